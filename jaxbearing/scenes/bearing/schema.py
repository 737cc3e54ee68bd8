"""Tables that the scene files of all bearings have, and checks that the oil has the laws and flow that they need."""

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from ...bearings.cage import AbstractCage
from ...bearings.operation import AbstractOperation, HeldDisplacement
from ...bearings.rating import Rating
from ...bearings.ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from ...contacts.oil_supply import GIVEN, Supply
from ...contacts.rolling_heating import AIHARA
from ...makers.catalogue import Catalogue
from ...mounting import Fits, PartTemperatures
from ...thermal.settings import Capacities, ConductanceFactors, Conductances, Shares, Thermal
from ..laws import TURBULENCE, Laws
from ..materials import MaterialField
from ..oil.needs import require_laws, require_piezoviscous
from ..oil.schema import OilTable
from ..table import Problems, Table, check, refusal_at
from ..table_of import table_of
from ..units import Text

TURBULENCE_OF_CAGES = {field.name: field for field in dataclasses.fields(AbstractCage)}["turbulence"].default


class CageBase(Table):
    """- `turbulence`: flow regime of the cage lands."""

    turbulence: Annotated[str, TURBULENCE] = TURBULENCE.name_of(TURBULENCE_OF_CAGES)

    @check
    def _consistent(self) -> Problems:
        bore, outside = self.inner_diameter, self.outer_diameter
        if bore is not None and outside is not None and bore >= outside:
            yield refusal_at("inner_diameter", f"less than the outer diameter, {in_mm(outside)}", in_mm(bore))


class SupplyTable(table_of(Supply)):
    """Oil supply of the raceway contacts; see `contacts.oil_supply.Supply`."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        name: tuple(other for other in GIVEN if other != name) for name in GIVEN
    }


class DisplacementTable(table_of(HeldDisplacement)):
    """Prescribed displacements of the inner ring."""


class OperationBase(Table):
    """The operating point. The class of the bearing kind defines the loads and displacements that it needs."""

    displacement: DisplacementTable | None = None


def operation_table(operation: type[AbstractOperation]) -> Any:
    """The table of the operating point of a bearing kind. Only lubricated bearings need the fields of the oil."""
    return table_of(operation, optional=("oil_temperature", "oil_flow"), base=OperationBase)


class FitsTable(table_of(Fits)):
    """Seats of the rings; see `mounting.seats.Fits`."""

    shaft_material: MaterialField | None = None
    housing_material: MaterialField | None = None


class TemperaturesTable(table_of(PartTemperatures)):
    """Temperatures of the parts; see `mounting.seats.PartTemperatures`."""


class ConductanceTable(table_of(Conductances)):
    """Conductances that replace computed ones."""


class CapacityTable(table_of(Capacities)):
    """Heat capacities that replace computed ones."""


class ConductanceFactorTable(table_of(ConductanceFactors)):
    """Factors for groups of conductances."""


class ShareTable(table_of(Shares)):
    """Fractions of the losses that heat the first of two bodies."""


class ThermalTable(table_of(Thermal)):
    """The thermal network; see `thermal.settings.Thermal`.

    - `conductance`: conductances that replace computed ones
    - `capacity`: heat capacities that replace computed ones
    - `factor`: factors for groups of conductances
    - `share`: fractions of the losses that heat the first of two bodies
    """

    conductance: ConductanceTable | None = None
    capacity: CapacityTable | None = None
    factor: ConductanceFactorTable | None = None
    share: ShareTable | None = None


class OuterRingTable(table_of(FlexibleRing)):
    """A flexible outer ring; see `bearings.ring_shape.FlexibleRing`."""


class InnerRingTable(table_of(FlexibleInnerRing)):
    """A flexible inner ring; see `bearings.ring_shape.FlexibleInnerRing`."""


class InnerRoundnessTable(table_of(InnerRoundness)):
    """Shape of the inner raceway; see `bearings.ring_shape.AbstractRoundness`."""


class OuterRoundnessTable(table_of(OuterRoundness)):
    """Shape of the outer raceway; see `bearings.ring_shape.AbstractRoundness`."""


class RatingTable(table_of(Rating)):
    """Inputs of the rating life; see `bearings.rating.Rating`."""

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "cleanliness": ("contamination_factor",),
        "contamination_factor": ("cleanliness",),
    }


def heating_problems(contact: Any) -> Problems:
    """Refuses `rolling_heating` without a law of rolling resistance. **Arguments:** `contact`: the table [contact]."""
    if contact.rolling_heating is not None and contact.rolling_resistance is None:
        yield refusal_at("rolling_resistance", "a law, without which rolling_heating has no meaning", "nothing")


class CatalogueTable(table_of(Catalogue)):
    """The bearing as a catalogue names it, for `jaxbearing compare`; see `makers.Catalogue`. No result depends on it.

    - `designation`: such as "6205-2RSH", "NU 210 ECP" or "32216"; series, bore and seals are read from it
    - `series`: as the makers' tables name it, such as "62", "72B", "2" (of NU 2) or "320X"
    """

    designation: Text | None = None
    series: Text | None = None


def require_oil_flow(drag: Table | None, operation: Any) -> Problems:
    """Refuses a scene with drag but without an oil flow."""
    if drag is not None and operation.oil_flow is None:
        yield refusal_at("operation.oil_flow", "a volume flow, which [drag] needs, e.g. '150 l/h'", "nothing")


def require_oil(
    oil: OilTable | None,
    operation: Any,
    contact: Any,
    density: str,
    laws: Mapping[str, Laws[Any]],
) -> Problems:
    """Refuses a scene without the oil and the oil data that the laws of the raceway contacts need.

    **Arguments:**
    - `contact`: with the fields `thermal`, `traction` and `rolling_heating`.
    - `density`: name of the feature that needs the density of the oil, in words; "" if none does.
    - `laws`: fields of `contact` whose laws may need an oil whose viscosity rises with pressure -> their laws.
    """
    if operation.oil_temperature is None:
        expected = "a temperature, which [contact] needs, e.g. '100 degC'"
        yield refusal_at("operation.oil_temperature", expected, "nothing")
    if oil is None:
        yield refusal_at("oil", "an oil, which [contact] needs: a table [oil] with a 'name' or a 'grade'", "nothing")
        return
    thermal, traction = law_in_words(contact, "thermal"), law_in_words(contact, "traction")
    heating = law_in_words(contact, "rolling_heating") if contact.rolling_heating == AIHARA else ""
    yield from require_laws(oil, {"conductivity": thermal or heating, "rheology": traction, "density": density})
    yield from require_piezoviscous(oil, contact, laws)


def law_in_words(contact: Table, name: str) -> str:
    """A law of the table as written in the file, e.g. "contact.thermal = 'gupta'"; "" without a law."""
    law = getattr(contact, name)
    return f"contact.{name} = '{law}'" if law else ""


def in_mm(length: float) -> str:
    return f"{1e3 * length:g} mm"
