r"""Estimates of the basic static load rating from Hertz's pressure, at the limits of ISO 76.

ISO 76 rates steel on steel. Rolling elements of another material on steel rings are rated here at the same pressure:
$C_0 \propto 1/E'^2$ of balls, $1/E'$ of rollers, so that a hybrid bearing with silicon nitride balls has 0.71 of the
rating of the steel one. (ISO 20056-2 rates hybrid bearings; it was not at hand.)
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import BALL_PRESSURE, ROLLER_PRESSURE, Material, reduced_modulus
from ..numerics.arguments import require_choice, require_count, require_numbers
from .capacity import CONFORMITIES, ball_size_ratio
from .modification import Family

MOST_LOADED = 5.0
"""Load of the most loaded element over the mean, 5 F/(Z cos(alpha)): Stribeck's number for a little clearance."""
STEEL_MODULUS = 2.2747252747252747e11
"""E' of the steel (207 GPa, 0.3) for which ratings are made, Pa."""


def rated_modulus(rings: Material, elements: Material, inner_ring: Material | None = None) -> Float[Array, ""]:
    """E' for the static rating, Pa: that of the standard's steel on itself, times E' of the rolling elements on the
    inner ring, whose contact is rated, over that of `rings` on themselves. The grade of steel does not count: ISO 76
    gives all one rating.

    **Validity:** `rings` of steel. **Arguments:** `inner_ring`: where it is of another material than `rings`.
    """
    inner = rings if inner_ring is None else inner_ring
    return STEEL_MODULUS * reduced_modulus(inner, elements) / reduced_modulus(rings, rings)


def ball_static_capacity(
    n_balls: int | Scalar,
    ball_diameter: Scalar,
    pitch_diameter: Scalar,
    contact_angle: Scalar,
    conformity_inner: Scalar = 0.52,
    modulus: Scalar = STEEL_MODULUS,
) -> Float[Array, ""]:
    r"""$C_0 = \frac15Z\cos\alpha\,Q(4.2\,GPa)$ of the inner contact, N.

    **Evidence:** [D] from Hertz and Stribeck's number; [C] a catalogue of hybrid spindle bearings prints 0.690 to 0.713
    of the rating of steel. **Arguments:** as `capacity.ball_capacity`; `modulus` E' (`rated_modulus`), Pa.
    """
    require_count("n_balls", n_balls)
    require_numbers("> 0", modulus=modulus)
    require_numbers(CONFORMITIES, conformity_inner=conformity_inner)
    gamma = ball_size_ratio(ball_diameter, pitch_diameter, contact_angle)
    # a rating that is computed by a program kept from before needs no contact: its import is not waited for
    from ..contacts import PointContact

    rolling = 0.5 * ball_diameter * (1.0 - gamma)
    transverse = conformity_inner * ball_diameter / (2.0 * conformity_inner - 1.0)
    load = PointContact(rolling, transverse, modulus).load_at_pressure(BALL_PRESSURE)
    return n_balls * jnp.cos(contact_angle) / MOST_LOADED * load


def roller_static_capacity(
    n_rollers: int | Scalar,
    roller_diameter: Scalar,
    pitch_diameter: Scalar,
    length: Scalar,
    contact_angle: Scalar = 0.0,
    modulus: Scalar = STEEL_MODULUS,
) -> Float[Array, ""]:
    r"""$C_0 = \frac15Z\cos\alpha\,Q(4.0\,GPa)$ of the inner contact, N: $44.2(1-\gamma)ZLD\cos\alpha$ in N and mm.

    **Evidence:** [D]; ISO 76 prints 44 ([M]). **Arguments:** as `capacity.roller_capacity`; `modulus` E'
    (`rated_modulus`), Pa.
    """
    require_count("n_rollers", n_rollers)
    require_numbers("> 0", roller_diameter=roller_diameter, length=length, modulus=modulus)
    gamma = ball_size_ratio(roller_diameter, pitch_diameter, contact_angle)
    from ..contacts import LineContact

    radius = 0.5 * jnp.asarray(roller_diameter) * (1.0 - gamma)
    load = LineContact(radius, length, modulus).load_at_pressure(ROLLER_PRESSURE)
    return n_rollers * jnp.cos(contact_angle) / MOST_LOADED * load


_LIMITS = {"ball": (BALL_PRESSURE, 3.0), "roller": (ROLLER_PRESSURE, 2.0)}
"""Pressure of the static rating, Pa, and the power of Hertz's pressure with which the load goes, by family."""


def contact_safety(
    inner: Float[Array, " element"], outer: Float[Array, " element"], family: Family
) -> Float[Array, ""]:
    r"""Static safety of the most loaded contact: $(p_{lim}/p)^3$ of balls, $(p_{lim}/p)^2$ of rollers, which is the
    load at the pressure of the static rating (4.2 and 4.0 GPa) over the load. It is infinite without load.

    **Evidence:** [D] Hertz. For rollers this is the effective static safety $q_0/q$ of ISO 17956:2025 by laminae, with
    $q_0 = 5C_0/(Zn_s\cos\alpha)$, as a public project reports it; the standard was not at hand.

    **Arguments:** largest Hertz pressure of each element on the inner and the outer raceway, of a roller in laminae
    that of its most loaded lamina, Pa.
    """
    require_choice("family", family, _LIMITS)
    require_numbers(">= 0", inner=inner, outer=outer)
    limit, power = _LIMITS[family]
    largest = jnp.maximum(jnp.max(inner), jnp.max(outer))
    loaded = largest > 0
    return jnp.where(loaded, (limit / jnp.where(loaded, largest, 1.0)) ** power, jnp.inf + 0.0 * largest)
