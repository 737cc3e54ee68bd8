r"""Posterior distribution of the parameters, by the No-U-Turn sampler of NumPyro, with the model and the derivatives of
the fit.

$\ln p(x, s) = -\frac{1}{2}\sum_i(r_i/s)^2 - n\ln s - \frac{1}{2}\sum_k((x_k - m_k)/d_k)^2$ within the bounds. $r_i$ are
the residuals over their assumed deviations. The size $s$ of the errors has a uniform prior of its logarithm; where the
errors are known, $s = 1$. The coordinates $x_k$ have normal priors with means $m_k$ and standard deviations $d_k$. For
a linear problem without priors, the marginals are the Student distributions of the least-squares intervals.

The sampler moves in coordinates in which the least-squares covariance is the identity.

**Reference:** Hoffman and Gelman (2014), *The No-U-Turn sampler*, Journal of Machine Learning Research 15, 1593;
R-hat and effective samples: Gelman et al. (2013), *Bayesian Data Analysis*, sections 11.4 and 11.5.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

MISSING = "the posterior needs NumPyro, an optional dependency: install the extra 'posterior'"
GOOD_R_HAT, GOOD_EFFECTIVE = 1.01, 400.0
"""Limit below which R-hat must be, and least number of effective samples, for the chains to agree."""
SPREAD = 1.0
"""Standard deviation of the starting points of the chains, over that of the least-squares estimate."""


class PosteriorUnavailableError(ImportError):
    """Error for a missing NumPyro, the library that draws the samples."""


@dataclass(frozen=True)
class Sampling:
    """Numbers of samples, and the seed.

    **Arguments:** `chains`; `warmup`, `samples`: of each chain; `seed`: the same seed gives the same samples.
    """

    chains: int = 4
    warmup: int = 300
    samples: int = 1000
    seed: int = 0

    def check(self) -> None:
        """Checks the numbers of chains and samples.

        **Raises:** `ValueError` for counts that are too small.
        """
        for name, least in (("chains", 2), ("warmup", 50), ("samples", 50)):
            if getattr(self, name) < least:
                raise ValueError(f"{name}: found {getattr(self, name)}, expected {least} or more")


@dataclass(frozen=True)
class Target:
    """The density that is sampled.

    **Arguments:**
    - `names`: of the parameters.
    - `evaluate`: traceable function from coordinates to residuals over deviations and their Jacobian.
    - `centre`, `covariance`: least-squares estimate of the coordinates and its covariance.
    - `scale`: size of the errors by least squares; `known`: whether the errors are known, so that it is 1.
    - `count`: number of residuals.
    - `prior_mean`, `prior_deviation`: of the coordinates; the deviation is infinite where there is no prior.
    - `low`, `high`: bounds of the coordinates.
    - `values`: function from coordinates, (sample, parameter), to SI values, numpy.
    """

    names: tuple[str, ...]
    evaluate: Callable[[Array], tuple[Array, Array]]
    centre: np.ndarray
    covariance: np.ndarray
    scale: float
    known: bool
    count: int
    prior_mean: np.ndarray
    prior_deviation: np.ndarray
    low: np.ndarray
    high: np.ndarray
    values: Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Marginal:
    """Marginal posterior distribution of one parameter, SI: mean, median, standard deviation, ends of the equal-tailed
    interval, R-hat of the split chains and number of effective samples."""

    mean: float
    median: float
    deviation: float
    lower: float
    upper: float
    r_hat: float
    effective: float


@dataclass(frozen=True)
class Posterior:
    """Samples of the parameters.

    **Arguments:**
    - `parameters`: marginal distribution of each.
    - `coordinates`, `values`: samples, (chain, sample, parameter); `values` in SI.
    - `scale`: size of the errors over the deviations, (chain, sample).
    - `divergences`: samples at which the integration failed; `steps`: mean number of evaluations of a sample.
    - `level`: of the intervals; `sampling`: how the samples were drawn.
    """

    parameters: Mapping[str, Marginal]
    coordinates: np.ndarray
    values: np.ndarray
    scale: np.ndarray
    divergences: int
    steps: float
    level: float
    sampling: Sampling

    @property
    def mixed(self) -> bool:
        """True if the chains agree: R-hat below 1.01, at least 400 effective samples, no divergence."""
        good = lambda marginal: marginal.r_hat < GOOD_R_HAT and marginal.effective >= GOOD_EFFECTIVE
        return all(map(good, self.parameters.values())) and not self.divergences

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on chains that do not agree."""
        sentences = []
        for name, marginal in self.parameters.items():
            if not marginal.r_hat < GOOD_R_HAT:
                sentences.append(f"the chains do not agree on {name} (R-hat {marginal.r_hat:.3f}): draw more samples.")
            elif marginal.effective < GOOD_EFFECTIVE:
                sentences.append(f"{name} has {marginal.effective:.0f} effective samples only: draw more samples.")
        if self.divergences:
            sentences.append(
                f"{self.divergences} samples diverged: a bound, or a region that the sampler cannot enter."
            )
        return tuple(sentences)

    def in_words(self) -> str:
        """A sentence that says how the samples were drawn."""
        sampling = self.sampling
        return (
            f"No-U-Turn, {sampling.chains} chains of {sampling.samples} samples after {sampling.warmup} of adaptation "
            f"(seed {sampling.seed}), {self.steps:.1f} evaluations each, {self.divergences} divergences"
        )

    def to_dict(self) -> dict[str, Any]:
        """Marginal distributions and the figures of their quality, as plain values."""
        whole: dict[str, Any] = {
            "parameters": {name: dict(vars(marginal)) for name, marginal in self.parameters.items()}
        }
        whole |= {"mixed": self.mixed, "divergences": self.divergences, "steps": self.steps, "level": self.level}
        return whole | dict(vars(self.sampling))

    def thinned(self, count: int) -> np.ndarray:
        """Coordinates of `count` samples, selected evenly from all chains, (sample, parameter)."""
        flat = self.coordinates.reshape(-1, self.coordinates.shape[-1])
        return flat[np.linspace(0, len(flat) - 1, min(count, len(flat))).astype(int)]


