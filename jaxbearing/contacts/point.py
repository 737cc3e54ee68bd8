"""Point contact of two curved bodies: exact Hertz ellipse and pressure."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.arguments import require_numbers
from ..numerics.compiling import compiled_by_hand
from ..numerics.safe import positive_power, smooth_abs

LOAD_WIDTH = 1e-3
"""Smoothing of |load| in semi-axes and pressure, N: the relative error of the load is 5e-7 at 1 N."""
AGM_PASSES = 7
NEWTON_STEPS = 4


class PointContact(eqx.Module):
    r"""Two curved elastic bodies pressed together at a point, with principal planes along and across rolling.

    The semi-axes are a along and c across rolling. Their ratio k = c/a solves $R_y/R_x = k^2B(m)/D(m)$,
    $m = 1 - 1/k^2$, with the complete elliptic integrals B and D of $\cos^2/\sqrt{1 - m\sin^2}$ and
    $\sin^2/\sqrt{1 - m\sin^2}$. Their size follows from $\sqrt{ac} = [6k^{1/2}E(m)QR/(\pi E')]^{1/3}$,
    $1/R = 1/R_x + 1/R_y$, and the pressure is $p_0 = 3Q/(2\pi ac)$. For $R_y < R_x$ the two planes are exchanged.

    **Limits:** k = 1 with $dk/d(R_y/R_x) = 2/3$ at $R_x = R_y$. At load 0 semi-axes and pressure are those of 1 mN,
    with gradient 0; a negative load counts as |Q|.
    **Validity:** elastic half-spaces without friction. k is exact to round-off for radius ratios from 1e-6 to 1e6.
    **Reference:** Hertz (1881); Johnson, *Contact Mechanics*, ch. 4.
    """

    reduced_radius_rolling: Values
    reduced_radius_transverse: Values
    reduced_modulus: Values
    shape: "HertzShape | None" = eqx.field(init=False)

    def __post_init__(self):
        self.shape = None

    def __check_init__(self):
        for name in ("reduced_radius_rolling", "reduced_radius_transverse", "reduced_modulus"):
            require_numbers("> 0", **{name: getattr(self, name)})

    def shaped(self) -> "PointContact":
        """The same contact with the shape of its ellipse stored.

        The shape takes a root search, and the laws need it many times. Do not change the radii of the result with
        `eqx.tree_at`: the stored shape would remain that of the old radii. `dataclasses.replace` removes the shape.
        """
        return eqx.tree_at(lambda c: c.shape, self, self._shape(), is_leaf=lambda leaf: leaf is None)

    def ellipticity(self) -> Float[Array, "..."]:
        """Ellipticity k = c/a, semi-axis across rolling over semi-axis along rolling."""
        return jnp.exp(self._shape().log_ellipticity)

    def log_second_kind(self) -> Float[Array, "..."]:
        """Logarithm of the complete elliptic integral E(m), m = 1 - (shorter over longer semi-axis)^2."""
        shape = self._shape()
        return jnp.log(shape.size) - 0.5 * jnp.abs(shape.log_ellipticity)

    def semi_axis_rolling(self, load: Values) -> Float[Array, "..."]:
        """Semi-axis a along rolling, m. **Arguments:** `load`, N, >= 0."""
        return self.ellipse(load).rolling

    def semi_axis_transverse(self, load: Values) -> Float[Array, "..."]:
        """Semi-axis c across rolling, m. **Arguments:** `load`, N, >= 0."""
        return self.ellipse(load).transverse

    def hertz_pressure(self, load: Values) -> Float[Array, "..."]:
        """Peak pressure p0, Pa. **Arguments:** `load`, N, >= 0."""
        return self.ellipse(load).pressure

    def ellipse(self, load: Values) -> "Ellipse":
        """Both semi-axes and the peak pressure at once. **Arguments:** `load`, N, >= 0."""
        shape, load = self._shape(), smooth_abs(load, LOAD_WIDTH)
        mean_axis, stretch = jnp.cbrt(self._compliance(shape) * load), jnp.exp(0.5 * shape.log_ellipticity)
        pressure = 1.5 / jnp.pi * load / jnp.square(mean_axis)
        return Ellipse(mean_axis / stretch, mean_axis * stretch, pressure)

    def mean_pressure(self, load: Values) -> Float[Array, "..."]:
        """Mean pressure Q/(pi a c), Pa. **Arguments:** `load`, N, >= 0."""
        return 2.0 / 3.0 * self.hertz_pressure(load)

    def load_at_pressure(self, pressure: Values) -> Float[Array, "..."]:
        """Load that gives a Hertz (peak) pressure, N. **Arguments:** `pressure`, Pa, > 0."""
        return jnp.square(self._compliance(self._shape())) * (jnp.pi / 1.5 * jnp.asarray(pressure)) ** 3

    def stiffness_constant(self) -> Float[Array, "..."]:
        r"""Stiffness constant $K = Q/\delta^{3/2}$, N/m^(3/2).

        $K = \pi kE'\sqrt{2ER/(9K_1^3)}$ with the complete elliptic integrals E and $K_1$ of second and first kind; k is
        the longer semi-axis over the shorter one.
        """
        log_k = jnp.abs(log_ellipticity(self._log_radius_ratio()))
        integrals = _elliptic(log_k)
        root = jnp.sqrt(2.0 / 9.0 * _second_kind(integrals, log_k) / (self._curvature() * integrals.k))
        return jnp.pi * jnp.exp(log_k) * self.reduced_modulus * root / integrals.k

    def load_at_approach(self, approach: Values) -> Float[Array, "..."]:
        """Load at an approach of the bodies, N; 0 if they do not touch. **Arguments:** `approach`: from first contact,
        m."""
        return self.stiffness_constant() * positive_power(approach, 1.5)

    def approach(self, load: Values) -> Float[Array, "..."]:
        """Approach of the bodies from first contact, m; its slope grows without bound as the load goes to 0.
        **Arguments:** `load`, N, >= 0."""
        return (jnp.asarray(load) / self.stiffness_constant()) ** (2.0 / 3.0)

    def _log_radius_ratio(self) -> Array:
        return jnp.log(self.reduced_radius_transverse) - jnp.log(self.reduced_radius_rolling)

    def _shape(self) -> "HertzShape":
        return hertz_shape(self._log_radius_ratio()) if self.shape is None else self.shape

    def _curvature(self) -> Array:
        """Sum 1/R of the curvatures, 1/m."""
        return jnp.asarray(1.0 / self.reduced_radius_rolling + 1.0 / self.reduced_radius_transverse)

    def _compliance(self, shape: "HertzShape") -> Array:
        """Ratio of sqrt(a c)^3 to the load, m^3/N."""
        return 6.0 / jnp.pi * shape.size / (self._curvature() * self.reduced_modulus)


class Ellipse(NamedTuple):
    """Contact ellipse: semi-axes along and across rolling, m, and peak pressure, Pa."""

    rolling: Float[Array, "..."]
    transverse: Float[Array, "..."]
    pressure: Float[Array, "..."]


PointContact.__init__.__doc__ = """**Arguments:**
- `reduced_radius_rolling`: Rx, m, 1/Rx = 1/Rx1 + 1/Rx2 in the plane of rolling, convex > 0.
- `reduced_radius_transverse`: Ry, m, > 0.
- `reduced_modulus`: E', Pa (see `materials.reduced_modulus`).
"""


class HertzShape(NamedTuple):
    """Quantities of the ellipse that depend on the radii only.

    - `log_ellipticity`: ln(c/a).
    - `size`: $\\sqrt{k}\\,E(m)$ with k = c/a or a/c, whichever is larger.
    """

    log_ellipticity: Float[Array, "..."]
    size: Float[Array, "..."]


class _Elliptic(NamedTuple):
    """Complete elliptic integrals K, B = K - D and D = int sin^2/sqrt(1 - m sin^2), and the slope dD/dm, at
    m = 1 - exp(-2 log_k), log_k >= 0."""

    k: Array
    b: Array
    d: Array
    d_slope: Array


def _elliptic(log_k: Array) -> _Elliptic:
    """Complete elliptic integrals by the arithmetic-geometric mean. They are exact near m = 0 too, where the
    differences K - E and E - (1 - m) K would lose digits by cancellation."""
    m = -jnp.expm1(-2.0 * log_k)
    arithmetic, geometric = jnp.ones_like(log_k), jnp.exp(-log_k)
    excess = term = jnp.zeros_like(log_k)  # D/K = 1/2 + m excess
    for n in range(AGM_PASSES):
        arithmetic, geometric = 0.5 * (arithmetic + geometric), jnp.sqrt(arithmetic * geometric)
        term = (1.0 if n == 0 else jnp.square(m * term)) / (16.0 * jnp.square(arithmetic))
        excess = excess + 2.0**n * term
    first_kind = 0.5 * jnp.pi / arithmetic
    d = first_kind * (0.5 + m * excess)
    squared = jnp.exp(2.0 * log_k)
    return _Elliptic(first_kind, first_kind - d, d, 0.5 * first_kind * (0.5 * squared - (squared + 1.0) * excess))


def _second_kind(integrals: _Elliptic, log_k: Array) -> Array:
    """Complete elliptic integral of the second kind, E = B + (1 - m) D."""
    return integrals.b + integrals.d * jnp.exp(-2.0 * log_k)


def _log_ratio(integrals: _Elliptic, log_k: Array) -> Array:
    """Logarithm of Ry/Rx, 2 ln k + ln B - ln D, for ln k >= 0."""
    return 2.0 * log_k + jnp.log(integrals.b) - jnp.log(integrals.d)


def _log_ratio_slope(integrals: _Elliptic, log_k: Array) -> Array:
    """Derivative of `_log_ratio` with respect to ln k."""
    first_slope = 0.5 * jnp.exp(2.0 * log_k) * integrals.b  # dK/dm
    bracket = (first_slope - integrals.d_slope) / integrals.b - integrals.d_slope / integrals.d
    return 2.0 + 2.0 * jnp.exp(-2.0 * log_k) * bracket


@jax.custom_jvp
@compiled_by_hand
def log_ellipticity(log_ratio: Array) -> Array:
    """Logarithm of c/a of the Hertz ellipse as a function of ln(Ry/Rx): odd, with slope 2/3 at 0.

    Four Newton steps from Hamrock and Brewe's approximation give it to round-off for |ln(Ry/Rx)| up to 14.
    """
    size = jnp.abs(log_ratio)
    log_k = -jnp.expm1(-size) * jnp.log(1.0339) + 0.636 * size

    def newton(_, log_k: Array) -> Array:
        integrals = _elliptic(log_k)
        return log_k - (_log_ratio(integrals, log_k) - size) / _log_ratio_slope(integrals, log_k)

    # a loop: four copies of the step would take half of the time to compile a ball bearing
    return jnp.sign(log_ratio) * jax.lax.fori_loop(0, NEWTON_STEPS, newton, log_k)


@log_ellipticity.defjvp
def _log_ellipticity_jvp(primals, tangents):
    log_k = log_ellipticity(primals[0])
    size = jnp.abs(log_k)
    return log_k, tangents[0] / _log_ratio_slope(_elliptic(size), size)


@jax.custom_jvp
def _size(log_k: Array) -> Array:
    """Size sqrt(k) E(m) for ln k >= 0. Its derivative is given in closed form, because automatic differentiation of the
    integrals would take most of the time of a derivative."""
    return jnp.exp(0.5 * log_k) * _second_kind(_elliptic(log_k), log_k)


@_size.defjvp
def _size_jvp(primals, tangents):
    """Derivative of `_size`, with dE/dm = -D/2."""
    (log_k,), (log_k_dot,) = primals, tangents
    size = _size(log_k)
    return size, (0.5 * size - jnp.exp(-1.5 * log_k) * _elliptic(log_k).d) * log_k_dot


@compiled_by_hand
def hertz_shape(log_ratio: Array) -> HertzShape:
    """Shape of the ellipse as a function of ln(Ry/Rx)."""
    log_k = log_ellipticity(log_ratio)
    # even and smooth at 0; with `jnp.abs`, whose derivative at 0 is 0, the second derivative would be lost
    return HertzShape(log_k, _size(jnp.where(log_k < 0, -log_k, log_k)))
