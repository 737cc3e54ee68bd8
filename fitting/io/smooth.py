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
"""Points on either side of 0 below the smallest slides."""
_TOGETHER = 8
"""Curves that are computed side by side; always as many, so that one program does for all files."""


class SmoothCurve(NamedTuple):
    """The model at the mean conditions of a curve, over its range of slide-to-roll ratios."""

    slide_to_roll: np.ndarray
    traction_coefficient: np.ndarray


def smooth_curves(result: FitResult, numbers: list[int], logarithmic: bool) -> list[SmoothCurve]:
    """The fitted model along curves of the measurements.

    **Arguments:** `numbers`: of the curves; `logarithmic`: whether small slides are to be shown, too.
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
    """Abscissae of a smooth curve: over the measured range and to 0, on both sides if measured; on a logarithmic axis
    down to the smallest slide."""
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
    """Away from 0 to the largest slide, all of one sign."""
    size = np.abs(slide)
    if logarithmic:
        return np.sign(slide[0]) * np.geomspace(size.min(), size.max(), count)
    # more of them near 0, where the curves bend
    return np.sign(slide[0]) * size.max() * np.linspace(0.0, 1.0, count + 1)[1:] ** 2


def _filled(parts: list[np.ndarray]) -> Array:
    """One row after the other, as many as are computed together."""
    return jnp.asarray(np.concatenate([*parts, *[parts[-1]] * (_TOGETHER - len(parts))]))


def _coefficients(scene: TwoDisk, slide: Values, speed: Values, temperature: Values, load: Values) -> Array:
    state = scene.state(slide, speed, temperature, load=load)
    return scene.traction(state).rolling / state.load


_compiled_coefficients = KeptProgram(_coefficients, quick=True)
