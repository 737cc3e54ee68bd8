"""The scene file of a ball bearing. Names are the attribute names of the classes that it builds."""

from collections.abc import Mapping
from typing import ClassVar, Literal, Self

from pydantic import model_validator

from . import units
from .laws import TractionAccuracy
from .materials import MaterialField
from .oil_needs import require_laws, require_piezoviscous
from .oil_schema import OilTable
from .table import Table, refusal_at


class BallGeometryTable(Table):
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "contact_angle": ("diametral_clearance",),
        "diametral_clearance": ("contact_angle",),
    }
    n_balls: units.Count
    pitch_diameter: units.PositiveLength
    ball_diameter: units.PositiveLength
    conformity_inner: units.PositiveNumber
    conformity_outer: units.PositiveNumber
    contact_angle: units.FlangeAngle | None = None
    diametral_clearance: units.NonNegativeLength | None = None
    shoulder_angle_inner: units.FlangeAngle | None = None
    shoulder_angle_outer: units.FlangeAngle | None = None

    @model_validator(mode="after")
    def _one_of_both(self) -> Self:
        if (self.contact_angle is None) == (self.diametral_clearance is None):
            both = "both 'contact_angle' and 'diametral_clearance'"
            found = both if self.contact_angle is not None else "neither 'contact_angle' nor 'diametral_clearance'"
            raise refusal_at("contact_angle", "one of the two: each follows from the other", found)
        return self


class BallMaterialsTable(Table):
    rings: MaterialField
    balls: MaterialField


class BallContactTable(Table):
    """Laws of the raceway contacts, by the names in `scenes.laws`, which says what each stands for."""

    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"traction": ("traction_accuracy",)}
    film: Literal["nijenbanning", "hamrock_dowson"]
    thermal: Literal["gupta"] | None = None
    traction: Literal["maxwell_eyring", "ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock"] | None = None
    traction_accuracy: TractionAccuracy | None = None
    rolling_resistance: Literal["houpert"] | None = None

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        for name in ("traction_accuracy", "rolling_resistance"):
            given = getattr(self, name)
            if given is not None and self.traction is None:
                raise refusal_at("traction", f"a law, without which {name} has no meaning", "nothing")
        return self


ISOVISCOUS = {"film": ("nijenbanning",)}
"""The laws of `BallContactTable` that hold for an oil of the same viscosity at every pressure."""


class KinematicsTable(Table):
    attitude: Literal["outer", "inner", "min_power", "equilibrium"] | None = None
    gyroscopic: Literal["off", "shared", "capped", "resolved"] = "off"


class BallCageTable(Table):
    guidance: Literal["inner_ring", "outer_ring"]
    guiding_clearance: units.PositiveLength
    pocket_clearance: units.PositiveLength
    land_width: units.PositiveLength
    inner_diameter: units.PositiveLength | None = None
    outer_diameter: units.PositiveLength | None = None
    n_lands: units.Count | None = None
    turbulence: Literal["laminar", "blend", "pure"] = "blend"


class BallDragTable(Table):
    coefficient: units.NonNegativeNumber | None = None
    through_flow_fraction: units.Fraction = 1.0


class BallOperationTable(Table):
    inner_speed: units.Speed
    axial_load: units.Force | None = None
    radial_load: units.Force | None = None
    moment: units.Moment | None = None
    misalignment: units.Angle | None = None
    outer_speed: units.Speed = 0.0
    oil_temperature: units.Temperature | None = None
    oil_flow: units.NonNegativeFlow | None = None

    @model_validator(mode="after")
    def _tilt(self) -> Self:
        if self.moment is not None and self.misalignment is not None:
            expected = "none beside operation.moment, which sets the tilt free"
            raise refusal_at("misalignment", expected, f"{self.misalignment:g} rad")
        return self


class BallBearingTable(Table):
    """The whole file. A table that is left out is not modelled."""

    not_yet: ClassVar[Mapping[str, str]] = {"rating": "a scene without a life rating"}
    kind: Literal["ball_bearing"]
    geometry: BallGeometryTable
    materials: BallMaterialsTable
    operation: BallOperationTable
    oil: OilTable | None = None
    contact: BallContactTable | None = None
    kinematics: KinematicsTable | None = None
    cage: BallCageTable | None = None
    drag: BallDragTable | None = None

    @model_validator(mode="after")
    def _complete(self) -> Self:
        """What one table needs of another. The classes check the rest when they are built."""
        slips = self.contact is not None and self.contact.traction is not None
        if slips and self.drag is not None and self.operation.oil_flow is None:
            raise refusal_at("operation.oil_flow", "a volume flow, which [drag] needs, e.g. '150 l/h'", "nothing")
        if self.contact is None:
            return self
        if self.operation.oil_temperature is None:
            expected = "a temperature, which [contact] needs, e.g. '100 degC'"
            raise refusal_at("operation.oil_temperature", expected, "nothing")
        if self.oil is None:
            raise refusal_at("oil", "an oil, which [contact] needs: a table [oil] with a 'name'", "nothing")
        thermal = f"contact.thermal = '{self.contact.thermal}'" if self.contact.thermal else ""
        traction = f"contact.traction = '{self.contact.traction}'" if self.contact.traction else ""
        density = "the cage or the drag" if slips and (self.cage is not None or self.drag is not None) else ""
        require_laws(self.oil, {"conductivity": thermal, "rheology": traction, "density": density})
        require_piezoviscous(self.oil, self.contact, ISOVISCOUS)
        return self
