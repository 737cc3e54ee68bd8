r"""Estimates of the basic static load rating from the Hertz pressure, at the limits of ISO 76.

ISO 76 rates steel on steel. Rolling elements of another material on steel rings are rated here at the same pressure:
$C_0 \propto 1/E'^2$ for balls, $1/E'$ for rollers. A hybrid bearing with silicon nitride balls therefore has 0.71 of
the rating of the steel bearing. ISO 20056-2 rates hybrid bearings; it was not at hand.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar
from ..materials import BALL_PRESSURE, ROLLER_PRESSURE, Material, reduced_modulus
from ..numerics.arguments import require_choice, require_count, require_numbers
from ..numerics.safe import largest
from .capacity import CONFORMITIES, ball_size_ratio
from .modification import Family

MOST_LOADED = 5.0
"""Stribeck's number for a small clearance: the load of the most loaded element is 5 F/(Z cos(alpha))."""
STEEL_MODULUS = 2.2747252747252747e11
"""Reduced modulus E' of the steel (207 GPa, Poisson's ratio 0.3) to which ratings apply, Pa."""


def rated_modulus(rings: Material, elements: Material, inner_ring: Material | None = None) -> Float[Array, ""]:
    """Reduced modulus E' for the static rating, Pa: `STEEL_MODULUS` times the ratio of E' of the elements on the inner
    ring to E' of `rings` on themselves.

    The ratio removes the grade of steel: ISO 76 gives all steels one rating. The inner contact is the rated one.

    **Validity:** `rings` of steel. **Arguments:** `inner_ring`: its material if it differs from `rings`.
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
    r"""Basic static load rating of balls, N, with the load Q of the inner contact at 4.2 GPa:
    $C_0 = \frac15Z\cos\alpha\,Q$.

    **Evidence:** [D] from Hertz and Stribeck's number; [C] a catalogue of hybrid spindle bearings prints 0.690 to 0.713
    of the rating of steel bearings. **Arguments:** as `capacity.ball_capacity`; `modulus` E' (`rated_modulus`), Pa.
    """
    require_count("n_balls", n_balls)
    require_numbers("> 0", modulus=modulus)
    require_numbers(CONFORMITIES, conformity_inner=conformity_inner)
    gamma = ball_size_ratio(ball_diameter, pitch_diameter, contact_angle)
    # imported here: a rating that a stored program computes does not need this module
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
    r"""Basic static load rating of rollers, N, with the load Q of the inner contact at 4.0 GPa:
    $C_0 = \frac15Z\cos\alpha\,Q = 44.2(1-\gamma)ZLD\cos\alpha$ (N and mm).

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
"""Pressure of the static rating, Pa, and exponent n of the Hertz relation load ~ pressure^n, by family."""


def contact_safety(
    inner: Float[Array, " element"], outer: Float[Array, " element"], family: Family
) -> Float[Array, ""]:
    r"""Static safety of the most loaded contact: $(p_{lim}/p)^3$ for balls, $(p_{lim}/p)^2$ for rollers.

    This is the load at the pressure of the static rating (4.2 GPa for balls, 4.0 GPa for rollers) over the load. It is
    infinite without load.

    **Evidence:** [D] Hertz. For rollers this is the effective static safety $q_0/q$ of ISO 17956:2025 by laminae, with
    $q_0 = 5C_0/(Zn_s\cos\alpha)$, as a public project reports it; the standard was not at hand.

    **Arguments:** `inner`, `outer`: largest Hertz pressure of each element on the raceway, Pa; of a roller in laminae:
    the pressure of its most loaded lamina.
    """
    require_choice("family", family, _LIMITS)
    require_numbers(">= 0", inner=inner, outer=outer)
    limit, power = _LIMITS[family]
    most = jnp.maximum(largest(inner), largest(outer))
    loaded = most > 0
    return jnp.where(loaded, (limit / jnp.where(loaded, most, 1.0)) ** power, jnp.inf + 0.0 * most)
