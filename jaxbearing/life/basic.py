"""Basic rating life of ISO 281 and the equivalent loads of catalogues."""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.arguments import require_angle, require_numbers

RELIABILITY_FACTORS = {0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25}
"""Reliability factor a_1 of ISO 281:2007, by reliability [M]. The previous edition had 0.62, 0.53, 0.44, 0.33 and
0.21 from 0.95 on."""
BALL_EXPONENT, ROLLER_EXPONENT = 3.0, 10.0 / 3.0
EXPONENTS = {"ball": BALL_EXPONENT, "roller": ROLLER_EXPONENT}
"""Exponent p of the load in ISO 281, by family."""
HOURS = 1e6 * 2.0 * np.pi / 3600.0
"""Time of a million revolutions at 1 rad/s, h."""
MINIMUM_LOADS = {"ball": 0.01, "roller": 0.02}
"""Minimum load over C, by family: elements skid below it, by a maker's general rule (SKF, bearing selection process,
requisite minimum load, as read on its pages). The rule ignores speed, oil and cage."""

_GROOVE = np.array(
    [
        # f0 Fa/C0, e, Y
        (0.172, 0.19, 2.30),
        (0.345, 0.22, 1.99),
        (0.689, 0.26, 1.71),
        (1.03, 0.28, 1.55),
        (1.38, 0.30, 1.45),
        (2.07, 0.34, 1.31),
        (3.45, 0.38, 1.15),
        (5.17, 0.42, 1.04),
        (6.89, 0.44, 1.00),
    ]
)


def basic_life(capacity: Values, equivalent_load: Values, exponent: float) -> Float[Array, "..."]:
    """Basic rating life L10 = (C/P)^p, 10^6 revolutions; infinite without load.

    **Arguments:** `capacity` C and `equivalent_load` P, N; `exponent` p: 3 for balls, 10/3 for rollers.
    """
    require_numbers("> 0", capacity=capacity, exponent=exponent)
    require_numbers(">= 0", equivalent_load=equivalent_load)
    return jnp.asarray(capacity / jnp.asarray(equivalent_load)) ** exponent


def tapered_equivalent_load(radial: Values, axial: Values, contact_angle: Values) -> Float[Array, "..."]:
    """Equivalent load P of tapered roller bearings, N: Fr if Fa/Fr <= e = 1.5 tan(alpha), else
    0.4 Fr + 0.4 cot(alpha) Fa [M].

    **Arguments:** `radial` Fr, `axial` Fa, N; `contact_angle` alpha, rad.
    """
    require_angle("contact_angle", contact_angle)
    require_numbers("above 0 and below 90 degrees", contact_angle=contact_angle)
    require_numbers(">= 0", radial=radial, axial=axial)
    tangent = jnp.tan(contact_angle)
    combined = 0.4 * radial + 0.4 / tangent * axial
    return jnp.where(axial <= 1.5 * tangent * radial, radial * jnp.ones_like(combined), combined)


def deep_groove_equivalent_load(
    radial: Values, axial: Values, static_capacity: Scalar, load_factor: Scalar
) -> Float[Array, "..."]:
    """Equivalent load P of deep-groove ball bearings, N: Fr if Fa/Fr <= e, else 0.56 Fr + Y Fa [M].

    The limit e and the factor Y are interpolated over f0 Fa/C0.

    **Arguments:** `radial` Fr, `axial` Fa, `static_capacity` C0, N; `load_factor`: f0 of the bearing, about 14.
    """
    require_numbers(">= 0", radial=radial, axial=axial)
    require_numbers("> 0", static_capacity=static_capacity, load_factor=load_factor)
    relative = load_factor * axial / static_capacity
    e, y = (jnp.interp(relative, jnp.asarray(_GROOVE[:, 0]), jnp.asarray(_GROOVE[:, i])) for i in (1, 2))
    return jnp.where(axial <= e * radial, radial, 0.56 * radial + y * axial)
