"""The fitted model between the measured points."""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from jaxbearing._types import Values
from jaxbearing.machines import TwoDisk
from jaxbearing.programs import KeptProgram

from ..result import FitResult

POINTS = 61
_NEAR_ZERO = 5
"""Number of points on either side of 0 between 0 and the smallest slide-to-roll ratio."""
_TOGETHER = 8
"""Number of curves that are computed together; it is always the same, so that one compiled program serves all files."""


class SmoothCurve(NamedTuple):
    """The model at the mean conditions of a curve, over its range of slide-to-roll ratios."""

    slide_to_roll: np.ndarray
    traction_coefficient: np.ndarray


def smooth_curves(result: FitResult, numbers: list[int], logarithmic: bool) -> list[SmoothCurve]:
    """The fitted model along curves of the measurements.

    **Arguments:** `numbers`: of the curves; `logarithmic`: whether the points are spaced for a logarithmic axis.
    """
    measured = result.measurements
    slide, load, speed, temperature = [], [], [], []
    for number in numbers:
        points = measured.in_curve(number)
        mean = lambda values, points=points: np.full(POINTS, np.mean(np.asarray(values)[points]))
        slide.append(_abscissae(np.asarray(measured.slide_to_roll)[points], logarithmic))
        load.append(mean(measured.load))
        speed.append(mean(measured.entrainment_speed))
        temperature.append(mean(measured.temperature))
    curves = []
    for first in range(0, len(numbers), _TOGETHER):
        chunk = [_filled(part[first : first + _TOGETHER]) for part in (slide, speed, temperature, load)]
        values = np.asarray(_compiled_coefficients(result.scene, *chunk)).reshape(_TOGETHER, POINTS)
        curves += [SmoothCurve(s, v) for s, v in zip(slide[first : first + _TOGETHER], values, strict=False)]
    return curves


def _abscissae(slide: np.ndarray, logarithmic: bool) -> np.ndarray:
    """Slide-to-roll ratios of a smooth curve, from 0 to the largest measured one, on both sides of 0 if both were
    measured; on a logarithmic axis a curve on one side begins at the smallest measured one."""
    low, high = float(slide.min()), float(slide.max())
    if low < 0.0 < high:
        half = POINTS // 2 - _NEAR_ZERO
        down, up = _side(slide[slide < 0.0], half, logarithmic), _side(slide[slide > 0.0], half, logarithmic)
        near = np.linspace(down[0], up[0], 2 * _NEAR_ZERO + 3)[1:-1]
        return np.concatenate([down[::-1], near, up])
    if low == high:
        return np.full(POINTS, low)
    away = slide[slide != 0.0]
    return _side(away, POINTS, True) if logarithmic else np.concatenate([[0.0], _side(away, POINTS - 1, False)])


def _side(slide: np.ndarray, count: int, logarithmic: bool) -> np.ndarray:
    """Slide-to-roll ratios on one side of 0, from the smallest to the largest."""
    size = np.abs(slide)
    if logarithmic:
        return np.sign(slide[0]) * np.geomspace(size.min(), size.max(), count)
    # closer together near 0, where the curves bend
    return np.sign(slide[0]) * size.max() * np.linspace(0.0, 1.0, count + 1)[1:] ** 2


def _filled(parts: list[np.ndarray]) -> Array:
    """All rows in one array, with copies of the last row up to the number of curves computed together."""
    return jnp.asarray(np.concatenate([*parts, *[parts[-1]] * (_TOGETHER - len(parts))]))


def _coefficients(scene: TwoDisk, slide: Values, speed: Values, temperature: Values, load: Values) -> Array:
    state = scene.state(slide, speed, temperature, load=load)
    return scene.traction(state).rolling / state.load


_compiled_coefficients = KeptProgram(_coefficients, quick=True)
