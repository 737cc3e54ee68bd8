"""Heating of a film by its shear: temperatures of the film and of the surfaces of a contact."""

from typing import ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import softplus_floor

LARGEST_RISE = 500.0
"""Upper limit of the temperature rise of the film above the base temperature, K."""
COLDEST = -200.0
"""Lower end of the search for the temperature rise, K. It is negative because the film may cool a little where the oil
gives back elastic energy."""
LARGEST_FOLDS = 700.0
RISE_WIDTH = 15.0
"""Smoothing width of the limit `LARGEST_RISE`, K: a rise of 100 K changes by 4e-11 K."""


class FilmHeating(Checked):
    r"""Heating of the film by its shear. The heat is conducted across the film into two equal, moving surfaces.

    The heat source q is stress times shear rate. The temperature profile across the film is parabolic, and nothing is
    conducted along the film: the mean temperature is $T_m = T_s + q h^2/(12k)$, and the flux into each surface is
    $\varphi = 6k(T_m - T_s)/h$ (= qh/2 without convection). The surfaces have the temperature
    $T_s(x) = T_b + (\pi\rho_sc_sk_su)^{-1/2}\int_{-a}^x\varphi(\xi)(x-\xi)^{-1/2}d\xi$, with the base temperature
    $T_b$ and the mean speed u. With `film_heat_capacity` the film itself carries heat along:
    $\rho c u h\,dT_m/dx = qh - 12k(T_m - T_s)/h$.

    **Limits:** uniform q without convection: $T_s - T_b = qh\sqrt{(x+a)/(\pi\rho_sc_sk_su)}$.
    **Validity:** fast surfaces (Peclet number of the solids above about 5); half of the heat flows into each surface.
    Convection in the film matters if $\rho cuh^2/(12ka)$ exceeds about 0.05. The mean rise is limited smoothly to
    500 K (at 100 K this changes it by less than 1e-10 K).
    **Reference:** Carslaw and Jaeger, *Conduction of Heat in Solids*, ch. 10; Houpert (1985), ASME J. Tribology 107,
    241; source eqs. (71)-(72).

    **Arguments:**
    - `conductivity`: k of the oil, W/(m K); `None`: the conductivity of the lubricant at the base temperature.
    - `solid_density`, `solid_heat_capacity`, `solid_conductivity`: properties of the surfaces, kg/m^3, J/(kg K),
      W/(m K); default: bearing steel.
    - `film_heat_capacity`: rho c of the oil, J/(m^3 K); `None`: no convection in the film.
    """

    part: ClassVar[str] = "contact.heating"

    conductivity: Scalar | None = bounded("> 0", default=None)
    solid_density: Scalar = bounded("> 0", converter=as_float, default=7800.0)
    solid_heat_capacity: Scalar = bounded("> 0", converter=as_float, default=460.0)
    solid_conductivity: Scalar = bounded("> 0", converter=as_float, default=46.0)
    film_heat_capacity: Scalar | None = bounded(">= 0", default=None)

    def peclet_number(self, half_width: Values, film: Values, speed: Values, conductivity: Values) -> Array:
        """Peclet number of the film: heat carried along it over heat conducted across it, rho c u h^2/(12 k a)."""
        if self.film_heat_capacity is None:
            raise ValueError("film_heat_capacity: found None, expected the oil's density times heat capacity")
        return jnp.asarray(self.film_heat_capacity * speed * film**2 / (12.0 * conductivity * half_width))


class HeatStep(NamedTuple):
    """Mean temperature rise of the film in one cell above the base temperature, K: `base + slope * q` with the heat
    source q in the cell, W/m^3."""

    base: Float[Array, "..."]
    slope: Float[Array, "..."]


