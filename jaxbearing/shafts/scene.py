"""The shaft on its bearings as a scene."""

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from .._scene import AbstractScene, label, number, optional_number
from .._solvers import solver
from .._types import Scalar
from ..bearings.bearing import AbstractBearing
from ..bearings.parts import names_another_bearing
from ..life.duty import SUM_TOLERANCE
from ..numerics.checks import Checked, demand, is_recording, numbers_or_none
from ..numerics.newton import NewtonOptions
from ..numerics.refusals import refusals_of, refuse_all
from .forces import AbstractForce
from .heat import ShaftThermal, thermal_problems
from .mounting import LinearBearing, MatchedSet, MountedBearing, Support, _numbers
from .paths import part_at, path_in_file, replaced
from .shaft import Shaft

if TYPE_CHECKING:
    from .solution import ShaftSolution


MOST_BEARINGS = 500
"""Largest number of bearings of a system. The equations are dense, and each bearing adds about a second to the time
that the program needs to compile."""
MOST_STATES = 10_000
"""Largest number of states of a duty cycle. Each state is first made as a scene of its own, which takes about 0.1 s."""


class SystemLife(Checked):
    """Inputs of the life of all bearings together.

    **Arguments:** `weibull`: Weibull slope of every bearing's life, 1.5 in API 610; `None` for the slopes of the
    standards, 10/9 for ball and 9/8 for roller bearings.
    """

    part: ClassVar[str] = "life"

    weibull: Scalar | None = optional_number(bound="> 0", metadata=label("1", "Weibull slope"))


class ShaftState(Checked):
    """A state of a duty cycle.

    **Arguments:**
    - `share`: its share of the time, above 0 and at most 1; the shares of all states add up to 1.
    - `changes`: values that differ from the scene: dotted path -> SI value, such as `{"force.pinion.torque": 50.0,
      "shaft.speed": 300.0}`; bearings, sets and forces are found by their names.
    - `name`: name of the state; if not given, its number.
    """

    part: ClassVar[str] = "state"

    share: Scalar = number(bound="above 0 and at most 1", metadata=label("1", "share of the time"))
    changes: dict[str, Any] = eqx.field(default_factory=dict)
    name: str = eqx.field(static=True, default="")


class Place(NamedTuple):
    """One bearing of a system, single or of a set. `closure`: its own given closure, without the preload of its set,
    m; `expansion`: as given, m; `set_index`: index of its set, `None` for a single bearing."""

    name: str
    scene: AbstractBearing | LinearBearing
    position: Scalar
    sense: float
    closure: Scalar
    expansion: Scalar
    support: Support | None
    set_index: int | None


