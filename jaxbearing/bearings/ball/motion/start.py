"""Equations of motion of a ball bearing scene, and the initial state of a transient run."""

import dataclasses
from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from ....contacts import PointContact
from ....gaps import CompliantBallPocketFace
from ....gaps.meeting_balls import MeetingBalls
from ....materials import CATALOGUE, reduced_modulus
from ....numerics.arrow import ArrowPoint
from ....numerics.integrator import IMPLICIT
from ....numerics.newton import NewtonOptions, newton_solve
from ....numerics.refusals import refuse_all
from ...cage import ASSUMED_MATERIAL
from ...inlet import oil_of
from ...motion.family import AbstractDynamics, Resumed, Start
from ...motion.history import LastState
from ...motion.settings import Simulation
from ...mounted import running_scene
from ...parts import azimuths
from ...ring import inner_ring
from ...ring_shape import moving_problems
from ...solution import RING_FREEDOMS
from ..build import build_core, build_lubricated
from ..core import BallCore
from ..gyroscopic import ResolvedCouple
from ..pairs import LubricatedBallSystem
from ..scene import BallAttitude, BallBearing
from ..state import BallGuess, BallsState
from .bodies import MovingCage, MovingRing, TurningBody
from .layout import tilt_levers
from .neighbours import Neighbours
from .quasi_static import quasi_static_dynamics
from .races import LubricatedRaces
from .rates import BallDynamics
from .speeds import Levers

CONTACT_DAMPING = 0.05
"""Contact damping if the settings give none, s/m."""
IMMOBILE = "contact.traction: nothing drives the balls of a bearing without traction on its raceways; simulate needs it"
NO_NETWORK = (
    "thermal: a transient run of the balls has no thermal network (simulate runs the temperatures of such a scene); "
    "leave [thermal] out, and give the temperatures that a solve has found as operation.oil_temperature and "
    "[temperatures]"
)
NO_MASS = (
    "simulation.ring_mass: a transient run of a ball bearing under loads needs the mass of the inner ring with the "
    "shaft's share, e.g. '5 kg'; or meridian = 'quasi_static', or operation.displacement, which holds the ring"
)

COUPLED = (
    "simulation.solver: an implicit solver eliminates ball by ball, and balls without a cage meet each other; choose "
    "'tsit5' or 'dopri8'"
)


class QuasiStatic(NamedTuple):
    """Steady state as positions and speeds; arrays are over all balls.

    - `orbit`: orbital speed of each ball, rad/s; `cage_orbit`: speed of the cage (without a cage, mean of the balls),
      rad/s.
    - `spin`: axial, radial and transverse component of the spin of each ball, rad/s.
    - `centre`: centre of each ball from the outer groove centre (axial, outward), m.
    - `position`: distance of each ball along the pitch circle from its position at equal spacing, m.
    - `cage`: displacement of the centre of the cage along azimuths 0 and 90 degrees, m.
    - `ring`: displacements of the inner ring as lengths, m, in the order of `RING_FREEDOMS`.
    - `status`, `residual`: status and residual of the solve.
    """

    orbit: Float[Array, " ball"]
    cage_orbit: Float[Array, ""]
    spin: Float[Array, "3 ball"]
    centre: Float[Array, "2 ball"]
    position: Float[Array, " ball"]
    cage: Float[Array, "2"]
    ring: Float[Array, "5"]
    status: Int[Array, ""]
    residual: Float[Array, ""]


def require_moving(scene: BallBearing) -> None:
    """Checks that a scene allows a transient run.

    **Raises:** `ValueError` for a scene without traction on the raceways, with a thermal network, or with rings that
    are flexible or not round."""
    if not scene.slips:
        raise ValueError(IMMOBILE)
    if scene.thermal is not None:
        raise ValueError(NO_NETWORK)
    refuse_all(moving_problems(scene, round_races=True))


