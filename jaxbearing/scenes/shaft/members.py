"""Sets with different bearings. A file gives a list of scenes or tables [[set.bearing]], one for each bearing.

Internally they are tables by number, from 1, in the table `bearing`.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ..errors import SceneError
from ..words import describe

MEMBERS = "bearing"
"""Table of a set that holds its bearings by number."""
_SCENE = "scene"
_LIST = "[[set.bearing]] tables in double brackets, one for each sign of the picture, each with a scene or a kind"


def numbered(entry: object, path: str, label: str) -> Any:
    """The entry of a set with its different bearings as tables by number; other entries are unchanged.

    **Arguments:** `path`: path of the entry; `label`: name of the file, for messages.

    **Raises:** `SceneError` for a value that is no list of scenes or tables.
    """
    if not isinstance(entry, Mapping):
        return entry
    scenes, bearings = entry.get(_SCENE), entry.get(MEMBERS)
    if isinstance(scenes, list):
        wrong = next((scene for scene in scenes if not isinstance(scene, str)), None)
        if wrong is not None or not scenes:
            actual = describe(wrong) if scenes else "an empty list"
            raise SceneError(label, f"{path}.{_SCENE}", actual, "a scene, or a list of scenes, one for each sign")
        if not isinstance(bearings, Mapping | None):
            raise SceneError(
                label, f"{path}.{MEMBERS}", "a list beside a list of scenes", "tables by number: [set.bearing.2]"
            )
        entry = {name: value for name, value in entry.items() if name != _SCENE}
        by_number = {str(place + 1): {_SCENE: scene} for place, scene in enumerate(scenes)}
        own = {number: table for number, table in (bearings or {}).items() if isinstance(table, Mapping)}
        members = {number: {**own.get(number, {}), **table} for number, table in by_number.items()}
        bearings = members | {number: table for number, table in (bearings or {}).items() if number not in members}
        entry = {**entry, MEMBERS: bearings}
    if isinstance(bearings, list):
        if not bearings or not all(isinstance(table, Mapping) for table in bearings):
            raise SceneError(label, f"{path}.{MEMBERS}", describe(bearings), _LIST)
        return {**entry, MEMBERS: {str(place + 1): dict(table) for place, table in enumerate(bearings)}}
    tables = isinstance(bearings, Mapping) and all(isinstance(table, Mapping) for table in bearings.values())
    if bearings is not None and not tables:
        raise SceneError(label, f"{path}.{MEMBERS}", describe(bearings), _LIST)
    return entry


def differ(entry: object) -> bool:
    """True for the entry of a set with different bearings."""
    return isinstance(entry, Mapping) and isinstance(entry.get(MEMBERS), Mapping)


def each_bearing(tables: Mapping[str, object]) -> Iterator[tuple[str, ...]]:
    """The keys of all bearing tables of a shaft, whose tables are by name."""
    for word in ("bearing", "set"):
        entries = tables.get(word)
        for name, entry in entries.items() if isinstance(entries, Mapping) else ():
            if word == "set" and differ(entry):
                yield from ((word, name, MEMBERS, number) for number in entry[MEMBERS])
            elif isinstance(entry, Mapping):
                yield word, name


def at(tables: Mapping[str, object], keys: tuple[str, ...]) -> Any:
    """The table at these keys; `None` where there is none."""
    table: Any = tables
    for key in keys:
        table = table.get(key) if isinstance(table, Mapping) else None
    return table


def put(tables: Mapping[str, Any], keys: tuple[str, ...], value: object) -> dict[str, Any]:
    """A copy of the tables with `value` at these keys."""
    if len(keys) == 1:
        return {**tables, keys[0]: value}
    return {**tables, keys[0]: put(tables[keys[0]], keys[1:], value)}


def changed(tables: Mapping[str, object], change: Callable[[tuple[str, ...], Any], Any]) -> dict[str, Any]:
    """A copy of the tables of a shaft with the table of each bearing changed.

    **Arguments:** `change`: (keys of the bearing's table, table) -> new table.

    **Raises:** `SceneError` with all errors from `change`.
    """
    copied, problems = dict(tables), []
    for keys in each_bearing(tables):
        try:
            copied = put(copied, keys, change(keys, at(tables, keys)))
        except SceneError as error:
            problems += error.problems
    if problems:
        raise SceneError.of_all(problems)
    return copied
