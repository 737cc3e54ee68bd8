"""The scene file of a line contact. Names are the attribute names of the classes that it builds, except for
`accuracy`, which chooses the mesh (see `line_contact.build`)."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from ...ehl import ContactGeometry, ContactOperation, FilmModel, FilmSimulation
from ...time_laws import LinearRamp, Sinusoidal
from .. import units
from ..kinds import KIND
from ..materials import MaterialField
from ..oil.schema import OilTable
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..time_tables import check_lists

ACCURACIES: dict[float, int] = {1e-2: 201, 2e-3: 501, 1e-3: 801, 3e-4: 1601}
"""Relative error of the steady films -> minimum number of nodes, which is enough at moderate loads; heavy loads need
more (see `ehl.resolution`)."""
DEFAULT_ACCURACY = 2e-3
Accuracy = Annotated[float, units.among_note(ACCURACIES)]


class ContactGeometryTable(table_of(ContactGeometry)):
    """See `ehl.line_contact.ContactGeometry`."""


class ContactBodiesTable(Table):
    body_1: MaterialField
    body_2: MaterialField


class FilmModelTable(table_of(FilmModel, optional=("nodes", "inlet"))):
    """Numerical settings of the contact.

    - `accuracy`: relative error of the steady films, for which nodes and inlet are chosen by the load of the scene if
      they are not given; a warning reports larger errors
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"accuracy": ("nodes",), "nodes": ("accuracy",)}
    accuracy: Accuracy | None = None


class ContactOperationTable(table_of(ContactOperation)):
    """See `ehl.line_contact.ContactOperation`."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "pressure": ("load_per_length",),
        "load_per_length": ("pressure",),
    }


class SpeedRampTable(table_of(LinearRamp)):
    """A factor that goes from `start` to `stop`, linearly or smoothly (quintic); a duration of 0 is a step."""

    start: units.Number = 1.0
    stop: units.Number = 0.0
    shape: Literal["linear", "smooth"] = "linear"

    @check
    def _moves_at_first(self) -> Problems:
        if self.start == 0.0:
            yield refusal_at("start", "a number other than 0: at rest there is no film to begin with", "the number 0")
        if self.shape == "smooth" and self.duration == 0.0:
            yield refusal_at("duration", "a time > 0, or shape = 'linear'", "0 s")


class SpeedTable(Table):
    """Factors at given times, linear between them."""

    times: units.Times
    factors: units.Numbers

    @check
    def _fits(self) -> Problems:
        yield from check_lists(self.times, self.factors)
        if self.factors[0] == 0.0:
            yield refusal_at("factors", "a first number other than 0: at rest there is no film to begin with", "0")


class FilmPerturbationTable(table_of(Sinusoidal)):
    """A factor 1 + amplitude sin(2 pi frequency t); with an amplitude above 1 the motion reverses."""


class FilmSimulationTable(table_of(FilmSimulation)):
    """See `ehl.simulation.FilmSimulation`."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "speed_ramp": ("speed_perturbation", "speed_table"),
        "speed_perturbation": ("speed_ramp", "speed_table"),
        "speed_table": ("speed_ramp", "speed_perturbation"),
    }
    speed_ramp: SpeedRampTable | None = None
    speed_perturbation: FilmPerturbationTable | None = None
    speed_table: SpeedTable | None = None

    @check
    def _one_law(self) -> Problems:
        fields = [name for name in self.instead if getattr(self, name) is not None]
        if len(fields) > 1:
            yield refusal_at(fields[1], f"none beside {fields[0]}: one of them", "both")


class LineContactTable(Table):
    """The whole file."""

    kind: Annotated[Literal["line_contact"], KIND]
    geometry: ContactGeometryTable
    materials: ContactBodiesTable
    oil: OilTable
    contact: FilmModelTable = Field(default_factory=FilmModelTable)
    operation: ContactOperationTable
    simulation: FilmSimulationTable | None = None
