"""The posterior of an oil's rheology: samples of the parameters that a fit determined."""

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from jaxbearing.lubricants import ExponentialRheology

from .parameters import NAMES, natural, values_of
from .posterior import Posterior, Sampling, Target, sampled
from .predictive import PREDICTED, Predictive, chosen_samples, measured_again
from .result import FitResult
from .search import Search
from .traction import coefficients, predicted_coefficients


def posterior_of(result: FitResult, sampling: Sampling | None = None) -> Posterior:
    """Draws samples of the parameters that have a confidence interval, with the No-U-Turn sampler. All other parameters
    keep their values.

    **Arguments:** `result`: a converged fit with the linear loss; `sampling`: number of samples and seed.

    **Raises:** `ValueError` if the fit did not converge or has another loss, if no parameter has a confidence interval,
    and for numbers of samples that are too small; `fitting.posterior.PosteriorUnavailableError` without NumPyro.
    """
    if not result.converged:
        raise ValueError(result.failure())
    if result.options.loss != "linear":
        raise ValueError(f"posterior: found the loss {result.options.loss!r}; expected 'linear', that of normal errors")
    determined = [name for name in result.fitted if result.parameters[name].standard_error is not None]
    if not determined:
        raise ValueError("posterior: found no parameter with an interval; expected curves that tell one or more")
    place = np.array([NAMES.index(name) for name in determined])
    among = [result.fitted.index(name) for name in determined]
    search = Search(result.measurements, result.scene, result.options)
    rheology = result.oil.rheology
    assert isinstance(rheology, ExponentialRheology)
    at_end = natural(rheology)
    low, high = search.limits
    scene, state = search.scene, search.state
    measured, deviation = search.coefficient, result.deviation

    def evaluate(coordinates: Array) -> tuple[Array, Array]:
        def residual(part: Array) -> Array:
            whole = jnp.asarray(at_end).at[place].set(part)
            return (predicted_coefficients(scene, state, rheology, whole) - measured) / deviation

        along = lambda direction: jax.jvp(residual, (coordinates,), (direction,))
        return jax.vmap(along, out_axes=(None, 1))(jnp.eye(len(place)))

    def values(part: np.ndarray) -> np.ndarray:
        whole = np.tile(at_end, (len(part), 1))
        whole[:, place] = part
        return values_of(whole)[:, place]

    left = (result.predicted - measured) / deviation
    degrees = max(len(left) - len(place), 1)
    target = Target(
        names=tuple(determined),
        evaluate=evaluate,
        centre=at_end[place],
        covariance=result.covariance[np.ix_(among, among)],
        scale=float(np.sqrt(np.sum(np.square(left)) / degrees)),
        known=False,
        count=len(left),
        prior_mean=np.zeros(len(place)),
        prior_deviation=np.full(len(place), np.inf),
        low=low[place],
        high=high[place],
        values=values,
    )
    return sampled(target, Sampling() if sampling is None else sampling, result.level)


def predictive(result: FitResult, posterior: Posterior, count: int = PREDICTED, seed: int = 0) -> Predictive:
    """Predictive distribution of the traction coefficients: the values that a repeated measurement would give at the
    points of the data.

    **Arguments:** `result`: the fit from which the posterior was sampled; `count`: number of samples of the posterior
    for which the traction coefficients are computed; `seed`: of the random errors of the repeated measurement.

    **Raises:** `ValueError` if the model has no solution for a sample.
    """
    search, place = Search(result.measurements, result.scene, result.options), chosen_samples(posterior, count)
    rheology = result.oil.rheology
    assert isinstance(rheology, ExponentialRheology)
    whole = np.tile(natural(rheology), (len(place), 1))
    columns = [NAMES.index(name) for name in posterior.parameters]
    whole[:, columns] = posterior.coordinates.reshape(-1, len(columns))[place]
    values = np.stack([coefficients(search.scene, search.state, rheology, jnp.asarray(sample)) for sample in whole])
    measured, deviation = np.asarray(search.coefficient), np.asarray(result.deviation)
    names = ("traction_coefficient",) * len(measured)
    return measured_again(posterior, place, values, measured, deviation, names, seed)
