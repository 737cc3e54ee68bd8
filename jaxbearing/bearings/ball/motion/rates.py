r"""Equations of motion of a ball bearing: rates of the states of balls, cage and inner ring.

Every ball has six degrees of freedom: the orbit, three components of its spin, and the axial and the outward position.
Forces follow by transposition of the interaction speeds (`speeds`). With the generalised forces G on a ball,

$$m(r\ddot\psi + 2\dot r\dot\psi) = (G_\psi + G_{wx})/r,\quad \dot w_x = \ddot\psi + G_{wx}/J,\quad
\dot w_r = G_{wr}/J + \dot\psi w_t,\quad \dot w_t = G_{wt}/J - \dot\psi w_r,$$
$$m\ddot x = G_x,\qquad m\ddot r = G_r + mr\dot\psi^2 + F_0.$$

The gyroscopic terms are those of Euler's equations; they do no work. The normal load is that of the elastic contact
times $\max(1 + \chi\dot\delta, 0)$. The displaced inner groove also pushes the balls along the orbit, because its
motion enters the interaction speeds. Drag acts at the pitch circle. Ring and cage have small tilts and turn fast
(`bodies`).

Positions along the orbit are counted in a frame that turns at $w = w_{ref}\,\omega_i(t)/\omega_i$:
$q = R(\psi - \psi^0 - \int w)$, $v = R(\dot\psi - w)$. The states of the spin are the surface speeds $u = r_bw$ with
the components w of the spin. The units of the states are such that one tolerance suits all (`layout`). The energy
balance that follows from these equations is in `energy`.
"""

from typing import ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....gaps.ball_pocket_face import BallPocketFace
from ....gaps.meeting_balls import MetBalls
from ....numerics.arrow import ArrowPoint
from ....time_laws import AbstractTimeFactor, RotatingLoad, Steady
from ...motion.family import AbstractDynamics
from ...motion.frame import turning_frame
from ...motion.history import Energy, Instant, PocketPeaks
from ..arcs import Arcs
from ..core import FORCE_FLOOR
from ..kinematics import BallKinematics, BallMotion
from ..state import BallDrag
from .bodies import Lands, MovingCage, MovingRing, moving_lands
from .energy import WORKS, energy_of, powers
from .instants import observe, pocket_peaks
from .layout import BALL_UNITS, GLOBAL_UNITS, Places, Rates, tilt_levers
from .neighbours import Neighbours, NeighbourSpeeds, neighbour_place
from .races import AbstractRaceLaw, Pressed, RaceFriction
from .results import BallInstant
from .speeds import Levers, Meridian, PocketPlace, PocketSpeeds, Speeds

WORK_PART = 0.1
"""Unit of the works that are integrated with the state, over the kinetic energy of the balls at the operating point."""
LEAST_WORK = 1e-9
"""Lower limit of the unit of the works, J."""
SHARED = 22
"""Number of components of cage and ring in the state."""


class MovingBalls(NamedTuple):
    """Positions, speeds and forces at one instant. Fields that are not listed are described by their classes.

    - `load`: normal loads with contact damping, N; `pressed.load` is without damping.
    - `friction`: friction on the races; `pocket`, `walls`, `lands`: `None` without a cage.
    - `forces`: interaction forces on the side of the balls, conjugate to `speeds`; `generalised`: generalised forces,
      conjugate to `rates`.
    - `met`: contact between each ball and the next one; `None` with a cage.
    """

    places: Places
    rates: Rates
    meridian: Meridian
    speeds: Speeds
    pressed: Pressed
    load: Float[Array, "2 ball"]
    friction: RaceFriction
    pocket: PocketPlace | None
    walls: BallPocketFace | None
    lands: Lands | None
    forces: Speeds
    generalised: Rates
    met: MetBalls | None = None


