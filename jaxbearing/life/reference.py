r"""Reference life from the loads of all contacts (ISO/TS 16281, now ISO 16281), whose damages add up.

The functions return the damage rate $1/L_{10r}$ per million revolutions. It is smooth in all loads, and 0 without load.
For a ring that turns against the load it depends on the mean over the elements of $Q^3$ (balls) or $q^4$ (laminae of
rollers), for a ring at rest on the mean of $Q^{10/3}$ or $q^{9/2}$.
"""

import functools
import operator
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._types import Scalar
from ..numerics.arguments import require_count, require_numbers
from .capacity import ball_size_ratio, groove_ratio, roller_ratio

TINY = 1e-40
"""Added to the mean of $(Q/Q_c)^3$ or $(q/q_c)^4$, so that its power has finite derivatives without load."""
REDUCTION = 0.83
"""Factor lambda for line contacts, ISO 281. Contact capacities are divided by it; factors on the laminae replace it."""


class ContactCapacities(NamedTuple):
    """Q_ci and Q_ce: loads on a contact that give the inner and the outer ring a life of 10^6 revolutions, N."""

    inner: Float[Array, ""]
    outer: Float[Array, ""]


def ball_contact_capacities(
    capacity: Scalar,
    n_balls: int,
    ball_diameter: Scalar,
    pitch_diameter: Scalar,
    contact_angle: Scalar,
    conformity_inner: Scalar,
    conformity_outer: Scalar,
) -> ContactCapacities:
    r"""Contact capacities of a ball bearing, N, from its dynamic capacity C:
    $Q_{ci} = \frac{C}{0.407Z\cos\alpha}[1 + A^{10/3}]^{3/10}$, $Q_{ce} = \frac{C}{0.389Z\cos\alpha}
    [1 + A^{-10/3}]^{3/10}$, with A of `capacity.groove_ratio` for the constant 1.044.

    **Evidence:** [D] 0.407 and 0.389 are $J_r/J_1$, $J_r/J_2$ of the load distribution without clearance; [C] at F = C
    the life is 0.999; $Q_{ci}$ is Lundberg and Palmgren's contact capacity within 0.8 %.
    **Arguments:** as `capacity.ball_capacity`; `capacity` C, N.
    """
    require_count("n_balls", n_balls)
    require_numbers("> 0", capacity=capacity)
    gamma = ball_size_ratio(ball_diameter, pitch_diameter, contact_angle)
    ratio = groove_ratio(gamma, conformity_inner, conformity_outer, 1.044)
    share = capacity / (n_balls * jnp.cos(contact_angle))
    inner = share / 0.407 * (1.0 + ratio ** (10.0 / 3.0)) ** 0.3
    return ContactCapacities(inner, share / 0.389 * (1.0 + ratio ** (-10.0 / 3.0)) ** 0.3)


def roller_contact_capacities(
    capacity: Scalar, n_rollers: int, roller_diameter: Scalar, pitch_diameter: Scalar, contact_angle: Scalar = 0.0
) -> ContactCapacities:
    r"""Contact capacities of a roller bearing, N, from its dynamic capacity C:
    $Q_{ci} = \frac{1}{0.83}\frac{C}{0.378Z\cos\alpha}[1 + B^{9/2}]^{2/9}$, $Q_{ce} = \frac{1}{0.83}
    \frac{C}{0.364Z\cos\alpha}[1 + B^{-9/2}]^{2/9}$, with B of `capacity.roller_ratio` for the constant 1.038.

    **Evidence:** [D] line-contact integrals give 0.376 and 0.363; [C] within 0.4 % of Lundberg and Palmgren's form.
    **Arguments:** as `capacity.roller_capacity`; `capacity` C, N.
    """
    require_count("n_rollers", n_rollers)
    require_numbers("> 0", capacity=capacity, roller_diameter=roller_diameter)
    gamma = ball_size_ratio(roller_diameter, pitch_diameter, contact_angle)
    ratio = roller_ratio(gamma, 1.038)
    share = capacity / (REDUCTION * n_rollers * jnp.cos(contact_angle))
    inner = share / 0.378 * (1.0 + ratio**4.5) ** (2.0 / 9.0)
    return ContactCapacities(inner, share / 0.364 * (1.0 + ratio**-4.5) ** (2.0 / 9.0))


def _mean_power(relative: Array, turns: Bool[Array, ""], turning: float, resting: float) -> Array:
    """Mean of relative loads over the elements (axis 0) to the power `resting`: the plain mean for a ring at rest; if
    the ring `turns`, the mean of the power `turning`, raised to `resting / turning`."""
    mean = jnp.mean(relative**turning, axis=0)
    rolled = (mean + TINY) ** (resting / turning) - TINY ** (resting / turning)
    return jnp.where(turns, rolled, jnp.mean(relative**resting, axis=0))


