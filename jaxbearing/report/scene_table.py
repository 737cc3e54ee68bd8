"""A scene as a table: each field under its path in a scene file, with its unit."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

import equinox as eqx
import numpy as np
from pydantic import BaseModel
from rich.console import Console

from .._scene import AbstractScene
from ..scenes.fields import is_known, tables_at
from ..scenes.reader import model_of
from ..shafts.paths import all_names
from ..shafts.scene import ShaftSystem
from .backends.screen import print_line, print_rule
from .display import ZERO_CELSIUS, display_unit, displayed

_NAMES = 40
"""Width of the column of names, in characters."""
_SIZES = {"Pa": ((1e8, "GPa", 1e-9), (1e5, "MPa", 1e-6), (0.0, "Pa", 1.0))}
"""SI unit -> triples of least modulus, unit shown from there on, and factor to that unit."""


def print_scene(scene: AbstractScene, console: Console) -> bool:
    """Prints the fields of a scene, one part after the other.

    It prints nothing and returns `False` for a batch of scenes and for a class that no scene file describes.
    """
    model = model_of(scene)
    rows: list[tuple[tuple[str, ...], str | None]] = []
    if model is not None:
        rows = list(_rows_of_shaft(scene, model) if isinstance(scene, ShaftSystem) else _rows(scene, (), model))
    texts = [(path, text) for path, text in rows if text is not None]
    if not rows or len(texts) < len(rows):
        return False
    print_line("kind", scene.kind, console, _NAMES)
    last = ""
    for (table, *inside), text in texts:
        if table != last and inside:
            print_rule(table, console)
        last = table
        print_line(".".join(inside or [table]), text, console, _NAMES)
    return True


def _rows_of_shaft(scene: ShaftSystem, model: type[BaseModel]) -> Iterator[tuple[tuple[str, ...], str | None]]:
    """Rows of a shaft as `_rows` yields them, with paths by section number and by name of bearing, set or force."""
    yield from _rows(dataclasses.replace(scene.shaft, sections=()), ("shaft",), model)
    for number, section in enumerate(scene.shaft.sections):
        yield from _rows(section, ("shaft", "sections", str(number + 1)), model)
    for word, name, entry in all_names(scene):
        for path, text in _rows(entry, (word, name), model):
            if path[2:] != ("name",):
                yield path, text
        bearing = getattr(entry, "scene", None)
        bearing = bearing[0] if isinstance(bearing, tuple) else bearing
        # a bearing on a shaft gets its loads and speeds from the shaft, so its own are not shown
        for path, text in _rows(bearing, (word, name), model) if bearing is not None else ():
            if path[2] != "operation":
                yield path, text
    if scene.life.weibull is not None:
        yield from _rows(scene.life, ("life",), model)


def _rows(part: Any, inside: tuple[str, ...], model: type[BaseModel]) -> Iterator[tuple[tuple[str, ...], str | None]]:
    """Path and text of each field that is given; the text is `None` for the numbers of a batch."""
    for field in dataclasses.fields(part):
        value, path = getattr(part, field.name), (*inside, field.name)
        if value is None or (isinstance(value, tuple) and not value):
            continue
        if isinstance(value, eqx.Module):
            # a table of fields, or a law
            if tables_at(model, path) and _is_table(value, model, path):
                yield from _rows(value, path, model)
            else:
                yield path, type(value).__name__
            continue
        if np.ndim(value) == 0 or isinstance(value, str):
            yield path, _text(value, field.metadata)
        elif isinstance(value, tuple):
            yield path, ", ".join(map(str, value))
        else:
            yield path, f"{np.size(value)} values" if "each" in field.metadata else None


def _is_table(value: eqx.Module, model: type[BaseModel], path: tuple[str, ...]) -> bool:
    """True if the scene-file table at `path` has at least one field of the part."""
    return any(is_known(model, (*path, field.name)) for field in dataclasses.fields(value))


def _text(value: Any, metadata: Mapping[str, Any]) -> str:
    """Text of a value with its unit. **Arguments:** `metadata`: of the field."""
    if isinstance(value, str | bool | int):
        return str(value).lower() if isinstance(value, bool) else str(value)
    number, si = float(value), metadata.get("unit", "1")
    if si == "K" and not metadata.get("difference"):
        return f"{number - ZERO_CELSIUS:.6g} degC"
    sizes = _SIZES.get(si, ())
    unit, factor = next(((name, by) for least, name, by in sizes if abs(number) >= least), ("", 0.0))
    if unit:
        return f"{number * factor:.6g} {unit}"
    return f"{displayed(number, si, number):.6g} {display_unit(si, number)}".rstrip()
