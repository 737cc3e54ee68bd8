"""Converts the tables of a shaft's file: lists become tables by name, and scenes of bearings are read.

In a file, bearings, sets and forces are lists of tables, each with a `name`, and the sections of the shaft are a list.
Here they become tables by name, so that a dotted path such as `bearing.rear.position` finds them. The scene that a
bearing names (a file or a built-in scene) is replaced by its tables.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from ..data_files import builtin_names
from ..errors import SceneError, nearest, one_of
from ..fields import plain_table_at
from ..kinds import kind_named, kind_refused
from ..table import Table
from ..words import describe
from .members import MEMBERS, at, changed, numbered, put

LISTS = {"bearing": "rear", "set": "front", "force": "pinion"}
"""Tables of a shaft's file that are lists with names -> example of a name."""
NAME, SCENE, SECTIONS = "name", "scene", "sections"
BEARINGS = ("ball_bearing", "cylindrical_roller_bearing", "tapered_roller_bearing")
"""Kinds of bearing scenes that a shaft may have."""
LINEAR = "linear"
"""Kind of a bearing that is described by its stiffness only."""
OF_SHAFT = ("oil_temperature", "oil_flow", "outer_speed")
"""Fields of the operating point that a bearing keeps on a shaft; loads and inner speed follow from the shaft."""
OF_MOUNT = (
    *("position", "thrust", "closure", "expansion", "support"),
    *("picture", "distance", "preload", "mismatch"),
)
"""Fields of an entry that describe position and mounting of the bearing."""
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_MEANT = "a name of letters, digits, _ and -, beginning with a letter, e.g. {example!r}"
_TAKEN = "another name: this one means something to the program"

Read = Callable[[str], dict[str, Any]]
"""Function that reads the tables of a bearing's scene, from a file or a built-in scene."""


def named(mapping: Mapping[str, Any], label: str) -> dict[str, Any]:
    """The tables of a shaft with lists converted to tables by name; existing tables by name are unchanged.

    **Arguments:** `label`: name of the file, for messages.

    **Raises:** `SceneError` with all errors in the names.
    """
    problems: list[SceneError] = []
    tables = dict(mapping)
    for table, example in LISTS.items():
        if table in tables:
            try:
                tables[table] = _by_name(tables[table], table, example, label)
            except SceneError as error:
                problems += error.problems
    for name, entry in tables["set"].items() if isinstance(tables.get("set"), dict) else ():
        try:
            tables["set"] = {**tables["set"], name: numbered(entry, f"set.{name}", label)}
        except SceneError as error:
            problems += error.problems
    shaft = tables.get("shaft")
    if isinstance(shaft, Mapping) and isinstance(shaft.get(SECTIONS), list):
        tables["shaft"] = {**shaft, SECTIONS: {str(i + 1): section for i, section in enumerate(shaft[SECTIONS])}}
    problems += _shared_names(tables, label)
    if problems:
        raise SceneError.of_all(problems)
    return tables


def _by_name(entries: object, table: str, example: str, label: str) -> dict[str, Any]:
    """A list of tables as tables by name. **Raises:** `SceneError` if it is no list of tables, and for names that are
    invalid or not unique."""
    if isinstance(entries, Mapping) and all(isinstance(inner, Mapping) for inner in entries.values()):
        for name in entries:
            if not _NAME.fullmatch(str(name)):
                raise SceneError(label, table, describe(name), _MEANT.format(example=example))
            if _is_taken(str(name)):
                raise SceneError(label, f"{table}.{name}", f"the name '{name}'", _TAKEN)
        return {str(name): dict(inner) for name, inner in entries.items()}
    if not isinstance(entries, list) or not all(isinstance(inner, Mapping) for inner in entries):
        there = "one table" if isinstance(entries, Mapping) else describe(entries)
        raise SceneError(label, table, there, f'[[{table}]] tables in double brackets, each with name = "{example}"')
    by_name: dict[str, Any] = {}
    problems = []
    for place, entry in enumerate(entries):
        name = entry.get(NAME, _default_name(entry, table, by_name))
        at = f"{table}[{place}].{NAME}"
        if not isinstance(name, str) or not _NAME.fullmatch(name):
            problems.append(SceneError(label, at, describe(name), _MEANT.format(example=example)))
        elif _is_taken(name):
            problems.append(SceneError(label, at, f"the name '{name}'", _TAKEN))
        elif name in by_name:
            problems.append(SceneError(label, at, f"'{name}' twice", "a name of its own for each"))
        else:
            by_name[name] = {key: value for key, value in entry.items() if key != NAME}
    if problems:
        raise SceneError.of_all(problems)
    return by_name


