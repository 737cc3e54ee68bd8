"""The scene file of a cylindrical roller bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import ClassVar, Literal, Self

from pydantic import model_validator

from . import units
from .laws import TractionAccuracy
from .materials import MaterialField
from .oil_needs import require_laws, require_piezoviscous
from .oil_schema import OilTable
from .table import Table, refusal_at


class GeometryTable(Table):
    n_rollers: units.Count
    pitch_diameter: units.PositiveLength
    roller_diameter: units.PositiveLength
    roller_length: units.PositiveLength
    diametral_clearance: units.Length
    contact_length: units.PositiveLength | None = None

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if self.contact_length is not None and self.contact_length > self.roller_length:
            limit = f"at most the roller length, {_mm(self.roller_length)}"
            raise refusal_at("contact_length", limit, _mm(self.contact_length))
        return self


class MaterialsTable(Table):
    rings: MaterialField
    rollers: MaterialField


class ContactTable(Table):
    """Laws of the raceway contacts, by the names in `scenes.contact_laws`, which says what each stands for."""

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

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        distributed = self.traction_model == "distributed"
        if distributed and self.traction is None:
            raise refusal_at("traction", "the law that traction_model = 'distributed' is about", "nothing")
        if self.traction_accuracy is not None and not distributed:
            expected = "none: only traction_model = 'distributed' is computed to an accuracy"
            raise refusal_at("traction_accuracy", expected, f"the number {self.traction_accuracy:g}")
        return self


ISOVISCOUS = {"film": ("moes",), "rolling_resistance": ("rigid_isoviscous",)}
"""The laws of `ContactTable` that hold for an oil of the same viscosity at every pressure."""


class CageTable(Table):
    guidance: Literal["inner_ring", "outer_ring"]
    guiding_clearance: units.PositiveLength
    pocket_clearance: units.PositiveLength
    land_width: units.PositiveLength
    inner_diameter: units.PositiveLength | None = None
    outer_diameter: units.PositiveLength | None = None
    pocket_axial_clearance: units.PositiveLength | None = None
    n_lands: units.Count | None = None
    turbulence: Literal["laminar", "blend", "pure"] = "blend"

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        bore, outside = self.inner_diameter, self.outer_diameter
        if bore is not None and outside is not None and bore >= outside:
            raise refusal_at("inner_diameter", f"less than the outer diameter, {_mm(outside)}", _mm(bore))
        return self


class FlangeTable(Table):
    ring: Literal["inner", "outer", "both"]
    axial_clearance: units.PositiveLength
    angle: units.FlangeAngle = 0.0
    height: units.PositiveLength | None = None


class DragTable(Table):
    coefficient: units.NonNegativeNumber
    through_flow_fraction: units.Fraction = 1.0


class OperationTable(Table):
    not_yet: ClassVar[Mapping[str, str]] = {
        "axial_load": "a radial load only",
        "moment": "a radial load only (the tilt is held at 0)",
        "misalignment": "aligned rings",
    }
    inner_speed: units.Speed
    radial_load: units.PositiveForce
    outer_speed: units.Speed = 0.0
    oil_temperature: units.Temperature | None = None
    oil_flow: units.NonNegativeFlow | None = None


class CylindricalRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    not_yet: ClassVar[Mapping[str, str]] = {
        "rating": "a scene without a life rating",
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

    @model_validator(mode="after")
    def _complete(self) -> Self:
        """What one table needs of another. The classes check the rest when they are built."""
        rolling = self.contact is not None and self.contact.traction is not None and self.cage is not None
        if rolling and self.drag is not None and self.operation.oil_flow is None:
            raise refusal_at("operation.oil_flow", "a volume flow, which [drag] needs, e.g. '150 l/h'", "nothing")
        if self.contact is None:
            return self
        if self.contact.traction is not None and self.cage is None:
            expected = (
                "a table [cage], which contact.traction needs: without one a roller outside the loaded zone slows "
            )
            raise refusal_at(
                "cage", expected + "down for ever (leave out contact.traction, or use simulate)", "nothing"
            )
        if self.operation.oil_temperature is None:
            expected = "a temperature, which [contact] needs, e.g. '100 degC'"
            raise refusal_at("operation.oil_temperature", expected, "nothing")
        if self.oil is None:
            raise refusal_at("oil", "an oil, which [contact] needs: a table [oil] with a 'name'", "nothing")
        thermal = f"contact.thermal = '{self.contact.thermal}'" if self.contact.thermal else ""
        traction = f"contact.traction = '{self.contact.traction}'" if self.contact.traction else ""
        require_laws(self.oil, {"conductivity": thermal, "rheology": traction, "density": traction})
        require_piezoviscous(self.oil, self.contact, ISOVISCOUS)
        return self


def _mm(length: float) -> str:
    return f"{1e3 * length:g} mm"