class BallDynamics(AbstractDynamics):
    """Equations of motion of balls, cage and inner ring; parts that are `None` are not modelled.

    **Arguments:**
    - `kinematics`: diameters, and speeds of the rings at the operating point.
    - `levers`: lengths that speeds depend on; `azimuth`: azimuth of each ball in the frame at time 0, rad.
    - `mass`: mass of a ball, kg; `inertia`: moment of inertia of a ball, kg m^2.
    - `races`: law of the raceway contacts; `contact_damping`: contact damping chi, s/m.
    - `free_offset`: axial distance of a free ball from the plane of the outer groove centres, m; `free_radius`: outward
      distance of a free ball from the circle of these centres, m.
    - `ring`, `cage`: the bodies; `neighbours`: ball-to-ball contacts.
    - `drag`: drag on the orbiting balls; `drag_viscosity`: viscosity of the oil for the drag, Pa s.
    - `reference_speed`: speed of the frame in which positions are counted, at the operating point, rad/s.
    - `speed`, `load`: time laws of the speed of the inner ring and of all loads on it, over those of the operating
      point.
    - `rotating_load`: an additional rotating load.
    - `on_pitch_circle`: whether the pitch radius replaces the distance of a ball from the axis (`quasi_static`).
    """

    works: ClassVar[tuple[str, ...]] = WORKS

    kinematics: BallKinematics
    levers: Levers
    azimuth: Float[Array, " ball"]
    mass: Float[Array, ""]
    inertia: Float[Array, ""]
    races: AbstractRaceLaw
    contact_damping: Float[Array, ""]
    free_offset: Float[Array, ""]
    free_radius: Float[Array, ""]
    ring: MovingRing
    reference_speed: Float[Array, ""]
    cage: MovingCage | None = None
    neighbours: Neighbours | None = None
    drag: BallDrag | None = None
    drag_viscosity: Float[Array, ""] | None = None
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    rotating_load: RotatingLoad | None = None
    on_pitch_circle: bool = eqx.field(static=True, default=False)

    # -- operating point ------------------------------------------------------------------------------------------

    def frame(self, time: Scalar) -> tuple[Float[Array, ""], Float[Array, ""], Float[Array, ""]]:
        """Angle, rad, speed, rad/s, and acceleration, rad/s^2, of the frame in which positions are counted."""
        return turning_frame(self.reference_speed, self.speed, time)

    def race_speeds(self, time: Scalar) -> Float[Array, "2"]:
        """Speeds of the inner and the outer ring, rad/s."""
        return jnp.stack([self.kinematics.inner_speed * self.speed.factor(time), self.kinematics.outer_speed])

    def ring_load(self, time: Scalar) -> Float[Array, "5"]:
        """Loads on the inner ring, N and N m."""
        load = self.ring.load * self.load.factor(time)
        if self.rotating_load is None:
            return load
        return load.at[1:3].add(self.rotating_load.components(time))

    @property
    def arcs(self) -> Arcs:
        """Groove arcs of the rings; in transient runs each ring has one arc."""
        return Arcs()

    @property
    def work_unit(self) -> Float[Array, ""]:
        """Unit of the works, J (see `WORK_PART`)."""
        motion, speed = self.kinematics, self.reference_speed
        orbit = self.mass * jnp.square(self.levers.pitch_radius * speed)
        spin = self.inertia * jnp.square(speed / motion.ratio)
        return jnp.asarray(WORK_PART * 0.5 * self.azimuth.shape[0] * (orbit + spin) + LEAST_WORK)

    # -- state ----------------------------------------------------------------------------------------------------

    def scaled(self, balls: Float[Array, "9 ball"], shared: Float[Array, "22"]) -> ArrowPoint:
        """Scaled state from the components of `BALL_STATE` and `GLOBAL_STATE` in SI units; the works are 0."""
        works = jnp.zeros(len(WORKS))
        return ArrowPoint(
            balls / jnp.asarray(BALL_UNITS)[:, None], jnp.concatenate([shared / jnp.asarray(GLOBAL_UNITS), works])
        )

    def unscaled(self, state: ArrowPoint) -> tuple[Float[Array, "9 ball"], Float[Array, "22"], Float[Array, " work"]]:
        """Components of `BALL_STATE` and `GLOBAL_STATE` in SI units, and works, J, from the scaled state."""
        shared, works = state.globals[:SHARED] * jnp.asarray(GLOBAL_UNITS), state.globals[SHARED:] * self.work_unit
        return state.elements * jnp.asarray(BALL_UNITS)[:, None], shared, works

    def moving(self, time: Scalar, state: ArrowPoint) -> tuple[Places, Rates]:
        """Positions and speeds of all bodies."""
        balls, shared, _ = self.unscaled(state)
        turned, turning, _ = self.frame(time)
        pitch, ball = self.levers.pitch_radius, self.levers.ball_radius
        q, v, u_x, u_r, u_t, x, r, v_x, v_r = balls
        cage, cage_rates = shared[:6], shared[6:12]
        of_cage, of_ring = 1.0 / tilt_levers(pitch), 1.0 / tilt_levers(self.ring.lever)
        places = Places(
            azimuth=self.azimuth + turned + q / pitch,
            pockets=self.azimuth + turned + cage[5] / pitch,
            centre=jnp.stack([self.free_offset + x, self.free_radius + r]),
            offset=x,
            radius=pitch + (jnp.zeros_like(r) if self.on_pitch_circle else r),
            cage=cage[:5] * of_cage,
            ring=self.ring.held + shared[12:17] * of_ring,
        )
        rates = Rates(
            orbit=turning + v / pitch,
            spin=jnp.stack([u_x, u_r, u_t]) / ball,
            centre=jnp.stack([v_x, v_r]),
            cage=jnp.append(cage_rates[:5] * of_cage, turning + cage_rates[5] / pitch),
            ring=shared[17:22] * of_ring,
            races=self.race_speeds(time),
        )
        return places, rates

    def at(self, time: Scalar, state: ArrowPoint) -> MovingBalls:
        """Positions, speeds, loads and forces in a given state."""
        places, rates = self.moving(time, state)
        meridian = self.levers.meridian(places)
        speeds, transpose = jax.vjp(lambda rate: self.levers.speeds(places, meridian, rate), rates)
        approach = meridian.distance - self.levers.grooves.offset[:, None]
        pressed = self.races.pressed(approach, meridian, speeds.races)
        load = pressed.load * jnp.maximum(1.0 + self.contact_damping * speeds.apart, 0.0)
        friction = self.races.friction(pressed, load, speeds.races)
        pocket = walls = lands = on_pocket = met = on_neighbours = None
        if self.cage is not None:
            assert speeds.pocket is not None
            assert speeds.lands is not None
            pocket = self.levers.pocket_place(places)
            walls = self.cage.walls(pocket, speeds.pocket)
            rubbing = -jnp.stack([walls.friction_along, walls.friction_across], axis=1)
            on_pocket = PocketSpeeds(walls.load[1] - walls.load[0], rubbing)
            lands = moving_lands(self.cage, self.levers.land_offsets(places), speeds.lands)
        if self.neighbours is not None:
            assert speeds.neighbours is not None
            met = self.neighbours.contacts(neighbour_place(places), places, rates)
            on_neighbours = NeighbourSpeeds(met.load, -met.friction[None] * speeds.neighbours.sliding)
        forces = Speeds(
            apart=-load,
            races=friction.on(speeds.races),
            drag=-self.drag_force(speeds.drag),
            pocket=on_pocket,
            lands=None if lands is None else lands.forces,
            neighbours=on_neighbours,
        )
        return MovingBalls(
            places=places,
            rates=rates,
            meridian=meridian,
            speeds=speeds,
            pressed=pressed,
            load=load,
            friction=friction,
            pocket=pocket,
            walls=walls,
            lands=lands,
            forces=forces,
            generalised=transpose(forces)[0],
            met=met,
        )

    def at_cage(self, time: Scalar, state: ArrowPoint) -> tuple[PocketPlace, BallPocketFace, Lands]:
        """The part of `at` that belongs to the cage: offsets of the balls in their pockets, pocket walls and lands."""
        assert self.cage is not None
        places, rates = self.moving(time, state)
        pocket = self.levers.pocket_place(places)
        walls = self.cage.walls(pocket, self.levers.pocket_speeds(places, rates))
        lands = moving_lands(self.cage, self.levers.land_offsets(places), self.levers.land_speeds(rates))
        return pocket, walls, lands

    def centrifugal(self, orbital_speed: Array) -> Array:
        """Centrifugal force of balls on the pitch circle, N."""
        return self.mass * self.levers.pitch_radius * jnp.square(orbital_speed)

    def couple(self, motion: BallMotion) -> Array:
        """The gyroscopic couple about the tangent of the orbit, N m."""
        return self.inertia * motion.orbital_speed * motion.radial_spin

    def drag_force(self, speed: Array) -> Array:
        """Drag on the orbiting balls, N, with the sign of their speed, m/s."""
        if self.drag is None or self.drag_viscosity is None:
            return jnp.zeros_like(speed)
        return self.drag.force(speed, self.drag_viscosity)

    # -- rates ----------------------------------------------------------------------------------------------------

    def rates(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """Derivatives of the scaled state by time, 1/s."""
        now = self.at(time, state)
        balls, shared, _ = self.unscaled(state)
        pitch, frame = self.levers.pitch_radius, self.levers.pitch_radius * self.frame(time)[2]
        orbit, spin, centre = self.ball_accelerations(now)
        elements = jnp.concatenate(
            [
                jnp.stack([balls[1], pitch * orbit - frame]),
                self.levers.ball_radius * spin,
                balls[7:9],
                centre,
            ]
        )
        rings = now.rates.ring
        on_ring = now.generalised.ring + self.ring_load(time) + self.ring.damping_force(rings)
        moved = tilt_levers(self.ring.lever) * self.ring.acceleration(on_ring, rings, now.rates.races[0])
        together = jnp.concatenate([*self._cage_rates(now, shared, frame), shared[17:22], moved])
        works = powers(self, time, now) / self.work_unit
        return ArrowPoint(
            elements / jnp.asarray(BALL_UNITS)[:, None],
            jnp.concatenate([together / jnp.asarray(GLOBAL_UNITS), works]),
        )

    def ball_accelerations(
        self, now: MovingBalls
    ) -> tuple[Float[Array, " ball"], Float[Array, "3 ball"], Float[Array, "2 ball"]]:
        """Accelerations of orbit and spin, rad/s^2, and of the centre in the plane of the groove, m/s^2."""
        pulled, (radius, orbit) = now.generalised, (now.places.radius, now.rates.orbit)
        (_, w_r, w_t), outward = now.rates.spin, now.rates.centre[1]
        along = (pulled.orbit + pulled.spin[0]) / (self.mass * radius) - 2.0 * outward * orbit
        turning = along / radius
        zero = jnp.zeros_like(turning)
        spin = pulled.spin / self.inertia + jnp.stack([turning, orbit * w_t, -orbit * w_r])
        centrifugal = radius * jnp.square(orbit) + FORCE_FLOOR / self.mass
        return turning, spin, pulled.centre / self.mass + jnp.stack([zero, centrifugal])

    def _cage_rates(self, now: MovingBalls, shared: Float[Array, "22"], frame: Array) -> tuple[Array, Array]:
        """Speeds and accelerations of the components of `CAGE_STATE`; 0 without a cage."""
        if self.cage is None:
            return jnp.zeros(6), jnp.zeros(6)
        pitch = self.levers.pitch_radius
        angle = now.places.pockets[0] - self.azimuth[0]
        moved = self.cage.acceleration(now.generalised.cage, now.rates.cage, angle)
        return shared[6:12], moved * jnp.append(tilt_levers(pitch), pitch) - jnp.append(jnp.zeros(5), frame)

    def nested_rates(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint, tolerance: Scalar
    ) -> tuple[ArrowPoint, ArrowPoint]:
        return self.rates(time, state), guess

    def first_guess(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        return ArrowPoint(jnp.zeros((0, state.elements.shape[1])), jnp.zeros(0))

    # -- results --------------------------------------------------------------------------------------------------

    def observe(self, time: Scalar, state: ArrowPoint) -> Instant:
        return observe(self, time, state)

    def peaks(self, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks | None:
        return None if self.cage is None else pocket_peaks(self, times, states)

    def energy(self, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
        assert isinstance(first, BallInstant)
        assert isinstance(last, BallInstant)
        return energy_of(self, state, first, last)
