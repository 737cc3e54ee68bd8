"""Results of a transient run of a ball bearing at one time."""

import dataclasses
from typing import TYPE_CHECKING, Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....numerics.arrow import ArrowPoint
from ....numerics.safe import safe_norm
from ...computed import computed_results
from ...motion.history import CageMotion, PocketPeaks
from ...solution import RING_FREEDOMS, RingDisplacement
from ..core import FORCE_FLOOR
from ..kinematics import BallMotion
from ..solution import BallResults, SolvedBalls
from .energy import (
    damping_power,
    drive_power,
    kinetic_energy,
    pocket_energy,
    pocket_losses,
    power_by_location,
    race_losses,
    raceway_energy,
)
from .groove_loss import groove_loss
from .neighbours import neighbour_place
from .results import BallInstant
from .speeds import PocketPlace

if TYPE_CHECKING:
    from .rates import BallDynamics, MovingBalls
else:
    BallDynamics = MovingBalls = Any

STILL = 1e-6
"""Floor of the mean speed of the surfaces in the slide-to-roll ratio, m/s, added as a square."""


class _Seen(NamedTuple):
    """State for the computed fields of `BallResults`, with the names that the state of a steady bearing has."""

    angle: Float[Array, "2 ball"]
    motion: BallMotion


def observe(dynamics: BallDynamics, time: Scalar, state: ArrowPoint) -> BallInstant:
    """All results at one time; pure."""
    now = dynamics.at(time, state)
    balls, shared, _ = dynamics.unscaled(state)
    frame_angle, frame_speed, _ = dynamics.frame(time)
    load, turned = dynamics.ring_load(time), dynamics.cage is not None
    axial, radial, lateral, moment, moment_lateral = load
    cage = now.places.cage
    walls, pocket = now.walls, now.pocket
    races, sliding_power, shear = now.speeds.races, race_losses(now)[0], now.friction.shear
    strips = None if shear is None else shear.by_strip
    in_groove = (None, None) if strips is None else groove_loss(dynamics.levers, now.meridian, strips)
    slide_to_roll = races.rolling * races.mean_speed / (jnp.square(races.mean_speed) + STILL**2)
    return BallInstant(
        inner_speed=now.rates.races[0],
        radial_load=radial,
        lateral_load=lateral,
        ring=RingDisplacement(**dict(zip(RING_FREEDOMS, now.places.ring, strict=True))),
        cage=_cage_motion(dynamics, now),
        elements=_ball_results(dynamics, now),
        pocket_peaks=None
        if walls is None or pocket is None or now.lands is None
        else PocketPeaks(*front_and_rear(pocket, *walls.load), land=now.lands.load),
        power_loss=power_by_location(dynamics, now),
        drive_power=drive_power(now),
        kinetic_energy=kinetic_energy(dynamics, now),
        pocket_energy=pocket_energy(dynamics, now),
        raceway_energy=raceway_energy(dynamics, now),
        state_elements=balls,
        state_cage=shared,
        frame_angle=frame_angle,
        frame_speed=frame_speed,
        axial_load=axial,
        moment=moment,
        moment_lateral=moment_lateral,
        axial_place=now.places.offset,
        outward_place=now.places.radius - dynamics.levers.pitch_radius,
        pocket_offset=None if now.pocket is None else now.pocket.size,
        gap_ahead=_gaps(dynamics, now),
        load_ahead=None if now.met is None else now.met.load,
        cage_axial=cage[0] if turned else None,
        cage_tilt=cage[3] if turned else None,
        cage_tilt_lateral=cage[4] if turned else None,
        damping_power=damping_power(dynamics, now),
        orbital_slip=slip_below(dynamics, _rolling_speed(dynamics, now), now.rates.orbit),
        slide_to_roll_inner=slide_to_roll[0],
        slide_to_roll_outer=slide_to_roll[1],
        sliding_power_inner=sliding_power[0],
        sliding_power_outer=sliding_power[1],
        groove_loss_inner=in_groove[0],
        groove_loss_outer=in_groove[1],
        pocket_power=pocket_losses(now),
        pocket_angle=None if pocket is None else jnp.arctan2(pocket.direction[1], pocket.direction[0]),
        land_load=None if now.lands is None else now.lands.load,
    )


def _rolling_speed(dynamics: BallDynamics, now: MovingBalls) -> Float[Array, " ball"]:
    """Orbital speed at which every ball would roll without sliding at its contact angles and attitude, rad/s."""
    motion = dataclasses.replace(dynamics.kinematics, inner_speed=now.rates.races[0])
    angle, (w_x, w_r, _) = jnp.arctan2(now.meridian.sine, now.meridian.cosine), now.rates.spin
    return motion.rolling(angle[0], angle[1], jnp.arctan2(w_r, w_x)).orbital_speed


