"""Steady state of a ball bearing: solution of the equations of a scene, and results."""

import dataclasses
from collections.abc import Callable
from typing import TypeVar

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...contacts.point_laws import PointFilm
from ...materials import reduced_modulus
from ...numerics.arrow import ArrowJacobian, ArrowPoint, assembled, element_tangents, seen_by_elements
from ...numerics.newton import NewtonOptions, NewtonResult, newton_solve
from ..assemble import Results, assemble
from ..elastic_ring import UNSUPPORTED
from ..facts import Facts
from ..interactions import FrictionTotals, Interaction, friction_totals, of_land
from ..land import LandState
from ..mixed import boundary_power, mixed_results
from ..parts import azimuths
from ..ring import InnerRing, Port
from ..solution import RING_FREEDOMS, TILTS, CageState, FailureCause, RacewayPower, Solution
from .arched import ArchedBallSystem
from .build import build_core, build_lubricated, row_of, with_films
from .contact_results import ball_results, contacts_at
from .core import BallCore, BallState
from .equations import AbstractBallEquations
from .friction import mixed_state
from .pairs import LubricatedBallSystem
from .rolling import constraint_torques, rolling_balance, rolling_resistance
from .scene import BallBearing
from .solution import BallPowerLoss, BallResults
from .state import BallsState

Balls = TypeVar("Balls", BallCore, LubricatedBallSystem, ArchedBallSystem)
Seen = TypeVar("Seen")


def solve_ball(
    scene: BallBearing, options: NewtonOptions, ring: InnerRing | None = None, exact: bool | None = None
) -> Solution:
    """Steady state of a ball bearing: pure, jit-able, vmap-able, differentiable; never raises for a failed solve.

    **Arguments:** `ring`: a ring with loads and displacements instead of those of the scene's operating point; `exact`:
    see `build_core`.
    """
    core = build_core(scene, exact, ring)
    if scene.contact is not None and scene.geometry.has_arcs:
        core = with_films(scene, core)
    core, steps = core.started()
    if scene.contact is None:
        system, result = newton_solve(core, options)
        port, balls = _dry_port(scene, system, result)
        results = _dry_results(scene, system, balls)
    else:
        system, result = newton_solve(build_lubricated(scene, core), options)
        state = system.at(result.point)
        results, port = _lubricated(scene, system, result, state), _port(scene, system, result, state.film)
    causes = _without_cage(scene)
    steps = steps + result.iterations
    results = results._replace(**system.bent.results(system.amplitudes(result.point.globals)))
    if system.outer is not None:
        result, none = system.outer.judged(system.ring, result)
        causes, steps = causes | {UNSUPPORTED: FailureCause(none, jnp.zeros(0))}, jnp.where(none, 0, steps)
    lever = system.grooves.lever
    if any(name in TILTS for name in system.freedoms):
        stiffness = _of_lengths(port.stiffness, lever, system.freedoms)
        results = results._replace(facts=results.facts._replace(stiffness=stiffness))
    times = overload(scene) if ring is None else jnp.zeros(())
    return assemble(
        scene,
        result,
        results,
        system.ring.displacement(result.point.globals),
        port,
        iterations=steps,
        ring_freedom=scene.shown_freedoms if ring is None else RING_FREEDOMS,
        failure_causes=causes
        | {
            "the load is {:.3g} times that at which the most loaded ball reaches 4.2 GPa, the limit of the static load "
            "rating: balls and races would yield": FailureCause(times > 1.0, times)
        },
        stiffness_freedom=RING_FREEDOMS,
        equation_names=system.equation_names(),
    )


def _of_lengths(
    stiffness: Float[Array, "5 5"], lever: Array, freedoms: tuple[str, ...]
) -> Float[Array, "freedom freedom"]:
    """Stiffness of the unknown degrees of freedom `freedoms` of the ring, N/m, with tilts converted to lengths by the
    `lever`, m."""
    free = np.asarray([RING_FREEDOMS.index(name) for name in freedoms])
    unit = jnp.stack([1.0 / lever if name in TILTS else jnp.ones(()) for name in freedoms])
    return stiffness[free][:, free] * unit[:, None] * unit[None]


