"""The tables of a file from a `Lubricant`: the way back from `catalogue.lubricant`, exact to the last bit."""

import typing
from collections.abc import Iterable, Iterator, Mapping

import equinox as eqx

from ...lubricants import (
    ConstantPressureViscosity,
    LinearConductivity,
    LinearDensity,
    LinearHeatCapacity,
    Lubricant,
    NoPressureViscosity,
    WaltherPower,
)
from ..data_files import oil_names
from ..drafts import read_table
from ..part_writer import SCENE, Rows, rows, same, unwritable
from ..toml_writer import comments, one_line, toml_text
from .catalogue import ROOM_TEMPERATURE, lubricant, with_catalogue
from .files import Origin
from .grades import bases, grades
from .schema import (
    PRESSURE_VISCOSITIES,
    RHEOLOGIES,
    VISCOSITIES,
    Law,
    LinearConductivityTable,
    LinearDensityTable,
    LinearHeatCapacityTable,
    OilTable,
)

HEADER = "A value with a unit is a string, a dimensionless value is a number. Every value has its source."
UNKNOWN_SOURCE = "not known: given in Python"
_TABLES: dict[type | None, type[Law]] = {
    table.builds: table for table in (*VISCOSITIES.values(), *PRESSURE_VISCOSITIES.values(), *RHEOLOGIES.values())
}


def oil_text(
    oil: Lubricant, name: str, description: str, header: Iterable[str], origins: Mapping[str, Origin] | None = None
) -> str:
    """The text of an oil file.

    **Arguments:**
    - `name`, `description`: texts for the reader of the file.
    - `header`: lines of comment at the top.
    - `origins`: name of a law -> its origin; other sources are marked as not known.

    **Raises:** `ValueError` for a law that files do not know.
    """
    named = {"name": one_line(name), "description": one_line(description)}
    return comments([*header, HEADER]) + toml_text(named | sourced_laws(oil, origins), aligned=False)


def sourced_laws(oil: Lubricant, origins: Mapping[str, Origin] | None = None) -> Rows:
    """The tables of the laws, with notes and the sources of the values.

    **Raises:** `ValueError` for a law that files do not know.
    """
    origins, laws = origins or {}, _laws(oil)
    notes = _notes(oil, laws, origins)
    for law, table in laws.items():
        sources = origins[law].sources if law in origins else {}
        texts = {key: one_line(sources.get(key, UNKNOWN_SOURCE)) for key in table if key != "law"}
        if len(texts) > 1 and len(set(texts.values())) == 1:
            texts = {"all": next(iter(texts.values()))}
        table |= {"note": one_line(notes[law])} if law in notes else {}
        table |= {"sources": texts} if texts else {}
    return laws


def _laws(oil: Lubricant) -> dict[str, Rows]:
    """Name of the law -> its table."""
    laws: dict[str, tuple[type[Law], object]] = {"viscosity": (_table(oil.viscosity, "viscosity"), oil.viscosity)}
    if not isinstance(oil.pressure_viscosity, NoPressureViscosity):
        law = oil.pressure_viscosity
        laws["pressure_viscosity"] = (_table(law, "pressure_viscosity"), law)
    if oil.rheology is not None:
        laws["rheology"] = (_table(oil.rheology, "rheology"), oil.rheology)
    for name, table in (
        ("density", LinearDensityTable),
        ("conductivity", LinearConductivityTable),
        ("heat_capacity", LinearHeatCapacityTable),
    ):
        if getattr(oil, name) is not None:
            laws[name] = (table, getattr(oil, name))
    return {name: {"law": _name_of(table)} | rows(table, law) for name, (table, law) in laws.items()}


def _table(law: object, name: str) -> type[Law]:
    if type(law) not in _TABLES:
        expected = f"a law that files know: a file cannot hold the law {type(law).__name__}"
        raise unwritable(f"oil.{name}", type(law).__name__, expected)
    return _TABLES[type(law)]


