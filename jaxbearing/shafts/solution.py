"""Results of a shaft on bearings. Every quantity carries its unit and description where it is defined.

Vectors of five have the order of `RING_FREEDOMS`. In the frame of the shaft they are along X, Y, Z and about both
tilts; in the frame of a bearing its own axis points along +X or -X (`BearingOnShaft.sense`).
"""

from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._scene import AbstractSolution, label
from ..bearings.solution import FailureCause, RingDisplacement, Solution, causes_in_words
from ..life.duty import SpectrumLife
from ..life.result import AtReliability, Life, reliability_field
from ..numerics.status import Status
from .heat import ShaftThermalResult

_Number = Float[Array, ""]


class BearingOnShaft(eqx.Module):
    """One bearing of a solved shaft.

    **Arguments:** the labels of the fields describe them; others are
    - `ring`: displacement of the inner ring relative to the outer ring at the port (on the axis, in the plane of the
      unloaded balls or in the middle of the rollers), in the bearing's frame, without closure.
    - `solution`: results of the bearing's own family at the displacement that the shaft prescribes. `None` for a linear
      bearing.
    - `life`: life of the bearing; `None` without a rating in the bearing's scene.
    - `name`, `sense`: name of the bearing; 1 if its axis points along +X, else -1.
    """

    position: _Number = eqx.field(metadata=label("m", "position along the shaft"))
    ring: RingDisplacement
    force: Float[Array, "5"] = eqx.field(
        metadata=label("mixed", "load that holds the inner ring, frame of the bearing, N and N m")
    )
    stiffness: Float[Array, "5 5"] = eqx.field(
        metadata=label("mixed", "d force / d displacement of the inner ring, frame of the bearing")
    )
    on_shaft: Float[Array, "5"] = eqx.field(
        metadata=label("mixed", "force of the bearing on the shaft at its position, frame of the shaft, N and N m")
    )
    outer: Float[Array, "5"] = eqx.field(
        metadata=label("mixed", "displacement of the outer ring, frame of the shaft, m and rad")
    )
    closure: _Number = eqx.field(metadata=label("m", "closure: axial displacement that mounting has given the ring"))
    expansion: _Number = eqx.field(
        metadata=label("m", "expansion of the inner raceway's radius less that of the outer one")
    )
    largest_load: _Number = eqx.field(metadata=label("N", "largest load of a rolling element on the inner raceway"))
    pressure_centre: _Number = eqx.field(
        metadata=label(
            "m", "position where normals of the unloaded outer race through the elements' middles meet the shaft's axis"
        )
    )
    solution: Solution | None
    life: Life | None
    name: str = eqx.field(static=True)
    sense: float = eqx.field(static=True)

    @property
    def radial_force(self) -> Float[Array, "*batch"]:
        """Size of the force on the shaft across its axis, N."""
        return jnp.hypot(self.on_shaft[..., 1], self.on_shaft[..., 2])

    @property
    def azimuth(self) -> Float[Array, "*batch"]:
        """Azimuth of the force on the shaft across its axis, rad."""
        return jnp.arctan2(self.on_shaft[..., 2], self.on_shaft[..., 1])

    @property
    def moment(self) -> Float[Array, "*batch"]:
        """Size of the moment on the shaft, N m."""
        return jnp.hypot(self.on_shaft[..., 3], self.on_shaft[..., 4])


class ShaftNodes(eqx.Module):
    """The shaft at its nodes: ends of sections, bearings and forces, in ascending order of `position`."""

    position: Float[Array, " node"] = eqx.field(metadata=label("m", "position along the shaft"))
    displacement: Float[Array, "node freedom"] = eqx.field(
        metadata=label("mixed", "displacement of the shaft, axial, radial, lateral, m, and tilts, rad")
    )
    load: Float[Array, "node freedom"] = eqx.field(
        metadata=label("mixed", "loads on the shaft at its nodes without those of bearings, N and N m")
    )


class SetResult(eqx.Module):
    """Results of a matched set. Fields that do not apply to its kind of preload are `None`.

    **Arguments:** the labels of the fields describe them.
    """

    preload: _Number | None = eqx.field(
        metadata=label("N", "axial force between the opposed groups, mounted, at rest and without load")
    )
    closure: _Number | None = eqx.field(metadata=label("m", "closure of each bearing that the preload asks for"))
    loss_force: _Number | None = eqx.field(
        metadata=label("N", "axial load on the group with more bearings that unloads the other one, at rest")
    )
    travel: _Number | None = eqx.field(
        metadata=label("m", "displacement of the outer rings that springs press, closing is positive")
    )
    spring_force: _Number | None = eqx.field(metadata=label("N", "force of the springs"))
    support_distance: _Number = eqx.field(
        metadata=label("m", "distance of the pressure centres of the outermost opposed bearings")
    )


class TorqueBalance(eqx.Module):
    """Torques about the shaft's axis, N m, positive in the sense of positive speed: `forces` + `drive` = `bearings`.

    **Arguments:** `forces`: torque of gears, belts and tangential loads; `bearings`: sum of the torques that turn the
    inner rings against friction; `drive`: torque that the drive must add; `power_loss`: losses of all bearings, W.
    """

    forces: _Number = eqx.field(metadata=label("N m", "sum of the torques of the forces"))
    bearings: _Number = eqx.field(metadata=label("N m", "sum of the friction torques of the bearings"))
    drive: _Number = eqx.field(metadata=label("N m", "torque of the drive"))
    power_loss: _Number = eqx.field(metadata=label("W", "sum of the losses of all bearings"))


def _of_system(unit: str, description: str):
    return eqx.field(default=None, kw_only=True, metadata=label(unit, description))