def _require_loads(inner: Array, outer: Array, capacities: ContactCapacities) -> None:
    """**Raises:** `ValueError` for negative loads, and for capacities that are not positive."""
    require_numbers(">= 0", inner=inner, outer=outer)
    require_numbers("> 0", **{f"capacities.{name}": value for name, value in capacities._asdict().items()})


def ball_damage_rate(
    inner: Float[Array, " element"],
    outer: Float[Array, " element"],
    capacities: ContactCapacities,
    inner_turns: Bool[Array, ""],
    outer_turns: Bool[Array, ""],
    second: tuple[Array | None, Array | None] = (None, None),
) -> Float[Array, ""]:
    r"""Damage rate of a ball bearing, per 10^6 revolutions:
    $1/L_{10r} = [(Q_{ei}/Q_{ci})^{10/3} + (Q_{ee}/Q_{ce})^{10/3}]^{9/10}$.

    **Evidence:** [C], see `ball_contact_capacities`. **Arguments:** `inner`, `outer`: loads of all contacts, N,
    including 0 of unloaded ones; `inner_turns`, `outer_turns`: True if the ring turns against the load; `second`: loads
    on the second flank of the inner and of the outer raceway, N, for rings with two groove arcs. Each flank counts as
    a further raceway, whose term is added (product of survivals).
    """
    _require_loads(inner, outer, capacities)
    rings = [(inner, capacities.inner, inner_turns), (outer, capacities.outer, outer_turns)]
    rings += [(load, *ring[1:]) for load, ring in zip(second, rings, strict=True) if load is not None]
    each = [_mean_power(load / limit, turns, 3.0, 10.0 / 3.0) for load, limit, turns in rings]
    return _power(functools.reduce(operator.add, each), 0.9)


def edge_factors(n_laminae: int) -> np.ndarray:
    r"""Stress concentration near the ends of a roller whose profile is not modelled: a factor for each lamina,
    $f_k = 1 - 0.01/\ln(1.985|2k - n_s - 1|/(2n_s - 2))$, 1 in the exact middle; shape (n_laminae,).

    **Evidence:** from one public transcription of ISO 16281; [C] the end laminae have 2.3283 for every n_s. With 30
    laminae: 2.3283 at the end, 1.1266 beside it, 1.0030 in the middle.
    """
    require_count("n_laminae", n_laminae)
    k = np.arange(1, n_laminae + 1)
    distance = np.abs(2 * k - n_laminae - 1)
    inside = distance > 0
    argument = 1.985 * np.where(inside, distance, 1) / max(2 * n_laminae - 2, 1)
    return np.where(inside, 1.0 - 0.01 / np.log(argument), 1.0)


def roller_damage_rate(
    inner: Float[Array, "element lamina"],
    outer: Float[Array, "element lamina"],
    capacities: ContactCapacities,
    inner_turns: Bool[Array, ""],
    outer_turns: Bool[Array, ""],
    factors: Float[np.ndarray, " lamina"] | Float[Array, " lamina"],
) -> Float[Array, ""]:
    r"""Damage rate of a roller bearing, per 10^6 revolutions:
    $1/L_{10r} = (\sum_k[(q_{kei}/q_{ci})^{9/2} + (q_{kee}/q_{ce})^{9/2}])^{8/9}$, $q_c = Q_cn_s^{-7/9}$.

    **Evidence:** [C], see `roller_contact_capacities`. The load exponent is 4 here and 10/3 in ISO 281, and the
    standard has the factor $(1/0.83)^4$. Lives of evenly loaded rollers are therefore 1.5 times the catalogue life at
    C/P = 4 and 2.4 times at C/P = 8 with the edge factors, 5.2 and 8.3 times without them.

    **Arguments:** `inner`, `outer`: loads of all laminae, N; `inner_turns`, `outer_turns`: True if the ring turns
    against the load; `factors`: factors f_k on the loads, such as `edge_factors`.
    """
    _require_loads(inner, outer, capacities)
    require_numbers(">= 0", factors=factors)
    count = inner.shape[1]
    factor = jnp.asarray(factors)[None, :]
    rings = ((inner, capacities.inner, inner_turns), (outer, capacities.outer, outer_turns))
    each = [
        jnp.sum(_mean_power(factor * load * count ** (7.0 / 9.0) / limit, turns, 4.0, 4.5))
        for load, limit, turns in rings
    ]
    return _power(each[0] + each[1], 8.0 / 9.0)


def _power(damage: Array, exponent: float) -> Array:
    """Damage to a power, damage^exponent, with value and slope 0 where the damage is 0. NaN stays NaN."""
    positive = damage > 0
    return jnp.where(positive, jnp.where(positive, damage, 1.0) ** exponent, 0.0 * damage)
