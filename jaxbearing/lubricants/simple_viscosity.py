"""Viscosity laws with few parameters: constant, isoviscous liquid, Barus, Roelands."""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import bounded
from ..numerics.safe import nonnegative_pressure, softplus_floor
from .viscosity import AbstractViscosity, capped

LOG_ROELANDS_VISCOSITY = -9.67
"""Natural logarithm of the viscosity, 6.3e-5 Pa s, at which all isotherms and isobars of Roelands' law meet."""
ROELANDS_RATE = 5.1e-9
"""Pressure coefficient of Roelands' law, 1/Pa: 1/(0.196 GPa); its isotherms meet at -0.196 GPa."""
ROELANDS_POLE = 138.0
"""Temperature at which Roelands' viscosity becomes infinite, K."""
ROELANDS_MARGIN = 1.0
"""Smallest distance, K, of the temperature from the pole; colder temperatures are clamped."""
ROELANDS_WIDTH = 1.0
"""Smoothing width of that clamp, K: T is exact to 1e-12 K above 167 K."""


class ConstantViscosity(AbstractViscosity):
    """The same viscosity at every pressure and temperature: an isoviscous fluid such as water or kerosene.

    **Validity:** one temperature, and pressures at which the fluid does not thicken (water: below about 0.5 GPa).
    """

    value: Scalar = bounded("> 0", unit="Pa s")

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        shape = jnp.broadcast_shapes(jnp.shape(pressure), jnp.shape(temperature))
        return jnp.broadcast_to(jnp.log(self.value), shape)


ConstantViscosity.__init__.__doc__ = """**Arguments:**
- `value`: dynamic viscosity, Pa s, > 0.
"""


class IsoviscousLiquid(AbstractViscosity):
    r"""A thin liquid whose viscosity depends on temperature only, such as water or kerosene.

    $\mu = \mu_0\,(T/T_0)^c\exp[b(1/T - 1/T_0)]$; Andrade's law for c = 0.

    **Limits:** $\mu_0$ at $T = T_0$, at every pressure; the coefficient of film formulas is 0.
    **Validity:** the range of the fit, and pressures at which the liquid does not thicken.
    **Reference:** equation 101 of the DIPPR tables, $\ln\mu = A + B/T + C\ln T$, about a reference point.
    """

    reference_viscosity: Scalar = bounded("> 0", unit="Pa s")
    reference_temperature: Scalar = bounded("> 0", unit="K")
    temperature_viscosity: Scalar = bounded("finite", unit="K", difference=True)
    temperature_exponent: Scalar = bounded("finite", unit="1")

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        temperature = jnp.asarray(temperature, dtype=float)
        inverse = 1.0 / temperature - 1.0 / self.reference_temperature
        log_ratio = jnp.log(temperature) - jnp.log(self.reference_temperature)
        exponent = self.temperature_viscosity * inverse + self.temperature_exponent * log_ratio
        shape = jnp.broadcast_shapes(jnp.shape(pressure), temperature.shape)
        return jnp.broadcast_to(capped(jnp.log(self.reference_viscosity) + exponent), shape)


IsoviscousLiquid.__init__.__doc__ = """**Arguments:**
- `reference_viscosity`: mu_0, Pa s, > 0.
- `reference_temperature`: T_0, K, > 0.
- `temperature_viscosity`: b, K.
- `temperature_exponent`: c, a number.
"""

ISOVISCOUS = (ConstantViscosity, IsoviscousLiquid)
"""Laws whose viscosity does not depend on pressure."""


