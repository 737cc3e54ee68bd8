"""Steady state of a cylindrical roller bearing: from the scene to the equations, and from the root to the results."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import alike_modulus, palmgren_stiffness
from ...gaps import Flange, Pocket, PocketEdge
from ...numerics.arrow import ArrowPoint, condensed, linearize, schur_complement
from ...numerics.newton import NewtonOptions, NewtonResult, newton_solve
from ..assemble import Results
from ..computed import computed_results
from ..facts import MEAN_OF_LINE, RACEWAYS, Contacts, Facts
from ..inlet import oil_elsewhere, oil_of_races, oil_temperature
from ..interactions import FrictionTotals, friction_totals
from ..mixed import boundary_power, mixed_results
from ..parts import azimuths
from ..profile import pressed_load
from ..ring import LENGTH_UNIT, InnerRing, Port
from ..ring_shape import out_of_round, shaped_parts
from ..solution import Solution
from .dry import DryRollerSystem
from .equations import AbstractLubricatedRollers, LubricatedRollerSystem
from .forces import CageParts, drag_of, rolling_alone
from .in_plane import IN_PLANE, outward
from .kinematics import RollerKinematics, roller_kinematics
from .loads import LEAST_LOAD
from .lubricated_tilt import FRICTION_LAMINAE, LubricatedTiltingSystem, least_films
from .ring import bending_rings, roller_ring
from .scene import CylindricalRollerBearing
from .solution import PowerLoss, RollerResults, SolvedRollers
from .tilting import TiltingRollers
from .tilting_steady import assembled, build_tilting, loads_along, none_outside, port_of, solve_tilting

NOTHING_UNKNOWN = ("no unknown: given displacements are the whole state",)
"""Equation names of a system without unknowns."""


def build_system(scene: CylindricalRollerBearing) -> DryRollerSystem | LubricatedRollerSystem:
    """Equations of rollers that carry evenly along their length; everything that does not depend on the unknowns is
    computed here."""
    geometry, operation = scene.geometry, scene.operation
    azimuth = azimuths(geometry, geometry.n_rollers)
    cosines = outward(azimuth)
    ring = roller_ring(scene, scene.ring_lever)
    motion = roller_kinematics(geometry, operation)
    contact = scene.race_lines(None)
    clearance, held = jnp.asarray(geometry.diametral_clearance) / 2.0, None
    form, bent = out_of_round(scene.inner_roundness, scene.outer_roundness, azimuth), bending_rings(scene, azimuth)
    if ring.needs_held_load:
        held = jnp.einsum("f,fn->n", ring.held[1:3], cosines)
        stiffness = palmgren_stiffness(contact.length, alike_modulus(contact.reduced_modulus))
        pressed = held - clearance if form is None else held + form - clearance
        asked = pressed_load(stiffness, contact.length, pressed, jnp.zeros(()))
        asked = jnp.sum(asked) + LEAST_LOAD
        ring = ring.with_held_load(asked if bent.outer is None else asked + bent.outer.given_load())
    common = {
        "kinematics": motion,
        "contact": contact,
        "directions": cosines[ring.places - 1],
        "azimuth": azimuth,
        "ring": ring,
        "held": held,
        "out_of_round": form,
        "outer": bent.outer,
        "inner": bent.inner,
        "radial_clearance": clearance,
        "roller_mass": scene.roller_mass,
    }
    if scene.contact is None:
        return DryRollerSystem(**common)
    assert scene.oil is not None
    return LubricatedRollerSystem(
        **common,
        laws=scene.contact,
        oil=scene.oil,
        inlet=oil_of_races(scene),
        elsewhere=oil_elsewhere(scene),
        cage=cage_parts(scene, motion) if scene.slips else None,
    )


def cage_parts(scene: CylindricalRollerBearing, motion: RollerKinematics) -> CageParts:
    """Models of all forces on rollers and cage except those of the raceways."""
    cage, oil, geometry = scene.cage, scene.oil, scene.geometry
    assert oil is not None
    viscosity_at = lambda place: oil.viscosity.viscosity(0.0, jnp.asarray(oil_temperature(scene, place)))
    at_flanges = viscosity_at("flange")
    at_rails = at_flanges if scene.oil_temperatures is None else viscosity_at("element_ends")
    rails = None
    if cage is not None and cage.pocket_axial_clearance is not None:
        edge = PocketEdge(
            inner_radius=jnp.asarray(cage.bore(geometry)) / 2.0,
            outer_radius=jnp.asarray(cage.outside(geometry)) / 2.0,
            side_clearance=jnp.asarray(cage.pocket_axial_clearance) / 2.0,
            pitch_radius=motion.pitch_radius,
            roller_radius=motion.roller_radius,
        )
        rails = edge.coefficients(at_rails)

    def flange(ring: str, race: Array, outward: float):
        part = scene.flange
        if part is None or part.ring not in (ring, "both"):
            return None
        return Flange(
            race_radius=race,
            rim_radius=race + outward * part.rim_height(geometry),
            side_clearance=jnp.asarray(part.axial_clearance) / 2.0,
            angle=jnp.asarray(part.angle),
            pitch_radius=motion.pitch_radius,
            roller_radius=motion.roller_radius,
        ).coefficients(at_flanges)

    drag, density = drag_of(scene)
    pocket = None
    if cage is not None:
        pocket = Pocket(
            clearance=jnp.asarray(cage.pocket_clearance),
            length=jnp.asarray(geometry.roller_length),
            roller_radius=motion.roller_radius,
        )
    return CageParts(
        pocket=pocket,
        land=None if cage is None else cage.land(geometry),
        guidance="inner_ring" if cage is None else cage.guidance,
        rails=rails,
        inner_flange=flange("inner", motion.inner_radius, 1.0),
        outer_flange=flange("outer", motion.outer_radius, -1.0),
        drag=drag,
        drag_density=density,
    )


def solve_rollers(
    scene: CylindricalRollerBearing,
    options: NewtonOptions,
    ring: InnerRing | None = None,
    exact_tilt: bool | None = None,
) -> Solution:
    """Solves for the steady state, with rollers that carry evenly along their length or with rollers that tilt. The
    loads that the flanges carry follow from the solution.

    **Arguments:** as `AbstractBearing.solve_ring`; `exact_tilt` has no effect, because rollers have no grooves.
    """
    evenly = ring is None and not scene.tilts
    if scene.contact is None and not scene.unknown_freedoms and not shaped_parts(scene):
        # dry rollers that carry evenly have no unknowns if the ring is held: the tilting model finds the same loads
        evenly = False
    if scene.slips and scene.cage is None:
        raise ValueError(
            "cage: without one a roller outside the loaded zone has no steady state; simulate can run this scene"
        )
    if evenly:
        solution = _solve_evenly(scene, options)
    elif scene.contact is None:
        solution = solve_tilting(scene, options, ring)
    else:
        solution = _solve_lubricated_tilt(scene, options, ring)
    flanges = scene.geometry.thrust_flanges
    return solution if flanges is None else flanges.hold(solution, scene.operation, ring)


def _solve_evenly(scene: CylindricalRollerBearing, options: NewtonOptions) -> Solution:
    """Steady state of rollers that carry evenly along their length."""
    system, result = newton_solve(build_system(scene), options)
    dry = isinstance(system, DryRollerSystem)
    results = _dry_results(system, result) if dry else _lubricated(scene, system, result)
    port = _port(system, result, results.elements.load_inner)
    return assembled(
        scene,
        system,
        result,
        results,
        port,
        result.iterations,
        ring_freedom=scene.shown_freedoms,
        stiffness_freedom=IN_PLANE if system.ring.needs_held_load else None,
        equation_names=system.equation_names() or NOTHING_UNKNOWN,
    )


def _solve_lubricated_tilt(scene: CylindricalRollerBearing, options: NewtonOptions, ring: InnerRing | None) -> Solution:
    """Steady state of lubricated rollers that tilt. The iteration starts at the equilibrium of the dry bearing."""
    dry, minimum = build_tilting(scene, ring).started()
    system, result = newton_solve(build_lubricated_tilt(scene, dry), options)
    released = system.ring.released(system.load_scale())
    return assembled(
        scene,
        system,
        none_outside(result, minimum),
        _lubricated(scene, system, result),
        port_of(system, build_lubricated_tilt(scene, build_tilting(scene, released)), result.point),
        minimum.steps + result.iterations,
        ring_freedom=scene.shown_freedoms if ring is None else scene.modelled_freedoms,
        stiffness_freedom=scene.modelled_freedoms,
        equation_names=system.equation_names(),
    )


def build_lubricated_tilt(scene: CylindricalRollerBearing, dry: TiltingRollers) -> LubricatedTiltingSystem:
    """Equations of lubricated rollers that tilt.

    **Arguments:** `dry`: the same bearing without films and friction, with its equilibrium as first guess, or without a
    guess for equations that are not solved.
    """
    assert scene.contact is not None
    assert scene.oil is not None
    motion = roller_kinematics(scene.geometry, scene.operation)
    return LubricatedTiltingSystem(
        dry=dry,
        ring=dry.ring,
        outer=dry.outer,
        inner=dry.inner,
        azimuth=dry.azimuth,
        heavier=jnp.ones(()),
        kinematics=motion,
        contact=scene.race_lines(None),
        laws=scene.contact,
        oil=scene.oil,
        inlet=oil_of_races(scene),
        roller_mass=scene.roller_mass,
        cage=cage_parts(scene, motion) if scene.slips else None,
        elsewhere=oil_elsewhere(scene),
        laminae=FRICTION_LAMINAE if scene.profile is None else scene.profile.n_laminae,
    )


def _port(
    system: DryRollerSystem | LubricatedRollerSystem, result: NewtonResult, load: Float[Array, " roller"]
) -> Port:
    """Reaction and stiffness of the ring, with everything else in equilibrium.

    They cover the unknown degrees of freedom or, if a displacement is given, all degrees of freedom of the model.

    **Arguments:** `load`: on the inner race, N.
    """
    jacobian, shown = result.jacobian, system
    if system.ring.needs_held_load:
        shown = system.in_plane()
        moved = system.ring.moved(result.point.globals[: len(system.freedoms)])[shown.ring.places] / LENGTH_UNIT
        others = result.point.globals[len(system.freedoms) :]
        place = ArrowPoint(result.point.elements, jnp.concatenate([moved, others]))
        jacobian = linearize(shown, place)[1]
    free = shown.ring.places
    ring = condensed(schur_complement(jacobian), len(free)) * (shown.load_scale() / LENGTH_UNIT)
    force = jnp.zeros(5).at[free].set(jnp.sum(load[None, :] * shown.directions, axis=1))
    return Port(force, jnp.zeros((5, 5)).at[free[:, None], free[None, :]].set(ring), system.freedoms)


def _dry_results(system: DryRollerSystem, result: NewtonResult) -> Results[RollerResults, PowerLoss]:
    load, _ = system.loads(system.inward_shift(result.point))
    motion, ones = system.kinematics, jnp.ones_like(system.azimuth)
    pressure = jnp.where(load > 0, system.contact.hertz_pressure(load), 0.0)
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=load[0],
        load_outer=load[1],
        pressure_inner=pressure[0],
        pressure_outer=pressure[1],
        orbital_speed=motion.free_orbit * ones,
        spin_speed=motion.free_spin * ones,
    )
    facts = Facts((Contacts(RACEWAYS, load, pressure, MEAN_OF_LINE),))
    return Results(elements, FrictionTotals(PowerLoss()), facts)


def _lubricated(
    scene: CylindricalRollerBearing, system: AbstractLubricatedRollers, result: NewtonResult
) -> Results[RollerResults, PowerLoss]:
    state, motion = system.at(result.point), system.kinematics
    contact, pocket, rise = state.contact, state.pocket, state.contact.temperature_rise
    mixed = system.mixed(state)
    along, opening, laminae, rated, more = state.pressed.along, state.pressed.opening, None, None, {}
    if isinstance(system, LubricatedTiltingSystem):
        assert along is not None
        laminae, pressure, rated = loads_along(scene, system.dry.line, system.contact, along.start, along.slope)
        more = least_films(state)
        opening = opening - 0.5 * system.dry.line.length * jnp.abs(jnp.sum(along.slope, axis=0))
    else:
        pressure = system.contact.hertz_pressure(state.load)
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=state.load[0],
        load_outer=state.load[1],
        pressure_inner=pressure[0],
        pressure_outer=pressure[1],
        orbital_speed=state.orbital_speed,
        spin_speed=state.spin_speed,
        film_inner=contact.film[0],
        film_outer=contact.film[1],
        temperature_rise_inner=None if rise is None else rise[0],
        temperature_rise_outer=None if rise is None else rise[1],
        sliding_inner=state.sliding_speed[0],
        sliding_outer=state.sliding_speed[1],
        traction_inner=None if contact.traction is None else contact.traction[0],
        traction_outer=None if contact.traction is None else contact.traction[1],
        pocket_film_front=None if pocket is None else pocket.film_front,
        pocket_film_rear=None if pocket is None else pocket.film_rear,
        pocket_load_front=None if pocket is None else pocket.load_front,
        pocket_load_rear=None if pocket is None else pocket.load_rear,
        **more,
        **mixed_results(mixed),
        **computed_results(RollerResults, SolvedRollers(system, state)),
    )
    contacts = Contacts(
        RACEWAYS,
        state.load,
        pressure,
        MEAN_OF_LINE,
        laws=system.laws,
        inlet=system.inlet,
        mean_speed=state.mean_speed,
        sliding=state.sliding_speed,
        temperature=None if rise is None else system.inlet.temperature + rise,
        load_share=None if mixed is None else mixed.share,
        laminae=laminae,
        starved=contact.supply,
    )
    facts = Facts((contacts,), opening=opening)
    if system.cage is None:
        totals = rolling_alone(system.contact, motion, contact.rolling_force)
        return Results(elements, totals, facts, laminae=rated)

    land = system.land_at(result.point, state)
    cage = system.cage_state(result.point, land)
    totals = friction_totals(PowerLoss, system.interactions(state, land), motion)
    return Results(elements, totals, facts, cage=cage, laminae=rated, boundary_power=boundary_power(mixed))
