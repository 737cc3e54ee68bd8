"""Thermal reduction of the film by inlet heating, and the temperature rise in the inlet that explains it."""

import abc
from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, PyTree

from .._types import Values
from ..lubricants import InletOil
from ..numerics.roots import Root, monotone_root
from ..numerics.safe import regular_power, smooth_abs, softplus_floor
from .line import LOAD_FLOOR, SPEED_FLOOR, LineContact, log_material_number
from .point import PointContact

NUMERATOR_FLOOR = 0.05
"""Smallest numerator of Gupta's factor, which as printed turns negative at large thermal loading."""
NUMERATOR_WIDTH = 0.02
LOADING_WIDTH = 1e-9
"""Thermal loading below which its powers are linear: the factor changes by < 1e-11 at loading >= 1e-3."""
SLIDE_WIDTH = 1e-6
"""Slide ratio below which its power is linear."""
SLIDE_LIMIT = 10.0
"""Largest slide ratio in Hsu and Lee's exponential."""
SLIDE_LIMIT_WIDTH = 0.2
"""Smoothing width of `SLIDE_LIMIT`; a slide ratio of 4.5 changes by less than 1e-12."""
RISE_BELOW = -5.0
"""Lower end of the bracket of the temperature rise, K; below 0, so that a rise of 0 is an ordinary root."""
RISE_TOLERANCE = 1e-9
"""Last Newton step of the temperature rise, relative to the rise or 1 K; leaves an error of about 1e-11 in ln h."""


def thermal_loading(speed: Values, oil: InletOil, user: str) -> Float[Array, "..."]:
    r"""Thermal loading $L = -(\partial\mu/\partial T)\,u^2/k$.

    **Arguments:** `speed` u, m/s; `oil` at the inlet, with a conductivity k; `user`, name of the law that needs it, for
    the error message.
    **Raises:** `ValueError` for an oil without a conductivity.
    """
    if oil.conductivity is None:
        raise ValueError(f"{user} needs the lubricant's conductivity: none given.")
    slope = -jnp.multiply(oil.viscosity, oil.log_slope)
    return slope / oil.conductivity * jnp.square(speed)


class AbstractThermalFactor(eqx.Module):
    """Ratio of the film with inlet heating to the isothermal film."""

    def thermal_loading(self, entrainment_speed: Values, oil: InletOil) -> Float[Array, "..."]:
        r"""Thermal loading $L = -(\partial\mu/\partial T)\,u^2/k$.

        **Arguments:** `entrainment_speed` u, m/s; `oil` at the inlet, with a conductivity k.
        """
        return thermal_loading(entrainment_speed, oil, f"{type(self).__name__}'s thermal factor")

    def slide_ratio(self, entrainment_speed: Values, sliding_speed: Values) -> Float[Array, "..."]:
        """Slide ratio S = 2|u1 - u2|/|u1 + u2|, >= 0; finite at rest.

        **Arguments:** `entrainment_speed`, (u1 + u2)/2, and `sliding_speed`, u1 - u2, m/s.
        """
        return 2.0 * jnp.abs(sliding_speed) / smooth_abs(2.0 * entrainment_speed, SPEED_FLOOR)

    @abc.abstractmethod
    def log_factor(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        oil: InletOil,
    ) -> Float[Array, "..."]:
        """Natural logarithm of the factor, <= 0.

        **Arguments:**
        - `contact`: the two cylinders.
        - `load`: N, >= 0.
        - `entrainment_speed`: (u1 + u2)/2, m/s, of either sign.
        - `sliding_speed`: u1 - u2, m/s, of either sign.
        - `oil`: the oil at the inlet temperature.
        """


class NoThermalReduction(AbstractThermalFactor):
    """No thermal reduction (factor 1): the isothermal film of a line or point contact."""

    def log_factor(
        self,
        contact: LineContact | PointContact,
        load: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        oil: InletOil,
    ) -> Float[Array, "..."]:
        values = (*jax.tree.leaves(contact), load, entrainment_speed, sliding_speed, oil.temperature)
        return jnp.zeros(jnp.broadcast_shapes(*(jnp.shape(value) for value in values)))


