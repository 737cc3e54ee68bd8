"""The oil of a scene file: one table a law, each with `law = "..."`; the parameters are those of the classes."""

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ConfigDict, Discriminator, Tag

from . import units
from .data_files import oil_names
from .errors import nearest, one_of
from .table import Problems, Table, check, refusal_at

VISCOSITY_LAWS = ("modified_wlf", "barus", "roelands", "constant", "two_viscosities")
PRESSURE_VISCOSITY_LAWS = ("constant", "fitted", "integrated")
SMALLEST_ROELANDS_VISCOSITY = 6.32e-5
"""exp(-9.67) Pa s, rounded up."""
DOCUMENTATION = ("name", "file", "description", "law", "sources", "note")
"""Names in an oil table and in the tables of its laws that are no parameters."""
ROELANDS_POLE = 138.0
"""K."""
SMALLEST_WALTHER_VISCOSITY = 0.3e-6
"""m^2/s."""


_LAWS = ("viscosity", "pressure_viscosity", "rheology", "density", "conductivity")


class Law(Table):
    """A law; `sources` says where each parameter comes from and is for the reader of the file only, `note` is what a
    solution that uses the oil repeats among its warnings."""

    sources: dict[str, str] | None = None
    note: str | None = None


class ModifiedWLFTable(Law):
    tag: ClassVar[str] = "<modified_wlf>"
    law: Literal["modified_wlf"]
    glass_viscosity: units.PositiveViscosity
    glass_temperature: units.Temperature
    glass_shift: units.PositiveTemperatureDifference
    glass_shift_rate: units.PositiveInversePressure
    expansion_factor: units.PositiveNumber
    expansion_rate: units.PositiveInversePressure
    c1: units.PositiveNumber
    c2: units.PositiveTemperatureDifference


class BarusTable(Law):
    tag: ClassVar[str] = "<barus>"
    law: Literal["barus"]
    reference_viscosity: units.PositiveViscosity
    reference_temperature: units.Temperature
    pressure_viscosity: units.PositiveInversePressure
    temperature_viscosity: units.NonNegativeTemperatureDifference


class RoelandsTable(Law):
    tag: ClassVar[str] = "<roelands>"
    law: Literal["roelands"]
    reference_viscosity: units.PositiveViscosity
    reference_temperature: units.Temperature
    pressure_exponent: units.PositiveNumber
    temperature_exponent: units.NonNegativeNumber

    @check
    def _within_the_law(self) -> Problems:
        if self.reference_viscosity <= SMALLEST_ROELANDS_VISCOSITY:
            found = f"{1e3 * self.reference_viscosity:g} mPa*s"
            yield refusal_at("reference_viscosity", "more than 0.063 mPa*s, Roelands' smallest viscosity", found)
        if self.reference_temperature <= ROELANDS_POLE:
            yield refusal_at("reference_temperature", "more than 138 K", f"{self.reference_temperature:g} K")


class ConstantViscosityTable(Law):
    """The same viscosity at every pressure and temperature."""

    tag: ClassVar[str] = "<constant>"
    law: Literal["constant"]
    value: units.PositiveViscosity


class TwoViscositiesTable(Law):
    """Kinematic viscosities at two temperatures; `pressure_viscosity` at `temperature_1` is estimated if left out.

    - `viscosity_1`, `viscosity_2`: kinematic, at the two temperatures
    - `temperature_1`, `temperature_2`: of the two viscosities, the lower first
    - `pressure_viscosity`: at `temperature_1`; not given: estimated, and marked so
    """

    tag: ClassVar[str] = "<two_viscosities>"
    law: Literal["two_viscosities"]
    viscosity_1: units.PositiveKinematicViscosity
    temperature_1: units.Temperature
    viscosity_2: units.PositiveKinematicViscosity
    temperature_2: units.Temperature
    pressure_viscosity: units.PositiveInversePressure | None = None

    @check
    def _falls_with_temperature(self) -> Problems:
        if self.temperature_2 <= self.temperature_1:
            expected = f"a temperature above temperature_1, {_celsius(self.temperature_1)}"
            yield refusal_at("temperature_2", expected, _celsius(self.temperature_2))
        if self.viscosity_2 >= self.viscosity_1:
            expected = f"less than viscosity_1, {_cst(self.viscosity_1)}: viscosity falls with temperature"
            yield refusal_at("viscosity_2", expected, _cst(self.viscosity_2))
        if self.viscosity_2 <= SMALLEST_WALTHER_VISCOSITY:
            yield refusal_at("viscosity_2", "more than 0.3 cSt, the limit of the law", _cst(self.viscosity_2))


