"""The scene file of a line contact. Names are the attribute names of the classes that it builds, except for how
accuracy chooses the mesh (see `line_contact_build`)."""

import itertools
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator

from ..ehl.simulation import DEFAULT_TOLERANCE
from . import units
from .materials import MaterialField
from .oil_schema import OilTable
from .simulation_schema import PerturbationTable
from .table import Problems, Table, check, refusal_at

ACCURACIES: dict[float, int] = {1e-2: 201, 2e-3: 501, 1e-3: 801, 3e-4: 1601}
"""Relative error of the steady films -> fewest nodes of the mesh, enough at moderate loads; heavy ones take more (see
`ehl.resolution`)."""
DEFAULT_ACCURACY = 2e-3


def _accuracy(value: Any) -> float:
    given = units.number(value, "> 0")
    if given not in ACCURACIES:
        words = ", ".join(f"{accuracy:g}" for accuracy in ACCURACIES)
        raise units.refusal(f"one of {words}", units.describe(value))
    return given


class ContactGeometryTable(Table):
    reduced_radius_rolling: units.PositiveLength


class ContactBodiesTable(Table):
    body_1: MaterialField
    body_2: MaterialField


class FilmModelTable(Table):
    """Numerical settings of the contact.

    - `accuracy`: relative error of the steady films for which mesh and inlet are chosen, by the load of the scene
    - `compressible`: density by Dowson and Higginson; false: constant
    - `nodes`: of the mesh
    - `inlet`: length of the inlet, in half widths of the Hertz contact
    - `film_limit`: film below which a run ends
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"accuracy": ("nodes",), "nodes": ("accuracy",)}
    compressible: units.Switch = True
    accuracy: Annotated[float, BeforeValidator(_accuracy)] | None = None
    nodes: units.Count | None = None
    inlet: units.PositiveNumber | None = None
    film_limit: units.NonNegativeLength = 0.5e-9

    @check
    def _one_of_both(self) -> Problems:
        if self.accuracy is not None and self.nodes is not None:
            yield refusal_at("nodes", "none beside 'accuracy': one of the two", f"the number {self.nodes}")


class ContactOperationTable(Table):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "pressure": ("load_per_length",),
        "load_per_length": ("pressure",),
    }
    entrainment_speed: units.SurfaceSpeed
    oil_temperature: units.Temperature
    load_per_length: units.PositiveLineLoad | None = None
    pressure: units.PositivePressure | None = None

    @check
    def _one_of_both(self) -> Problems:
        if (self.load_per_length is None) == (self.pressure is None):
            names = "'load_per_length' and 'pressure'"
            found = f"neither of {names}" if self.pressure is None else f"both {names}"
            expected = "one of the two: a load per length or a Hertz (peak) pressure"
            yield refusal_at("load_per_length", expected, found)


class SpeedRampTable(Table):
    """A factor from `start` to `stop`; straight, or smooth (a quintic); at once for a duration of 0."""

    start: units.Number = 1.0
    stop: units.Number = 0.0
    duration: units.NonNegativeTime
    begin: units.NonNegativeTime = 0.0
    shape: Literal["linear", "smooth"] = "linear"

    @check
    def _moves_at_first(self) -> Problems:
        if self.start == 0.0:
            yield refusal_at("start", "a number other than 0: at rest there is no film to begin with", "the number 0")
        if self.shape == "smooth" and self.duration == 0.0:
            yield refusal_at("duration", "a time > 0, or shape = 'linear'", "0 s")


class SpeedTable(Table):
    """Straight lines between times, as factors."""

    times: units.Times
    factors: units.Numbers

    @check
    def _fits(self) -> Problems:
        times = self.times
        if len(times) < 2 or len(times) != len(self.factors):
            expected = "as many factors as times, two or more"
            yield refusal_at("factors", expected, f"{len(self.factors)} factors and {len(times)} times")
        if any(b <= a for a, b in itertools.pairwise(times)):
            yield refusal_at("times", "times that increase", "some that do not")
        if self.factors[0] == 0.0:
            yield refusal_at("factors", "a first number other than 0: at rest there is no film to begin with", "0")


class FilmPerturbationTable(PerturbationTable):
    """A factor 1 + amplitude sin(2 pi frequency t); beyond an amplitude of 1 the motion reverses."""

    amplitude: units.NonNegativeNumber  # pyright: ignore[reportIncompatibleVariableOverride]


class FilmSimulationTable(Table):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "speed_ramp": ("speed_perturbation", "speed_table"),
        "speed_perturbation": ("speed_ramp", "speed_table"),
        "speed_table": ("speed_ramp", "speed_perturbation"),
    }
    duration: units.PositiveTime | None = None
    tolerance: units.PositiveNumber = DEFAULT_TOLERANCE
    speed_ramp: SpeedRampTable | None = None
    speed_perturbation: FilmPerturbationTable | None = None
    speed_table: SpeedTable | None = None

    @check
    def _one_law(self) -> Problems:
        given = [name for name in self.instead if getattr(self, name) is not None]
        if len(given) > 1:
            yield refusal_at(given[1], f"none beside {given[0]}: one of them", "both")


class LineContactTable(Table):
    """The whole file."""

    kind: Literal["line_contact"]
    geometry: ContactGeometryTable
    materials: ContactBodiesTable
    oil: OilTable
    contact: FilmModelTable = FilmModelTable()
    operation: ContactOperationTable
    simulation: FilmSimulationTable | None = None
