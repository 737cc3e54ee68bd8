r"""The moving cylindrical roller bearing: rate of change of rollers and cage (source eqs. (27)-(41)).

State of roller j: $q_j = R_m(\Psi_j - \Psi^0_j - \int w)$, $v_j = R_m(W_j - w)$, $u_j = R_R s_j$; of the cage: its
centre X, Y, $q_c = R_m(\Psi_c - \int w)$ and the speeds $V_x, V_y, v_c = R_m(W_c - w)$. The frame turns at
$w = w_{ref}\,\omega_i(t)/\omega_i$, in proportion to the shaft, so that positions stay small and are resolved. All
are in units (`ROLLER_UNITS`, `CAGE_UNITS`) with which one tolerance serves for all. Loads and ring displacement follow
from the state (`motion.loads.distributed_loads`): they are no part of it. Frames and signs: see `cylindrical.scene`.

$$m\dot v = Q_2 - Q_1 - F_{OL} + F_i - F_o + F_E + F_{Ec} + F_P,\qquad
J(\dot v/R_m - \dot u/R_R) = R_R(F_{C1} + F_{C2} - F_i - F_o) + M_{flange} + M_{rail} + \tfrac12R_R(P_i + P_o)$$

and the cage by the reactions and by its lands. A pocket wall is a compliant squeeze film (`gaps.CompliantPocketFace`)
in the gap $H_1 = J_p/2 + q_c - q_j - (X\cos\Psi + Y\sin\Psi)$ in front, $H_2 = J_p - H_1$ behind.

**Energy.** Multiplying each equation of motion by its speed gives, exactly,

$$\frac{dE_{kin}}{dt} = \omega_iT_i + \omega_oT_o - \sum D - \Pi - \Lambda,$$

$E_{kin} = \sum_j[\tfrac12 m R_m^2W_j^2 + \tfrac12J(W_j - s_j)^2] + \tfrac12 m_c(V_x^2 + V_y^2) + \tfrac12J_cW_c^2$,
T the torques that drive the rings, and

- dissipations D, each its own force times its own sliding speed: raceways $F\,\Delta u$, rolling resistance
  $P\,u$, pocket friction $(F_{C1} + F_{C2})R_R(s + W_c - W) - (F_{C1} - F_{C2})\,V\cdot n$, flanges, rails, lands,
  drag;
- $\Pi = -\sum(Q_1\dot H_1 + Q_2\dot H_2)$: work that closes the pocket films. A part is stored by their elastic
  flattening, $E_{pocket} = \sum\frac{0.9}{1.9}kQ^{1.9}$, the rest squeezes oil out;
- $\Lambda = \sum(Q_1 - Q_2)(X\sin\Psi - Y\cos\Psi)W_j$: neglected by the model, which takes the moment of the pocket
  loads on the cage about the bearing's centre instead of about the cage's (eq. (33)).

The radial direction is quasi-static and a balance of its own (the derivative of eq. (38), weighted by Q):

$$F\cdot\dot d = \frac{dE_{race}}{dt} - \Omega - \sum Q_i\frac{d(h_i + h_o)}{dt} - \sum F_c\frac{d\delta_o}{dt},$$

$E_{race} = \sum\frac{0.9}{1.9}(k_iQ_i^{1.9} + k_oQ_o^{1.9})$: the work of the load on the ring is stored by the
raceways but for the work on the films, that of the centrifugal force, and $\Omega = \sum Q_i\,(d\cdot t)\,W_j$:
rollers roll into the wedge between displaced rings, and the model neglects the tangential force $Q_i\,(d\cdot t)/R_m$
that would pay for it. The identities hold to round-off at every state, and `tests` check them so.
"""

from typing import TYPE_CHECKING, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar
from ...contacts.laws import ContactState
from ...gaps import CompliantPocketFace
from ...gaps.pocket import PocketFace
from ...numerics.arrow import ArrowPoint
from ...numerics.series import cosine_and_sine
from ...time_laws import AbstractTimeFactor, RotatingLoad, Steady
from ..cylindrical.equations import LubricatedRollerSystem
from ..cylindrical.forces import RollerForces, forces_without_pocket, friction_on_rings, on_cage
from ..cylindrical.kinematics import RollerKinematics
from ..cylindrical.solution import PowerLoss
from ..interactions import Costs, Interaction, costs, of_land
from ..mounted import running_play
from .loads import Distribution, RaceLoads, distributed_loads

