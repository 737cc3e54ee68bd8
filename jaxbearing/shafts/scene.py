"""The shaft on its bearings as a scene."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from .._scene import AbstractScene, label, number, optional_number, replaced
from .._types import Scalar
from ..bearings.bearing import AbstractBearing
from ..life.duty import SUM_TOLERANCE
from ..numerics.checks import Checked, known
from ..numerics.newton import NewtonOptions
from ..numerics.refusals import refuse_all
from .forces import AbstractForce
from .mounting import LinearBearing, MatchedSet, MountedBearing, Support, numbers
from .shaft import Shaft


_MEMBERS = {"bearing": "bearings", "set": "sets", "force": "forces"}
"""Word before the name of a member -> field of the system."""


def _changed(member: Any, changes: Mapping[str, Any], above: str) -> Any:
    """A bearing, set or force with other values; what its class has no field for belongs to its scene."""
    fields = {field.name for field in dataclasses.fields(member)}
    own = {path: value for path, value in changes.items() if path.split(".")[0] in fields}
    deeper = {path: value for path, value in changes.items() if path not in own}
    if deeper and not hasattr(member, "scene"):
        raise AttributeError(f"{above}{next(iter(deeper))}: a {type(member).__name__} has no such field")
    if own:
        member = replaced(member, {tuple(path.split(".")): value for path, value in own.items()}, above)
    if deeper:
        one = lambda scene: replaced(scene, {tuple(path.split(".")): value for path, value in deeper.items()}, above)
        scene = tuple(map(one, member.scene)) if isinstance(member.scene, tuple) else one(member.scene)
        member = dataclasses.replace(member, scene=scene)
    return member


class SystemLife(Checked):
    """Inputs of the life of all bearings together.

    **Arguments:** `weibull`: slope of the distribution of every bearing's life, 1.5 in API 610; `None` for that of the
    standards, 10/9 of ball and 9/8 of roller bearings.
    """

    part: ClassVar[str] = "life"

    weibull: Scalar | None = optional_number(bound="> 0", metadata=label("1", "Weibull slope"))


class ShaftState(Checked):
    """A state of a duty cycle.

    **Arguments:**
    - `share`: its share of the time, above 0 and at most 1; the shares of all states add up to 1.
    - `changes`: what differs from the scene: dotted path -> SI value, such as `{"force.pinion.torque": 50.0,
      "shaft.speed": 300.0}`; bearings, sets and forces are found by their names.
    - `name`: its name; left out: its number.
    """

    part: ClassVar[str] = "state"

    share: Scalar = number(bound="above 0 and at most 1", metadata=label("1", "share of the time"))
    changes: dict[str, Any] = eqx.field(default_factory=dict)
    name: str = eqx.field(static=True, default="")


class Place(NamedTuple):
    """One bearing of a system, from a set or alone. `closure` and `expansion` are those that it is given by itself,
    m; `set_index` is the number of its set, or `None`."""

    name: str
    scene: AbstractBearing | LinearBearing
    position: Any
    sense: float
    closure: Any
    expansion: Any
    support: Support | None
    set_index: int | None


class ShaftSystem(AbstractScene):
    """A shaft on bearings, with all that acts on it. `jaxbearing.solve` finds its equilibrium.

    **Arguments:**
    - `shaft`: dimensions, speed, weight.
    - `sets`, `bearings`: on the shaft. `places` has all bearings, those of the sets first.
    - `forces`: that act on the shaft.
    - `housing`: stiffness of a housing that holds all outer rings, shape (5 n, 5 n) in the frame of the shaft, five
      freedoms for each of the bearings in the order of `places`; `None`: each outer ring has its own support.
    - `states`: of a duty cycle; without any there is one state, that of the scene.
    - `life`: inputs of the life of the system.

    **Raises:** `ValueError` for names that are given twice, for no bearing, for positions beyond the ends of the shaft,
    and for shares that do not add up to 1.
    """

    kind: ClassVar[str] = "shaft"
    operating_point: ClassVar[str] = "shaft"

    shaft: Shaft
    bearings: tuple[MountedBearing, ...] = eqx.field(default=(), converter=tuple)
    sets: tuple[MatchedSet, ...] = eqx.field(default=(), converter=tuple)
    forces: tuple[AbstractForce, ...] = eqx.field(default=(), converter=tuple)
    housing: Float[Array | np.ndarray, "m m"] | None = eqx.field(
        default=None, converter=numbers, metadata=label("mixed", "stiffness of the housing")
    )
    states: tuple[ShaftState, ...] = eqx.field(default=(), converter=tuple)
    life: SystemLife = SystemLife()

    def __check_init__(self):
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str]:
        places = self.places
        if not places:
            yield "bearing: found none, expected at least one bearing or set"
        for part, names in (
            ("bearing", [place.name for place in places]),
            ("set", [one.name for one in self.sets]),
            ("force", [force.name for force in self.forces]),
        ):
            for name in sorted({name for name in names if names.count(name) > 1}):
                yield f"{part}.{name}: this name is given {names.count(name)} times, expected once"
        if sum(force.balances for force in self.forces) > 1:
            yield "force: more than one has balance = true, expected at most one"
        yield from self._beyond()
        if self.housing is not None:
            count = 5 * len(places)
            if np.shape(self.housing) != (count, count):
                yield f"housing must have the shape ({count}, {count}), got {np.shape(self.housing)}"
            if any(place.support is not None for place in places):
                yield "support: expected none beside housing, which holds all outer rings"
        shares = known(*(state.share for state in self.states))
        if self.states and shares is not None and abs(sum(shares) - 1.0) > SUM_TOLERANCE:
            yield f"state.share must add up to 1 over the states, got {sum(shares):.7g}"

    def _beyond(self) -> Iterator[str]:
        """Problems of positions that lie beyond the ends of a shaft with sections."""
        length = known(*(section.length for section in self.shaft.sections))
        if not length:
            return
        end = sum(length)
        held = [(f"bearing.{place.name}", place.position) for place in self.places]
        held += [(f"force.{force.name}", force.position) for force in self.forces]
        for name, position in held:
            at = known(position)
            if at is not None and not -1e-9 <= at[0] <= end + 1e-9:
                yield f"{name}.position: {at[0] * 1e3:g} mm lies beyond the shaft ({end * 1e3:g} mm)"

    def replace(self, changes: Any) -> "ShaftSystem":
        """A copy with other values. Keys are dotted paths of the fields of this class; or `bearing.NAME.`, `set.NAME.`
        or `force.NAME.` and a field of the member with this name, or a path of the scene of a bearing or of a set:
        `force.pinion.torque`, `bearing.rear.geometry.diametral_clearance`. Values are SI numbers, or parts.

        **Raises:** as `AbstractScene.replace`; `AttributeError` for a name that no member has.
        """
        if not isinstance(changes, Mapping) or not all(isinstance(path, str) for path in changes):
            return super().replace(changes)
        own: dict[str, Any] = {}
        members: dict[tuple[str, str], dict[str, Any]] = {}
        for path, value in changes.items():
            first, *rest = path.split(".", 2)
            if first in _MEMBERS and len(rest) == 2:
                members.setdefault((first, rest[0]), {})[rest[1]] = value
            else:
                own[path] = value
        system = super().replace(own) if own else self
        for (kind, name), deeper in members.items():
            field = _MEMBERS[kind]
            everyone = getattr(system, field)
            found = [one.name for one in everyone]
            if name not in found:
                raise AttributeError(f"the scene has no {kind} {name!r}: it has {', '.join(found) or 'none'}")
            new = [_changed(one, deeper, f"{kind}.{name}.") if one.name == name else one for one in everyone]
            system = dataclasses.replace(system, **{field: tuple(new)})
        return system

    @property
    def places(self) -> tuple[Place, ...]:
        """All bearings: those of the sets in their order, then those that stand alone."""
        found = []
        for index, one in enumerate(self.sets):
            mismatch = np.zeros(one.count) if one.mismatch is None else one.mismatch
            for name, scene, position, sense, closure in zip(
                one.names, one.scenes, one.positions(), one.senses, mismatch, strict=True
            ):
                found.append(Place(name, scene, position, sense, closure, one.expansion, one.support, index))
        for alone in self.bearings:
            found.append(
                Place(
                    alone.name,
                    alone.scene,
                    alone.position,
                    alone.sense,
                    alone.closure,
                    alone.expansion,
                    alone.support,
                    None,
                )
            )
        return tuple(found)

    def steady_solution(self, options: NewtonOptions) -> Any:
        from .steady import solve_shaft

        return solve_shaft(self, options)
