"""Film of a contact whose inlet heats up: thermal factor, and the temperature of the oil that enters."""

from typing import Any, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from ..lubricants import InletOil, Lubricant
from ..numerics.compiling import compiled_by_hand
from .film import AbstractLineFilm
from .line import LineContact
from .point import PointContact
from .point_film import AbstractPointFilm
from .thermal import AbstractThermalFactor, NoThermalReduction, inlet_temperature_rise


class HeatedFilm(NamedTuple):
    """`log_thickness`, ln of m; `rise`, K, of the oil in the contact above the inlet (None: isothermal); `residual` of
    the nested solve for it, in units of ln(film)."""

    log_thickness: Float[Array, "..."]
    rise: Float[Array, "..."] | None
    residual: Float[Array, "..."]


@compiled_by_hand
def heated_film(
    film: AbstractLineFilm | AbstractPointFilm,
    thermal: AbstractThermalFactor,
    contact: LineContact | PointContact,
    load: Values,
    speed: Values,
    sliding_speed: Values,
    lubricant: Lubricant,
    inlet: InletOil,
) -> HeatedFilm:
    """The isothermal film at the inlet temperature times the thermal factor, and the rise that explains the factor.

    **Arguments:** laws that fit the kind of contact; `load`, N, > 0; `speed`, mean of the surfaces, and
    `sliding_speed`, m/s; `inlet` = `lubricant.at(inlet temperature)`, evaluated once for all contacts.
    """
    # laws of the contact's kind: seen to when the scene is made
    law: Any = film
    factor: Any = thermal
    log_film = law.log_thickness(contact, load, speed, inlet.viscosity, inlet.pressure_viscosity)
    if isinstance(thermal, NoThermalReduction):
        return HeatedFilm(log_film, None, jnp.zeros_like(log_film))
    log_factor = factor.log_factor(contact, load, speed, sliding_speed, inlet)
    args = (law, contact, load, speed, lubricant)
    root = inlet_temperature_rise(_log_film_at, args, inlet.temperature, log_film, log_factor)
    return HeatedFilm(log_film + log_factor, root.value, root.residual)


def _log_film_at(temperature: Array, args: Any) -> Array:
    """ln of the isothermal film with the oil at another inlet temperature."""
    law, contact, load, speed, lubricant = args
    viscosity = lubricant.viscosity.viscosity(0.0, temperature)
    return law.log_thickness(contact, load, speed, viscosity, lubricant.pressure_viscosity.coefficient(temperature))
