"""`--set path=value`: changes to the tables of a scene before it is validated."""

import re
import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

import jax
import numpy as np
from jax.core import Tracer
from pydantic import BaseModel

from ..materials import material_named
from ..numerics.structure import plain
from .errors import SceneError
from .fields import is_known, names_at
from .materials import MaterialTable, catalogue_table
from .oil.files import base_of
from .presets import Filling, filling
from .problems import describe_at, in_words, unknown_name
from .table import Table
from .words import describe

Overrides = Mapping[str, str | float | np.generic | np.ndarray | jax.Array]
"""Dotted path of a field -> value as typed by a user, or a number or truth value of Python, numpy or JAX."""
REMOVE = "none"
"""The value that removes an optional table or field from the scene."""
_NOT_QUITE_TOML = re.compile(r"[+-]?(?:\.[0-9]+|[0-9]+\.)(?:[eE][+-]?[0-9]+)?")


def split_assignments(assignments: Iterable[str]) -> dict[str, str]:
    """ "path=value" texts as a mapping, the later one prevailing.

    **Raises:** `SceneError` for a text of another form.
    """
    overrides: dict[str, str] = {}
    problems = []
    for text in assignments:
        path, equals, value = text.partition("=")
        path, value = path.strip(), value.strip()
        if not (equals and value and all(path.split("."))):
            expected = "path=value, e.g. operation.inner_speed='12000 rpm'"
            problems.append(SceneError("--set", path, f"'{text}'", expected))
        overrides[path] = value
    if problems:
        raise SceneError.of_all(problems)
    return overrides


def as_texts(overrides: Overrides | None) -> dict[str, str]:
    """Overrides as texts, as a user would type them; numbers and truth values of Python, numpy or JAX are converted.

    **Raises:** `SceneError` for a value of another kind.
    """
    texts = {}
    if not isinstance(overrides, Mapping | None):
        expected = "dotted paths with their values, e.g. {'operation.inner_speed': '12000 rpm'}"
        raise SceneError("overrides", "", describe(overrides), expected)
    for path, value in (overrides or {}).items():
        if not isinstance(path, str):
            raise SceneError("overrides", str(path), describe(path), "a dotted path, e.g. 'operation.inner_speed'")
        value = plain(value)
        if isinstance(value, bool):
            texts[path] = str(value).lower()
        elif isinstance(value, str | int | float):
            texts[path] = str(value)
        else:
            expected = "text as it would be typed ('12000 rpm'), or a plain number"
            actual = "a traced value" if isinstance(value, Tracer) else f"a {type(value).__name__}"
            raise SceneError("overrides", path, actual, expected)
    return texts


def parse_value(text: str) -> Any:
    """The value of a `--set`: read as TOML if possible (numbers, true, "quoted"), also numbers such as ".3" and "3.";
    otherwise the text itself."""
    if "\n" in text:
        return text
    if _NOT_QUITE_TOML.fullmatch(text):
        return float(text)
    try:
        return tomllib.loads(f"value = {text}")["value"]
    # ValueError: not TOML, or a number of thousands of digits
    except ValueError:
        return text


def apply(raw: Mapping[str, object], overrides: Mapping[str, str], model: type[BaseModel], file: str) -> dict[str, Any]:
    """A copy of the tables with the overrides. Unknown names are applied too; the validation refuses them later.

    **Raises:** `SceneError` if a path leads through a value that is not a table, or if an unknown name is to be
    removed.
    """
    changed, problems = applied(raw, overrides, model, file)
    if problems:
        raise SceneError.of_all(problems)
    return changed


def applied(
    raw: Mapping[str, object], overrides: Mapping[str, str], model: type[BaseModel], file: str
) -> tuple[dict[str, Any], list[SceneError]]:
    """A copy of the tables with the valid overrides and with the laws of a preset, and the errors of the other
    overrides; see `apply`."""
    filled, problems = preset(raw, overrides, model, file)
    return filled.tables, problems


def preset(
    raw: Mapping[str, object], overrides: Mapping[str, str], model: type[BaseModel], file: str
) -> tuple[Filling, list[SceneError]]:
    """Does what `applied` does, and also returns the entries that a preset adds to the tables."""
    changed, problems = _applied(raw, overrides, model, file)
    removed = tuple(path for path, text in overrides.items() if text == REMOVE)
    return filling(changed, removed, model, file), problems


