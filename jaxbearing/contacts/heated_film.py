"""Film thickness with inlet heating: the thermal factor, and the temperature rise of the oil that corresponds to it."""

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
    """Film with inlet heating.

    - `log_thickness`: ln of the film thickness in m.
    - `rise`: temperature rise of the oil in the contact above the inlet temperature, K; `None` if isothermal.
    - `residual`: residual of the nested solve for the rise, in units of ln(film).
    """

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
    """Film thickness, the isothermal film at the inlet temperature times the thermal factor, and temperature rise at
    which the isothermal film has this thickness.

    **Arguments:** `film`, `thermal`: laws for the kind of the contact; `load`, N, > 0; `speed`: mean speed of the
    surfaces, m/s; `sliding_speed`, m/s; `inlet` = `lubricant.at(inlet temperature)`, evaluated once for all contacts.
    """
    # a scene checks that both laws fit the kind of its contacts
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
    """Logarithm of the isothermal film with the oil properties at a given temperature, K."""
    law, contact, load, speed, lubricant = args
    viscosity = lubricant.viscosity.viscosity(0.0, temperature)
    return law.log_thickness(contact, load, speed, viscosity, lubricant.pressure_viscosity.coefficient(temperature))