def _name_of(table: type[Law]) -> str:
    return typing.get_args(table.model_fields["law"].annotation)[0]


def _notes(oil: Lubricant, laws: Iterable[str], origins: Mapping[str, Origin]) -> dict[str, str]:
    """Name of a law -> its note. Notes that belong to no known law are added to the viscosity."""
    notes = {law: origins[law].note for law in laws if law in origins and origins[law].note}
    rest = [note for note in oil.notes if note not in (*notes.values(), *oil.viscosity.notes)]
    if rest:
        notes["viscosity"] = ". ".join([notes["viscosity"], *rest] if "viscosity" in notes else rest)
    return notes


def scene_oil(oil: Lubricant | None) -> Rows | None:
    """The table [oil] of a scene: the name in the catalogue and the differences from it, or all laws.

    **Raises:** `SceneError` for a law that files do not know.
    """
    if oil is None:
        return None
    whole = _laws(oil)
    _share_out_notes(oil, whole)
    whole = {law: _short(getattr(oil, law), table) for law, table in whole.items()}
    amended = (_amended(oil, named) for named in _catalogue(oil))
    # the fewest changes to an oil of the catalogue
    return min(filter(None, amended), key=_size, default=whole)


def _catalogue(oil: Lubricant) -> Iterator[Rows]:
    """Tables that name the oils of the catalogue of which this oil may be a variant."""
    yield from ({"name": name} for name in oil_names())
    if isinstance(oil.viscosity, WaltherPower):
        for base in bases():
            yield from ({"grade": grade, "base": base} for grade in grades(base))


def _size(table: Mapping[str, object]) -> int:
    return sum(_size(value) if isinstance(value, Mapping) else 1 for value in table.values())


def _amended(oil: Lubricant, named: Rows) -> Rows | None:
    """The table of a named oil with the differences; `None` if the viscosity differs or the table gives another oil."""
    base = lubricant(read_table(OilTable, with_catalogue(named), SCENE))
    if not same(base.viscosity, oil.viscosity):
        return None
    own, theirs = _laws(oil), _laws(base)
    amended: Rows = dict(named)
    for law, table in own.items():
        if same(getattr(oil, law), getattr(base, law)):
            continue
        alike = theirs.get(law, {}).get("law") == table["law"]
        changed = {key: value for key, value in table.items() if not alike or theirs[law].get(key) != value}
        amended[law] = _short(getattr(oil, law), table) if len(changed) == len(table) else changed
    return amended if _is_oil(amended, oil) else None


def _short(law: eqx.Module, table: Rows) -> object:
    """The value of a law that is a single number; other laws as their tables."""
    constant = isinstance(law, ConstantPressureViscosity)
    if isinstance(law, LinearDensity | LinearConductivity | LinearHeatCapacity):
        constant = same((law.slope, law.reference_temperature), (0.0, ROOM_TEMPERATURE))
    return table["value"] if constant and "note" not in table else table


def _is_oil(table: Rows, oil: Lubricant) -> bool:
    return same(lubricant(read_table(OilTable, with_catalogue(table), SCENE)), oil)


def _share_out_notes(oil: Lubricant, laws: dict[str, Rows]) -> None:
    """Distributes the notes over the tables of the laws in their order, if possible to laws that they name.

    A lubricant does not store to which law a note belongs.

    **Raises:** `SceneError` for more notes than laws.
    """
    notes, names = list(oil.notes[len(oil.viscosity.notes) :]), list(laws)
    if len(notes) > len(names):
        raise unwritable("oil.notes", f"{len(notes)} notes", f"at most {len(names)}, one for each law of the oil")
    while notes:
        name, left = names.pop(0), len(names)
        about = [law for law in names if law.replace("_", " ") in notes[0]]
        if left < len(notes) or not about:
            laws[name]["note"] = notes.pop(0)
