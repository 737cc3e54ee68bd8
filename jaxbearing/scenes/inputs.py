"""Lists the inputs of a scene file, field by field, with descriptions, for reports."""

import dataclasses
import inspect
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from .._scene import AbstractScene
from ..materials import Material
from .errors import SceneError
from .fields import tables_at
from .marks import marks_of
from .overrides import preset
from .reader import model_of, read_tables, scene_model

_ARGUMENT = re.compile(r"^\s*- (?P<names>`\w+`.*?): (?P<text>.*)$")
_NO_NEWS = re.compile(
    r"(?:m|s|rad|rad/s|N|N m|N/m|K|Pa|Pa s|Hz|m/s|m\^2/s|m\^3/s|1/Pa|K/Pa|K\^2/Pa|kg/m\^3|kg/\(m\^3 K\)|W/\(m K\)"
    r"|W/\(m K\^2\)|N/m\^\(10/9\)|structure|[<>]=? ?[\d.e-]+)\.?"
)
"""Units and bounds in docstrings, which are left out of a description: the value beside it has its unit."""


@dataclass(frozen=True)
class SceneInput:
    """One field of a scene file.

    **Arguments:** `path`: dotted path; `text`: value as written in the file or in `--set`; `description`: in words;
    `given`: False for a default value; `mark`: origin of a value that nobody gave, in words.
    """

    path: str
    text: str
    description: str
    given: bool = True
    mark: str = ""


def scene_inputs(
    source: str | Path, overrides: Mapping[str, str] | None, scene: AbstractScene
) -> dict[str, list[SceneInput]]:
    """Fields by table; "" holds the fields outside tables. `scene`: made by `load_scene` from the same arguments."""
    label, mapping = read_tables(source)
    overrides = overrides or {}
    model = scene_model(mapping, overrides, label)
    filled, problems = preset(mapping, overrides, model, label)
    if problems:
        raise SceneError.of_all(problems)
    marks = {path: f"{mark.word}, by the file" for path, mark in marks_of(source, overrides).items() if mark.word}
    marks |= dict.fromkeys(filled.added, "by laws = 'best'")
    marks |= dict.fromkeys(filled.estimated, "estimated by laws = 'best'")
    marks |= dict.fromkeys(filled.assumed, "assumed by laws = 'best'")
    by_table: dict[str, list[SceneInput]] = {}
    for field in _fields(filled.tables, (), model, scene):
        field = dataclasses.replace(field, mark=marks.get(field.path, ""))
        table = field.path.partition(".")[0] if "." in field.path else ""
        by_table.setdefault(table, []).append(field)
    return by_table


def _fields(
    table: Mapping[str, Any], inside: tuple[str, ...], model: type[BaseModel], scene: AbstractScene
) -> Iterator[SceneInput]:
    for name, value in table.items():
        path = (*inside, name)
        if isinstance(value, Mapping):
            yield from _fields(value, path, model, scene)
        else:
            yield SceneInput(".".join(path), _text(value), _meaning(scene, path))
    schemas = tables_at(model, inside)
    if len(schemas) != 1 or not inside:
        return
    for name, info in schemas[0].model_fields.items():
        if name not in table and not info.is_required() and isinstance(info.default, bool | int | float | str):
            path = (*inside, name)
            yield SceneInput(".".join(path), _text(info.default), _meaning(scene, path), given=False)


def _meaning(scene: AbstractScene, path: tuple[str, ...]) -> str:
    """Description of a field without its name, which stands beside it."""
    words = path[-1].replace("_", " ")
    if path == ("kind",):
        return "family, which decides what tables a scene has"
    if isinstance(getattr(getattr(scene, path[0], None), path[-1], None), Material):
        return f"material of the {words}"
    return described_field(scene, path).removeprefix(f"{words}: ")


def _text(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    return f"{value:g}" if isinstance(value, float) else str(value)


def described_field(scene: AbstractScene, path: tuple[str, ...]) -> str:
    """Description of a field: the first sentence of the docstring of a law, or the label of the field in its class, or
    the text of the argument in the docstring of the class or of the table."""
    words = path[-1].replace("_", " ")
    law = scene.part_at(".".join(path))
    if dataclasses.is_dataclass(law):
        summary = _first_sentence(type(law))
        return f"{words}: {summary}" if summary else words
    # the table describes fields that no class has and fields that their class does not describe
    places = [owner_of(scene, path), *((table, path[-1]) for table in _tables(scene, path[:-1]))]
    return next((text for place in places if place and (text := described_argument(*place))), words)


def owner_of(scene: AbstractScene, path: Sequence[str]) -> tuple[type, str] | None:
    """The class that has a field of a scene, and the name of the field in it. This is the class of the part that holds
    the field or, if only files have the field there, the class that its table was made from."""
    part = scene.part_at(".".join(path[:-1])) if len(path) > 1 else scene
    if dataclasses.is_dataclass(part) and path[-1] in {field.name for field in dataclasses.fields(part)}:
        return type(part), path[-1]
    made = (getattr(table, "made_from", {}) for table in _tables(scene, path[:-1]))
    return next((made_from[path[-1]] for made_from in made if path[-1] in made_from), None)


def _tables(scene: AbstractScene, path: Sequence[str]) -> list[type[BaseModel]]:
    """The tables that files of such scenes accept at a path."""
    model = model_of(scene)
    return [] if model is None else tables_at(model, path)


def described_argument(owner: type, name: str) -> str:
    """Description of a field of a class: its label, or the text of the argument in the docstring of the class or of its
    `__init__`; "" if there is none."""
    if dataclasses.is_dataclass(owner):
        label = {field.name: field.metadata for field in dataclasses.fields(owner)}.get(name, {}).get("description")
        if label:
            return label
    description = next((text for base in owner.__mro__ if (text := _arguments(base).get(name))), "")
    return f"{name.replace('_', ' ')}: {description}" if description else ""


def _first_sentence(law: type) -> str:
    paragraph = (inspect.cleandoc(law.__doc__ or "")).split("\n\n")[0]
    sentence = " ".join(paragraph.split()).partition(". ")[0].rstrip(".")
    # a sentence with a formula is no description
    return "" if "$" in sentence else sentence.replace("`", "")


def _arguments(owner: type) -> dict[str, str]:
    """Argument -> its text in the docstring of a class."""
    texts: dict[str, str] = {}
    names: list[str] = []
    docstrings = (owner.__dict__.get("__doc__"), getattr(owner.__dict__.get("__init__"), "__doc__", None))
    lines = [line for text in docstrings for line in inspect.cleandoc(text or "").splitlines()]
    for line in lines:
        entry = _ARGUMENT.match(line)
        if entry is not None:
            names = re.findall(r"`(\w+)`", entry["names"])
            texts |= dict.fromkeys(names, entry["text"])
        elif line.startswith("  ") and names:
            texts |= {name: f"{texts[name]} {line.strip()}" for name in names}
        else:
            names = []
    return {name: _plain(text) for name, text in texts.items()}


def _plain(text: str) -> str:
    parts = [part for part in re.split(r", |; ", text.replace("`", "")) if not _NO_NEWS.fullmatch(part)]
    return ", ".join(parts).rstrip(".")
