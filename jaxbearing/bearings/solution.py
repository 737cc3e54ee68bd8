"""Results of a steady solve. Every quantity carries its unit and description where it is defined.

The command line, JSON, files and pages read this metadata, so that no second list of units exists.
"""

import dataclasses
from collections.abc import Mapping
from typing import Generic, NamedTuple, TypeVar

import equinox as eqx
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._scene import AbstractSolution, derived_part
from .._scene import derived as derived
from .._scene import label as label
from ..life.result import Life
from ..numerics.status import Status
from ..thermal.result import ThermalResult
from .frequencies import KinematicFrequencies, frequencies_of_motion
from .growth import FitResult
from .operation import AbstractOperation
from .ring_deflection import InnerRingDeflection, RingDeflection
from .supplied import SupplyResult

INNER_TOLERANCE = 1e-8
"""Residual of nested solves (`inner_residual`) above which a failure message names the nested solve as the cause."""

RING_FREEDOMS = ("axial", "radial", "lateral", "tilt", "tilt_lateral")
"""Degrees of freedom of the inner ring, in the order of `ring` and `stiffness`."""
TILTS = ("tilt", "tilt_lateral")
"""Degrees of freedom among `RING_FREEDOMS` that are angles."""

_CONJUGATE = {"m": "N", "rad": "N m"}
"""Unit of a displacement of the ring -> unit of its load."""


class RingDisplacement(eqx.Module):
    """Displacement of the inner ring. Degrees of freedom that the bearing does not model are 0.

    The zero of `axial` depends on the bearing:
    - ball bearings given by their clearance: the middle of the play, where the planes of the grooves coincide;
    - cylindrical roller bearings with flanges: the middle of the play;
    - ball bearings given by their contact angle, and tapered bearings: first contact of elements and races. For tapered
      bearings with `[fits]` this is first contact with the dimensions of the drawing.
    """

    axial: Float[Array, ""] = eqx.field(
        metadata=label("m", "axial displacement (zero: middle of the play, or first contact if given by contact angle)")
    )
    radial: Float[Array, ""] = eqx.field(metadata=label("m", "displacement along the load line"))
    lateral: Float[Array, ""] = eqx.field(metadata=label("m", "displacement across the load line"))
    tilt: Float[Array, ""] = eqx.field(metadata=label("rad", "tilt that moves azimuth 0 axially"))
    tilt_lateral: Float[Array, ""] = eqx.field(metadata=label("rad", "tilt about the load line"))


def force_units() -> tuple[str, ...]:
    """Units of the entries of `Solution.force`: N and N m."""
    return tuple(_CONJUGATE[field.metadata["unit"]] for field in dataclasses.fields(RingDisplacement))


def stiffness_units() -> tuple[tuple[str, ...], ...]:
    """Units of the entries of `Solution.stiffness`: N/m, N/rad, N m/m and N m/rad."""
    fields = {field.name: field for field in dataclasses.fields(RingDisplacement)}
    units = [fields[name].metadata["unit"] for name in RING_FREEDOMS]
    return tuple(tuple(f"{_CONJUGATE[row]}/{column}" for column in units) for row in units)


class CageState(eqx.Module):
    """Position and speed of the cage."""

    speed: Float[Array, ""] = eqx.field(metadata=label("rad/s", "cage speed"))
    slip: Float[Array, ""] = eqx.field(metadata=label("1", "1 - cage speed / speed of rolling without slip"))
    eccentricity_ratio: Float[Array, ""] = eqx.field(metadata=label("1", "cage offset over radial guiding clearance"))
    attitude_angle: Float[Array, ""] = eqx.field(metadata=label("rad", "angle between land load and line of centres"))


def losses_not_modelled(loss: eqx.Module) -> tuple[str, ...]:
    """Names of the losses that this scene does not model (`None`).

    **Arguments:** `loss`: a `PowerLoss`, `BallPowerLoss` or `TaperedPowerLoss`.
    """
    absent = (field.name for field in dataclasses.fields(loss) if getattr(loss, field.name) is None)
    return tuple(name for name in absent if name != "total")


