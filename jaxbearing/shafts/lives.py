r"""Life of all bearings of a shaft together, and under a duty cycle.

A shaft survives as long as all its bearings: $\ln S = \ln0.9\sum_b(t/L_b)^{e_b}$, so that its life solves
$\sum_b(L/L_b)^{e_b} = 1$ with the Weibull slopes e, 10/9 of ball and 9/8 of roller bearings. Under a duty cycle the
damage of all states adds up along each bearing first (Palmgren and Miner), then the bearings make the system: damage
adds up along one bearing's history, survival multiplies over bearings.

If all slopes are equal, this is the $L = (\sum_bL_b^{-e})^{-1/e}$ of catalogues. Ball and roller bearings on one shaft
keep their own slopes; the sum then has no closed solution. The law is the same for each kind of life. Lives at a
reliability n other than 90 % have $\ln n$ in place of $\ln0.9$ and give the life of the system at n, so all bearings
must be rated for the same reliability.

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
from ..numerics.safe import largest
from .solution import SystemLifeResult

SLOPES = {"ball": 10.0 / 9.0, "roller": 9.0 / 8.0}
"""Weibull slopes of the standards, by family."""
STEPS = 40
"""Number of Newton steps for the life of a system; a few would be enough."""


def system_rate(
    rates: Float[Array, " bearing"], slopes: Float[Array, " bearing"] | Float[np.ndarray, " bearing"]
) -> Float[Array, ""]:
    r"""Rate r = 1/L of the system, the root of $\sum_b(r_b/r)^{e_b} = 1$; 0 if no bearing is loaded.

    **Arguments:** `rates`: r_b = 1/L_b of the bearings, all in the same unit, 0 for a bearing without load; `slopes`:
    e_b.
    """
    require_numbers(">= 0", rates=rates)
    require_numbers("> 0", slopes=slopes)
    rates, slopes = jnp.asarray(rates), jnp.asarray(slopes)
    most = largest(rates)
    loaded = rates > 0
    logs = jnp.log(jnp.where(loaded, rates, 1.0)) - jnp.log(jnp.where(most > 0, most, 1.0))

    def residual(log_rate: Array, logs: Array, slopes: Array) -> Array:
        """Logarithm of the sum; it decreases with `log_rate` and is convex."""
        return jnp.log(jnp.sum(jnp.where(loaded, jnp.exp(slopes * (logs - log_rate)), 0.0)))

    def better(_, log_rate: Array) -> Array:
        value, slope = jax.value_and_grad(residual)(log_rate, *jax.lax.stop_gradient((logs, slopes)))
        return log_rate - value / jnp.where(slope < 0, slope, -1.0)

    root = jax.lax.fori_loop(0, STEPS, better, jnp.zeros(()))
    root = jax.lax.stop_gradient(jnp.where(most > 0, root, 0.0))
    slope = jax.lax.stop_gradient(jax.grad(residual)(root, logs, slopes))
    root = root - residual(root, logs, slopes) / jnp.where(slope < 0, slope, -1.0)
    # a rate that is NaN gives NaN, not an infinite life
    return jnp.where(most > 0, most * jnp.exp(root), 0.0 * jnp.sum(rates))


def system_life(lives: Float[Array, " bearing"], slopes: Float[Array, " bearing"]) -> Float[Array, ""]:
    """Life of the system from those of its bearings, in the same unit. **Arguments:** `slopes`: see `system_rate`."""
    return life_of(system_rate(1.0 / jnp.asarray(lives), slopes))


def slopes_of(families: list[str], weibull: Scalar | None) -> Float[Array, " bearing"]:
    """Weibull slope of each bearing.

    **Arguments:** `families`: "ball" or "roller" for each bearing; `weibull`: slope of all bearings, `None`: `SLOPES`.
    """
    if weibull is not None:
        return jnp.broadcast_to(jnp.asarray(weibull, dtype=float), (len(families),))
    return jnp.asarray([SLOPES[family] for family in families])


def system_of(
    lives: Sequence[Life], rates: Sequence[Mapping[str, Array]], weibull: Scalar | None, speed: Scalar
) -> SystemLifeResult:
    """Life of all bearings together, for each kind of life that all of them have. There is no Lnmr if the bearings are
    rated for different reliabilities.

    **Arguments:** `lives`: of the bearings; `rates`: 1/L of each bearing by kind of life (`life.duty.damage_rates`);
    `weibull`: see `slopes_of`; `speed`: of the shaft, rad/s.
    """
    slopes = slopes_of([life.family for life in lives], weibull)
    reliabilities = {life.reliability for life in lives}
    kinds = common_rates(rates)
    if len(reliabilities) > 1:
        kinds.pop("Lnmr", None)
        reliabilities = {0.90}
    together = jax.vmap(system_rate, in_axes=(0, None))(jnp.stack([jnp.stack(each) for each in kinds.values()]), slopes)
    return SystemLifeResult(**lives_of(dict(zip(kinds, together, strict=True)), speed), reliability=reliabilities.pop())
