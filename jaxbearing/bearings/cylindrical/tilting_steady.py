r"""Steady state of a cylindrical roller bearing with tilting, profiled rollers.

The load distribution is dry and frictionless. Loads are integrated in closed form along straight rollers, and over
laminae along a profile. If the scene has an oil and contact laws, films and rolling resistance follow from the loads,
for rolling without sliding: the laminae are short line contacts side by side, each with its own load per length. The
tractions that keep the rollers rolling follow from the balance of each roller, and the ring torques from the tractions.
"""

import dataclasses

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...contacts.laws import ContactState
from ...contacts.oil_supply import Starvation
from ...lubricants import InletOil
from ...numerics.arrow import ArrowPoint, linearize
from ...numerics.newton import NewtonOptions, newton_solve
from ...numerics.status import Status
from ..assemble import Results, assemble
from ..elastic_ring import UNSUPPORTED
from ..facts import MEAN_OF_LINE, RACEWAYS, Contacts, Facts
from ..inlet import oil_of_races
from ..parts import azimuths
from ..profile import own_laminae, pressed_load, roller_line
from ..rating import rated_laminae
from ..ring import InnerRing, Port
from ..ring_shape import out_of_round
from ..solution import FailureCause, LaminaLoads, Solution
from .forces import rolling_alone
from .kinematics import RollerKinematics, roller_kinematics
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
    mass = scene.materials.rollers.density * jnp.pi * motion.roller_radius**2 * geometry.roller_length
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
        centrifugal=mass * motion.pitch_radius * jnp.square(motion.free_orbit),
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
    none = ~result.converged & minimum.outside
    result = result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status))
    results, causes, steps = _results(scene, system, system.at(result.point)), {}, minimum.steps + result.iterations
    results = results._replace(**system.bent.results(system.amplitudes(result.point.globals)))
    if system.outer is not None:
        result, none = system.outer.judged(system.ring, result)
        causes, steps = {UNSUPPORTED: FailureCause(none, jnp.zeros(0))}, jnp.where(none, 0, steps)
    return assemble(
        scene,
        result,
        results,
        system.ring.displacement(result.point.globals),
        _port(scene, system, result.point),
        failure_causes=causes,
        iterations=steps,
        ring_freedom=scene.shown_freedoms if ring is None else scene.modelled_freedoms,
        stiffness_freedom=scene.modelled_freedoms,
        equation_names=system.equation_names(),
    )


def _results(
    scene: CylindricalRollerBearing, system: TiltingRollers, state: TiltingState
) -> Results[RollerResults, PowerLoss]:
    motion, zero, ones = (
        roller_kinematics(scene.geometry, scene.operation),
        jnp.zeros(()),
        jnp.ones_like(system.azimuth),
    )
    count = own_laminae(scene.profile)
    cut = lambda number: jnp.stack(
        [system.line.of_race(side).laminae(state.approach[side], state.slope[side], number) for side in (0, 1)]
    )
    laminae = cut(count)
    rated = rated_laminae(scene.rating, count)
    inner_laminae, outer_laminae = laminae if rated == count else cut(rated)
    curvatures = jnp.stack([1.0 / motion.inner_radius, -1.0 / motion.outer_radius])
    contact = LineContact(
        (1.0 / (1.0 / motion.roller_radius + curvatures))[:, None],
        jnp.asarray(system.line.length),
        scene.materials.race_modulus,
    )
    if scene.profile is None:
        # the load per length of a straight roller is largest at one of its ends
        ends = jnp.asarray([0.0, 1.0])[:, None, None]
        per_length = system.line.load_per_length(state.approach[None], state.slope[None], ends)
        most = jnp.max(per_length, axis=0) * contact.length
    else:
        most = jnp.max(laminae, axis=2) * count
    peaks = jnp.where(most > 0, contact.hertz_pressure(jnp.where(most > 0, most, 1.0)), 0.0)
    more, rolling, starved = _films(scene, contact, motion, state.load, laminae)
    elements = RollerResults(
        azimuth=system.azimuth,
        load_inner=state.load[0],
        load_outer=state.load[1],
        pressure_inner=peaks[0],
        pressure_outer=peaks[1],
        orbital_speed=motion.free_orbit * ones,
        spin_speed=motion.free_spin * ones,
        **more,
    )
    profiled = scene.profile is not None and scene.profile.shape is not None
    totals = rolling_alone(contact, motion, rolling)
    contacts = Contacts(RACEWAYS, state.load, peaks, MEAN_OF_LINE, laminae=laminae)
    facts = Facts((contacts,))
    if scene.contact is not None and scene.oil is not None:
        rises = [more[name] for name in ("temperature_rise_inner", "temperature_rise_outer") if name in more]
        inlet = oil_of_races(scene)
        speed = motion.surface_speeds(zero, zero)[0][:, None]
        temperature = inlet.temperature + jnp.stack(rises) if rises else None
        contacts = contacts._replace(laws=scene.contact, inlet=inlet, mean_speed=speed, temperature=temperature)
        contacts = contacts._replace(starved=starved)
        facts = facts._replace(contacts=(contacts,))
    laminae = LaminaLoads(inner_laminae, outer_laminae, profiled)
    return Results(elements, totals, facts, laminae=laminae)


