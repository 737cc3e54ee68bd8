"""The scene file of a tapered roller bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from ...bearings.parts import ContactLaws
from ...bearings.tapered.geometry import TaperedCage, TaperedGeometry
from ...bearings.tapered.scene import TaperedOperation
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
    operation_table,
    require_oil,
    require_oil_flow,
)
from ..bearing.simulation import WarmUpTable
from ..cylindrical.schema import RACEWAY_LAWS, DragTable
from ..kinds import KIND
from ..laws import LINE_THERMAL, RIB_FILMS, ROLLER_FILMS, ROLLING, TRACTIONS, TractionAccuracy
from ..materials import MaterialField, RingMaterialsTable
from ..mixed import RibMixedTable, mixed_needs_traction
from ..oil.schema import OilTable
from ..presets import Preset
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of


class TaperedGeometryTable(table_of(TaperedGeometry)):
    """See `bearings.tapered.geometry.TaperedGeometry`."""


class TaperedMaterialsTable(RingMaterialsTable):
    rollers: MaterialField


class TaperedContactTable(table_of(ContactLaws, leave_out=("entrainment_offset", "entrainment_smoothing"))):
    """Laws of the contacts by name; `scenes.laws` lists the names.

    `film` and `rolling_resistance` hold for the raceways, `flange_film` for the roller ends on the rib. `thermal` holds
    for both, but the rib always has Gupta's law, because the other law is for line contacts. `traction` holds for the
    sliding on the rib, and for the friction that the raceways transmit, or, without a cage, could transmit.

    - `traction_accuracy`: relative error of the traction forces, for which the integration over the contact is resolved
    - `rolling_resistance`: law of the raceways; `true`: the first of these laws; not given: none
    - `supply`: how much oil reaches the raceways; not given: they are fully flooded
    - `flange_film`: film law of the roller ends on the rib
    - `mixed`: mixed friction of rough raceways and ribs; not given: the films carry all of the loads
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "traction": ("traction_accuracy", "mixed"),
        "rolling_resistance": ("rolling_heating",),
    }
    film: Annotated[str, ROLLER_FILMS]
    thermal: Annotated[str, LINE_THERMAL] | None = None
    rolling_resistance: Annotated[str, ROLLING] | None = None
    flange_film: Annotated[str, RIB_FILMS] | None = None
    traction: Annotated[str, TRACTIONS] | None = None
    traction_accuracy: TractionAccuracy | None = None
    supply: SupplyTable | None = None
    mixed: RibMixedTable | None = None

    @check
    def _mixed(self) -> Problems:
        yield from mixed_needs_traction(self)

    @check
    def _consistent(self) -> Problems:
        if self.traction_accuracy is not None and self.traction is None:
            yield refusal_at("traction", "a law, without which traction_accuracy has no meaning", "nothing")
        yield from heating_problems(self)


class TaperedCageTable(table_of(TaperedCage, base=CageBase)):
    """See `bearings.tapered.geometry.TaperedCage`."""


class TaperedOperationTable(operation_table(TaperedOperation)):
    """See `bearings.tapered.scene.TaperedOperation`."""

    needs: ClassVar[tuple[str, ...]] = ("axial_load",)


class TaperedRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    kind: Annotated[Literal["tapered_roller_bearing"], KIND]
    laws: Preset | None = None
    geometry: TaperedGeometryTable
    materials: TaperedMaterialsTable
    operation: TaperedOperationTable
    oil: OilTable | None = None
    contact: TaperedContactTable | None = None
    cage: TaperedCageTable | None = None
    drag: DragTable | None = None
    profile: ProfileTable | None = None
    rating: RatingTable | None = None
    catalogue: CatalogueTable | None = None
    fits: FitsTable | None = None
    temperatures: TemperaturesTable | None = None
    thermal: ThermalTable | None = None
    simulation: WarmUpTable | None = None
    outer_ring: OuterRingTable | None = None
    inner_ring: InnerRingTable | None = None
    inner_roundness: InnerRoundnessTable | None = None
    outer_roundness: OuterRoundnessTable | None = None

    @check
    def _flow(self) -> Problems:
        if self.contact is not None:
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _oil(self) -> Problems:
        if self.contact is not None:
            slips = self.contact.traction is not None and self.cage is not None
            density = "the cage or the drag" if slips or self.drag is not None else ""
            laws = {**RACEWAY_LAWS, "flange_film": RIB_FILMS}
            yield from require_oil(self.oil, self.operation, self.contact, density, laws)
