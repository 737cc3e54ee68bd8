"""Minimum film thicknesses for the lambda ratio, from solutions that give the central film."""

from typing import Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..contacts import AbstractLineFilm, HamrockDowsonMinimum, PointContact, RigidBlend
from ..contacts.minimum_film import line_share, minimum_share
from .bearing import AbstractBearing
from .inlet import oil_of_races


def minimum_films(scene: AbstractBearing, elements: Any) -> tuple[Float[Array, " element"], Float[Array, " element"]]:
    """Minimum films of the inner and the outer raceway, m, from the films of a solution.

    Line contacts: `LINE_SHARE` times the central film, or the film itself if the law of the scene gives the minimum
    film. For rollers in laminae the film of the thinnest lamina is used. Point contacts: the film times the ratio of
    Hamrock and Dowson's laws for the minimum and the central film, at most 1. The ratio uses the mean entrainment speed
    at the pitch circle, on which it depends only with the power 0.01.
    """
    film = scene.contact.film
    film = film.film if isinstance(film, RigidBlend) else film
    if isinstance(film, HamrockDowsonMinimum):
        share = jnp.ones((2, 1))
    else:
        points = scene.point_contacts(elements)
        share = _line_share(scene.contact.film) if points is None else _point_share(scene, points, elements)
    films = [getattr(elements, f"{thinnest_film(elements)}_{side}") for side in ("inner", "outer")]
    return films[0] * share[0], films[1] * share[1]


def thinnest_film(elements: Any) -> str:
    """First part of the names of the results with the thinnest central film of each element: `film`, or `film_least` of
    rollers that tilt."""
    return "film" if getattr(elements, "film_least_inner", None) is None else "film_least"


def _line_share(law: AbstractLineFilm) -> Array:
    return jnp.full((2, 1), line_share(law))


def _point_share(scene: AbstractBearing, contact: PointContact, elements: Any) -> Float[Array, "2 element"]:
    load = jnp.stack([elements.load_inner, elements.load_outer])
    operation, inlet = scene.operation, oil_of_races(scene)
    speed = 0.25 * scene.geometry.pitch_diameter * (jnp.asarray(operation.inner_speed) - operation.outer_speed)
    return minimum_share(scene.contact.film, contact, load, speed, inlet.viscosity, inlet.pressure_viscosity)
