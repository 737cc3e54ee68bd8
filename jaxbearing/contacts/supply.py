r"""Starved contacts: how much thinner the film is, and how much less it resists rolling, where little oil arrives.

Notation: $h_c$ flooded central film (thermal factor included), $h_m$ gap at the inlet meniscus, $S_c = h_m/h_c$,
$S = S_c/0.75$ the same over the flooded minimum film, $h_l$ sum of the oil layers that both surfaces bring,
$\varphi_f$ film factor, $\varphi_r$ factor of the rolling resistance, a half-width along rolling, R reduced radius.
Every function is elementwise and takes logarithms where a ratio spans many decades.

The resistance feels the supply long before the film does: at $S_c = 10$ the film has lost 5 % and the resistance 35 %.
So measured torques say little about films, and the reverse.

**Left out:** replenishment beyond the number that a scene gives as layer (`levelling_time` tells why surface tension
does not refill a track), the smaller inlet heating of a starved contact, side loss of a layer.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.checks import known
from ..numerics.roots import Root, monotone_root
from ..numerics.safe import log_add, softplus, softplus_floor

GAP_EXPONENT = 1.19
"""g of the film factor of a gap, fitted to full solutions."""
LINE_LAYER_EXPONENT = 8.0
"""gamma of a line contact: its flow has no way out, the exact limit is the smaller of layer and flooded film."""
POINT_LAYER_EXPONENT = 3.0
"""gamma of an ellipse, from which oil also leaves sideways; 2 to 5 in the literature (from memory)."""
MINIMUM_OVER_CENTRAL = 0.75
"""Minimum over central film of the incompressible solutions to which the rolling factor was fitted."""
LAYER_FLOOR = 1e-15
"""Added to a layer or a gap, m: no oil at all gives a film of this size; a film of 1 um changes by 1e-9 of itself."""
LEAST_GAP = -27.631021115928547
"""ln(1e-12): smallest ln S of the rolling factor, whose slope there is finite."""
GAP_WIDTH = 1.0
"""Smoothing of that limit: ln S above -2 changes by less than 1e-11."""
MENISCUS_FLOOR = 1e-9
"""Smallest (x_m - a)/a."""
MENISCUS_WIDTH = 1e-3
"""Smoothing of that limit: (x_m - a)/a above 0.03 changes by less than 1e-15."""
CORNER = 80.0
"""Exponent that rounds the corner of Hamrock and Dowson's factor: it is 0.9 % lower at the corner."""
FAR = -30.0
"""x below which 1 - (1 + e^x)^(-k) is k e^x to 1e-13."""


def log_film_factor_of_gap(log_gap: Values, exponent: Values = GAP_EXPONENT) -> Float[Array, "..."]:
    r"""ln of $\varphi_f = S_c/(1 + S_c^g)^{1/g}$.

    **Limits:** $1 - S_c^{-g}/g$ at a wide gap, $S_c$ at a narrow one.
    **Validity:** within -0.10 (M = 1) and +0.04 of full solutions of line contacts, M 1 to 100, L 5 to 14; the minimum
    film has the same factor to +0.06 and -0.10.
    **Reference:** own fit.

    **Arguments:** `log_gap`, ln S_c; `exponent` g, > 0.
    """
    return -softplus(-exponent * log_gap) / exponent


def log_film_factor_of_layer(log_layer: Values, exponent: Values) -> Float[Array, "..."]:
    r"""ln of $\varphi_f = r/(1 + r^\gamma)^{1/\gamma}$, $r = h_l/h_c$.

    **Limits:** 1 at a thick layer; r at a thin one: the film is then the layer, and it never is thicker.
    **Validity:** oil of the same density in the film as outside.
    **Reference:** Chevalier et al. (1998); Damiens et al. (2004), who find that one parameter governs.

    **Arguments:** `log_layer`, ln r; `exponent` gamma, > 0: `LINE_LAYER_EXPONENT` or `POINT_LAYER_EXPONENT`.
    """
    return -softplus(-exponent * log_layer) / exponent


