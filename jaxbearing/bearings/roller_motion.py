"""From the scene of a cylindrical roller bearing to its equations of motion and the state that a run begins with."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from ..gaps import CompliantPocketFace
from ..materials import CATALOGUE, reduced_modulus
from ..numerics.arrow import ArrowPoint
from ..numerics.newton import NewtonOptions, newton_solve
from ..numerics.status import Status
from .cylindrical_roller import CylindricalRollerBearing
from .roller_dynamics import RollerDynamics
from .roller_equations import LubricatedRollerSystem
from .roller_loads import LENGTH_UNIT
from .roller_steady import build_system
from .simulation import Simulation

ASSUMED_CAGE = "bronze"
"""Material of a cage, where a scene does not give it."""


class Start(NamedTuple):
    """Equations of motion, state at time 0, and how the quasi-static solve ended that gave it."""

    dynamics: RollerDynamics
    state: ArrowPoint
    status: Int[Array, ""]
    residual: Float[Array, ""]


def build_dynamics(
    scene: CylindricalRollerBearing, simulation: Simulation, reference_speed: Array | None = None
) -> RollerDynamics:
    """Equations of motion, with everything prepared that does not depend on the state.

    **Arguments:** `reference_speed`, rad/s, of the frame in which positions are counted, at the operating point; that of
    rolling without slip where not given.

    **Raises:** `ValueError` for a scene without traction on the raceways: nothing would drive its rollers.
    """
    if not scene.slips:
        raise ValueError(
            "contact.traction: a bearing without traction on its raceways does not move by itself; simulate needs it"
        )
    if simulation.rotating_load is not None and "lateral" not in scene.ring_freedom:
        scene = scene.replace({"ring_freedom": ("radial", "lateral")})
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
    )


def quasi_static_start(
    scene: CylindricalRollerBearing, simulation: Simulation, options: NewtonOptions | None = None
) -> Start:
    """The steady state of the bearing at the speed and radial load of time 0, as a state of motion: rollers and cage
    where the steady films hold them. Without a cage: rolling without slip.

    The speed of time 0 must not be 0 (the films that hold the rollers vanish). Pure, jit-able. Its accelerations are not quite 0: the walls of the steady pockets are rigid, and positions that
    stand still in the pockets of an eccentric cage are not what rollers have that go round in it.
    """
    zero = jnp.zeros(())
    operation = scene.operation
    begins = scene.at_operation(
        inner_speed=operation.inner_speed * simulation.speed.factor(zero),
        radial_load=operation.radial_load * simulation.load.factor(zero),
    )
    system = build_system(begins)
    assert isinstance(system, LubricatedRollerSystem)
    motion, n = system.kinematics, scene.geometry.n_rollers
    factor = simulation.speed.factor(zero)
    if scene.cage is None:
        dynamics = build_dynamics(scene, simulation, motion.free_orbit / factor)
        rolling = jnp.full(n, motion.roller_radius * motion.free_spin)
        state = dynamics.scaled(jnp.stack([jnp.zeros(n), jnp.zeros(n), rolling]), jnp.zeros(6))
        return Start(dynamics, state, jnp.asarray(int(Status.CONVERGED)), zero)
    solved, result = newton_solve(system, options)
    assert isinstance(solved, LubricatedRollerSystem)
    found, parts = solved.at(result.point), solved.cage
    assert parts is not None
    assert parts.land is not None
    assert found.pocket is not None
    assert found.cage_force is not None
    orbit = solved.orbit(result.point.globals[-1])
    dynamics = build_dynamics(scene, simulation, orbit / factor)

    pull = jnp.sum(found.cage_force, axis=1)
    land = solved.land_at(result.point, found)
    # what the pockets pull the cage with, the lands' film passes on to the ring
    sign = 1.0 if parts.guidance == "inner_ring" else -1.0
    other = motion.inner_speed if parts.guidance == "inner_ring" else motion.outer_speed
    x, y = parts.land.static_offset(
        land.eccentricity_ratio, land.attitude_angle, sign * pull[0], sign * pull[1], 0.5 * (other + orbit)
    )
    if parts.guidance == "inner_ring":
        ring = result.point.globals[:-1] * LENGTH_UNIT
        lateral = ring[1] if "lateral" in solved.freedoms else zero
        x, y = -lateral - x, ring[0] - y
    offset = x * jnp.cos(solved.azimuth) + y * jnp.sin(solved.azimuth)
    q = 0.5 * jnp.asarray(scene.cage.pocket_clearance) - offset - found.pocket.film_front
    rollers = jnp.stack([q, jnp.zeros(n), motion.roller_radius * found.spin_speed])
    state = dynamics.scaled(rollers, jnp.stack([x, y, zero, zero, zero, zero]))
    return Start(dynamics, state, result.status, result.residual_norm)
