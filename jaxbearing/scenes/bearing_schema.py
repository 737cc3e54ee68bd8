"""Common tables of the scene files of all bearings: cage, operating point, and what these need of the oil."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from ..life.basic import RELIABILITY_FACTORS
from ..life.modification import CLEANLINESS
from . import units
from .oil_needs import require_laws, require_piezoviscous
from .oil_schema import OilTable
from .table import Problems, Table, check, refusal_at


class BearingCageTable(Table):
    guidance: Literal["inner_ring", "outer_ring"]
    guiding_clearance: units.PositiveLength
    pocket_clearance: units.PositiveLength
    land_width: units.PositiveLength
    inner_diameter: units.PositiveLength | None = None
    outer_diameter: units.PositiveLength | None = None
    n_lands: units.Count | None = None
    turbulence: Literal["laminar", "blend", "pure"] = "blend"

    @check
    def _consistent(self) -> Problems:
        bore, outside = self.inner_diameter, self.outer_diameter
        if bore is not None and outside is not None and bore >= outside:
            yield refusal_at("inner_diameter", f"less than the outer diameter, {in_mm(outside)}", in_mm(bore))


class DisplacementTable(Table):
    """Given displacements of the inner ring."""

    axial: units.Length | None = None
    radial: units.Length | None = None
    lateral: units.Length | None = None


class BearingOperationTable(Table):
    """The operating point; which loads and displacements a kind of bearing needs its class says."""

    inner_speed: units.Speed
    outer_speed: units.Speed = 0.0
    oil_temperature: units.Temperature | None = None
    oil_flow: units.NonNegativeFlow | None = None
    radial_load: units.Force | None = None
    radial_load_lateral: units.Force | None = None
    moment: units.Moment | None = None
    moment_lateral: units.Moment | None = None
    misalignment: units.Angle | None = None
    misalignment_lateral: units.Angle | None = None
    displacement: DisplacementTable | None = None

    @check
    def _tilt(self) -> Problems:
        for moment, tilt in (("moment", "misalignment"), ("moment_lateral", "misalignment_lateral")):
            if getattr(self, moment) is not None and getattr(self, tilt) is not None:
                about = "" if moment == "moment" else " about the load line"
                expected = f"none beside operation.{moment}, which sets the tilt{about} free"
                yield refusal_at(tilt, expected, f"{getattr(self, tilt):g} rad")

    @check
    def _held(self) -> Problems:
        if self.displacement is None:
            return
        for load, freedom in (("axial_load", "axial"), ("radial_load", "radial"), ("radial_load_lateral", "lateral")):
            held = getattr(self.displacement, freedom)
            if getattr(self, load, None) is not None and held is not None:
                expected = f"none beside operation.{load}, which sets the {freedom} displacement free"
                yield refusal_at(f"displacement.{freedom}", expected, in_mm(held))


class ThrustOperationTable(BearingOperationTable):
    """The operating point of a bearing that carries axial loads."""

    axial_load: units.Force | None = None


def _reliability(value: Any) -> float:
    given = units.number(value)
    if given not in RELIABILITY_FACTORS:
        known = ", ".join(f"{one:g}" for one in RELIABILITY_FACTORS)
        raise units.refusal(f"one of {known}, without quotes", units.describe(value))
    return given


class RatingTable(Table):
    """Inputs of the life; see `bearings.rating.Rating`."""

    dynamic_capacity: units.PositiveForce | None = None
    static_capacity: units.PositiveForce | None = None
    fatigue_load_limit: units.PositiveForce | None = None
    viscosity_ratio: units.PositiveNumber | None = None
    roughness_rings: units.PositiveLength | None = None
    roughness_elements: units.PositiveLength | None = None
    reliability: Annotated[float, BeforeValidator(_reliability)] = 0.90
    cleanliness: Literal[tuple(CLEANLINESS)] | None = None  # pyright: ignore[reportInvalidTypeForm]
    n_laminae: units.Count | None = None
    edge_factor: units.Switch | None = None
    grooves: Literal["catalogue", "scene"] = "catalogue"
    tilt: Literal["exact", "iso"] = "exact"

    @check
    def _both_roughnesses(self) -> Problems:
        if (self.roughness_rings is None) != (self.roughness_elements is None):
            given = "roughness_rings" if self.roughness_elements is None else "roughness_elements"
            missing = "roughness_elements" if self.roughness_elements is None else "roughness_rings"
            yield refusal_at(missing, f"a length, which '{given}' needs beside it", "nothing")


def require_oil_flow(drag: Table | None, operation: BearingOperationTable) -> Problems:
    """Refusal of a scene with drag that does not say how much oil flows."""
    if drag is not None and operation.oil_flow is None:
        yield refusal_at("operation.oil_flow", "a volume flow, which [drag] needs, e.g. '150 l/h'", "nothing")


def require_oil(
    oil: OilTable | None,
    operation: BearingOperationTable,
    contact: Table,
    density: str,
    isoviscous: Mapping[str, tuple[str, ...]],
) -> Problems:
    """Refusals of a scene that lacks what the laws of the raceway contacts need.

    **Arguments:**
    - `contact`: with the fields `thermal` and `traction`.
    - `density`: what needs the density of the oil, in words; "" where nothing does.
    - `isoviscous`: fields of `contact` -> the laws that hold for an oil of the same viscosity at every pressure.
    """
    if operation.oil_temperature is None:
        expected = "a temperature, which [contact] needs, e.g. '100 degC'"
        yield refusal_at("operation.oil_temperature", expected, "nothing")
    if oil is None:
        yield refusal_at("oil", "an oil, which [contact] needs: a table [oil] with a 'name'", "nothing")
        return
    thermal, traction = law_in_words(contact, "thermal"), law_in_words(contact, "traction")
    yield from require_laws(oil, {"conductivity": thermal, "rheology": traction, "density": density})
    yield from require_piezoviscous(oil, contact, isoviscous)


def law_in_words(contact: Table, name: str) -> str:
    """A law of the table as it stands in the file; "" where it names none."""
    law = getattr(contact, name)
    return f"contact.{name} = '{law}'" if law else ""


def in_mm(length: float) -> str:
    return f"{1e3 * length:g} mm"
