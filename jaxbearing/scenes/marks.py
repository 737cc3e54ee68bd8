"""Marks in the comments of a scene file, which tell that a number is estimated, assumed or from an example.

`jaxbearing new` writes a mark behind each number that nobody gave. The marks are read back, so that results repeat
them. A mark belongs to the value on its line; values replaced by an override have no mark. A comment is a mark if it
begins with one of `WORDS` or contains "estimated:".
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from .data_files import builtin_names
from .errors import SceneError
from .overrides import Overrides, apply, as_texts
from .reader import is_shaft, read_tables, scene_model
from .shaft.files import OF_SHAFT, SCENE, beside, named
from .shaft.members import at, each_bearing
from .toml_files import parse_toml, read_text

WORDS = {"estimated": "estimated", "assumed": "assumed", "an example": "an example"}
"""Word at the beginning of a comment -> word for the number in results."""
UNMOUNTED = "unmounted"
"""Word in the comment of a clearance before mounting."""
CLEARANCE = "geometry.diametral_clearance"
_HEADER = re.compile(r"\s*\[{1,2}\s*([\w.-]+)\s*\]{1,2}\s*(?:#.*)?")
_LINE = re.compile(r"""\s*([\w.-]+)\s*=(?:[^#"']|"[^"]*"|'[^']*')*#\s*(.*)""")


class Mark(NamedTuple):
    """Mark of a field, read from its comment.

    **Arguments:** `word`: one of the values of `WORDS`, "" without a mark; `unmounted`: True for a clearance before
    mounting.
    """

    word: str
    unmounted: bool = False


def marks_in(text: str) -> dict[str, Mark]:
    """The marks in the text of a scene file, by dotted path."""
    marks, table = {}, ""
    for line in text.splitlines():
        header = _HEADER.fullmatch(line)
        if header is not None:
            table = f"{header[1]}."
            continue
        field = _LINE.fullmatch(line)
        mark = Mark("") if field is None else _mark(field[2])
        if field is not None and mark != Mark(""):
            marks[f"{table}{field[1]}"] = mark
    return marks


def _mark(comment: str) -> Mark:
    word = next((label for word, label in WORDS.items() if re.match(rf"{word}\b", comment)), "")
    if not word and re.search(r"\bestimated:", comment):
        word = WORDS["estimated"]
    return Mark(word, re.search(rf"\b{UNMOUNTED}\b", comment) is not None)


def marks_of(source: str | Path, overrides: Overrides | None = None) -> dict[str, Mark]:
    """The marks of a scene file, and of the files of the bearings on a shaft, by dotted path. Fields that `overrides`
    replaces have no mark. Built-in scenes have no marks, nor have pipes, which cannot be read twice.

    **Raises:** `SceneError` for a file that cannot be read.
    """
    text = _text(source)
    if text is None:
        return {}
    marks, label = marks_in(text), str(source)
    tables = parse_toml(text, label, "a scene")
    if is_shaft(tables):
        tables = beside(named(tables, label), Path(source).parent)
        for keys in each_bearing(tables):
            marks |= _bearing_marks(at(tables, keys), ".".join(keys))
    replaced = as_texts(overrides)
    return {path: mark for path, mark in marks.items() if not any(_within(path, other) for other in replaced)}


def _bearing_marks(entry: Any, above: str) -> dict[str, Mark]:
    """Marks in the scene file of a bearing on a shaft, for the values that the shaft and the entry do not replace."""
    scene = entry.get(SCENE) if isinstance(entry, Mapping) else None
    text = _text(scene) if isinstance(scene, str) else None
    marks = {} if text is None else marks_in(text)
    kept = lambda path: not path.startswith("operation.") or path.removeprefix("operation.") in OF_SHAFT
    return {
        f"{above}.{path}": mark
        for path, mark in marks.items()
        if kept(path) and at(entry, tuple(path.split("."))) is None
    }


def _text(source: str | Path) -> str | None:
    """Text of a scene file; `None` for a built-in scene, and for a pipe, which cannot be read again."""
    if str(source) in builtin_names() or not Path(source).is_file():
        return None
    return read_text(source, "a scene")


def _within(path: str, other: str) -> bool:
    return f"{path}.".startswith(f"{other}.")


def notes_of_file(source: str | Path, overrides: Overrides | None = None) -> list[str]:
    """Notes on a scene file: numbers that nobody gave, clearances before mounting that are used as operating
    clearances, and assumed materials of the seats.

    **Raises:** `SceneError` for a file that cannot be read.
    """
    if str(source) not in builtin_names() and not Path(source).is_file():
        return []
    marks = marks_of(source, overrides)
    groups = {word: [path for path, mark in marks.items() if mark.word == word] for word in WORDS.values()}
    texts = [f"{word}: {', '.join(paths)}" for word, paths in groups.items() if paths]
    notes = [f"not given, by the marks in the scene file: {'; '.join(texts)}"] if texts else []
    before = [path for path, mark in marks.items() if mark.unmounted and path.endswith(CLEARANCE)]
    tables = _complete(source, overrides)
    for path in before:
        keys = tuple(path.removesuffix(CLEARANCE).rstrip(".").split("."))
        bearing = tables if keys == ("",) else at(tables, keys)
        if not isinstance(bearing, Mapping) or bearing.get("fits") is None:
            notes.append(
                f"{path} is the clearance before mounting, and is taken as that of the running bearing: add [fits], "
                "which makes the running clearance a result"
            )
    fits = tables.get("fits")
    fits_table = fits if isinstance(fits, Mapping) else {}
    seats = [part for part in ("shaft", "housing") if any(f"{part}_{name}" in fits_table for name in _OF_SEAT)]
    bare = [part for part in seats if f"{part}_material" not in fits_table]
    if bare:
        fields = " and ".join(f"fits.{part}_material" for part in bare)
        notes.append(f"{fields} {'is' if len(bare) == 1 else 'are'} not given: assumed steel")
    return notes


_OF_SEAT = ("interference", "tolerance")
"""Endings of the field names that define the seat of a part."""


def _complete(source: str | Path, overrides: Overrides | None) -> Mapping[str, object]:
    """The tables of a scene with its overrides; empty if these cannot be applied."""
    label, mapping = read_tables(source)
    texts = as_texts(overrides)
    try:
        return apply(mapping, texts, scene_model(mapping, texts, label), label)
    except SceneError:
        return {}