def log_gap_of_layer(log_layer: Values, exponent: Values, gap_exponent: Values = GAP_EXPONENT) -> Float[Array, "..."]:
    r"""ln of the gap $S_c = \varphi_f/(1 - \varphi_f^g)^{1/g}$ that thins the film as much as a layer does.

    Nothing cancels where the layer is thick: $1 - \varphi_f^g = 1 - (1 + r^{-\gamma})^{-g/\gamma}$.

    **Arguments:** `log_layer`, ln r; `exponent` gamma and `gap_exponent` g, > 0.
    """
    missing = log_deficit(-exponent * log_layer, gap_exponent / exponent)
    return log_film_factor_of_layer(log_layer, exponent) - missing / gap_exponent


def log_deficit(x: Values, exponent: Values) -> Float[Array, "..."]:
    """ln of 1 - (1 + e^x)^(-k), without cancellation. **Arguments:** `x`; `exponent` k, > 0."""
    x = jnp.asarray(x, dtype=float)
    far = x < FAR
    near = jnp.where(far, FAR, x)
    return jnp.where(far, x + jnp.log(exponent), jnp.log(-jnp.expm1(-exponent * softplus(near))))


def layer_of_flow(capture: Values, oil_flow: Values, width: Values, speed: Values) -> Float[Array, "..."]:
    r"""Layer that a flow of oil leaves on the track, m: $h_l = \eta_cQ/(\ell u)$.

    The flow through the bearing, less what misses the track, is spread once over it between two passages; the number of
    rolling elements drops out.

    **Validity:** the captured part is known to a factor of 10.

    **Arguments:** `capture` eta_c; `oil_flow` Q, m^3/s; `width` of the track l, m, > 0; `speed` u, mean of both
    surfaces, m/s, > 0.
    """
    return jnp.asarray(capture * oil_flow / (width * speed))


def hertz_gap(half_width: Values, radius: Values, distance: Values) -> Float[Array, "..."]:
    r"""Gap of dry elastic bodies beside a line, m: $\frac{a^2}{2R}[X\sqrt{X^2-1} - \text{arccosh}X]$, $X = x/a$.

    **Validity:** lines, and the plane of rolling of wide ellipses; beside a circle the gap is 18 % wider at X = 1.5.
    At X <= 1, where bodies touch, it goes on as $10^{-3}e^{1000(X-1)}$ for X - 1.

    **Arguments:** `half_width` a, m; `radius` R, m; `distance` x from the centre, m, > a.

    **Raises:** `ValueError` for a known distance that lies inside the contact.
    """
    numbers = known(half_width, distance) if jnp.ndim(half_width) == jnp.ndim(distance) == 0 else None
    if numbers is not None and not numbers[1] > numbers[0]:
        raise ValueError(
            f"distance: the meniscus must lie outside the contact, whose half-width is {numbers[0]:g} m, "
            f"got {numbers[1]:g} m"
        )
    outside = _outside(jnp.asarray(distance) / half_width)
    reach = jnp.sqrt(outside * (outside + 2.0))
    return jnp.square(half_width) / (2.0 * radius) * ((1.0 + outside) * reach - jnp.log1p(outside + reach))


def log_gap_at_meniscus(log_hertz_gap: Values, exponent: Values = GAP_EXPONENT) -> Root:
    r"""ln of the gap $S_c$ at a meniscus, which widens with the film: $S_c = \varphi_f(S_c) + G$.

    One scalar root, nearly linear in logarithms, with the derivative of the implicit function.

    **Limits:** $S_c = G + 1$ at a far meniscus; $(gG)^{1/(1+g)}$ next to the Hertz zone, where the film vanishes.

    **Arguments:** `log_hertz_gap`, ln G, G the dry gap at the meniscus over h_c; `exponent` g, > 0.
    """

    def excess(log_gap: Array, args: tuple[Array, Array]) -> Array:
        target, power = args
        return log_gap + log_deficit(power * log_gap, 1.0 / power) - target

    target, power = jnp.asarray(log_hertz_gap, dtype=float), jnp.asarray(exponent, dtype=float)
    near = (target + jnp.log(power)) / (1.0 + power)
    low, high = jnp.minimum(near, target) - 2.0, jnp.maximum(near, target) + 3.0
    return monotone_root(excess, (target, power), low, high, log_add(near, target))


