"""States of a load spectrum in Python: a name, a share of the time, changes of the scene."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from .._scene import AbstractScene
from .._types import Scalar
from ..bearings.bearing import AbstractBearing
from ..life.duty import SUM_TOLERANCE
from ..numerics.arguments import require_numbers
from ..numerics.checks import known


@dataclass(frozen=True)
class State:
    """One state of a load spectrum.

    **Arguments:**
    - `name`: its name, another one for each state.
    - `share`: its share of the time, above 0 and at most 1; the shares of all states add up to 1.
    - `changes`: dotted path of a field -> SI value, as `scene.replace` takes them.
    """

    name: str
    share: Scalar
    changes: Mapping[str, Any]


def require_states(states: Sequence[State]) -> None:
    """Checks names and shares; a traced share passes.

    **Raises:** `ValueError` for no state, for a name that another state has, and for shares that do not add up to 1.
    """
    if not states or not all(isinstance(one, State) for one in states):
        raise ValueError(f"states must be one or more of State(name, share, changes), got {states!r}")
    names = [one.name for one in states]
    for name in names:
        if not isinstance(name, str) or not name.strip() or names.count(name) > 1:
            raise ValueError(f"states must have a name of their own each, got {name!r} {names.count(name)} times")
    for one in states:
        require_numbers("above 0 and at most 1", **{f"share of state {one.name!r}": one.share})
    shares = known(*(one.share for one in states))
    if shares is not None and abs(sum(shares) - 1.0) > SUM_TOLERANCE:
        raise ValueError(f"share must add up to 1 over the states, got {sum(shares):.7g}")


def require_rated(scenes: Mapping[str, AbstractScene]) -> None:
    """Checks that each scene is a bearing with a life, all for one reliability. **Arguments:** name -> scene.

    **Raises:** `TypeError` for another kind of scene, `ValueError` for one without a rating and for reliabilities that
    differ.
    """
    reliabilities = {}
    for name, scene in scenes.items():
        if not isinstance(scene, AbstractBearing):
            raise TypeError(f"a load spectrum is one of a bearing, got a {type(scene).__name__}")
        if scene.rating is None:
            raise ValueError(f"rating: found nothing in state '{name}', expected a table: damage follows from the life")
        reliabilities[name] = scene.rating.reliability
    if len(set(reliabilities.values())) > 1:
        raise ValueError(f"rating.reliability: expected the same in all states, got {reliabilities}")