class RacewayPower(eqx.Module):
    """Losses of balls on the raceways by kind: spin about the contact normal, sliding along and across the rolling
    direction, and Heathcote slip due to the curvature of the contact (`None`: the contact is taken as flat)."""

    inner_spin: Float[Array, ""] = eqx.field(metadata=label("W", "spin, inner raceway"))
    inner_rolling: Float[Array, ""] = eqx.field(metadata=label("W", "sliding along rolling, inner raceway"))
    inner_transverse: Float[Array, ""] = eqx.field(metadata=label("W", "sliding across rolling, inner raceway"))
    outer_spin: Float[Array, ""] = eqx.field(metadata=label("W", "spin, outer raceway"))
    outer_rolling: Float[Array, ""] = eqx.field(metadata=label("W", "sliding along rolling, outer raceway"))
    outer_transverse: Float[Array, ""] = eqx.field(metadata=label("W", "sliding across rolling, outer raceway"))
    inner_curvature: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "Heathcote slip, inner raceway")
    )
    outer_curvature: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "Heathcote slip, outer raceway")
    )


class BoundaryPower(eqx.Module):
    """Losses by boundary friction of asperities, for scenes with mixed friction. Each entry is included in the loss of
    the same name in `power_loss`. Places that a kind of bearing does not have are `None`."""

    total: Float[Array, ""] = eqx.field(metadata=label("W", "boundary friction, total"))
    inner_raceway: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "boundary friction, inner raceway")
    )
    outer_raceway: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "boundary friction, outer raceway")
    )
    flange: Float[Array, ""] | None = eqx.field(default=None, metadata=label("W", "boundary friction, flange"))


class RollingByRace(eqx.Module):
    """Rolling resistance of each raceway, which `RacewayPower` does not include. `law` describes the law and the inlet
    heating in words."""

    inner: Float[Array, ""] = eqx.field(metadata=label("W", "rolling resistance of the inner raceway"))
    outer: Float[Array, ""] = eqx.field(metadata=label("W", "rolling resistance of the outer raceway"))
    law: str = eqx.field(static=True)


class LaminaLoads(eqx.Module):
    """Loads on the laminae (slices) of rollers along their length, beginning at the end s = 0.

    **Arguments:**
    - `inner`, `outer`: load of each lamina on the inner and outer raceway, N.
    - `profiled`: True if the rollers have a profile, which spreads the load near the ends.
    """

    inner: Float[Array, "element lamina"]
    outer: Float[Array, "element lamina"]
    profiled: bool = eqx.field(static=True, default=False)


class FailureCause(NamedTuple):
    """A possible cause of a failed solve. `applies` is True if it is a cause of this failure; `numbers` are inserted
    into its text, which is its key in `Solution.failure_causes`."""

    applies: Bool[Array, ""]
    numbers: Float[Array, "..."]


def causes_in_words(causes: Mapping[str, FailureCause]) -> list[str]:
    """Texts of the causes that apply, with their numbers inserted."""
    return [
        text.format(*np.atleast_1d(np.asarray(cause.numbers)).tolist())
        for text, cause in causes.items()
        if bool(cause.applies)
    ]


Point = TypeVar("Point", bound=AbstractOperation)
"""Class of the operating point of a bearing family."""
Elements = TypeVar("Elements", bound=eqx.Module)
"""Class of the results of the rolling elements."""
Losses = TypeVar("Losses", bound=eqx.Module)
"""Class of the power losses."""


