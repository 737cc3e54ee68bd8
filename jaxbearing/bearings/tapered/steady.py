"""Steady state of a tapered roller bearing: from the scene to the equations, and from the root to the results."""

import dataclasses
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from ...contacts import LineContact, lamina_points
from ...numerics.arrow import ArrowPoint, linearize
from ...numerics.newton import NewtonOptions, NewtonResult, newton_solve
from ...numerics.safe import largest, safe_norm
from ...numerics.status import Status
from ..assemble import Results, assemble
from ..computed import computed_results
from ..elastic_ring import UNSUPPORTED
from ..facts import MEAN_OF_LINE, MEAN_OF_POINT, RACEWAYS, Contacts, Facts
from ..inlet import oil_elsewhere, oil_of, oil_of_races
from ..interactions import friction_totals
from ..mixed import boundary_power, mixed_results
from ..parts import azimuths
from ..profile import own_laminae
from ..rating import rated_laminae
from ..ring import InnerRing, Port
from ..solution import RING_FREEDOMS, BoundaryPower, FailureCause, LaminaLoads, Solution
from .build import TaperedMotion, build_tapered, rolling_motion
from .friction import TaperedFriction, tapered_friction
from .scene import TaperedRollerBearing
from .skidding import SkiddingSystem, build_skidding, skidding_friction
from .solution import SolvedTapered, TaperedPowerLoss, TaperedResults
from .system import Inertia, TaperedState, TaperedSystem

ROUNDED_UP = 2e-6
"""Fraction by which a printed lower bound is raised, so that its value rounded to six digits still satisfies it."""
ROUNDING = 1e-9
"""Relative round-off of the moments in `tips_over`: cases closer to the bound than this are left to the solve."""
HIGHEST = 9.0
"""Number 1/(10/9 - 1) in the formula of `line_pressure`."""


def solve_tapered(
    scene: TaperedRollerBearing, options: NewtonOptions, ring: InnerRing | None = None, exact_tilt: bool | None = None
) -> Solution:
    """Solves for the steady state. The function is pure and can be jitted, vmapped and differentiated. A failed solve
    does not raise.

    The status is `no_equilibrium` if no equilibrium is found and there is a proof that none exists. There are two
    proofs. The first needs the loads only: they are beyond a static bound (`slides_out`, `tips_over`). The second is
    that the cone, with all else in equilibrium, is still pushed further at a tilt of 0.1 rad or at a displacement of
    the apex distance (`numerics.convex.find_minimum`). Rollers that may skid have centrifugal forces and gyroscopic
    moments that the loads do not tell: for them the only proof is `slides_out`, without these forces.

    **Arguments:** as `AbstractBearing.solve_ring`; `exact_tilt` has no effect, because rollers have no grooves.
    """
    asked = build_tapered(scene, ring)
    # what is known of the inertia forces: those of rollers that may skid are smaller, if they orbit more slowly
    known = asked.inertia.times(0.0) if scene.slips else asked.inertia
    bounded, sliding = _bounded(scene, ring), jnp.asarray(False)
    if bounded:
        sliding = slides_out(scene, known)
        sliding = sliding if scene.slips else sliding | tips_over(scene)
    # loads without equilibrium are replaced by loads with one: a few steps then lead to finite values and derivatives
    easy = jnp.where(sliding, _axial_only(asked), asked.ring.load)
    begun = dataclasses.replace(asked, ring=asked.ring.under(easy))
    if scene.slips and bounded:
        begun = dataclasses.replace(begun, inertia=asked.inertia.times(_held_part(scene, asked.inertia)))
    started, minimum = begun.started(sliding)
    if scene.slips:
        system, result = newton_solve(build_skidding(scene, started, jnp.where(sliding, 0.0, 1.0)), options)
        none = sliding
    else:
        system, result = newton_solve(started, options)
        none = sliding | (~result.converged & minimum.outside)
    result = result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status))
    result = result._replace(residual_norm=jnp.where(sliding, jnp.nan, result.residual_norm))
    friction = None
    if isinstance(system, SkiddingSystem):
        dry, solved = system.dry, system.at(result.point)
        state, motion = solved.pressed.contacts, TaperedMotion(solved.orbital_speed, solved.spin_speed)
        friction = skidding_friction(system, result, solved)
    else:
        dry = system
        state, motion = system.at(result.point), rolling_motion(scene.geometry, scene.operation)
        if scene.contact is not None:
            friction = tapered_friction(scene, state)
    if friction is not None:
        result = _with_nested(result, friction, options)
    results = _results(scene, dry, result.point.elements[:3], state, motion, friction)
    causes, steps = _reasons(scene, known) if bounded else {}, minimum.steps + result.iterations
    results = results._replace(**system.bent.results(system.amplitudes(result.point.globals)))
    if system.outer is not None:
        result, unsupported = system.outer.judged(system.ring, result)
        causes = causes | {UNSUPPORTED: FailureCause(unsupported, jnp.zeros(0))}
        sliding = sliding | unsupported
    return assemble(
        scene,
        result,
        results,
        system.ring.displacement(result.point.globals),
        _port(scene, system, result),
        failure_causes=causes,
        iterations=jnp.where(sliding, 0, steps),
        ring_freedom=scene.shown_freedoms if ring is None else RING_FREEDOMS,
        stiffness_freedom=RING_FREEDOMS,
        equation_names=system.equation_names(),
    )