class Barus(AbstractViscosity):
    r"""Barus' law of pressure with Gupta's dependence on temperature.

    $\mu = \mu_0\exp[\alpha p + \beta(1/T - 1/T_0)]$.

    **Limits:** $\mu_0$ at p = 0, T = T_0; the coefficient of film formulas is $\alpha$ at every temperature.
    **Validity:** a baseline. Above about 0.5 GPa it overestimates the viscosity by orders of magnitude; it is capped
    smoothly at 1e15 Pa s (ln(viscosity) exact to 5e-13 below 1e9 Pa s). Pressures below 0 level off at -1 MPa.
    **Reference:** Barus (1893), Am. J. Sci. 45, 87; source eqs. (73)-(74).
    """

    reference_viscosity: Scalar = bounded("> 0", unit="Pa s")
    reference_temperature: Scalar = bounded("> 0", unit="K")
    pressure_viscosity: Scalar = bounded(">= 0", unit="1/Pa")
    temperature_viscosity: Scalar = bounded(">= 0", unit="K", difference=True)

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        inverse = 1.0 / jnp.asarray(temperature, dtype=float) - 1.0 / self.reference_temperature
        exponent = self.pressure_viscosity * nonnegative_pressure(pressure) + self.temperature_viscosity * inverse
        return capped(jnp.log(self.reference_viscosity) + exponent)


Barus.__init__.__doc__ = """**Arguments:**
- `reference_viscosity`: mu_0, Pa s, > 0.
- `reference_temperature`: T_0, K, > 0.
- `pressure_viscosity`: alpha, 1/Pa, >= 0.
- `temperature_viscosity`: beta, K, >= 0; 0 is a viscosity that does not depend on temperature.
"""


class Roelands(AbstractViscosity):
    r"""Roelands' law.

    $\ln\mu = \ln\mu_0 + (\ln\mu_0 + 9.67)\{(1 + 5.1\times10^{-9}p)^Z[(T - 138)/(T_0 - 138)]^{-S_0} - 1\}$.

    **Limits:** $\mu_0$ at p = 0, T = T_0; there the slopes are $d\ln\mu/dp = 5.1\times10^{-9} Z(\ln\mu_0 + 9.67)$ and
    $d\ln\mu/dT = -S_0(\ln\mu_0 + 9.67)/(T_0 - 138)$.
    **Validity:** measured below about 0.5 GPa and fair to 1 GPa; above, too stiff. T is clamped smoothly 1 K above the
    pole at 138 K (exact to 1e-12 K above 167 K), the viscosity at 1e15 Pa s (ln(viscosity) exact to 5e-13 below
    1e9 Pa s). Pressures below 0 level off at -1 MPa.
    **Reference:** Roelands (1966), thesis, TU Delft; source eq. (75), garbled there.
    """

    reference_viscosity: Scalar = bounded("> 0.0632 mPa s (Roelands' smallest viscosity)", unit="Pa s")
    reference_temperature: Scalar = bounded("> 138 K (the pole of Roelands' law)", unit="K")
    pressure_exponent: Scalar = bounded("> 0", unit="1")
    temperature_exponent: Scalar = bounded(">= 0", unit="1")

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        log_reference = jnp.log(self.reference_viscosity)
        above_pole = softplus_floor(temperature, ROELANDS_POLE + ROELANDS_MARGIN, ROELANDS_WIDTH) - ROELANDS_POLE
        log_ratio = jnp.log(above_pole) - jnp.log(self.reference_temperature - ROELANDS_POLE)
        exponent = self.pressure_exponent * log_compression(pressure) - self.temperature_exponent * log_ratio
        # expm1: exp(...) - 1 cancels near p = 0, T = T_0
        return capped(log_reference + (log_reference - LOG_ROELANDS_VISCOSITY) * jnp.expm1(exponent))


Roelands.__init__.__doc__ = """**Arguments:**
- `reference_viscosity`: mu_0, Pa s, > 6.3e-5.
- `reference_temperature`: T_0, K, > 138.
- `pressure_exponent`: Z, a number > 0, about 0.4 to 0.8.
- `temperature_exponent`: S_0, >= 0, about 1 to 1.5.
"""


def log_compression(pressure: Values) -> Batch:
    """Term ln(1 + 5.1e-9 p) of Roelands' law; p below 0 levels off at -1 MPa. **Arguments:** `pressure`, Pa."""
    return jnp.log1p(ROELANDS_RATE * nonnegative_pressure(pressure))
