"""Life of a bearing from its scene and its solution, or from its scene alone."""

import dataclasses
from collections.abc import Callable
from typing import NamedTuple, TypeVar

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._checks import Information
from .._scene import AbstractScene, AbstractSolution
from .._types import Scalar
from ..life.basic import EXPONENTS, HOURS, RELIABILITY_FACTORS, basic_life, tapered_equivalent_load
from ..life.capacity import ball_capacity, roller_capacity
from ..life.equivalent import LARGEST_ANGLE, ball_equivalent_load, ball_static_load, roller_static_load
from ..life.modification import (
    KAPPA_RANGE,
    Family,
    contamination_factor,
    fatigue_load_limit,
    film_ratio,
    modification_factor,
    reference_viscosity,
)
from ..life.reference import (
    ball_contact_capacities,
    ball_damage_rate,
    edge_factors,
    roller_contact_capacities,
    roller_damage_rate,
)
from ..life.result import CatalogueLife, Life
from ..life.static import ball_static_capacity, contact_safety, rated_modulus, roller_static_capacity
from ..lubricants import Lubricant
from ..numerics.safe import largest
from .bearing import AbstractBearing
from .flanks import on_heavier_flanks
from .inlet import race_temperatures
from .minimum_films import minimum_films
from .operation import AbstractOperation
from .rated import RatedContacts
from .rating import CATALOGUE_CONFORMITY, Rating, rated_laminae
from .solution import Solution

FEWEST_LAMINAE = 30
"""Least number of laminae that ISO 16281 asks for."""

STEEP_WARNING = Information(
    "contact angle above 45 degrees: the X and Y of radial ball bearings end there, and there is no L10; L10r holds "
    "for any contact angle"
)
THIN_WARNING = (
    "viscosity ratio kappa below 0.1: ISO 281 gives no a_ISO there, that of kappa = 0.1 is used; boundary lubrication"
)
THICK_WARNING = Information(
    "viscosity ratio kappa above 4: a_ISO is that of kappa = 4, as ISO 281 asks; the contamination factor of a "
    "cleanliness class takes kappa itself, beyond the diagrams of ISO 281, which end at 4"
)


UNSAFE = "static safety C0/P0 below 1: larger permanent dents than the static load rating of ISO 76 allows"
TOO_LIGHT = (
    "the load of the contacts is below a maker's least load against skidding, 0.01 C of ball and 0.02 C of roller "
    "bearings: elements may slide"
)

AnySolution = TypeVar("AnySolution", bound=AbstractSolution)


class Rated(NamedTuple):
    """Load ratings of a bearing, N, its equivalent loads, N, and the damage rate of its contacts, per million
    revolutions."""

    family: Family
    dynamic_capacity: Array
    static_capacity: Array
    damage_rate: Array
    catalogue_load: Array | None
    """Equivalent dynamic load P of ISO 281 by the catalogue's formulas, N."""
    static_load: Array | None
    """Equivalent static load P0 of ISO 76, N."""


def with_life(scene: AbstractScene, solution: AnySolution) -> AnySolution:
    """Adds the life to the solution of a bearing whose scene has a rating; returns any other solution unchanged."""
    if not isinstance(scene, AbstractBearing) or not isinstance(solution, Solution) or scene.rating is None:
        return solution
    by_class = scene.rating.cleanliness is not None
    scene = scene.settled(solution)
    life = bearing_life(scene, solution)
    checks = dict(solution.checks)
    if life.modification_factor is not None and life.viscosity_ratio is not None:
        checks[THIN_WARNING] = life.viscosity_ratio < KAPPA_RANGE[0]
        if by_class:
            checks[THICK_WARNING] = life.viscosity_ratio > KAPPA_RANGE[1]
    if life.static_safety is not None:
        checks[UNSAFE] = life.static_safety < 1.0
    checks[TOO_LIGHT] = life.equivalent_load < life.minimum_load
    steep = not scene.line_contacts and scene.geometry.contact_angle is not None
    if steep and life.catalogue_load is not None:
        checks[STEEP_WARNING] = scene.drawing_angle > LARGEST_ANGLE * (1.0 + 1e-12)
    notes = (*solution.notes, *ineffective_inputs(scene, life))
    return dataclasses.replace(solution, life=life, checks=checks, notes=notes)


