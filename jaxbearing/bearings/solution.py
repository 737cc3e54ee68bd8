"""Results of a steady solve, labelled: every quantity carries its unit and description where it is defined.

The command line, JSON, files and pages read this metadata; nothing keeps a second list.
"""

from typing import Any

import equinox as eqx
import jax
from jaxtyping import Array, Bool, Float, Int

from ..numerics.status import SolveError, Status
from .parts import Operation


def quantity(unit: str, description: str, **kwargs: Any) -> Any:
    """Field that holds a result, with its SI unit and what it is."""
    return eqx.field(metadata={"unit": unit, "description": description}, **kwargs)


RING_FREEDOMS = ("axial", "radial", "lateral", "tilt", "tilt_lateral")
"""Degrees of freedom of the inner ring, in the order of `ring` and `stiffness`."""


class RingDisplacement(eqx.Module):
    """Displacement of the inner ring; a degree of freedom that the family does not activate is held at 0."""

    axial: Float[Array, ""] = quantity("m", "axial displacement")
    radial: Float[Array, ""] = quantity("m", "displacement along the load line")
    lateral: Float[Array, ""] = quantity("m", "displacement across the load line")
    tilt: Float[Array, ""] = quantity("rad", "tilt that moves azimuth 0 axially")
    tilt_lateral: Float[Array, ""] = quantity("rad", "tilt about the load line")


class CageState(eqx.Module):
    """Where the cage is and how fast it turns."""

    speed: Float[Array, ""] = quantity("rad/s", "cage speed")
    slip: Float[Array, ""] = quantity("1", "1 - cage speed / speed of rolling without slip")
    eccentricity_ratio: Float[Array, ""] = quantity("1", "cage offset over radial guiding clearance")
    attitude_angle: Float[Array, ""] = quantity("rad", "angle between land load and line of centres")


class RollerResults(eqx.Module):
    """Arrays over the rolling elements; what a scene does not model is `None`. Speeds are positive in normal running."""

    azimuth: Float[Array, " element"] = quantity("rad", "azimuth from the load line")
    load_inner: Float[Array, " element"] = quantity("N", "normal load on the inner raceway")
    load_outer: Float[Array, " element"] = quantity("N", "normal load on the outer raceway")
    pressure_inner: Float[Array, " element"] = quantity("Pa", "Hertz (peak) pressure on the inner raceway")
    pressure_outer: Float[Array, " element"] = quantity("Pa", "Hertz (peak) pressure on the outer raceway")
    orbital_speed: Float[Array, " element"] = quantity("rad/s", "speed of the roller centre about the bearing axis")
    spin_speed: Float[Array, " element"] = quantity("rad/s", "spin about the roller's own axis, relative to its orbit")
    film_inner: Float[Array, " element"] | None = quantity("m", "central film on the inner raceway", default=None)
    film_outer: Float[Array, " element"] | None = quantity("m", "central film on the outer raceway", default=None)
    temperature_rise_inner: Float[Array, " element"] | None = quantity("K", "inlet heating, inner", default=None)
    temperature_rise_outer: Float[Array, " element"] | None = quantity("K", "inlet heating, outer", default=None)
    sliding_inner: Float[Array, " element"] | None = quantity("m/s", "sliding speed on the inner race", default=None)
    sliding_outer: Float[Array, " element"] | None = quantity("m/s", "sliding speed on the outer race", default=None)
    traction_inner: Float[Array, " element"] | None = quantity("N", "forward force by the inner race", default=None)
    traction_outer: Float[Array, " element"] | None = quantity("N", "backward force by the outer race", default=None)
    pocket_film_front: Float[Array, " element"] | None = quantity("m", "film in front of the roller", default=None)
    pocket_film_rear: Float[Array, " element"] | None = quantity("m", "film behind the roller", default=None)
    pocket_load_front: Float[Array, " element"] | None = quantity("N", "pocket load in front", default=None)
    pocket_load_rear: Float[Array, " element"] | None = quantity("N", "pocket load behind", default=None)


class PowerLoss(eqx.Module):
    """Dissipated power by location, W; what a scene does not model is `None`. The entries add up to `total`."""

    total: Float[Array, ""] = quantity("W", "total")
    inner_raceway: Float[Array, ""] | None = quantity("W", "sliding on the inner raceway", default=None)
    outer_raceway: Float[Array, ""] | None = quantity("W", "sliding on the outer raceway", default=None)
    rolling_resistance: Float[Array, ""] | None = quantity("W", "rolling resistance of the raceways", default=None)
    pocket: Float[Array, ""] | None = quantity("W", "rollers sliding in the cage pockets", default=None)
    element_ends: Float[Array, ""] | None = quantity("W", "roller ends against the cage rails", default=None)
    flange: Float[Array, ""] | None = quantity("W", "roller ends against the ring flanges", default=None)
    cage_pilot: Float[Array, ""] | None = quantity("W", "cage lands on the guiding ring", default=None)
    drag: Float[Array, ""] | None = quantity("W", "oil drag on the orbiting rollers", default=None)


class Solution(eqx.Module):
    """Result of a steady solve. Where `status` is not converged every result is NaN, never the last iterate."""

    status: Int[Array, ""]
    iterations: Int[Array, ""] = quantity("1", "Newton steps")
    residual_norm: Float[Array, ""] = quantity("1", "largest scaled residual")
    worst_equation: Int[Array, ""]
    worst_element: Int[Array, ""]
    operation: Operation
    ring: RingDisplacement
    cage: CageState | None
    elements: RollerResults
    power_loss: PowerLoss
    drive_power: Float[Array, ""] = quantity("W", "sum over both rings of torque times speed")
    inner_torque: Float[Array, ""] = quantity("N m", "torque that drives the inner ring")
    outer_torque: Float[Array, ""] = quantity("N m", "torque that drives the outer ring")
    stiffness: Float[Array, "freedom freedom"] = quantity("N/m", "d load / d displacement of the active freedoms")
    checks: dict[str, Bool[Array, ""]]
    ring_freedom: tuple[str, ...] = eqx.field(static=True)
    equation_names: tuple[str, ...] = eqx.field(static=True)
    global_equations: int = eqx.field(static=True)
    unknowns: int = eqx.field(static=True)
    notes: tuple[str, ...] = eqx.field(static=True, default=())

    @property
    def converged(self) -> Bool[Array, ""]:
        return self.status == Status.CONVERGED

    @property
    def warnings(self) -> list[str]:
        """What left the range of a law, and what the model assumed or left out, in words (one solution only)."""
        return [text for text, broken in self.checks.items() if bool(broken)] + list(self.notes)

    def failure(self) -> str:
        """One sentence on a solve that failed: status, residual, worst equation."""
        local_equations = len(self.equation_names) - self.global_equations
        worst = int(self.worst_equation)
        name = self.equation_names[worst]
        place = f" of element {int(self.worst_element)}" if worst < local_equations else ""
        return (
            f"{Status(int(self.status)).text} after {int(self.iterations)} Newton steps: scaled residual "
            f"{float(self.residual_norm):.3g}, worst equation: {name}{place}"
        )

    def raise_if_failed(self) -> None:
        """**Raises:** `SolveError` for a single failed solve; does nothing while JAX traces (each lane has its status)."""
        try:
            failed = not bool(self.converged)
        except jax.errors.ConcretizationTypeError:
            return
        if failed:
            raise SolveError(self.failure())
