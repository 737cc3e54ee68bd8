"""Calibrated fields of scenes: their coordinates in the search, bounds and priors."""

import dataclasses
import functools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from .._scene import AbstractScene
from ..distribution import Distribution
from ..numerics.ranges import RANGES
from ..report.labels import label_unit
from ..scenes.inputs import owner_of
from ..sweeps.cases import listed
from ..sweeps.fields import label_of
from ..sweeps.recipe import in_scene

LARGEST_LOG = 80.0
"""Largest change of a natural logarithm that a search may try: 35 decades."""


@dataclasses.dataclass(frozen=True)
class FreeField:
    """One number of the scenes that is fitted.

    The coordinate of a number that must be positive is ln(value / scale), with the start as scale. The coordinate of
    any other number is (value - start) / scale.

    **Arguments:**
    - `path`: dotted path in the scenes.
    - `unit`: SI unit, written as in labels of results.
    - `start`: value in the first scene that has it, or the median or mean of its prior.
    - `positive`: whether its logarithm is searched.
    - `scale`: of the coordinate.
    - `low`, `high`: bounds, infinite where there is none.
    - `prior`: its prior distribution; `None`: only the bounds are known.
    """

    path: str
    unit: str
    start: float
    positive: bool
    scale: float
    low: float = -math.inf
    high: float = math.inf
    prior: Distribution | None = None

    def value(self, coordinate: Any) -> Any:
        """SI values of coordinates, numpy."""
        if self.positive:
            return self.scale * np.exp(np.clip(coordinate, -LARGEST_LOG, LARGEST_LOG))
        return self.start + self.scale * np.asarray(coordinate)

    def slope(self, coordinate: Any) -> Any:
        """Derivative of the value by the coordinate."""
        return self.value(coordinate) if self.positive else np.full(np.shape(coordinate), self.scale)

    def traced(self, coordinate: Array) -> Array:
        """`value` of a traced coordinate."""
        if self.positive:
            return self.scale * jnp.exp(jnp.clip(coordinate, -LARGEST_LOG, LARGEST_LOG))
        return self.start + self.scale * coordinate

    def traced_slope(self, coordinate: Array) -> Array:
        """`slope` of a traced coordinate."""
        return self.traced(coordinate) if self.positive else jnp.full_like(coordinate, self.scale)

    def coordinate(self, value: float) -> float:
        """Coordinate of a value; infinite for a missing bound, and minus infinity for 0 of a positive number."""
        if self.positive:
            return math.log(value / self.scale) if value > 0.0 else -math.inf
        return (value - self.start) / self.scale

    @property
    def limits(self) -> tuple[float, float]:
        """Bounds of the coordinate."""
        if self.positive:
            return self.coordinate(self.low), self.coordinate(self.high) if self.high < math.inf else math.inf
        return self.coordinate(self.low), self.coordinate(self.high)

    @functools.cached_property
    def normal_prior(self) -> tuple[float, float] | None:
        """Mean and standard deviation of the normal prior of the coordinate; `None` if only bounds are known. For a
        positive number, a lognormal prior is represented exactly, apart from its limits, which become bounds; a normal
        prior is replaced by a lognormal one with the same median and relative deviation."""
        prior = self.prior
        if prior is None or prior.shape == "uniform":
            return None
        if not self.positive:
            return self.coordinate(prior.mean), prior.deviation / self.scale
        if prior.log_deviation is not None:
            return self.coordinate(prior.nominal), prior.log_deviation
        return self.coordinate(prior.mean), math.sqrt(math.log1p((prior.deviation / prior.mean) ** 2))


