"""The table [simulation] of a scene file: what a run in time does beyond the operating point."""

from collections.abc import Mapping
from typing import Annotated, ClassVar

import numpy as np

from ...bearings.motion.settings import Simulation
from ...time_laws import AbstractTimeFactor, Ramp, RotatingLoad, Sinusoidal, Steady, Tabulated
from .. import units
from ..errors import SceneError
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..time_tables import check_lists, read_time_table

_LAWS = ("perturbation", "ramp", "table")


class PerturbationTable(table_of(Sinusoidal)):
    """A factor 1 + amplitude sin(2 pi frequency t); a bearing's speed and load do not reverse."""

    amplitude: units.Fraction


class RampTable(table_of(Ramp)):
    """A factor that goes smoothly from `start` to `stop`; a bearing's speed and load do not reverse."""

    start: units.NonNegativeNumber
    stop: units.NonNegativeNumber = 1.0


class FactorTable(Table):
    """A factor over time, by straight lines: from a CSV file, see `time_tables`, or from lists in the scene.

    - `file`: CSV with a column of time and one of the value or its factor
    - `times`: in place of a file
    - `factors`: at these times, over the value of the operating point
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "file": ("times", "factors"),
        "times": ("file",),
        "factors": ("file",),
    }
    file: str | None = None
    times: Annotated[tuple[float, ...], units.several_note("finite", "s")] | None = None
    factors: units.Numbers | None = None

    @check
    def _one_of_both(self) -> Problems:
        if self.file is not None:
            names = [name for name in ("times", "factors") if getattr(self, name) is not None]
            if names:
                yield refusal_at(names[0], "none beside 'file': a file, or times and factors", "both")
        elif self.times is None and self.factors is None:
            yield refusal_at("file", "a CSV file, or times and factors in the scene", "nothing")
        elif self.times is None or self.factors is None:
            missing, there = ("times", "factors") if self.times is None else ("factors", "times")
            yield refusal_at(missing, f"a list as long as '{there}'", "nothing")

    @check
    def _fits(self) -> Problems:
        if self.times is not None and self.factors is not None:
            yield from check_lists(self.times, self.factors)


class RotatingLoadTable(table_of(RotatingLoad)):
    """A turning load beside the radial one."""


class SimulationTable(table_of(Simulation, leave_out=("entrainment_smoothing",))):
    """See `bearings.motion.settings.Simulation`."""

    speed_perturbation: PerturbationTable | None = None
    speed_ramp: RampTable | None = None
    speed_table: FactorTable | None = None
    load_perturbation: PerturbationTable | None = None
    load_ramp: RampTable | None = None
    load_table: FactorTable | None = None
    rotating_load: RotatingLoadTable | None = None

    @check
    def _consistent(self) -> Problems:
        for name in ("speed", "load"):
            given = [field for field in (f"{name}_{law}" for law in _LAWS) if getattr(self, field) is not None]
            if len(given) > 1:
                yield refusal_at(given[1], f"one of {' and '.join(given)}", "both")
        if self.speed_ramp is not None and self.speed_ramp.start == 0.0:
            yield refusal_at("speed_ramp.start", "a number > 0: at rest the films vanish", "the number 0")
        if self.load_ramp is not None and self.load_ramp.start == 0.0:
            yield refusal_at("load_ramp.start", "a number > 0: a run begins with a loaded bearing", "the number 0")

    @check
    def _tables(self) -> Problems:
        """Refuses values in CSV files that the run cannot use."""
        for name, least in (("speed", "> 0: at rest the films vanish"), ("load", ">= 0, the first one > 0")):
            table = getattr(self, f"{name}_table")
            factors = () if table is None or table.factors is None else table.factors
            first = [one for one in factors[:1] if one == 0.0]
            wrong = first or [one for one in factors if one < 0.0 or (one == 0.0 and name == "speed")]
            if wrong:
                yield refusal_at(f"{name}_table.factors", f"numbers {least}", f"the number {wrong[0]:g}")


def simulation(table: SimulationTable, inner_speed: float, radial_load: float) -> Simulation:
    """The run that a table describes. **Arguments:** speed, rad/s, and load, N, of the operating point.

    **Raises:** `SceneError` for a file that cannot be read or makes no sense.
    """
    turning = table.rotating_load
    return Simulation(
        duration=table.duration,
        speed=_factor(table, "speed", inner_speed),
        load=_factor(table, "load", radial_load),
        rotating_load=None if turning is None else RotatingLoad(**turning.model_dump()),
        solver=table.solver,
        tolerance=table.tolerance,
    )


def _factor(table: SimulationTable, name: str, steady: float) -> AbstractTimeFactor:
    perturbation, ramp, file = (getattr(table, f"{name}_{law}") for law in _LAWS)
    if perturbation is not None:
        return Sinusoidal(**perturbation.model_dump())
    if ramp is not None:
        return Ramp(**ramp.model_dump())
    if file is None:
        return Steady()
    if file.file is None:
        return Tabulated(np.asarray(file.times), np.asarray(file.factors))
    field = f"simulation.{name}_table.file"
    found = read_time_table(file.file, name, field)
    if not found.relative and steady == 0.0:
        raise SceneError(
            file.file, "", f"a column '{name}'", f"a column 'factor': operation.inner_speed is 0, for {field}"
        )
    return Tabulated(found.times, found.values if found.relative else found.values / steady)