def _bounded(scene: TaperedRollerBearing, ring: InnerRing | None) -> bool:
    """True if the static bounds apply, because all loads are given and no displacements."""
    return ring is None and not scene.operation.displaced


def slides_out(scene: TaperedRollerBearing, inertia: Inertia) -> Bool[Array, ""]:
    r"""True if $F_a < F_r\tan\alpha_o + ZQ_c\sin\alpha_o$, with $Q_c = F_c\cos\alpha_f/\cos(\alpha_o - \alpha_f)$.
    There is then no equilibrium at any tilt.

    All rollers press on the cup at the angle $\alpha_o$, and the centrifugal forces of two or more rollers cancel (for
    a single roller nothing is proved). Hence $F_a - F_r\tan\alpha_o = \sin\alpha_o\sum Q_o(1 - \cos\psi)$. $Q_c$ is
    the smallest possible load $Q_o$ on the cup: that of a roller whose centrifugal force is carried by cup and rib
    alone.
    """
    if scene.geometry.n_rollers < 2:
        return jnp.asarray(False)
    return jnp.asarray(scene.operation.axial_load) < least_axial_load(scene, inertia)


def _held_part(scene: TaperedRollerBearing, inertia: Inertia) -> Float[Array, ""]:
    """The part of the inertia forces with which rollers that may skid have a dry equilibrium, where the iteration
    starts: with it, `least_axial_load` is at most in the middle between the given axial load and that without inertia
    forces."""
    nothing = least_axial_load(scene, inertia.times(0.0))
    needed = least_axial_load(scene, inertia) - nothing
    spare = jnp.maximum(0.5 * (jnp.asarray(scene.operation.axial_load) - nothing), 0.0)
    return jax.lax.stop_gradient(jnp.where(needed > spare, spare / jnp.where(needed > spare, needed, 1.0), 1.0))


def least_axial_load(scene: TaperedRollerBearing, inertia: Inertia) -> Float[Array, ""]:
    """Bound in `slides_out`, N: a smaller axial load cannot hold the cone in the cup."""
    geometry = scene.geometry
    cup, rib = jnp.asarray(geometry.contact_angle), jnp.asarray(geometry.rib_angle)
    least = inertia.force * jnp.cos(rib) / jnp.cos(cup - rib)
    return scene.operation.radial_size * jnp.tan(cup) + geometry.n_rollers * least * jnp.sin(cup)


def tips_over(scene: TaperedRollerBearing) -> Bool[Array, ""]:
    r"""True if the given moments are larger than the cup can hold. There is then no equilibrium at any tilt.

    The moment about the apex (`moment` minus the radial load times `load_position`) is $M = \sum\rho Q_o\cos\psi$,
    where each load acts at a distance $\rho$ between d - l and d from the apex. The forces are $F_r =
    \cos\alpha_o\sum Q_o\cos\psi$ and $F_a = \sin\alpha_o\sum Q_o$. Therefore $|M - (d - l/2)F_r/\cos\alpha_o| \le
    (l/2)F_a/\sin\alpha_o$. If the moment about the load line is given as well, the bound holds for the length of the
    plane vector of both differences. The centrifugal and gyroscopic loads of two or more rollers cancel.
    """
    ranges = _moment_ranges(scene)
    if scene.geometry.n_rollers < 2 or not ranges:
        return jnp.asarray(False)
    beyond = [span.moment - span.middle for span in ranges.values()]
    size = jnp.abs(beyond[0]) if len(beyond) == 1 else safe_norm(beyond[0], beyond[1])
    rounding = sum(jnp.abs(span.moment) + jnp.abs(span.middle) for span in ranges.values())
    return size > next(iter(ranges.values())).most + ROUNDING * rounding