class Gupta(AbstractThermalFactor):
    r"""Gupta, Cheng, Zhu, Forster and Schrand's thermal factor, for line and point contacts.

    $\phi_T = [1 - 13.2\,(p_0/E') L^{0.42}]/[1 + 0.213\,(1 + 2.23\,S^{0.83}) L^{0.64}]$, with the thermal loading
    $L = -(\partial\mu/\partial T) u^2/k$ (u the mean speed) and $S = 2|u_1 - u_2|/|u_1 + u_2|$.

    **Limits:** 1 as u -> 0 at any sliding.
    **Validity:** fitted for S up to about 2 and L up to about 20 (see `slide_ratio` and `thermal_loading`). The
    numerator, as printed negative at very large L, is floored smoothly at 0.05; the powers are linear below L = 1e-9
    and S = 1e-6.
    **Reference:** Gupta et al. (1992), ASME J. Tribology 114, 55; source eqs. (61)-(64). What the source squares
    in its eq. (63) is ambiguous; here it is the mean speed, as in the literature.
    """

    def log_factor(
        self,
        contact: LineContact | PointContact,
        load: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        oil: InletOil,
    ) -> Float[Array, "..."]:
        loading = self.thermal_loading(entrainment_speed, oil)
        slide = self.slide_ratio(entrainment_speed, sliding_speed)
        severity = contact.hertz_pressure(load) / contact.reduced_modulus
        numerator = 1.0 - 13.2 * severity * regular_power(loading, 0.42, LOADING_WIDTH)
        slide_term = 0.213 * (1.0 + 2.23 * regular_power(slide, 0.83, SLIDE_WIDTH))
        heating = slide_term * regular_power(loading, 0.64, LOADING_WIDTH)
        return jnp.log(softplus_floor(numerator, NUMERATOR_FLOOR, NUMERATOR_WIDTH)) - jnp.log1p(heating)


class HsuLee(AbstractThermalFactor):
    r"""Hsu and Lee's thermal factor of a line contact.

    $\phi_T = 1/[1 + 0.0766\,G^{0.687}W^{0.447}L^{0.527}e^{0.875S}]$, $G = \alpha E'$, $W = Q/(E'R\ell)$; L and S as in
    `Gupta`.

    **Limits:** 1 as u -> 0, as the load -> 0 and for an isoviscous oil.
    **Validity:** fitted for S up to about 2 and L up to about 20; S is limited smoothly to 10, the power of L is
    linear below 1e-9.
    **Reference:** Hsu and Lee (1994); source eq. (65), whose garbled "1 -" is read as 1/(1 + ...), since a thermal
    factor is at most 1.
    """

    def log_factor(
        self,
        contact: LineContact,
        load: Values,
        entrainment_speed: Values,
        sliding_speed: Values,
        oil: InletOil,
    ) -> Float[Array, "..."]:
        loading = self.thermal_loading(entrainment_speed, oil)
        slide = self.slide_ratio(entrainment_speed, sliding_speed)
        slide = -softplus_floor(-slide, -SLIDE_LIMIT, SLIDE_LIMIT_WIDTH)
        log_material = log_material_number(oil.pressure_viscosity, contact.reduced_modulus)
        size = contact.reduced_modulus * contact.reduced_radius * contact.length
        log_load = jnp.log(smooth_abs(load, LOAD_FLOOR)) - jnp.log(size)
        strength = jnp.exp(0.687 * log_material + 0.447 * log_load + 0.875 * slide)
        return -jnp.log1p(0.0766 * strength * regular_power(loading, 0.527, LOADING_WIDTH))


def inlet_temperature_rise(
    log_film: Callable[[Array, PyTree], Array],
    args: PyTree,
    temperature: Values,
    log_isothermal: Values,
    log_factor: Values,
    maximum: float = 500.0,
) -> Root:
    r"""Temperature rise $\Delta T$, K, that thins the isothermal film as much as the thermal factor does.

    $\ln h(T_0 + \Delta T) = \ln\phi_T + \ln h(T_0)$, elementwise.

    **Limits:** a factor of 1 gives exactly 0, with the derivative $1/(\partial\ln h/\partial T)$.
    **Validity:** where no rise up to `maximum` thins the film enough, the value is `maximum`, and `residual` is the
    remaining error of ln h.

    **Arguments:**
    - `log_film(temperature, args)`: ln of the isothermal film with the oil at that temperature, elementwise,
      decreasing.
    - `args`: pytree of arrays with all that the film depends on (`log_film` must not close over differentiated arrays).
    - `temperature`: $T_0$ of the inlet, K.
    - `log_isothermal`: $\ln h(T_0)$.
    - `log_factor`: $\ln\phi_T$, <= 0.
    - `maximum`: upper end of the search, K.
    """

    def excess(rise: Array, everything: PyTree) -> Array:
        film_args, inlet, target = everything
        return target - log_film(inlet + rise, film_args)

    temperature = jnp.asarray(temperature, dtype=float)
    target = jnp.asarray(log_isothermal + log_factor, dtype=float)
    search = (args, temperature, target)
    return monotone_root(excess, search, RISE_BELOW, maximum, jnp.zeros_like(target), tolerance=RISE_TOLERANCE)