def _films(
    scene: CylindricalRollerBearing,
    contact: LineContact,
    motion: RollerKinematics,
    load: Float[Array, "2 roller"],
    laminae: Float[Array, "2 roller lamina"],
) -> tuple[dict[str, Array], Float[Array, "2 roller"] | None, Starvation | None]:
    """Films by the names of the results, rolling resistance of each contact, N, and its starvation.

    `film_*` are the films of whole contacts, with the load spread evenly over the length, m; `film_least_*` are the
    thinnest films of the laminae, m. Both are NaN for contacts without load.
    """
    laws, oil = scene.contact, scene.oil
    if laws is None or oil is None:
        return {}, None, None
    inlet = oil_of_races(scene)
    # laminae are the last axis
    along = lambda tree: jax.tree.map(lambda values: values[..., None] if jnp.ndim(values) else values, tree)
    inlet_along = along(inlet)
    speed = motion.surface_speeds(jnp.zeros(()), jnp.zeros(()))[0][:, None]

    def loaded(line: LineContact, load: Array, speed: Array, inlet: InletOil) -> tuple[Array, ContactState]:
        carries = load > 0
        safe = jnp.where(carries, load, 1.0)
        return carries, laws.evaluate(line, safe, speed + 0.0 * safe, 0.0 * safe, oil, inlet)

    carries, whole = loaded(contact, load, speed, inlet)
    radius, modulus = along((contact.reduced_radius, contact.reduced_modulus))
    each = LineContact(radius, contact.length / laminae.shape[2], modulus)
    if inlet.flow is not None:
        # the flow is shared equally by the laminae
        inlet_along = dataclasses.replace(inlet_along, flow=inlet.flow / laminae.shape[2])
    carried, parts = loaded(each, laminae, speed[..., None], inlet_along)
    blank = lambda values: jnp.where(carries, values, jnp.nan)
    film = blank(whole.film)
    least = blank(jnp.min(jnp.where(carried, parts.film, jnp.inf), axis=2))
    more = {"film_inner": film[0], "film_outer": film[1], "film_least_inner": least[0], "film_least_outer": least[1]}
    if whole.temperature_rise is not None:
        rise = blank(whole.temperature_rise)
        more |= {"temperature_rise_inner": rise[0], "temperature_rise_outer": rise[1]}
    if parts.rolling_force is None:
        return more, None, whole.supply
    return more, jnp.sum(jnp.where(carried, parts.rolling_force, 0.0), axis=2), whole.supply


def _port(scene: CylindricalRollerBearing, system: TiltingRollers, point: ArrowPoint) -> Port:
    """Reaction and stiffness of the ring, with the rollers in equilibrium."""
    full = build_tilting(scene, system.ring.released(system.load_scale()))
    place = ArrowPoint(point.elements, system.ring.released_unknowns(point.globals))
    equations, jacobian = linearize(full, place)
    force = full.of_freedoms(equations.residual.globals) * full.load_scale() + full.ring.load
    port = full.ring.port(jacobian, force, full.load_scale(), system.freedoms)
    # nothing holds the ring axially: the artificial springs of the unknowns must not count
    held = jnp.asarray([0.0, 1.0, 1.0, 1.0, 1.0])
    return Port(port.force * held, port.stiffness * held[:, None] * held[None, :], port.free)
