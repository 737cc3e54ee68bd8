"""The oil of a scene file. Each law is a table with `law = "..."` and the parameters of its class.

The names of the laws are registered here; tables, messages, readers and writers of oils use them.
"""

from collections.abc import Callable, Mapping
from functools import reduce
from operator import or_
from typing import Annotated, Any, ClassVar, Literal, Never

from pydantic import BeforeValidator, ConfigDict, Discriminator, Tag, create_model

from ...lubricants import (
    ISOVISCOUS,
    Barus,
    ConstantPressureViscosity,
    ConstantViscosity,
    ExponentialRheology,
    FittedPressureViscosity,
    IntegratedPressureViscosity,
    IsoviscousLiquid,
    LinearConductivity,
    LinearDensity,
    LinearHeatCapacity,
    Lubricant,
    ModifiedWLF,
    ProportionalRheology,
    Roelands,
    VogelDicke,
    WaltherPower,
    WaltherRoelands,
)
from .. import units
from ..data_files import oil_named, oil_names
from ..errors import nearest, one_of
from ..table import Problems, Table, check, refusal_at
from ..table_of import number_of, table_of
from ..words import describe
from . import grades

DOCUMENTATION = ("name", "grade", "base", "file", "description", "law", "sources", "note", "ranges")
"""Names in an oil table and in the tables of its laws that are not parameters."""
LAWS = ("viscosity", "pressure_viscosity", "rheology", "density", "conductivity", "heat_capacity")


class Law(Table):
    """A law. `sources` gives the source of each parameter, for readers of the file only. `note` is repeated among the
    warnings of solutions with the oil. `ranges` gives the lowest and the highest value of parameters that are a prior;
    `jaxbearing tolerances` uses them as uniform distributions."""

    sources: dict[str, str] | None = None
    note: str | None = None
    ranges: dict[str, list[Any]] | None = None


class _FallingViscosities(Law):
    """Check that viscosity falls with temperature; messages have the units of data sheets."""

    @check
    def _falls_with_temperature(self) -> Problems:
        if self.temperature_2 <= self.temperature_1:
            expected = f"a temperature above temperature_1, {_celsius(self.temperature_1)}"
            yield refusal_at("temperature_2", expected, _celsius(self.temperature_2))
        if self.viscosity_2 >= self.viscosity_1:
            expected = f"less than viscosity_1, {_cst(self.viscosity_1)}: viscosity falls with temperature"
            yield refusal_at("viscosity_2", expected, _cst(self.viscosity_2))


_RISE = units.INVERSE_PRESSURE.expected("> 0")


class _RisesWithPressure(Law):
    """Check that viscosity rises with pressure, since a coefficient of 0 in a file is probably an error. The class
    itself allows 0, for closed-form solutions."""

    @check
    def _rises(self) -> Problems:
        for name in ("pressure_viscosity", "value"):
            if getattr(self, name, None) == 0.0:
                yield refusal_at(name, _RISE, "0")


class _ExponentOfFunction(Law):
    """Check that an exponent is given only for the viscous function that has one."""

    @check
    def _exponent_where_there_is_one(self) -> Problems:
        needed = self.viscous_function == "elsharkawy_hamrock"
        if needed and self.exponent is None:
            yield refusal_at("exponent", "the exponent of 'elsharkawy_hamrock', e.g. 2", "nothing")
        if not needed and self.exponent is not None:
            expected = "no exponent: only the viscous_function 'elsharkawy_hamrock' has one"
            yield refusal_at("exponent", expected, f"the number {self.exponent:g}")


def _law_named(*names: str) -> dict[str, Any]:
    """The field `law`, for `create_model`."""
    return {"__module__": __name__, "law": (Literal[names], ...)}


def law_table(name: str, law: type, tag: str | None = None, base: type[Law] = Law) -> type[Law]:
    """The table of a law of an oil.

    **Arguments:** `name`: name in files; `law`: class with the parameters; `tag`: tag of the alternative if it is not
    the name; "" for a field without alternatives; `base`: table with further checks.
    """
    made: Any = create_model(f"{law.__name__}Table", __base__=table_of(law, base=base), **_law_named(name))
    made.tag, made.__doc__ = f"<{name}>" if tag is None else tag, law.__doc__
    return made


