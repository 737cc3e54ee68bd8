"""Heat of the sheared film in a contact: temperature across the film and of the surfaces."""

from typing import ClassVar, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float
from ..numerics.safe import softplus_floor

LARGEST_RISE = 500.0
"""Rise of the film above the base temperature that is never exceeded, K."""
COLDEST = -200.0
"""Lower end of the search for the rise, K: elastic energy given back may cool the film a little."""
LARGEST_FOLDS = 700.0
RISE_WIDTH = 15.0
"""Smoothing width of that limit, K: a rise of 100 K is changed by 4e-11 K."""


class FilmHeating(Checked):
    r"""Heat of shear, led across the film into two equal surfaces that carry it away.

    Source q = stress times shear rate, parabolic temperature profile, no conduction along the film:
    $T_m = T_s + q h^2/(12k)$ (mean over the film), flux into each surface $\varphi = 6k(T_m - T_s)/h$ (= qh/2 without
    convection), $T_s(x) = T_b + (\pi\rho_sc_sk_su)^{-1/2}\int_{-a}^x\varphi(\xi)(x-\xi)^{-1/2}d\xi$; with
    `film_heat_capacity` the film itself carries heat along, $\rho c u h\,dT_m/dx = qh - 12k(T_m - T_s)/h$.

    **Limits:** uniform q without convection: $T_s - T_b = qh\sqrt{(x+a)/(\pi\rho_sc_sk_su)}$.
    **Validity:** surfaces moving fast (Peclet number of the solids above about 5); half of the heat into each.
    Convection in the film matters where $\rho cuh^2/(12ka)$ exceeds about 0.05. The mean rise is limited smoothly to
    500 K (changed by < 1e-10 K at 100 K).
    **Reference:** Carslaw and Jaeger, *Conduction of Heat in Solids*, ch. 10; Houpert (1985), ASME J. Tribology 107,
    241; source eqs. (71)-(72).

    **Arguments:**
    - `conductivity`: k of the oil, W/(m K); None: the oil's own at the base temperature.
    - `solid_density`, `solid_heat_capacity`, `solid_conductivity`: of the surfaces, kg/m^3, J/(kg K), W/(m K);
      default: bearing steel.
    - `film_heat_capacity`: rho c of the oil, J/(m^3 K); None: no convection in the film.
    """

    part: ClassVar[str] = "contact.heating"

    conductivity: Scalar | None = bounded("> 0", default=None)
    solid_density: Scalar = bounded("> 0", converter=as_float, default=7800.0)
    solid_heat_capacity: Scalar = bounded("> 0", converter=as_float, default=460.0)
    solid_conductivity: Scalar = bounded("> 0", converter=as_float, default=46.0)
    film_heat_capacity: Scalar | None = bounded(">= 0", default=None)

    def peclet_number(self, half_width: Values, film: Values, speed: Values, conductivity: Values) -> Array:
        """rho c u h^2/(12 k a): heat carried along by the film over heat led across it."""
        if self.film_heat_capacity is None:
            raise ValueError("film_heat_capacity: found None, expected the oil's density times heat capacity")
        return jnp.asarray(self.film_heat_capacity * speed * film**2 / (12.0 * conductivity * half_width))


class HeatStep(NamedTuple):
    """Mean rise of the film in one cell as `base + slope * q`, q the heat source there, W/m^3; K above the base."""

    base: Float[Array, "..."]
    slope: Float[Array, "..."]


class HeatFlow:
    """The linear relations between heat source and temperature on the mesh of a march.

    All lengths in units of the strip's half-width: `film_resistance` = h^2/(12 k), `surface_rise` = rise of the
    surface per flux that enters over one half-width, `length` = distance in which the film takes its temperature.
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
        """Rise of the film in a cell.

        **Arguments:** `own`, `width`: of the cell; `surface`: rise of the surface there by the cells before;
        `entering`: rise of the film that enters.
        """
        decay = self._decay(width)
        ratio = self.conductance * self.surface_rise * own
        divisor = 1.0 + decay * ratio
        base = ((1.0 - decay) * surface + (1.0 + ratio) * decay * entering) / divisor
        return HeatStep(base, (1.0 + ratio) * (1.0 - decay) * self.film_resistance / divisor)

    def surface(self, own: Values, before: Values, film_rise: Values) -> tuple[Array, Array]:
        """Rise of the surface in the cell and flux into it, W/m^2."""
        ratio = self.conductance * self.surface_rise * own
        rise = (before + ratio * film_rise) / (1.0 + ratio)
        return rise, self.conductance * (film_rise - rise)

    def leaving(self, width: Values, entering: Values, film_rise: Values) -> Array:
        """Rise of the film at the end of the cell, from that at its beginning and its mean."""
        if self.length is None:
            return jnp.asarray(film_rise)
        decay = self._decay(width)
        settled = (film_rise - decay * entering) / (1.0 - decay)
        return settled + (entering - settled) * jnp.exp(-self._folds(width))

    def _folds(self, width: Values) -> Array:
        """width/length, at most 700: there the film has long taken its temperature."""
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