def _without_cage(scene: BallBearing) -> dict[str, FailureCause]:
    if not scene.slips or scene.cage is not None:
        return {}
    text = (
        "balls that slide have no cage here: where the load lets some of them skid, no steady state is found; give the "
        "scene a [cage], a larger thrust, or leave out contact.traction"
    )
    return {text: FailureCause(jnp.asarray(True), jnp.zeros(0))}


def overload(scene: BallBearing) -> Float[Array, ""]:
    r"""Static equivalent load over the static load rating, $P_0/C_0$, for the grooves and materials of the scene.

    The rating follows the definition of ISO 76, $C_0 = \frac15Z\cos\alpha\,Q(4.2\,GPa)$ for the inner contact. The load
    is $P_0 = \max(F_r, X_0F_r + Y_0F_a)$ with $X_0$ = 0.6 (deep groove) or 0.5 and
    $Y_0 = 0.58 - 0.008\alpha$/1°, at most 0.5, a line through the table of ISO 76 ([M], from memory). A moment counts
    as the axial load $2M/d_m$. The contact load at 4.2 GPa comes from Hamrock and Brewe's closed form of the ellipse,
    which is accurate to 5 %; this is sufficient for a message.
    """
    geometry, operation = scene.geometry, scene.operation
    angle, radial_row = jnp.asarray(geometry.nominal_angle), geometry.contact_angle is None and not geometry.has_arcs
    radial, axial = operation.radial_size, 2.0 * operation.moment_size / geometry.pitch_diameter
    if operation.axial_load is not None:
        axial = axial + jnp.abs(operation.axial_load)
    share = 0.6 if radial_row else 0.5
    equivalent = jnp.maximum(radial, share * radial + jnp.minimum(0.58 - 0.008 * jnp.degrees(angle), 0.5) * axial)
    modulus = reduced_modulus(scene.materials.of_rings[0], scene.materials.balls)
    rolling = 0.5 * geometry.ball_diameter * (1.0 - geometry.ball_diameter / geometry.pitch_diameter * jnp.cos(angle))
    transverse = geometry.conformity_inner * geometry.ball_diameter / (2.0 * geometry.conformity_inner - 1.0)
    ratio, radius = transverse / rolling, 1.0 / (1.0 / rolling + 1.0 / transverse)
    ellipticity, integral = ratio ** (2.0 / jnp.pi), 1.0 + (0.5 * jnp.pi - 1.0) / ratio
    spread = 6.0 * jnp.square(ellipticity) * integral * radius / (jnp.pi * modulus)
    ball = (jnp.pi * scene.yield_pressure / (1.5 * ellipticity)) ** 3 * jnp.square(spread)
    return equivalent / (0.2 * geometry.n_balls * jnp.cos(angle) * ball)


def _dry_results(scene: BallBearing, system: BallCore, state: BallState) -> Results[BallResults, BallPowerLoss]:
    contact = contacts_at(scene, state.angle, system.arcs.races)
    elements, contacts = ball_results(scene, system, state, contact)
    return Results(elements, FrictionTotals(BallPowerLoss()), Facts((contacts,)))


