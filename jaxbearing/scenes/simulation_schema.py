"""The table [simulation] of a scene file: what a run in time does beyond the operating point."""

from typing import Literal, Self

from pydantic import model_validator

from ..bearings.simulation import DEFAULT_SOLVER, DEFAULT_TOLERANCE, Simulation
from ..bearings.time_laws import AbstractTimeFactor, Ramp, RotatingLoad, Sinusoidal, Steady
from . import units
from .table import Table, refusal_at


class PerturbationTable(Table):
    """A factor 1 + amplitude sin(2 pi frequency t)."""

    frequency: units.PositiveFrequency
    amplitude: units.Fraction


class RampTable(Table):
    """A factor that goes smoothly from `start` to `stop`."""

    start: units.NonNegativeNumber
    stop: units.NonNegativeNumber = 1.0
    duration: units.PositiveTime
    begin: units.NonNegativeTime = 0.0


class RotatingLoadTable(Table):
    """A turning load beside the radial one."""

    load: units.NonNegativeForce
    speed: units.Speed
    phase: units.Angle = 0.0


class SimulationTable(Table):
    duration: units.PositiveTime | None = None
    solver: Literal["tsit5", "dopri8", "kvaerno3", "kvaerno4", "kvaerno5", "implicit_euler"] = DEFAULT_SOLVER
    tolerance: units.PositiveNumber = DEFAULT_TOLERANCE
    speed_perturbation: PerturbationTable | None = None
    speed_ramp: RampTable | None = None
    load_perturbation: PerturbationTable | None = None
    load_ramp: RampTable | None = None
    rotating_load: RotatingLoadTable | None = None

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        for name in ("speed", "load"):
            if getattr(self, f"{name}_perturbation") is not None and getattr(self, f"{name}_ramp") is not None:
                raise refusal_at(f"{name}_ramp", f"either {name}_ramp or {name}_perturbation", "both")
        if self.speed_ramp is not None and self.speed_ramp.start == 0.0:
            raise refusal_at("speed_ramp.start", "a number > 0: at rest the films vanish", "the number 0")
        return self


def simulation(table: SimulationTable) -> Simulation:
    """The run that a table describes."""
    turning = table.rotating_load
    return Simulation(
        duration=table.duration,
        speed=_factor(table.speed_perturbation, table.speed_ramp),
        load=_factor(table.load_perturbation, table.load_ramp),
        rotating_load=None if turning is None else RotatingLoad(**turning.model_dump()),
        solver=table.solver,
        tolerance=table.tolerance,
    )


def _factor(perturbation: PerturbationTable | None, ramp: RampTable | None) -> AbstractTimeFactor:
    if perturbation is not None:
        return Sinusoidal(**perturbation.model_dump())
    return Steady() if ramp is None else Ramp(**ramp.model_dump())