VISCOSITIES: dict[str, type[Law]] = {
    "modified_wlf": law_table("modified_wlf", ModifiedWLF),
    "barus": law_table("barus", Barus, base=_RisesWithPressure),
    "roelands": law_table("roelands", Roelands),
    "constant": law_table("constant", ConstantViscosity),
    "two_viscosities": law_table("two_viscosities", WaltherRoelands, base=_FallingViscosities),
    "walther_power": law_table("walther_power", WaltherPower, base=_FallingViscosities),
    "vogel_dicke": law_table("vogel_dicke", VogelDicke),
    "isoviscous": law_table("isoviscous", IsoviscousLiquid),
}
"""Laws of viscosity by name."""
PRESSURE_VISCOSITIES: dict[str, type[Law]] = {
    "constant": law_table("constant", ConstantPressureViscosity, base=_RisesWithPressure),
    "fitted": law_table("fitted", FittedPressureViscosity),
    "integrated": law_table("integrated", IntegratedPressureViscosity),
}
"""Laws of the pressure-viscosity coefficient by name."""
RHEOLOGIES: dict[str, type[Law]] = {
    "exponential": law_table("exponential", ExponentialRheology, base=_ExponentOfFunction),
    "proportional": law_table("proportional", ProportionalRheology, base=_ExponentOfFunction),
}
"""Laws of shear modulus and stress by name."""
LinearDensityTable = law_table("linear", LinearDensity, "<table>")
LinearConductivityTable = law_table("linear", LinearConductivity, "<table>")
LinearHeatCapacityTable = law_table("linear", LinearHeatCapacity, "<table>")


def _no_text(value: object) -> Never:
    raise units.refusal("a table with a 'law'", describe(value))


def _law_field(title: str, laws: Mapping[str, type[Law]], text: object) -> Any:
    """The type of a field that holds a table with a law.

    **Arguments:** `title`: part of the name of the table that reports a missing or wrong `law`; `laws`: name -> table;
    `text`: type of the value that the field accepts instead of a table.
    """
    unknown: Any = create_model(f"Unknown{title}Table", __base__=_Unknown, **_law_named(*laws))

    def tag(value: object) -> str:
        if not isinstance(value, dict):
            return "<value>"
        law = value.get("law")
        return f"<{law}>" if isinstance(law, str) and law in laws else "<unknown>"

    tables = {f"<{name}>": table for name, table in laws.items()}
    return _alternatives({"<value>": text, **tables, "<unknown>": unknown}, tag)


class _Unknown(Law):
    model_config = ConfigDict(extra="allow")
    tag: ClassVar[str] = "<unknown>"


def _text_or_table(value: object) -> str:
    return "<table>" if isinstance(value, dict) else "<value>"


def _linear_field(table: type[Law], law: type) -> object:
    """The type of a field that holds a number, which means a constant, or a linear law."""
    return _alternatives({"<value>": number_of(law, "value"), "<table>": table}, _text_or_table)


def _alternatives(kinds: Mapping[str, object], tag: Callable[[Any], str]) -> Any:
    """The type of a field that accepts these types; `tag`: function that selects one of them for a given value."""
    return Annotated[reduce(or_, [Annotated[kind, Tag(name)] for name, kind in kinds.items()]), Discriminator(tag)]


def _celsius(temperature: float) -> str:
    return f"{temperature - 273.15:g} degC"


def _cst(viscosity: float) -> str:
    return f"{1e6 * viscosity:g} cSt"


def builds(table: object, *laws: type) -> bool:
    """True if the value of a field is the table of one of these laws."""
    return isinstance(table, Law) and table.builds in laws


def _oil_name(value: object) -> str:
    name = oil_named(value)
    if name is None:
        near = nearest(value, oil_names()) if isinstance(value, str) else ""
        raise units.refusal(f"an oil of the catalogue: {one_of(oil_names())}", describe(value), near)
    return name


def _grade(value: object) -> str:
    known, grade = grades.grades(), grades.grade_named(value)
    if grade not in known:
        near = grades.nearest_grade(value, known)
        raise units.refusal(f"an ISO viscosity grade: {one_of(known)}", describe(value), near)
    return grade


def _base(value: object) -> str:
    base = grades.base_named(value)
    if base is None:
        near = nearest(value, grades.bases()) if isinstance(value, str) else ""
        raise units.refusal(f"a base stock: {one_of(grades.bases())}", describe(value), near)
    return base