def _lubricated(
    scene: BallBearing, system: AbstractBallEquations, result: NewtonResult, state: BallsState
) -> Results[BallResults, BallPowerLoss]:
    film, shear, pocket, arcs = state.film, state.traction, state.pocket, system.arcs
    by_contact: dict[str, Array] = {"film": film.film}
    if film.rise is not None:
        by_contact["temperature_rise"] = film.rise
    if shear is not None:
        by_contact |= {
            "sliding": state.races.rolling,
            "traction": jnp.asarray(-arcs.senses * shear.rolling),
            "spin_moment": shear.moment,
        }
    more: dict[str, Array | None] = {**arcs.named(by_contact)}
    mixed = None if shear is None else mixed_state(system, state)
    more |= mixed_results(mixed, arcs.names)
    if system.resolved:
        more["transverse_spin"] = state.motion.transverse
    if pocket is not None:
        more |= {"pocket_film_front": pocket.film_front, "pocket_film_rear": pocket.film_rear}
        more |= {"pocket_load_front": pocket.load_front, "pocket_load_rear": pocket.load_rear}
    elements, contacts = ball_results(scene, system, state, state.contact, state, **more)
    contacts = contacts._replace(
        laws=system.laws,
        inlet=system.inlet,
        mean_speed=state.races.mean_speed,
        sliding=state.races.rolling,
        temperature=film.temperature,
        load_share=None if mixed is None else mixed.share,
        starved=film.supply,
    )
    facts = Facts((contacts,))
    land = None if system.cage is None else system.land_at(result.point, state)
    if shear is None:
        return _rolling_alone(system, state, elements, facts)
    cage = None if land is None else _cage_state(system, result, state, land)
    parts = _raceway_power(system, state)
    totals = friction_totals(BallPowerLoss, _interactions(system, state, land), system.kinematics)
    boundary = boundary_power(mixed, system.multiplicity, races=arcs.races)
    return Results(elements, totals, facts, cage=cage, raceway_power=parts, boundary_power=boundary)


def _cage_state(system: AbstractBallEquations, result: NewtonResult, state: BallsState, land: LandState) -> CageState:
    orbit = system.orbit(result.point.globals[-1])
    load, free = system.arcs.on_inner(state.load), system.free_rolling(state)
    weight = load / jnp.sum(load)
    mean = jnp.sum(weight * free)
    unit = system.orbit_unit
    slip = (mean - orbit) * mean / (jnp.square(mean) + jnp.square(1e-8 * unit))
    alone = system.multiplicity > 1  # all balls alike: the cage is concentric
    eccentricity = jnp.zeros(()) if alone else land.eccentricity_ratio
    return CageState(orbit, slip, eccentricity, land.attitude_angle)


def _rolling_alone(
    system: AbstractBallEquations, state: BallsState, elements: BallResults, facts: Facts
) -> Results[BallResults, BallPowerLoss]:
    """Results of balls that roll without sliding, with the rolling resistance if the scene models it."""
    resistance, interactions = rolling_resistance(system, state), []
    if resistance is not None:
        power = system.multiplicity * jnp.sum(system.arcs.senses * resistance * state.races.roll)
        if system.common_orbit or isinstance(system, ArchedBallSystem):
            torques = constraint_torques(system, state, resistance)
        else:
            balance = rolling_balance(system, state, resistance)
            torques = _ball_torques(system, state, balance.forward, balance.about, (resistance,))
        interactions = [Interaction("rolling_resistance", power, *torques, _by_race(system, state, resistance))]
    totals = friction_totals(BallPowerLoss, interactions, system.kinematics)
    return Results(elements, totals, facts)


def _raceway_power(system: AbstractBallEquations, state: BallsState) -> RacewayPower:
    shear, races = state.traction, state.races
    assert shear is not None
    senses, by_race = system.arcs.senses, system.arcs.by_race
    total = lambda power: [system.multiplicity * jnp.sum(on_race) for on_race in by_race(power)]
    spin, rolling = total(shear.moment * races.spin), total(shear.rolling * (senses * races.rolling))
    transverse = total(shear.transverse * (senses * races.transverse))
    parts = RacewayPower(spin[0], rolling[0], transverse[0], spin[1], rolling[1], transverse[1])
    if state.curvature is None:
        return parts
    curved = total(senses * state.curvature * races.roll)
    return dataclasses.replace(parts, inner_curvature=curved[0], outer_curvature=curved[1])


