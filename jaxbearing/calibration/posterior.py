"""Posterior distribution of calibrated fields, and its predictions."""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from fitting.posterior import Posterior, Sampling, Target, sampled
from fitting.predictive import PREDICTED, Predictive, chosen_samples, measured_again

from .evaluation import at_points
from .result import Calibration


def posterior_of(found: Calibration, sampling: Sampling | None = None) -> Posterior:
    """Samples of the fitted fields by the No-U-Turn sampler; the held ones keep their values.

    **Arguments:** `found`: a calibration that converged, with the linear loss.

    **Raises:** `ValueError` for another calibration; `fitting.posterior.PosteriorUnavailableError` without NumPyro.
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


def _evaluate(calibration: Calibration):
    """Traceable function from the coordinates of the fitted fields to the residuals of the fitted values, over their
    deviations, and the Jacobian."""
    search = calibration.search
    observed, place = search.observed, np.flatnonzero(calibration.settled.held.free)
    held = np.asarray(calibration.settled.problem.natural(calibration.settled.u))
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
    """Posterior prediction of a repeated measurement at the operating points of the data, with new random errors.

    **Arguments:** `found`: the calibration of the posterior; `count`: number of samples whose predictions are computed.

    **Raises:** `ValueError` where a sample has no solution.
    """
    search, place = found.search, chosen_samples(posterior, count)
    whole = np.tile(np.asarray(found.settled.problem.natural(found.settled.u)), (len(place), 1))
    whole[:, found.settled.held.free] = posterior.coordinates.reshape(-1, posterior.coordinates.shape[-1])[place]
    values, _ = search.predicted(whole)
    observed = search.observed
    return measured_again(
        posterior, place, values, observed.value, observed.deviation, tuple(map(str, observed.name)), seed
    )
