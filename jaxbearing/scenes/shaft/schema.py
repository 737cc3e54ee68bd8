"""The schema of the scene file of a shaft.

The schema of a file has a field for each of its bearings, sets, forces and sections, with the schema of its kind.
`shaft_model` makes it. `ShaftTable` holds the fields that all files have.
"""

import functools
import operator
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import create_model

from ...shafts.forces import FORCES
from ...shafts.scene import ShaftSystem
from ..drafts import Unreadable
from ..errors import SceneError, nearest, one_of
from ..kinds import KIND, kind_named
from ..table import Table
from ..words import describe
from .files import (
    BEARINGS,
    LINEAR,
    REMOVE,
    SCENE,
    SECTIONS,
    kind_of,
    merged,
    with_scenes,
    without_loads,
)
from .members import MEMBERS, changed, differ
from .tables import (
    FAMILIES,
    FORCE_TABLES,
    BearingEntry,
    HousingTable,
    LifeTable,
    MemberEntry,
    SectionTable,
    SetEntry,
    SetMountTable,
    ShaftPart,
    ShaftThermalTable,
    StateTable,
    member_table,
    mounted_table,
)

Kind = str | tuple[str, ...]
"""Kind of all bearings of a set, or kinds of its different bearings."""


def _kind_of_force(entry: Mapping[str, object], path: str, file: str) -> str:
    """The kind of a force. **Raises:** `SceneError` for an entry without a known kind."""
    kind = entry.get("kind")
    if isinstance(kind, str) and kind in FORCES:
        return kind
    near = nearest(kind, FORCES) if isinstance(kind, str) else ""
    raise SceneError(file, f"{path}.kind", "nothing" if kind is None else describe(kind), one_of(FORCES), near)


def with_kind(entry: object, kind: str | None) -> dict[str, Any]:
    """An entry with its kind replaced by that of an override, if there is one."""
    own = dict(entry) if isinstance(entry, Mapping) else {}
    return own if kind is None else {**own, "kind": kind}


def _with_scene(entry: object, keys: tuple[str, ...], file: str) -> object:
    """An entry merged with the tables of its scene. **Raises:** `SceneError` if its kind differs from the scene's."""
    if not isinstance(entry, Mapping) or not isinstance(entry.get(SCENE), Mapping):
        return entry
    scene, own = entry[SCENE], {key: value for key, value in entry.items() if key != SCENE}
    kind = kind_named(scene.get("kind"))
    if "kind" in own and kind_named(own["kind"]) != kind:
        expected = f"none beside the scene, whose kind is '{kind}'"
        raise SceneError(file, ".".join((*keys, "kind")), describe(own["kind"]), expected)
    scene = without_loads({**scene, "kind": kind})
    if kind not in FAMILIES:
        return merged(scene, own, None)
    of_set = keys[0] == "set"
    return merged(scene, own, member_table(kind) if len(keys) > 2 else mounted_table(kind, of_set))


def _kinds_of_set(entry: Any, path: str, file: str) -> Kind:
    """The kinds of the bearings of a set. **Raises:** `SceneError` for an unknown kind and for the kind linear."""
    if not differ(entry):
        each: tuple[tuple[str, Any], ...] = ((path, entry),)
    else:
        each = tuple((f"{path}.{MEMBERS}.{number}", table) for number, table in entry[MEMBERS].items())
    kinds = tuple(kind_of(table, at, file) for at, table in each)
    for (at, _), kind in zip(each, kinds, strict=True):
        if kind == LINEAR:
            raise SceneError(file, f"{at}.kind", f"'{LINEAR}'", one_of(BEARINGS))
    return kinds if differ(entry) else kinds[0]


ANY_NAME, NUMBER = "NAME", "NUMBER"
"""Placeholders for a name and for the number of a section or bearing, in lists of fields."""
_ANY_FORCE: Any = functools.reduce(operator.or_, FORCE_TABLES.values())


