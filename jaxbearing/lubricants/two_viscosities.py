"""A viscosity law from a data sheet: two kinematic viscosities and a density."""

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.arguments import require_numbers, require_temperature
from ..numerics.checks import bounded, demand, numbers_or_none
from ..numerics.safe import softplus_floor
from .simple_viscosity import LOG_ROELANDS_VISCOSITY, ROELANDS_RATE, log_compression
from .thermal import LinearDensity
from .viscosity import AbstractViscosity, capped

CENTISTOKES = 1e-6
"""Kinematic viscosity of 1 cSt, m^2/s."""
WALTHER_SHIFT = 0.7
"""Number that ASTM D341 adds to the viscosity in cSt."""
DENSITY_FLOOR = 0.5
"""Smallest density in units of its reference value: a linear density falls below any bound far outside its range."""
DENSITY_WIDTH = 0.01
"""Smoothing width of that floor, in the same unit: at 0.7 of the reference value the density is exact to 2e-11."""

ESTIMATE_NOTE = (
    "alpha of the oil, the growth of its viscosity with pressure, is estimated from its viscosity (Wooster): +-30 % "
    "for mineral oils, up to 70 % too large for synthetic ones"
)
"""Note of an oil whose alpha is estimated."""


def wooster_pressure_viscosity(viscosity: Values) -> Batch:
    r"""Estimate for mineral oils: $\alpha = (0.6 + 0.965\log_{10}(\mu/\text{mPa s}))\times10^{-8}$ 1/Pa.

    **Validity:** within 31 % of the coefficients measured on 13 mineral oils at 30, 60 and 100 C (2.4 mPa s to 2 Pa s;
    tests/published/lubricants.toml), mostly below them. For synthetic oils it is too large: with it, the film
    coefficient of `WaltherRoelands` is 18 to 65 % too large for the four oils of the source at 40 and 100 C.
    **Reference:** Wooster's formula, as textbooks give it (Stachowiak and Batchelor, Engineering Tribology, ch. 2).

    **Arguments:** `viscosity`, at ambient pressure, Pa s, > 2.4e-4.
    """
    require_numbers("> 0", viscosity=viscosity)
    return jnp.asarray(1e-8 * (0.6 + 0.965 * jnp.log10(jnp.multiply(viscosity, 1e3))))


class WaltherRoelands(AbstractViscosity):
    r"""An oil known by two kinematic viscosities and its density.

    Temperature by Walther's straight line, $\log_{10}\log_{10}(\nu/\text{cSt} + 0.7) = A - B\log_{10}T$ through the two
    points, $\mu(T) = \rho(T)\,\nu(T)$; pressure by Roelands' factor,
    $\ln\mu(p,T) = \ln\mu(T) + (\ln\mu(T) + 9.67)[(1 + 5.1\times10^{-9}p)^Z - 1]$, with Z such that
    $\partial\ln\mu/\partial p = \alpha$ at p = 0, $T = T_1$. If $\alpha$ is not given, it is estimated from
    $\mu(T_1)$ by `wooster_pressure_viscosity`, and `notes` says so.

    **Limits:** $\rho\nu_1$, $\rho\nu_2$ at p = 0 and $T_1$, $T_2$; $\alpha$ as above.
    **Validity:** between the two temperatures and some 20 K around; towards the pour point real oils are thicker.
    ASTM D341 adds a term below 2 cSt, left out here: the viscosity comes out too low by 0.04 % at 2 cSt, 2 % at 1 cSt,
    and never below 0.3 cSt. Pressure as for `Roelands`, with the same smooth cap at 1e15 Pa s. The density is floored
    smoothly at half its reference value (exact to 2e-11 above 0.7 of it).
    **Reference:** ASTM D341; Walther (1931), Erdoel und Teer 7, 382; Roelands (1966), thesis, TU Delft.
    """

    viscosity_1: Scalar = bounded("> 0.3 cSt (0.3e-6 m^2/s)", unit="m^2/s")
    temperature_1: Scalar = bounded("> 0", unit="K")
    viscosity_2: Scalar = bounded("> 0.3 cSt (0.3e-6 m^2/s)", unit="m^2/s")
    temperature_2: Scalar = bounded("> 0", unit="K")
    density: LinearDensity  # pyright: ignore[reportGeneralTypeIssues]  (the fields before it have no default either)
    pressure_viscosity: Scalar | None = bounded("> 0", unit="1/Pa", default=None)

    def __check_init__(self):
        super().__check_init__()
        require_falling(self.viscosity_1, self.temperature_1, self.viscosity_2, self.temperature_2)

    def log_viscosity(self, pressure: Values, temperature: Values) -> Batch:
        require_temperature(temperature)
        log_ambient = self._log_ambient(jnp.asarray(temperature, dtype=float))
        slope_1 = ROELANDS_RATE * (self._log_ambient(jnp.asarray(self.temperature_1)) - LOG_ROELANDS_VISCOSITY)
        growth = jnp.expm1(self.coefficient_1() / slope_1 * log_compression(pressure))
        return capped(log_ambient + (log_ambient - LOG_ROELANDS_VISCOSITY) * growth)

    def coefficient_1(self) -> Batch:
        """The given or estimated slope d ln(viscosity)/dp at ambient pressure and `temperature_1`, 1/Pa."""
        if self.pressure_viscosity is not None:
            return jnp.asarray(self.pressure_viscosity)
        return wooster_pressure_viscosity(jnp.exp(self._log_ambient(jnp.asarray(self.temperature_1))))

    @property
    def notes(self) -> tuple[str, ...]:
        return (ESTIMATE_NOTE,) if self.pressure_viscosity is None else ()

    def _log_ambient(self, temperature: Batch) -> Batch:
        """Natural logarithm of the dynamic viscosity in Pa s at ambient pressure."""
        points = (self.viscosity_1, self.temperature_1, self.viscosity_2, self.temperature_2)
        return log_dynamic(log_kinematic(*points, temperature), self.density, temperature)