def _is_taken(name: str) -> bool:
    """True for a name that is an attribute of `Table`, such as `checks`."""
    return hasattr(Table, name) or name.startswith("model_")


def _default_name(entry: Mapping[str, object], table: str, taken: Mapping[str, object]) -> str:
    """A name for a table without one: the kind of a force, otherwise the word of the list, with a number if needed."""
    kind = entry.get("kind")
    base = kind if table == "force" and isinstance(kind, str) and _NAME.fullmatch(kind) else table
    return next(name for i in range(1, len(taken) + 2) if (name := base if i == 1 else f"{base}_{i}") not in taken)


def _shared_names(tables: Mapping[str, Any], label: str) -> Iterator[SceneError]:
    """Problems with names that a bearing and a set share; results need different names."""
    bearings, sets = (tables.get(table) for table in ("bearing", "set"))
    if isinstance(bearings, Mapping) and isinstance(sets, Mapping):
        for name in sets:
            if name in bearings:
                yield SceneError(label, f"set.{name}", f"the name '{name}' of a bearing", "a name of its own")


def beside(mapping: Mapping[str, object], folder: Path) -> dict[str, Any]:
    """The tables of a shaft's file in `folder`, by name, with paths made relative to the working folder."""
    return changed(mapping, lambda _, entry: _moved(entry, folder))


def _moved(entry: Mapping[str, object], folder: Path) -> dict[str, Any]:
    moved = dict(entry)
    scene, oil = entry.get(SCENE), entry.get("oil")
    if isinstance(scene, str) and scene not in builtin_names():
        moved[SCENE] = str(folder / scene)
    if isinstance(oil, Mapping) and isinstance(oil.get("file"), str):
        moved["oil"] = {**oil, "file": str(folder / oil["file"])}
    return moved


def read_scenes(mapping: Mapping[str, object], label: str, read: Read) -> dict[str, Any]:
    """The tables of a shaft, by name, with each name of a bearing's scene replaced by the tables of this scene.

    **Raises:** `SceneError` for a file that cannot be read, and for a scene that is not a bearing.
    """

    def with_tables(keys: tuple[str, ...], entry: object) -> object:
        if not isinstance(entry, Mapping) or not isinstance(entry.get(SCENE), str):
            return entry
        return {**entry, SCENE: bearing_scene(entry[SCENE], ".".join((*keys, SCENE)), label, read)}

    return changed(mapping, with_tables)


def bearing_scene(source: str, path: str, label: str, read: Read) -> dict[str, object]:
    """The tables of a bearing's scene without its loads and speeds.

    **Arguments:** `path`: path of the field that names the scene; `label`: name of the shaft's file.

    **Raises:** `SceneError` for a file that cannot be read, and for a scene that is not a bearing.
    """
    tables = read(source)
    kind = kind_named(tables.get("kind"))
    if kind not in BEARINGS:
        actual = f"'{source}', whose kind is {describe(tables.get('kind'))}"
        raise SceneError(label, path, actual, f"the scene of a bearing: kind {one_of(BEARINGS)}")
    return without_loads({**tables, "kind": kind})


