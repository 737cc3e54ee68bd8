"""The scene file of a tapered roller bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import ClassVar, Literal

from . import units
from .bearing_schema import RatingTable, ThrustOperationTable, require_oil, require_oil_flow
from .laws import TractionAccuracy
from .materials import MaterialField
from .oil_schema import OilTable
from .profile_schema import ProfileTable
from .roller_schema import DragTable
from .table import Problems, Table, check, refusal_at


class TaperedGeometryTable(Table):
    n_rollers: units.Count
    roller_diameter: units.PositiveLength
    roller_length: units.PositiveLength
    contact_angle: units.AcuteAngle
    roller_half_angle: units.AcuteAngle
    flange_angle: units.AcuteAngle
    end_radius: units.PositiveLength
    first_element_angle: units.Angle | None = None


class TaperedMaterialsTable(Table):
    rings: MaterialField
    rollers: MaterialField


class TaperedContactTable(Table):
    """Laws of the contacts, by the names in `tapered_build`. `film`, `rolling_resistance`: of the raceways;
    `flange_film`: of the roller ends on the rib; `thermal`: of both, on the rib always Gupta's, the other one is made
    for lines; `traction`: of what slides on the rib, and what the raceways could carry.

    - `traction_accuracy`: relative error of the traction forces for which the march through the Hertz pressure is cut
    - `rolling_resistance`: of the raceways; not given: none
    - `flange_film`: film law of the roller ends on the rib
    """

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"traction": ("traction_accuracy",)}
    film: Literal["moes", "dowson_higginson", "dowson_toyoda", "pan_hamrock", "grubin"]
    thermal: Literal["gupta", "hsu_lee"] | None = None
    rolling_resistance: Literal["rigid_isoviscous", "ertel_grubin"] | None = None
    flange_film: Literal["chittenden", "hamrock_dowson", "nijenbanning"] | None = None
    traction: Literal["maxwell_eyring", "ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock"] | None = None
    traction_accuracy: TractionAccuracy | None = None

    @check
    def _consistent(self) -> Problems:
        if self.traction_accuracy is not None and self.traction is None:
            yield refusal_at("traction", "a law, without which traction_accuracy has no meaning", "nothing")


ISOVISCOUS = {
    "film": ("moes",),
    "rolling_resistance": ("rigid_isoviscous",),
    "flange_film": ("nijenbanning",),
}
"""The laws of `TaperedContactTable` that hold for an oil of the same viscosity at every pressure."""


class TaperedOperationTable(ThrustOperationTable):
    needs: ClassVar[tuple[str, ...]] = ("axial_load",)
    load_position: units.Length = 0.0

    @check
    def _thrust(self) -> Problems:
        if self.axial_load is None and (self.displacement is None or self.displacement.axial is None):
            expected = "a force, e.g. '1 kN', which is required where operation.displacement.axial is not given"
            yield refusal_at("axial_load", expected, "nothing")


class TaperedRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    kind: Literal["tapered_roller_bearing"]
    geometry: TaperedGeometryTable
    materials: TaperedMaterialsTable
    operation: TaperedOperationTable
    oil: OilTable | None = None
    contact: TaperedContactTable | None = None
    drag: DragTable | None = None
    profile: ProfileTable | None = None
    rating: RatingTable | None = None

    @check
    def _flow(self) -> Problems:
        if self.contact is not None:
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _oil(self) -> Problems:
        if self.contact is not None:
            density = "" if self.drag is None else "the drag"
            yield from require_oil(self.oil, self.operation, self.contact, density, ISOVISCOUS)
