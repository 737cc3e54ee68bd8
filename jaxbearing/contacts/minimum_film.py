"""Minimum over central film of a lubricated contact, from the film law that a scene names."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from .film import AbstractLineFilm, DowsonHigginson, MartinBlend, PanHamrockMinimum
from .line import LineContact
from .point import PointContact
from .point_film import AbstractPointFilm, HamrockDowsonCentral, HamrockDowsonMinimum, RigidBlend

LINE_SHARE = 0.75
"""Ratio of minimum to central film of a line contact: 0.750 and 0.746 in own full solutions of the source's two
contacts (table 18), 0.75 by Dowson and Higginson's minimum and Dowson and Toyoda's central film at U = 1e-11, W =
1e-4."""


def of_minimum(law: AbstractLineFilm | AbstractPointFilm) -> bool:
    """True if a law is one of the minimum film."""
    law = law.film if isinstance(law, MartinBlend | RigidBlend) else law
    return isinstance(law, DowsonHigginson | PanHamrockMinimum | HamrockDowsonMinimum)


def line_share(law: AbstractLineFilm | AbstractPointFilm) -> float:
    """Minimum film over the film of a law of line contacts."""
    return 1.0 if of_minimum(law) else LINE_SHARE


def minimum_share(
    law: AbstractLineFilm | AbstractPointFilm,
    contact: LineContact | PointContact,
    load: Values,
    entrainment_speed: Values,
    viscosity: Values,
    pressure_viscosity: Values,
) -> Float[Array, "..."]:
    """Minimum film over the film of a law: 1 where the law is one of the minimum film.

    **Arguments:** `law`: of the film; others as for `minimum_over_central`.
    """
    if of_minimum(law):
        return jnp.ones(())
    return minimum_over_central(contact, load, entrainment_speed, viscosity, pressure_viscosity)


def minimum_over_central(
    contact: LineContact | PointContact,
    load: Values,
    entrainment_speed: Values,
    viscosity: Values,
    pressure_viscosity: Values,
) -> Float[Array, "..."]:
    """Minimum over central film.

    Line contacts have `LINE_SHARE`. Point contacts have the ratio of Hamrock and Dowson's two laws, at most 1.

    **Arguments:** `contact`; `load`, N; `entrainment_speed`, m/s; `viscosity`, Pa s, and `pressure_viscosity`, 1/Pa, of
    the oil in the inlet.
    """
    if isinstance(contact, LineContact):
        return jnp.asarray(LINE_SHARE)
    state = (contact, load, entrainment_speed, viscosity, pressure_viscosity)
    ratio = HamrockDowsonMinimum().log_thickness(*state) - HamrockDowsonCentral().log_thickness(*state)
    return jnp.exp(jnp.minimum(ratio, 0.0))
