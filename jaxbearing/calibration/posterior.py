"""The posterior of calibrated fields, and what it predicts."""

from dataclasses import dataclass

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from fitting.posterior import Posterior, Sampling, Target, sampled

from .evaluation import at_points
from .result import Calibration

PREDICTED = 200
"""Samples of the posterior whose predictions are computed."""


@dataclass(frozen=True)
class Predictive:
    """Values as the posterior predicts them to be measured again, SI: median and ends of the interval of each measured
    value, and the share of the measured values inside."""

    median: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    inside: float


def posterior_of(found: Calibration, sampling: Sampling | None = None) -> Posterior:
    """Samples of the fields that were told, by the No-U-Turn sampler; the others keep their values.

    **Arguments:** `found`: a calibration that converged, with the linear loss.

    **Raises:** `ValueError` for another calibration; `fitting.posterior.PosteriorUnavailableError` without the library.
    """
    if not found.converged:
        raise ValueError(found.failure())
    if found.options.loss != "linear":
        raise ValueError(f"posterior: found the loss {found.options.loss!r}; expected 'linear', that of normal errors")
    search, free = found.search, found.settled.held.free
    place = np.flatnonzero(free)
    low, high = search.limits
    fields = [search.fields[i] for i in place]
    target = Target(
        names=found.fitted,
        evaluate=_evaluate(found),
        centre=np.asarray(found.settled.problem.natural(found.settled.u))[place],
        covariance=found.covariance[np.ix_(place, place)],
        scale=found.scale,
        known=found.options.known_errors,
        count=search.count,
        prior_mean=search.prior_mean[place],
        prior_deviation=search.prior_deviation[place],
        low=low[place],
        high=high[place],
        values=lambda part: np.stack([field.value(part[:, i]) for i, field in enumerate(fields)], axis=1),
    )
    return sampled(target, Sampling() if sampling is None else sampling, found.options.level)


def _evaluate(found: Calibration):
    """Residuals of the fitted values over their deviations and the Jacobian, traced, by the coordinates of the fields
    that were told."""
    search = found.search
    observed, place = search.observed, np.flatnonzero(found.settled.held.free)
    held = np.asarray(found.settled.problem.natural(found.settled.u))
    used = np.flatnonzero(search.weight > 0)
    paths = [field.path for field in search.fields]

    def evaluate(coordinates: Array) -> tuple[Array, Array]:
        whole = jnp.asarray(held).at[place].set(coordinates)
        predicted, slopes = jnp.zeros(len(observed)), jnp.zeros((len(observed), len(paths)))
        for number, (evaluator, data) in enumerate(zip(search.evaluators, search.rigs, strict=True)):
            own = [paths.index(path) for path in evaluator.paths]
            values = [search.fields[i].traced(whole[i]) for i in own]
            chain = jnp.stack([search.fields[i].traced_slope(whole[i]) for i in own])
            fields = {path: jnp.full(data.points, value) for path, value in zip(evaluator.paths, values, strict=True)}
            conditions = {path: jnp.asarray(column) for path, column in data.conditions.items()}
            active = jnp.ones(data.points, dtype=bool)
            results, derived, converged = at_points(
                evaluator.base, conditions, fields, active, evaluator.wanted, evaluator.options
            )
            mine = np.flatnonzero(observed.rig == number)
            column = np.array([evaluator.wanted.index(name) for name in observed.name[mine]])
            point = observed.point[mine]
            predicted = predicted.at[mine].set(jnp.where(converged[point], results[point, column], jnp.nan))
            part = derived[point, :, column] * chain
            slopes = slopes.at[np.ix_(mine, np.array(own))].set(part)
        size = observed.deviation[used]
        return (predicted[used] - observed.value[used]) / size, slopes[used][:, place] / size[:, None]

    return evaluate


def predictive(found: Calibration, posterior: Posterior, count: int = PREDICTED, seed: int = 0) -> Predictive:
    """Predicts by the posterior what would be measured at the operating points of the data, with new errors.

    **Arguments:** `count`: samples whose predictions are computed.
    """
    search = found.search
    flat = posterior.coordinates.reshape(-1, posterior.coordinates.shape[-1])
    chosen = np.linspace(0, len(flat) - 1, min(count, len(flat))).astype(int)
    whole = np.tile(np.asarray(found.settled.problem.natural(found.settled.u)), (len(chosen), 1))
    whole[:, found.settled.held.free] = flat[chosen]
    values, _ = search.predicted(whole)
    errors = np.random.default_rng(seed).normal(size=values.shape)
    scale = posterior.scale.reshape(-1)[chosen]
    again = values + errors * scale[:, None] * search.observed.deviation
    tail = 0.5 - 0.5 * found.options.level
    lower, median, upper = np.nanquantile(again, (tail, 0.5, 1.0 - tail), axis=0)
    measured = search.observed.value
    return Predictive(median, lower, upper, float(np.mean((lower <= measured) & (measured <= upper))))
