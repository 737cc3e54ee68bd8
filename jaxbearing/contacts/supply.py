r"""Starvation: factors by which film thickness and rolling resistance fall where little oil reaches a contact.

Notation: $h_c$ flooded central film (thermal factor included), $h_m$ gap at the inlet meniscus, $S_c = h_m/h_c$,
$S = S_c/0.75$ the gap over the flooded minimum film, $h_l$ sum of the oil layers on both surfaces,
$\varphi_f$ film factor, $\varphi_r$ factor of the rolling resistance, a half-width along rolling, R reduced radius.
Every function is elementwise and takes logarithms where a ratio spans many decades.

Starvation lowers the rolling resistance long before the film: at $S_c = 10$ the film is 5 % and the resistance 35 %
below the flooded value. So measured torques say little about films, and films little about torques.

**Left out:** replenishment of the track, except for the layer that a scene gives (`levelling_time` shows why surface
tension does not refill a track); the smaller inlet heating of a starved contact; side loss of a layer.
"""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.checks import known
from ..numerics.roots import Root, monotone_root
from ..numerics.safe import log_add, softplus, softplus_floor

GAP_EXPONENT = 1.19
"""Exponent g of the film factor of a gap, fitted to full solutions."""
LINE_LAYER_EXPONENT = 8.0
"""Exponent gamma of a line contact. No oil leaves it sideways: exactly, the film is the smaller of layer and flooded
film."""
POINT_LAYER_EXPONENT = 3.0
"""Exponent gamma of an elliptic contact, which oil also leaves sideways; 2 to 5 in the literature (from memory)."""
MINIMUM_OVER_CENTRAL = 0.75
"""Ratio of minimum to central film in the incompressible solutions to which the rolling factor was fitted."""
LAYER_FLOOR = 1e-15
"""Thickness added to a layer or a gap, m: the film without any oil; a relative error of 1e-9 at 1 um."""
LEAST_GAP = -27.631021115928547
"""Smallest ln S in the rolling factors, ln(1e-12), for finite slopes."""
GAP_WIDTH = 1.0
"""Smoothing width of `LEAST_GAP`: ln S above -2 changes by less than 1e-11."""
MENISCUS_FLOOR = 1e-9
"""Smallest relative distance of the meniscus from the edge of the contact, (x_m - a)/a."""
MENISCUS_WIDTH = 1e-3
"""Smoothing width of `MENISCUS_FLOOR`: (x_m - a)/a above 0.03 changes by less than 1e-15."""
CORNER = 80.0
"""Exponent that rounds the corner of Hamrock and Dowson's factor, which lowers it by 0.9 % there."""
FAR = -30.0
"""Value of x below which 1 - (1 + e^x)^(-k) equals k e^x to 1e-13."""


def log_film_factor_of_gap(log_gap: Values, exponent: Values = GAP_EXPONENT) -> Float[Array, "..."]:
    r"""Logarithm of the film factor of a meniscus gap, $\varphi_f = S_c/(1 + S_c^g)^{1/g}$.

    **Limits:** $1 - S_c^{-g}/g$ at a wide gap, $S_c$ at a narrow one.
    **Validity:** within -0.10 (at M = 1) and +0.04 of full solutions of line contacts, M = 1 to 100, L = 5 to 14; for
    the minimum film, within -0.10 and +0.06.
    **Reference:** own fit.

    **Arguments:** `log_gap`, ln S_c; `exponent` g, > 0.
    """
    return -softplus(-exponent * log_gap) / exponent


def log_film_factor_of_layer(log_layer: Values, exponent: Values) -> Float[Array, "..."]:
    r"""Logarithm of the film factor of an oil layer, $\varphi_f = r/(1 + r^\gamma)^{1/\gamma}$, $r = h_l/h_c$.

    **Limits:** 1 for a thick layer; r for a thin one: the film then equals the layer; it is never thicker.
    **Validity:** equal density of the oil inside and outside of the film.
    **Reference:** Chevalier et al. (1998); Damiens et al. (2004), who find that a single parameter governs.

    **Arguments:** `log_layer`, ln r; `exponent` gamma, > 0: `LINE_LAYER_EXPONENT` or `POINT_LAYER_EXPONENT`.
    """
    return -softplus(-exponent * log_layer) / exponent


