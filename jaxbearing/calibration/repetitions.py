"""Calibrations of repeated measurements, to check the coverage of the intervals."""

from typing import NamedTuple

import numpy as np

from fitting.uncertainty import spread

from .result import Calibration


class Repetitions(NamedTuple):
    """Calibrations of repeated measurements, SI: values of the fields and ends of their intervals, (repetition, field),
    and a mask of those that converged."""

    value: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    converged: np.ndarray

    def covered(self, truth: np.ndarray) -> np.ndarray:
        """Share of the converged repetitions whose interval contains the true value, for each field."""
        inside = (self.lower <= truth) & (truth <= self.upper)
        return np.mean(inside[self.converged], axis=0)


def repeated(found: Calibration, measured: np.ndarray) -> Repetitions:
    """Repeats the calibration with other measured values at the same operating points, all sets of values side by side.
    The same fields are fitted, from the calibrated values.

    **Arguments:** `measured`: (repetition, value), in the order of `found.measured`, SI.
    """
    search, problem, free = found.search, found.settled.problem, found.settled.held.free
    options = search.options
    measured = np.asarray(measured, dtype=float)
    start = np.tile(found.settled.u, (len(measured), 1))
    estimate = search.lanes(problem, start, measured=measured)
    coordinates = problem.natural(estimate.u)
    predicted, slopes = search.predicted(coordinates)
    used = problem.weight > 0
    half = np.full(coordinates.shape, np.nan)
    for lane in range(len(measured)):
        rows = slopes[lane, used] / search.observed.deviation[used, None]
        residual = (predicted[lane, used] - measured[lane, used]) / search.observed.deviation[used]
        variance = search.variance_of(residual, rows, problem.scale, free)
        _, whole = search.with_priors(
            np.zeros((1, len(rows))), rows[None] / np.sqrt(variance), coordinates[lane : lane + 1]
        )
        own = spread(whole[0], free, 1.0, options.level)
        half[lane] = search.quantile(own) * np.sqrt(np.diag(own.covariance))
    at = lambda where: np.stack([field.value(where[:, i]) for i, field in enumerate(search.fields)], axis=1)
    value, lower, upper = at(coordinates), at(coordinates - half), at(coordinates + half)
    return Repetitions(value, lower, upper, np.asarray(estimate.converged))
