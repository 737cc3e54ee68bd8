"""Parts of a scene as tables of a scene file: the way back from the `build` modules, exact to the last bit.

Fields that a file cannot hold are refused; the error names the field.
"""

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import equinox as eqx
import numpy as np

from ..materials import CATALOGUE, Material, catalogue_material
from ..time_laws import Tabulated
from . import units
from .errors import SceneError, one_of
from .fields import plain_table_at
from .laws import ENTRY_POINTS, Laws
from .materials import MaterialTable
from .quantity_texts import quantity_text
from .table import Table
from .words import shortened

Rows = dict[str, Any]
"""A table: name -> text with a unit, number, word, list or inner table."""
_MANY = 1000
"""Largest number of rows for which the shortest unit is chosen for each time; longer tables have s."""
SCENE = "scene"
"""The name of the scene in refusals, before the file is known."""


def unwritable(path: str, found: str, expected: str) -> SceneError:
    """The error for a field that a file cannot hold."""
    return SceneError(SCENE, path, found, expected)


def given(tables: Mapping[str, object]) -> Rows:
    """The tables and fields without those that are `None`."""
    return {name: value for name, value in tables.items() if value is not None}


def rows(table: type[Table], part: object, thermal: bool = False) -> Rows:
    """The given fields of a part that its table takes from the class (`table_of`), its materials, and its inner parts
    with tables of their own. Laws are left out: the callers know their names.

    **Arguments:** `thermal`: True if the materials have thermal properties.
    """
    entries: Rows = {}
    for name in table.model_fields:
        owner, own = table.made_from.get(name, (type(part), name))
        value = getattr(part, own, None) if isinstance(part, owner) else None
        if value is None:
            continue
        inner = plain_table_at(table, name)
        if name in table.made_from:
            entries[name] = written(part, own)
        elif isinstance(value, Material):
            entries[name] = material(value, thermal)
        elif inner is not None:
            entries[name] = rows(inner, value, thermal)
    return entries


def all_rows(part: eqx.Module) -> Rows:
    """All given fields of a part, by their names in its class."""
    return given({field.name: written(part, field.name) for field in dataclasses.fields(part)})


def written(part: Any, name: str) -> Any:
    """The value of a field of a part, as written in a file."""
    value = getattr(part, name)
    metadata = next(field.metadata for field in dataclasses.fields(part) if field.name == name)
    if "bound" in metadata:
        return number(value, metadata["unit"], metadata["difference"])
    if "each" in metadata:
        values = [number(entry, metadata["unit"]) for entry in np.asarray(value)]
        return values[0] if len(values) == 1 else values
    return value


def number(value: object, unit: str, difference: bool = False) -> float | str:
    """A number as written in a file: plain, or as a text with a unit. **Arguments:** as for `units.number_note`."""
    plain = float(np.asarray(value))
    return plain if unit == "1" else quantity_text(plain, units.dimension_of_unit(unit, difference))


def table_rows(law: Tabulated) -> Rows:
    """The table of a factor over time: times and factors."""
    times, factors = np.asarray(law.times).tolist(), np.asarray(law.factors).tolist()
    # the search for the shortest unit would take most of the time
    text = (lambda time: number(time, "s")) if len(times) <= _MANY else (lambda time: f"{time!r} s")
    return {"times": [text(time) for time in times], "factors": factors}


def material(part: Material, thermal: bool = False) -> str | Rows:
    """The name in the catalogue, or a table. **Arguments:** `thermal`: True if a name stands for a material with
    thermal properties."""
    named = (name for name in CATALOGUE if same(catalogue_material(name, thermal=thermal), part))
    return next(named, rows(MaterialTable, part))


def law_name(laws: Laws[Any], law: object, path: str, made: Callable[[str], object] | None = None) -> str:
    """The name by which files know a law.

    **Arguments:** `path`: path of the law in the scene, for messages; `made`: function that makes the law of a name,
    if `laws` alone cannot.

    **Raises:** `SceneError` for a law without a name, and for a law with other numbers than the named one.
    """
    for name in laws.every():
        try:
            candidate = (made or (lambda key: laws[key]()))(name)
        except Exception:  # whatever the class of another package raises
            continue
        if same(candidate, law):
            return name
    expected = f"a law that a file has a name for: {one_of(laws)}, or that of an entry point of '{ENTRY_POINTS}'"
    raise unwritable(path, shown(law), expected)


def optional_law(laws: Laws[Any], law: object, absent: object, path: str) -> str | None:
    """The name of a law; `None` for the law `absent`, which is that of a file without a name."""
    return None if same(law, absent) else law_name(laws, law, path)


def shown(value: object) -> str:
    """A value or part of a scene on one line, for messages."""
    return shortened(" ".join(repr(value).split()))


def same(part: object, other: object) -> bool:
    """True if two parts are of the same classes and hold the same values, numbers to the last bit."""
    return next(differences(part, other), None) is None


def differences(part: object, other: object, path: str = "") -> Iterator[tuple[str, Any, Any]]:
    """Dotted path and both values of each difference between two parts."""
    if isinstance(part, eqx.Module) and type(part) is type(other):
        for field in dataclasses.fields(part):
            inside = f"{path}.{field.name}".lstrip(".")
            yield from differences(getattr(part, field.name), getattr(other, field.name), inside)
    elif isinstance(part, tuple) and isinstance(other, tuple) and len(part) == len(other):
        for i, (mine, yours) in enumerate(zip(part, other, strict=True)):
            yield from differences(mine, yours, f"{path}.{i}".lstrip("."))
    elif not _alike(part, other):
        yield path, part, other


def _alike(leaf: Any, other: Any) -> bool:
    if eqx.is_array_like(leaf) and eqx.is_array_like(other):
        if isinstance(leaf, bool) or isinstance(other, bool):
            return leaf is other
        bits = [np.asarray(value, dtype=np.float64) for value in (leaf, other)]
        return bits[0].shape == bits[1].shape and bits[0].tobytes() == bits[1].tobytes()
    return type(leaf) is type(other) and bool(leaf == other)