def log_gap_of_layer(log_layer: Values, exponent: Values, gap_exponent: Values = GAP_EXPONENT) -> Float[Array, "..."]:
    r"""Logarithm of the gap $S_c = \varphi_f/(1 - \varphi_f^g)^{1/g}$ with the same film factor as an oil layer.

    With $1 - \varphi_f^g = 1 - (1 + r^{-\gamma})^{-g/\gamma}$ no digits cancel at a thick layer (`log_deficit`).

    **Arguments:** `log_layer`, ln r; `exponent` gamma and `gap_exponent` g, > 0.
    """
    missing = log_deficit(-exponent * log_layer, gap_exponent / exponent)
    return log_film_factor_of_layer(log_layer, exponent) - missing / gap_exponent


def log_deficit(x: Values, exponent: Values) -> Float[Array, "..."]:
    """Logarithm of 1 - (1 + e^x)^(-k), without cancellation. **Arguments:** `x`; `exponent` k, > 0."""
    x = jnp.asarray(x, dtype=float)
    far = x < FAR
    near = jnp.where(far, FAR, x)
    return jnp.where(far, x + jnp.log(exponent), jnp.log(-jnp.expm1(-exponent * softplus(near))))


def layer_of_flow(capture: Values, oil_flow: Values, width: Values, speed: Values) -> Float[Array, "..."]:
    r"""Layer that a flow of oil leaves on the track, m: $h_l = \eta_cQ/(\ell u)$.

    The part $\eta_c$ of the flow through the bearing reaches the track and is spread over it once between two passages
    of rolling elements; their number cancels.

    **Validity:** $\eta_c$ is known to a factor of 10 only.

    **Arguments:** `capture` eta_c; `oil_flow` Q, m^3/s; `width` of the track l, m, > 0; `speed` u, mean of both
    surfaces, m/s, > 0.
    """
    return jnp.asarray(capture * oil_flow / (width * speed))


