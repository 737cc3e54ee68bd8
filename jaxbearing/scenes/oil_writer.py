"""The text of an oil file from a `Lubricant`: the way back from `oils.lubricant`, to the last digit of every number.

Written as a template and not by a TOML library: the files hold five flat tables, and comments.
"""

import json
import typing
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from pydantic_core import PydanticCustomError

from ..lubricants import Lubricant, NoPressureViscosity
from . import units
from .errors import printable
from .oil_files import Origin
from .oil_schema import (
    DOCUMENTATION,
    PRESSURE_VISCOSITIES,
    VISCOSITIES,
    ExponentialRheologyTable,
    Law,
    LinearConductivityTable,
    LinearDensityTable,
    LinearHeatCapacityTable,
)

HEADER = "A value with a unit is a string, a dimensionless value is a number. Every value has its source."
UNKNOWN_SOURCE = "not known: given in Python"
_TABLES: dict[type | None, type[Law]] = {
    table.builds: table for table in (*VISCOSITIES.values(), *PRESSURE_VISCOSITIES.values())
}
_READABLE = {
    units.PRESSURE: ("GPa", "MPa", "kPa"),
    units.INVERSE_PRESSURE: ("1/GPa",),
    units.KELVIN_PER_PRESSURE: ("K/GPa",),
    units.KELVIN2_PER_PRESSURE: ("K^2/GPa",),
    units.VISCOSITY: ("mPa*s",),
    units.KINEMATIC_VISCOSITY: ("cSt",),
}
"""Units besides the SI's in which a number may be shorter."""
_DIGITS = (6, 9, 12, 15, 17)


def oil_text(
    oil: Lubricant, name: str, description: str, header: Iterable[str], origins: Mapping[str, Origin] | None = None
) -> str:
    """**Arguments:**
    - `name`, `description`: of the oil, for whoever reads the file.
    - `header`: lines of comment at the top.
    - `origins`: of the laws, by name; what they do not say is marked as not known.

    **Raises:** `ValueError` for a law that files do not know.
    """
    lines = [*(f"# {_line(text)}" for text in [*header, HEADER])]
    lines += [f"name = {_string(name)}", f"description = {_string(description)}"]
    return "\n".join([*lines, *law_lines(oil, origins)]) + "\n"


def law_lines(oil: Lubricant, origins: Mapping[str, Origin] | None = None, above: str = "") -> list[str]:
    """The tables of the laws, an empty line before each. **Arguments:** `above`: what stands before their names, "oil."
    in a scene. **Raises:** `ValueError` for a law that files do not know."""
    origins, lines = origins or {}, []
    laws = _laws(oil)
    notes = _notes(oil, laws, origins)
    for law, (table, values) in laws.items():
        sources = origins[law].sources if law in origins else {}
        lines += ["", f"[{above}{law}]", f"law = {_string(typing.get_args(table.model_fields['law'].annotation)[0])}"]
        lines += [f"{key} = {_value(value, table, key)}" for key, value in values.items()]
        lines += [f"note = {_string(notes[law])}"] if law in notes else []
        lines += ["", f"[{above}{law}.sources]"] if values else []
        texts = {key: sources.get(key, UNKNOWN_SOURCE) for key in values}
        if len(values) > 1 and len(set(texts.values())) == 1:
            texts = {"all": next(iter(texts.values()))}
        lines += [f"{key} = {_string(text)}" for key, text in texts.items()]
    return lines


def _laws(oil: Lubricant) -> dict[str, tuple[type[Law], dict[str, Any]]]:
    """Name of the law -> its table of the schema, and the parameters."""
    found: dict[str, tuple[type[Law], Any]] = {"viscosity": (_table(oil.viscosity), oil.viscosity)}
    if not isinstance(oil.pressure_viscosity, NoPressureViscosity):
        found["pressure_viscosity"] = (_table(oil.pressure_viscosity), oil.pressure_viscosity)
    for name, table in (
        ("rheology", ExponentialRheologyTable),
        ("density", LinearDensityTable),
        ("conductivity", LinearConductivityTable),
        ("heat_capacity", LinearHeatCapacityTable),
    ):
        if getattr(oil, name) is not None:
            found[name] = (table, getattr(oil, name))
    return {name: (table, _parameters(table, law)) for name, (table, law) in found.items()}


def _table(law: Any) -> type[Law]:
    if type(law) not in _TABLES:
        raise ValueError(f"an oil file cannot hold the law {type(law).__name__}")
    return _TABLES[type(law)]


def _parameters(table: type[Law], law: Any) -> dict[str, Any]:
    named = [key for key in table.model_fields if key not in DOCUMENTATION]
    return {key: getattr(law, key) for key in named if getattr(law, key) is not None}


def _notes(oil: Lubricant, laws: Iterable[str], origins: Mapping[str, Origin]) -> dict[str, str]:
    """Notes of the laws; those that no law is known for go with the viscosity."""
    found = {law: origins[law].note for law in laws if law in origins and origins[law].note}
    rest = [note for note in oil.notes if note not in (*found.values(), *oil.viscosity.notes)]
    if rest:
        found["viscosity"] = ". ".join([found["viscosity"], *rest] if "viscosity" in found else rest)
    return found


def _value(value: Any, table: type[Law], key: str) -> str:
    if isinstance(value, str):
        return _string(value)
    dimension = _dimension(table.model_fields[key])
    number = float(np.asarray(value))
    return repr(number) if dimension is None else _string(quantity_text(number, dimension))


def quantity_text(value: float, dimension: units.Dimension) -> str:
    """The shortest text of a value in SI that is read as this very value."""
    texts = [f"{value!r} {dimension.si}"]
    for unit in (dimension.si, *_READABLE.get(dimension, ())):
        scaled = units.registry().Quantity(value, dimension.si).to(unit).magnitude
        texts += [f"{scaled:.{digits}g} {unit}" for digits in _DIGITS]
    return min((text for text in texts if _is_read_as(value, text, dimension)), key=len)


def _is_read_as(value: float, text: str, dimension: units.Dimension) -> bool:
    """Digits may be missing, and the factor of a unit may cost the last place."""
    try:
        return units.parse(text, dimension) == value
    except PydanticCustomError:
        # rounded up beyond the largest number
        return False


def _dimension(info: Any) -> units.Dimension | None:
    """Dimension of a field of the schema; `None` for a plain number."""
    for part in (*info.metadata, *_metadata(info.annotation)):
        if isinstance(part, units.QuantityValidator):
            return part.dimension
    return None


def _metadata(annotation: Any) -> Iterable[Any]:
    for inner in typing.get_args(annotation):
        yield inner
        yield from _metadata(inner)


def _string(text: str) -> str:
    # what JSON escapes, TOML escapes the same way; the rest is made printable first
    return json.dumps(_line(text), ensure_ascii=False)


def _line(text: str) -> str:
    return printable(" ".join(text.split()))