class Solution(AbstractSolution, Generic[Point, Elements, Losses]):
    """Result of a steady solve. If it did not converge, every physical result is NaN, never the last iterate; `status`,
    `iterations` and the residuals still describe the solve.

    `BallSolution`, `RollerSolution` and `TaperedSolution` name the classes of `operation`, `elements` and
    `power_loss` of a bearing family. Drive power and torques are `None` if the scene models no loss.

    **Arguments:** most fields are described by their labels; the others are
    - `checks`: text of a warning or rule -> True if a law is used outside its range or an input breaks the rule.
    - `worst_equation`: index in `equation_names`; `worst_element`: index of the rolling element, without meaning if the
      worst equation belongs to no single element.
    - `force`: external loads that hold the inner ring in place, positive along its displacements.
    - `ring_freedom`: degrees of freedom of the ring whose displacement is a result or is prescribed; the prescribed
      ones are also in `held_freedom`.
    - `equation_names`: equations of one rolling element, then those that belong to no single element.
    - `global_equations`: number of equations that belong to no single rolling element.
    - `notes`: what the model assumes or leaves out.
    - `element_name`: "ball" or "roller".
    - `rolling_by_race`: parts of `power_loss.rolling_resistance`; `None`: not modelled.
    """

    status: Int[Array, ""] = eqx.field(metadata=label("1", "how the solve ended"))
    iterations: Int[Array, ""] = eqx.field(metadata=label("1", "Newton steps"))
    residual_norm: Float[Array, ""] = eqx.field(metadata=label("1", "largest scaled residual"))
    inner_residual: Float[Array, ""] = eqx.field(
        metadata=label("1", "largest residual of nested solves: inlet temperature, cage land, orbital speed of balls")
    )
    worst_equation: Int[Array, ""] = eqx.field(metadata=label("1", "equation with the largest scaled residual"))
    worst_element: Int[Array, ""] = eqx.field(metadata=label("1", "rolling element with the largest scaled residual"))
    operation: Point
    ring: RingDisplacement
    cage: CageState | None
    elements: Elements
    power_loss: Losses
    drive_power: Float[Array, ""] | None = eqx.field(metadata=label("W", "sum over both rings of torque times speed"))
    inner_torque: Float[Array, ""] | None = eqx.field(metadata=label("N m", "torque that drives the inner ring"))
    outer_torque: Float[Array, ""] | None = eqx.field(metadata=label("N m", "torque that drives the outer ring"))
    force: Float[Array, " freedom"] = eqx.field(
        metadata=label(
            "mixed",
            "loads that hold the inner ring where it is, friction along the raceways left out: axial, radial, lateral, "
            "about tilt and tilt_lateral, in N and N m; degrees of freedom that are not modelled are 0",
        )
    )
    stiffness: Float[Array, "freedom freedom_displaced"] = eqx.field(
        metadata=label(
            "mixed",
            "d load / d displacement of the inner ring: rows and columns axial, radial, lateral, tilt, tilt_lateral, "
            "in N/m, N/rad, N m/m and N m/rad; degrees of freedom that are not modelled are 0",
        )
    )
    checks: Mapping[str, Bool[Array, ""]]
    ring_freedom: tuple[str, ...] = eqx.field(static=True)
    equation_names: tuple[str, ...] = eqx.field(static=True)
    global_equations: int = eqx.field(static=True)
    unknowns: int = eqx.field(static=True, metadata=label("1", "unknowns of the equations"))
    notes: tuple[str, ...] = eqx.field(static=True, default=())
    stiffness_freedom: tuple[str, ...] | None = eqx.field(static=True, default=None)
    """Degrees of freedom whose rows and columns of `stiffness` are modelled; the others are 0. `None`: the same as
    `ring_freedom`."""
    element_name: str = eqx.field(static=True, default="roller")
    raceway_power: RacewayPower | None = None
    laminae: LaminaLoads | None = None
    held_freedom: tuple[str, ...] = eqx.field(static=True, default=())
    """Modelled degrees of freedom of the ring with a prescribed displacement."""
    fit: FitResult | None = None
    thermal: ThermalResult | None = None
    failure_causes: dict[str, FailureCause] = eqx.field(default_factory=dict)
    """Possible causes of a failed solve: text with placeholders for numbers, such as `{:.3g}` -> its `FailureCause`."""
    life: Life | None = None
    """Life of the bearing, if the scene has a rating."""
    rolling_by_race: RollingByRace | None = None
    boundary_power: BoundaryPower | None = None
    supply: SupplyResult | None = None
    outer_ring: RingDeflection | None = None
    """Deformed shape of the outer ring, if it bends."""
    inner_ring: InnerRingDeflection | None = None
    """Deformed shape of the inner ring, if it bends."""
    textbook_frequencies: KinematicFrequencies | None = None
    """Frequencies for rolling without slip at the contact angle of the drawing."""

    @derived_part(KinematicFrequencies)
    def frequencies(self) -> KinematicFrequencies:
        """Frequencies of the computed motion."""
        return frequencies_of_motion(self.operation, self.elements, self.cage)

    @property
    def freedoms_of_stiffness(self) -> tuple[str, ...]:
        """Degrees of freedom whose rows and columns of `stiffness` are modelled, in the order of `RING_FREEDOMS`. For
        the others, `stiffness` contains 0 as a placeholder."""
        freedoms = self.ring_freedom if self.stiffness_freedom is None else self.stiffness_freedom
        return tuple(name for name in RING_FREEDOMS if name in freedoms)

    @property
    def not_modelled(self) -> tuple[str, ...]:
        """Names of the losses that this scene does not model, and of those that its kind of scene never models."""
        return losses_not_modelled(self.power_loss)

    @property
    def converged(self) -> Bool[Array, "*batch"]:
        return self.status == Status.CONVERGED

    def solver_failure(self) -> str:
        """Message of a failed solve in one line: how it ended, and the causes that apply.

        Unless the loads have no equilibrium, it contains the residual and the worst equation, or the nested solve that
        failed; with a thermal network, the hottest node instead of the residual.
        """
        causes = causes_in_words(self.failure_causes)
        if causes and int(self.status) == Status.INVALID_INPUT:
            return f"{Status.INVALID_INPUT.text}: {'; '.join(causes)}"
        # whether loads can be balanced does not depend on the temperatures
        mechanical = self.thermal is None or int(self.status) == Status.NO_EQUILIBRIUM
        ending = self._ending() if mechanical else self._thermal_ending()
        return "; ".join([ending, *causes])

    def _thermal_ending(self) -> str:
        """Message of a failed search for the temperatures."""
        thermal = self.thermal
        assert thermal is not None
        status, speed = Status(int(self.status)), float(np.asarray(self.operation.inner_speed)) * 30.0 / np.pi
        ending = f"{thermal.ending(status)}, inner ring at {speed:.6g} rpm"
        if status == Status.THERMAL_RUNAWAY:
            return ending
        name = self.equation_names[int(self.worst_equation)]
        return f"{ending}; of the last solve of the bearing the worst equation is: {name}"

    def _ending(self) -> str:
        """Message of a failed solve without its causes: the residual and the worst equation or nested solve, or why the
        loads have no equilibrium."""
        local_equations = len(self.equation_names) - self.global_equations
        worst = int(self.worst_equation)
        name = self.equation_names[worst]
        place = f" of element {int(self.worst_element)}" if worst < local_equations else ""
        if float(self.inner_residual) > INNER_TOLERANCE:
            name = "nested solve (inlet temperature rise of a contact, cage land, or orbital speed of a ball)"
            place = f", residual {float(self.inner_residual):.3g}"
        if int(self.status) == Status.NO_EQUILIBRIUM:
            steps = int(self.iterations)
            if not steps:
                return (
                    f"{Status.NO_EQUILIBRIUM.text}: compressive contacts cannot balance these loads; the inner ring "
                    "would separate (proved by the loads alone)"
                )
            return (
                f"{Status.NO_EQUILIBRIUM.text}: nothing balances these loads with small tilts and displacements, the "
                f"inner ring would separate or tilt by more than 0.1 rad (proved after {steps} Newton steps)"
            )
        return (
            f"{Status(int(self.status)).text} after {int(self.iterations)} Newton steps: scaled residual "
            f"{float(self.residual_norm):.3g}, worst equation: {name}{place}"
        )