class UnknownViscosityTable(Law):
    """Stand-in for a table whose `law` is absent or unknown: it only raises the error."""

    model_config = ConfigDict(extra="allow")
    tag: ClassVar[str] = "<unknown>"
    law: Literal["modified_wlf", "barus", "roelands", "constant", "two_viscosities"]


class ConstantPressureViscosityTable(Law):
    tag: ClassVar[str] = "<constant>"
    law: Literal["constant"]
    value: units.PositiveInversePressure


class FittedPressureViscosityTable(Law):
    tag: ClassVar[str] = "<fitted>"
    law: Literal["fitted"]
    offset: units.InversePressure
    a00: units.KelvinPerPressure
    a01: units.Kelvin2PerPressure
    pole_temperature: units.Temperature
    a10: units.KelvinPerPressure
    a11: units.Kelvin2PerPressure


class IntegratedPressureViscosityTable(Law):
    """Integrated from the oil's own viscosity law: no parameters."""

    tag: ClassVar[str] = "<integrated>"
    law: Literal["integrated"]


class UnknownPressureViscosityTable(Law):
    """Stand-in for a table whose `law` is absent or unknown: it only raises the error."""

    model_config = ConfigDict(extra="allow")
    tag: ClassVar[str] = "<unknown>"
    law: Literal["constant", "fitted", "integrated"]


class ExponentialRheologyTable(Law):
    """`viscous_function` names the flow law that the data were fitted with, `exponent` is that of the last of them."""

    law: Literal["exponential"]
    viscous_function: Literal["ree_eyring", "bair_winer", "gecim_winer", "elsharkawy_hamrock"] | None = None
    exponent: units.PositiveNumber | None = None
    reference_temperature: units.Temperature
    shear_modulus: units.PositivePressure
    shear_modulus_pressure: units.InversePressure
    shear_modulus_temperature: units.TemperatureDifference
    stress: units.PositivePressure
    stress_pressure: units.InversePressure
    stress_temperature: units.TemperatureDifference

    @check
    def _exponent_where_there_is_one(self) -> Problems:
        needed = self.viscous_function == "elsharkawy_hamrock"
        if needed and self.exponent is None:
            yield refusal_at("exponent", "the exponent of 'elsharkawy_hamrock', e.g. 2", "nothing")
        if not needed and self.exponent is not None:
            expected = "no exponent: only the viscous_function 'elsharkawy_hamrock' has one"
            yield refusal_at("exponent", expected, f"the number {self.exponent:g}")


class LinearDensityTable(Law):
    tag: ClassVar[str] = "<table>"
    law: Literal["linear"]
    value: units.PositiveDensity
    slope: units.DensitySlope
    reference_temperature: units.Temperature


class LinearConductivityTable(Law):
    tag: ClassVar[str] = "<table>"
    law: Literal["linear"]
    value: units.PositiveConductivity
    slope: units.ConductivitySlope
    reference_temperature: units.Temperature


def _law_tag(laws: Sequence[str]) -> Callable[[Any], str]:
    """The alternative that a field means: a text, or a table by its `law`."""

    def tag(value: Any) -> str:
        if not isinstance(value, dict):
            return "<value>"
        law = value.get("law")
        return f"<{law}>" if law in laws else "<unknown>"

    return tag


def _text_or_table(value: Any) -> str:
    return "<table>" if isinstance(value, dict) else "<value>"


def _no_text(value: Any) -> Any:
    raise units.refusal("a table with a 'law'", units.describe(value))