def starved_rolling_factor(log_gap_over_minimum: Values) -> Float[Array, "..."]:
    r"""$\varphi_r = 1/(1 + 1.4317\,S^{-1/2} + 1.0161\,S^{-1} + 6.559\,S^{-1.75})$.

    **Limits:** 1 as $1 - 1.43/\sqrt S$: the far inlet counts; 0 with $S^{1.75}$, where S is floored at 1e-12.
    **Validity:** within -0.03 and +0.05 of full solutions of line contacts, M 1 to 100, L 5 to 14, S 0.3 to 540. Taken
    for points too, for which it is not verified.
    **Reference:** own fit.

    **Arguments:** `log_gap_over_minimum`, ln S.
    """
    log_gap = _floored(log_gap_over_minimum)
    root = jnp.exp(-0.5 * log_gap)
    return 1.0 / (1.0 + root * (1.4317 + 1.0161 * root) + 6.559 * jnp.exp(-1.75 * log_gap))


def biboulet_houpert_rolling_factor(log_gap_over_minimum: Values) -> Float[Array, "..."]:
    r"""$\varphi_r = (S^2 + 162.8\,S)/(S^2 + 193.1\,S + 1257)$.

    **Limits:** 1 as $1 - 30.3/S$; 0 with S, which is floored at 1e-12.
    **Validity:** within -0.10 and +0.04 of the solutions of `starved_rolling_factor`.
    **Reference:** Biboulet and Houpert (2010), Proc. IMechE J 224, 777, eq. (44).

    **Arguments:** `log_gap_over_minimum`, ln S.
    """
    near = jnp.exp(-_floored(log_gap_over_minimum))
    return (1.0 + 162.8 * near) / (1.0 + near * (193.1 + 1257.0 * near))


def hamrock_dowson_log_film_factor(distance_ratio: Values, film_ratio: Values) -> Float[Array, "..."]:
    r"""ln of $\varphi_f = [(m-1)/(m^*-1)]^{0.29}$, at most 1, with $m^* = 1 + 3.06\,H^{0.58}$, $H = (R_x/a)^2h_c/R_x$.

    **Limits:** 1 for m well above m*; the corner there is rounded (0.9 % lower). m <= 1 as in `hertz_gap`.
    **Validity:** m >= 1.2: own solutions agree to 0.02 there, and lie up to 0.12 below at m = 1.05.
    **Reference:** Hamrock and Dowson (1977), ASME J. Lubr. Technol. 99, 15; the constants from memory.

    **Arguments:** `distance_ratio` m = x_m/a; `film_ratio` H.
    """
    log_share = jnp.log(_outside(distance_ratio)) - jnp.log(3.06) - 0.58 * jnp.log(film_ratio)
    return -softplus(-CORNER * 0.29 * log_share) / CORNER


def levelling_time(
    viscosity: Values, half_width: Values, surface_tension: Values, layer: Values
) -> Float[Array, "..."]:
    r"""Time in which surface tension refills a track, s: $t = 3\mu b^4/(\sigma h^3)$, a scale.

    A minute for b = 0.5 mm and a layer of 10 um, where two rollers follow each other within a millisecond: side ridges,
    cage and spin refill a track in a bearing, surface tension does not.

    **Arguments:** `viscosity`, Pa s; `half_width` b of the track, m; `surface_tension`, N/m; `layer` h, m.
    """
    return jnp.asarray(3.0 * viscosity * jnp.asarray(half_width) ** 4 / (surface_tension * jnp.asarray(layer) ** 3))


def _floored(log_gap: Values) -> Float[Array, "..."]:
    return softplus_floor(log_gap, LEAST_GAP, GAP_WIDTH)


def _outside(ratio: Values) -> Float[Array, "..."]:
    """x/a - 1, > 0."""
    return softplus_floor(ratio - 1.0, MENISCUS_FLOOR, MENISCUS_WIDTH)
