"""Point contact of two curved bodies: exact Hertz ellipse and pressure."""

import dataclasses
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.arguments import require_numbers
from ..numerics.compiling import compiled_by_hand
from ..numerics.safe import smooth_abs

LOAD_WIDTH = 1e-3
"""Smoothing of |load| in size and pressure, N: the relative error of the load is 5e-7 at 1 N."""
AGM_PASSES = 7
NEWTON_STEPS = 4


class PointContact(eqx.Module):
    r"""Two curved elastic bodies pressed together at a point; principal planes along and across rolling.

    The semi-axes a along and c across the rolling direction are in the ratio k = c/a that solves
    $R_y/R_x = k^2B(m)/D(m)$, $m = 1 - 1/k^2$ (B, D the complete elliptic integrals $\int\cos^2$, $\int\sin^2$ over
    $\sqrt{1 - m\sin^2}$), $\sqrt{ac} = [6k^{1/2}E(m)QR/(\pi E')]^{1/3}$, $1/R = 1/R_x + 1/R_y$, and
    $p_0 = 3Q/(2\pi ac)$; for $R_y < R_x$ the planes change places.

    **Limits:** k = 1 with $dk/d(R_y/R_x) = 2/3$ at $R_x = R_y$. At load 0 size and pressure are those of 1 mN, with
    gradient 0; a negative load counts as |Q|.
    **Validity:** half-space, elastic, frictionless. Round-off in k for radius ratios from 1e-6 to 1e6.
    **Reference:** Hertz (1881); Johnson, *Contact Mechanics*, ch. 4.
    """

    reduced_radius_rolling: Values
    reduced_radius_transverse: Values
    reduced_modulus: Values

    def __check_init__(self):
        for field in dataclasses.fields(self):
            require_numbers("> 0", **{field.name: getattr(self, field.name)})

    def ellipticity(self) -> Float[Array, "..."]:
        """k = c/a, semi-axis across over semi-axis along rolling."""
        return jnp.exp(self._log_ellipticity())

    def semi_axis_rolling(self, load: Values) -> Float[Array, "..."]:
        """a, m. **Arguments:** `load`, N, >= 0."""
        log_k = self._log_ellipticity()
        return jnp.exp(-0.5 * log_k) * self._mean_axis(log_k, load)

    def semi_axis_transverse(self, load: Values) -> Float[Array, "..."]:
        """c, m. **Arguments:** `load`, N, >= 0."""
        log_k = self._log_ellipticity()
        return jnp.exp(0.5 * log_k) * self._mean_axis(log_k, load)

    def hertz_pressure(self, load: Values) -> Float[Array, "..."]:
        """Peak pressure p0, Pa. **Arguments:** `load`, N, >= 0."""
        mean_axis = self._mean_axis(self._log_ellipticity(), load)
        return 1.5 / jnp.pi * smooth_abs(load, LOAD_WIDTH) / jnp.square(mean_axis)

    def ellipse(self, load: Values) -> "Ellipse":
        """Both semi-axes and the peak pressure at once. **Arguments:** `load`, N, >= 0."""
        log_k = self._log_ellipticity()
        mean_axis, stretch = self._mean_axis(log_k, load), jnp.exp(0.5 * log_k)
        pressure = 1.5 / jnp.pi * smooth_abs(load, LOAD_WIDTH) / jnp.square(mean_axis)
        return Ellipse(mean_axis / stretch, mean_axis * stretch, pressure)

    def mean_pressure(self, load: Values) -> Float[Array, "..."]:
        """Mean pressure Q/(pi a c), Pa. **Arguments:** `load`, N, >= 0."""
        return 2.0 / 3.0 * self.hertz_pressure(load)

    def load_at_pressure(self, pressure: Values) -> Float[Array, "..."]:
        """Load that gives a Hertz (peak) pressure, N. **Arguments:** `pressure`, Pa, > 0."""
        return jnp.square(self._compliance(self._log_ellipticity())) * (jnp.pi / 1.5 * jnp.asarray(pressure)) ** 3

    def stiffness_constant(self) -> Float[Array, "..."]:
        r"""$K = Q/\delta^{3/2}$, N/m^(3/2), $\pi kE'\sqrt{2ER/(9K_1^3)}$ with the complete integrals E and $K_1$."""
        log_k = jnp.abs(self._log_ellipticity())
        integrals = _elliptic(log_k)
        second_kind = integrals.b + integrals.d * jnp.exp(-2.0 * log_k)
        curvature = 1.0 / self.reduced_radius_rolling + 1.0 / self.reduced_radius_transverse
        root = jnp.sqrt(2.0 / 9.0 * second_kind / (curvature * integrals.k))
        return jnp.pi * jnp.exp(log_k) * self.reduced_modulus * root / integrals.k

    def _log_ellipticity(self) -> Array:
        return log_ellipticity(jnp.log(self.reduced_radius_transverse) - jnp.log(self.reduced_radius_rolling))

    def _mean_axis(self, log_k: Array, load: Values) -> Array:
        """sqrt(a c), m."""
        return jnp.cbrt(self._compliance(log_k) * smooth_abs(load, LOAD_WIDTH))

    def _compliance(self, log_k: Array) -> Array:
        """sqrt(a c)^3 over the load, m^3/N."""
        log_k = jnp.abs(log_k)
        integrals = _elliptic(log_k)
        second_kind = integrals.b + integrals.d * jnp.exp(-2.0 * log_k)
        curvature = 1.0 / self.reduced_radius_rolling + 1.0 / self.reduced_radius_transverse
        return 6.0 / jnp.pi * jnp.exp(0.5 * log_k) * second_kind / (curvature * self.reduced_modulus)


