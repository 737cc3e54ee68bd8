"""The scene file of a tapered roller bearing. Names are the attribute names of the classes that it builds."""

from typing import Literal, Self

from pydantic import model_validator

from . import units
from .bearing_schema import BearingOperationTable, RatingTable, require_oil
from .materials import MaterialField
from .oil_schema import OilTable
from .profile_schema import ProfileTable
from .table import Table, refusal_at


class TaperedGeometryTable(Table):
    n_rollers: units.Count
    roller_diameter: units.PositiveLength
    roller_length: units.PositiveLength
    contact_angle: units.FlangeAngle
    roller_half_angle: units.FlangeAngle
    flange_angle: units.FlangeAngle
    end_radius: units.PositiveLength


class TaperedMaterialsTable(Table):
    rings: MaterialField
    rollers: MaterialField


class TaperedContactTable(Table):
    """Laws of the raceway films, by the names in `scenes.contact_laws`; there is no traction on these raceways."""

    film: Literal["moes", "dowson_higginson", "dowson_toyoda", "pan_hamrock", "grubin"]
    thermal: Literal["gupta", "hsu_lee"] | None = None
    rolling_resistance: Literal["rigid_isoviscous", "ertel_grubin"] | None = None
    traction: None = None


ISOVISCOUS = {"film": ("moes",), "rolling_resistance": ("rigid_isoviscous",)}
"""The laws of `TaperedContactTable` that hold for an oil of the same viscosity at every pressure."""


class TaperedOperationTable(BearingOperationTable):
    axial_load: units.Force
    radial_load: units.Force | None = None
    moment: units.Moment | None = None
    misalignment: units.Angle | None = None
    load_position: units.Length = 0.0

    @model_validator(mode="after")
    def _tilt(self) -> Self:
        if self.moment is not None and self.misalignment is not None:
            expected = "none beside operation.moment, which sets the tilt free"
            raise refusal_at("misalignment", expected, f"{self.misalignment:g} rad")
        return self


class TaperedRollerTable(Table):
    """The whole file. A table that is left out is not modelled."""

    kind: Literal["tapered_roller_bearing"]
    geometry: TaperedGeometryTable
    materials: TaperedMaterialsTable
    operation: TaperedOperationTable
    oil: OilTable | None = None
    contact: TaperedContactTable | None = None
    profile: ProfileTable | None = None
    rating: RatingTable | None = None

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if self.contact is not None:
            require_oil(self.oil, self.operation, self.contact, "", ISOVISCOUS)
        return self
