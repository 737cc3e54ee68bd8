"""Equations of motion of a cylindrical roller bearing from its scene, and the state that a run begins with."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from ....gaps import CompliantPocketFace
from ....materials import CATALOGUE, reduced_modulus
from ....numerics.newton import NewtonOptions, newton_solve
from ....numerics.refusals import refuse_all
from ....numerics.status import Status
from ...cage import ASSUMED_MATERIAL
from ...motion.family import Resumed, Start
from ...motion.history import LastState
from ...motion.settings import Simulation
from ...mounted import running_scene
from ...ring import LENGTH_UNIT
from ...ring_shape import moving_problems
from ..equations import LubricatedRollerSystem
from ..scene import CylindricalRollerBearing, check_run
from ..steady import build_system
from .rates import RollerDynamics

IMMOBILE = (
    "contact.traction: nothing drives the rollers of a bearing without traction on its raceways; simulate needs it"
)
NO_NETWORK = (
    "thermal: a transient run of the rollers has no thermal network (simulate runs the temperatures of such a scene); "
    "leave [thermal] out, and give the temperatures that a solve has found as operation.oil_temperature and "
    "[temperatures]"
)


class QuasiStatic(NamedTuple):
    """Steady state as positions and speeds of rollers and cage.

    - `orbit`: orbital speed of rollers and cage, rad/s; `spin`: spin of each roller, rad/s.
    - `centre`: centre of the cage along X and Y, m.
    - `position`: distance of each roller along the pitch circle from its place at equal spacing, m.
    - `status`, `residual`: how the solve ended.
    """

    orbit: Float[Array, ""]
    centre: Float[Array, "2"]
    position: Float[Array, "*roller"]
    spin: Float[Array, " roller"]
    status: Int[Array, ""]
    residual: Float[Array, ""]


def require_moving(scene: CylindricalRollerBearing) -> None:
    """Checks that rollers and cage of a scene can be simulated in motion.
    **Raises:** `ValueError` for a scene without traction on the raceways, with a thermal network or with flexible
    rings.
    """
    if not scene.slips:
        raise ValueError(IMMOBILE)
    if scene.thermal is not None:
        raise ValueError(NO_NETWORK)
    refuse_all(moving_problems(scene, round_races=False))


def build_dynamics(
    scene: CylindricalRollerBearing, simulation: Simulation, reference_speed: Array | None = None
) -> RollerDynamics:
    """Equations of motion; everything that does not depend on the state is computed here.

    **Arguments:** `reference_speed`: speed at the operating point of the frame in which positions are counted, rad/s;
    left out: orbital speed of rolling without slip.

    **Raises:** `ValueError` for a scene that cannot be simulated in motion (`require_moving`), and for an operating
    point with given displacements, an axial load or no radial load; and for settings that only ball bearings have.
    """
    require_moving(scene)
    check_run(scene.operation, scene.profile)
    simulation.require_no_mass()
    if simulation.rotating_load is not None and not scene.skewed:
        scene = scene.replace({"ring_freedom": ("radial", "lateral")})
    seats = None if scene.fits is None else scene
    scene, _, _ = running_scene(scene)
    system = build_system(scene)
    assert isinstance(system, LubricatedRollerSystem)
    if simulation.entrainment_smoothing is not None:
        smoothing = jnp.asarray(simulation.entrainment_smoothing)
        system = eqx.tree_at(lambda s: s.laws.entrainment_smoothing, system, smoothing)
    geometry, materials, cage = scene.geometry, scene.materials, scene.cage
    pocket = clearance = mass = inertia = None
    if cage is not None:
        solid = CATALOGUE[ASSUMED_MATERIAL] if materials.cage is None else materials.cage
        mass, inertia = (jnp.asarray(value) for value in cage.mass_and_inertia(geometry, solid.density))
        clearance = jnp.asarray(cage.pocket_clearance)
        pocket = CompliantPocketFace(
            roller_radius=system.kinematics.roller_radius,
            length=jnp.asarray(geometry.roller_length),
            reduced_modulus=reduced_modulus(materials.rollers, solid),
            pressure_viscosity=system.inlet.pressure_viscosity,
        )
    speed = system.kinematics.free_orbit if reference_speed is None else reference_speed
    return RollerDynamics(
        system=system,
        reference_speed=jnp.asarray(speed),
        roller_inertia=0.5 * system.roller_mass * jnp.square(system.kinematics.roller_radius),
        cage_mass=mass,
        cage_inertia=inertia,
        pocket=pocket,
        pocket_clearance=clearance,
        speed=simulation.speed,
        load=simulation.load,
        rotating_load=simulation.rotating_load,
        seats=seats,
        inner_roundness=scene.inner_roundness,
        outer_roundness=scene.outer_roundness,
    )


def quasi_static(scene: CylindricalRollerBearing, options: NewtonOptions | None = None) -> QuasiStatic:
    """Steady state of the operating point; without a cage, rolling without slip. Pure."""
    n, zero = scene.geometry.n_rollers, jnp.zeros(())
    scene, _, _ = running_scene(scene)
    system = build_system(scene)
    assert isinstance(system, LubricatedRollerSystem)
    if scene.cage is None:
        motion = system.kinematics
        spin = jnp.full(n, motion.free_spin)
        return QuasiStatic(motion.free_orbit, jnp.zeros(2), zero, spin, jnp.asarray(int(Status.CONVERGED)), zero)
    solved, result = newton_solve(system, options)
    assert isinstance(solved, LubricatedRollerSystem)
    motion, rollers, parts = solved.kinematics, solved.at(result.point), solved.cage
    assert parts is not None
    assert parts.land is not None
    assert rollers.pocket is not None
    assert rollers.cage_force is not None
    orbit, inner = solved.orbit(result.point.globals[-1]), parts.guidance == "inner_ring"
    land, pull = solved.land_at(result.point, rollers), jnp.sum(rollers.cage_force, axis=1)
    # the film of the lands transmits the pocket forces to the ring
    toward = pull if inner else -pull
    mean_speed = 0.5 * ((motion.inner_speed if inner else motion.outer_speed) + orbit)
    centre = jnp.stack(
        parts.land.static_offset(land.eccentricity_ratio, land.attitude_angle, toward[0], toward[1], mean_speed)
    )
    if inner:
        ring = result.point.globals[:-1] * LENGTH_UNIT
        lateral = ring[1] if "lateral" in solved.freedoms else zero
        centre = jnp.stack([-lateral, ring[0]]) - centre
    offset = centre[0] * jnp.cos(solved.azimuth) + centre[1] * jnp.sin(solved.azimuth)
    q = 0.5 * jnp.asarray(scene.cage.pocket_clearance) - offset - rollers.pocket.film_front
    return QuasiStatic(orbit, centre, q, rollers.spin_speed, result.status, result.residual_norm)


def begin(scene: CylindricalRollerBearing, simulation: Simulation, steady: QuasiStatic) -> Start:
    """Equations of motion and the initial state of a run, which is the steady state at time 0; pure.

    The speed at time 0 must not be 0, because there are no films at rest to carry the rollers. The accelerations of
    this state are small but not 0: the steady state has rigid pocket walls and leaves out that rollers move in the
    pockets of an eccentric cage. It does not contain a rotating load either.
    """
    factor = simulation.speed.factor(jnp.zeros(()))
    dynamics = build_dynamics(scene, simulation, steady.orbit / factor)
    still = jnp.zeros_like(steady.spin)
    rollers = jnp.stack([steady.position + still, still, dynamics.system.kinematics.roller_radius * steady.spin])
    state = dynamics.scaled(rollers, jnp.concatenate([steady.centre, jnp.zeros(4)]))
    return Start(dynamics, state, steady.status, steady.residual)


def resume(scene: CylindricalRollerBearing, simulation: Simulation, last: LastState) -> Resumed:
    """Equations of motion and initial state of a run that continues an earlier one; pure.

    Speeds and loads over time may differ from those of the earlier run. The positions and speeds of rollers and cage in
    space continue unchanged."""
    dynamics = build_dynamics(scene, simulation, jnp.asarray(last.reference_speed))
    turned, turning, _ = dynamics.frame(jnp.asarray(last.time))
    pitch = dynamics.system.kinematics.pitch_radius
    ahead, faster = pitch * (last.frame_angle - turned), pitch * (last.frame_speed - turning)
    zero = jnp.zeros(())
    rollers = jnp.asarray(last.elements) + jnp.stack([ahead, faster, zero])[:, None]
    cage = jnp.asarray(last.cage)
    if last.has_cage:
        cage = cage + jnp.stack([zero, zero, ahead, zero, zero, faster])
    return Resumed(dynamics, dynamics.scaled(rollers, cage))