if TYPE_CHECKING:
    from ..cylindrical.scene import CylindricalRollerBearing

ROLLER_UNITS = (1e-5, 0.1, 1.0)
"""Units of q, m, v and u, m/s: with the same tolerance, absolute in these units and relative, q is held to 1e-9 m, v
to 1e-5 m/s and u to 1e-4 m/s at 1e-4."""
CAGE_UNITS = (1e-5, 1e-5, 1e-5, 0.1, 0.1, 0.1)
"""Units of X, Y, q_c, m, and their speeds, m/s."""
WORK_PART = 0.1
"""Unit of the works that are integrated beside the state, over the rollers' kinetic energy at the operating point: so
large that they do not steer the step (some 100 J in a turbine), and in proportion also where all turns slowly."""
LEAST_WORK = 1e-9
"""That the unit of the works is at least, J."""
WORKS = ("drive", "dissipation", "pocket_films", "lever_arm", "load")
LOAD_TOLERANCE = 0.3
"""Scaled residual of the load distribution before the last step, which squares it, over the root of the integration's
tolerance: loads are found to a tenth of that, their derivatives to 1e-7 at 1e-5."""
FINE = 1e-11
"""Tolerance for which loads are found where none is given."""
LOAD_STEPS = 40
LOAD_FAILURE = 2.0
"""That residual over its tolerance from which on the rates are NaN: the step is then rejected and shortened."""
_PALMGREN_ENERGY = 0.9 / 1.9


class LandForces(NamedTuple):
    """Both lands: force and torque on the cage, torque on the guiding ring, dissipation, eccentricity ratio."""

    force: Float[Array, "2"]
    cage_torque: Float[Array, ""]
    ring_torque: Float[Array, ""]
    power: Float[Array, ""]
    eccentricity_ratio: Float[Array, ""]


class PocketState(NamedTuple):
    """Both walls of every pocket, and the rates at which their gaps open, m/s."""

    front: PocketFace
    rear: PocketFace
    gap_rate: Float[Array, " roller"]


class MovingState(NamedTuple):
    """Everything that happens at one instant; arrays over rollers, races first where two."""

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


