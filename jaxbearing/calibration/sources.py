"""Input of a calibration on the command line: reads scene files, CSV files and texts into scenes, data, priors and
bounds."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .._scene import AbstractScene
from ..bearings.priors import DRAG_FIELD, SUPPLY_FIELD, drag_prior, supply_prior
from ..distribution import Distribution
from ..scenes.errors import SceneError
from ..scenes.reader import distributions_in, scene_from_tables
from ..scenes.words import describe
from ..sweeps.fields import SceneSource
from .data import Data
from .table import read_data, require_plain

ASSUMED = "assumed"
"""Text that stands for the package's own prior of a field."""
_PRIOR = "PATH={...} or PATH=assumed, e.g. drag.coefficient='{median = 0.3, log_deviation = 0.9}'"
_BOUND = "PATH=LOW:HIGH, e.g. drag.coefficient=0.05:1.2"


@dataclass
class Given:
    """Input of a calibration: scenes, data, free fields, priors and bounds in SI, and notes on the files."""

    sources: list[SceneSource]
    scenes: list[AbstractScene]
    data: list[Data]
    free: list[str]
    priors: dict[str, Distribution] = field(default_factory=dict)
    bounds: dict[str, tuple[float | None, float | None]] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def given_of(
    rigs: Sequence[tuple[str, Path]],
    overrides: Mapping[str, str],
    free: Sequence[str],
    priors: Sequence[str],
    bounds: Sequence[str],
) -> Given:
    """Reads all files and texts.

    **Arguments:** `rigs`: scene and data file of each rig; `overrides`: changed values of the first scene and of every
    other one that has the field; `priors`, `bounds`: texts "PATH=...".

    **Raises:** `SceneError`.
    """
    texts = dict(_parted("--prior", prior, _PRIOR) for prior in priors)
    inputs = Given([], [], [], list(dict.fromkeys(free)))
    for place, (scene, file) in enumerate(rigs):
        source = SceneSource.of(scene, overrides)
        if place:
            source = SceneSource(source.label, source.tables, _known(source, overrides))
        own = {path: text for path, text in texts.items() if text != ASSUMED and _has(source, path)}
        distributions = distributions_in(source.tables, source.label, {**source.overrides, **own}, priors=True)
        inputs.priors |= {path: distribution for path, distribution in distributions.items() if path in inputs.free}
        built = scene_from_tables(source.tables, source.label, source.overrides)
        data, notes = read_data(file, source, built)
        inputs.sources.append(source)
        inputs.scenes.append(built)
        inputs.data.append(data)
        inputs.notes += notes
    for path, text in texts.items():
        if text == ASSUMED:
            inputs.priors[path] = _assumed(path, inputs.scenes)
        elif path not in inputs.priors:
            raise SceneError("--prior", path, "a field that is not free, or no distribution", _PRIOR)
    for bound in bounds:
        path, text = _parted("--bound", bound, _BOUND)
        inputs.bounds[path] = _ends(inputs, path, text)
    _check_plain(inputs)
    return inputs


def _parted(option: str, text: str, expected: str) -> tuple[str, str]:
    path, equals, value = text.partition("=")
    path, value = path.strip(), value.strip()
    if not (equals and value and all(path.split("."))):
        raise SceneError(option, path, f"'{text}'", expected)
    return path, value


def _has(source: SceneSource, path: str) -> bool:
    try:
        source.field(path, "")
    except SceneError:
        return False
    return True


def _known(source: SceneSource, overrides: Mapping[str, str]) -> dict[str, str]:
    """The overrides whose field a further scene has."""
    return {path: text for path, text in overrides.items() if _has(source, path)}


def _assumed(path: str, scenes: Sequence[AbstractScene]) -> Distribution:
    """The package's own prior of a field. **Raises:** `SceneError` where there is none."""
    known = {DRAG_FIELD: drag_prior, SUPPLY_FIELD: supply_prior}
    prior = next((own for scene in scenes if path in known and (own := known[path](scene)) is not None), None)
    if prior is None:
        expected = f"a distribution of your own; assumed ones are known of {' and '.join(known)} where a scene has them"
        raise SceneError("--prior", path, f"'{ASSUMED}'", expected)
    return prior


def _ends(inputs: Given, path: str, text: str) -> tuple[float | None, float | None]:
    low, colon, high = (part.strip() for part in text.partition(":"))
    if not colon or not (low or high):
        raise SceneError("--bound", path, describe(text), _BOUND)
    source = next((rig for rig in inputs.sources if _has(rig, path)), inputs.sources[0])
    field = source.field(path, "--bound")
    ends = [field.read(end, "--bound") if end else None for end in (low, high)]
    return ends[0], ends[1]


def _check_plain(inputs: Given) -> None:
    """Checks that each free field is a number that the scene takes over unchanged from its file.

    **Raises:** `SceneError`.
    """
    for path in inputs.free:
        sources = [
            (source, scene) for source, scene in zip(inputs.sources, inputs.scenes, strict=True) if _has(source, path)
        ]
        if not sources:
            inputs.sources[0].field(path, "--free")
        for source, scene in sources:
            value: Any = scene
            for name in path.split("."):
                value = getattr(value, name, None)
            if path in inputs.priors:
                value = inputs.priors[path].nominal
            if value is None:
                raise SceneError(
                    "--free", path, "no value in the scene", "a number to start from (--set), or a --prior"
                )
            start = float(value)
            require_plain(source, {path: np.array([start, start * 1.001, start * 0.999])}, "--free", in_file=False)