def _interactions(system: AbstractBallEquations, state: BallsState, land: LandState | None) -> list[Interaction]:
    """The friction of sliding balls as a list of interactions, each with the power of its own force and speed."""
    shear, pocket, motion = state.traction, state.pocket, state.motion
    assert shear is not None
    total = lambda power: system.multiplicity * jnp.sum(power)
    curved, senses = () if state.curvature is None else (state.curvature,), system.arcs.senses
    sheared = system.arcs.by_race(shear.power)
    inner, outer = _ball_torques(system, state, jnp.asarray(-senses * shear.rolling), -shear.moment, curved)
    interactions = [
        Interaction("inner_raceway", total(sheared[0]), inner_torque=inner),
        Interaction("outer_raceway", total(sheared[1]), outer_torque=outer),
    ]
    if state.rolling is not None:
        nothing = jnp.zeros_like(state.rolling)
        torques = _ball_torques(system, state, nothing, nothing, (state.rolling,))
        power = total(senses * state.rolling * state.races.roll)
        interactions.append(Interaction("rolling_resistance", power, *torques, _by_race(system, state, state.rolling)))
    if pocket is not None:
        radius = 0.5 * system.kinematics.ball_diameter
        power = pocket.friction * motion.axial_spin + pocket.transverse * motion.radial_spin
        interactions.append(Interaction("pocket", total(radius * power)))
    if land is not None and system.cage is not None:
        interactions.append(of_land(land.power, land.ring_torque, system.cage.guidance))
    if state.drag_force is not None:
        speed = 0.5 * system.kinematics.pitch_diameter * motion.orbital_speed
        interactions.append(Interaction("drag", total(state.drag_force * speed)))
    return interactions


def _by_race(system: AbstractBallEquations, state: BallsState, resistance: Array) -> Float[Array, "2"]:
    """Power of the rolling resistance on the inner and the outer race, W. **Arguments:** `resistance`: moment against
    the roll at each contact, N m."""
    power = system.arcs.by_race(jnp.asarray(system.arcs.senses * resistance * state.races.roll))
    return system.multiplicity * jnp.sum(jnp.stack(power), axis=1)


def _ball_torques(
    system: AbstractBallEquations, state: BallsState, forward: Array, about: Array, resistances: tuple[Array, ...]
) -> tuple[Array, Array]:
    """Torques that drive the inner and the outer ring against the friction of the balls, N m.

    **Arguments:** loads on each ball at each contact (first axis): `forward`: force along the orbit, N; `about`: moment
    about the normal, N m; `resistances`: moments against the roll, N m."""
    motion, senses = system.kinematics, system.arcs.senses
    sine, cosine = jnp.sin(state.angle), jnp.cos(state.angle)
    radius = 0.5 * motion.pitch_diameter * (1.0 - senses * motion.ratio * cosine)
    # n_i . e_x = -sin, n_o . e_x = sin; b_i . e_x = -cos, b_o . e_x = cos
    torque = forward * radius - senses * about * sine
    for resistance in resistances:
        torque = torque + senses * (senses * resistance) * cosine
    inner, outer = (system.multiplicity * jnp.sum(on_race) for on_race in system.arcs.by_race(torque))
    return inner, outer


def _released(scene: BallBearing, system: Balls, result: NewtonResult) -> tuple[Balls, ArrowPoint]:
    """The equations and the unknowns with all balls and all five degrees of freedom of the ring, even if only one ball
    or fewer degrees of freedom were solved for."""
    count = scene.geometry.n_balls
    azimuth = azimuths(scene.geometry, count)
    released = system.ring.released(system.load_scale())
    row = row_of(azimuth, released, system.grooves.turning, system.exact, 1)
    full = dataclasses.replace(system, **row._asdict())
    globals_ = system.ring.released_unknowns(result.point.globals)
    return full, ArrowPoint(_wide(result.point.elements, count), globals_)


def _wide(values: Array, count: int) -> Array:
    return jnp.broadcast_to(values, (*values.shape[:-1], count))


def _dry_port(scene: BallBearing, system: BallCore, result: NewtonResult) -> tuple[Port, BallState]:
    """Reaction and stiffness for all five degrees of freedom of the ring, and the state of all balls, from one
    evaluation of the frictionless equations."""
    full, point = _released(scene, system, result)
    return _port_anew(full, point, full.seen, system.freedoms)


