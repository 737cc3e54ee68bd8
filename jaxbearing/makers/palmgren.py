r"""Palmgren's formula with the constants of INA and Timken, and Timken's formula for tapered roller bearings.

$M_0 = 10^{-7}f_0(\nu n)^{2/3}d_m^3$ from $\nu n = 2000$ on and $160\cdot10^{-7}f_0d_m^3$ below; $M_1 = f_1P_1d_m$.

Arguments and moments are in SI units; the catalogues' units (N mm, mm, rpm, mm^2/s) are used inside only.

**Reference:** Palmgren (1959); Schaeffler/INA catalogue HR1, pages 55 to 61; Timken Engineering Manual, pages 179 to
184.
"""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.safe import power, regular_power
from .skf import MM, STILL, rolled, speed_in_rpm

SLOW = 2000.0
"""Product nu n, mm^2/s rpm, below which M0 does not depend on the speed."""
RATIO_WIDTH = 1e-9
"""Value of P0/C0 below which its power is replaced by a linear function."""


def viscous_moment(f0: Values, speed: Values, viscosity: Values, mean_diameter: Scalar) -> Batch:
    """Viscous moment M0, N m. It jumps by 0.8 % at nu n = 2000, as the printed formula does.

    **Arguments:** `speed`, rad/s; `viscosity`, kinematic, m^2/s; `mean_diameter`, m.
    """
    moved = rolled(viscosity, speed)
    fast = moved >= SLOW
    share = jnp.where(fast, 1e-7 * power(jnp.where(fast, moved, SLOW), 2.0 / 3.0), 160e-7)
    return f0 * share * (jnp.asarray(mean_diameter) * MM) ** 3 / MM


def load_moment(f1: Values, load: Values, mean_diameter: Scalar) -> Batch:
    """Load-dependent moment M1 = f1 P1 d_m, N m. **Arguments:** `load` P1, N; `mean_diameter`, m."""
    return jnp.asarray(f1) * load * mean_diameter


def load_factor(size: Scalar, exponent: float, static_load: Values, static_capacity: Values) -> Batch:
    """Factor f1 = size (P0/C0)^exponent, a constant for `exponent` 0. **Arguments:** `static_load` P0 and
    `static_capacity` C0, N."""
    if exponent == 0.0:
        return jnp.asarray(size, dtype=float)
    return size * regular_power(jnp.asarray(static_load) / static_capacity, exponent, RATIO_WIDTH)


def ina_load(
    family: str, radial: Values, axial: Values, axial_factor: Values | None = None, double_row: bool = False
) -> Batch:
    """Load P1 of INA, N, at least the radial load.

    Deep groove 3.3 Fa - 0.1 Fr; angular contact Fa - 0.1 Fr, in double rows 1.4 Fa - 0.1 Fr; four-point
    1.5 Fa + 3.6 Fr; tapered 2 Y Fa; cylindrical Fr.

    **Arguments:** loads >= 0, N; `axial_factor` Y of tapered bearings.
    """
    fr, fa = jnp.asarray(radial), jnp.asarray(axial)
    if family == "deep_groove":
        load = 3.3 * fa - 0.1 * fr
    elif family == "angular_contact":
        load = (1.4 if double_row else 1.0) * fa - 0.1 * fr
    elif family == "four_point":
        load = 1.5 * fa + 3.6 * fr
    elif family == "tapered":
        assert axial_factor is not None
        load = 2.0 * axial_factor * fa
    else:
        load = fr
    return jnp.maximum(load, fr)


def timken_load(radial: Values, axial: Values, contact_angle: Scalar) -> Batch:
    r"""P1 of Timken for radial ball bearings, $\max(0.9F_a\cot\alpha - 0.1F_r, F_r)$, N.

    **Arguments:** loads >= 0, N; `contact_angle`, rad, > 0.
    """
    fr = jnp.asarray(radial)
    return jnp.maximum(0.9 * axial / jnp.tan(contact_angle) - 0.1 * fr, fr)


def timken_tapered_moment(g1: Values, speed: Values, dynamic_viscosity: Values, equivalent: Values) -> Batch:
    r"""$M = 2.56\cdot10^{-6}G_1(n\mu)^{0.62}(f_3F_r/K)^{0.3}$, N m, with $\mu$ in mPa s.

    **Validity:** speeds from `timken_least_speed` on. **Arguments:** `g1`: G1 of the bearing; `speed`, rad/s;
    `dynamic_viscosity`, Pa s; `equivalent`: f3 Fr/K, N, or the axial load where K Fa/Fr > 2.
    """
    moved = regular_power(speed_in_rpm(speed) * jnp.asarray(dynamic_viscosity) * 1e3, 0.62, STILL)
    return 2.56e-6 * g1 * moved * regular_power(jnp.asarray(equivalent), 0.3, STILL)


def timken_least_speed(g2: Values, dynamic_viscosity: Values, f2: Values, radial: Values, factor: Values) -> Batch:
    r"""Least speed of Timken's formula, $n_{min} = \frac{625}{G_2\mu}(f_2F_r/K)^{2/3}$ in rpm, returned in rad/s.

    **Arguments:** `g2`: G2 of the bearing; `dynamic_viscosity`, Pa s; `f2`: read from the manual's graph; `radial`, N;
    `factor` K.
    """
    least = 625.0 / (g2 * jnp.asarray(dynamic_viscosity) * 1e3)
    return least * regular_power(jnp.asarray(f2) * radial / factor, 2.0 / 3.0, STILL) * jnp.pi / 30.0