class SystemLifeResult(AtReliability):
    """Life of all bearings together, for each kind of life that all of them have: 90 % of such shafts, or for Lnmr the
    fraction `reliability`, reach it without the failure of a bearing. Revolutions are those of the shaft.

    There is no Lnmr of the system if the bearings are rated for different reliabilities.
    """

    Lnmr_hours: _Number | None = _of_system("h", "modified reference rating life of the system at the reliability n")
    Lnmr: _Number | None = _of_system(
        "1", "modified reference rating life of the system at the reliability n, million revolutions"
    )
    L10r_hours: _Number = eqx.field(
        kw_only=True, metadata=label("h", "basic reference rating life of the system at 90 % reliability")
    )
    L10r: _Number = eqx.field(
        kw_only=True,
        metadata=label("1", "basic reference rating life of the system at 90 % reliability, million revolutions"),
    )
    L10mh: _Number | None = _of_system("h", "modified rating life of ISO 281 of the system at 90 % reliability")
    L10m: _Number | None = _of_system(
        "1", "modified rating life of ISO 281 of the system at 90 % reliability, million revolutions"
    )
    L10h: _Number | None = _of_system("h", "basic rating life of ISO 281 of the system at 90 % reliability")
    L10: _Number | None = _of_system(
        "1", "basic rating life of ISO 281 of the system at 90 % reliability, million revolutions"
    )
    reliability: float = reliability_field()


class DutyResult(eqx.Module):
    """Lives under a duty cycle. The damage of all states is added for each bearing; the lives of the bearings give the
    life of the system.

    **Arguments:** `lives`: life of each rated bearing by its name; `system`: life of the system, `None` if a bearing
    has no rating; `names`: names of the states; `states`: their solutions, stacked along a first axis of every array.
    """

    lives: dict[str, SpectrumLife]
    system: SystemLifeResult | None
    shares: Float[Array, " state"] = eqx.field(metadata=label("1", "shares of the time"))
    states: "ShaftSolution"
    names: tuple[str, ...] = eqx.field(static=True)

    @property
    def bearing_hours(self) -> dict[str, Float[Array, "*batch"]]:
        """L10r of each rated bearing, h."""
        return {name: life.L10r_hours for name, life in self.lives.items()}

    @property
    def system_hours(self) -> Float[Array, "*batch"] | None:
        """L10r of the system, h."""
        return None if self.system is None else self.system.L10r_hours


class ShaftSolution(AbstractSolution):
    """Result of a solve of a shaft on bearings. A solve that did not converge returns NaN for every result.

    With a duty cycle it is the solution of the first state, and `duty` has all of them.

    **Arguments:** the labels of the fields describe them; others are
    - `bearings`: results of the bearings by name, bearings of sets first.
    - `sets`: results of the matched sets by name.
    - `life`: life of the system; `None` if a bearing has no rating.
    - `thermal`: common thermal network along shaft and housing; `None` if there is none.
    - `checks`: text of a warning or rule -> True if it applies.
    - `softest`: degree of freedom along which the search ran away if there is no equilibrium: index into
      `freedom_names`, which also name the bearing.
    """

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the solve ended"))
    iterations: Int[Array, ""] = eqx.field(metadata=label("1", "Newton steps of both stages"))
    start_steps: Int[Array, ""] = eqx.field(metadata=label("1", "steps of the convex minimisation"))
    newton_steps: Int[Array, ""] = eqx.field(metadata=label("1", "steps with exact centrifugal forces"))
    residual_norm: Float[Array, ""] = eqx.field(metadata=label("1", "largest scaled residual"))
    bearings: dict[str, BearingOnShaft]
    shaft: ShaftNodes
    sets: dict[str, SetResult]
    torque: TorqueBalance
    life: SystemLifeResult | None
    checks: Mapping[str, Bool[Array, ""]]
    softest: Int[Array, ""]
    operation: Any = None
    duty: DutyResult | None = None
    thermal: ShaftThermalResult | None = None
    failure_causes: dict[str, FailureCause] = eqx.field(default_factory=dict)
    unknowns: int = eqx.field(static=True, default=0, metadata=label("1", "unknowns of the shaft"))
    freedom_names: tuple[str, ...] = eqx.field(static=True, default=())
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    @property
    def converged(self) -> Bool[Array, "*batch"]:
        return self.status == Status.CONVERGED

    def solver_failure(self) -> str:
        """One sentence on a failed solve."""
        status, steps = Status(int(self.status)), int(self.iterations)
        causes = causes_in_words(self.failure_causes)
        if causes:
            return f"{status.text}: {'; '.join(causes)}"
        if status == Status.NO_EQUILIBRIUM:
            return (
                f"{status.text}: nothing holds the shaft along {self.freedom_names[int(self.softest)]} (after "
                f"{steps} steps)"
            )
        if status == Status.THERMAL_RUNAWAY:
            return self._runaway()
        return f"{status.text} after {steps} steps: scaled residual {float(self.residual_norm):.3g}"

    def _runaway(self) -> str:
        """One sentence on a thermal runaway, with the hottest node of the first state that has one."""
        if self.duty is not None:
            lane = int(np.argmax(np.asarray(self.duty.states.status) == Status.THERMAL_RUNAWAY))
            state = jax.tree.map(lambda leaf: leaf[lane], self.duty.states)
            return f"{state._runaway()}, in state {self.duty.names[lane]}"
        solved = {name: bearing.solution for name, bearing in self.bearings.items() if bearing.solution is not None}
        warm = {name: solution.thermal for name, solution in solved.items() if solution.thermal is not None}
        name, hottest = max(warm.items(), key=lambda entry: float(jnp.max(entry[1].last)))
        return f"{hottest.ending(Status.THERMAL_RUNAWAY)}, in bearing {name}"
