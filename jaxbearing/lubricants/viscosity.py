"""Viscosity as a function of pressure and temperature."""

import abc
import math
from typing import ClassVar

import jax
import jax.numpy as jnp
import numpy as np

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import Checked, bounded
from ..numerics.safe import nonnegative_pressure, softplus, softplus_floor

LN10 = math.log(10.0)

LOG10_VISCOSITY_CAP = 15.0
"""Upper limit of log10(viscosity in Pa s) for all laws. Traction depends on 1/viscosity only: caps of 1e8 to 1e15 Pa s
give the same traction in all printed digits."""
EXPANSION_FLOOR = 0.02
"""Smallest free-volume expansion factor F (dimensionless)."""
EXPANSION_WIDTH = 0.005
"""Smoothing width of that floor (dimensionless)."""
CAP_WIDTH = 0.5
"""Smoothing width, in ln(viscosity), of the cap for laws without a pole: below 1e9 Pa s ln(viscosity) is exact to
5e-13, at the cap it is 0.35 too low."""
POLE_WIDTH = 0.5
"""Smoothing width of the distance from the pole, K: 9 K away the distance is changed by < 1e-8 K."""

LIMIT_FOLDS = 200.0
"""Pressure limit of a law that rises at all pressures, in units of its pressure scale."""
SLOPE_STEP = 1e6
"""Pressure step, Pa, from which the initial slope of ln(viscosity) is computed for the pressure scale."""
SMALLEST_SLOPE = 1e-12
"""Smallest slope d ln(viscosity)/dp for the pressure scale, 1/Pa: a thousandth of that of any lubricant."""

LIMIT_SCAN_END = 1e10
"""Highest pressure that `ModifiedWLF.pressure_limit` considers, Pa."""
LIMIT_SCAN_INTERVALS = 300
LIMIT_SCAN_DECADES = 18.0
"""Rise of the viscosity above ambient, in decades, at which that scan stops. An integral of 1/viscosity has converged
far below it."""


class AbstractViscosity(Checked):
    """Low-shear viscosity of a lubricant. A law implements `log_viscosity`; everything else follows."""

    part: ClassVar[str] = "oil.viscosity"

    @abc.abstractmethod
    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        """Natural logarithm of the dynamic viscosity in Pa s.

        **Arguments:** `pressure`, Pa, >= 0 (slightly negative ones too must give a finite result); `temperature`, K,
        > 0.
        """

    def viscosity(self, pressure: Values, temperature: Values) -> Batch:
        """Dynamic viscosity, Pa s. For contact pressures use `log_viscosity` instead."""
        return jnp.exp(self.log_viscosity(pressure, temperature))

    def log_slope(self, temperature: Values) -> Batch:
        r"""Slope $\partial\ln\mu/\partial T$ at ambient pressure, 1/K: negative for liquids, 0 for a constant law."""
        require_temperature(temperature)
        temperature = jnp.asarray(temperature, dtype=float)
        at_ambient = lambda t: self.log_viscosity(0.0, t)
        return jax.jvp(at_ambient, (temperature,), (jnp.ones_like(temperature),))[1]

    def pressure_scale(self, temperature: Values) -> Batch:
        """Pressure over which the viscosity initially grows by a factor e, Pa, at most 1e12 Pa; no gradient."""
        temperature = jnp.asarray(temperature, dtype=float)
        rise = self.log_viscosity(SLOPE_STEP, temperature) - self.log_viscosity(0.0, temperature)
        return jax.lax.stop_gradient(1.0 / jnp.maximum(rise / SLOPE_STEP, SMALLEST_SLOPE))

    def pressure_limit(self, temperature: Values) -> Batch:
        r"""Upper limit of $\int \mu(0)/\mu(p)\,dp$, Pa; no gradient. By default 200 pressure scales.

        The default limit is 10 GPa for 20 1/GPa. The part of the integral beyond it is $e^{-200}$ for Barus' law and
        < 1e-6 for Roelands' law (viscosity above 1 mPa s, Z > 0.4); the cap of the viscosity adds $200\,\mu(0)$/1e15
        Pa s. A law whose viscosity falls again above some pressure must override this method and return that pressure.
        """
        return LIMIT_FOLDS * self.pressure_scale(temperature)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes for the user on the origin of the law's numbers."""
        return ()


def capped(log_viscosity: Values) -> Batch:
    r"""Smooth min(x, ln(1e15)) for x = ln(viscosity in Pa s): $x - w\ln(1 + e^{(x - x_{cap})/w})$ with w = 0.5."""
    excess = (log_viscosity - LN10 * LOG10_VISCOSITY_CAP) / CAP_WIDTH
    return jnp.asarray(log_viscosity - CAP_WIDTH * softplus(excess))


