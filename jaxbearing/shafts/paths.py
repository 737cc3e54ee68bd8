"""Dotted paths of the numbers of a shaft, as scene files have them: `bearing.rear.position`,
`bearing.rear.geometry.diametral_clearance`, `set.front.preload.force`, `force.pinion.torque`,
`shaft.sections.2.outer_diameter`. Bearings, sets and forces are found by their names, sections by their numbers from 1.
Different bearings of a set are numbered from 1 too: `set.front.bearing.2.geometry.n_balls`.
"""

import dataclasses
import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import equinox as eqx

from .._scene import _replaced
from ..numerics.arguments import did_you_mean

if TYPE_CHECKING:
    from .scene import ShaftSystem

Bearing = TypeVar("Bearing")
LISTS = {"bearing": "bearings", "set": "sets", "force": "forces"}
"""First word of a path -> field of `ShaftSystem` that it refers to."""
_BEARING = "scene"
"""Field of a mounted bearing, or of a set, that holds the bearing; paths leave it out."""
NUMBERED = "bearing"
"""Word of a path before the number of a bearing in a set of different bearings."""
_Changes = dict[tuple[str, ...], Any]


def replaced(system: "ShaftSystem", changes: object) -> "ShaftSystem":
    """A copy of a `ShaftSystem` with other values.

    **Arguments:** `changes`: dotted path -> value in SI, or a part.

    **Raises:** `AttributeError` for a path that the system does not have; `TypeError` if `changes` is no mapping.
    """
    if not isinstance(changes, Mapping) or not all(isinstance(path, str) for path in changes):
        raise TypeError(f"replace takes a mapping from dotted paths to values, got {changes!r}")
    plain: _Changes = {}
    named: dict[tuple[str, str], _Changes] = {}
    for path, value in changes.items():
        keys = tuple(path.split("."))
        if keys[0] in LISTS and len(keys) > 2:
            named.setdefault((keys[0], keys[1]), {})[keys[2:]] = value
        elif keys[:2] == ("shaft", "sections") and len(keys) > 3:
            named.setdefault(("section", keys[2]), {})[keys[3:]] = value
        else:
            plain[keys] = value
    lists: dict[str, Any] = {}
    for (word, name), inner in named.items():
        field = LISTS.get(word, "sections")
        entries = list(lists.get(field) or entries_of(system, word))
        place = _place(system, word, name)
        entries[place] = _changed(entries[place], inner, f"{word}.{name}")
        lists[field] = tuple(entries)
    if "sections" in lists:
        plain["shaft", "sections"] = lists.pop("sections")
    return _replaced(system, {**plain, **{(field,): value for field, value in lists.items()}})


def entries_of(system: "ShaftSystem", word: str) -> tuple[Any, ...]:
    """The bearings, sets, forces or sections of the system. **Arguments:** `word`: a key of `LISTS`, or "section"."""
    return system.shaft.sections if word == "section" else getattr(system, LISTS[word])


def names_of(system: "ShaftSystem", word: str) -> tuple[str, ...]:
    """Names of the entries, in their order."""
    entries = entries_of(system, word)
    if word == "section":
        return tuple(str(place + 1) for place in range(len(entries)))
    return tuple(entry.name for entry in entries)


def _place(system: "ShaftSystem", word: str, name: str) -> int:
    """Index of the entry with this name. **Raises:** `AttributeError` if there is none."""
    names = names_of(system, word)
    if name not in names:
        whole = f"shaft.sections.{name}" if word == "section" else f"{word}.{name}"
        near = did_you_mean(name, names, whole.removesuffix(name))
        raise AttributeError(f"the scene has no {whole!r}; there is {', '.join(names) or 'none'}{near}")
    return names.index(name)


def _changed(entry: Any, changes: _Changes, above: str) -> Any:
    """An entry with other values: its own fields, and those of its bearing."""
    own = [field.name for field in dataclasses.fields(entry)]
    mine = {path: value for path, value in changes.items() if path[0] in own}
    bearings = {".".join(path): value for path, value in changes.items() if path[0] not in own}
    if bearings:
        scene = getattr(entry, _BEARING, ())
        scenes = scene if isinstance(scene, tuple) else (scene,)
        inside = [field.name for bearing in scenes for field in dataclasses.fields(bearing)]
        inside += [NUMBERED] if isinstance(scene, tuple) else []
        for path in bearings:
            name = path.partition(".")[0]
            if name not in inside:
                there, near = ", ".join(own), did_you_mean(name, own + inside, f"{above}.")
                raise AttributeError(f"the scene has no '{above}.{path}': {type(entry).__name__} has {there}{near}")
        several = isinstance(scene, tuple)
        mine[(_BEARING,)] = _of_bearings(scene, bearings, above) if several else _of_bearing(scene, bearings, above)
    return _replaced(entry, mine, f"{above}.")