def with_scenes(
    mapping: Mapping[str, object], overrides: Mapping[str, str], label: str
) -> tuple[dict[str, Any], dict[str, str]]:
    """The tables of a shaft, by name, with names of scenes replaced by the tables of these scenes, also for scenes that
    an override names. Also returns the remaining overrides.

    **Raises:** `SceneError` as `named` and `read_scenes`.
    """
    from ..overrides import parse_value
    from ..reader import tables_of_file

    tables, left = named(mapping, label), {}
    for path, text in overrides.items():
        if path == f"shaft.{SECTIONS}" and isinstance(tables.get("shaft"), Mapping) and text != REMOVE:
            tables = named({**tables, "shaft": {**tables["shaft"], SECTIONS: parse_value(text)}}, label)
            continue
        keys = tuple(path.split("."))
        entry = at(tables, keys[:-1]) if _names_a_scene(keys) and text != REMOVE else None
        if isinstance(entry, Mapping):
            # the new scene replaces a bearing whose tables are in the entry itself
            kept = entry if SCENE in entry else {key: value for key, value in entry.items() if key in OF_MOUNT}
            scenes = parse_value(text)
            other = {**kept, SCENE: scenes if isinstance(scenes, list) else text}
            tables = put(tables, keys[:-1], numbered(other, ".".join(keys[:-1]), label) if keys[0] == "set" else other)
        else:
            left[path] = text
    return read_scenes(tables, label, tables_of_file), left


def _names_a_scene(keys: tuple[str, ...]) -> bool:
    """True for the path of the scene of a bearing, of a set, or of one bearing of a set."""
    member = len(keys) == 5 and keys[0] == "set" and keys[2] == MEMBERS
    return keys[-1] == SCENE and (member or (len(keys) == 3 and keys[0] in ("bearing", "set")))


REMOVE = "none"
"""The value that removes an optional table or field of a bearing's scene."""
_WHOLE_OIL = ("name", "grade", "base", "file")
"""Fields with which the oil of an entry replaces the whole oil of the scene."""


def merged(scene: Mapping[str, Any], own: Mapping[str, object], table: type[BaseModel] | None) -> dict[str, Any]:
    """The tables of a bearing's scene with the changes from its entry in the shaft's file.

    **Arguments:** `scene`: tables of the scene; `own`: entry; `table`: their schema, if known.
    """
    tables = dict(scene)
    instead = getattr(table, "instead", {})
    for name in own:
        for other in instead.get(name, ()):
            tables.pop(other, None)
    for name, value in own.items():
        there = tables.get(name)
        if value == REMOVE and name != NAME:
            tables.pop(name, None)
        elif not (isinstance(there, Mapping) and isinstance(value, Mapping)):
            tables[name] = value
        elif name == "oil" and any(key in value for key in _WHOLE_OIL):
            tables[name] = dict(value)
        else:
            inner = None if table is None else plain_table_at(table, name)
            tables[name] = merged(there, value, inner)
    return tables


def without_loads(tables: Mapping[str, object]) -> dict[str, object]:
    """The tables of a bearing without loads and speeds, which follow from the shaft, and without transient run and load
    spectrum, which only single bearings have."""
    kept = {name: value for name, value in tables.items() if name not in ("simulation", "state")}
    operation = kept.get("operation")
    if isinstance(operation, Mapping):
        kept["operation"] = {name: value for name, value in operation.items() if name in OF_SHAFT}
    return kept


def kind_of(entry: Mapping[str, object], path: str, label: str) -> str:
    """The kind of the bearing of an entry: its own, or that of its scene.

    **Raises:** `SceneError` for a missing or unknown kind.
    """
    known = (*BEARINGS, LINEAR)
    scene = entry.get(SCENE)
    word = entry.get("kind", scene.get("kind") if isinstance(scene, Mapping) else None)
    kind = kind_named(word)
    if kind in known:
        return str(kind)
    if word is None:
        expected = "the scene of a bearing, a file or a built-in one; or a kind with its tables, such as geometry"
        near = next((key for key in entry if key != SCENE and nearest(str(key), (SCENE, "kind"))), "")
        actual = f"the unknown name {near!r}" if near else "nothing"
        raise SceneError(label, f"{path}.{SCENE}", actual, expected, nearest(near, (SCENE, "kind")) if near else "")
    actual, near = kind_refused(word, known)
    raise SceneError(label, f"{path}.kind", actual, one_of(known), near)