class RollerDynamics(eqx.Module):
    """Rollers and cage in motion; a part that is `None` is not there.

    **Arguments:**
    - `system`: raceways, roller ends, drag and land, with the oil at its inlet temperature, at the operating point.
      Its rigid pocket films are not used.
    - `reference_speed`: w_ref, rad/s: of the frame in which positions are counted, at the operating point.
    - `roller_inertia`: J, kg m^2; `cage_mass`, kg; `cage_inertia`: J_c, kg m^2, about the bearing axis; `None` without
      a cage, whose states then stand still.
    - `pocket`: film on one wall of a pocket; `None`: rollers do not meet the cage.
    - `speed`, `load`: the inner ring's speed and the radial load over those of the operating point.
    - `rotating_load`: a further, turning load; it needs a ring that is free in both directions.
    - `land_speed`: cage speed at which the lands' turbulence is evaluated, rad/s; `None`: the current one.
    - `seats`: the scene on the drawing of a bearing whose clearance follows the current speed; `None`: it stays.
    """

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

    def __check_init__(self):
        if self.rotating_load is not None and "lateral" not in self.system.freedoms:
            raise ValueError("a rotating load needs ring_freedom = ('radial', 'lateral')")

    # -- operating point ------------------------------------------------------------------------------------------

    def motion(self, time: Scalar) -> RollerKinematics:
        """Speeds of the rings."""
        steady = self.system.kinematics
        return eqx.tree_at(lambda m: m.inner_speed, steady, steady.inner_speed * self.speed.factor(time))

    def frame(self, time: Scalar) -> tuple[Float[Array, ""], Float[Array, ""], Float[Array, ""]]:
        """Angle, rad, speed and acceleration of the frame in which positions are counted."""
        time = jnp.asarray(time, dtype=float)
        factor, rate = jax.jvp(self.speed.factor, (time,), (jnp.ones_like(time),))
        return (
            self.reference_speed * self.speed.integral(time),
            self.reference_speed * factor,
            self.reference_speed * rate,
        )

    def ring_load(self, time: Scalar) -> Float[Array, " freedom"]:
        """Load on the inner ring along its freedoms, N."""
        load = self.system.ring.load * self.load.factor(time)
        return load if self.rotating_load is None else load + self.rotating_load.components(time)

    @property
    def work_unit(self) -> Float[Array, ""]:
        """J, see `WORK_PART`."""
        motion = self.system.kinematics
        speed = motion.pitch_radius * self.reference_speed
        rollers = 0.5 * self.system.azimuth.shape[0] * self.system.roller_mass * jnp.square(speed)
        spin = 0.5 * self.system.azimuth.shape[0] * self.roller_inertia * jnp.square(motion.free_spin)
        return jnp.asarray(WORK_PART * (rollers + spin) + LEAST_WORK)

    # -- state ----------------------------------------------------------------------------------------------------

    def scaled(self, rollers: Float[Array, "3 roller"], cage: Float[Array, "6"]) -> ArrowPoint:
        """State, with works of 0, from q, v, u and from X, Y, q_c, V_x, V_y, v_c, SI."""
        works = jnp.zeros(len(WORKS))
        return ArrowPoint(
            rollers / jnp.asarray(ROLLER_UNITS)[:, None], jnp.concatenate([cage / jnp.asarray(CAGE_UNITS), works])
        )

    def unscaled(self, state: ArrowPoint) -> tuple[Float[Array, "3 roller"], Float[Array, "6"], Float[Array, " work"]]:
        """q, v, u; X, Y, q_c, V_x, V_y, v_c; works in the order of `WORKS`, J."""
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
            radial_clearance=self._radial_clearance(motion),
        )

    def _radial_clearance(self, motion: RollerKinematics) -> Float[Array, ""]:
        """Half the clearance at the current speed: rings and seats grow at once. Other sizes stay as at the operating
        point."""
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
        """All forces. **Arguments:** `guess` of the load distribution (`Distribution.point` of a state nearby);
        `tolerance`: of an integration that asks."""
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
        forces = forces_without_pocket(motion, system.contact, contact, parts, orbit, spin)
        tangential, moment = forces.tangential, forces.moment
        pocket, land = None, None
        force, cage_moment = jnp.zeros(2), jnp.zeros(())
        cage_orbit = turning + v_c / pitch
        centre, velocity = jnp.stack([x, y]), jnp.stack([v_x, v_y])
        if self.pocket is not None:
            pocket = self._pocket((q, v, u), (x, y, q_c), (v_x, v_y, v_c), azimuth, orbit)
            front, rear = pocket.front, pocket.rear
            tangential = tangential + rear.load - front.load
            moment = moment + motion.roller_radius * (front.friction + rear.friction)
            moments, reactions = on_cage(
                motion, azimuth, (front.load, rear.load), (front.friction, rear.friction), forces.rails
            )
            force, cage_moment = force + jnp.sum(reactions, axis=1), cage_moment + jnp.sum(moments)
        if parts.land is not None:
            land = self._land(motion, distribution.ring, centre, velocity, cage_orbit)
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
        """Outward unit vectors at the rollers along the freedoms of the ring."""
        cosine, sine = cosine_and_sine(azimuth)
        along = {"radial": cosine, "lateral": sine}
        return jnp.stack([along[name] for name in self.system.freedoms])

    def _pocket(
        self,
        roller: tuple[Array, Array, Array],
        position: tuple[Array, Array, Array],
        velocity: tuple[Array, Array, Array],
        azimuth: Array,
        orbit: Array,
    ) -> PocketState:
        (q, v, u), (x, y, q_c), (v_x, v_y, v_c) = roller, position, velocity
        assert self.pocket is not None
        assert self.pocket_clearance is not None
        cosine, sine = cosine_and_sine(azimuth)
        ahead = (q_c - q) - (x * cosine + y * sine)
        rate = (v_c - v) - (v_x * cosine + v_y * sine) + (x * sine - y * cosine) * orbit
        half = 0.5 * self.pocket_clearance
        # both walls in one search: half as many loops
        face = self.pocket.face(
            jnp.stack([half + ahead, half - ahead]),
            jnp.stack([rate, -rate]),
            jnp.stack([u, u]),
            self.system.inlet.viscosity,
        )
        front, rear = (jax.tree.map(lambda leaf, i=i: leaf[i], face) for i in (0, 1))
        return PocketState(front, rear, rate)

    def _land(
        self, motion: RollerKinematics, ring: Array, centre: Array, velocity: Array, cage_orbit: Array
    ) -> LandForces:
        parts, inlet = self.system.cage, self.system.inlet
        assert parts is not None
        assert parts.land is not None
        land = parts.land
        inner = parts.guidance == "inner_ring"
        turbulent = cage_orbit if self.land_speed is None else self.land_speed
        if inner:
            # ring displacement along azimuths 0 and 90 degrees is (Y, -X); its speed is neglected
            lateral = ring[1] if "lateral" in self.system.freedoms else jnp.zeros(())
            offset, rate = jnp.stack([-lateral, ring[0]]) - centre, -velocity
            journal, bush = motion.inner_speed, cage_orbit
            k_z, c_f = land.film_factors(inlet.density, inlet.viscosity, motion.inner_speed - turbulent)
        else:
            offset, rate, journal, bush = centre, velocity, cage_orbit, motion.outer_speed
            k_z, c_f = land.film_factors(inlet.density, inlet.viscosity, turbulent - motion.outer_speed)
        film = land.force_on_journal(offset[0], offset[1], rate[0], rate[1], journal, bush, inlet.viscosity, k_z)
        found = land.line_of_centres(offset[0], offset[1])
        along, across = found.direction
        on_journal, on_bush = land.torques(
            found.eccentricity_ratio, film[1] * along - film[0] * across, journal, bush, inlet.viscosity, c_f
        )
        on_cage, on_ring = (on_bush, on_journal) if inner else (on_journal, on_bush)
        n, sign = land.n_lands, -1.0 if inner else 1.0
        heat = land.dissipation(on_journal, on_bush, journal, bush) - film[0] * rate[0] - film[1] * rate[1]
        return LandForces(sign * n * jnp.stack(film), n * on_cage, n * on_ring, n * heat, found.eccentricity_ratio)

    # -- rates ----------------------------------------------------------------------------------------------------

    def rates(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """d state / d time, 1/s; NaN where no load distribution is found."""
        return self.rates_and_loads(time, state)[0]

    def rates_and_loads(
        self, time: Scalar, state: ArrowPoint, closing: ArrowPoint | None = None, tolerance: Scalar = FINE
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """`rates`, and the load distribution that was found, as `RaceLoads.smoothed` gives it: extrapolated over time
        it is the argument `closing` of states nearby. `tolerance`: of an integration that asks."""
        loads = self.race_loads(time, state)
        guess = None if closing is None else loads.unsmoothed(closing)
        now = self.at(time, state, guess, tolerance)
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
        works = self.powers(time, now) / self.work_unit
        rollers = jnp.stack([v, acceleration - frame_acceleration, spinning]) / jnp.asarray(ROLLER_UNITS)[:, None]
        rates = ArrowPoint(rollers, jnp.concatenate([moving / jnp.asarray(CAGE_UNITS), works]))
        good = now.distribution.residual < LOAD_FAILURE * LOAD_TOLERANCE * jnp.sqrt(tolerance)
        return jax.tree.map(lambda rate: jnp.where(good, rate, jnp.nan), rates), loads.smoothed(now.distribution.point)

    def first_closing(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """The argument `closing` of `rates_and_loads` where nothing is known."""
        loads = self.race_loads(time, state)
        return loads.smoothed(loads.initial())

    # -- energy ---------------------------------------------------------------------------------------------------

    def costs(self, now: MovingState) -> Costs[PowerLoss]:
        """Losses by location, W, and what drives the rings, each from the force and the sliding speed of its own
        interaction; without the squeezing of the pocket films (see `powers`)."""
        motion, forces, parts = now.motion, now.forces, self.system.cage
        assert parts is not None
        found = friction_on_rings(
            motion, now.contact, now.sliding_speed, now.mean_speed, forces.inner_flange, forces.outer_flange
        )
        cosine, sine = cosine_and_sine(now.azimuth)
        behind = now.orbit - now.cage_orbit
        if now.pocket is not None:
            front, rear = now.pocket.front.friction, now.pocket.rear.friction
            outward = now.velocity[1] * cosine - now.velocity[0] * sine
            rubbing = (front + rear) * motion.roller_radius * (now.spin - behind)
            found.append(Interaction("pocket", jnp.sum(rubbing - (front - rear) * outward)))
        rails = forces.rails
        if rails is not None:
            along = -(now.velocity[0] * cosine + now.velocity[1] * sine)
            forward = rails.tangential_force * (motion.pitch_radius * behind - along)
            found.append(Interaction("element_ends", -jnp.sum(forward + rails.moment * (behind - now.spin))))
        if now.land is not None:
            found.append(of_land(now.land.power, now.land.ring_torque, parts.guidance))
        if forces.drag_force is not None:
            found.append(Interaction("drag", jnp.sum(forces.drag_force * motion.pitch_radius * now.orbit)))
        return costs(PowerLoss, found, motion)

    def powers(self, time: Scalar, now: MovingState) -> Float[Array, " work"]:
        r"""Rates of `WORKS`, W. That of the load is $-\dot F\cdot d$: its work is this integral plus the change of
        $F\cdot d$."""
        cost = self.costs(now)
        closing = lever = jnp.zeros(())
        if now.pocket is not None:
            push = now.pocket.front.load - now.pocket.rear.load
            closing = -jnp.sum(push * now.pocket.gap_rate)
            cosine, sine = cosine_and_sine(now.azimuth)
            arm = now.centre[0] * sine - now.centre[1] * cosine
            lever = jnp.sum(push * arm * now.orbit)
        time = jnp.asarray(time, dtype=float)
        _, load_rate = jax.jvp(self.ring_load, (time,), (jnp.ones_like(time),))
        load = -jnp.sum(load_rate * now.distribution.ring)
        assert cost.drive_power is not None
        assert cost.power_loss.total is not None
        return jnp.stack([cost.drive_power, cost.power_loss.total, closing, lever, load])

    def kinetic_energy(self, time: Scalar, state: ArrowPoint) -> Float[Array, ""]:
        """Kinetic energy of rollers and cage, J."""
        motion = self.system.kinematics
        (_, v, u), (_, _, _, v_x, v_y, v_c), _ = self.unscaled(state)
        turning = self.frame(time)[1]
        orbit, cage = turning + v / motion.pitch_radius, turning + v_c / motion.pitch_radius
        rollers = self.system.roller_mass * jnp.square(motion.pitch_radius * orbit)
        rollers = rollers + self.roller_inertia * jnp.square(orbit - u / motion.roller_radius)
        total = 0.5 * jnp.sum(rollers)
        if self.cage_mass is None or self.cage_inertia is None:
            return total
        return total + 0.5 * (self.cage_mass * (v_x * v_x + v_y * v_y) + self.cage_inertia * jnp.square(cage))

    def pocket_energy(self, now: MovingState) -> Float[Array, ""]:
        """Elastic energy of the pocket films, J."""
        if now.pocket is None or self.pocket is None:
            return jnp.zeros(())
        return jnp.sum(self.pocket.flattening_energy(jnp.stack([now.pocket.front.load, now.pocket.rear.load])))

    def raceway_energy(self, now: MovingState) -> Float[Array, ""]:
        """Elastic energy of the raceway contacts, J."""
        load = now.distribution.load
        return _PALMGREN_ENERGY * jnp.sum(load * self.system.contact.palmgren_approach(load))
