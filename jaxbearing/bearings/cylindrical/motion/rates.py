r"""Equations of motion of rollers and cage of the moving cylindrical roller bearing (source eqs. (27)-(41)).

The state of roller j is $q_j = R_m(\Psi_j - \Psi^0_j - \int w)$, $v_j = R_m(W_j - w)$, $u_j = R_R s_j$. The state of
the cage is its centre X, Y, $q_c = R_m(\Psi_c - \int w)$ and the speeds $V_x, V_y, v_c = R_m(W_c - w)$. The frame turns
at $w = w_{ref}\,\omega_i(t)/\omega_i$, in proportion to the shaft, so that positions stay small and are resolved. The
units of the components (`ROLLER_UNITS`, `CAGE_UNITS`) let one tolerance serve for all of them. Loads and ring
displacement are not part of the state; they follow from it (`loads.distributed_loads`). Frames and signs: see
`cylindrical.scene`. The equations of motion of a roller are

$$m\dot v = Q_2 - Q_1 - F_{OL} + F_i - F_o + F_E + F_{Ec} + F_P,\qquad
J(\dot v/R_m - \dot u/R_R) = R_R(F_{C1} + F_{C2} - F_i - F_o) + M_{flange} + M_{rail} + \tfrac12R_R(P_i + P_o)$$

Pocket walls and side rails rub on a roller with its spin against the cage, $s + W_c - W$. The reactions of the rollers
and the forces of the lands act on the cage. A pocket wall is a compliant squeeze film
(`gaps.CompliantPocketFace`) in the gap $H_1 = J_p/2 + q_c - q_j - (X\cos\Psi + Y\sin\Psi)$ in front of the roller, or
$H_2 = J_p - H_1$ behind it. `energy` has the energy balance that follows from these equations.
"""

from typing import TYPE_CHECKING, ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....contacts.laws import ContactState
from ....gaps import CompliantPocketFace
from ....numerics.arrow import ArrowPoint
from ....numerics.series import cosine_and_sine
from ....time_laws import AbstractTimeFactor, RotatingLoad, Steady
from ...motion.family import AbstractDynamics
from ...motion.frame import turning_frame
from ...motion.history import Energy, Instant, PocketPeaks
from ...mounted import running_play
from ...ring_shape import InnerRoundness, OuterRoundness, out_of_round
from ..equations import LubricatedRollerSystem
from ..forces import RollerForces, forces_without_pocket, on_cage
from ..kinematics import RollerKinematics
from ..loads import Distribution, RaceLoads, distributed_loads
from .cage_forces import LandForces, PocketState, RingShift, land_forces, pocket_state
from .energy import WORKS, energy_of, powers
from .instants import observe, pocket_peaks
from .results import RollerInstant

if TYPE_CHECKING:
    from ..scene import CylindricalRollerBearing

ROLLER_UNITS = (1e-5, 0.1, 1.0)
"""Units of q, m, v, m/s, and u, m/s. The tolerance of the integration is relative and, in these units, absolute: at
1e-4 it holds q to 1e-9 m, v to 1e-5 m/s and u to 1e-4 m/s."""
CAGE_UNITS = (1e-5, 1e-5, 1e-5, 0.1, 0.1, 0.1)
"""Units of X, Y and q_c, m, and of V_x, V_y and v_c, m/s."""
WORK_PART = 0.1
"""Unit of the works in the state, divided by the kinetic energy of the rollers at the operating point. It is so large
that the works do not control the step size (some 100 J in a turbine), and it becomes smaller for slow bearings."""
LEAST_WORK = 1e-9
"""Lower limit of the unit of the works, J."""
LOAD_TOLERANCE = 0.3
"""Largest scaled residual of the load distribution before the last Newton step, divided by the square root of the
integration's tolerance. The last step squares the residual: loads are then found to a tenth of that tolerance, and
their derivatives to 1e-7 at a tolerance of 1e-5."""
FINE = 1e-11
"""Tolerance of the integration that decides how exactly the loads are found, if none is given."""
LOAD_STEPS = 40
"""Largest number of Newton steps for one load distribution."""
LOAD_FAILURE = 2.0
"""The rates are NaN if the residual of the loads is larger than its tolerance times this factor; the integrator then
rejects the step and shortens it."""


