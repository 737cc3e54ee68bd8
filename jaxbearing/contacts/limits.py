"""Viscous and elastic limits of the traction law: Deborah number and traction slope of the elastic limit."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import AbstractRheology, Lubricant
from .patch import ContactPatch


def deborah_number(
    patch: ContactPatch, entrainment_speed: Values, temperature: Values, lubricant: Lubricant
) -> Float[Array, "..."]:
    r"""$D = \mu u/(Ga)$ at the mean pressure: relaxation time of the oil over the transit time a/u.

    Below about 0.1 the oil flows as a viscous fluid, and its shear modulus has no effect on the traction. Above about 3
    the slope of the traction curve at small sliding is elastic.

    **Reference:** source eqs. (80)-(81).

    **Arguments:** `entrainment_speed`, m/s; `temperature`, K. **Raises:** `ValueError` if no rheology is given.
    """
    if lubricant.rheology is None:
        raise ValueError("The Deborah number needs the lubricant's rheology (shear modulus): none is given.")
    pressure = patch.mean_pressure
    log_viscosity = lubricant.viscosity.log_viscosity(pressure, temperature)
    log_time = log_viscosity - lubricant.rheology.log_shear_modulus(pressure, temperature)
    return jnp.exp(log_time) * jnp.abs(entrainment_speed) / patch.half_width


def elastic_slope(
    patch: ContactPatch, film: Values, temperature: Values, rheology: AbstractRheology
) -> Float[Array, "..."]:
    r"""Slope of the traction coefficient over the slide-to-roll ratio for a purely elastic oil.

    $\partial c_f/\partial(\Delta u/u) = \frac{4}{\pi}\frac{G a}{h p_0}$, for point and line contacts. It follows
    from the integral of the stress $G\Delta u(x + a)/(uh)$ over the patch, with a constant G.

    **Validity:** D >> 1 and small sliding; G at the mean pressure.
    **Reference:** derived here. The source's eq. (84) multiplies the area by the stress at the exit, which is twice the
    mean stress, and its factors contradict each other.

    **Arguments:** `film`, m; `temperature`, K.
    """
    modulus = jnp.exp(rheology.log_shear_modulus(patch.mean_pressure, temperature))
    return 4.0 / jnp.pi * modulus * patch.half_width / (film * patch.pressure)
