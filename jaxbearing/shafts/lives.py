r"""Life of all bearings of a shaft together, and under a duty cycle.

A shaft survives as long as all its bearings: $\ln S = \ln0.9\sum_b(t/L_b)^{e_b}$, so that its life solves
$\sum_b(L/L_b)^{e_b} = 1$ with the Weibull slopes e, 10/9 of ball and 9/8 of roller bearings. Under a duty cycle the
damage of all states adds up along each bearing first (Palmgren and Miner), then the bearings make the system: damage
adds up along one bearing's history, survival multiplies over bearings.

**Evidence:** [D] from the distribution of Weibull; the slopes are those of ISO 281's reference life.
"""

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arguments import require_numbers

SLOPES = {"ball": 10.0 / 9.0, "roller": 9.0 / 8.0}
"""Weibull slopes of the standards, by family."""
STEPS = 40
"""Newton steps for the life of a system; a few are enough."""


def system_rate(
    rates: Float[Array, " bearing"], slopes: Float[Array, " bearing"] | Float[np.ndarray, " bearing"]
) -> Float[Array, ""]:
    r"""1/L of the system, from 1/L_b of its bearings: the root of $\sum_b(r_b/r)^{e_b} = 1$; 0 where nothing is loaded.

    **Arguments:** `rates`: 1/L_b, in one unit, 0 of a bearing without load; `slopes`: e_b.
    """
    require_numbers(">= 0", rates=rates)
    require_numbers("> 0", slopes=slopes)
    rates, slopes = jnp.asarray(rates), jnp.asarray(slopes)
    largest = jnp.max(rates)
    loaded = rates > 0
    logs = jnp.log(jnp.where(loaded, rates, 1.0)) - jnp.log(jnp.where(largest > 0, largest, 1.0))

    def residual(log_rate: Array, logs: Array, slopes: Array) -> Array:
        """Logarithm of the sum, which falls and is convex."""
        return jnp.log(jnp.sum(jnp.where(loaded, jnp.exp(slopes * (logs - log_rate)), 0.0)))

    def better(_, log_rate: Array) -> Array:
        value, slope = jax.value_and_grad(residual)(log_rate, *jax.lax.stop_gradient((logs, slopes)))
        return log_rate - value / jnp.where(slope < 0, slope, -1.0)

    root = jax.lax.fori_loop(0, STEPS, better, jnp.zeros(()))
    root = jax.lax.stop_gradient(jnp.where(largest > 0, root, 0.0))
    slope = jax.lax.stop_gradient(jax.grad(residual)(root, logs, slopes))
    root = root - residual(root, logs, slopes) / jnp.where(slope < 0, slope, -1.0)
    # a rate that is NaN has no life, not an endless one
    return jnp.where(largest > 0, largest * jnp.exp(root), 0.0 * jnp.sum(rates))


def system_life(lives: Float[Array, " bearing"], slopes: Float[Array, " bearing"]) -> Float[Array, ""]:
    """Life of the system from those of its bearings, in their unit. **Arguments:** see `system_rate`."""
    return life_of(system_rate(1.0 / jnp.asarray(lives), slopes))


def life_of(rate: Float[Array, ""]) -> Float[Array, ""]:
    """1/rate; infinite without damage."""
    damaged = rate > 0
    return jnp.where(damaged, 1.0 / jnp.where(damaged, rate, 1.0), jnp.where(rate == 0, jnp.inf, jnp.nan))


def slopes_of(families: list[str], weibull: Scalar | None) -> Float[Array, " bearing"]:
    """Weibull slope of each bearing. **Arguments:** "ball" or "roller"; one slope for all, or `None`."""
    if weibull is not None:
        return jnp.broadcast_to(jnp.asarray(weibull, dtype=float), (len(families),))
    return jnp.asarray([SLOPES[family] for family in families])


def hourly_rates(rates: Float[Array, "..."], speed: Scalar) -> Float[Array, "..."]:
    """1/h from 1/10^6 revolutions. **Arguments:** `speed`: rad/s."""
    return rates * jnp.abs(speed) * 3600.0 / (2.0 * jnp.pi * 1e6)