def available() -> bool:
    """True if NumPyro is installed."""
    from importlib.util import find_spec

    return find_spec("numpyro") is not None


def sampled(target: Target, sampling: Sampling, level: float) -> Posterior:
    """Draws samples of a posterior. **Arguments:** `level`: of the intervals.

    **Raises:** `PosteriorUnavailableError` without NumPyro; `ValueError` for counts that are too small.
    """
    sampling.check()
    if not available():
        raise PosteriorUnavailableError(MISSING)
    from numpyro.infer import MCMC, NUTS  # pyright: ignore[reportMissingImports]

    root = np.linalg.cholesky(target.covariance)
    potential = potential_of(target, jnp.asarray(root))
    size = len(target.names) + (0 if target.known else 1)
    mcmc = MCMC(
        NUTS(potential_fn=potential, target_accept_prob=0.85),
        num_warmup=sampling.warmup,
        num_samples=sampling.samples,
        num_chains=sampling.chains,
        chain_method="sequential",
        progress_bar=False,
    )
    starts = SPREAD * np.random.default_rng(sampling.seed).normal(size=(sampling.chains, size))
    starts[:, : len(target.names)] = _inside(target, root, starts[:, : len(target.names)])
    key = jax.random.PRNGKey(sampling.seed)
    # NumPyro leaves types and shapes to JAX's own rules, which a user may have made stricter
    with jax.numpy_dtype_promotion("standard"), jax.numpy_rank_promotion("allow"):
        mcmc.run(key, init_params=jnp.asarray(starts), extra_fields=("diverging", "num_steps"))
    drawn = np.asarray(mcmc.get_samples(group_by_chain=True))
    fields = {name: np.asarray(value) for name, value in mcmc.get_extra_fields(group_by_chain=True).items()}
    coordinates = target.centre + drawn[..., : len(target.names)] @ root.T
    scale = np.ones(drawn.shape[:2]) if target.known else target.scale * np.exp(drawn[..., -1] * _width(target))
    flat = target.values(coordinates.reshape(-1, len(target.names)))
    values = flat.reshape(coordinates.shape)
    marginals = {name: _marginal(values[..., i], coordinates[..., i], level) for i, name in enumerate(target.names)}
    divergences, steps = int(np.sum(fields["diverging"])), float(np.mean(fields["num_steps"]))
    return Posterior(marginals, coordinates, values, scale, divergences, steps, level, sampling)


def potential_of(target: Target, root: Float[Array, "parameter parameter"]) -> Callable[[Array], Array]:
    """Potential of the sampler, minus the logarithm of the density. Its argument holds the parameters in coordinates in
    which the least-squares covariance is the identity and, if the errors are not known, the scaled logarithm of their
    size. Its gradient comes from the forward-mode Jacobian of the residuals."""
    count, width = len(target.names), _width(target)
    mean, deviation = jnp.asarray(target.prior_mean), jnp.asarray(target.prior_deviation)
    low, high, centre = (jnp.asarray(part) for part in (target.low, target.high, target.centre))

    def both(place: Array) -> tuple[Array, Array]:
        coordinates = centre + root @ place[:count]
        log_scale = 0.0 if target.known else jnp.log(target.scale) + width * place[count]
        residual, jacobian = target.evaluate(coordinates)
        weight = jnp.exp(-2.0 * log_scale)
        square = jnp.sum(jnp.square(residual))
        distance = (coordinates - mean) / deviation
        value = 0.5 * weight * square + target.count * log_scale + 0.5 * jnp.sum(jnp.square(distance))
        slope = root.T @ (weight * (jacobian.T @ residual) + distance / deviation)
        if not target.known:
            slope = jnp.append(slope, width * (target.count - weight * square))
        inside = jnp.all((coordinates >= low) & (coordinates <= high)) & jnp.isfinite(value)
        return jnp.where(inside, value, jnp.inf), jnp.where(inside & jnp.isfinite(slope), slope, 0.0)

    @jax.custom_vjp
    def potential(place: Array) -> Array:
        return both(place)[0]

    potential.defvjp(both, lambda slope, cotangent: (cotangent * slope,))
    return potential


def _width(target: Target) -> float:
    """Standard deviation of the logarithm of the size of the errors."""
    return float(1.0 / np.sqrt(2.0 * max(target.count - len(target.names), 1)))


def _inside(target: Target, root: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Starting points, moved towards the centre until they are within the bounds."""
    for _ in range(30):
        coordinates = target.centre + starts @ root.T
        beyond = np.any((coordinates < target.low) | (coordinates > target.high), axis=1)
        if not np.any(beyond):
            break
        starts = np.where(beyond[:, None], 0.5 * starts, starts)
    return starts


def _marginal(values: np.ndarray, coordinates: np.ndarray, level: float) -> Marginal:
    from numpyro.diagnostics import effective_sample_size, split_gelman_rubin  # pyright: ignore[reportMissingImports]

    lower, median, upper = np.quantile(values, (0.5 - 0.5 * level, 0.5, 0.5 + 0.5 * level))
    return Marginal(
        float(np.mean(values)),
        float(median),
        float(np.std(values)),
        float(lower),
        float(upper),
        float(split_gelman_rubin(coordinates)),
        float(effective_sample_size(coordinates)),
    )