class Ellipse(NamedTuple):
    """Loaded ellipse: semi-axes along and across rolling, m, and peak pressure, Pa."""

    rolling: Float[Array, "..."]
    transverse: Float[Array, "..."]
    pressure: Float[Array, "..."]


PointContact.__init__.__doc__ = """**Arguments:**
- `reduced_radius_rolling`: Rx, m, 1/Rx = 1/Rx1 + 1/Rx2 in the plane of rolling, convex > 0.
- `reduced_radius_transverse`: Ry, m, > 0.
- `reduced_modulus`: E', Pa (see `materials.reduced_modulus`).
"""


class _Elliptic(NamedTuple):
    """K, B, D = int sin^2/sqrt(1 - m sin^2), B = K - D, and dD/dm; m = 1 - exp(-2 log_k), log_k >= 0."""

    k: Array
    b: Array
    d: Array
    d_slope: Array


def _elliptic(log_k: Array) -> _Elliptic:
    """By the arithmetic-geometric mean; regular at m = 0, where K - E and E - (1 - m) K would cancel."""
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


def _log_ratio_and_slope(log_k: Array) -> tuple[Array, Array]:
    """ln(Ry/Rx) = 2 ln k + ln B - ln D and its slope in ln k, for ln k >= 0."""
    integrals = _elliptic(log_k)
    first_slope = 0.5 * jnp.exp(2.0 * log_k) * integrals.b  # dK/dm
    bracket = (first_slope - integrals.d_slope) / integrals.b - integrals.d_slope / integrals.d
    log_ratio = 2.0 * log_k + jnp.log(integrals.b) - jnp.log(integrals.d)
    return log_ratio, 2.0 + 2.0 * jnp.exp(-2.0 * log_k) * bracket


@jax.custom_jvp
@compiled_by_hand
def log_ellipticity(log_ratio: Array) -> Array:
    """ln(c/a) of the Hertz ellipse from ln(Ry/Rx): odd, slope 2/3 at 0.

    Four Newton steps from Hamrock and Brewe's approximation end at round-off for |ln(Ry/Rx)| up to 14.
    """
    size = jnp.abs(log_ratio)
    log_k = -jnp.expm1(-size) * jnp.log(1.0339) + 0.636 * size

    def newton(_, log_k: Array) -> Array:
        value, slope = _log_ratio_and_slope(log_k)
        return log_k - (value - size) / slope

    # a loop, not four copies: they would be half of what a ball bearing takes to compile
    return jnp.sign(log_ratio) * jax.lax.fori_loop(0, NEWTON_STEPS, newton, log_k)


@log_ellipticity.defjvp
def _log_ellipticity_jvp(primals, tangents):
    log_k = log_ellipticity(primals[0])
    return log_k, tangents[0] / _log_ratio_and_slope(jnp.abs(log_k))[1]
