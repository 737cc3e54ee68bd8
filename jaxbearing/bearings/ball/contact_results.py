"""Results at the contacts of a solved ball bearing: loads, angles, pressures, motion, and input of the range checks."""

from typing import Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar
from ...contacts import PointContact
from ..computed import computed_results
from ..facts import LOADED, MEAN_OF_POINT, RACEWAYS, Contacts
from ..parts import azimuths
from .arcs import Arcs
from .core import BallCore, BallState
from .equations import AbstractBallEquations
from .gyroscopic import USUAL_FRICTION
from .scene import BallBearing
from .solution import BallResults, SolvedBalls
from .state import BallsState


def _every(scene: BallBearing, values: Array) -> Float[Array, " ball"]:
    """One value for each ball, even if one ball was solved for all."""
    return jnp.broadcast_to(values, (scene.geometry.n_balls,))


def ball_results(
    scene: BallBearing,
    system: BallCore | AbstractBallEquations,
    state: BallState | BallsState,
    contact: PointContact,
    films: BallsState | None = None,
    **more: Array | None,
) -> tuple[BallResults, Contacts]:
    """Loads, angles and motion of the balls, and the geometric part of the contacts for the range checks.

    **Arguments:** `films`: state of the lubricated balls; `more`: further results, by the names of their fields."""
    geometry, kinematics = scene.geometry, system.kinematics
    load, angle, motion = state.load, state.angle, state.motion
    ellipse = contact.ellipse(load)
    pressure = jnp.where(load > 0, ellipse.pressure, 0.0)
    arcs, first = system.arcs, (0, system.arcs.first_outer)
    races = kinematics.races(motion, angle, arcs.senses)
    rolling = jnp.abs(kinematics.inner_speed - kinematics.outer_speed) / kinematics.ratio
    ratios = races.spin / jnp.sqrt(jnp.square(races.roll) + jnp.square(1e-12 * rolling) + 1e-24)
    more |= computed_results(BallResults, SolvedBalls(system, state, films))
    if scene.kinematics.gyroscopic is None:
        more["gyroscopic_limit"] = 0.5 * USUAL_FRICTION * kinematics.ball_diameter * jnp.sum(load, axis=0)
    more |= _second(arcs, load, angle, pressure, ratios)
    others: dict[str, Any] = {name: None if result is None else _every(scene, result) for name, result in more.items()}
    elements = BallResults(
        azimuth=azimuths(geometry, geometry.n_balls),
        load_inner=_every(scene, load[0]),
        load_outer=_every(scene, load[first[1]]),
        contact_angle_inner=_every(scene, angle[0]),
        contact_angle_outer=_every(scene, angle[first[1]]),
        pressure_inner=_every(scene, pressure[0]),
        pressure_outer=_every(scene, pressure[first[1]]),
        orbital_speed=_every(scene, motion.orbital_speed),
        spin_speed=_every(scene, motion.spin_speed),
        attitude_angle=_every(scene, motion.attitude),
        spin_to_roll_inner=_every(scene, jnp.abs(ratios[0])),
        spin_to_roll_outer=_every(scene, jnp.abs(ratios[first[1]])),
        **others,
    )
    contacts = Contacts(_places(arcs), load, pressure, MEAN_OF_POINT, angle=angle)
    if not arcs.single:
        most = jnp.stack([jnp.max(load[: arcs.first_outer]), jnp.max(load[arcs.first_outer :])])
        contacts = contacts._replace(largest=arcs.of_contacts(most)[:, None])
    return elements, _at_shoulders(scene, contacts, arcs, ellipse.transverse)


def _places(arcs: Arcs) -> tuple[str, ...]:
    """Names of the contacts of a ball, for messages."""
    names = {0: "{}", 1: "{} (flank for thrust along +x)", -1: "{} (flank for thrust along -x)"}
    return tuple(names[side].format(RACEWAYS[race]) for race, side in zip(arcs.races, arcs.sides, strict=True))


def _second(arcs: Arcs, load: Array, angle: Array, pressure: Array, ratios: Array) -> dict[str, Array | None]:
    """Results that only bearings with two groove arcs have: those of the flanks for thrust along -e_x, and the number
    of loaded contacts."""
    if arcs.single:
        return {}
    spins = jnp.abs(ratios)
    named = arcs.named({"load": load, "contact_angle": angle, "pressure": pressure, "spin_to_roll": spins})
    carrying = jnp.sum(load > LOADED * jnp.max(load), axis=0, dtype=float)
    return {"loaded_contacts": carrying, **{name: result for name, result in named.items() if name.endswith("_second")}}


def _at_shoulders(scene: BallBearing, contacts: Contacts, arcs: Arcs, transverse: Array) -> Contacts:
    """The contacts, with the angle by which each ellipse passes the shoulder of its groove, if the scene gives one."""
    geometry = scene.geometry
    limits = (geometry.shoulder_angle_inner, geometry.shoulder_angle_outer)
    if limits == (None, None):
        return contacts
    assert contacts.angle is not None
    angle = jnp.abs(contacts.angle)
    radius = jnp.stack([jnp.asarray(f * geometry.ball_diameter) for f in _conformities(scene)])
    limit = jnp.stack([jnp.asarray(0.0 if value is None else value) for value in limits])
    radius, limit = arcs.of_contacts(radius)[:, None], arcs.of_contacts(limit)[:, None]
    names = ("the inner ring's shoulder", "the outer ring's shoulder")
    edges = tuple(None if limits[race] is None else names[race] for race in arcs.races)
    return contacts._replace(past_edge=angle + transverse / radius - limit, edges=edges)


def _conformities(scene: BallBearing) -> tuple[Scalar, Scalar]:
    return scene.geometry.conformity_inner, scene.geometry.conformity_outer


def contacts_at(scene: BallBearing, angle: Array, races: tuple[int, ...]) -> PointContact:
    """The contacts at given contact angles, rad. **Arguments:** `races`: race of each contact, 0 inner, 1 outer."""
    return scene.geometry.contacts_on(jnp.cos(angle), races, scene.materials.race_modulus)