Viscosity = Annotated[
    Annotated[ModifiedWLFTable, Tag("<modified_wlf>")]
    | Annotated[BarusTable, Tag("<barus>")]
    | Annotated[RoelandsTable, Tag("<roelands>")]
    | Annotated[ConstantViscosityTable, Tag("<constant>")]
    | Annotated[TwoViscositiesTable, Tag("<two_viscosities>")]
    | Annotated[UnknownViscosityTable, Tag("<unknown>")]
    | Annotated[None, BeforeValidator(_no_text), Tag("<value>")],
    Discriminator(_law_tag(VISCOSITY_LAWS)),
]
"""A table with a law."""
PressureViscosity = Annotated[
    Annotated[units.PositiveInversePressure, Tag("<value>")]
    | Annotated[ConstantPressureViscosityTable, Tag("<constant>")]
    | Annotated[FittedPressureViscosityTable, Tag("<fitted>")]
    | Annotated[IntegratedPressureViscosityTable, Tag("<integrated>")]
    | Annotated[UnknownPressureViscosityTable, Tag("<unknown>")],
    Discriminator(_law_tag(PRESSURE_VISCOSITY_LAWS)),
]
"""A text with a unit (the same at every temperature), or a table with a law."""
Density = Annotated[
    Annotated[units.PositiveDensity, Tag("<value>")] | Annotated[LinearDensityTable, Tag("<table>")],
    Discriminator(_text_or_table),
]
"""A text with a unit (the same at every temperature), or a table with a law."""
Conductivity = Annotated[
    Annotated[units.PositiveConductivity, Tag("<value>")] | Annotated[LinearConductivityTable, Tag("<table>")],
    Discriminator(_text_or_table),
]
"""A text with a unit (the same at every temperature), or a table with a law."""


def _celsius(temperature: float) -> str:
    return f"{temperature - 273.15:g} degC"


def _cst(viscosity: float) -> str:
    return f"{1e6 * viscosity:g} cSt"


def _oil_name(value: Any) -> str:
    names = oil_names()
    if not isinstance(value, str) or value not in names:
        near = nearest(value, names) if isinstance(value, str) else ""
        raise units.refusal(f"an oil of the catalogue: {one_of(names)}", units.describe(value), near)
    return value


class OilTable(Table):
    """`name` takes the laws of an oil of the catalogue, `file` those of an oil file; further tables replace or amend
    them. A `--set` of the file is of the whole oil.

    - `name`: of the catalogue
    - `file`: an oil file
    - `description`: for the reader
    - `viscosity`: law of viscosity
    - `pressure_viscosity`: coefficient of film formulas; not given: by integral
    - `rheology`: shear modulus and stress, which traction needs
    - `density`: which drag, cage lands and kinematic viscosities need
    - `conductivity`: which thermal factors and film heating need
    """

    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {"name": ("file",), "file": ("name", "description", *_LAWS)}
    name: Annotated[str, BeforeValidator(_oil_name)] | None = None
    file: str | None = None
    description: str | None = None
    viscosity: Viscosity | None = None
    pressure_viscosity: PressureViscosity | None = None
    rheology: ExponentialRheologyTable | None = None
    density: Density | None = None
    conductivity: Conductivity | None = None

    @check
    def _complete(self) -> Problems:
        if self.name is not None and self.file is not None:
            yield refusal_at("file", "none beside 'name': one of the two", units.describe(self.file))
            return
        if self.viscosity is None:
            expected = "the law of viscosity, the 'name' of an oil of the catalogue, or the 'file' of an oil"
            yield refusal_at("viscosity", expected, "nothing")
        if isinstance(self.viscosity, TwoViscositiesTable) and self.density is None:
            expected = "a density, which makes the kinematic viscosities of 'two_viscosities' dynamic ones, e.g. "
            yield refusal_at("density", expected + "density = '870 kg/m^3'", "nothing")
        if isinstance(self.viscosity, ConstantViscosityTable) and isinstance(
            self.pressure_viscosity, IntegratedPressureViscosityTable
        ):
            expected = "a law other than 'integrated' (left out: 0), the viscosity being constant"
            yield refusal_at("pressure_viscosity.law", expected, "'integrated'")
