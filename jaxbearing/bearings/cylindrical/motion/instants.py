"""Results of a moving cylindrical roller bearing at one time."""

from typing import TYPE_CHECKING, Any

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....numerics.arrow import ArrowPoint
from ...motion.history import CageMotion, PocketPeaks
from ...solution import RING_FREEDOMS, RingDisplacement
from ..kinematics import cage_slip
from ..solution import RollerResults
from .energy import kinetic_energy, pocket_energy, power_by_location, raceway_energy
from .results import RollerInstant

if TYPE_CHECKING:
    from .rates import RollerDynamics
else:
    RollerDynamics = Any


def observe(dynamics: RollerDynamics, time: Scalar, state: ArrowPoint) -> RollerInstant:
    """All results at one time; pure."""
    now = dynamics.at(time, state)
    system, motion, load, contact = dynamics.system, now.motion, now.distribution.load, now.contact
    pressure, pocket, rise = system.contact.hertz_pressure(load), now.pocket, contact.temperature_rise
    ring = dict(zip(system.freedoms, now.distribution.ring, strict=True))
    force = dict(zip(system.freedoms, dynamics.ring_load(time), strict=True))
    zero = jnp.zeros(())
    elements = RollerResults(
        azimuth=now.azimuth,
        load_inner=load[0],
        load_outer=load[1],
        pressure_inner=pressure[0],
        pressure_outer=pressure[1],
        orbital_speed=now.orbit,
        spin_speed=now.spin,
        film_inner=contact.film[0],
        film_outer=contact.film[1],
        temperature_rise_inner=None if rise is None else rise[0],
        temperature_rise_outer=None if rise is None else rise[1],
        sliding_inner=now.sliding_speed[0],
        sliding_outer=now.sliding_speed[1],
        traction_inner=None if contact.traction is None else contact.traction[0],
        traction_outer=None if contact.traction is None else contact.traction[1],
        pocket_film_front=None if pocket is None else pocket.front.film,
        pocket_film_rear=None if pocket is None else pocket.rear.film,
        pocket_load_front=None if pocket is None else pocket.front.load,
        pocket_load_rear=None if pocket is None else pocket.rear.load,
    )
    cage = None
    if now.land is not None:
        cage = CageMotion(
            x=now.centre[0],
            y=now.centre[1],
            velocity_x=now.velocity[0],
            velocity_y=now.velocity[1],
            speed=now.cage_orbit,
            slip=cage_slip(now.cage_orbit, motion),
            eccentricity_ratio=now.land.eccentricity_ratio,
        )
    peaks = None if pocket is None else PocketPeaks(front=pocket.front.load, rear=pocket.rear.load)
    cost = power_by_location(dynamics, now)
    assert cost.drive_power is not None
    frame_angle, frame_speed, _ = dynamics.frame(time)
    rollers, own, _ = dynamics.unscaled(state)
    return RollerInstant(
        inner_speed=motion.inner_speed,
        radial_load=force["radial"],
        lateral_load=force.get("lateral", zero),
        ring=RingDisplacement(**{name: ring.get(name, zero) for name in RING_FREEDOMS}),
        cage=cage,
        elements=elements,
        pocket_peaks=peaks,
        power_loss=cost.power_loss,
        drive_power=cost.drive_power,
        kinetic_energy=kinetic_energy(dynamics, time, state),
        pocket_energy=pocket_energy(dynamics, now),
        raceway_energy=raceway_energy(dynamics, now),
        state_elements=rollers,
        state_cage=own,
        frame_angle=frame_angle,
        frame_speed=frame_speed,
    )


def pocket_loads(dynamics: RollerDynamics, time: Scalar, state: ArrowPoint) -> Float[Array, "2 roller"]:
    """Loads on the front and the rear pocket walls, N. They cost less than `observe` and show shocks between
    instants."""
    rollers, cage, _ = dynamics.unscaled(state)
    pitch, (turned, turning, _) = dynamics.system.kinematics.pitch_radius, dynamics.frame(time)
    azimuth = dynamics.system.azimuth + rollers[0] / pitch + turned
    pocket = dynamics.pocket_state(
        tuple(rollers), tuple(cage[:3]), tuple(cage[3:]), azimuth, turning + rollers[1] / pitch
    )
    return jnp.stack([pocket.front.load, pocket.rear.load])


def pocket_peaks(dynamics: RollerDynamics, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks:
    """Largest loads on the front and the rear pocket walls in each interval, N, shape (interval, roller).

    **Arguments:** `times`: several times within each interval, s; `states`: at these times, with first axis of length
    `interval * part`.
    """
    # one search for all states: rollers far from a wall do not lengthen it
    loads = jax.vmap(lambda time, state: pocket_loads(dynamics, time, state))(times.reshape(-1), states)
    front, rear = jnp.swapaxes(jnp.max(loads.reshape(*times.shape, *loads.shape[1:]), axis=1), 0, 1)
    return PocketPeaks(front=front, rear=rear)