def free_freedoms(scene: BallBearing, simulation: Simulation) -> tuple[bool, ...]:
    """For each degree of freedom, whether the ring moves along it in a transient run. It moves along the unknown
    degrees of freedom of the steady state, along the lateral one if the radial one is unknown, because moving balls are
    not symmetric about the load line, and along both under a rotating load, except where a displacement is prescribed.
    """
    free = set(scene.unknown_freedoms)
    if simulation.rotating_load is not None:
        free |= {name for name in ("radial", "lateral") if scene.operation.held_at(name) is None}
    if "radial" in free and scene.operation.held_at("lateral") is None:
        free.add("lateral")
    return tuple(name in free for name in RING_FREEDOMS)


def require_mass(scene: BallBearing, simulation: Simulation) -> None:
    """Checks that a ring that moves with inertia has a mass. **Raises:** `ValueError` if it has none."""
    moves = any(free_freedoms(scene, simulation)) and simulation.meridian == "dynamic"
    if moves and simulation.ring_mass is None:
        raise ValueError(NO_MASS)


def require_explicit(scene: BallBearing, simulation: Simulation) -> None:
    """Checks that the solver allows ball-to-ball contacts.

    **Raises:** `ValueError` for an implicit solver without a cage, because implicit solvers assume that the balls are
    coupled through the cage and the ring only."""
    if scene.cage is None and simulation.solver in IMPLICIT:
        raise ValueError(COUPLED)


def build_dynamics(scene: BallBearing, simulation: Simulation, reference_speed: Array) -> BallDynamics:
    """Equations of motion, with all quantities prepared that do not depend on the state.

    **Arguments:** `reference_speed`: speed of the frame in which positions are counted, at the operating point, rad/s.

    **Raises:** `ValueError` for a scene that `require_moving` refuses, and for a ring under loads without a mass.
    """
    require_moving(scene)
    running, _, _ = running_scene(scene)
    assert isinstance(running, BallBearing)
    # the motion obeys Euler's equations, whatever law carries the gyroscopic couple in the steady state
    resolved = dataclasses.replace(running, kinematics=BallAttitude("equilibrium", ResolvedCouple()))
    core = build_core(resolved, exact=False)
    zero = jnp.zeros_like(core.azimuth)
    # its equations are not solved, so any first guess will do
    system = build_lubricated(resolved, core, BallGuess(zero, zero, zero, jnp.zeros(len(core.freedoms))))
    assert isinstance(system, LubricatedBallSystem)
    geometry, grooves = running.geometry, core.grooves
    share = grooves.offset[1] / grooves.centre_distance
    drag = system.drag
    return BallDynamics(
        kinematics=core.kinematics,
        levers=_levers(running, core),
        azimuth=jnp.asarray(azimuths(geometry, geometry.n_balls)),
        mass=core.mass,
        inertia=core.inertia,
        races=LubricatedRaces(system),
        contact_damping=jnp.asarray(
            CONTACT_DAMPING if simulation.contact_damping is None else simulation.contact_damping
        ),
        free_offset=-grooves.aligned * share,
        free_radius=grooves.offset[1] * jnp.minimum(grooves.free_cosine, 1.0),
        ring=_moving_ring(running, simulation),
        reference_speed=jnp.asarray(reference_speed),
        cage=None if running.cage is None else _moving_cage(running, system),
        neighbours=_neighbours(running, system) if running.cage is None else None,
        drag=drag,
        drag_viscosity=None if drag is None else jnp.asarray(oil_of(system.inlet, system.elsewhere, "drag").viscosity),
        speed=simulation.speed,
        load=simulation.load,
        rotating_load=simulation.rotating_load,
    )


def _levers(scene: BallBearing, core: BallCore) -> Levers:
    geometry, places = scene.geometry, None
    if scene.cage is not None:
        places = jnp.asarray(scene.cage.land_places(geometry))
    return Levers(
        grooves=core.grooves,
        ball_radius=0.5 * jnp.asarray(geometry.ball_diameter),
        pitch_radius=0.5 * jnp.asarray(geometry.pitch_diameter),
        land_places=places,
        on_outer=scene.cage is not None and scene.cage.guidance == "outer_ring",
        balls_meet=scene.cage is None,
    )


