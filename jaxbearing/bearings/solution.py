"""Results of a steady solve, labelled: every quantity carries its unit and description where it is defined.

The command line, JSON, files and pages read this metadata; nothing keeps a second list.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any, Generic, NamedTuple, TypeVar

import equinox as eqx
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._scene import AbstractSolution
from .._scene import derived as derived
from .._scene import label as label
from ..numerics.status import Status
from .growth import FitResult

INNER_TOLERANCE = 1e-8
"""Residual of a nested solve above which it is named as the reason of a failure."""

RING_FREEDOMS = ("axial", "radial", "lateral", "tilt", "tilt_lateral")
"""Degrees of freedom of the inner ring, in the order of `ring` and `stiffness`."""
TILTS = ("tilt", "tilt_lateral")
"""The angles among `RING_FREEDOMS`."""

_CONJUGATE = {"m": "N", "rad": "N m"}
"""Unit of a displacement of the ring -> that of its load."""


class RingDisplacement(eqx.Module):
    """Displacement of the inner ring; a degree of freedom that the family does not activate is held at 0.

    `axial` is 0 in the middle of the play for ball bearings given by their clearance, where the planes of the grooves
    coincide, and for cylindrical roller bearings with flanges; it is 0 at first contact of elements and races for ball
    bearings given by their contact angle and for tapered bearings.
    """

    axial: Float[Array, ""] = eqx.field(
        metadata=label("m", "axial displacement (zero: middle of the play, or first contact if given by contact angle)")
    )
    radial: Float[Array, ""] = eqx.field(metadata=label("m", "displacement along the load line"))
    lateral: Float[Array, ""] = eqx.field(metadata=label("m", "displacement across the load line"))
    tilt: Float[Array, ""] = eqx.field(metadata=label("rad", "tilt that moves azimuth 0 axially"))
    tilt_lateral: Float[Array, ""] = eqx.field(metadata=label("rad", "tilt about the load line"))


def force_units() -> tuple[str, ...]:
    """Units of the entries of `Solution.force`."""
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


def losses_not_modelled(loss: Any) -> tuple[str, ...]:
    """Names of the losses that are `None`, and of those that no scene of this kind models.

    **Arguments:** `loss`: a `PowerLoss`, `BallPowerLoss` or `TaperedPowerLoss`.
    """
    absent = [field.name for field in dataclasses.fields(loss) if getattr(loss, field.name) is None]
    return (*(name for name in absent if name != "total"), *getattr(loss, "never", ()))


class RacewayPower(eqx.Module):
    """Parts of the losses on the raceways of balls, W: spin about the contact normal, sliding along and across the
    rolling direction, sliding that comes of the curvature of the contact (`None`: taken as flat)."""

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


class LaminaLoads(eqx.Module):
    """Loads of the laminae into which rollers are cut along their length, from the end s = 0.

    **Arguments:**
    - `inner`, `outer`: on the raceways, N.
    - `profiled`: whether the rollers have a profile, which spreads the load near the ends.
    """

    inner: Float[Array, "element lamina"]
    outer: Float[Array, "element lamina"]
    profiled: bool = eqx.field(static=True, default=False)


class Reason(NamedTuple):
    """A possible cause of a failure: a flag that says that it applies, and the numbers of its text."""

    applies: Bool[Array, ""]
    numbers: Float[Array, "..."]


Point = TypeVar("Point")
"""Class of the operating point of a family."""
Elements = TypeVar("Elements")
"""Class of the results of its rolling elements."""
Losses = TypeVar("Losses")
"""Class of its losses."""


class Solution(AbstractSolution, Generic[Point, Elements, Losses]):
    """Result of a steady solve. Where `status` is not converged every result is NaN, never the last iterate.

    `operation`, `elements` and `power_loss` are those of the kind of bearing, which `BallSolution`, `RollerSolution`
    and `TaperedSolution` name. Where the scene models no loss there is no drive power and no torque.

    **Arguments:** the labels of the fields say what they are, and
    - `global_equations`: number of equations that belong to no single rolling element.
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
            "about tilt and tilt_lateral, in N and N m; freedoms that are not modelled are 0",
        )
    )
    stiffness: Float[Array, "freedom freedom_displaced"] = eqx.field(
        metadata=label(
            "mixed",
            "d load / d displacement of the inner ring: rows and columns axial, radial, lateral, tilt, tilt_lateral, "
            "in N/m, N/rad, N m/m and N m/rad; freedoms that are not modelled are 0",
        )
    )
    checks: Mapping[str, Bool[Array, ""]]
    ring_freedom: tuple[str, ...] = eqx.field(static=True)
    equation_names: tuple[str, ...] = eqx.field(static=True)
    global_equations: int = eqx.field(static=True)
    unknowns: int = eqx.field(static=True, metadata=label("1", "unknowns of the equations"))
    notes: tuple[str, ...] = eqx.field(static=True, default=())
    stiffness_freedom: tuple[str, ...] | None = eqx.field(static=True, default=None)
    """Rows and columns of `stiffness` that are modelled; `None`: those of `ring_freedom`. The others are 0."""
    element_name: str = eqx.field(static=True, default="roller")
    raceway_power: RacewayPower | None = None
    laminae: LaminaLoads | None = None
    held_freedom: tuple[str, ...] = eqx.field(static=True, default=())
    """Freedoms of the ring that are held where they are, and not free under a given load."""
    fit: FitResult | None = None
    reasons: dict[str, Reason] = eqx.field(default_factory=dict)
    """Possible causes of a failed solve: a sentence with places for numbers, such as `{:.3g}` -> the numbers."""
    life: Any = None
    """`life.result.Life`, where the scene has a rating."""

    @property
    def freedoms_of_stiffness(self) -> tuple[str, ...]:
        """Names of the rows and columns of `stiffness` that the model has, in the order of `RING_FREEDOMS`; entries of
        the others are 0 and say nothing about the bearing."""
        found = self.ring_freedom if self.stiffness_freedom is None else self.stiffness_freedom
        return tuple(name for name in RING_FREEDOMS if name in found)

    @property
    def not_modelled(self) -> tuple[str, ...]:
        """Losses that the scene does not model, by their names in `power_loss`."""
        return losses_not_modelled(self.power_loss)

    @property
    def converged(self) -> Bool[Array, "*batch"]:
        return self.status == Status.CONVERGED

    def solver_failure(self) -> str:
        """One sentence on a solve that failed: status, residual, worst equation, and what may have caused it."""
        found = [
            text.format(*np.atleast_1d(np.asarray(reason.numbers)).tolist())
            for text, reason in self.reasons.items()
            if bool(reason.applies)
        ]
        if found and int(self.status) == Status.INVALID_INPUT:
            return f"{Status.INVALID_INPUT.text}: {'; '.join(found)}"
        return "; ".join([self._ending(), *found])

    def _ending(self) -> str:
        """One sentence: status, residual, worst equation."""
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
                    f"{Status.NO_EQUILIBRIUM.text}: contacts that only push cannot balance these loads, the inner ring "
                    "comes out (proved by the loads alone)"
                )
            return (
                f"{Status.NO_EQUILIBRIUM.text}: nothing balances these loads with small tilts and displacements, the "
                f"inner ring comes out or tilts by more than 0.1 rad (proved after {steps} Newton steps)"
            )
        return (
            f"{Status(int(self.status)).text} after {int(self.iterations)} Newton steps: scaled residual "
            f"{float(self.residual_norm):.3g}, worst equation: {name}{place}"
        )