_Viscosity = _law_field("Viscosity", VISCOSITIES, Annotated[None, BeforeValidator(_no_text)])
_Rise = Annotated[
    float,
    units.QuantityValidator(
        lambda value: units.quantity(value, units.INVERSE_PRESSURE, "> 0"), dimension=units.INVERSE_PRESSURE
    ),
]
_PressureViscosity = _law_field("PressureViscosity", PRESSURE_VISCOSITIES, _Rise)
_Rheology = _law_field("Rheology", RHEOLOGIES, Annotated[None, BeforeValidator(_no_text)])


_Density = _linear_field(LinearDensityTable, LinearDensity)
_Conductivity = _linear_field(LinearConductivityTable, LinearConductivity)
_HeatCapacity = _linear_field(LinearHeatCapacityTable, LinearHeatCapacity)


class OilTable(Table):
    """`name` takes the laws of an oil of the catalogue, `grade` those of a standard oil, `file` those of an oil file;
    further tables replace or change them. A `--set` of the grade or of the file replaces the whole oil.

    - `name`: name of an oil of the catalogue
    - `grade`: ISO viscosity grade of a standard oil
    - `base`: base stock of the grade, not given: mineral
    - `file`: path of an oil file
    - `description`: text for the reader of the file
    - `viscosity`: law of viscosity
    - `pressure_viscosity`: coefficient of film formulas; not given: integrated from the viscosity
    - `rheology`: shear modulus and stress, needed by traction
    - `density`: law of density, needed by drag, cage lands and kinematic viscosities
    - `conductivity`: law of thermal conductivity, needed by thermal factors and film heating
    - `heat_capacity`: law of heat capacity, needed by thermal networks
    """

    builds: ClassVar[type | None] = Lubricant
    instead: ClassVar[Mapping[str, tuple[str, ...]]] = {
        "name": ("file", "grade", "base"),
        "grade": ("name", "file", "description", *LAWS),
        "file": ("name", "grade", "base", "description", *LAWS),
    }
    about: ClassVar[Mapping[str, tuple[str, ...]]] = {"grade": ("base",)}
    name: Annotated[str, BeforeValidator(_oil_name)] | None = None
    grade: Annotated[str, BeforeValidator(_grade)] | None = None
    base: Annotated[str, BeforeValidator(_base)] | None = None
    file: str | None = None
    description: str | None = None
    viscosity: _Viscosity | None = None  # pyright: ignore[reportInvalidTypeForm]
    pressure_viscosity: _PressureViscosity | None = None  # pyright: ignore[reportInvalidTypeForm]
    rheology: _Rheology | None = None  # pyright: ignore[reportInvalidTypeForm]
    density: _Density | None = None  # pyright: ignore[reportInvalidTypeForm]
    conductivity: _Conductivity | None = None  # pyright: ignore[reportInvalidTypeForm]
    heat_capacity: _HeatCapacity | None = None  # pyright: ignore[reportInvalidTypeForm]

    @check
    def _one_origin(self) -> Problems:
        if self.base is not None and self.grade is None:
            yield refusal_at("base", "none without 'grade', e.g. 'ISO VG 68'", describe(self.base))

    @check
    def _complete(self) -> Problems:
        if self.name is not None and self.file is not None:
            yield refusal_at("file", "none beside 'name': one of the two", describe(self.file))
            return
        if self.grade is not None and (self.name is not None or self.file is not None):
            other = "name" if self.name is not None else "file"
            yield refusal_at("grade", f"none beside '{other}': one of the two", describe(self.grade))
            return
        if self.grade is not None:
            base = self.base or grades.DEFAULT_BASE
            if self.grade not in grades.grades(base):
                near = grades.nearest_grade(self.grade, grades.grades(base))
                yield refusal_at("grade", grades.refused(base), f"'{self.grade}'", near)
                return
        if self.viscosity is None:
            expected = "the law of viscosity, or an oil: its 'name' in the catalogue, its 'grade' or its 'file'"
            yield refusal_at("viscosity", expected, "nothing")
        if builds(self.viscosity, WaltherRoelands, WaltherPower) and self.density is None:
            expected = "a density, which makes the kinematic viscosities of the law dynamic ones, e.g. "
            yield refusal_at("density", expected + "density = '870 kg/m^3'", "nothing")
        if builds(self.viscosity, *ISOVISCOUS) and builds(self.pressure_viscosity, IntegratedPressureViscosity):
            expected = "a law other than 'integrated' (left out: 0), the viscosity being constant under pressure"
            yield refusal_at("pressure_viscosity.law", expected, "'integrated'")