def _of_bearings(scenes: tuple[Bearing, ...], changes: Mapping[str, object], above: str) -> tuple[Bearing, ...]:
    """Changes different bearings of a set: the bearing whose number is in the path, or all if there is no number.

    **Raises:** `AttributeError` for a number that the set does not have.
    """
    changed = list(scenes)
    for path, value in changes.items():
        keys = path.split(".")
        if keys[0] != NUMBERED:
            changed = [_of_bearing(scene, {path: value}, above) for scene in changed]
            continue
        place = _number(keys[1:2], len(scenes))
        if place is None:
            raise AttributeError(f"the scene has no '{above}.{path}'; the set has bearings 1 to {len(scenes)}")
        number = ".".join([above, *keys[:2]])
        changed[place] = _of_bearing(changed[place], {".".join(keys[2:]): value}, number)
    return tuple(changed)


def _number(keys: list[str], count: int) -> int | None:
    """Index of a bearing from its number, which counts from 1; `None` if there is no such bearing."""
    digits = keys[0] if keys else ""
    return int(digits) - 1 if digits.isdecimal() and 1 <= int(digits) <= count else None


def _of_bearing(scene: Bearing, changes: Mapping[str, object], above: str) -> Bearing:
    return _replaced(scene, {tuple(path.split(".")): value for path, value in changes.items()}, f"{above}.")


_NUMBERED = re.compile(r"(bearings|sets|forces)\.(\d+)\.(.*)")


def path_in_file(system: "ShaftSystem", path: str) -> str:
    """Path in scene files of a path in the tree of numbers: `bearing.rear.geometry.conformity_inner` for
    `bearings.0.scene.geometry.conformity_inner`."""
    match = _NUMBERED.fullmatch(path)
    if match is None:
        place = re.fullmatch(r"shaft\.sections\.(\d+)\.(.*)", path)
        return path if place is None else f"shaft.sections.{int(place[1]) + 1}.{place[2]}"
    word = next(word for word, field in LISTS.items() if field == match[1])
    place = int(match[2])
    name, rest = names_of(system, word)[place], match[3].removeprefix(f"{_BEARING}.")
    if rest != match[3] and isinstance(entries_of(system, word)[place].scene, tuple):
        number, _, rest = rest.partition(".")
        rest = f"{NUMBERED}.{int(number) + 1}.{rest}"
    return f"{word}.{name}.{rest}"


def part_at(system: Any, path: str) -> Any:
    """The number or part at a path; `None` where there is none."""
    keys = path.split(".")
    if keys[0] in LISTS and len(keys) > 1:
        word, name, rest = keys[0], keys[1], keys[2:]
    elif keys[:2] == ["shaft", "sections"] and len(keys) > 2:
        word, name, rest = "section", keys[2], keys[3:]
    else:
        return _inside(system, keys)
    names = names_of(system, word)
    if name not in names:
        return None
    return _inside(entries_of(system, word)[names.index(name)], rest)


def _inside(part: object, keys: list[str]) -> object:
    for place, key in enumerate(keys):
        own = [field.name for field in dataclasses.fields(part)] if isinstance(part, eqx.Module) else []
        if key not in own and _BEARING in own:
            scene = getattr(part, _BEARING)
            rest = keys[place:]
            if not isinstance(scene, tuple):
                return _inside(scene, rest)
            if key != NUMBERED:
                return _inside(scene[0], rest)
            number = _number(rest[1:2], len(scene))
            return None if number is None else _inside(scene[number], rest[2:])
        part = getattr(part, key, None)
    return part


def all_names(system: "ShaftSystem") -> Iterator[tuple[str, str, object]]:
    """Word, name and entry of every bearing, set and force."""
    for word in LISTS:
        for name, entry in zip(names_of(system, word), entries_of(system, word), strict=True):
            yield word, name, entry