class _MomentRange(NamedTuple):
    """A given moment and the range in which it must lie, N m.

    - `moment`: given moment, about the apex.
    - `middle`, `most`: middle and half width of the range.
    - `shift`: difference of the moments about the reference point and about the apex.
    """

    moment: Array
    middle: Array
    most: Array
    shift: Array


def _moment_ranges(scene: TaperedRollerBearing) -> dict[str, _MomentRange]:
    """Ranges of the given moments, by their names. The range of `moment` depends on the radial load, that of the moment
    about the load line on the lateral load."""
    operation, geometry = scene.operation, scene.geometry
    cup, length = jnp.asarray(geometry.contact_angle), jnp.asarray(geometry.roller_length)
    most = 0.5 * length * jnp.asarray(operation.axial_load) / jnp.sin(cup)
    ranges = {}
    moments = {
        "moment": (operation.moment, operation.radial_load),
        "moment about the load line": (operation.moment_lateral, operation.radial_load_lateral),
    }
    for name, (moment, load) in moments.items():
        if moment is not None:
            force = jnp.asarray(0.0 if load is None else load)
            shift = jnp.asarray(operation.load_position) * force
            middle = (geometry.apex_distance - 0.5 * length) * force / jnp.cos(cup)
            ranges[name] = _MomentRange(jnp.asarray(moment) - shift, middle, most, shift)
    return ranges


def _reasons(scene: TaperedRollerBearing, inertia: Inertia) -> dict[str, FailureCause]:
    """Possible causes of a failed solve: loads beyond the static bounds, with the bounds."""
    sliding, least = slides_out(scene, inertia), least_axial_load(scene, inertia)
    tipping = jnp.asarray(False) if scene.slips else tips_over(scene) & ~sliding
    axial_load = jnp.asarray(scene.operation.axial_load)
    causes = {
        "the axial load of {:.6g} N must be at least {:.6g} N to hold the cone in the cup; where an opposed bearing "
        "gives it, operation.displacement.axial in its place holds the cone": FailureCause(
            sliding, jnp.stack([axial_load, least * (1.0 + ROUNDED_UP)])
        )
    }
    ranges = {} if scene.slips else _moment_ranges(scene)
    for name, (moment, middle, most, shift) in ranges.items():
        ends = jnp.stack([moment + shift, middle - most + shift, middle + most + shift])
        text = f"the {name} of {{:.4g}} N m must lie between {{:.4g}} and {{:.4g}} N m"
        causes[text] = FailureCause(tipping, ends)
    if len(ranges) == 2:
        text = "both moments together, as a vector, at most {:.4g} N m from the middles of these ranges"
        causes[text] = FailureCause(tipping, ranges["moment"].most[None])
    return causes


def _axial_only(system: TaperedSystem) -> Float[Array, " freedom"]:
    """Purely axial loads, which have an equilibrium, of the same size as the loads of the system."""
    along = jnp.asarray([1.0 if name == "axial" else 0.0 for name in system.freedoms])
    return along * (system.load_scale() + jnp.sum(jnp.abs(system.ring.load) * (1.0 - along)))


def _with_nested(result: NewtonResult, friction: TaperedFriction, options: NewtonOptions) -> NewtonResult:
    """The result with the residual of the nested solves of the films included. It has not converged if this residual is
    too large."""
    residual = friction.races.residual
    if friction.rib is not None:
        residual = jnp.maximum(residual, friction.rib.residual)
    failed = result.converged & ~(residual <= options.inner_tolerance)
    status = jnp.where(failed, int(Status.NOT_CONVERGED), result.status)
    return result._replace(status=status, inner_residual=jnp.maximum(result.inner_residual, residual))