def slip_below(dynamics: BallDynamics, free: Array, speed: Array) -> Array:
    """Slip, 1 - `speed`/`free`, with the speed `free` of rolling without sliding; finite if `free` is 0."""
    least = 1e-8 * dynamics.kinematics.orbit_scale(free)
    return (free - speed) * free / (jnp.square(free) + jnp.square(least))


def _gaps(dynamics: BallDynamics, now: MovingBalls) -> Float[Array, " ball"] | None:
    """Gap between each ball and the next one, m; `None` with a cage."""
    if dynamics.neighbours is None:
        return None
    return neighbour_place(now.places).distance - 2.0 * dynamics.levers.ball_radius


def front_and_rear(pocket: PocketPlace, ahead: Array, behind: Array) -> Float[Array, "2 ball"]:
    """Values on the front and the rear half of every pocket, in the direction of the orbit.

    **Arguments:** `ahead`, `behind`: values on the wall towards which the ball is offset, and on the opposite wall."""
    forward = pocket.direction[0] >= 0
    return jnp.stack([jnp.where(forward, ahead, behind), jnp.where(forward, behind, ahead)])


def _ball_results(dynamics: BallDynamics, now: MovingBalls) -> BallResults:
    (w_x, w_r, w_t), speeds, pressed = now.rates.spin, now.speeds.races, now.pressed
    motion = BallMotion(now.rates.orbit, safe_norm(w_x, w_r), jnp.arctan2(w_r, w_x), w_t)
    angle = jnp.arctan2(now.meridian.sine, now.meridian.cosine)
    pressure = pressed.contact.hertz_pressure(now.load)
    ratio = jnp.abs(speeds.spin) / safe_norm(speeds.roll, 1e-12)
    more: dict[str, Any] = {}
    if pressed.film is not None:
        more |= dict(zip(("film_inner", "film_outer"), pressed.film.film, strict=True))
        if pressed.film.rise is not None:
            more |= dict(zip(("temperature_rise_inner", "temperature_rise_outer"), pressed.film.rise, strict=True))
    if now.walls is not None and now.pocket is not None:
        loads, films = (front_and_rear(now.pocket, *both) for both in (now.walls.load, now.walls.film))
        more |= dict(zip(("pocket_load_front", "pocket_load_rear"), loads, strict=True))
        more |= dict(zip(("pocket_film_front", "pocket_film_rear"), films, strict=True))
    seen: Any = (dynamics, _Seen(angle, motion))
    more |= computed_results(BallResults, SolvedBalls(*seen))
    return BallResults(
        azimuth=now.places.azimuth,
        load_inner=now.load[0],
        load_outer=now.load[1],
        contact_angle_inner=angle[0],
        contact_angle_outer=angle[1],
        pressure_inner=pressure[0],
        pressure_outer=pressure[1],
        orbital_speed=now.rates.orbit,
        spin_speed=motion.spin_speed,
        attitude_angle=motion.attitude,
        spin_to_roll_inner=ratio[0],
        spin_to_roll_outer=ratio[1],
        transverse_spin=w_t,
        sliding_inner=speeds.rolling[0],
        sliding_outer=speeds.rolling[1],
        traction_inner=now.friction.rolling[0],
        traction_outer=now.friction.rolling[1],
        spin_moment_inner=-now.friction.spin[0],
        spin_moment_outer=-now.friction.spin[1],
        **more,
    )


def _cage_motion(dynamics: BallDynamics, now: MovingBalls) -> CageMotion | None:
    """Motion of the cage in the plane of the bearing, with Y along the load line and X a quarter turn behind it; `None`
    without a cage."""
    if now.lands is None:
        return None
    speed = now.rates.cage[5]
    weight = now.load[0] + FORCE_FLOOR
    mean = jnp.sum(weight * _rolling_speed(dynamics, now)) / jnp.sum(weight)
    return CageMotion(
        x=-now.places.cage[2],
        y=now.places.cage[1],
        velocity_x=-now.rates.cage[2],
        velocity_y=now.rates.cage[1],
        speed=speed,
        slip=slip_below(dynamics, mean, speed),
        eccentricity_ratio=jnp.max(now.lands.eccentricity_ratio),
    )


def pocket_peaks(dynamics: BallDynamics, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks:
    """Largest loads in each time interval on the front and the rear half of every pocket, shape (interval, ball), and
    on every land, shape (interval, land).

    **Arguments:** `times`: several times within each interval, s; `states`: the states at these times, with a first
    axis of length `interval * part`.
    """

    def at_once(time: Array, state: ArrowPoint) -> PocketPeaks:
        place, walls, lands = dynamics.at_cage(time, state)
        return PocketPeaks(*front_and_rear(place, *walls.load), land=lands.load)

    peaks = jax.vmap(at_once)(times.reshape(-1), states)
    return jax.tree.map(lambda loads: jnp.max(loads.reshape(*times.shape, *loads.shape[1:]), axis=1), peaks)
