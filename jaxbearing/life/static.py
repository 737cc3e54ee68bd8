"""Estimates of the basic static load rating from Hertz's pressure (ISO 76)."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..contacts import LineContact, PointContact
from ..numerics.arguments import require_angle, require_count

BALL_PRESSURE, ROLLER_PRESSURE = 4.2e9, 4.0e9
"""Hertz pressure of the most loaded contact at the static rating, Pa (ISO 76, [M])."""
MOST_LOADED = 5.0
"""Load of the most loaded element over the mean, 5 F/(Z cos(alpha)): Stribeck's number for a little clearance."""
STEEL_MODULUS = 2.2747252747252747e11
"""E' of the steel (207 GPa, 0.3) for which ratings are made, Pa."""


def ball_static_capacity(
    n_balls: int,
    ball_diameter: Scalar,
    pitch_diameter: Scalar,
    contact_angle: Scalar,
    conformity_inner: Scalar = 0.52,
) -> Float[Array, ""]:
    r"""$C_0 = \frac15Z\cos\alpha\,Q(4.2\,GPa)$ of the inner contact, N.

    **Evidence:** [D] from Hertz and Stribeck's number. **Arguments:** as `capacity.ball_capacity`.
    """
    require_count("n_balls", n_balls)
    require_angle("contact_angle", contact_angle)
    gamma = ball_diameter * jnp.cos(contact_angle) / pitch_diameter
    rolling = 0.5 * ball_diameter * (1.0 - gamma)
    transverse = conformity_inner * ball_diameter / (2.0 * conformity_inner - 1.0)
    load = PointContact(rolling, transverse, STEEL_MODULUS).load_at_pressure(BALL_PRESSURE)
    return n_balls * jnp.cos(contact_angle) / MOST_LOADED * load


def roller_static_capacity(
    n_rollers: int, roller_diameter: Scalar, pitch_diameter: Scalar, length: Scalar, contact_angle: Scalar = 0.0
) -> Float[Array, ""]:
    r"""$C_0 = \frac15Z\cos\alpha\,Q(4.0\,GPa)$ of the inner contact, N: $44.2(1-\gamma)ZLD\cos\alpha$ in N and mm.

    **Evidence:** [D]; ISO 76 prints 44 ([M]). **Arguments:** as `capacity.roller_capacity`.
    """
    require_count("n_rollers", n_rollers)
    require_angle("contact_angle", contact_angle)
    gamma = roller_diameter * jnp.cos(contact_angle) / pitch_diameter
    radius = 0.5 * jnp.asarray(roller_diameter) * (1.0 - gamma)
    load = LineContact(radius, length, STEEL_MODULUS).load_at_pressure(ROLLER_PRESSURE)
    return n_rollers * jnp.cos(contact_angle) / MOST_LOADED * load