def hertz_gap(half_width: Values, radius: Values, distance: Values) -> Float[Array, "..."]:
    r"""Gap beside a dry Hertzian line contact, m: $\frac{a^2}{2R}[X\sqrt{X^2-1} - \text{arccosh}X]$, $X = x/a$.

    **Validity:** line contacts, and wide ellipses in the plane of rolling; a circular contact has an 18 % wider gap at
    X = 1.5. At X <= 1, inside the contact, X - 1 is continued smoothly as $10^{-3}e^{1000(X-1)}$.

    **Arguments:** `half_width` a, m; `radius` R, m; `distance` x from the centre, m, > a.

    **Raises:** `ValueError` for a distance inside the contact (single numbers that are not traced).
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
    r"""Logarithm of the gap $S_c$ at a meniscus, the dry gap plus the film: $S_c = G + \varphi_f(S_c)$.

    The root of a scalar function that is nearly linear in logarithms, with the derivative of the implicit function.

    **Limits:** $S_c = G + 1$ at a distant meniscus; $(gG)^{1/(1+g)}$ next to the Hertz zone, where the film vanishes.

    **Arguments:** `log_hertz_gap`, ln G, with G the dry gap at the meniscus over h_c; `exponent` g, > 0.
    """

    def excess(log_gap: Array, args: tuple[Array, Array]) -> Array:
        target, power = args
        return log_gap + log_deficit(power * log_gap, 1.0 / power) - target

    target, power = jnp.asarray(log_hertz_gap, dtype=float), jnp.asarray(exponent, dtype=float)
    near = (target + jnp.log(power)) / (1.0 + power)
    low, high = jnp.minimum(near, target) - 2.0, jnp.maximum(near, target) + 3.0
    return monotone_root(excess, (target, power), low, high, log_add(near, target))


def starved_rolling_factor(log_gap_over_minimum: Values) -> Float[Array, "..."]:
    r"""Starvation factor of rolling, $\varphi_r = 1/(1 + 1.4317\,S^{-1/2} + 1.0161\,S^{-1} + 6.559\,S^{-1.75})$.

    **Limits:** $1 - 1.43/\sqrt S$ at large S: even the distant inlet contributes; proportional to $S^{1.75}$ at small
    S, which is floored at 1e-12.
    **Validity:** within -0.03 and +0.05 of full solutions of line contacts, M = 1 to 100, L = 5 to 14, S = 0.3 to 540.
    Point contacts use it too, for which it is not verified.
    **Reference:** own fit.

    **Arguments:** `log_gap_over_minimum`, ln S.
    """
    log_gap = _floored(log_gap_over_minimum)
    root = jnp.exp(-0.5 * log_gap)
    return 1.0 / (1.0 + root * (1.4317 + 1.0161 * root) + 6.559 * jnp.exp(-1.75 * log_gap))


def biboulet_houpert_rolling_factor(log_gap_over_minimum: Values) -> Float[Array, "..."]:
    r"""Biboulet and Houpert's starvation factor of rolling, $\varphi_r = (S^2 + 162.8\,S)/(S^2 + 193.1\,S + 1257)$.

    **Limits:** $1 - 30.3/S$ at large S; proportional to S at small S, which is floored at 1e-12.
    **Validity:** within -0.10 and +0.04 of the full solutions that `starved_rolling_factor` was fitted to.
    **Reference:** Biboulet and Houpert (2010), Proc. IMechE J 224, 777, eq. (44).

    **Arguments:** `log_gap_over_minimum`, ln S.
    """
    near = jnp.exp(-_floored(log_gap_over_minimum))
    return (1.0 + 162.8 * near) / (1.0 + near * (193.1 + 1257.0 * near))


def hamrock_dowson_log_film_factor(distance_ratio: Values, film_ratio: Values) -> Float[Array, "..."]:
    r"""Logarithm of Hamrock and Dowson's factor of a meniscus distance, $\varphi_f = [(m-1)/(m^*-1)]^{0.29} \le 1$.

    $m^* = 1 + 3.06\,H^{0.58}$, $H = (R_x/a)^2h_c/R_x$.

    **Limits:** 1 for m well above m*; the corner at m* is rounded (0.9 % lower). m <= 1 as in `hertz_gap`.
    **Validity:** m >= 1.2, where own solutions agree to 0.02; at m = 1.05 they are up to 0.12 lower.
    **Reference:** Hamrock and Dowson (1977), ASME J. Lubr. Technol. 99, 15; the constants from memory.

    **Arguments:** `distance_ratio` m = x_m/a; `film_ratio` H.
    """
    log_share = jnp.log(_outside(distance_ratio)) - jnp.log(3.06) - 0.58 * jnp.log(film_ratio)
    return -softplus(-CORNER * 0.29 * log_share) / CORNER


def levelling_time(
    viscosity: Values, half_width: Values, surface_tension: Values, layer: Values
) -> Float[Array, "..."]:
    r"""Time scale in which surface tension refills a track, s: $t = 3\mu b^4/(\sigma h^3)$.

    For b = 0.5 mm and a layer of 10 um it is a minute, while rollers follow each other within a millisecond: a track in
    a bearing is refilled by side ridges, cage and spin, not by surface tension.

    **Arguments:** `viscosity`, Pa s; `half_width` b of the track, m; `surface_tension`, N/m; `layer` h, m.
    """
    return jnp.asarray(3.0 * viscosity * jnp.asarray(half_width) ** 4 / (surface_tension * jnp.asarray(layer) ** 3))


def _floored(log_gap: Values) -> Float[Array, "..."]:
    return softplus_floor(log_gap, LEAST_GAP, GAP_WIDTH)


def _outside(ratio: Values) -> Float[Array, "..."]:
    """Smoothly floored x/a - 1, > 0."""
    return softplus_floor(ratio - 1.0, MENISCUS_FLOOR, MENISCUS_WIDTH)
