"""The posterior: its potential and gradient, and the sampler beside least squares and beside exact distributions."""

import dataclasses

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy import stats

from fitting.posterior import (
    Marginal,
    Posterior,
    PosteriorUnavailableError,
    Sampling,
    Target,
    available,
    potential_of,
    sampled,
)
from fitting.predictive import chosen_samples, measured_again

COUNT = 24
MATRIX = np.stack([np.ones(COUNT), np.linspace(-1.0, 1.0, COUNT)], axis=1)


def line(known=False, prior=(np.inf, np.inf), curvature=0.0):
    """A line through noisy points, bent a little; its least squares with numpy."""
    rng = np.random.default_rng(3)
    measured = MATRIX @ [2.0, 1.0] + 0.3 * rng.normal(size=COUNT)

    def evaluate(x):
        model = lambda x: MATRIX @ x + curvature * x[1] ** 2
        return model(x) - measured, jax.jacfwd(model)(x)

    centre, square, *_ = np.linalg.lstsq(MATRIX, measured)
    scale = 1.0 if known else float(np.sqrt(square[0] / (COUNT - 2)))
    covariance = scale**2 * np.linalg.inv(MATRIX.T @ MATRIX)
    free = np.full(2, np.inf)
    return Target(
        names=("level", "slope"),
        evaluate=evaluate,
        centre=centre,
        covariance=covariance,
        scale=scale,
        known=known,
        count=COUNT,
        prior_mean=np.zeros(2),
        prior_deviation=np.array(prior),
        low=-free,
        high=free,
        values=np.asarray,
    )


def test_the_gradient_is_that_of_the_potential():
    """Of a bent model with a prior, against JAX's own derivative of the same sum."""
    target = line(prior=(0.5, np.inf), curvature=0.4)
    root = np.linalg.cholesky(target.covariance)
    potential = potential_of(target, jnp.asarray(root))

    def plainly(place):
        x = target.centre + root @ place[:2]
        log_scale = np.log(target.scale) + place[2] / np.sqrt(2.0 * (COUNT - 2))
        residual = target.evaluate(x)[0]
        prior = 0.5 * (x[0] / 0.5) ** 2
        return 0.5 * jnp.sum(jnp.square(residual)) * jnp.exp(-2.0 * log_scale) + COUNT * log_scale + prior

    for place in np.random.default_rng(0).normal(size=(3, 3)):
        np.testing.assert_allclose(potential(place), plainly(place), rtol=1e-13)
        np.testing.assert_allclose(jax.grad(potential)(place), jax.grad(plainly)(place), rtol=1e-11)


def test_nothing_is_likely_beyond_a_bound():
    target = dataclasses.replace(line(), high=np.array([np.inf, 0.0]))
    potential = potential_of(target, jnp.eye(2))
    assert np.isinf(potential(jnp.zeros(3)))
    assert np.all(np.isfinite(jax.grad(potential)(jnp.zeros(3))))


def test_counts_that_are_too_small():
    with pytest.raises(ValueError, match="chains: found 1"):
        sampled(line(), Sampling(chains=1), 0.95)


def test_without_the_library_it_says_so(monkeypatch):
    monkeypatch.setattr("fitting.posterior.available", lambda: False)
    with pytest.raises(PosteriorUnavailableError, match="extra 'posterior'"):
        sampled(line(), Sampling(), 0.95)


def drawn_posterior(coordinates, scale):
    """A posterior of one parameter with these samples."""
    marginal = Marginal(0.0, 0.0, 1.0, -2.0, 2.0, 1.0, 1000.0)
    values = np.asarray(coordinates)[..., None]
    return Posterior({"level": marginal}, values, values, scale, 0, 3.0, 0.95, Sampling())