def ineffective_inputs(scene: AbstractBearing, life: Life) -> list[Information]:
    """Notes on fields of the rating that have no effect, because the scene lacks an input that they need or because
    they belong to another kind of bearing."""
    rating = scene.rating
    assert rating is not None
    if not scene.line_contacts:
        others = {"n_laminae": rating.n_laminae, "edge_factor": rating.edge_factor}
        texts = [
            f"rating.{name} has no effect: it is about rollers" for name, value in others.items() if value is not None
        ]
    else:
        about_balls = {"grooves": rating.grooves != "catalogue", "tilt": rating.tilt != "exact"}
        texts = [f"rating.{name} has no effect: it is about balls" for name, chosen in about_balls.items() if chosen]
    if rating.n_laminae is not None and rating.n_laminae < FEWEST_LAMINAE and scene.line_contacts:
        texts.append(
            f"rating.n_laminae = {rating.n_laminae}: ISO 16281 asks for at least {FEWEST_LAMINAE}; with edge factors "
            "the life of straight rollers grows with the number of laminae"
        )
    if rating.says_cleanliness and life.viscosity_ratio is None:
        lacking = "a viscosity ratio: rating.viscosity_ratio, or an oil with a density"
        name = "contamination_factor" if rating.cleanliness is None else "cleanliness"
        texts.append(f"rating.{name} has no effect without {lacking}")
    if rating.roughness_rings is not None and life.film_ratio_inner is None:
        texts.append("rating.roughness_rings and roughness_elements have no effect without films")
    return [Information(text) for text in texts]


def bearing_life(scene: object, solution: Solution) -> Life:
    """Life from the contact loads of a solution; pure. It is NaN if the solve failed.

    Needs `scene.rating`. The modified life uses one viscosity ratio and one load ratio, that of `equivalent_load`, for
    the whole bearing ([M]: the standard evaluates them contact by contact).

    **Raises:** `TypeError` for a kind of bearing without a life; `ValueError` for a scene without a rating.
    """
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"no life of a {type(scene).__name__}")
    if scene.rating is None:
        raise ValueError("bearing_life needs a scene with a rating, got one without")
    rating: Rating = scene.rating
    good = solution.converged
    # if the solve failed, the formulas get finite numbers, so that NaN reaches no derivative of other lanes of a batch
    solid = jax.tree.map(lambda leaf: jnp.where(good, leaf, 1.0), (solution.elements, solution.laminae))
    operation, heavier = scene.operation, on_heavier_flanks(solid[0])
    speed = jnp.asarray(operation.inner_speed) - operation.outer_speed
    turns = _turning(operation)
    contacts = scene.rated_contacts(solid[0], solid[1], jnp.where(good, solution.force, 1.0))
    pitch_diameter = jnp.asarray(contacts.pitch_diameter)
    rated = rated_by(contacts, rating, turns)
    exponent = EXPONENTS[rated.family]
    rate = rated.damage_rate
    loaded = rate > 0
    safe_rate = jnp.where(loaded, rate, 1.0)
    # a rate of NaN (no loads) gives a life of NaN, not an infinite one
    reference = jnp.where(loaded, 1.0 / safe_rate, jnp.where(rate == 0, jnp.inf, jnp.nan))
    equivalent = jnp.where(loaded, rated.dynamic_capacity * safe_rate ** (1.0 / exponent), 0.0 * rate)
    hours = lambda revolutions: revolutions * HOURS / jnp.abs(speed)
    reliability = RELIABILITY_FACTORS[rating.reliability]
    kappa = _viscosity_ratio(scene, rating, pitch_diameter, speed)
    more: dict[str, Array | None] = {}
    if kappa is not None:
        more["viscosity_ratio"] = kappa
    if kappa is not None and rating.says_cleanliness:
        limit = _chosen(
            rating.fatigue_load_limit, lambda: fatigue_load_limit(rated.static_capacity, pitch_diameter, rated.family)
        )
        clean = _cleanliness(rating, kappa, pitch_diameter)
        factor = modification_factor(kappa, clean * limit / jnp.where(loaded, equivalent, 1.0), rated.family)
        modified = reliability * factor * reference
        more |= {"modification_factor": factor, "Lnmr": modified, "Lnmr_hours": hours(modified)}
        more |= {"contamination_factor": clean, "fatigue_load_limit": limit}
    if rating.roughness_rings is not None and solid[0].film_inner is not None:
        rough = (rating.roughness_rings, rating.roughness_elements)
        inner, outer = minimum_films(scene, heavier)
        more |= {"film_ratio_inner": film_ratio(inner, *rough), "film_ratio_outer": film_ratio(outer, *rough)}
    if rated.catalogue_load is not None:
        more["L10"] = basic_life(rated.dynamic_capacity, rated.catalogue_load, exponent)
        more["L10h"] = hours(more["L10"])
        more |= {"catalogue_load": rated.catalogue_load, "static_load": rated.static_load}
    life = Life(
        damage_rate=rate,
        L10r=reference,
        L10r_hours=hours(reference),
        dynamic_capacity=rated.dynamic_capacity,
        static_capacity=rated.static_capacity,
        equivalent_load=equivalent,
        reliability_factor=jnp.asarray(reliability),
        contact_static_safety=contact_safety(heavier.pressure_inner, heavier.pressure_outer, rated.family),
        family=rated.family,
        reliability=rating.reliability,
        **more,
    )
    return jax.tree.map(lambda leaf: jnp.where(good, leaf, jnp.nan), life)


