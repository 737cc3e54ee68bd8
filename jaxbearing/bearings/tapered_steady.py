"""Steady state of a tapered roller bearing: from the scene to the equations, and from the root to the results."""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from ..contacts import LineContact
from ..materials import reduced_modulus
from ..numerics.arrow import ArrowPoint, linearize, schur_complement
from ..numerics.newton import NewtonOptions, NewtonResult, newton_solve
from ..numerics.status import Status
from .rating import LAMINAE
from .roller_loads import LENGTH_UNIT
from .solution import RING_FREEDOMS, CageState, LaminaLoads, PowerLoss, RingDisplacement, Solution
from .steady import assemble
from .tapered_build import TaperedMotion, build_tapered, rolling_motion
from .tapered_roller import TaperedRollerBearing
from .tapered_solution import TaperedResults
from .tapered_system import Inertia, TaperedState, TaperedSystem

YIELD_PRESSURE = 4.0e9
"""Pa: that of the basic static load rating of roller bearings in ISO 76."""
HIGHEST = 9.0
"""1/(10/9 - 1): see `line_pressure`."""


def solve_tapered(scene: TaperedRollerBearing, options: NewtonOptions) -> Solution:
    """Steady state: pure, jit-able, vmap-able, differentiable; never raises for a failed solve.

    Where no equilibrium is found and one of two proofs holds that there is none, the status is `no_equilibrium`: the
    axial load is below a static bound (`slides_out`); or the cone, with all else in equilibrium, is still pushed on at
    a tilt of 0.1 rad, or at a displacement of the apex distance (`numerics.convex.find_minimum`).
    """
    posed = build_tapered(scene)
    slides = slides_out(scene, posed.inertia)
    started, minimum = posed.started(slides)
    system, result = newton_solve(started, options)
    none = ~result.converged & (slides | minimum.outside)
    result = result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status))
    ring = {name: result.point.globals[i] * LENGTH_UNIT for i, name in enumerate(system.freedoms)}
    lever = scene.geometry.apex_distance
    if scene.operation.moment is None and scene.operation.misalignment is not None:
        ring["tilt"] = jnp.asarray(scene.operation.misalignment) * lever
    scale = {"tilt": lever, "tilt_lateral": lever}
    displacement = RingDisplacement(
        **{name: ring.get(name, jnp.zeros(())) / scale.get(name, 1.0) for name in RING_FREEDOMS}
    )
    tilted = scene.operation.misalignment is not None and scene.operation.moment is None
    return assemble(
        scene,
        result,
        _results(scene, system, result),
        displacement,
        _stiffness(scene, system, result),
        iterations=minimum.steps + result.iterations,
        ring_freedom=(*scene.ring_freedom, "tilt") if tilted else scene.ring_freedom,
        stiffness_freedom=RING_FREEDOMS,
        equation_names=system.equation_names(),
    )


def slides_out(scene: TaperedRollerBearing, inertia: Inertia) -> Bool[Array, ""]:
    r"""Whether $F_a < F_r\tan\alpha_o + ZQ_c\sin\alpha_o$, $Q_c = F_c\cos\alpha_f/\cos(\alpha_o - \alpha_f)$: no
    equilibrium then, whatever the tilt.

    Every roller leans on the cup at that angle, and the centrifugal forces cancel: $F_a - F_r\tan\alpha_o =
    \sin\alpha_o\sum Q_o(1 - \cos\psi)$; and $Q_c$ is the least that a roller leans on the cup with, its centrifugal
    force carried by cup and rib alone.
    """
    operation, geometry = scene.operation, scene.geometry
    radial = jnp.abs(jnp.asarray(0.0 if operation.radial_load is None else operation.radial_load))
    cup, rib = jnp.asarray(geometry.contact_angle), jnp.asarray(geometry.flange_angle)
    least = inertia.force * jnp.cos(rib) / jnp.cos(cup - rib)
    return jnp.asarray(operation.axial_load) < radial * jnp.tan(cup) + geometry.n_rollers * least * jnp.sin(cup)


class _Results(NamedTuple):
    """Results before masking; `range_excess` maps a warning to a number that is positive where it applies."""

    cage: CageState | None
    elements: TaperedResults
    power_loss: PowerLoss
    drive_power: Array
    inner_torque: Array
    outer_torque: Array
    laminae: LaminaLoads
    range_excess: dict[str, Array]


def _results(scene: TaperedRollerBearing, system: TaperedSystem, result: NewtonResult) -> _Results:
    geometry, state = scene.geometry, system.at(result.point)
    count = geometry.n_rollers
    every = lambda values: jnp.broadcast_to(values, (count,))
    motion = rolling_motion(geometry, scene.operation)
    place = system.units() * result.point.elements
    pressure = line_pressure(scene, system, state)
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    flange = geometry.flange_contact(modulus).hertz_pressure(state.flange_load)
    more, losses = _films(scene, state, motion)
    elements = TaperedResults(
        azimuth=jnp.asarray(2.0 * np.pi * np.arange(count) / count),
        load_inner=every(state.load[0]),
        load_outer=every(state.load[1]),
        load_flange=every(state.flange_load),
        contact_angle_inner=every(geometry.cone_angle),
        contact_angle_outer=every(jnp.asarray(geometry.contact_angle)),
        pressure_inner=every(pressure[0]),
        pressure_outer=every(pressure[1]),
        pressure_flange=every(jnp.where(state.flange_load > 0, flange, 0.0)),
        orbital_speed=every(motion.orbital_speed),
        spin_speed=every(motion.spin_speed),
        roller_shift=every(place[0]),
        roller_lift=every(place[1]),
        roller_tilt=every(place[2]),
        **{name: every(values) for name, values in more.items()},
    )
    laminae = LAMINAE if scene.rating is None else scene.rating.n_laminae
    if scene.profile is not None:
        laminae = scene.profile.n_laminae
    cut = lambda side: jnp.broadcast_to(
        system.line.laminae(state.approach[side], state.slope[side], laminae), (count, laminae)
    )
    speed = jnp.asarray(scene.operation.inner_speed) - scene.operation.outer_speed
    turning = speed != 0.0
    torque = jnp.where(turning, losses.total / jnp.where(turning, speed, 1.0), 0.0)
    excess = {"contact pressure beyond 4 GPa: rollers and races yield (static rating of ISO 76)": jnp.max(pressure)}
    excess = {text: value - YIELD_PRESSURE for text, value in excess.items()}
    end = jnp.max(jnp.where(state.flange_load > 0, _end_reach(scene, state), 0.0))
    excess["contact ellipse on the rib cut off at the edge of the roller's end face"] = end
    return _Results(
        cage=None,
        elements=elements,
        power_loss=losses,
        drive_power=losses.total,
        inner_torque=torque,
        outer_torque=-torque,
        laminae=LaminaLoads(cut(0), cut(1), scene.profile is not None and scene.profile.shape is not None),
        range_excess=excess,
    )


