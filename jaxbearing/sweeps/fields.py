"""Fields of a scene file that can be swept: their units, and reading and writing of their values as text."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, TypeAdapter, ValidationError

from .._scene import AbstractScene
from ..report.labels import udunits
from ..scenes.distributions import no_number
from ..scenes.errors import SceneError
from ..scenes.fields import dimension_of, is_known, type_at
from ..scenes.inputs import owner_of
from ..scenes.overrides import REMOVE, parse_value
from ..scenes.problems import in_words, unknown_name
from ..scenes.quantity_texts import quantity_text
from ..scenes.reader import read_base, scene_from_tables, scene_model, warn_of_means, warn_of_preset
from ..scenes.units import Dimension
from ..scenes.words import describe
from .cases import MOST_CASES, Cases, between, grid, latin_hypercube, random
from .recipe import Direct, Read, from_reader, structural

OVER = "--over"
_GRID = "NAME=START:STOP:COUNT or NAME=START:STOP:COUNT:log, e.g. operation.inner_speed='2000 rpm:20000 rpm:10'"
_RANGE = "NAME=START:STOP or NAME=START:STOP:log, e.g. operation.inner_speed='2000 rpm:20000 rpm'"


@dataclass(frozen=True)
class Field:
    """One number of a scene file: `path`; `dimension`, `None` without a unit; `kind`, the type that reads it."""

    path: str
    dimension: Dimension | None
    kind: Any

    def text(self, value: float) -> str:
        """A value in SI as text of a scene file."""
        return repr(float(value)) if self.dimension is None else quantity_text(float(value), self.dimension)

    def read(self, text: str, where: str) -> float:
        """SI value of a text, within the bounds of the field. **Raises:** `SceneError`."""
        value = text.strip() if self.dimension is not None else parse_value(text.strip())
        try:
            return float(TypeAdapter(self.kind).validate_python(value))
        except ValidationError as error:
            context = error.errors(include_url=False)[0].get("ctx", {})
            found, expected = context.get("found", describe(value)), context.get("expected", "a number")
            raise SceneError(where, self.path, found, expected) from None


@dataclass(frozen=True)
class SceneSource:
    """A scene file or built-in scene, and changes to it, from which the scene of a case is read."""

    label: str
    tables: dict[str, Any]
    overrides: dict[str, str]

    @classmethod
    def of(cls, source: str | Path, overrides: Mapping[str, str] | None = None) -> "SceneSource":
        """The source with this name or path.

        **Raises:** `SceneError` for a scene that cannot be read.
        """
        label, tables = read_base(source)
        return cls(label, tables, dict(overrides or {}))

    @property
    def model(self) -> type[BaseModel]:
        return scene_model(self.tables, self.overrides, self.label)

    def field(self, path: str, where: str) -> Field:
        """The field at a dotted path.

        **Raises:** `SceneError` for a field that does not exist, and for one that is not a single number.
        """
        names = path.split(".")
        if not all(names) or not is_known(self.model, names):
            known = next((n for n in range(1, len(names) + 1) if not is_known(self.model, names[:n])), len(names))
            raise in_words(where, ".".join(names[:known]), unknown_name(names[:known], self.model))
        kind = type_at(self.model, names)
        problem = no_number(kind)
        if problem:
            raise SceneError(where, path, problem, structural(path).partition("expected ")[2])
        return Field(path, dimension_of(kind), kind)

    def warn_of_means(self, cases: Cases, fields: Mapping[str, Field]) -> None:
        """Warns of distributions that are replaced by their means in all cases, and of the laws and estimates that a
        preset stands for in the first case."""
        swept = {path: fields[path].text(float(values[0])) for path, values in cases.part(0, 1).items()}
        warn_of_means(self.tables, self.label, {**self.overrides, **swept})
        warn_of_preset(self.tables, self.label, {**self.overrides, **swept})

    def recipe(self, cases: Cases, fields: Mapping[str, Field]) -> Direct | Read:
        """The recipe that makes the scenes of the cases.

        **Raises:** `SceneError`, or `ValueError` for a field that changes the structure of the equations.
        """
        return from_reader(_Reader(self, dict(fields)), cases)


@dataclass(frozen=True)
class _Reader:
    source: SceneSource
    fields: dict[str, Field]

    def __call__(self, values: dict[str, float]) -> AbstractScene:
        texts = {path: self.fields[path].text(value) for path, value in values.items()}
        return scene_from_tables(self.source.tables, self.source.label, {**self.source.overrides, **texts})

    def as_data(self) -> dict[str, Any]:
        return {
            "label": self.source.label,
            "tables": self.source.tables,
            "overrides": self.source.overrides,
            "paths": tuple(self.fields),
        }


def parse_over(texts: list[str], source: SceneSource, counted: bool) -> tuple[dict[str, Field], dict[str, object]]:
    """Fields and ranges of `--over` texts, both by path; a range is (start, stop, count, log), where `count` is `None`
    unless `counted`.

    **Raises:** `SceneError`.
    """
    expected, fields, ranges = (_GRID if counted else _RANGE), {}, {}
    for text in texts:
        path, equals, span = text.partition("=")
        path, parts = path.strip(), [part.strip() for part in span.split(":")]
        log = parts[-1] == "log"
        parts = parts[:-1] if log else parts
        if not equals or len(parts) != (3 if counted else 2) or not all(parts) or REMOVE in parts:
            raise SceneError(OVER, path, f"'{text}'", expected)
        if path in fields:
            raise SceneError(OVER, path, "this field twice", "each field once")
        if path in source.overrides:
            raise SceneError(OVER, path, "a field that --set gives too", "one of the two")
        field = source.field(path, OVER)
        start, stop = (field.read(part, OVER) for part in parts[:2])
        if log and not (start > 0.0 and stop > 0.0):
            raise SceneError(OVER, path, f"'{span}'", "values > 0 in SI units, which logarithmic spacing needs")
        fields[path], ranges[path] = field, (start, stop, _count(parts[2], path) if counted else None, log)
        if start == stop and ranges[path][2] != 1:
            raise SceneError(OVER, path, f"'{span}'", "a stop that differs from the start")
    return fields, ranges


def _count(text: str, path: str) -> int:
    if not re.fullmatch(r"[0-9]{1,9}", text) or not 1 <= int(text) <= MOST_CASES:
        raise SceneError(OVER, path, describe(text), f"a whole number of values from 1 to {MOST_CASES}")
    return int(text)


def grid_of(ranges: Mapping[str, Any]) -> Cases:
    """The grid of these ranges.

    **Raises:** `ValueError` for too many cases.
    """
    values = {}
    for path, (start, stop, count, log) in ranges.items():
        values[path] = between(start, stop, np.linspace(0.0, 1.0, count), log, path)
    return grid(values)


def samples_of(ranges: Mapping[str, Any], kind: str, count: int, seed: int) -> Cases:
    """Random cases within these ranges.

    **Raises:** `ValueError` for an impossible count.
    """
    bounds = {path: (start, stop, *(["log"] if log else [])) for path, (start, stop, _, log) in ranges.items()}
    return (latin_hypercube if kind == "latin_hypercube" else random)(bounds, count, seed)


def described_fields(fields: Mapping[str, Field], scene: AbstractScene) -> dict[str, dict[str, str]]:
    """Unit and description of each swept field."""
    return {path: label_of(scene, path) for path in fields}


def label_of(scene: AbstractScene, path: str) -> dict[str, str]:
    """Unit and description of a field, from the class that declares it, as attributes of a coordinate."""
    names = path.split(".")
    words, owner = names[-1].replace("_", " "), owner_of(scene, names)
    metadata = {} if owner is None else owner[0].__dataclass_fields__[owner[1]].metadata
    flat = re.sub(r"/\((.+?)\)", lambda under: "/" + under[1].replace(" ", "/"), metadata.get("unit", "1"))
    return {"units": udunits(flat), "long_name": metadata.get("description") or words}