def catalogue_life(scene: AbstractBearing) -> CatalogueLife:
    """Life of ISO 281 under the loads of the scene, without a solve. The bearing alone need not be in equilibrium, as
    for a purely radial load on a tapered roller bearing, where an opposed bearing supplies the axial force.

    The life is NaN in cases that the formulas of catalogues do not cover: a moment, a given displacement, an axial load
    on flanges, or an axial load in a direction in which the bearing carries none.

    **Raises:** `ValueError` for a scene without a rating.
    """
    if scene.rating is None:
        raise ValueError("catalogue_life needs a scene with a rating, got one without")
    operation: AbstractOperation = scene.operation
    rated = rated_by(scene.rated_contacts(None, None), scene.rating, _turning(operation))
    load = jnp.asarray(jnp.nan) if rated.catalogue_load is None else rated.catalogue_load
    axial = operation.load("axial")
    if axial is not None:
        load = jnp.where((scene.one_way_angle > 0) & (jnp.asarray(axial) < 0), jnp.nan, load)
    life = (rated.dynamic_capacity / load) ** EXPONENTS[rated.family]
    hours = life * HOURS / jnp.abs(jnp.asarray(operation.inner_speed) - operation.outer_speed)
    return CatalogueLife(L10h=hours, L10=life, catalogue_load=load, dynamic_capacity=rated.dynamic_capacity)


def _turning(operation: AbstractOperation) -> tuple[Bool[Array, ""], Bool[Array, ""]]:
    """Tests whether the inner and the outer ring turn relative to the stationary load. If both rings are at rest, the
    inner ring counts as turning."""
    inner, outer = (jnp.asarray(value) != 0.0 for value in (operation.inner_speed, operation.outer_speed))
    return inner | ~outer, outer


def _viscosity_ratio(
    scene: AbstractBearing, rating: Rating, pitch_diameter: Array, speed: Array
) -> Float[Array, ""] | None:
    """Viscosity ratio kappa, as given or computed from the oil at its inlet temperature; if the oil of each raceway has
    a temperature of its own, at the higher of these. `None` if kappa is not given and cannot be computed."""
    if rating.viscosity_ratio is not None:
        return jnp.asarray(rating.viscosity_ratio)
    oil: Lubricant | None = scene.oil
    if oil is None or oil.density is None:
        return None
    temperature = jnp.asarray(race_temperatures(scene))
    if temperature.ndim:
        temperature = largest(temperature)
    kinematic = oil.viscosity.viscosity(0.0, temperature) / oil.density.density(temperature)
    return kinematic / reference_viscosity(speed, pitch_diameter)


