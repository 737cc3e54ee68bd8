"""Viscosity of a standard oil, given by grade and base stock; its pressure-viscosity coefficient follows from it."""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_temperature
from ..numerics.checks import bounded
from ..numerics.safe import softplus_floor
from .simple_viscosity import LOG_ROELANDS_VISCOSITY, ROELANDS_RATE, log_compression
from .thermal import LinearDensity
from .two_viscosities import log_dynamic, log_kinematic, require_falling
from .viscosity import AbstractViscosity, capped

COEFFICIENT_PRESSURE = 0.2e9
"""Pressure, Pa, up to which the coefficient is the mean slope of ln(viscosity)."""
LARGEST_LOG_VISCOSITY = 16.0
"""Natural logarithm of the viscosity in cSt above which the coefficient is constant (8.9e6 cSt)."""
LARGEST_WIDTH = 0.1
"""Smoothing width of that bound, in ln(viscosity): below 4e5 cSt the coefficient is exact to 1e-13."""


class WaltherPower(AbstractViscosity):
    r"""An oil on Walther's line whose pressure-viscosity coefficient is a power of its viscosity.

    Temperature as for `WaltherRoelands`: $\log_{10}\log_{10}(\nu/\text{cSt} + 0.7)$ is linear in $\log_{10}T$,
    $\mu(T) = \rho(T)\,\nu(T)$. Pressure by Roelands' factor,
    $\ln\mu(p,T) = \ln\mu(T) + (\ln\mu(T) + 9.67)[(1 + 5.1\times10^{-9}p)^{Z(T)} - 1]$, with Z(T) such that
    $\ln[\mu(p_s,T)/\mu(T)] = \alpha(T)\,p_s$ at $p_s$ = 0.2 GPa, where $\alpha(T) = s\,(\nu(T)/\text{cSt})^t$.

    **Limits:** $\rho\nu_1$, $\rho\nu_2$ at p = 0 and $T_1$, $T_2$; $\alpha$ as the mean slope of $\ln\mu$ up to 0.2
    GPa. The coefficient of film formulas, by integral, is 0.96 to 1.09 of $\alpha$ at 40 and 100 C for the oils of the
    grade table.
    **Validity:** temperature and density as for `WaltherRoelands`; pressure as for `Roelands`. In the cold,
    above 8.9e6 cSt, $\alpha$ stays constant (with a smooth transition). The source of s and t does not say to which
    pressure $\alpha$ belongs: 0.2 GPa is assumed.
    **Reference:** ASTM D341; Roelands (1966), thesis, TU Delft; the power law of the library GEARpie (2022).
    """

    viscosity_1: Scalar = bounded("> 0.3 cSt (0.3e-6 m^2/s)", unit="m^2/s")
    temperature_1: Scalar = bounded("> 0", unit="K")
    viscosity_2: Scalar = bounded("> 0.3 cSt (0.3e-6 m^2/s)", unit="m^2/s")
    temperature_2: Scalar = bounded("> 0", unit="K")
    pressure_coefficient: Scalar = bounded("> 0", unit="1/Pa")
    pressure_exponent: Scalar = bounded(">= 0", unit="1")
    density: LinearDensity  # pyright: ignore[reportGeneralTypeIssues]  (the fields before it have no default either)

    def __check_init__(self):
        super().__check_init__()
        require_falling(self.viscosity_1, self.temperature_1, self.viscosity_2, self.temperature_2)

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        temperature = jnp.asarray(temperature, dtype=float)
        log_nu = self._log_kinematic(temperature)
        log_ambient = log_dynamic(log_nu, self.density, temperature)
        span = log_ambient - LOG_ROELANDS_VISCOSITY
        rise = COEFFICIENT_PRESSURE * self._coefficient(log_nu)
        exponent = jnp.log1p(rise / span) / jnp.log1p(ROELANDS_RATE * COEFFICIENT_PRESSURE)
        return capped(log_ambient + span * jnp.expm1(exponent * log_compression(pressure)))

    def coefficient(self, temperature: Values) -> Batch:
        """Mean slope alpha(T) of ln(viscosity) up to 0.2 GPa, 1/Pa. **Arguments:** `temperature`, K, > 0."""
        require_temperature(temperature)
        return self._coefficient(self._log_kinematic(jnp.asarray(temperature, dtype=float)))

    def _log_kinematic(self, temperature: Batch) -> Batch:
        points = (self.viscosity_1, self.temperature_1, self.viscosity_2, self.temperature_2)
        return log_kinematic(*points, temperature)

    def _coefficient(self, log_nu: Batch) -> Batch:
        bounded_log = -softplus_floor(-log_nu, -LARGEST_LOG_VISCOSITY, LARGEST_WIDTH)
        return self.pressure_coefficient * jnp.exp(self.pressure_exponent * bounded_log)


WaltherPower.__init__.__doc__ = """**Arguments:**
- `viscosity_1`: kinematic viscosity at `temperature_1`, m^2/s, > 0.3e-6 (1 cSt = 1e-6 m^2/s).
- `temperature_1`: K, > 0; usually 40 C.
- `viscosity_2`: kinematic viscosity at `temperature_2`, m^2/s, > 0.3e-6.
- `temperature_2`: K, > 0, another one; usually 100 C.
- `pressure_coefficient`: s, the coefficient at 1 cSt, 1/Pa, > 0.
- `pressure_exponent`: t, a number >= 0, about 0.14.
- `density`: of the oil at ambient pressure.
"""
