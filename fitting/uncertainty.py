"""Uncertainty of each parameter."""

from typing import NamedTuple

import numpy as np
from scipy import stats

SINGULAR = 1e-10
"""Singular value of the column-scaled Jacobian, relative to the largest, up to which the data say nothing about its
direction."""
UNKNOWN = float(np.log(3.0))
"""Half-width of the interval of ln G or ln tau within the range of the data, above which a parameter is not determined:
a factor of 3 to either side."""


class Spread(NamedTuple):
    """Covariance of the natural coordinates (0 for held ones), quantile of Student's distribution for the interval,
    condition number, and `degrees`: informative points minus free parameters."""

    covariance: np.ndarray
    quantile: float
    condition: float
    degrees: int


def spread(jacobian: np.ndarray, free: np.ndarray, variance: float, level: float) -> Spread:
    """Linearized covariance of the free parameters, $s^2(J^TJ)^{-1}$; infinite for those that the data do not show.

    **Arguments:** `jacobian`: of the residuals, (point, parameter); `free`: mask of the free parameters; `variance`:
    s^2; `level`: of the interval, e.g. 0.95.
    """
    indices = np.flatnonzero(free)
    covariance = np.zeros((len(free), len(free)))
    degrees = informative(jacobian, free) - len(indices)
    quantile = float(stats.t.ppf(0.5 + 0.5 * level, degrees)) if degrees > 0 else np.nan
    if len(indices) == 0:
        return Spread(covariance, quantile, 1.0, degrees)
    columns = jacobian[:, indices]
    norms = np.linalg.norm(columns, axis=0)
    seen = (norms > 0) & np.isfinite(norms)
    scaled = np.where(seen, columns, 0.0) / np.where(seen, norms, 1.0)
    _, singular, right = np.linalg.svd(scaled, full_matrices=False)
    if len(singular) < len(indices):
        inverse = np.full((len(indices),) * 2, np.inf)
        condition = np.inf
    else:
        small = singular <= SINGULAR * singular[0]
        condition = float(singular[0] / singular[-1]) if singular[-1] > 0 else np.inf
        inverse = (right.T / np.square(np.where(small, 1.0, singular))) @ right
        # a parameter that takes part in an unseen direction is not known at all
        lost = np.any(np.abs(right[small]) > 1e-3, axis=0) | ~seen
        inverse[lost] = inverse[:, lost] = 0.0
        inverse[lost, lost] = np.inf
    scale = np.outer(np.where(seen, norms, 1.0), np.where(seen, norms, 1.0))
    covariance[np.ix_(indices, indices)] = variance * inverse / scale
    return Spread(covariance, quantile, condition, degrees)


def informative(jacobian: np.ndarray, free: np.ndarray) -> int:
    """Number of points on which the free parameters have an effect: a point without sliding, for example, has none."""
    size = np.linalg.norm(jacobian[:, free], axis=1)
    return int(np.sum(size > SINGULAR * np.max(size, initial=0.0)))


def correlation(covariance: np.ndarray) -> np.ndarray:
    """Correlation matrix; NaN for parameters without a finite variance."""
    deviation = np.sqrt(np.diag(covariance))
    usable = np.isfinite(deviation) & (deviation > 0)
    size = np.where(usable, deviation, np.nan)
    with np.errstate(invalid="ignore"):
        return covariance / np.outer(size, size)
