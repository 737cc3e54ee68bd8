"""The table [simulation] of a scene file: settings of a transient run.

With [thermal] the run computes temperatures, without it the motion of the rolling elements.
"""

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

import numpy as np

from ...bearings.motion.settings import Simulation
from ...bearings.warming.settings import SOLVERS as WARM_UP_SOLVERS
from ...bearings.warming.settings import WarmUpSimulation
from ...time_laws import AbstractTimeFactor, LinearRamp, Ramp, RotatingLoad, Sinusoidal, Steady, Tabulated
from .. import units
from ..errors import SceneError, one_of
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..time_tables import check_lists, read_time_table

_LAWS = ("perturbation", "ramp", "table")
_ALWAYS = ("speed", "load")
_OF_OIL = ("oil_inlet", "oil_flow")
_NUMBERS_OF_BALLS = ("ring_mass", "ring_damping", "contact_damping")
_OF_BALLS = (*_NUMBERS_OF_BALLS, "meridian")


class PerturbationTable(table_of(Sinusoidal)):
    """A factor 1 + amplitude sin(2 pi frequency t); a bearing's speed and load must not reverse."""

    amplitude: units.Fraction


class InletRampTable(table_of(LinearRamp)):
    """A factor that goes from `start` to `stop`, smoothly or linearly. The factor of the oil inlet may be negative.

    - `shape`: 'linear' needs [thermal]: in a run of the rolling elements a kink in the speed would act as a shock
    """

    stop: units.Number = 1.0
    shape: Literal["smooth", "linear"] = "smooth"

    @check
    def _lasts(self) -> Problems:
        if self.shape == "smooth" and self.duration == 0.0:
            yield refusal_at("duration", "a time > 0, or shape = 'linear' in a run of temperatures", "0 s")


class RampTable(InletRampTable):
    """A factor that goes from `start` to `stop`, smoothly or linearly; a bearing's speed and load must not reverse."""

    start: units.NonNegativeNumber
    stop: units.NonNegativeNumber = 1.0