class MovingState(NamedTuple):
    """Speeds, films and forces at one instant. The last axis of arrays runs over the rollers; a first axis of length 2
    runs over the races (inner, outer).

    - `azimuth`: rad; `orbit`, `spin`: orbital speed and spin of each roller, rad/s; `cage_orbit`: cage speed, rad/s.
    - `centre`, m, and `velocity`, m/s: of the cage along X and Y.
    - `mean_speed`, `sliding_speed`: of the surfaces on each race, m/s.
    - `tangential`, N, and `moment`, N m: sums of the forces along the orbit and of the moments on each roller.
    - `cage_force`, N, and `cage_moment`, N m: sums on the cage.
    - Other fields: see their classes.
    """

    motion: RollerKinematics
    azimuth: Float[Array, " roller"]
    orbit: Float[Array, " roller"]
    spin: Float[Array, " roller"]
    cage_orbit: Float[Array, ""]
    centre: Float[Array, "2"]
    velocity: Float[Array, "2"]
    distribution: Distribution
    mean_speed: Float[Array, "2 roller"]
    sliding_speed: Float[Array, "2 roller"]
    contact: ContactState
    forces: RollerForces
    pocket: PocketState | None
    land: LandForces | None
    tangential: Float[Array, " roller"]
    moment: Float[Array, " roller"]
    cage_force: Float[Array, "2"]
    cage_moment: Float[Array, ""]