def test_a_new_measurement_scatters_by_samples_and_errors():
    """Normal samples and normal errors: variances add up, and 95 % are 1.96 deviations of the sum."""
    rng = np.random.default_rng(11)
    found = drawn_posterior(0.3 * rng.normal(size=(4, 5000)), np.full((4, 5000), 2.0))
    place = chosen_samples(found, 20000)
    values = found.values.reshape(-1, 1)[place] + np.array([[1.0, 5.0]])
    again = measured_again(found, place, values, np.array([1.1, 9.0]), np.array([0.2, 0.2]), ("a", "a"))
    half = stats.norm.ppf(0.975) * np.hypot(0.3, 2.0 * 0.2)
    # four standard errors of a quantile of so many samples: the density there is 0.0584 over the deviation
    error = 4.0 * np.sqrt(0.025 * 0.975 / len(place)) / 0.0584 * np.hypot(0.3, 0.4)
    np.testing.assert_allclose(again.upper - [1.0, 5.0], half, atol=error)
    np.testing.assert_allclose(again.lower - [1.0, 5.0], -half, atol=error)
    np.testing.assert_allclose(again.deviation, 0.4, rtol=1e-12)
    assert again.inside == 0.5
    assert again.in_words().startswith("1 of 2 measured values lie within the 95 % intervals in which 20000 samples")
    assert set(again.to_dict()) == {"median", "lower", "upper", "inside", "level", "samples"}


def test_a_sample_without_a_solution_is_said():
    found = drawn_posterior(np.zeros((2, 50)), np.ones((2, 50)))
    place = chosen_samples(found, 10)
    values = np.ones((10, 1))
    values[3] = np.nan
    with pytest.raises(ValueError, match="no solution with 1 of 10 samples"):
        measured_again(found, place, values, np.ones(1), np.ones(1), ("a",))


# NumPyro is an extra of the package; `.[test]`, which README and CI install, has it, so these tests run there
needs_library = pytest.mark.skipif(not available(), reason="NumPyro is not installed")


@needs_library
@pytest.mark.parametrize(
    "known",
    [pytest.param(False, id="errors estimated", marks=pytest.mark.slow), pytest.param(True, id="errors known")],
)
def test_sampler_and_least_squares_agree(known):
    """Of a linear problem the marginals are exact: Student's with n - k degrees, or normal. Asked: R-hat < 1.01."""
    target = line(known)
    found = sampled(target, Sampling(samples=1500), 0.95)
    assert found.mixed, found.warnings
    quantile = (stats.norm if known else stats.t(COUNT - 2)).ppf(0.975)
    for i, one in enumerate(found.parameters.values()):
        assert one.r_hat < 1.01
        deviation = np.sqrt(target.covariance[i, i])
        # Monte Carlo errors, four standard ones: of a mean, and of a quantile in the tail
        assert abs(one.mean - target.centre[i]) < 4.0 * deviation / np.sqrt(one.effective)
        density = 2.8 / np.sqrt(one.effective)
        for end, side in ((one.lower, -1.0), (one.upper, 1.0)):
            assert abs(end - target.centre[i] - side * quantile * deviation) < 4.0 * density * deviation
    assert found.values.shape == (4, 1500, 2)
    assert np.all(found.scale > 0.0)


@needs_library
def test_a_prior_narrows_the_posterior():
    """Errors known: precisions add up exactly."""
    target = line(known=True, prior=(0.1, np.inf))
    found = sampled(target, Sampling(samples=1500), 0.95)
    precision = np.linalg.inv(target.covariance) + np.diag([100.0, 0.0])
    deviation = np.sqrt(np.diag(np.linalg.inv(precision)))
    for i, one in enumerate(found.parameters.values()):
        # four standard errors of a deviation from so many independent samples
        np.testing.assert_allclose(one.deviation, deviation[i], rtol=4.0 / np.sqrt(2.0 * one.effective))


@needs_library
def test_the_same_seed_gives_the_same_samples():
    few = Sampling(chains=2, warmup=50, samples=50, seed=7)
    first, second = (sampled(line(), few, 0.95) for _ in range(2))
    np.testing.assert_array_equal(first.values, second.values)