def _applied(
    raw: Mapping[str, object], overrides: Mapping[str, str], model: type[BaseModel], file: str
) -> tuple[dict[str, Any], list[SceneError]]:
    changed, overrides = completed(model, _copy(raw, file), overrides, file)
    problems = []
    for path, text in overrides.items():
        keys = path.split(".")
        names = names_at(model, keys[:-1])
        others = names.about if text == REMOVE else names.instead
        _take_out(changed, keys[:-1], others.get(keys[-1], ()))
    for path, text in overrides.items():
        keys = path.split(".")
        try:
            if text == REMOVE:
                _remove(changed, keys, path, model, file)
                continue
            table = changed
            for depth, key in enumerate(keys[:-1]):
                table = _table(table.setdefault(key, {}), changed, keys[: depth + 1], path, file, text)
            table[keys[-1]] = parse_value(text)
        except SceneError as error:
            problems.append(error)
    return changed, problems


def completed(
    model: type[BaseModel], tables: dict[str, Any], overrides: Mapping[str, str], file: str
) -> tuple[dict[str, Any], Mapping[str, str]]:
    """See `Table.completed`."""
    return model.completed(tables, overrides, file) if issubclass(model, Table) else (tables, overrides)


def _take_out(changed: dict[str, object], inside: list[str], names: Iterable[str]) -> None:
    """Removes these fields from a table of the file; another override may set them again."""
    table: object = changed
    for key in inside:
        table = table.get(key) if isinstance(table, dict) else None
    for name in names:
        if isinstance(table, dict):
            table.pop(name, None)


def _remove(changed: dict[str, object], keys: list[str], path: str, model: type[BaseModel], file: str) -> None:
    """Removes a field or table. If it is absent, its name must at least be valid."""
    _keep_catalogue(changed, keys, path, file)
    table = changed
    for depth, key in enumerate(keys):
        if key not in table:
            wrong = next((n for n in range(depth + 1, len(keys) + 1) if not is_known(model, keys[:n])), None)
            if wrong is not None:
                raise in_words(file, ".".join(keys[:wrong]), unknown_name(keys[:wrong], model))
            return
        if depth == len(keys) - 1:
            del table[key]
        else:
            table = _table(table[key], changed, keys[: depth + 1], path, file)


def _keep_catalogue(changed: Mapping[str, object], keys: list[str], path: str, file: str) -> None:
    """Refuses to remove data that the name, grade or file of the oil would supply again. **Raises:** `SceneError`."""
    oil = changed.get("oil")
    if len(keys) < 2 or keys[0] != "oil" or keys[1] in ("name", "grade", "base", "file") or not isinstance(oil, dict):
        return
    entry: object = base_of(oil)
    for key in keys[1:]:
        entry = entry.get(key) if isinstance(entry, dict) else None
    if entry is not None:
        named = {"name": "the catalogue's", "grade": "the standard oil", "file": "the oil file"}
        whose = next(f"{words} {oil[key]}" for key, words in named.items() if key in oil)
        expected = f"another value: {whose} has one, and comes back without yours"
        raise SceneError(file, path, f"'{REMOVE}'", expected)


def _table(
    value: object, changed: Mapping[str, object], inside: list[str], path: str, file: str, text: str = ""
) -> dict[str, Any]:
    if isinstance(value, dict):
        return value
    place = ".".join(inside)
    expected = "a table, to set a value in it"
    name, last = material_named(str(value)), path.removeprefix(f"{place}.")
    if name is not None and last in MaterialTable.model_fields and text:
        changes = catalogue_table(name) | {last: text}
        entries = ", ".join(f"{field} = {_as_toml(change)}" for field, change in changes.items())
        expected = f"a table: {place}={{{entries}}} is {name} with this value"
    raise SceneError(file, path, f"{describe_at(changed, place)} at {place}", expected)


def _as_toml(text: str) -> str:
    """A value as written in a TOML file: a number, or a text in quotes."""
    return text if isinstance(parse_value(text), int | float) else f'"{text}"'


MOST_DEEP = 20
"""Largest depth of nested tables in a scene; valid scenes have at most five levels."""


def _copy(table: Mapping[str, object], file: str, above: tuple[str, ...] = ()) -> dict[str, object]:
    """A copy of the tables with plain values. **Raises:** `SceneError` for tables that are nested too deeply."""
    if len(above) > MOST_DEEP:
        raise SceneError(file, ".".join(above), "a table nested too deeply", f"at most {MOST_DEEP} levels of tables")
    return {
        key: _copy(value, file, (*above, str(key))) if isinstance(value, Mapping) else _plain(value)
        for key, value in table.items()
    }


def _plain(value: object) -> Any:
    """A value of a table, or a list of values, with numbers of numpy or JAX converted to those of Python."""
    return [plain(entry) for entry in value] if isinstance(value, list) else plain(value)