class ShaftTable(Table):
    """The whole file without its bearings, sets, forces and states."""

    kind: Annotated[Literal["shaft"], KIND]
    shaft: ShaftPart
    housing: HousingTable | None = None
    thermal: ShaftThermalTable | None = None
    life: LifeTable | None = None

    @classmethod
    def example(cls) -> type[Table]:
        fields: dict[str, Any] = {
            "shaft": (_with_sections((NUMBER,)), ...),
            "bearing": (_by_name("bearing", {ANY_NAME: BearingEntry}) | None, None),
            "set": (_by_name("set", {ANY_NAME: _any_set()}) | None, None),
            "force": (_by_name("force", {ANY_NAME: _ANY_FORCE}) | None, None),
            "state": (StateTable | None, None),
        }
        made: Any = create_model("AnyShaftTable", __base__=ShaftTable, __module__=__name__, **fields)
        return made

    @classmethod
    def of_file(cls, tables: Mapping[str, object], overrides: Mapping[str, str], file: str) -> type[Table]:
        known, left = with_scenes(tables, overrides, file)
        kinds: dict[str, Any] = {}
        for word, kind_in in (("bearing", kind_of), ("set", _kinds_of_set), ("force", _kind_of_force)):
            entries = known.get(word)
            there = {
                name: with_kind(entry, left.get(f"{word}.{name}.kind"))
                for name, entry in (entries.items() if isinstance(entries, Mapping) else ())
                if left.get(f"{word}.{name}") != REMOVE
            }
            kinds[word] = tuple((name, kind_in(entry, f"{word}.{name}", file)) for name, entry in there.items())
        sections = known["shaft"].get(SECTIONS) if isinstance(known.get("shaft"), Mapping) else None
        removed = left.get(f"shaft.{SECTIONS}") == REMOVE
        numbers = tuple(sections) if isinstance(sections, Mapping) and not removed else ()
        left_in = tuple(name for name in numbers if left.get(f"shaft.{SECTIONS}.{name}") != REMOVE)
        return shaft_model(kinds["bearing"], kinds["set"], kinds["force"], left_in)

    @classmethod
    def completed(
        cls, tables: Mapping[str, object], overrides: Mapping[str, str], file: str
    ) -> tuple[dict[str, Any], Mapping[str, str]]:
        complete, left = with_scenes(tables, overrides, file)
        return changed(complete, lambda keys, entry: _with_scene(entry, keys, file)), left

    def entries(self, table: str) -> dict[str, Any]:
        """The tables of the bearings, sets, forces or sections, by name. **Arguments:** `table`: which of these."""
        owner = self.shaft if table == SECTIONS else self
        group = getattr(owner, table, None)
        if not isinstance(group, Table | None):
            raise Unreadable(table)
        return {} if group is None else {name: getattr(group, name) for name in type(group).model_fields}


def _by_name(word: str, tables: Mapping[str, object]) -> Any:
    """A schema with a table for each name. **Arguments:** `word`: name of the list in files."""
    doc = f"""Tables by name.

    - `{ANY_NAME}`: one for each, under its name; in a file each is a table [[{word}]] with a `name`
    - `{NUMBER}`: one for each, numbered from 1
    """
    fields: Any = {name: (table, ...) for name, table in tables.items()}
    return create_model(f"{word.capitalize()}Tables", __base__=Table, __module__=__name__, __doc__=doc, **fields)


def _any_set() -> type[Table]:
    """The schema of a set for lists of fields, which belongs to no file."""
    fields: dict[str, Any] = {MEMBERS: (_by_name("members", {NUMBER: MemberEntry}) | None, None)}
    return create_model("SetEntry", __base__=SetEntry, __module__=__name__, __doc__=SetEntry.__doc__, **fields)


def _with_sections(names: tuple[str, ...]) -> Any:
    parts = _by_name(SECTIONS, dict.fromkeys(names, SectionTable))
    fields: Any = {SECTIONS: (parts | None, None)}
    return create_model("ShaftPart", __base__=ShaftPart, __module__=__name__, __doc__=ShaftPart.__doc__, **fields)


@functools.lru_cache(64)
def shaft_model(
    bearings: tuple[tuple[str, str], ...],
    sets: tuple[tuple[str, Kind], ...],
    forces: tuple[tuple[str, str], ...],
    sections: tuple[str, ...],
) -> type[ShaftTable]:
    """The schema of a file with these bearings, sets and forces, each by name and kind, and with these sections."""
    tables: dict[str, dict[str, type[Table]]] = {
        "bearing": {name: mounted_table(kind, False) for name, kind in bearings},
        "set": {name: mounted_table(kind, True) if isinstance(kind, str) else _mixed_set(kind) for name, kind in sets},
        "force": {name: FORCE_TABLES[kind] for name, kind in forces},
    }
    fields: dict[str, Any] = {word: (_by_name(word, named) | None, None) for word, named in tables.items()}
    if sections:
        fields["shaft"] = (_with_sections(sections), ...)
    made: Any = create_model("ShaftFileTable", __base__=ShaftTable, __module__=__name__, **fields)
    return made


@functools.lru_cache(64)
def _mixed_set(kinds: tuple[str, ...]) -> type[Table]:
    """The schema of a set with different bearings."""
    numbers = {str(place + 1): member_table(kind) for place, kind in enumerate(kinds)}
    fields: Any = {MEMBERS: (_by_name("members", numbers), ...)}
    doc = "A set of different bearings."
    return create_model("MixedSetTable", __base__=SetMountTable, __module__=__name__, __doc__=doc, **fields)


def model_of_scene(scene: ShaftSystem) -> type[ShaftTable]:
    """The schema of the file of a shaft."""
    bearings = tuple((bearing.name, bearing.scene.kind) for bearing in scene.bearings)
    kinds = lambda matched: (
        tuple(each.kind for each in matched.scene) if isinstance(matched.scene, tuple) else matched.scene.kind
    )
    sets = tuple((matched.name, kinds(matched)) for matched in scene.sets)
    forces = tuple((force.name, force.kind) for force in scene.forces)
    return shaft_model(bearings, sets, forces, tuple(str(i + 1) for i in range(len(scene.shaft.sections))))