def _port_anew(
    full: Balls,
    point: ArrowPoint,
    element: Callable[[Array, Array], tuple[Array, Array, Seen]],
    freedoms: tuple[str, ...],
) -> tuple[Port, Seen]:
    """Reaction and stiffness for all degrees of freedom of the ring, from derivatives of `element`, and the third
    result of `element`.

    **Arguments:** `full`, `point`: equations and unknowns of `_released`; `element`: function of the unknowns of the
    balls and the shared unknowns; `freedoms`: names of the degrees of freedom that were solved for."""
    values, tangents, seen = element_tangents(element, point.elements, seen_by_elements(full, point))
    equations, jacobian = assembled(full, point, values, tangents, jnp.zeros(()))
    force = equations.residual.globals[:5] * full.load_scale() + full.ring.load
    return full.ring.port(jacobian, force, full.load_scale(), freedoms), seen


def _port(
    scene: BallBearing, system: LubricatedBallSystem | ArchedBallSystem, result: NewtonResult, film: PointFilm
) -> Port:
    """Reaction and stiffness for all five degrees of freedom of the ring of a lubricated bearing."""
    if isinstance(system, ArchedBallSystem):
        every, point = _released(scene, system, result)
        return _port_anew(every, point, every.element, system.freedoms)[0]
    full, point = _released(scene, system, result)
    if full.bent:
        return _port_anew(full, point, full.element, system.freedoms)[0]
    # a ring that cannot tilt only moves the groove centres: at given unknowns of the balls the films do not change
    kept = None if full.exact else jax.tree.map(lambda values: _wide(values, scene.geometry.n_balls), film)
    jacobian, force = _all_freedoms(full, point, result.jacobian, len(system.freedoms), system.multiplicity, kept)
    return full.ring.port(jacobian, force, full.load_scale(), system.freedoms)


def _all_freedoms(
    full: LubricatedBallSystem,
    point: ArrowPoint,
    solved: ArrowJacobian,
    freedoms: int,
    multiplicity: int,
    film: PointFilm | None,
) -> tuple[ArrowJacobian, Float[Array, "5"]]:
    """The Jacobian with all five degrees of freedom of the ring, from the Jacobian of the solve, and the forces on the
    degrees of freedom, N.

    Displacements of the ring only move the groove centres, so the expensive friction derivatives of the solve are
    reused. The rotation of the inner race under a sliding ball by a tilt is left out here.

    **Arguments:** `full`: the equations of all balls with five degrees of freedom; `solved`: Jacobian of the solve;
    `freedoms`: number of degrees of freedom of the ring in the solve; `multiplicity`: number of balls for which each
    ball of the solve stands; `film`: films of the contacts if they do not depend on the ring, else `None`.
    """
    m, count = point.elements.shape
    g = point.globals.shape[0]
    shared = jnp.broadcast_to(point.globals[:, None], (g, count))

    def light(v):
        state = full.frictionless(v[:m], v[m:], film)
        return jnp.concatenate([state.fit, state.on_ring])

    v = jnp.concatenate([point.elements, shared])
    seeds = jnp.broadcast_to(jnp.eye(m + g)[:, :, None], (m + g, m + g, count))
    push = lambda seed: jax.jvp(light, (v,), (seed,))
    values, tangents = jax.vmap(push, out_axes=(None, 0))(seeds)
    tangents = jnp.swapaxes(tangents, 0, 1)
    wide = lambda values: jnp.broadcast_to(values, (*values.shape[:-1], count))
    by_ring = jnp.zeros((m, 5, count)).at[:2].set(tangents[:2, m : m + 5])
    cage = solved.chain[freedoms:, freedoms:]
    chain = jnp.zeros((g, 5 + cage.shape[1])).at[:5, :5].set(jnp.eye(5) / full.load_scale())
    corner = jnp.zeros((g, g)).at[:5].set(jnp.sum(tangents[2:, m:], axis=-1) / full.load_scale())
    jacobian = ArrowJacobian(
        local=wide(solved.local),
        right_border=jnp.concatenate([by_ring, wide(solved.right_border[:, freedoms:])], axis=1),
        contributions=jnp.concatenate([tangents[2:, :m], wide(solved.contributions[freedoms:]) / multiplicity]),
        corner=corner.at[5:, 5:].set(solved.corner[freedoms:, freedoms:]),
        chain=chain.at[5:, 5:].set(cage),
    )
    return jacobian, jnp.sum(values[2:], axis=-1)
