"""Ratio of the minimum film thickness of a lubricated contact to the central one, or to that of a film law."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from .film import AbstractLineFilm, DowsonHigginson, MartinBlend, PanHamrockMinimum
from .line import LineContact
from .point import PointContact
from .point_film import AbstractPointFilm, HamrockDowsonCentral, HamrockDowsonMinimum, RigidBlend

LINE_SHARE = 0.75
"""Ratio of the minimum to the central film thickness of a line contact. In our full solutions of the source's two
contacts (table 18) it is 0.750 and 0.746. Dowson and Higginson's minimum film and Dowson and Toyoda's central film give
0.75 at U = 1e-11 and W = 1e-4."""


def of_minimum(law: AbstractLineFilm | AbstractPointFilm) -> bool:
    """True if a law gives the minimum film thickness."""
    law = law.film if isinstance(law, MartinBlend | RigidBlend) else law
    return isinstance(law, DowsonHigginson | PanHamrockMinimum | HamrockDowsonMinimum)


def line_share(law: AbstractLineFilm | AbstractPointFilm) -> float:
    """Ratio of the minimum film thickness of a line contact to that of a film law."""
    return 1.0 if of_minimum(law) else LINE_SHARE


def minimum_share(
    law: AbstractLineFilm | AbstractPointFilm,
    contact: LineContact | PointContact,
    load: Values,
    entrainment_speed: Values,
    viscosity: Values,
    pressure_viscosity: Values,
) -> Float[Array, "..."]:
    """Ratio of the minimum film thickness to that of a film law: 1 for a law of the minimum film.

    **Arguments:** `law`: film law; others as for `minimum_over_central`.
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
    """Ratio of the minimum to the central film thickness.

    For line contacts it is `LINE_SHARE`, for point contacts the ratio of Hamrock and Dowson's two films, at most 1.

    **Arguments:** `contact`; `load`, N; `entrainment_speed`, m/s; `viscosity`, Pa s, and `pressure_viscosity`, 1/Pa, of
    the oil in the inlet.
    """
    if isinstance(contact, LineContact):
        return jnp.asarray(LINE_SHARE)
    state = (contact, load, entrainment_speed, viscosity, pressure_viscosity)
    ratio = HamrockDowsonMinimum().log_thickness(*state) - HamrockDowsonCentral().log_thickness(*state)
    return jnp.exp(jnp.minimum(ratio, 0.0))