class HeatFlow:
    """Linear relations between heat source and temperature rises in the cells of a strip, from inlet to exit.

    Lengths along the strip are in units of its half-width.

    - `widths`: widths of the cells.
    - `history`, `own`: integrals of (x - xi)^(-1/2) over xi for the middle x of a cell, over each cell before it and
      over its own first half.
    - `surface_rise`: factor of these integrals in the rise of the surface, a^(1/2)/(pi rho_s c_s k_s u)^(1/2), m^2 K/W.
    - `conductance`: 6 k/h, W/(m^2 K); `film_resistance`: h^2/(12 k), m^3 K/W.
    - `length`: distance over which the film temperature adapts to heat source and surfaces; `None`: no convection.
    """

    def __init__(
        self, heating: FilmHeating, steps: int, half_width: Array, film: Array, speed: Array, conductivity: Array
    ):
        edges = -np.cos(np.arange(steps + 1) * np.pi / steps)
        middle = -np.cos((np.arange(steps) + 0.5) * np.pi / steps)
        reach = np.sqrt(np.maximum(middle[:, None] - edges[None, :], 0.0))
        self.history = np.where(np.arange(steps)[None, :] < np.arange(steps)[:, None], 1.0, 0.0) * (
            2.0 * (reach[:, :-1] - reach[:, 1:])
        )
        self.own = 2.0 * np.sqrt(middle - edges[:-1])
        self.widths = np.diff(edges)
        effusivity = heating.solid_density * heating.solid_heat_capacity * heating.solid_conductivity
        self.surface_rise = jnp.sqrt(half_width / (jnp.pi * effusivity * speed))
        self.conductance = 6.0 * conductivity / film
        self.film_resistance = jnp.square(film) / (12.0 * conductivity)
        self.length = None
        if heating.film_heat_capacity is not None:
            self.length = heating.peclet_number(half_width, film, speed, conductivity)

    def step(self, own: Values, width: Values, surface: Values, entering: Values) -> HeatStep:
        """Temperature rise of the film in a cell.

        **Arguments:** `own`, `width`: those of the cell; `surface`: rise of the surface there caused by the cells
        before, K; `entering`: rise of the film that enters the cell, K.
        """
        decay = self._decay(width)
        ratio = self.conductance * self.surface_rise * own
        divisor = 1.0 + decay * ratio
        base = ((1.0 - decay) * surface + (1.0 + ratio) * decay * entering) / divisor
        return HeatStep(base, (1.0 + ratio) * (1.0 - decay) * self.film_resistance / divisor)

    def surface(self, own: Values, before: Values, film_rise: Values) -> tuple[Array, Array]:
        """Temperature rise of the surface in a cell, K, and heat flux into it, W/m^2.

        **Arguments:** `own`: that of the cell; `before`: rise of the surface caused by the cells before, K;
        `film_rise`: mean rise of the film in the cell, K.
        """
        ratio = self.conductance * self.surface_rise * own
        rise = (before + ratio * film_rise) / (1.0 + ratio)
        return rise, self.conductance * (film_rise - rise)

    def leaving(self, width: Values, entering: Values, film_rise: Values) -> Array:
        """Temperature rise of the film at the end of a cell, K.

        **Arguments:** `width`: that of the cell; `entering`: rise at its beginning, K; `film_rise`: mean rise in it, K.
        """
        if self.length is None:
            return jnp.asarray(film_rise)
        decay = self._decay(width)
        settled = (film_rise - decay * entering) / (1.0 - decay)
        return settled + (entering - settled) * jnp.exp(-self._folds(width))

    def _folds(self, width: Values) -> Array:
        """Cell width over `length`, limited to 700: exp(-700) is negligible and does not underflow."""
        assert self.length is not None
        short = self.length < width / LARGEST_FOLDS
        return jnp.where(short, LARGEST_FOLDS, width / jnp.where(short, width, self.length))

    def _decay(self, width: Values) -> Array:
        """Mean over the cell of exp(-x/length)."""
        if self.length is None:
            return jnp.zeros(())
        return -jnp.expm1(-self._folds(width)) * self.length / width


def limited_rise(rise: Values) -> Float[Array, "..."]:
    """A smooth minimum of a rise of temperature, K, and 500 K."""
    return -softplus_floor(-rise, -LARGEST_RISE, RISE_WIDTH)