class ModifiedWLF(AbstractViscosity):
    r"""The modified Williams-Landel-Ferry law of Yasutomi, Bair and Winer.

    $T_g(p) = T_{g0} + A_1\ln(1 + A_2 p)$, $F(p) = 1 - B_1\ln(1 + B_2 p)$, $y = (T - T_g) F$,
    $\log_{10}\mu = \log_{10}\mu_g - C_1 y/(C_2 + y)$.

    Coded as $(\log_{10}\mu_g - C_1) + C_1 C_2/(C_2 + y)$, which has one division and makes the pole explicit.

    **Limits:** $\mu_g$ at $T = T_g(p)$; finite, and with a finite gradient, at every pressure and temperature.
    **Validity:** the printed law has a pole at $y = -C_2$ (cold, high pressure), and its viscosity falls again beyond
    F = 0 (3.6 to 9.4 GPa for four oils). Here F is floored smoothly at 0.02, and the distance from the pole such that
    $\log_{10}\mu < 15$. The floors change the law by < 1e-8 relative wherever $C_2 + y$ is 9 K above its floor. Near
    the floors the value stands for a stiff solid and is not measured. Pressures below 0 level off at -1 MPa.
    **Reference:** Yasutomi, Bair and Winer (1984), ASME J. Tribology 106, 291; source eq. (76).
    """

    glass_viscosity: Scalar = bounded("> 0", unit="Pa s")
    glass_temperature: Scalar = bounded("> 0", unit="K")
    glass_shift: Scalar = bounded("> 0", unit="K", difference=True)
    glass_shift_rate: Scalar = bounded("> 0", unit="1/Pa")
    expansion_factor: Scalar = bounded("> 0", unit="1")
    expansion_rate: Scalar = bounded("> 0", unit="1/Pa")
    c1: Scalar = bounded("> 0", unit="1")
    c2: Scalar = bounded("> 0", unit="K", difference=True)

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        log10_glass = jnp.log10(self.glass_viscosity)
        glass, expansion = self._glass_and_expansion(nonnegative_pressure(pressure))
        expansion = softplus_floor(expansion, EXPANSION_FLOOR, EXPANSION_WIDTH)
        # at this distance log10(viscosity) equals the cap
        floor = self.c1 * self.c2 / (LOG10_VISCOSITY_CAP - log10_glass + self.c1)
        distance = softplus_floor(self.c2 + (temperature - glass) * expansion, floor, POLE_WIDTH)
        return LN10 * (log10_glass - self.c1 + self.c1 * self.c2 / distance)

    def pressure_limit(self, temperature: Values) -> Batch:
        """Pressure up to which the printed law is meaningful at this temperature, Pa; no gradient.

        The last of 301 points from 0 to 10 GPa before the law without floors stops growing, reaches F = 0 or its
        pole, or has risen by 18 decades; at least 33 MPa, the first point above 0.
        """
        temperature = jnp.asarray(temperature, dtype=float)[..., None]
        grid = np.linspace(0.0, LIMIT_SCAN_END, LIMIT_SCAN_INTERVALS + 1)
        pressure = jnp.asarray(grid.reshape((1,) * (temperature.ndim - 1) + (-1,)))
        glass, expansion = self._glass_and_expansion(pressure)
        distance = self.c2 + (temperature - glass) * expansion
        log10_rise = self.c1 * self.c2 / jnp.where(distance > 0, distance, 1.0)
        good = (expansion > 0) & (distance > 0) & (log10_rise - log10_rise[..., :1] <= LIMIT_SCAN_DECADES)
        good = good[..., 1:] & (jnp.diff(log10_rise, axis=-1) > 0)
        # good[i] is about point i + 1, so the first False sits at the index of the last good point.
        last = jnp.where(jnp.all(good, axis=-1), LIMIT_SCAN_INTERVALS, jnp.argmin(good, axis=-1))
        step = LIMIT_SCAN_END / LIMIT_SCAN_INTERVALS
        return jax.lax.stop_gradient(step * jnp.maximum(last, 1).astype(float))

    def _glass_and_expansion(self, pressure: Values) -> tuple[Batch, Batch]:
        """Glass temperature, K, and expansion factor F, as printed."""
        glass = self.glass_temperature + self.glass_shift * jnp.log1p(self.glass_shift_rate * pressure)
        expansion = 1.0 - self.expansion_factor * jnp.log1p(self.expansion_rate * pressure)
        return jnp.asarray(glass), jnp.asarray(expansion)


ModifiedWLF.__init__.__doc__ = """**Arguments:**
- `glass_viscosity`: viscosity at the glass transition, Pa s, > 0 and below 1e15.
- `glass_temperature`: Tg0 at ambient pressure, K.
- `glass_shift`: A1, K, > 0.
- `glass_shift_rate`: A2, 1/Pa, > 0.
- `expansion_factor`: B1, a number > 0.
- `expansion_rate`: B2, 1/Pa, > 0.
- `c1`: C1, a number, of the decimal logarithm (2.3 times smaller than that of a law written in ln), > 0.
- `c2`: C2, K, > 0.
"""