def free_fields(
    scenes: Sequence[AbstractScene],
    free: Sequence[str],
    priors: Mapping[str, Distribution],
    bounds: Mapping[str, tuple[float | None, float | None]],
) -> tuple[FreeField, ...]:
    """The fields that are calibrated, in the order of `free`.

    **Arguments:** `scenes`: of all rigs; a field has one common value in all scenes that have it. `priors`, `bounds`:
    by dotted path, SI.

    **Raises:** `ValueError` for an empty `free` or a repeated field, for a prior or bounds of a field that is not free,
    for a field that is not a number in any scene, and for bounds that exclude every value.
    """
    if not free:
        raise ValueError("free: found no field; expected one or more dotted paths, such as 'drag.coefficient'")
    twice = next((path for path in free if list(free).count(path) > 1), None)
    if twice is not None:
        raise ValueError(f"free: found '{twice}' twice; expected each field once")
    for name, entries in (("prior", priors), ("bounds", bounds)):
        other = next((path for path in entries if path not in free), None)
        if other is not None:
            raise ValueError(f"{name}: found '{other}', which is not free; expected one of {', '.join(free)}")
    return tuple(_field(scenes, path, priors.get(path), bounds.get(path, (None, None))) for path in free)


def scenes_with(scenes: Sequence[AbstractScene], path: str) -> list[int]:
    """Indices of the scenes that have a number at this path."""
    return [place for place, scene in enumerate(scenes) if _number_at(scene, path) is not None]


def _number_at(scene: AbstractScene, path: str) -> float | None:
    value: Any = scene
    for name in path.split("."):
        value = getattr(value, name, None)
    is_number = isinstance(value, int | float | np.ndarray) or hasattr(value, "dtype")
    if value is None or isinstance(value, bool | str) or not is_number or np.ndim(value):
        return None
    return float(value)


def _field(
    scenes: Sequence[AbstractScene],
    path: str,
    prior: Distribution | None,
    bounds: tuple[float | None, float | None],
) -> FreeField:
    places = scenes_with(scenes, path)
    if not places:
        # says what is there instead, or why it is no number
        in_scene(scenes[0], listed({path: [1.0 if prior is None else prior.nominal]}))
        raise ValueError(f"{path}: found no value in the scene; expected a number to start from, or a prior")
    scene = scenes[places[0]]
    own = _number_at(scene, path)
    assert own is not None
    start = own if prior is None else prior.nominal
    if prior is not None and not prior.deviation > np.finfo(float).eps * abs(start):
        raise ValueError(
            f"prior: found the deviation {prior.deviation:g} for {path}, which is known then; expected a deviation > "
            "0, or the value in the scene (--set) and no --free"
        )
    owner = owner_of(scene, path.split("."))
    metadata = {} if owner is None else owner[0].__dataclass_fields__[owner[1]].metadata
    allowed = RANGES[metadata.get("bound", "finite")]
    ends = [allowed.low, allowed.high]
    cut = (None, None) if prior is None else (prior.low, prior.high)
    if prior is not None and prior.shape == "uniform":
        cut = prior.lowest, prior.highest
    for limits in (cut, bounds):
        for place, (limit, choose) in enumerate(zip(limits, (max, min), strict=True)):
            if limit is not None:
                ends[place] = choose(ends[place], limit)
    low, high = ends
    if not low < high:
        raise ValueError(f"bounds: found {low:g} to {high:g} for {path}; expected the lower one first")
    start = min(max(start, low), high)
    positive = allowed.low >= 0.0 and start > 0.0
    if allowed.low >= 0.0 and not positive:
        raise ValueError(
            f"{path}: found {start:g} to start from; expected a value > 0, since its logarithm is fitted: set one, or "
            "give a prior"
        )
    in_scene(scene, listed({path: [start]}))
    scale = start if positive else _scale(start, prior)
    unit = label_unit(label_of(scene, path)["units"])
    return FreeField(path, unit, start, positive, scale, low, high, prior)


def _scale(start: float, prior: Distribution | None) -> float:
    """Scale of the coordinate of a number that may have either sign."""
    if prior is not None and prior.deviation > 0.0:
        return prior.deviation
    return abs(start) if start else 1.0