class ShaftSystem(AbstractScene):
    """A shaft on bearings, with all that acts on it. `jaxbearing.solve` finds its equilibrium.

    **Arguments:**
    - `shaft`: dimensions, speed and weight of the shaft.
    - `sets`, `bearings`: matched sets and single bearings. `places` has all bearings, those of the sets first.
    - `forces`: forces on the shaft besides those of its bearings.
    - `housing`: stiffness of a housing that holds all outer rings, shape (5 n, 5 n) in the frame of the shaft, five
      degrees of freedom for each of the bearings in the order of `places`; `None`: each outer ring has its own support.
    - `states`: states of a duty cycle; if there are none, the scene itself is the only state.
    - `life`: inputs of the life of the system.
    - `thermal`: joins the thermal networks of the bearings along shaft and housing; `None`: each has its own.

    **Raises:** `ValueError` for names that are given twice, for no bearing, for positions beyond the ends of the shaft,
    for flexible outer rings that nothing holds, for shares that do not add up to 1, and for a state whose scene is
    invalid; `AttributeError` for a state that changes a path that does not exist.
    """

    kind: ClassVar[str] = "shaft"
    operating_point: ClassVar[str] = "shaft"

    shaft: Shaft
    bearings: tuple[MountedBearing, ...] = eqx.field(default=(), converter=tuple)
    sets: tuple[MatchedSet, ...] = eqx.field(default=(), converter=tuple)
    forces: tuple[AbstractForce, ...] = eqx.field(default=(), converter=tuple)
    housing: Float[Array | np.ndarray, "m m"] | None = eqx.field(
        default=None, converter=_numbers, metadata=label("mixed", "stiffness of the housing")
    )
    states: tuple[ShaftState, ...] = eqx.field(default=(), converter=tuple)
    life: SystemLife = SystemLife()
    thermal: ShaftThermal | None = None

    def __check_init__(self):
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        places = self.places
        if not places:
            yield "bearing: found none, expected at least one bearing or set"
        for word, count, most in (("bearing", len(places), MOST_BEARINGS), ("state", len(self.states), MOST_STATES)):
            if count > most:
                yield f"{word}: found {count}, expected at most {most}"
                return
        for part, names in (
            ("bearing", [place.name for place in places]),
            ("set", [matched.name for matched in self.sets]),
            ("force", [force.name for force in self.forces]),
        ):
            for name in sorted({name for name in names if names.count(name) > 1}):
                yield f"{part}.{name}: this name is given {names.count(name)} times, expected once"
        if sum(force.balances for force in self.forces) > 1:
            yield "force: more than one has balance = true, expected at most one"
        yield from self._beyond()
        yield from self._shapes()
        paths = {self._table_of(place): place.scene for place in places}
        yield from thermal_problems(self.thermal, self.shaft, paths)
        if self.housing is not None:
            count = 5 * len(places)
            if np.shape(self.housing) != (count, count):
                yield f"housing must have the shape ({count}, {count}), got {np.shape(self.housing)}"
            if any(place.support is not None for place in places):
                yield "support: expected none beside housing, which holds all outer rings"
        for path in sorted({path for state in self.states for path in state.changes if names_another_bearing(path)}):
            yield f"state: found '{path}', expected changes that leave each bearing the same"
        yield from self._of_states()

    def _of_states(self) -> Iterator[str | ValueError]:
        """Problems of the states: their shares, and the scene of each state. Traced numbers of these scenes are checked
        in the solve (`steady`)."""
        shares = numbers_or_none(*(state.share for state in self.states))
        if not self.states or shares is None:
            return
        rule, total = "state.share must add up to 1 over the states", sum(shares)
        message = lambda: f"{rule}, got {float(total):.7g}"
        yield from refusals_of(demand, rule, abs(total - 1.0) <= SUM_TOLERANCE, message)
        if is_recording():
            return
        base = dataclasses.replace(self, states=())
        for place, state in enumerate(self.states):
            for error in refusals_of(base.replace, state.changes):
                yield f"state '{state.name or place + 1}': {error}"

    def _beyond(self) -> Iterator[str | ValueError]:
        """Problems of positions that lie beyond the ends of a shaft with sections."""
        lengths = numbers_or_none(*(section.length for section in self.shaft.sections))
        if not lengths:
            return
        end = sum(lengths)
        held = [(self._path_of(place), place.position) for place in self.places]
        held += [((f"force.{force.name}.position", ""), force.position) for force in self.forces]
        for (path, which), position in held:
            if numbers_or_none(position) is None:
                continue
            message = lambda path=path, which=which, position=position: (
                f"{path}: {which}{float(position) * 1e3:g} mm lies beyond the shaft ({float(end) * 1e3:g} mm)"
            )
            # distances of 1 nm are round-off of the sums
            inside = (position >= -1e-9) & (position <= end + 1e-9)
            yield from refusals_of(demand, f"{path} must lie within the length of the shaft", inside, message)

    def _shapes(self) -> Iterator[str]:
        """Problems of flexible outer rings: each needs something that holds it in place, and must not have an outer
        load if the shaft has an elastic support or housing there."""
        problems = []
        for place in self.places:
            ring = place.scene.outer_ring if isinstance(place.scene, AbstractBearing) else None
            if ring is None or not ring.harmonics:
                continue
            table = f"{self._table_of(place)}.outer_ring"
            if not ring.held:
                problems.append(
                    f"{table}: nothing holds the ring; expected housing_stiffness or support_angle, because a bearing "
                    "on a shaft carries no more than what holds its outer ring"
                )
            elif ring.load_angle is not None and (place.support is not None or self.housing is not None):
                problems.append(
                    f"{table}.load_angle: expected none beside an elastic support or housing of the shaft, on which "
                    "loads from outside would act too"
                )
        # a set has the same parts in each of its bearings
        yield from dict.fromkeys(problems)

    def _table_of(self, place: Place) -> str:
        """Path of the table of a bearing, or of its set."""
        return f"bearing.{place.name}" if place.set_index is None else f"set.{self.sets[place.set_index].name}"

    def _path_of(self, place: Place) -> tuple[str, str]:
        """Path of the position of a bearing, and for a bearing of a set the words that name it."""
        which = "" if place.set_index is None else f"{place.name} at "
        return f"{self._table_of(place)}.position", which

    @property
    def places(self) -> tuple[Place, ...]:
        """All bearings: those of the sets in their order, then the single bearings."""
        places = []
        for index, entry in enumerate(self.sets):
            mismatch = np.zeros(entry.count) if entry.mismatch is None else entry.mismatch
            for name, scene, position, sense, closure in zip(
                entry.names, entry.scenes, entry.positions(), entry.senses, mismatch, strict=True
            ):
                places.append(Place(name, scene, position, sense, closure, entry.expansion, entry.support, index))
        for entry in self.bearings:
            support = entry.support
            places += [
                Place(
                    entry.name, entry.scene, entry.position, entry.sense, entry.closure, entry.expansion, support, None
                )
            ]
        return tuple(places)

    def replace(self, changes: Any) -> "ShaftSystem":
        """A copy with other values. `changes`: dotted path of scene files (`paths`) -> SI number or part.

        **Raises:** the errors of `AbstractScene.replace`.
        """
        return replaced(self, changes)

    def part_at(self, path: str) -> Any:
        return part_at(self, path)

    def path_in_file(self, path: str) -> str:
        return path_in_file(self, path)

    def steady_solution(self, options: NewtonOptions) -> "ShaftSolution":
        return solver(self.kind, "steady_solution")(self, options)
