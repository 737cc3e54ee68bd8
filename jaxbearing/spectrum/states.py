"""States of a load spectrum in Python: a name, a share of the time, changes of the scene."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import equinox as eqx

from .._scene import AbstractScene
from .._types import Scalar
from ..bearings.bearing import AbstractBearing
from ..bearings.parts import RUNNING_SIZES
from ..life.duty import SUM_TOLERANCE
from ..numerics.arguments import require_numbers
from ..numerics.checks import known, numbers_or_none


@dataclass(frozen=True)
class State:
    """One state of a load spectrum.

    **Arguments:**
    - `name`: name of the state; no two states have the same.
    - `share`: share of the time, above 0 and at most 1; the shares of all states add up to 1.
    - `changes`: dotted path of a field -> SI value, as `scene.replace` takes them.
    """

    name: str
    share: Scalar
    changes: Mapping[str, Any]


def require_states(states: Sequence[State]) -> None:
    """Checks the names and the shares of the states. Traced shares are not checked.

    **Raises:** `ValueError` if there is no state, if two states have the same name or a state has none, or if a share
    is out of range or the shares do not add up to 1.
    """
    if not states or not all(isinstance(state, State) for state in states):
        raise ValueError(f"states must be one or more of State(name, share, changes), got {states!r}")
    names = [state.name for state in states]
    for name in names:
        if not isinstance(name, str) or not name.strip() or names.count(name) > 1:
            raise ValueError(f"states must have a name of their own each, got {name!r} {names.count(name)} times")
    for state in states:
        require_numbers("above 0 and at most 1", **{f"share of state {state.name!r}": state.share})
    shares = known(*(state.share for state in states))
    if shares is not None and abs(sum(shares) - 1.0) > SUM_TOLERANCE:
        raise ValueError(f"share must add up to 1 over the states, got {sum(shares):.7g}")


def require_rated(scenes: Mapping[str, AbstractScene]) -> None:
    """Checks that all scenes are states of one bearing and rate its life at the same reliability.

    **Arguments:** `scenes`: name of a state -> its scene.

    **Raises:** `TypeError` for a scene that is not a bearing; `ValueError` for a scene without a rating, for different
    reliabilities, and for different bearings.
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
    states = list(scenes.items())
    for name, scene in states[1:]:
        first, bearing = states[0]
        for path in _differing_fields(bearing, scene):
            problem = f"found one value in state '{first}' and another in state '{name}'"
            raise ValueError(f"{path}: {problem}, expected states of one bearing")


def _differing_fields(bearing: AbstractScene, other: AbstractScene) -> Iterator[str]:
    """Dotted paths of the fields of geometry and materials whose values make the other scene another bearing. Traced
    numbers are not compared."""
    assert isinstance(bearing, AbstractBearing), "other scenes are refused"
    assert isinstance(other, AbstractBearing), "other scenes are refused"
    for part in ("geometry", "materials"):
        yield from _differences(getattr(bearing, part), getattr(other, part), part)


def _differences(first: object, other: object, path: str) -> Iterator[str]:
    if isinstance(first, eqx.Module) and type(first) is type(other):
        for field in dataclasses.fields(first):
            if field.name not in RUNNING_SIZES:
                yield from _differences(getattr(first, field.name), getattr(other, field.name), f"{path}.{field.name}")
    elif numbers_or_none(first, other) is None:
        if first != other:
            yield path
    elif (numbers := known(first, other)) is not None and numbers[0] != numbers[1]:
        yield path
