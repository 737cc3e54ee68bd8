"""The scene file of a cylindrical roller bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from ...bearings.cylindrical.geometry import RollerCage, RollerFlange, RollerGeometry
from ...bearings.operation import Operation
from ...bearings.parts import ContactLaws, Drag
from ..bearing.profile import ProfileTable
from ..bearing.schema import (
    CageBase,
    CatalogueTable,
    FitsTable,
    InnerRingTable,
    InnerRoundnessTable,
    OuterRingTable,
    OuterRoundnessTable,
    RatingTable,
    SupplyTable,
    TemperaturesTable,
    ThermalTable,
    heating_problems,
    law_in_words,
    operation_table,
    require_oil,
    require_oil_flow,
)
from ..bearing.simulation import SimulationTable
from ..kinds import KIND
from ..laws import LINE_THERMAL, ROLLER_FILMS, ROLLING, TRACTIONS, TractionAccuracy
from ..materials import MaterialField, RingMaterialsTable
from ..mixed import MixedTable, mixed_needs_traction
from ..oil.schema import OilTable
from ..presets import Preset
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of


class GeometryTable(table_of(RollerGeometry)):
    """See `bearings.cylindrical.geometry.RollerGeometry`."""

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"flange_stiffness": ("flange_gap", "thrust")}


class MaterialsTable(RingMaterialsTable):
    rollers: MaterialField
    cage: MaterialField | None = None


class ContactTable(table_of(ContactLaws, leave_out=("entrainment_smoothing",))):
    """Laws of the raceway contacts by name; `scenes.laws` lists the names.

    - `traction_model`: the law at the mean Hertz pressure, or marched through the pressure distribution
    - `traction_accuracy`: relative error of the traction forces, for which the integration over the contact is resolved
    - `rolling_resistance`: law of the raceways; `true`: the first of these laws; not given: none
    - `supply`: how much oil reaches the raceways; not given: they are fully flooded
    - `mixed`: mixed friction of rough raceways; not given: the films carry all of the loads
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"traction_model": ("traction_accuracy",)}
    about: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "traction": ("traction_model", "traction_accuracy", "mixed"),
        "traction_model": ("traction_accuracy",),
        "rolling_resistance": ("rolling_heating",),
    }
    film: Annotated[str, ROLLER_FILMS]
    thermal: Annotated[str, LINE_THERMAL] | None = None
    traction: Annotated[str, TRACTIONS] | None = None
    traction_model: Literal["mean_pressure", "distributed"] = "mean_pressure"
    traction_accuracy: TractionAccuracy | None = None
    rolling_resistance: Annotated[str, ROLLING] | None = None
    supply: SupplyTable | None = None
    mixed: MixedTable | None = None

    @check
    def _mixed(self) -> Problems:
        yield from mixed_needs_traction(self)

    @check
    def _consistent(self) -> Problems:
        distributed = self.traction_model == "distributed"
        if distributed and self.traction is None:
            yield refusal_at("traction", "the law that traction_model = 'distributed' is about", "nothing")
        if self.traction_accuracy is not None and not distributed:
            expected = "none: only traction_model = 'distributed' is computed to an accuracy"
            yield refusal_at("traction_accuracy", expected, f"the number {self.traction_accuracy:g}")
        yield from heating_problems(self)


RACEWAY_LAWS = {"film": ROLLER_FILMS, "rolling_resistance": ROLLING}
"""Fields of a roller bearing's [contact] whose laws may need an oil whose viscosity rises with pressure."""


class CageTable(table_of(RollerCage, base=CageBase)):
    """See `bearings.cylindrical.geometry.RollerCage`."""


class FlangeTable(table_of(RollerFlange)):
    """See `bearings.cylindrical.geometry.RollerFlange`."""


class DragTable(table_of(Drag)):
    """See `bearings.parts.Drag`."""


class OperationTable(operation_table(Operation)):
    """See `bearings.operation.Operation`."""

    needs: ClassVar[tuple[str, ...]] = ("radial_load",)


class CylindricalRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    not_yet: ClassVar[Mapping[str, str]] = {
        "kinematics": "a scene without [kinematics], which belongs to ball bearings",
    }
    kind: Annotated[Literal["cylindrical_roller_bearing"], KIND]
    laws: Preset | None = None
    geometry: GeometryTable
    materials: MaterialsTable
    operation: OperationTable
    oil: OilTable | None = None
    contact: ContactTable | None = None
    cage: CageTable | None = None
    flange: FlangeTable | None = None
    drag: DragTable | None = None
    simulation: SimulationTable | None = None
    rating: RatingTable | None = None
    catalogue: CatalogueTable | None = None
    fits: FitsTable | None = None
    temperatures: TemperaturesTable | None = None
    thermal: ThermalTable | None = None
    profile: ProfileTable | None = None
    outer_ring: OuterRingTable | None = None
    inner_ring: InnerRingTable | None = None
    inner_roundness: InnerRoundnessTable | None = None
    outer_roundness: OuterRoundnessTable | None = None

    def moves(self) -> bool:
        """True if a transient run moves the rollers."""
        return self.simulation is not None and self.thermal is None

    @check
    def _flow(self) -> Problems:
        """Checks what one table needs of another. The classes check the rest when they are built."""
        slips = self.contact is not None and self.contact.traction is not None
        if slips and (self.cage is not None or self.moves()):
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _run(self) -> Problems:
        if self.moves() and self.operation.radial_load is None:
            yield refusal_at("operation.radial_load", "a force, which a transient run needs, e.g. '10 kN'", "nothing")

    @check
    def _kind_of_run(self) -> Problems:
        if self.simulation is not None:
            yield from self.simulation.of_other_run(warm=self.thermal is not None)

    @check
    def _cage(self) -> Problems:
        slips = self.contact is not None and self.contact.traction is not None
        if slips and self.cage is None and not self.moves():
            expected = (
                "a table [cage], which contact.traction needs: without one a roller outside the loaded zone slows "
            )
            yield refusal_at(
                "cage", expected + "down for ever (leave out contact.traction, or use simulate)", "nothing"
            )

    @check
    def _oil(self) -> Problems:
        if self.contact is None:
            return
        density = law_in_words(self.contact, "traction")
        yield from require_oil(self.oil, self.operation, self.contact, density, RACEWAY_LAWS)