WaltherRoelands.__init__.__doc__ = """**Arguments:**
- `viscosity_1`: kinematic viscosity at `temperature_1`, m^2/s, > 0.3e-6 (1 cSt = 1e-6 m^2/s).
- `temperature_1`: K, > 0; usually 40 C.
- `viscosity_2`: kinematic viscosity at `temperature_2`, m^2/s, > 0.3e-6.
- `temperature_2`: K, > 0, another one; usually 100 C.
- `density`: of the oil at ambient pressure.
- `pressure_viscosity`: alpha at `temperature_1`, 1/Pa, > 0, or None: estimated from the viscosity there.
"""


def require_falling(viscosity_1: Scalar, temperature_1: Scalar, viscosity_2: Scalar, temperature_2: Scalar) -> None:
    """Checks that the viscosity of an oil falls with temperature between its two points.

    **Arguments:** as `log_kinematic`.

    **Raises:** `ValueError` if the numbers are known and the viscosity does not fall.
    """
    points = numbers_or_none(viscosity_1, viscosity_2, temperature_1, temperature_2)
    if points is not None:
        demand(
            "oil.viscosity must fall with the temperature between its two points",
            (points[0] - points[1]) * (points[3] - points[2]) > 0,
            lambda: (
                f"oil.viscosity: {float(points[0]):g} m^2/s at {float(points[2]):g} K and {float(points[1]):g} "
                f"m^2/s at {float(points[3]):g} K; the viscosity must fall with the temperature"
            ),
        )


def log_kinematic(
    viscosity_1: Scalar, temperature_1: Scalar, viscosity_2: Scalar, temperature_2: Scalar, temperature: Values
) -> Batch:
    """Natural logarithm of the kinematic viscosity in cSt, on Walther's line through two points.

    **Arguments:** `viscosity_1`, `viscosity_2`, m^2/s, > 0.3e-6, at `temperature_1`, `temperature_2`, K;
    `temperature`, K, > 0.
    """
    # log10 log10 and ln ln differ by a constant, so the line through two points is the same
    first, second = (jnp.log(jnp.log(jnp.divide(nu, CENTISTOKES) + WALTHER_SHIFT)) for nu in (viscosity_1, viscosity_2))
    log_1, log_2 = jnp.log(temperature_1), jnp.log(temperature_2)
    log_sum = jnp.exp(first + (second - first) * ((jnp.log(temperature) - log_1) / (log_2 - log_1)))
    # ln(e^s - 0.7) for s > 0, with no overflow in the cold
    return log_sum + jnp.log1p(-WALTHER_SHIFT * jnp.exp(-log_sum))


def log_dynamic(log_kinematic: Batch, density: LinearDensity, temperature: Values) -> Batch:
    """Natural logarithm of the dynamic viscosity in Pa s; the density is floored smoothly at half its reference value.

    **Arguments:** `log_kinematic`: natural logarithm of the kinematic viscosity in cSt; `density`: law of the density;
    `temperature`, K.
    """
    relative_density = density.density(temperature) / density.value
    relative_density = softplus_floor(relative_density, DENSITY_FLOOR, DENSITY_WIDTH)
    return log_kinematic + jnp.log(CENTISTOKES * density.value) + jnp.log(relative_density)