def _results(
    scene: TaperedRollerBearing,
    system: TaperedSystem,
    unknowns: Float[Array, "3 roller"],
    state: TaperedState,
    motion: TaperedMotion,
    friction: TaperedFriction | None,
) -> Results[TaperedResults, TaperedPowerLoss]:
    geometry, count = scene.geometry, scene.geometry.n_rollers
    every = lambda values: jnp.broadcast_to(values, (count,))
    place = system.units() * unknowns
    pressure = line_pressure(scene, system, state)
    modulus = scene.materials.race_modulus
    flange = geometry.flange_contact(modulus).hertz_pressure(state.flange_load)
    more: dict[str, Array | None] = {} if friction is None else {**_of_friction(friction, state)}
    more |= computed_results(TaperedResults, SolvedTapered(system, state, place, friction))
    positive = lambda values: every(jnp.where(values > 0, values, 0.0))  # and no -0.0
    elements = TaperedResults(
        azimuth=azimuths(geometry, count),
        load_inner=positive(state.load[0]),
        load_outer=positive(state.load[1]),
        load_flange=positive(state.flange_load),
        contact_angle_inner=every(geometry.cone_angle),
        contact_angle_outer=every(jnp.asarray(geometry.contact_angle)),
        pressure_inner=every(pressure[0]),
        pressure_outer=every(pressure[1]),
        pressure_flange=every(jnp.where(state.flange_load > 0, flange, 0.0)),
        orbital_speed=every(motion.orbital_speed),
        spin_speed=every(motion.spin_speed),
        **{name: every(values) for name, values in more.items() if values is not None},
    )
    own = own_laminae(scene.profile)
    rated = rated_laminae(scene.rating, own)
    cut = lambda number: jnp.stack(
        [system.line.of_race(side).laminae(state.approach[side], state.slope[side], number) for side in (0, 1)]
    )
    laminae = cut(own)
    inner_laminae, outer_laminae = (
        jnp.broadcast_to(side, (count, rated)) for side in (laminae if rated == own else cut(rated))
    )
    totals = friction_totals(TaperedPowerLoss, [], scene.operation) if friction is None else friction.totals
    return Results(
        elements,
        totals,
        _facts(scene, state, friction, pressure, flange, laminae, place[2]),
        laminae=LaminaLoads(
            inner_laminae, outer_laminae, scene.profile is not None and scene.profile.shape is not None
        ),
        cage=None if friction is None else friction.cage,
        boundary_power=_boundary_power(scene, state, friction),
    )


