"""Viscosity by Vogel's law in temperature and Dicke's modulus in pressure."""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import bounded
from ..numerics.safe import nonnegative_pressure, softplus_floor
from .viscosity import AbstractViscosity, capped

ICE_POINT = 273.15
"""Zero of the Celsius scale, K: Dicke's modulus is linear in the temperature in degrees Celsius."""
HUNDRED = 100.0
"""Difference of the two temperatures at which the modulus is given, 0 and 100 C, K."""
POLE_MARGIN = 20.0
"""Smallest distance, K, of the temperature from Vogel's pole; colder temperatures are clamped."""
POLE_WIDTH = 1.0
"""Smoothing width of that clamp, K: 50 K above the pole T is exact to 1e-13 K."""
MODULUS_FLOOR = 1e7
"""Smallest modulus at ambient pressure, Pa (100 1/GPa): a linear modulus crosses zero far below the fitted
temperatures."""
MODULUS_WIDTH = 5e5
"""Smoothing width of that floor, Pa: a modulus above 30 MPa is exact to 1e-13 of it."""
RATE_FLOOR = 1e-3
"""Smallest rise of the modulus with pressure, Pa/Pa: without it the viscosity could have a pole at high pressure."""
RATE_WIDTH = 1e-4
"""Smoothing width of that floor, Pa/Pa: a rise of 4.2e-3 is exact to 1e-14."""


class VogelDicke(AbstractViscosity):
    r"""Vogel's law in temperature, Dicke's in pressure.

    $\mu = K\exp\!\left[\dfrac{B}{T - T_V}\right]\exp\!\left[\dfrac{p}{a_1 + a_2\theta + (b_1 + b_2\theta)\,p}\right]$,
    $\theta = T - 273.15$ K.

    **Limits:** Vogel's law at p = 0; there $d\ln\mu/dp = 1/(a_1 + a_2\theta)$. As p grows $\ln\mu$ levels off, at
    $1/(b_1 + b_2\theta)$ above its ambient value.
    **Validity:** the range of the fit. T is clamped smoothly 20 K above $T_V$, the modulus $a_1 + a_2\theta$ at 10 MPa,
    its rise $b_1 + b_2\theta$ at 1e-3, the viscosity at 1e15 Pa s. For FVA 3 these bounds change nothing above 0 C.
    Pressures below 0 level off at -1 MPa.
    **Reference:** Vogel (1921), Phys. Z. 22, 645; Dicke's modulus equation as printed by Wingertszahn, Koch, Maccioni,
    Concli and Sauer (2023), Lubricants 11, 369.
    """

    viscosity_limit: Scalar = bounded("> 0", unit="Pa s")
    temperature_viscosity: Scalar = bounded("> 0", unit="K", difference=True)
    pole_temperature: Scalar = bounded("> 0", unit="K")
    modulus_cold: Scalar = bounded("> 0", unit="Pa")
    modulus_hot: Scalar = bounded("> 0", unit="Pa")
    rate_cold: Scalar = bounded("finite", unit="1")
    rate_hot: Scalar = bounded("finite", unit="1")

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        pressed = nonnegative_pressure(pressure)
        above_pole = softplus_floor(temperature, self.pole_temperature + POLE_MARGIN, POLE_WIDTH)
        log_ambient = jnp.log(self.viscosity_limit) + self.temperature_viscosity / (above_pole - self.pole_temperature)
        share = jnp.subtract(temperature, ICE_POINT) / HUNDRED
        modulus = self.modulus_cold + (self.modulus_hot - self.modulus_cold) * share
        modulus = softplus_floor(modulus, MODULUS_FLOOR, MODULUS_WIDTH)
        rate = softplus_floor(self.rate_cold + (self.rate_hot - self.rate_cold) * share, RATE_FLOOR, RATE_WIDTH)
        return capped(log_ambient + pressed / (modulus + rate * pressed))


VogelDicke.__init__.__doc__ = """**Arguments:**
- `viscosity_limit`: K, the viscosity at infinite temperature, Pa s, > 0.
- `temperature_viscosity`: B, K, > 0.
- `pole_temperature`: T_V, K, > 0; 273.15 K less the constant C of the law in degrees Celsius.
- `modulus_cold`: a_1, the modulus at 0 C, Pa, > 0.
- `modulus_hot`: a_1 + 100 K a_2, that at 100 C, Pa, > 0.
- `rate_cold`: b_1, the rise of the modulus with pressure at 0 C, a number.
- `rate_hot`: b_1 + 100 K b_2, that at 100 C, a number.
"""
