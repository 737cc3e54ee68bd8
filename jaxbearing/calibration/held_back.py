"""Prediction of values that were not fitted: those held back in the data, or each fold from the others."""

import numpy as np

from fitting.holding import Settled
from fitting.uncertainty import Spread

from .result import HeldBack
from .search import Search

DISPLACED = 0.2
"""Displacement of the start of a calibration without one fold from the result with all values, in coordinates: that
result already contains the values that are left out."""


def held_back_of(search: Search, settled: Settled, spread: Spread, scale: float, folds: int) -> HeldBack | None:
    """Predictions of each fold from the others or, with fewer than 2 `folds`, of the values held back in the data;
    `None` where there are neither.

    **Arguments:** `scale`: size of the errors, over their assumed deviations.
    """
    mine = np.flatnonzero(search.observed.held_back)
    if folds < 2 and not len(mine):
        return None
    u = np.asarray(settled.u)
    if folds < 2:
        return _predictions(search, settled, u[None], mine, np.zeros(len(mine), dtype=int), spread, scale, True)
    fitted = np.flatnonzero(search.weight > 0)
    # folds of whole operating points, so that no other result of a left-out point is fitted
    keys = search.observed.rig[fitted] * (1 + np.max(search.observed.point)) + search.observed.point[fitted]
    fold = np.unique(keys, return_inverse=True)[1] % folds
    weight = np.tile(settled.problem.weight, (folds, 1))
    weight[fold, fitted] = 0.0
    shifted = u + DISPLACED * np.minimum(search.prior_deviation, 1.0) * settled.problem.free
    estimate = search.lanes(settled.problem, np.tile(shifted, (folds, 1)), weight)
    return _predictions(
        search, settled, estimate.u, fitted, fold, spread, scale, bool(np.all(estimate.converged)), weight
    )


def _predictions(
    search: Search,
    settled: Settled,
    u: np.ndarray,
    places: np.ndarray,
    lane: np.ndarray,
    spread: Spread,
    scale: float,
    converged: bool,
    weight: np.ndarray | None = None,
) -> HeldBack:
    """Predictions of the values at `places`, each from the unknowns of its lane, with the standard deviation of the
    difference from a measurement."""
    values, slopes = search.predicted(settled.problem.natural(u))
    predicted, along = values[lane, places], slopes[lane, places]
    covariances = []
    for row, own in enumerate(slopes):
        used = (search.weight if weight is None else weight[row]) > 0
        covariances.append(search.covariance_of(own[used] / search.observed.deviation[used, None] / scale, settled))
    left = np.einsum("pi,pij,pj->p", along, np.stack(covariances)[lane], along)
    deviation = np.sqrt(left + np.square(scale * search.observed.deviation[places]))
    measured = search.observed.value[places]
    return HeldBack(places, measured, predicted, deviation, float(spread.quantile), converged)
