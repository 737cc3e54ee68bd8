"""From the scene of a cylindrical roller bearing to its equations of motion and the state that a run begins with."""

import dataclasses
from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from ...gaps import CompliantPocketFace
from ...materials import CATALOGUE, reduced_modulus
from ...numerics.arrow import ArrowPoint
from ...numerics.checks import InputChecks, check_inputs, gate, void
from ...numerics.newton import NewtonOptions, newton_solve
from ...numerics.status import Status
from ..cylindrical.equations import LubricatedRollerSystem
from ..cylindrical.scene import NO_NETWORK, CylindricalRollerBearing, check_run
from ..cylindrical.steady import build_system
from ..mounted import running_scene
from ..ring import LENGTH_UNIT
from .rates import RollerDynamics
from .settings import Simulation

ASSUMED_CAGE = "bronze"
"""Material of a cage, where a scene does not give it."""


IMMOBILE = (
    "contact.traction: nothing drives the rollers of a bearing without traction on its raceways; simulate needs it"
)


class Start(NamedTuple):
    """Equations of motion, state at time 0, and how the quasi-static solve ended that gave it."""

    dynamics: RollerDynamics
    state: ArrowPoint
    status: Int[Array, ""]
    residual: Float[Array, ""]


class QuasiStatic(NamedTuple):
    """Orbital speed of all, rad/s; centre of the cage, m; places of the rollers along the pitch circle from those of
    equal distances, m; spins, rad/s; how the solve ended."""

    orbit: Float[Array, ""]
    centre: Float[Array, "2"]
    position: Float[Array, "*roller"]
    spin: Float[Array, " roller"]
    status: Int[Array, ""]
    residual: Float[Array, ""]


def build_dynamics(
    scene: CylindricalRollerBearing, simulation: Simulation, reference_speed: Array | None = None
) -> RollerDynamics:
    """Equations of motion, with everything prepared that does not depend on the state.

    **Arguments:** `reference_speed`, rad/s, of the frame in which positions are counted, at the operating point; that
    of rolling without slip where not given.

    **Raises:** `ValueError` for a scene without traction on the raceways: nothing would drive its rollers; and for an
    operating point that holds the ring somewhere.
    """
    if not scene.slips:
        raise ValueError(IMMOBILE)
    check_run(scene.operation)
    if scene.thermal is not None:
        raise ValueError(NO_NETWORK)
    if simulation.rotating_load is not None and not scene.skewed:
        scene = scene.replace({"ring_freedom": ("radial", "lateral")})
    seats = None if scene.fits is None else scene
    scene, _, _ = running_scene(scene)
    system = build_system(scene)
    assert isinstance(system, LubricatedRollerSystem)
    smoothing = jnp.asarray(simulation.entrainment_smoothing)
    system = eqx.tree_at(lambda s: s.laws.entrainment_smoothing, system, smoothing)
    geometry, materials, cage = scene.geometry, scene.materials, scene.cage
    pocket = clearance = mass = inertia = None
    if cage is not None:
        solid = CATALOGUE[ASSUMED_CAGE] if materials.cage is None else materials.cage
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
    )


def quasi_static(scene: CylindricalRollerBearing, options: NewtonOptions | None = None) -> QuasiStatic:
    """Steady state of the operating point as places and speeds of rollers and cage; pure. Without a cage: rolling
    without slip."""
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
    motion, found, parts = solved.kinematics, solved.at(result.point), solved.cage
    assert parts is not None
    assert parts.land is not None
    assert found.pocket is not None
    assert found.cage_force is not None
    orbit, inner = solved.orbit(result.point.globals[-1]), parts.guidance == "inner_ring"
    land, pull = solved.land_at(result.point, found), jnp.sum(found.cage_force, axis=1)
    # what the pockets pull the cage with, the lands' film passes on to the ring
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
    q = 0.5 * jnp.asarray(scene.cage.pocket_clearance) - offset - found.pocket.film_front
    return QuasiStatic(orbit, centre, q, found.spin_speed, result.status, result.residual_norm)


def at_start(scene: CylindricalRollerBearing, simulation: Simulation) -> CylindricalRollerBearing:
    """The scene at the speed and loads of time 0."""
    zero, operation = jnp.zeros(()), scene.operation
    factor = simulation.load.factor(zero)
    names = [name for name in ("radial_load", "radial_load_lateral") if getattr(operation, name) is not None]
    loads = {name: getattr(operation, name) * factor for name in names}
    return scene.at_operation(inner_speed=operation.inner_speed * simulation.speed.factor(zero), **loads)


def begin(scene: CylindricalRollerBearing, simulation: Simulation, found: QuasiStatic) -> Start:
    """Rollers and cage where the steady films of time 0 hold them, as a state of motion; pure.

    The speed of time 0 must not be 0 (the films that hold the rollers vanish). The accelerations of this state are not
    quite 0: the walls of the steady pockets are rigid, and rollers that go round in the pockets of an eccentric cage do
    not stand still in them. A rotating load is not in it.
    """
    factor = simulation.speed.factor(jnp.zeros(()))
    dynamics = build_dynamics(scene, simulation, found.orbit / factor)
    still = jnp.zeros_like(found.spin)
    rollers = jnp.stack([found.position + still, still, dynamics.system.kinematics.roller_radius * found.spin])
    state = dynamics.scaled(rollers, jnp.concatenate([found.centre, jnp.zeros(4)]))
    return Start(dynamics, state, found.status, found.residual)


def quasi_static_start(
    scene: CylindricalRollerBearing, simulation: Simulation, options: NewtonOptions | None = None
) -> Start:
    """Equations of motion and the state that a run begins with; pure, jit-able.

    Where a traced input is invalid `status` says so, and the state is NaN."""
    lane, inputs = checked_lane(scene, simulation)
    start = begin(lane, simulation, quasi_static(at_start(lane, simulation), options))
    return start._replace(status=jnp.where(inputs.valid, start.status, int(Status.INVALID_INPUT)))


def checked_lane(
    scene: CylindricalRollerBearing, simulation: Simulation
) -> tuple[CylindricalRollerBearing, InputChecks]:
    """The checks of traced inputs, and the scene with an operation that is NaN where they are invalid."""
    inputs = check_inputs(dataclasses.replace(scene, simulation=simulation))
    lane = gate(scene, inputs.valid)
    return dataclasses.replace(lane, operation=void(lane.operation, inputs.valid)), inputs
