"""Which parameters the data can tell: by rule before a fit, by their uncertainty after it; in words."""

import numpy as np

from .parameters import GROUPS, SCALES, SYMBOLS, Centre
from .uncertainty import UNKNOWN, Spread

VISCOUS = 0.3
"""Deborah number below which the shear modulus cannot be seen."""
SAME_PRESSURE = 0.02
"""Relative span of the pressures below which they count as one."""
SAME_TEMPERATURE = 5.0
"""Span of the temperatures, K, below which they count as one."""


def frozen_by_rule(pressure: np.ndarray, temperature: np.ndarray, deborah: np.ndarray) -> dict[int, str]:
    """Index of a parameter -> why the data cannot tell it, before any fit.

    **Arguments:** mean pressure, Pa, temperature, K, and Deborah number of the points.
    """
    reasons: dict[int, str] = {}
    modulus, stress = GROUPS
    if np.max(deborah) < VISCOUS:
        for index in modulus:
            reasons[index] = (
                f"the data are viscous only (largest Deborah number {np.max(deborah):.2g}, below {VISCOUS:g}): the "
                "shear modulus does not show"
            )
    for group in (modulus, stress):
        if np.ptp(pressure) < SAME_PRESSURE * np.mean(pressure):
            reasons.setdefault(group[1], "one pressure only")
        if np.ptp(temperature) < SAME_TEMPERATURE:
            reasons.setdefault(group[2], "one temperature only")
    return reasons


def not_determined(spread: Spread, directions: np.ndarray, free: np.ndarray, centre: Centre) -> dict[int, str]:
    """Index of a free parameter -> why its interval says nothing: ln G or ln tau is uncertain by more than a factor of
    3 at the centre of the data, or, for a coefficient, across their range.

    **Arguments:** `directions`: from centred to natural coordinates, as fitted.
    """
    reasons: dict[int, str] = {}
    # covariance at the centre: ln G_c = ln G0 + arm . (alpha, beta)
    for group in GROUPS:
        arms = np.zeros(len(free))
        arms[list(group)] = 1.0, -directions[group[0], group[1]], -directions[group[0], group[2]]
        reach = (
            1.0,
            0.5 * centre.pressure_span * SCALES[group[1]],
            0.5 * centre.inverse_temperature_span * SCALES[group[2]],
        )
        rows = [arms, np.eye(len(free))[group[1]], np.eye(len(free))[group[2]]]
        for index, row, length in zip(group, rows, reach, strict=True):
            if not free[index]:
                continue
            variance = _quadratic(spread.covariance, row)
            half = spread.quantile * np.sqrt(variance) * length if np.isfinite(variance) else np.inf
            if not half <= UNKNOWN:
                factor = np.exp(min(half, 50.0))
                reasons[index] = f"its effect on the data is uncertain by a factor of {factor:.3g} to either side"
    return reasons


def _quadratic(covariance: np.ndarray, row: np.ndarray) -> float:
    used = row != 0
    part = covariance[np.ix_(used, used)]
    if not np.all(np.isfinite(part)):
        return np.inf
    return float(row[used] @ part @ row[used])


def in_words(index: int, reason: str) -> str:
    """One sentence for the report."""
    return f"{SYMBOLS[index]} cannot be determined: {reason}."
