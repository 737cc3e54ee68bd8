"""Line contact of two parallel cylinders: half-width and pressure by Hertz, elastic approach by Palmgren."""

import dataclasses

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..numerics.arguments import require_numbers
from ..numerics.safe import positive_power, regular_power, smooth_abs

LOAD_FLOOR = 1e-9
"""Smoothing of |load| in half-width, pressure and film, N: the relative error of |load| is < 1e-12 above 1 mN."""
SPEED_FLOOR = 1e-6
"""Smoothing of |u1 + u2|, m/s: its relative error is < 1e-6 above 1 mm/s. At rest the film is tiny, but not zero."""
PRESSURE_VISCOSITY_FLOOR = 1e-25
"""Added to the pressure-viscosity coefficient, 1/Pa, so that its logarithm is finite for an isoviscous oil.
Coefficients above 1e-9 1/Pa are exact to round-off."""
PALMGREN_LOAD_WIDTH = 1e-6
"""Load below which the approach is linear in the load, not proportional to Q^0.9, N: relative error 5e-14 at 1 N."""


class LineContact(eqx.Module):
    r"""Two parallel elastic cylinders pressed together, with the load evenly distributed over the contact length.

    $b = \sqrt{8 Q R/(\pi\ell E')}$, $p_0 = \sqrt{Q E'/(2\pi R\ell)}$, $\bar p = \frac{\pi}{4}p_0$;
    Palmgren: $\delta = 0.39\,(8/E')^{0.9} Q^{0.9}/\ell^{0.8}$, where $8/E'$ is the bracket
    $4(1-\nu_1^2)/E_1 + 4(1-\nu_2^2)/E_2$ of the source.

    The fields broadcast against the load: for both races of N rollers, fields of shape (2, 1) and a load of shape
    (2, N).

    **Limits:** at load 0 the approach is 0, and half-width and pressure are those of 1e-9 N; all gradients are finite.
    A negative load counts as |Q| in half-width and pressure and as 0 in the approach.
    **Validity:** elastic half-spaces (b much smaller than R and length), no misalignment, no edge pressure. Palmgren's
    law is empirical, for finite rollers of steel; with E' and in SI units it is dimensionally homogeneous.
    **Reference:** Hertz (1881); Johnson, *Contact Mechanics*, ch. 4; Palmgren (1959); source eq. (41).
    """

    reduced_radius: Values
    length: Values
    reduced_modulus: Values

    def __check_init__(self):
        for field in dataclasses.fields(self):
            require_numbers("> 0", **{field.name: getattr(self, field.name)})

    def half_width(self, load: Values) -> Float[Array, "..."]:
        """Half-width b along rolling, m. **Arguments:** `load`, N, >= 0."""
        load = smooth_abs(load, LOAD_FLOOR)
        return jnp.sqrt(8.0 / jnp.pi * load * self.reduced_radius / (self.length * self.reduced_modulus))

    def hertz_pressure(self, load: Values) -> Float[Array, "..."]:
        """Peak pressure p0, Pa. **Arguments:** `load`, N, >= 0."""
        load = smooth_abs(load, LOAD_FLOOR)
        return jnp.sqrt(load * self.reduced_modulus / (2.0 * jnp.pi * self.reduced_radius * self.length))

    def mean_pressure(self, load: Values) -> Float[Array, "..."]:
        """Mean pressure Q/(2 b l), Pa. **Arguments:** `load`, N, >= 0."""
        return 0.25 * jnp.pi * self.hertz_pressure(load)

    def load_at_pressure(self, pressure: Values) -> Float[Array, "..."]:
        """Load that gives a Hertz (peak) pressure, N. **Arguments:** `pressure`, Pa, > 0."""
        return 2.0 * jnp.pi * self.reduced_radius * self.length / self.reduced_modulus * jnp.square(pressure)

    @property
    def palmgren_compliance(self) -> Float[Array, "..."]:
        """Constant k of Palmgren's approach delta = k Q^0.9, m/N^0.9."""
        return jnp.asarray(0.39 * (8.0 / self.reduced_modulus) ** 0.9 / self.length**0.8, dtype=float)

    def palmgren_approach(self, load: Values) -> Float[Array, "..."]:
        """Elastic approach of the two axes, m, > 0 in compression; 0 at load <= 0. **Arguments:** `load`, N."""
        load = jnp.asarray(load, dtype=float)
        pressed = jnp.where(load > 0, load, 0.0)
        return self.palmgren_compliance * regular_power(pressed, 0.9, PALMGREN_LOAD_WIDTH)

    def palmgren_load(self, approach: Values) -> Float[Array, "..."]:
        """Load that gives an elastic approach, N; 0 with slope 0 at approach <= 0. **Arguments:** `approach`, m."""
        return positive_power(approach / self.palmgren_compliance, 10.0 / 9.0)


LineContact.__init__.__doc__ = """**Arguments:**
- `reduced_radius`: R, m, 1/R = 1/R1 + 1/R2, convex > 0.
- `length`: of the contact, m, > 0.
- `reduced_modulus`: E', Pa (see `materials.reduced_modulus`).
"""


def log_entrainment_sum(entrainment_speed: Values) -> Float[Array, "..."]:
    """Logarithm of |u1 + u2| in m/s, from the mean speed; |u1 + u2| levels off at 1e-6 m/s, with gradient 0 at rest."""
    return jnp.log(smooth_abs(2.0 * entrainment_speed, SPEED_FLOOR))


def log_material_number(pressure_viscosity: Values, reduced_modulus: Values) -> Float[Array, "..."]:
    """Logarithm of G = alpha E', with 1e-25 1/Pa added to alpha: finite for an isoviscous oil."""
    return jnp.log((pressure_viscosity + PRESSURE_VISCOSITY_FLOOR) * reduced_modulus)