def _neighbours(scene: BallBearing, system: LubricatedBallSystem) -> Neighbours:
    """Ball-to-ball contacts, in the oil of the pockets (at the inlet temperature if none is given for them)."""
    radius, balls = 0.5 * jnp.asarray(scene.geometry.ball_diameter), scene.materials.balls
    contact = PointContact(0.5 * radius, 0.5 * radius, reduced_modulus(balls, balls))
    viscosity = jnp.asarray(oil_of(system.inlet, system.elsewhere, "pocket").viscosity)
    return Neighbours(MeetingBalls(radius, contact.stiffness_constant()), viscosity)


def _moving_cage(scene: BallBearing, system: LubricatedBallSystem) -> MovingCage:
    cage, geometry, materials = scene.cage, scene.geometry, scene.materials
    assert cage is not None
    solid = CATALOGUE[ASSUMED_MATERIAL] if materials.cage is None else materials.cage
    radius, clearance = 0.5 * jnp.asarray(geometry.ball_diameter), jnp.asarray(cage.pocket_clearance)
    conforming = radius * (2.0 * radius + clearance) / clearance
    wall = PointContact(radius, conforming, reduced_modulus(materials.balls, solid))
    return MovingCage(
        body=TurningBody(*map(jnp.asarray, cage.mass_and_inertias(geometry, solid.density))),
        pocket=CompliantBallPocketFace(clearance, radius, wall.stiffness_constant()),
        viscosity=jnp.asarray(oil_of(system.inlet, system.elsewhere, "pocket").viscosity),
        land=cage.land(geometry),
        oil=oil_of(system.inlet, system.elsewhere, "cage_pilot"),
        imbalance=jnp.zeros(()),
    )


def _moving_ring(scene: BallBearing, simulation: Simulation) -> MovingRing:
    r"""The inner ring, as a cylinder with the mass of ring and shaft and the radius of the circle of groove centres:
    $I_p = \tfrac12mR_i^2$, $I_t = \tfrac12I_p$. The increase of $I_t$ with the length of the cylinder is left out."""
    free, lever = free_freedoms(scene, simulation), jnp.asarray(scene.ring_lever)
    ring = inner_ring(scene, lever, tuple(name for name, moves in zip(RING_FREEDOMS, free, strict=True) if moves))
    levers, body = tilt_levers(lever), None
    if any(free) and simulation.meridian == "dynamic":
        require_mass(scene, simulation)
        mass = jnp.asarray(simulation.ring_mass)
        polar = 0.5 * mass * jnp.square(lever)
        body = TurningBody(mass, polar, 0.5 * polar)
    damping = 0.0 if simulation.ring_damping is None else simulation.ring_damping
    return MovingRing(
        body=body,
        load=jnp.zeros(5).at[ring.places].set(ring.load) * levers,
        held=ring.held / levers,
        damping=jnp.asarray(damping),
        lever=lever,
        free=free,
    )


def quasi_static(scene: BallBearing, options: NewtonOptions | None = None) -> QuasiStatic:
    """Steady state at the operating point, with the attitude law of the scene; pure."""
    scene, _, _ = running_scene(scene)
    count = scene.geometry.n_balls
    core, _ = build_core(scene, exact=False).started()
    solved, result = newton_solve(build_lubricated(scene, core), options)
    assert isinstance(solved, LubricatedBallSystem)
    balls, ring = solved.at(result.point), solved.ring
    every = lambda values: jnp.broadcast_to(values, (*values.shape[:-1], count))
    motion = balls.motion
    orbit = every(motion.orbital_speed)
    moved = ring.moved(result.point.globals[: len(ring.freedoms)])
    position, centre, cage_orbit = jnp.zeros(count), jnp.zeros(2), jnp.mean(orbit)
    if solved.cage is not None:
        assert balls.pocket is not None
        cage_orbit = solved.orbit(result.point.globals[-1])
        if solved.multiplicity == 1:
            centre = _cage_centre(solved, result.point, balls, moved, cage_orbit)
        azimuth = jnp.asarray(azimuths(scene.geometry, count))
        # displacement of the pockets along the orbit by the eccentricity of the cage
        aside = centre[0] * jnp.sin(azimuth) - centre[1] * jnp.cos(azimuth)
        position = 0.5 * solved.cage.pocket.clearance - every(balls.pocket.film_front) - aside
    return QuasiStatic(
        orbit=orbit,
        cage_orbit=cage_orbit,
        spin=every(jnp.stack([motion.axial_spin, motion.radial_spin, motion.transverse])),
        centre=every(balls.centre),
        position=position,
        cage=centre,
        ring=moved,
        status=result.status,
        residual=result.residual_norm,
    )