class FactorTable(Table):
    """A factor over time, linear between points, from a CSV file (see `time_tables`) or from lists in the scene.

    - `file`: CSV file with a column of times and a column of values or factors
    - `times`: times of the factors, s, in place of a file
    - `factors`: ratios to the value of the operating point at these times
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
    """A rotating load in addition to the radial load."""


class CoursesTable(Table):
    """Speed and load over time, and in a run of temperatures also inlet temperature and flow of the oil.

    - `oil_inlet_perturbation`: factor of the temperature difference between oil inlet and ambient
    - `oil_inlet_ramp`: factor of the temperature difference between oil inlet and ambient
    - `oil_inlet_table`: factor of the temperature difference between oil inlet and ambient
    """

    speed_perturbation: PerturbationTable | None = None
    speed_ramp: RampTable | None = None
    speed_table: FactorTable | None = None
    load_perturbation: PerturbationTable | None = None
    load_ramp: RampTable | None = None
    load_table: FactorTable | None = None
    oil_inlet_perturbation: PerturbationTable | None = None
    oil_inlet_ramp: InletRampTable | None = None
    oil_inlet_table: FactorTable | None = None
    oil_flow_perturbation: PerturbationTable | None = None
    oil_flow_ramp: RampTable | None = None
    oil_flow_table: FactorTable | None = None

    def given(self, name: str) -> list[str]:
        """Names of the given fields that describe a quantity over time."""
        return [field for field in (f"{name}_{law}" for law in _LAWS) if getattr(self, field) is not None]

    @check
    def _consistent(self) -> Problems:
        for name in (*_ALWAYS, *_OF_OIL):
            fields = self.given(name)
            if len(fields) > 1:
                yield refusal_at(fields[1], f"one of {' and '.join(fields)}", "both")
        if self.speed_ramp is not None and self.speed_ramp.start == 0.0:
            yield refusal_at("speed_ramp.start", "a number > 0: at rest the films vanish", "the number 0")
        if self.load_ramp is not None and self.load_ramp.start == 0.0:
            yield refusal_at("load_ramp.start", "a number > 0: a run begins with a loaded bearing", "the number 0")

    @check
    def _tables(self) -> Problems:
        """Refuses factors in lists that a run cannot use."""
        rules = {
            "speed": ("> 0: at rest the films vanish", True, True),
            "load": (">= 0, the first one > 0", True, False),
            "oil_flow": (">= 0", False, False),
        }
        for name, (words, first_above, all_above) in rules.items():
            table = getattr(self, f"{name}_table")
            factors = () if table is None or table.factors is None else table.factors
            first = [factor for factor in factors[:1] if factor == 0.0 and first_above]
            wrong = first or [factor for factor in factors if factor < 0.0 or (factor == 0.0 and all_above)]
            if wrong:
                yield refusal_at(f"{name}_table.factors", f"numbers {words}", f"the number {wrong[0]:g}")


class WarmUpTable(table_of(WarmUpSimulation, base=CoursesTable)):
    """See `bearings.warming.settings.WarmUpSimulation`; a steady solve ignores it."""


class SimulationTable(
    table_of(
        *(Simulation, WarmUpSimulation),
        leave_out=("entrainment_smoothing", *_OF_BALLS),
        optional=("solver", "instants"),
        base=CoursesTable,
    )
):
    """See `bearings.motion.settings.Simulation`, and with [thermal] `bearings.warming.settings.WarmUpSimulation`.

    The class provides the default solver. `start`, `instants` and the fields of the oil need [thermal];
    `rotating_load` is not allowed with it.
    """

    rotating_load: RotatingLoadTable | None = None

    def of_other_run(self, warm: bool) -> Problems:
        """Refuses fields of the other kind of run. **Arguments:** `warm`: True if the file has [thermal]."""
        if warm:
            if self.solver is not None and self.solver not in WARM_UP_SOLVERS:
                expected = f"{one_of(WARM_UP_SOLVERS)} beside [thermal], whose run is stiff"
                yield refusal_at("simulation.solver", expected, f"'{self.solver}'")
            if self.rotating_load is not None:
                expected = "none beside [thermal]: its run knows no load that turns with the shaft"
                yield refusal_at("simulation.rotating_load", expected, "a table")
            return
        names = [field for name in _OF_OIL for field in self.given(name)]
        names += [name for name in ("start", "instants") if getattr(self, name) is not None]
        for name in names:
            expected = "none without [thermal]: it belongs to a run of temperatures"
            yield refusal_at(f"simulation.{name}", expected, "one")
        for name in _ALWAYS:
            ramp = getattr(self, f"{name}_ramp")
            if ramp is not None and ramp.shape == "linear":
                expected = "'smooth' without [thermal]: in a run of the rollers a kink is a shock of its own"
                yield refusal_at(f"simulation.{name}_ramp.shape", expected, "'linear'")


_SHARED = tuple(field.name for field in dataclasses.fields(Simulation) if field.name not in _OF_BALLS)


class BallSimulationTable(table_of(Simulation, leave_out=_SHARED, base=SimulationTable)):
    """See `bearings.motion.settings.Simulation`, and with [thermal] `bearings.warming.settings.WarmUpSimulation`."""

    def of_other_run(self, warm: bool) -> Problems:
        # called on the class: `self` may be a `Draft`, which has the fields of this class but is not an instance of it
        yield from SimulationTable.of_other_run(self, warm)
        for name in _NUMBERS_OF_BALLS if warm else ():
            if getattr(self, name) is not None:
                expected = "none beside [thermal]: it belongs to a run of the balls"
                yield refusal_at(f"simulation.{name}", expected, "one")


def simulation(table: SimulationTable, inner_speed: float, load: float) -> Simulation:
    """The run of the rolling elements that a table describes. **Arguments:** `inner_speed`, rad/s, and
    `load`, N, of the operating point; a load of 0 means that a file can only give factors.

    **Raises:** `SceneError` for a file that cannot be read or makes no sense.
    """
    turning, steady = table.rotating_load, {"speed": inner_speed, "load": load}
    own: dict[str, Any] = {} if table.solver is None else {"solver": table.solver}
    if isinstance(table, BallSimulationTable):
        own |= {name: getattr(table, name) for name in _OF_BALLS}
    return Simulation(
        duration=table.duration,
        **{name: _factor(table, name, (0.0, value)) for name, value in steady.items()},
        rotating_load=None if turning is None else RotatingLoad(**turning.model_dump()),
        tolerance=table.tolerance,
        **own,
    )


def warm_up(table: Any) -> WarmUpSimulation | None:
    """The run of temperatures that the file of a bearing describes; `None` without [simulation].

    **Arguments:** `table`: table of the whole file.

    **Raises:** as `simulation`.
    """
    if table.simulation is None:
        return None
    run = table.simulation
    laws = {name: _factor(run, name, _steady(table, name)) for name in (*_ALWAYS, *_OF_OIL)}
    own = {name: getattr(run, name) for name in ("duration", "start", "instants", "solver", "tolerance")}
    return WarmUpSimulation(**laws, **{name: value for name, value in own.items() if value is not None})


def _steady(table: Any, name: str) -> tuple[float, float]:
    """Values, SI, that correspond to the factors 0 and 1; equal values mean that a file can only give factors."""
    operation, thermal = table.operation, table.thermal
    match name:
        case "speed":
            return 0.0, operation.inner_speed
        case "load":
            loads = [getattr(operation, field, None) for field in ("radial_load", "axial_load")]
            nonzero = [load for load in loads if load]
            return 0.0, nonzero[0] if len(nonzero) == 1 else 0.0
        case "oil_flow":
            return 0.0, operation.oil_flow or 0.0
    if thermal is None:
        return 0.0, 0.0
    inlet = operation.oil_temperature if thermal.oil_inlet is None else thermal.oil_inlet
    return thermal.ambient, thermal.ambient if inlet is None else inlet


def _factor(table: CoursesTable, name: str, steady: tuple[float, float]) -> AbstractTimeFactor:
    perturbation, ramp, file = (getattr(table, f"{name}_{law}") for law in _LAWS)
    if perturbation is not None:
        return Sinusoidal(**perturbation.model_dump())
    if ramp is not None:
        numbers = ramp.model_dump(exclude={"shape"})
        return Ramp(**numbers) if ramp.shape == "smooth" else LinearRamp(**numbers)
    if file is None:
        return Steady()
    if file.file is None:
        return Tabulated(np.asarray(file.times), np.asarray(file.factors))
    field = f"simulation.{name}_table.file"
    course, (nothing, whole) = read_time_table(file.file, name, field), steady
    if not course.relative and whole == nothing:
        raise SceneError(file.file, "", f"a column '{name}'", f"a column 'factor': {_NO_UNIT[name]}, for {field}")
    return Tabulated(course.times, course.values if course.relative else (course.values - nothing) / (whole - nothing))


_NO_UNIT = {
    "speed": "operation.inner_speed is 0",
    "load": "the operating point has several loads or none, and all follow it",
    "oil_inlet": "thermal.oil_inlet is the temperature of the ambient, or is not given",
    "oil_flow": "operation.oil_flow is 0",
}
"""Reasons why a file can only give factors and not values."""