def line_pressure(scene: TaperedRollerBearing, system: TaperedSystem, state: TaperedState) -> Float[Array, "2 roller"]:
    r"""Largest Hertz pressure along each raceway contact, Pa: $p_0^2 = qE'/(2\pi R)$ with q and R of the place.

    Straight rollers: R shrinks towards the apex, so that the largest is at an end, or, where the load falls towards the
    small end, at $s = 10d - 9f/|g|$, where $d\,p_0/ds = 0$. With a profile: the largest of the laminae.
    """
    geometry = scene.geometry
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    length, reach = system.line.length, geometry.apex_distance
    if scene.profile is None:
        falls = state.slope < 0
        steep = jnp.where(falls, -state.slope, 1.0)
        inside = jnp.where(falls, 10.0 * reach - HIGHEST * state.approach / steep, 0.0)
        place = jnp.stack([jnp.zeros_like(inside), jnp.ones_like(inside), jnp.clip(inside / length, 0.0, 1.0)])
    else:
        count = scene.profile.n_laminae
        middles = jnp.asarray((np.arange(count) + 0.5) / count)[:, None, None]
        place = jnp.broadcast_to(middles, (count, *state.slope.shape))
    load = system.line.load_per_length(state.approach[None], state.slope[None], place)
    radii = jnp.stack([geometry.race_reduced_radii(place[:, side])[side] for side in (0, 1)], axis=1)
    contact = LineContact(radii, jnp.ones(()), modulus)
    return jnp.max(jnp.where(load > 0, contact.hertz_pressure(load), 0.0), axis=0)


def _end_reach(scene: TaperedRollerBearing, state: TaperedState) -> Array:
    """By how much the ellipse on the rib reaches beyond the end face, m."""
    geometry = scene.geometry
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    below = geometry.end_radius * jnp.sin(geometry.flange_tilt)
    # across the rolling direction, along the rib's generator
    ellipse = geometry.flange_contact(modulus).ellipse(state.flange_load)
    return below + ellipse.transverse - 0.5 * geometry.roller_diameter


def _films(
    scene: TaperedRollerBearing, state: TaperedState, motion: TaperedMotion
) -> tuple[dict[str, Array], PowerLoss]:
    """Films of the raceways as even line contacts of the sizes and speeds at mid length, and what rolling costs."""
    if scene.contact is None or scene.oil is None:
        return {}, PowerLoss(total=jnp.zeros(()))
    geometry, operation, laws = scene.geometry, scene.operation, scene.contact
    modulus = reduced_modulus(scene.materials.rings, scene.materials.rollers)
    contact = LineContact(
        geometry.race_reduced_radii(jnp.asarray(0.5))[:, None], jnp.asarray(geometry.roller_length), modulus
    )
    reach = geometry.apex_distance - 0.5 * geometry.roller_length
    speed = motion.spin_speed * reach * jnp.sin(geometry.roller_half_angle) * jnp.ones((2, 1))
    inlet = scene.oil.at(operation.oil_temperature)
    still = jnp.zeros_like(state.load)
    found = laws.evaluate(contact, state.load, speed + still, still, scene.oil, inlet)
    films = {"film_inner": found.film[0], "film_outer": found.film[1]}
    if found.temperature_rise is not None:
        films |= {
            "temperature_rise_inner": found.temperature_rise[0],
            "temperature_rise_outer": found.temperature_rise[1],
        }
    if found.rolling_force is None:
        return films, PowerLoss(total=jnp.zeros(()))
    multiplicity = geometry.n_rollers // state.load.shape[1]
    power = multiplicity * jnp.sum(found.rolling_force * speed)
    return films, PowerLoss(total=power, rolling_resistance=power)


def _stiffness(scene: TaperedRollerBearing, system: TaperedSystem, result: NewtonResult) -> Float[Array, "5 5"]:
    """d load / d displacement of the cone's five freedoms at the reference point, rollers in equilibrium, N/m."""
    full = build_tapered(scene, RING_FREEDOMS)
    place = dict(zip(system.freedoms, result.point.globals, strict=True))
    ring = jnp.stack([place.get(name, jnp.zeros(())) for name in RING_FREEDOMS])
    elements = jnp.broadcast_to(result.point.elements, (3, scene.geometry.n_rollers))
    schur = schur_complement(linearize(full, ArrowPoint(elements, ring))[1])
    lever = scene.geometry.apex_distance
    arm = jnp.stack([*[jnp.ones(())] * 3, lever, lever])
    return schur * (full.load_scale() / LENGTH_UNIT) * arm[:, None] * arm[None, :]
