"""Makes scenes and oils from data in a program: tables with SI numbers or texts with units, names of oils, files."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jax
import numpy as np
from jax.core import Tracer

from .._scene import AbstractScene
from ..lubricants import Lubricant
from .data_files import oil_named
from .drafts import read_table
from .oil import catalogue as oils
from .oil.files import read_oil
from .oil.schema import OilTable
from .reader import scene_from_tables, warn_of_means, warn_of_preset
from .units import bare_numbers_are_si


def scene_from_mapping(mapping: Mapping[str, object]) -> AbstractScene:
    """A scene from the tables of a scene file, {"kind": ..., "geometry": {...}, ...}.

    A number in a field with a unit is an SI value here; a text carries its own unit, as in a file. Traced numbers are
    not allowed: make the scene with known numbers first, and change it with `replace`. A field that is given as a
    distribution takes its mean, and a `MeanUsedWarning` reports it. A `PresetUsedWarning` lists the laws that
    `laws = "best"` stands for.

    **Raises:** `SceneError` with all errors; `TypeError` for an object that is not a mapping, and for traced numbers.
    """
    if not isinstance(mapping, Mapping):
        raise TypeError(f"scene_from_mapping takes the tables of a scene, got a {type(mapping).__name__}")
    with bare_numbers_are_si():
        tables = _plain(mapping, "")
        warn_of_means(tables, "scene")
        scene = scene_from_tables(tables, "scene")
        warn_of_preset(tables, "scene")
        return scene


def load_oil(source: str | Path, base: str | None = None) -> Lubricant:
    """An oil of the catalogue by its name, a standard oil by its grade ("ISO VG 68"), or an oil from a file, such as
    `jaxbearing fit --out` writes.

    **Arguments:** `base`: base stock of a grade: "mineral" (the default), "PAO", "ester" or "polyglycol".

    **Raises:** `SceneError` for an unknown name, grade or base stock, and for a file that is not an oil file.
    """
    if isinstance(source, str) and (oil_named(source) or not source.endswith(".toml")):
        return oils.load_oil(source, base)
    return oils.lubricant(read_table(OilTable, read_oil(str(source)), str(source)))


def _plain(value: object, path: str) -> Any:
    """The tables with arrays, tuples and paths converted to Python's numbers, lists and texts."""
    if isinstance(value, Mapping):
        return {str(key): _plain(inner, f"{path}.{key}".lstrip(".")) for key, inner in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(inner, path) for inner in value]
    if isinstance(value, Tracer):
        raise TypeError(f"{path}: a traced number; make the scene of known numbers first and change it with replace")
    if isinstance(value, jax.Array | np.ndarray | np.generic):
        return np.asarray(value).tolist()
    return str(value) if isinstance(value, Path) else value
