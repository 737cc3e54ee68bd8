"""The oil of a scene file: one table a law, each with `law = "..."`; the parameters are those of the classes."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, ConfigDict, Discriminator, Tag, model_validator

from . import units
from .data_files import oil_names
from .errors import nearest, one_of
from .table import Table, refusal_at

PRESSURE_VISCOSITY_LAWS = ("constant", "fitted", "integrated")


class Law(Table):
    """A law; `sources` says where each parameter comes from and is for the reader of the file only."""

    sources: dict[str, str] | None = None


class ModifiedWLFTable(Law):
    law: Literal["modified_wlf"]
    glass_viscosity: units.PositiveViscosity
    glass_temperature: units.Temperature
    glass_shift: units.PositiveTemperatureDifference
    glass_shift_rate: units.PositiveInversePressure
    expansion_factor: units.PositiveNumber
    expansion_rate: units.PositiveInversePressure
    c1: units.PositiveNumber
    c2: units.PositiveTemperatureDifference


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
    """Where `law` is absent or unknown: only there to say so."""

    model_config = ConfigDict(extra="allow")
    tag: ClassVar[str] = "<unknown>"
    law: Literal["constant", "fitted", "integrated"]


class ExponentialRheologyTable(Law):
    law: Literal["exponential"]
    reference_temperature: units.Temperature
    shear_modulus: units.PositivePressure
    shear_modulus_pressure: units.InversePressure
    shear_modulus_temperature: units.TemperatureDifference
    stress: units.PositivePressure
    stress_pressure: units.InversePressure
    stress_temperature: units.TemperatureDifference


class LinearDensityTable(Law):
    law: Literal["linear"]
    value: units.PositiveDensity
    slope: units.DensitySlope
    reference_temperature: units.Temperature


class LinearConductivityTable(Law):
    law: Literal["linear"]
    value: units.PositiveConductivity
    slope: units.ConductivitySlope
    reference_temperature: units.Temperature


def _pressure_viscosity_tag(value: Any) -> str:
    if not isinstance(value, dict):
        return "<value>"
    law = value.get("law")
    return f"<{law}>" if law in PRESSURE_VISCOSITY_LAWS else "<unknown>"


PressureViscosity = Annotated[
    Annotated[units.PositiveInversePressure, Tag("<value>")]
    | Annotated[ConstantPressureViscosityTable, Tag("<constant>")]
    | Annotated[FittedPressureViscosityTable, Tag("<fitted>")]
    | Annotated[IntegratedPressureViscosityTable, Tag("<integrated>")]
    | Annotated[UnknownPressureViscosityTable, Tag("<unknown>")],
    Discriminator(_pressure_viscosity_tag),
]
"""A text with a unit (the same at every temperature), or a table with a law."""


def _oil_name(value: Any) -> str:
    names = oil_names()
    if not isinstance(value, str) or value not in names:
        near = nearest(value, names) if isinstance(value, str) else ""
        raise units.refusal(f"an oil of the catalogue: {one_of(names)}", units.describe(value), near)
    return value


class OilTable(Table):
    """`name` takes the laws of an oil of the catalogue; further tables replace or amend them."""

    name: Annotated[str, BeforeValidator(_oil_name)] | None = None
    description: str | None = None
    viscosity: ModifiedWLFTable | None = None
    pressure_viscosity: PressureViscosity | None = None
    rheology: ExponentialRheologyTable | None = None
    density: LinearDensityTable | None = None
    conductivity: LinearConductivityTable | None = None

    @model_validator(mode="after")
    def _complete(self) -> Self:
        for field in ("viscosity", "pressure_viscosity"):
            if getattr(self, field) is None:
                raise refusal_at(field, f"the law of {field}, or the 'name' of an oil of the catalogue", "nothing")
        return self
