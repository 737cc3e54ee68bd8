"""Steady state of a cylindrical roller bearing with dry, frictionless rollers that tilt, and what lubricated rollers
that tilt share with it: loads along the rollers, reaction of the ring, results."""

import dataclasses
from typing import Any

import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from ...contacts import AbstractTiltedLine, LineContact
from ...numerics.arrow import ArrowPoint, linearize
from ...numerics.convex import Minimum
from ...numerics.newton import NewtonOptions, NewtonResult, newton_solve
from ...numerics.safe import largest
from ...numerics.status import Status
from ..assemble import Results, assemble
from ..elastic_ring import UNSUPPORTED
from ..facts import MEAN_OF_LINE, RACEWAYS, Contacts, Facts
from ..interactions import FrictionTotals
from ..parts import azimuths
from ..profile import own_laminae, pressed_load, roller_line
from ..rating import rated_laminae
from ..ring import InnerRing, Port
from ..ring_shape import out_of_round
from ..rings import AbstractBetweenRings
from ..solution import FailureCause, LaminaLoads, Solution
from .kinematics import roller_kinematics
from .lubricated_tilt import LubricatedTiltingSystem
from .ring import bending_rings, roller_ring
from .scene import CylindricalRollerBearing
from .solution import PowerLoss, RollerResults
from .tilting import TiltingRollers, TiltingState


def build_tilting(scene: CylindricalRollerBearing, ring: InnerRing | None = None) -> TiltingRollers:
    """Equations of a scene. **Arguments:** `ring`: inner ring to use instead of the one at the operating point."""
    geometry = scene.geometry
    azimuth = azimuths(geometry, geometry.n_rollers)
    length = jnp.asarray(geometry.loaded_length)
    columns = _columns(azimuth, length)
    if ring is None:
        ring = roller_ring(scene, length)
    line = roller_line(scene.profile, scene.materials.race_modulus, length)
    motion = roller_kinematics(scene.geometry, scene.operation)
    held = jnp.einsum("f,fcn->cn", ring.held, columns)
    form, bent = out_of_round(scene.inner_roundness, scene.outer_roundness, azimuth), bending_rings(scene, azimuth)
    if form is not None:
        held = held.at[0].add(form)
    system = TiltingRollers(
        line=line,
        azimuth=azimuth,
        columns=ring.of_unknown(columns),
        held=held if ring.expansion is None else held.at[0].add(ring.expansion),
        ring=ring,
        radial_clearance=jnp.asarray(geometry.diametral_clearance) / 2.0,
        centrifugal=scene.roller_mass * motion.pitch_radius * jnp.square(motion.free_orbit),
        guess=None,
        outer=bent.outer,
        inner=bent.inner,
    )
    if not ring.needs_held_load:
        return system
    pressed = system.held[0] - system.radial_clearance
    load = jnp.sum(pressed_load(jnp.asarray(line.stiffness), length, pressed, system.held[1]))
    if system.outer is not None:
        load = load + system.outer.given_load()
    return dataclasses.replace(system, ring=ring.with_held_load(load))


def _columns(azimuth: Float[Array, " roller"], lever: Array) -> Float[Array, "5 2 roller"]:
    """Displacement of the inner race towards each roller, and its slope along the roller, for a unit of each degree of
    freedom in `RING_FREEDOMS`. The unit of a tilt is a length: the tilt times `lever`, m. The axial displacement has no
    effect on the rollers."""
    zero, cosine, sine = jnp.zeros_like(azimuth), jnp.cos(azimuth), jnp.sin(azimuth)
    pairs = ((zero, zero), (cosine, zero), (sine, zero), (zero, -cosine / lever), (zero, -sine / lever))
    return jnp.stack([jnp.stack(pair) for pair in pairs])


def solve_tilting(scene: CylindricalRollerBearing, options: NewtonOptions, ring: InnerRing | None = None) -> Solution:
    """Solves for the steady state. The function is pure and can be jitted, vmapped and differentiated. A failed solve
    does not raise. **Arguments:** `ring`: inner ring to use instead of the one at the scene's operating point."""
    started, minimum = build_tilting(scene, ring).started()
    system, result = newton_solve(started, options)
    return assembled(
        scene,
        system,
        none_outside(result, minimum),
        _results(scene, system, system.at(result.point)),
        port_of(system, build_tilting(scene, system.ring.released(system.load_scale())), result.point),
        minimum.steps + result.iterations,
        ring_freedom=scene.shown_freedoms if ring is None else scene.modelled_freedoms,
        stiffness_freedom=scene.modelled_freedoms,
        equation_names=system.equation_names(),
    )