class RollerDynamics(AbstractDynamics):
    """Equations of motion of rollers and cage. A part that is `None` is not modelled.

    **Arguments:**
    - `system`: equations of the steady bearing at the operating point, with the oil at its inlet temperature. Their
      raceways, roller ends, drag and lands are used; their rigid pocket films are not.
    - `reference_speed`: w_ref, speed at the operating point of the frame in which positions are counted, rad/s.
    - `roller_inertia`: J, moment of inertia of a roller about its axis, kg m^2.
    - `cage_mass`, kg, and `cage_inertia`: J_c, about the bearing axis, kg m^2; `None`: there is no cage, and its states
      stay constant.
    - `pocket`: model of the film on one pocket wall; `None`: rollers do not touch the cage.
    - `pocket_clearance`: J_p, total circumferential clearance of a roller in its pocket, m.
    - `speed`, `load`: speed of the inner ring and radial load over time, divided by those of the operating point.
    - `rotating_load`: additional load that rotates; it requires the ring to be free in both directions.
    - `land_speed`: cage speed at which the turbulence of the land films is evaluated, rad/s; `None`: the current one.
    - `seats`: scene with the dimensions of the drawing, from which the clearance at the current speed is computed;
      `None`: the clearance is constant.
    - `inner_roundness`, `outer_roundness`: deviations of raceways that are not round, stationary relative to the load;
      `None`: they are round.
    """

    works: ClassVar[tuple[str, ...]] = WORKS

    system: LubricatedRollerSystem
    reference_speed: Float[Array, ""]
    roller_inertia: Float[Array, ""]
    cage_mass: Float[Array, ""] | None
    cage_inertia: Float[Array, ""] | None
    pocket: CompliantPocketFace | None = None
    pocket_clearance: Float[Array, ""] | None = None
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    rotating_load: RotatingLoad | None = None
    land_speed: Float[Array, ""] | None = None
    seats: "CylindricalRollerBearing | None" = None
    inner_roundness: InnerRoundness | None = None
    outer_roundness: OuterRoundness | None = None

    def __check_init__(self):
        if self.rotating_load is not None and "lateral" not in self.system.freedoms:
            raise ValueError("a rotating load needs ring_freedom = ('radial', 'lateral')")

    # -- operating point ------------------------------------------------------------------------------------------

    def motion(self, time: Scalar) -> RollerKinematics:
        """Kinematics of the rollers at the ring speeds of this time."""
        steady = self.system.kinematics
        return eqx.tree_at(lambda m: m.inner_speed, steady, steady.inner_speed * self.speed.factor(time))

    def frame(self, time: Scalar) -> tuple[Float[Array, ""], Float[Array, ""], Float[Array, ""]]:
        """Angle, rad, speed, rad/s, and acceleration, rad/s^2, of the frame in which positions are counted."""
        return turning_frame(self.reference_speed, self.speed, time)

    def ring_load(self, time: Scalar) -> Float[Array, " freedom"]:
        """Load on the inner ring along its degrees of freedom, N."""
        load = self.system.ring.load * self.load.factor(time)
        return load if self.rotating_load is None else load + self.rotating_load.components(time)

    @property
    def work_unit(self) -> Float[Array, ""]:
        """Unit of the works, J, see `WORK_PART`."""
        motion = self.system.kinematics
        speed = motion.pitch_radius * self.reference_speed
        rollers = 0.5 * self.system.azimuth.shape[0] * self.system.roller_mass * jnp.square(speed)
        spin = 0.5 * self.system.azimuth.shape[0] * self.roller_inertia * jnp.square(motion.free_spin)
        return jnp.asarray(WORK_PART * (rollers + spin) + LEAST_WORK)

    # -- state ----------------------------------------------------------------------------------------------------

    def scaled(self, rollers: Float[Array, "3 roller"], cage: Float[Array, "6"]) -> ArrowPoint:
        """State of a run, with all works 0. **Arguments:** `rollers`: q, v, u; `cage`: X, Y, q_c, V_x, V_y, v_c; in SI
        units."""
        works = jnp.zeros(len(WORKS))
        return ArrowPoint(
            rollers / jnp.asarray(ROLLER_UNITS)[:, None], jnp.concatenate([cage / jnp.asarray(CAGE_UNITS), works])
        )

    def unscaled(self, state: ArrowPoint) -> tuple[Float[Array, "3 roller"], Float[Array, "6"], Float[Array, " work"]]:
        """Components of a state in SI units: q, v, u; X, Y, q_c, V_x, V_y, v_c; works in the order of `WORKS`, J."""
        cage, works = state.globals[:6] * jnp.asarray(CAGE_UNITS), state.globals[6:] * self.work_unit
        return state.elements * jnp.asarray(ROLLER_UNITS)[:, None], cage, works

    def race_loads(self, time: Scalar, state: ArrowPoint) -> RaceLoads:
        """Equations of the load distribution."""
        system, motion = self.system, self.motion(time)
        azimuth, orbit, spin = self._places(time, state)
        mean_speed, sliding = motion.surface_speeds(orbit - motion.free_orbit, spin - motion.free_spin)
        return RaceLoads(
            contact=system.contact,
            laws=system.laws,
            oil=system.oil,
            inlet=system.inlet,
            directions=self.directions(azimuth),
            mean_speed=mean_speed,
            sliding_speed=sliding,
            centrifugal=system.centrifugal(orbit),
            ring_load=self.ring_load(time),
            radial_clearance=self._opening(motion, azimuth),
        )

    def _opening(self, motion: RollerKinematics, azimuth: Float[Array, " roller"]) -> Float[Array, "*roller"]:
        """Half the diametral clearance, m; if a raceway is not round, the radial opening of the rings at each
        roller."""
        clearance = self._radial_clearance(motion)
        form = out_of_round(self.inner_roundness, self.outer_roundness, azimuth)
        return clearance if form is None else clearance - form

    def _radial_clearance(self, motion: RollerKinematics) -> Float[Array, ""]:
        """Half the diametral clearance at the current speed, m. Rings and seats expand without delay; all other
        dimensions stay those of the operating point."""
        if self.seats is None:
            return self.system.radial_clearance
        return 0.5 * running_play(self.seats.at_operation(inner_speed=motion.inner_speed)).measure

    def _places(self, time: Scalar, state: ArrowPoint) -> tuple[Array, Array, Array]:
        """Azimuths, rad, orbital speeds and spins, rad/s, of the rollers."""
        (q, v, u), _, _ = self.unscaled(state)
        motion, (turned, turning, _) = self.system.kinematics, self.frame(time)
        pitch = motion.pitch_radius
        return self.system.azimuth + q / pitch + turned, turning + v / pitch, u / motion.roller_radius

    def at(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint | None = None, tolerance: Scalar = FINE
    ) -> MovingState:
        """Speeds, films and forces of one state.

        **Arguments:**
        - `guess`: initial guess of the load distribution, the `Distribution.point` of a similar state.
        - `tolerance`: tolerance of the integration; it decides how exactly the loads are found.
        """
        system, motion = self.system, self.motion(time)
        (q, v, u), (x, y, q_c, v_x, v_y, v_c), _ = self.unscaled(state)
        pitch, (_, turning, _) = motion.pitch_radius, self.frame(time)
        azimuth, orbit, spin = self._places(time, state)
        loads = self.race_loads(time, state)
        mean_speed, sliding = loads.mean_speed, loads.sliding_speed
        distribution = distributed_loads(loads, LOAD_TOLERANCE * jnp.sqrt(tolerance), LOAD_STEPS, guess)
        contact = system.laws.evaluate(system.contact, distribution.load, mean_speed, sliding, system.oil, system.inlet)
        parts = system.cage
        assert parts is not None
        cage_orbit = turning + v_c / pitch
        forces = forces_without_pocket(motion, system.contact, contact, parts, orbit, spin, orbit - cage_orbit)
        tangential, moment = forces.tangential, forces.moment
        pocket, land = None, None
        force, cage_moment = jnp.zeros(2), jnp.zeros(())
        centre, velocity = jnp.stack([x, y]), jnp.stack([v_x, v_y])
        if self.pocket is not None:
            pocket = self.pocket_state((q, v, u), (x, y, q_c), (v_x, v_y, v_c), azimuth, orbit)
            front, rear = pocket.front, pocket.rear
            tangential = tangential + rear.load - front.load
            moment = moment + motion.roller_radius * (front.friction + rear.friction)
            moments, reactions = on_cage(
                motion, azimuth, (front.load, rear.load), (front.friction, rear.friction), forces.rails
            )
            force, cage_moment = force + jnp.sum(reactions, axis=1), cage_moment + jnp.sum(moments)
        if parts.land is not None:
            turbulence = cage_orbit if self.land_speed is None else self.land_speed
            shift = RingShift(distribution.ring, system.freedoms)
            land = land_forces(parts, system.inlet, motion, shift, centre, velocity, cage_orbit, turbulence)
            force, cage_moment = force + land.force, cage_moment + land.cage_torque
        return MovingState(
            motion=motion,
            azimuth=azimuth,
            orbit=orbit,
            spin=spin,
            cage_orbit=cage_orbit,
            centre=centre,
            velocity=velocity,
            distribution=distribution,
            mean_speed=mean_speed,
            sliding_speed=sliding,
            contact=contact,
            forces=forces,
            pocket=pocket,
            land=land,
            tangential=tangential,
            moment=moment,
            cage_force=force,
            cage_moment=cage_moment,
        )

    def directions(self, azimuth: Float[Array, " roller"]) -> Float[Array, "freedom roller"]:
        """Components of the outward unit vectors at the rollers along the degrees of freedom of the ring."""
        cosine, sine = cosine_and_sine(azimuth)
        along = {"radial": cosine, "lateral": sine}
        return jnp.stack([along[name] for name in self.system.freedoms])

    def pocket_state(
        self,
        rollers: tuple[Array, Array, Array],
        place: tuple[Array, Array, Array],
        velocity: tuple[Array, Array, Array],
        azimuth: Float[Array, " roller"],
        orbit: Float[Array, " roller"],
    ) -> PocketState:
        """Contacts with both walls of every pocket, see `cage_forces.pocket_state`."""
        assert self.pocket is not None
        assert self.pocket_clearance is not None
        viscosity, pitch = self.system.inlet.viscosity, self.system.kinematics.pitch_radius
        moving = (rollers, place, velocity, azimuth, orbit)
        return pocket_state(self.pocket, self.pocket_clearance, viscosity, *moving, pitch)

    # -- rates ----------------------------------------------------------------------------------------------------

    def rates(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """Rates of the state, 1/s; NaN if no load distribution is found."""
        return self.nested_rates(time, state)[0]

    def nested_rates(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint | None = None, tolerance: Scalar = FINE
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """Rates of the state, and the load distribution as `RaceLoads.smoothed`, which changes smoothly over time.

        **Arguments:** `guess`: of the load distribution, in the same form; `tolerance`: of the integration.
        """
        loads = self.race_loads(time, state)
        now = self.at(time, state, None if guess is None else loads.unsmoothed(guess), tolerance)
        motion, (_, v, _), cage = now.motion, *self.unscaled(state)[:2]
        acceleration = now.tangential / self.system.roller_mass
        frame_acceleration = motion.pitch_radius * self.frame(time)[2]
        spinning = motion.roller_radius * (acceleration / motion.pitch_radius - now.moment / self.roller_inertia)
        if self.cage_mass is None or self.cage_inertia is None:
            # no cage: its states are frozen
            moving = jnp.zeros(6)
        else:
            linear = now.cage_force / self.cage_mass
            angular = motion.pitch_radius * now.cage_moment / self.cage_inertia
            moving = jnp.concatenate([cage[3:], linear, (angular - frame_acceleration)[None]])
        works = powers(self, time, now) / self.work_unit
        rollers = jnp.stack([v, acceleration - frame_acceleration, spinning]) / jnp.asarray(ROLLER_UNITS)[:, None]
        rates = ArrowPoint(rollers, jnp.concatenate([moving / jnp.asarray(CAGE_UNITS), works]))
        good = now.distribution.residual < LOAD_FAILURE * LOAD_TOLERANCE * jnp.sqrt(tolerance)
        return jax.tree.map(lambda rate: jnp.where(good, rate, jnp.nan), rates), loads.smoothed(now.distribution.point)

    def first_guess(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        loads = self.race_loads(time, state)
        return loads.smoothed(loads.initial())

    # -- results --------------------------------------------------------------------------------------------------

    def observe(self, time: Scalar, state: ArrowPoint) -> RollerInstant:
        return observe(self, time, state)

    def peaks(self, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks | None:
        return None if self.pocket is None else pocket_peaks(self, times, states)

    def energy(self, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
        assert isinstance(first, RollerInstant)
        assert isinstance(last, RollerInstant)
        return energy_of(self, state, first, last)