def _cleanliness(rating: Rating, kappa: Array, pitch_diameter: Array) -> Array:
    """Contamination factor e_C, as given or of the contamination class."""
    if rating.cleanliness is None:
        return jnp.asarray(rating.contamination_factor)
    return contamination_factor(kappa, pitch_diameter, rating.cleanliness)


def _chosen(value: Scalar | None, computed: Callable[[], Array]) -> Array:
    return computed() if value is None else jnp.asarray(value)


def rated_by(contacts: RatedContacts, rating: Rating, turns: tuple[Array, Array]) -> Rated:
    """Ratings, equivalent loads and damage rate of the contacts of a bearing.

    **Arguments:** `turns`: whether the inner and the outer ring turn relative to the load."""
    return (_of_points if contacts.length is None else _of_lines)(contacts, rating, turns)


def _of_points(contacts: RatedContacts, rating: Rating, turns: tuple[Array, Array]) -> Rated:
    assert contacts.conformities is not None
    sizes = (contacts.n_elements, contacts.diameter, contacts.pitch_diameter, jnp.asarray(contacts.contact_angle))
    modulus = rated_modulus(contacts.rings, contacts.elements, contacts.inner_ring)
    # the conformities of the ratings; the damage is split between the races with the bearing's own conformities
    rated = contacts.conformities if rating.grooves == "scene" else (CATALOGUE_CONFORMITY,) * 2
    capacity = _chosen(rating.dynamic_capacity, lambda: ball_capacity(*sizes, *rated))
    static = _chosen(rating.static_capacity, lambda: ball_static_capacity(*sizes, rated[0], modulus))
    limits = ball_contact_capacities(capacity, *sizes, *contacts.conformities)
    of_inner, of_outer = turns
    rate = ball_damage_rate(contacts.inner, contacts.outer, limits, of_inner, of_outer, contacts.second)
    radial, axial = contacts.radial_load, contacts.axial_load
    if radial is None or axial is None:
        return Rated("ball", capacity, static, rate, None, None)
    angle = contacts.contact_angle
    load = ball_equivalent_load(radial, axial, angle, contacts.n_elements, contacts.diameter)
    return Rated("ball", capacity, static, rate, load, ball_static_load(radial, axial, angle))


def edge_weights(rating: Rating, profiled: bool, count: int) -> np.ndarray:
    """Edge factors f_k of the laminae: those of the standard, or 1 if the rating or a profile switches them off."""
    wanted = not profiled if rating.edge_factor is None else rating.edge_factor
    return edge_factors(count) if wanted else np.ones(count)


def even_laminae(load: Float[Array, " element"], count: int) -> Float[Array, "element lamina"]:
    """Loads of the laminae of rollers whose load is uniform along their length."""
    return jnp.broadcast_to(load[:, None] / count, (load.shape[0], count))


def _of_lines(contacts: RatedContacts, rating: Rating, turns: tuple[Array, Array]) -> Rated:
    assert contacts.length is not None
    angle, length = jnp.asarray(contacts.contact_angle), contacts.length
    sizes = (contacts.n_elements, contacts.diameter, contacts.pitch_diameter)
    modulus = rated_modulus(contacts.rings, contacts.elements, contacts.inner_ring)
    capacity = _chosen(rating.dynamic_capacity, lambda: roller_capacity(*sizes, length, angle))
    static = _chosen(rating.static_capacity, lambda: roller_static_capacity(*sizes, length, angle, modulus))
    limits = roller_contact_capacities(capacity, *sizes, angle)
    inner, outer = contacts.inner, contacts.outer
    if inner.ndim == 1:
        inner, outer = (even_laminae(load, rated_laminae(rating)) for load in (inner, outer))
    weights = edge_weights(rating, contacts.profiled, inner.shape[1])
    rate = roller_damage_rate(inner, outer, limits, *turns, factors=weights)
    load = resting = contacts.radial_load
    if load is not None and contacts.axial_load is not None:
        resting = roller_static_load(load, contacts.axial_load, angle)
        load = tapered_equivalent_load(load, contacts.axial_load, angle)
    return Rated("roller", capacity, static, rate, load, resting)
