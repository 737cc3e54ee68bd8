"""One lubricated contact put together: film, inlet heating and traction from load and surface speeds."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..lubricants import InletOil, Lubricant
from ..numerics.precision import as_float
from ..numerics.safe import smooth_abs
from .film import AbstractLineFilm
from .line import LineContact
from .rolling import AbstractRollingResistance
from .thermal import AbstractThermalFactor, NoThermalReduction, inlet_temperature_rise
from .traction import AbstractTraction

SPEED_SMOOTHING = 5e-7
"""Smoothing of the mean surface speed's modulus, m/s: relative error < 1e-12 above 0.5 m/s."""


class ContactState(NamedTuple):
    """What one contact does: `film` m, `temperature_rise` K above the inlet, `traction` N (None: frictionless),
    `rolling_force` N (None: no rolling resistance), of the sign of the mean speed.

    `inner_residual` is that of the nested solve for the temperature rise, in units of ln(film).
    """

    film: Float[Array, "*batch"]
    temperature_rise: Float[Array, "*batch"] | None
    traction: Float[Array, "*batch"] | None
    rolling_force: Float[Array, "*batch"] | None
    inner_residual: Float[Array, ""]


class ContactLaws(eqx.Module):
    """Laws of the lubricated raceway contacts.

    **Arguments:**
    - `film`: film thickness law.
    - `thermal`: thermal reduction of the film; `NoThermalReduction()` is neutral.
    - `traction`: friction force law, or `None`: frictionless, and then the rolling elements roll without slip.
    - `entrainment_offset`: added to the mean surface speed of every contact, m/s. 0 by default; the
      reference closure of the published check values uses 1 mm/s.
    - `rolling`: rolling resistance, or `None`: left out.
    """

    film: AbstractLineFilm
    thermal: AbstractThermalFactor = NoThermalReduction()
    traction: AbstractTraction | None = None
    entrainment_offset: Scalar = eqx.field(converter=as_float, default=0.0)
    rolling: AbstractRollingResistance | None = None

    def evaluate(
        self,
        contact: LineContact,
        load: Values,
        mean_speed: Values,
        sliding_speed: Values,
        lubricant: Lubricant,
        inlet: InletOil,
    ) -> ContactState:
        """Film, temperature rise, traction and rolling resistance.

        The film is phi_T times the isothermal film at the inlet temperature; traction and rolling resistance see
        the oil at the inlet temperature plus the rise that explains phi_T (its pressure-viscosity coefficient at
        the inlet temperature).

        **Arguments:** `load`, N, > 0; `mean_speed` (u1 + u2)/2 and `sliding_speed` u1 - u2, m/s, of either sign;
        `inlet` = `lubricant.at(inlet temperature)`, evaluated once for all contacts.
        """
        speed = smooth_abs(mean_speed, SPEED_SMOOTHING) + self.entrainment_offset
        log_film = self.film.log_thickness(contact, load, speed, inlet.viscosity, inlet.pressure_viscosity)
        rise, inner_residual, base, base_viscosity = None, jnp.zeros(()), inlet.temperature, inlet.viscosity
        if not isinstance(self.thermal, NoThermalReduction):
            log_factor = self.thermal.log_factor(contact, load, speed, sliding_speed, inlet)
            args = (self, contact, load, speed, lubricant)
            root = inlet_temperature_rise(_log_film_at, args, base, log_film, log_factor)
            log_film = log_film + log_factor
            rise, inner_residual = root.value, jnp.max(root.residual)
            base = inlet.temperature + rise
            base_viscosity = lubricant.viscosity.viscosity(0.0, base)
        film = jnp.exp(log_film)
        traction = None
        if self.traction is not None:
            traction = self.traction.force(contact, load, film, speed, sliding_speed, base, lubricant, base_viscosity)
        rolling = None
        if self.rolling is not None:
            rolling = self.rolling.force(contact, load, film, mean_speed, base_viscosity, inlet.pressure_viscosity)
        return ContactState(film, rise, traction, rolling, inner_residual)


def _log_film_at(temperature, args):
    """ln of the isothermal film with the oil at another inlet temperature."""
    laws, contact, load, speed, lubricant = args
    viscosity = lubricant.viscosity.viscosity(0.0, temperature)
    return laws.film.log_thickness(
        contact, load, speed, viscosity, lubricant.pressure_viscosity.coefficient(temperature)
    )
