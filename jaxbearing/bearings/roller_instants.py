"""What is reported of a moving cylindrical roller bearing at one time."""

import jax.numpy as jnp

from .._types import Scalar
from ..numerics.arrow import ArrowPoint
from .history import CageMotion, Instant
from .roller_dynamics import RollerDynamics
from .roller_steady import cage_slip
from .solution import RING_FREEDOMS, RingDisplacement, RollerResults


def observe(dynamics: RollerDynamics, time: Scalar, state: ArrowPoint) -> Instant:
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
    inner, outer = dynamics.drive_torques(now)
    rollers, own, _ = dynamics.unscaled(state)
    return Instant(
        inner_speed=motion.inner_speed,
        radial_load=force["radial"],
        lateral_load=force.get("lateral", zero),
        ring=RingDisplacement(**{name: ring.get(name, zero) for name in RING_FREEDOMS}),
        cage=cage,
        elements=elements,
        power_loss=dynamics.losses(now),
        drive_power=motion.inner_speed * inner + motion.outer_speed * outer,
        kinetic_energy=dynamics.kinetic_energy(time, state),
        pocket_energy=dynamics.pocket_energy(now),
        raceway_energy=dynamics.raceway_energy(now),
        state_rollers=rollers,
        state_cage=own,
    )
