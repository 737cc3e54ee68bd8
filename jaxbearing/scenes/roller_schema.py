"""The scene file of a cylindrical roller bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import ClassVar, Literal

from . import units
from .bearing_schema import (
    BearingCageTable,
    BearingOperationTable,
    RatingTable,
    in_mm,
    law_in_words,
    require_oil,
    require_oil_flow,
)
from .laws import TractionAccuracy
from .materials import MaterialField
from .oil_schema import OilTable
from .profile_schema import ProfileTable
from .simulation_schema import SimulationTable
from .table import Problems, Table, check, refusal_at


class GeometryTable(Table):
    n_rollers: units.Count
    pitch_diameter: units.PositiveLength
    roller_diameter: units.PositiveLength
    roller_length: units.PositiveLength
    diametral_clearance: units.Length
    contact_length: units.PositiveLength | None = None
    first_element_angle: units.Angle | None = None

    @check
    def _consistent(self) -> Problems:
        if self.contact_length is not None and self.contact_length > self.roller_length:
            limit = f"at most the roller length, {in_mm(self.roller_length)}"
            yield refusal_at("contact_length", limit, in_mm(self.contact_length))


class MaterialsTable(Table):
    rings: MaterialField
    rollers: MaterialField
    cage: MaterialField | None = None


class ContactTable(Table):
    """Laws of the raceway contacts, by the names in `scenes.contact_laws`, which says what each stands for.

    - `traction_model`: the law at the mean Hertz pressure, or marched through the pressure
    - `traction_accuracy`: relative error of the traction forces for which the march through the Hertz pressure is cut
    - `rolling_resistance`: of the raceways; not given: none
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"traction_model": ("traction_accuracy",)}
    about: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "traction": ("traction_model", "traction_accuracy"),
        "traction_model": ("traction_accuracy",),
    }
    film: Literal["moes", "dowson_higginson", "dowson_toyoda", "pan_hamrock", "grubin"]
    thermal: Literal["gupta", "hsu_lee"] | None = None
    traction: Literal["maxwell_eyring", "ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock"] | None = None
    traction_model: Literal["mean_pressure", "distributed"] = "mean_pressure"
    traction_accuracy: TractionAccuracy | None = None
    rolling_resistance: Literal["rigid_isoviscous", "ertel_grubin"] | None = None
    entrainment_offset: units.NonNegativeSurfaceSpeed = 0.0

    @check
    def _consistent(self) -> Problems:
        distributed = self.traction_model == "distributed"
        if distributed and self.traction is None:
            yield refusal_at("traction", "the law that traction_model = 'distributed' is about", "nothing")
        if self.traction_accuracy is not None and not distributed:
            expected = "none: only traction_model = 'distributed' is computed to an accuracy"
            yield refusal_at("traction_accuracy", expected, f"the number {self.traction_accuracy:g}")


ISOVISCOUS = {"film": ("moes",), "rolling_resistance": ("rigid_isoviscous",)}
"""The laws of `ContactTable` that hold for an oil of the same viscosity at every pressure."""


class CageTable(BearingCageTable):
    pocket_axial_clearance: units.PositiveLength | None = None


class FlangeTable(Table):
    ring: Literal["inner", "outer", "both"]
    axial_clearance: units.PositiveLength
    angle: units.FlangeAngle = 0.0
    height: units.PositiveLength | None = None


class DragTable(Table):
    """Oil drag of the rolling elements.

    - `coefficient`: drag coefficient of one roller in its row
    - `through_flow_fraction`: part of the oil flow that passes through the bearing; 1: under-race supply
    """

    coefficient: units.NonNegativeNumber
    through_flow_fraction: units.Fraction = 1.0


class OperationTable(BearingOperationTable):
    not_yet: ClassVar[Mapping[str, str]] = {"axial_load": "a radial load only, beside a moment or misalignment"}
    needs: ClassVar[tuple[str, ...]] = ("radial_load",)
    radial_load: units.PositiveForce | None = None

    @check
    def _axial(self) -> Problems:
        if self.displacement is not None and self.displacement.axial is not None:
            expected = "none: nothing holds the inner ring of a cylindrical roller bearing along the axis"
            yield refusal_at("displacement.axial", expected, in_mm(self.displacement.axial))

    @check
    def _across(self) -> Problems:
        held = self.displacement is not None and (
            self.displacement.radial is not None or self.displacement.lateral is not None
        )
        if self.radial_load is None and self.radial_load_lateral is None and not held:
            expected = "a force, e.g. '10 kN', which is required without radial_load_lateral and operation.displacement"
            yield refusal_at("radial_load", expected, "nothing")


class CylindricalRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    not_yet: ClassVar[Mapping[str, str]] = {
        "kinematics": "a scene without [kinematics], which belongs to ball bearings",
    }
    kind: Literal["cylindrical_roller_bearing"]
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
    profile: ProfileTable | None = None

    @check
    def _flow(self) -> Problems:
        """Checks what one table needs of another. The classes check the rest when they are built."""
        slips = self.contact is not None and self.contact.traction is not None
        if slips and (self.cage is not None or self.simulation is not None):
            yield from require_oil_flow(self.drag, self.operation)

    @check
    def _run(self) -> Problems:
        if self.simulation is not None and self.operation.radial_load is None:
            yield refusal_at("operation.radial_load", "a force, which a run in time needs, e.g. '10 kN'", "nothing")

    @check
    def _cage(self) -> Problems:
        slips = self.contact is not None and self.contact.traction is not None
        if slips and self.cage is None and self.simulation is None:
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
        yield from require_oil(self.oil, self.operation, self.contact, density, ISOVISCOUS)