def _boundary_power(
    scene: TaperedRollerBearing, state: TaperedState, friction: TaperedFriction | None
) -> BoundaryPower | None:
    """The part of the losses that is boundary friction."""
    rib = None if friction is None or friction.rib is None else friction.rib.mixed
    races = None if friction is None else friction.races.mixed
    return boundary_power(races, scene.geometry.n_rollers // state.load.shape[1], rib)


def _of_friction(friction: TaperedFriction, state: TaperedState) -> dict[str, Array]:
    """Films, their temperatures and friction, by the names of the results."""
    races, rib, balance = friction.races, friction.rib, friction.balance
    more = {"film_inner": races.film[0], "film_outer": races.film[1]}
    if races.temperature_rise is not None:
        more |= {
            "temperature_rise_inner": races.temperature_rise[0],
            "temperature_rise_outer": races.temperature_rise[1],
        }
    if balance is not None:
        # without load, this force comes from the cage, not from the raceway
        traction = jnp.where(state.load > 0, balance.traction, jnp.nan)
        more |= {"traction_inner": traction[0], "traction_outer": -traction[1]}
    if races.asperities is not None:
        ratio, share = races.asperities
        more |= {"film_ratio_inner": ratio[0], "film_ratio_outer": ratio[1]}
        more |= {"load_share_inner": share[0], "load_share_outer": share[1]}
    more |= mixed_results(races.mixed)
    if races.sliding is not None:
        more |= {"sliding_inner": races.sliding[0], "sliding_outer": races.sliding[1]}
    if friction.pocket is not None:
        names = ("film_front", "film_rear", "load_front", "load_rear")
        more |= {f"pocket_{name}": getattr(friction.pocket, name) for name in names}
    if rib is None:
        return more
    if rib.mixed is not None:
        more |= mixed_results(jax.tree.map(lambda values: values[None], rib.mixed), ("flange",))
    more |= {"film_flange": rib.film, "sliding_flange": rib.motion.sliding_speed, "spin_flange": rib.motion.spin}
    if rib.temperature_rise is not None:
        more["temperature_rise_flange"] = rib.temperature_rise
    if rib.traction is not None:
        more["traction_flange"] = rib.traction.rolling
    return more


def _facts(
    scene: TaperedRollerBearing,
    state: TaperedState,
    friction: TaperedFriction | None,
    pressure: Float[Array, "2 roller"],
    flange: Float[Array, " roller"],
    laminae: Float[Array, "2 roller lamina"],
    tilt: Float[Array, " roller"],
) -> Facts:
    """The facts that the range checks need, of raceways and rib."""
    races = Contacts(RACEWAYS, state.load, pressure, MEAN_OF_LINE, laminae=laminae)
    rib = Contacts(
        ("the rib",),
        state.flange_load[None],
        flange[None],
        MEAN_OF_POINT,
        past_edge=_end_reach(scene, state)[None],
        edges=("the edge of the roller's end face, on the rib",),
    )
    if friction is None or scene.contact is None or scene.oil is None:
        return Facts((races, rib), roller_tilt=tilt)
    inlet, of_races, of_rib = oil_of_races(scene), friction.races, friction.rib
    warm = lambda oil, rise: None if rise is None else oil.temperature + rise
    warm_races = warm(inlet, of_races.temperature_rise)
    races = races._replace(laws=scene.contact, inlet=inlet, mean_speed=of_races.speed, temperature=warm_races)
    races = races._replace(starved=of_races.starved, sliding=of_races.sliding)
    if of_races.asperities is not None:
        races = races._replace(load_share=of_races.asperities.share)
    if of_races.mixed is not None:
        races = races._replace(load_share=of_races.mixed.share)
    if of_rib is not None:
        rise, elsewhere = of_rib.temperature_rise, oil_elsewhere(scene)
        oil = oil_of(inlet, elsewhere, "flange")
        rib = rib._replace(laws=scene.rib, inlet=oil, temperature=warm(oil, None if rise is None else rise[None]))
        if of_rib.mixed is not None:
            rib = rib._replace(load_share=of_rib.mixed.share[None])
    reserve = None
    if of_races.capacity is not None and friction.balance is not None:
        reserve = of_races.capacity - jnp.abs(friction.balance.traction)
    return Facts((races, rib), traction_reserve=reserve, roller_tilt=tilt)


def line_pressure(scene: TaperedRollerBearing, system: TaperedSystem, state: TaperedState) -> Float[Array, "2 roller"]:
    r"""Largest Hertz pressure along each raceway contact, Pa: $p_0^2 = qE'/(2\pi R)$, with q and R at each position.

    Straight rollers: R decreases towards the apex. The largest pressure is therefore at an end, or, if the load falls
    towards the small end, at $s = 10d - 9f/|g|$, where $d\,p_0/ds = 0$. Rollers with a profile: the largest pressure at
    the points over which the load is summed, so that a contact without load has no pressure.
    """
    geometry = scene.geometry
    modulus = scene.materials.race_modulus
    length, reach = system.line.length, geometry.apex_distance
    if scene.profile is None:
        falls = state.slope < 0
        steep = jnp.where(falls, -state.slope, 1.0)
        inside = jnp.where(falls, 10.0 * reach - HIGHEST * state.approach / steep, 0.0)
        place = jnp.stack([jnp.zeros_like(inside), jnp.ones_like(inside), jnp.clip(inside / length, 0.0, 1.0)])
    else:
        places = jnp.asarray(lamina_points(scene.profile.n_laminae)[0])[:, None, None]
        place = jnp.broadcast_to(places, (len(places), *state.slope.shape))
    load = system.line.load_per_length(state.approach[None], state.slope[None], place)
    radii = jnp.stack([geometry.race_reduced_radii(place[:, side])[side] for side in (0, 1)], axis=1)
    # positions are the first axis
    contact = LineContact(radii, jnp.ones(()), modulus[None] if jnp.ndim(modulus) else modulus)
    return largest(jnp.where(load > 0, contact.hertz_pressure(load), 0.0), axis=0)


def _end_reach(scene: TaperedRollerBearing, state: TaperedState) -> Array:
    """Length by which the ellipse on the rib reaches beyond the end face, m; negative if it does not."""
    geometry = scene.geometry
    modulus = scene.materials.race_modulus
    below = geometry.sphere_radius * jnp.sin(geometry.flange_tilt)
    # across the rolling direction, along the rib's generator
    ellipse = geometry.flange_contact(modulus).ellipse(state.flange_load)
    return below + ellipse.transverse - 0.5 * geometry.roller_diameter


def _port(scene: TaperedRollerBearing, system: TaperedSystem | SkiddingSystem, result: NewtonResult) -> Port:
    """Reaction and stiffness of the cone's five degrees of freedom at the reference point, with the rollers and the
    cage in equilibrium."""
    full = build_tapered(scene, system.ring.released(system.load_scale()))
    if isinstance(system, SkiddingSystem):
        full = build_skidding(scene, full, system.heavier)
    rows = result.point.elements
    elements = jnp.broadcast_to(rows, (rows.shape[0], scene.geometry.n_rollers))
    point = ArrowPoint(elements, system.ring.released_unknowns(result.point.globals))
    equations, jacobian = linearize(full, point)
    force = full.of_freedoms(equations.residual.globals) * full.load_scale() + full.ring.load
    return full.ring.port(jacobian, force, full.load_scale(), system.freedoms)