def _cage_centre(
    solved: LubricatedBallSystem, point: ArrowPoint, balls: BallsState, ring: Float[Array, "5"], orbit: Array
) -> Float[Array, "2"]:
    """Displacement of the centre of the cage at which its lands carry the sum of the pocket forces, m."""
    parts, motion, land = solved.cage, solved.kinematics, solved.land_at(point, balls)
    assert parts is not None
    assert balls.cage_force is not None
    inner, pull = parts.guidance == "inner_ring", jnp.sum(balls.cage_force, axis=1)
    # the land films transmit the sum of the pocket forces to the ring
    toward = pull if inner else -pull
    mean_speed = 0.5 * ((motion.inner_speed if inner else motion.outer_speed) + orbit)
    offset = jnp.stack(
        parts.land.static_offset(land.eccentricity_ratio, land.attitude_angle, toward[0], toward[1], mean_speed)
    )
    return ring[1:3] - offset if inner else offset


def begin(scene: BallBearing, simulation: Simulation, steady: QuasiStatic) -> Start:
    """Equations of motion, and the initial state, in which balls, cage and ring are as in the steady state at time 0;
    pure.

    If the scene resolves the gyroscopic couple, the accelerations of this state are 0, except for effects that the
    steady state neglects: elastic pocket walls, spin relative to the cage, and axial pocket forces. With other laws for
    the couple they are not 0.
    """
    factor = simulation.speed.factor(jnp.zeros(()))
    dynamics = build_dynamics(scene, simulation, steady.cage_orbit / factor)
    pitch, still = dynamics.levers.pitch_radius, jnp.zeros_like(steady.orbit)
    offset, outward = steady.centre[0] - dynamics.free_offset, steady.centre[1] - dynamics.free_radius
    behind = pitch * (steady.orbit - steady.cage_orbit)
    spin = dynamics.levers.ball_radius * steady.spin
    balls = jnp.concatenate(
        [jnp.stack([steady.position, behind]), spin, jnp.stack([offset, outward, still, still])],
    )
    cage, shift = jnp.zeros(12), jnp.where(dynamics.ring.mask > 0, steady.ring, 0.0)
    if dynamics.cage is not None:
        cage = cage.at[0].set(jnp.mean(offset)).at[1:3].set(steady.cage)
    state = dynamics.scaled(balls, jnp.concatenate([cage, shift, jnp.zeros(5)]))
    return Start(*_chosen_equations(simulation, dynamics, state), steady.status, steady.residual)


def _chosen_equations(
    simulation: Simulation, dynamics: BallDynamics, state: ArrowPoint
) -> tuple[AbstractDynamics, ArrowPoint]:
    """The equations chosen by the settings (`meridian`), and their state."""
    if simulation.meridian == "quasi_static":
        return quasi_static_dynamics(dynamics, state)
    return dynamics, state


def resume(scene: BallBearing, simulation: Simulation, last: LastState) -> Resumed:
    """Equations of motion, and the state in which an earlier run ended; pure.

    The time laws of speeds and loads may differ from those of that run; positions and speeds in space are kept."""
    dynamics = build_dynamics(scene, simulation, jnp.asarray(last.reference_speed))
    turned, turning, _ = dynamics.frame(jnp.asarray(last.time))
    pitch = dynamics.levers.pitch_radius
    ahead, faster = pitch * (last.frame_angle - turned), pitch * (last.frame_speed - turning)
    balls, shared = jnp.asarray(last.elements), jnp.asarray(last.cage)
    balls = balls.at[0].add(ahead).at[1].add(faster)
    if last.has_cage:
        shared = shared.at[5].add(ahead).at[11].add(faster)
    return Resumed(*_chosen_equations(simulation, dynamics, dynamics.scaled(balls, shared)))