def none_outside(result: NewtonResult, minimum: Minimum) -> NewtonResult:
    """The result with the status of a bearing without equilibrium, if the dry bearing has none either."""
    none = ~result.converged & minimum.outside
    return result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status))


def assembled(
    scene: CylindricalRollerBearing,
    system: AbstractBetweenRings,
    result: NewtonResult,
    results: Results[RollerResults, PowerLoss],
    port: Port,
    steps: Int[Array, ""],
    **names: Any,
) -> Solution:
    """Builds the solution, with the results of flexible rings. **Arguments:** `steps`: Newton steps of all solves;
    others as in `assemble.assemble`."""
    results = results._replace(**system.bent.results(system.amplitudes(result.point.globals)))
    causes = {}
    if system.outer is not None:
        result, none = system.outer.judged(system.ring, result)
        causes, steps = {UNSUPPORTED: FailureCause(none, jnp.zeros(0))}, jnp.where(none, 0, steps)
    ring = system.ring.displacement(result.point.globals)
    return assemble(scene, result, results, ring, port, failure_causes=causes, iterations=steps, **names)


def _results(
    scene: CylindricalRollerBearing, system: TiltingRollers, state: TiltingState
) -> Results[RollerResults, PowerLoss]:
    motion, ones = roller_kinematics(scene.geometry, scene.operation), jnp.ones_like(system.azimuth)
    contact = scene.race_lines(None)
    laminae, peaks, rated = loads_along(scene, system.line, contact, state.approach, state.slope)
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=state.load[0],
        load_outer=state.load[1],
        pressure_inner=peaks[0],
        pressure_outer=peaks[1],
        orbital_speed=motion.free_orbit * ones,
        spin_speed=motion.free_spin * ones,
    )
    facts = Facts((Contacts(RACEWAYS, state.load, peaks, MEAN_OF_LINE, laminae=laminae),))
    return Results(elements, FrictionTotals(PowerLoss()), facts, laminae=rated)


def loads_along(
    scene: CylindricalRollerBearing,
    line: AbstractTiltedLine,
    contact: LineContact,
    start: Float[Array, "2 roller"],
    slope: Float[Array, "2 roller"],
) -> tuple[Float[Array, "2 roller lamina"], Float[Array, "2 roller"], LaminaLoads]:
    """Loads along tilted rollers: of the laminae of the profile, N; largest pressures, Pa; loads of the laminae for the
    life. **Arguments:** `start`, m, and `slope`: of the approach along the rollers."""
    count, profile = own_laminae(scene.profile), scene.profile
    cut = lambda number: jnp.stack([line.of_race(side).laminae(start[side], slope[side], number) for side in (0, 1)])
    laminae = cut(count)
    rated = rated_laminae(scene.rating, count)
    inner, outer = laminae if rated == count else cut(rated)
    if profile is None:
        # the load per length of a straight roller is largest at one of its ends
        ends = jnp.asarray([0.0, 1.0])[:, None, None]
        most = largest(line.load_per_length(start[None], slope[None], ends), axis=0) * contact.length
    else:
        most = largest(laminae, axis=2) * count
    peaks = jnp.where(most > 0, contact.hertz_pressure(jnp.where(most > 0, most, 1.0)), 0.0)
    profiled = profile is not None and profile.shape is not None
    return laminae, peaks, LaminaLoads(inner, outer, profiled)


def port_of(
    system: TiltingRollers | LubricatedTiltingSystem,
    full: TiltingRollers | LubricatedTiltingSystem,
    point: ArrowPoint,
) -> Port:
    """Reaction and stiffness of the ring, with the rollers and the cage in equilibrium. **Arguments:** `full`: the
    equations with all degrees of freedom of the ring as unknowns; `point`: equilibrium of `system`."""
    place = ArrowPoint(point.elements, system.ring.released_unknowns(point.globals))
    equations, jacobian = linearize(full, place)
    force = full.of_freedoms(equations.residual.globals) * full.load_scale() + full.ring.load
    port = full.ring.port(jacobian, force, full.load_scale(), system.freedoms)
    # nothing holds the ring axially: the artificial springs of the unknowns must not count
    held = jnp.asarray([0.0, 1.0, 1.0, 1.0, 1.0])
    return Port(port.force * held, port.stiffness * held[:, None] * held[None, :], port.free)
