"""Identifiability: which parameters the data determine, by rule before a fit and by uncertainty after it; and the
sentences about it."""

import numpy as np

from .parameters import GROUPS, SCALES, SYMBOLS, Centre
from .uncertainty import UNKNOWN, Spread

HUGE = 20.0
"""Half-width of an interval of ln G or ln tau above which a message no longer quotes the factor of uncertainty."""
VISCOUS = 0.3
"""Deborah number below which the shear modulus cannot be seen."""
OIL_MODULUS = (3e6, 3e10)
"""Plausible range of the shear modulus, Pa, of an oil under contact pressure."""
OIL_STRESS = (1e5, 1e9)
"""Plausible range of the characteristic stress, Pa, of an oil under contact pressure."""
SAME_PRESSURE = 0.02
"""Relative span of the pressures below which they count as one."""
TOGETHER = 0.9
"""Correlation of pressure and 1/temperature from which their effects cannot be separated."""
SAME_TEMPERATURE = 5.0
"""Span of the temperatures, K, below which they count as one."""


def viscous_only(deborah: np.ndarray) -> str:
    """The reason why the data may not show the shear modulus, or an empty text. **Arguments:** `deborah`: Deborah
    numbers of the points."""
    if np.max(deborah) >= VISCOUS:
        return ""
    largest = f"{np.max(deborah):.2g}, below {VISCOUS:g}"
    return f"the data are viscous only (largest Deborah number {largest}): the shear modulus does not show"


def elastic_conditions(pressure: np.ndarray, temperature: np.ndarray, deborah: np.ndarray) -> dict[int, str]:
    """Reasons why the data do not determine alpha_G or beta_G, by index of the parameter: the shear modulus shows only
    where the Deborah number is not small, and those points have a single pressure or temperature.

    **Arguments:** pressure, Pa, temperature, K, and Deborah number of each point with the fitted oil.
    """
    elastic = deborah >= VISCOUS
    if np.all(elastic) or not np.any(elastic):
        return {}
    where = f"where the shear modulus shows (Deborah number from {VISCOUS:g})"
    reasons: dict[int, str] = {}
    if np.ptp(pressure[elastic]) < SAME_PRESSURE * np.mean(pressure):
        reasons[GROUPS[0][1]] = f"one pressure only {where}"
    if np.ptp(temperature[elastic]) < SAME_TEMPERATURE:
        reasons[GROUPS[0][2]] = f"one temperature only {where}"
    return reasons


def implausible(modulus: float, stress: float) -> list[str]:
    """Sentences where shear modulus or stress at the centre of the data, Pa, are not those of an oil under pressure."""
    sentences = []
    low, high = OIL_MODULUS
    if not low <= modulus <= high:
        sentences.append(
            f"The shear modulus at the middle of the data, {modulus:.3g} Pa, is not that of an oil under pressure (0.1 "
            "to 1 GPa): it stands for something else, as the compliance of bodies or machine, or contact of asperities."
        )
    low, high = OIL_STRESS
    if not low <= stress <= high:
        sentences.append(
            f"The characteristic stress at the middle of the data, {stress:.3g} Pa, is not that of an oil under "
            "pressure (1 to 100 MPa)."
        )
    return sentences


def frozen_by_rule(pressure: np.ndarray, temperature: np.ndarray, held: tuple[bool, bool]) -> dict[int, str]:
    """Reasons, known before any fit, why the data do not determine a parameter, by index of the parameter.

    **Arguments:** mean pressure, Pa, and temperature, K, of the points; `held`: whether the user holds G0, and tau0.
    With a held value, data at a single pressure determine the pressure coefficient if the temperature varies, and data
    at a single temperature the temperature coefficient if the pressure varies.
    """
    reasons: dict[int, str] = {}
    one_pressure = np.ptp(pressure) < SAME_PRESSURE * np.mean(pressure)
    one_temperature = np.ptp(temperature) < SAME_TEMPERATURE
    for group, value_given in zip(GROUPS, held, strict=True):
        if one_pressure and not (value_given and not one_temperature):
            reasons[group[1]] = "one pressure only"
        if one_temperature and not (value_given and not one_pressure):
            reasons[group[2]] = "one temperature only"
    return reasons


def confounded(pressure: np.ndarray, temperature: np.ndarray) -> str:
    """A sentence where pressure and temperature change together, or an empty text."""
    inverse = 1.0 / temperature
    if np.ptp(pressure) < SAME_PRESSURE * np.mean(pressure) or np.ptp(temperature) < SAME_TEMPERATURE:
        return ""
    together = float(np.corrcoef(pressure, inverse)[0, 1])
    if abs(together) < TOGETHER:
        return ""
    return (
        f"Pressure and temperature change together (correlation of p and 1/T {together:.2f}): the curves hardly tell "
        "their effects apart, and the intervals lean on the shape of the law."
    )


def not_determined(spread: Spread, directions: np.ndarray, free: np.ndarray, centre: Centre) -> dict[int, str]:
    """Reasons why a fit does not determine a free parameter, by its index: G or tau is uncertain by more than a factor
    of 3 at the centre of the data or, for a coefficient, over half their range.

    **Arguments:** `directions`: matrix from centred to natural coordinates of the fit.
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
                reasons[index] = "the data do not show it"
                if half < HUGE:
                    factor = np.exp(half)
                    reasons[index] = f"its effect on the data is uncertain by a factor of {factor:.3g} to either side"
    return reasons


def _quadratic(covariance: np.ndarray, row: np.ndarray) -> float:
    used = row != 0
    part = covariance[np.ix_(used, used)]
    if not np.all(np.isfinite(part)):
        return np.inf
    return float(row[used] @ part @ row[used])


def in_words(index: int, reason: str) -> str:
    """One sentence for the report on a parameter that is not determined."""
    return f"{SYMBOLS[index]} cannot be determined: {reason}."
