r"""Life of all bearings of a shaft together, and under a duty cycle.

A shaft survives as long as all its bearings: $\ln S = \ln0.9\sum_b(t/L_b)^{e_b}$, so that its life solves
$\sum_b(L/L_b)^{e_b} = 1$ with the Weibull slopes e, 10/9 of ball and 9/8 of roller bearings. Under a duty cycle the
damage of all states adds up along each bearing first (Palmgren and Miner), then the bearings make the system: damage
adds up along one bearing's history, survival multiplies over bearings.

With one slope for all this is the $L = (\sum_bL_b^{-e})^{-1/e}$ of catalogues. Ball and roller bearings on one shaft
keep their own slopes, and the sum has no closed solution then. The law is the same for each kind of life. Lives at
another reliability n than 90 % have $\ln n$ in the place of $\ln0.9$ and make a life of the system at n, so that all
bearings must be rated for the same one.

**Evidence:** [D] from the distribution of Weibull; the slopes are those of ISO 281's reference life.
"""

from collections.abc import Mapping, Sequence

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..life.duty import common_rates, life_of, lives_of
from ..life.result import Life
from ..numerics.arguments import require_numbers
from .solution import SystemLifeResult

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


def slopes_of(families: list[str], weibull: Scalar | None) -> Float[Array, " bearing"]:
    """Weibull slope of each bearing. **Arguments:** "ball" or "roller"; one slope for all, or `None`."""
    if weibull is not None:
        return jnp.broadcast_to(jnp.asarray(weibull, dtype=float), (len(families),))
    return jnp.asarray([SLOPES[family] for family in families])


def system_of(
    lives: Sequence[Life], rates: Sequence[Mapping[str, Array]], weibull: Scalar | None, speed: Scalar
) -> SystemLifeResult:
    """Life of all bearings together, of each kind that all of them have; no Lnmr of bearings that are rated for
    different reliabilities.

    **Arguments:** `lives` of the bearings; `rates`: 1/L of each by kind (`life.duty.damage_rates`); `weibull`: see
    `slopes_of`; `speed` of the shaft, rad/s.
    """
    slopes = slopes_of([life.family for life in lives], weibull)
    reliabilities = {life.reliability for life in lives}
    kinds = common_rates(rates)
    if len(reliabilities) > 1:
        kinds.pop("Lnmr", None)
        reliabilities = {0.90}
    together = jax.vmap(system_rate, in_axes=(0, None))(jnp.stack([jnp.stack(each) for each in kinds.values()]), slopes)
    return SystemLifeResult(**lives_of(dict(zip(kinds, together, strict=True)), speed), reliability=reliabilities.pop())
