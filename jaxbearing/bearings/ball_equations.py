r"""Equations of the steady lubricated ball bearing, as a block-arrow system.

Unknowns per ball: ln Qi and the inner contact angle; with traction the spin; with `attitude="equilibrium"` or
`"min_power"` the attitude beta; with a resolved gyroscopic couple the spin about the orbit's tangent; without a cage
the orbital speed. Globally: ring displacements, and with a cage its speed (all balls orbit with it).

The force of the inner race and the centrifugal force give load and angle of the outer contact, so that both force
balances of a ball hold identically, and what is solved is that the centres fit (source eqs. (23)-(26)): with
$n = (\sin\alpha, \cos\alpha)$, $t = (\cos\alpha, -\sin\alpha)$ and $l_k = g_k + (Q_k/K_k)^{2/3} - h_k$,
$l_in_i + l_on_o = A$, its component along $n_i$ as the logarithm of the ratio of the positive terms on its two sides.
The pocket friction along the radius (newtons beside the centrifugal force) is left out of the balance of forces.

Forces on the ball, $F_{tk}$ along $e_t$, moments $M_{sk}$ about $n_k$, $M_{rk}$ against the relative roll; in terms
of the traction law $F_{tk} = -sF_x(s\,u_t, s\,u_b, \omega_s)$, s = 1 inside, -1 outside. Equations (source eqs.
(16)-(17) and the moment about the radius, which the source replaces by a hypothesis on beta):

- about the axis: $F_{to}\cos\alpha_o - F_{ti}\cos\alpha_i + \frac2D(M_{so}\sin\alpha_o - M_{si}\sin\alpha_i
  + M_{ro}\cos\alpha_o + M_{ri}\cos\alpha_i) + F_{C1} + F_{C2} = 0$;
- about the radius: $-F_{to}\sin\alpha_o + F_{ti}\sin\alpha_i + \frac2D(M_{so}\cos\alpha_o - M_{si}\cos\alpha_i
  - M_{ro}\sin\alpha_o - M_{ri}\sin\alpha_i) - F_{C1x} - F_{C2x} + \frac2DJ\omega_m\omega_t = 0$;
- about the tangent (resolved couple): $F_{bo} + F_{bi} + \frac2DsJ\omega_m\omega_R\sin\beta = 0$;
- along the tangent: $F_{to} + F_{ti} - F_{ol} = Q_{C1} - Q_{C2}$, solved by the pocket films in closed form, or,
  without a cage, an equation for the orbital speed.
"""

from typing import Literal, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..contacts import PointContact
from ..contacts.distributed import Traction
from ..contacts.point_laws import PointFilm, PointLaws
from ..contacts.shear import Sliding
from ..gaps import ReynoldsDrag, RollerDrag, ShortJournal
from ..gaps.ball_pocket import BallPocket, BallPocketFilm
from ..lubricants import InletOil, Lubricant
from ..numerics.arrow import ArrowPoint
from ..numerics.roots import monotone_root
from ..numerics.safe import safe_norm
from .ball_geometry import BallGeometry
from .ball_kinematics import BallMotion, RaceMotion
from .ball_system import LENGTH_UNIT, AbstractBallSystem
from .land import LandState, guided_land

LOG_LOAD_RANGE = (-200.0, 18.0)
"""ln(load / 1 N) that an iterate may take."""
ROLLING_PASSES = 6
"""Orbital speed and outer contact angle of a ball that rolls without sliding: the error falls by 0.02 a pass."""
FRICTION_PASSES = 3
"""Load and angle of the outer contact under the friction that carries the couple: the error falls as fast."""
PART_TOLERANCE = 1e-12
"""Of the part of the way from outer to inner control at which the spin power is least."""


class BallCageParts(eqx.Module):
    """What a cage adds to the equations; all prepared, with the oil at its inlet temperature."""

    pocket: BallPocket
    land: ShortJournal
    guidance: Literal["inner_ring", "outer_ring"] = eqx.field(static=True)


class BallDrag(eqx.Module):
    """Drag on the orbiting balls: a law with its own coefficient, and the density of the oil-air mixture."""

    law: ReynoldsDrag | RollerDrag
    density: Float[Array, ""]

    def force(self, speed: Array, viscosity: Array) -> Array:
        """N, of the sign of the orbital speed, m/s; it acts against it."""
        if isinstance(self.law, RollerDrag):
            return self.law.force(speed, self.density)
        return self.law.force(speed, self.density, viscosity)


class BallGuess(NamedTuple):
    """Start of the iteration: from the bearing without friction."""

    log_load: Float[Array, " ball"]
    angle: Float[Array, " ball"]
    attitude: Float[Array, " ball"]
    ring: Float[Array, " freedom"]


class BallsState(NamedTuple):
    """Everything that happens at every ball, for given unknowns; arrays over balls, (inner, outer) first where two."""

    load: Float[Array, "2 ball"]
    angle: Float[Array, "2 ball"]
    motion: BallMotion
    races: RaceMotion
    friction: Float[Array, "2 ball"] | None
    film: PointFilm
    traction: Traction | None
    rolling: Float[Array, "2 ball"] | None
    pocket: BallPocketFilm | None
    drag_force: Float[Array, " ball"] | None
    fit: Float[Array, "2 ball"]
    rows: tuple[Array, ...]
    """Residuals of the ball's motion, in the order of its unknowns."""
    ring_force: Float[Array, "2 ball"]
    ring_moment: Float[Array, " ball"]
    cage_moment: Float[Array, " ball"] | None
    cage_force: Float[Array, "2 ball"] | None


class LubricatedBallSystem(AbstractBallSystem):
    """Lubricated ball bearing; see the module."""

    geometry: BallGeometry
    reduced_modulus: Float[Array, ""]
    laws: PointLaws
    oil: Lubricant
    inlet: InletOil
    azimuth: Float[Array, " ball"]
    guess: BallGuess
    resolved: bool = eqx.field(static=True, default=False)
    cage: BallCageParts | None = None
    drag: BallDrag | None = None

    # -- structure ------------------------------------------------------------------------------------------------

    @property
    def slips(self) -> bool:
        return self.laws.traction is not None

    @property
    def own_unknowns(self) -> tuple[str, ...]:
        """Names of a ball's unknowns beside load and angle."""
        if not self.slips:
            return ()
        names = ["spin"]
        if self.attitude in ("min_power", "equilibrium"):
            names.append("attitude")
        if self.cage is None:
            names.append("orbit")
        if self.resolved:
            names += ["transverse", "carried"]
        return tuple(names)

    @property
    def global_orbit(self) -> bool:
        return self.slips and self.cage is not None

    # -- scales ---------------------------------------------------------------------------------------------------

    def reference(self) -> BallMotion:
        """Rolling at the free contact angle, half way between outer and inner control."""
        angle = self.grooves.free_angle
        between = 0.5 * (self.kinematics.outer_control(angle) + self.kinematics.inner_control(angle))
        return self.kinematics.rolling(angle, angle, between)

    def orbit_unit(self) -> Array:
        """Scale of orbital speeds, rad/s; not 0 while a ring turns."""
        free = self.reference().orbital_speed
        return jnp.sqrt(0.5 * (jnp.square(free) + jnp.square(free - self.kinematics.outer_speed)))

    def spin_unit(self) -> Array:
        return self.orbit_unit() / self.kinematics.ratio

    def load_scale(self) -> Array:
        return jnp.sqrt(jnp.sum(jnp.square(self.ring_load)))

    def friction_scale(self) -> Array:
        """Scale of a ball's friction forces, N: 1 % of its share of the load and of its centrifugal force."""
        force = self.centrifugal(self.reference().orbital_speed)
        return 0.01 * (self.load_scale() / self.ball_count + force)

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        text = {
            "spin": "moment about the bearing axis on a ball",
            "attitude": "moment about the radius on a ball",
            "orbit": "tangential force on a ball",
            "transverse": "moment about the tangent on a ball",
            "carried": "transverse friction at the inner race of a ball",
        }
        own = tuple(text[name] for name in self.own_unknowns)
        cage = ("moment balance of the cage",) if self.global_orbit else ()
        return (
            "approach of the rings at a ball",
            "direction of the contacts of a ball",
            *own,
            *self.ring_equation_names(),
            *cage,
        )

    def step_caps(self) -> ArrowPoint:
        caps = {"spin": 0.15, "attitude": 0.3, "orbit": 0.15, "transverse": 0.02, "carried": 1.0}
        elements = [12.0, 0.2, *(caps[name] for name in self.own_unknowns)]
        ring = [5.0] * len(self.freedoms) + [0.15] * self.global_orbit
        return ArrowPoint(jnp.asarray(elements)[:, None], jnp.asarray(ring))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        low, high = LOG_LOAD_RANGE
        own = len(self.own_unknowns)
        lowest, highest = [low, -1.6] + [-50.0] * own, [high, 1.6] + [50.0] * own
        ring = jnp.asarray([1e5] * len(self.freedoms) + [3.0] * self.global_orbit)
        return ArrowPoint(jnp.asarray(lowest)[:, None], -ring), ArrowPoint(jnp.asarray(highest)[:, None], ring)

    def initial(self) -> ArrowPoint:
        guess, reference = self.guess, self.reference()
        zeros = jnp.zeros_like(guess.log_load)
        inner = guess.angle
        outer = self._outer_contact(guess.log_load, inner, reference.orbital_speed, None)[1]
        rolling = self.kinematics.rolling(inner, outer, guess.attitude)
        start = {
            "spin": (rolling.spin_speed - reference.spin_speed) / self.spin_unit(),
            "attitude": guess.attitude,
            "orbit": (rolling.orbital_speed - reference.orbital_speed) / self.orbit_unit(),
            "transverse": zeros,
            "carried": zeros,
        }
        elements = jnp.stack([guess.log_load, inner, *(start[name] for name in self.own_unknowns)])
        ring = guess.ring / LENGTH_UNIT
        if self.global_orbit:
            weights = jnp.exp(guess.log_load)
            common = jnp.sum(weights * start["orbit"]) / jnp.sum(weights)
            ring = jnp.concatenate([ring, common[None]])
        return ArrowPoint(elements, ring)

    @property
    def rising(self) -> bool:
        """Not where a ball has nearly lost its inner race."""
        return False

    @property
    def rounding(self) -> float:
        """Slow, heavily loaded contacts make a force of the last bit of a speed: 1e-8 of 1 % of a ball's load."""
        return 100.0

    @property
    def paths(self) -> int:
        return 1

    def eased(self, ease, path):
        """A part of the gyroscopic couple, where traction has to carry it; else more load, which pins the balls to
        rolling."""
        if self.resolved:
            return eqx.tree_at(lambda system: system.couple_share, self, self.couple_share * (1.0 - ease))
        force = 100.0 * self.friction_scale() * self.ball_count
        factor = (1.0 + force / self.load_scale()) ** ease
        return eqx.tree_at(lambda system: system.ring_load, self, self.ring_load * factor)

    def element(self, unknowns, shared):
        state = self.balls(unknowns, shared)
        totals = [self.contributions(state.ring_force, state.ring_moment)]
        if state.cage_moment is not None and state.cage_force is not None:
            totals += [self.multiplicity * state.cage_moment[None, :], state.cage_force]
        local = jnp.concatenate([state.fit, *(row[None, :] for row in state.rows)])
        return local, jnp.concatenate(totals), jnp.max(state.film.residual)

    def closure(self, globals_, totals):
        d = len(self.freedoms)
        ring = (totals[:d] - self.ring_load) / self.load_scale()
        if not self.global_orbit:
            return ring, jnp.zeros(())
        land = self.land(self.orbit(globals_[d]), totals[d + 1], totals[d + 2])
        scale = self.friction_scale() * 0.5 * self.kinematics.pitch_diameter * self.ball_count
        # the moment falls with the cage speed
        return jnp.concatenate([ring, -(totals[d] + land.cage_torque)[None] / scale]), land.residual

    # -- physics --------------------------------------------------------------------------------------------------

    def orbit(self, scaled: Array) -> Array:
        return self.reference().orbital_speed + self.orbit_unit() * scaled

    def at(self, point: ArrowPoint) -> BallsState:
        shape = (point.globals.shape[0], point.elements.shape[1])
        return self.balls(point.elements, jnp.broadcast_to(point.globals[:, None], shape))

    def land(self, orbit: Array, force_x: Array, force_y: Array) -> LandState:
        """The lands that carry the pocket forces."""
        cage, motion = self.cage, self.kinematics
        assert cage is not None
        return guided_land(
            cage.land, cage.guidance, motion.inner_speed, motion.outer_speed, orbit, force_x, force_y, self.inlet
        )

    def land_at(self, point: ArrowPoint, state: BallsState) -> LandState:
        assert state.cage_force is not None
        force = jnp.sum(state.cage_force, axis=1)
        return self.land(self.orbit(point.globals[-1]), force[0], force[1])

    def balls(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        state, contact = self.frictionless(unknowns, shared)
        return self._with_traction(state, contact) if self.slips else state

    def frictionless(
        self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]
    ) -> tuple[BallsState, PointContact]:
        """All but what traction does."""
        d = len(self.freedoms)
        own = dict(zip(self.own_unknowns, unknowns[2:], strict=True))
        log_load, inner = unknowns[0], unknowns[1]
        reference = self.reference()
        orbit = None
        if self.slips:
            scaled = own["orbit"] if self.cage is None else shared[d]
            orbit = reference.orbital_speed + self.orbit_unit() * scaled
        load, outer, motion, friction = self._contacts(log_load, inner, orbit, own)
        angle = jnp.stack([inner, outer])
        races = jax.tree.map(
            lambda a, b: jnp.stack([a, b]),
            self.kinematics.inner_race(motion, inner),
            self.kinematics.outer_race(motion, outer),
        )
        cosine = jnp.cos(angle)
        contact = self.geometry.contacts(cosine[0], cosine[1], self.reduced_modulus)
        film = self.laws.film_state(contact, load, races.mean_speed, races.rolling, self.oil, self.inlet)
        fit = self._fit(load, angle, film.film, shared[:d])
        axial, radial, moment = self.with_friction(load, angle, friction)
        state = BallsState(
            load=load,
            angle=angle,
            motion=motion,
            races=races,
            friction=friction,
            film=film,
            traction=None,
            rolling=None,
            pocket=None,
            drag_force=None,
            fit=fit,
            rows=(),
            ring_force=jnp.stack([axial[0], radial[0]]),
            ring_moment=moment,
            cage_moment=None,
            cage_force=None,
        )
        return state, contact

    def _outer_contact(
        self, log_load: Array, inner: Array, orbit: Array, friction: Array | None
    ) -> tuple[Array, Array]:
        """Load and angle of the outer contact from the forces on the ball; `friction` T_i, T_o with its sign."""
        load = jnp.exp(log_load)
        axial, radial = load * jnp.sin(inner), load * jnp.cos(inner) + self.centrifugal(orbit)
        if friction is None:
            return safe_norm(axial, radial), jnp.arctan2(axial, radial)
        axial, radial = axial + friction[0] * jnp.cos(inner), radial - friction[0] * jnp.sin(inner)
        # the outer race's load and friction, at right angles to each other, carry that
        total = jnp.square(axial) + jnp.square(radial)
        outer = jnp.sqrt(jnp.maximum(total - jnp.square(friction[1]), 1e-6 * total))
        return outer, jnp.arctan2(axial, radial) - jnp.arctan2(friction[1], outer)

    def _contacts(self, log_load, inner, orbit, own):
        """Loads, outer angle, motion of the ball and friction that carries the couple."""
        motion_at = lambda angle, orbital: self._motion(inner, angle, orbital, own)
        if orbit is None:
            # rolling without sliding: the orbital speed needs the outer angle, which needs the centrifugal force
            outer = inner
            orbit = self.reference().orbital_speed
            for _ in range(ROLLING_PASSES):
                outer = self._outer_contact(log_load, inner, orbit, None)[1]
                orbit = motion_at(outer, None).orbital_speed
        friction = None
        load, outer = self._outer_contact(log_load, inner, orbit, None)
        motion = motion_at(outer, orbit)
        for _ in range(0 if self.gyroscopic is None and not self.resolved else FRICTION_PASSES):
            couple = self.couple(motion)
            if self.gyroscopic is None:
                taken = 2.0 * couple / self.kinematics.ball_diameter
                carried = self.friction_scale() * own["carried"]
                friction = jnp.stack([carried, taken - carried])
            else:
                parts = self.gyroscopic.friction(couple, self.kinematics.ball_diameter, jnp.exp(log_load), load)
                friction = self.gyroscopic.sign * jnp.stack(parts)
            load, outer = self._outer_contact(log_load, inner, orbit, friction)
            motion = motion_at(outer, orbit)
        return jnp.stack([jnp.exp(log_load), load]), outer, motion, friction

    def _motion(self, inner: Array, outer: Array, orbit: Array | None, own: dict[str, Array]) -> BallMotion:
        if self.attitude == "outer":
            attitude = self.kinematics.outer_control(outer)
        elif self.attitude == "inner":
            attitude = self.kinematics.inner_control(inner)
        else:
            attitude = own["attitude"]
        if orbit is None or not self.slips:
            return self.kinematics.rolling(inner, outer, attitude)
        reference = self.reference()
        spin = reference.spin_speed + self.spin_unit() * own["spin"]
        transverse = self.spin_unit() * own["transverse"] if self.resolved else jnp.zeros_like(spin)
        return BallMotion(orbit, spin, attitude, transverse)

    def _fit(self, load: Array, angle: Array, film: Array, shift: Array) -> Float[Array, "2 ball"]:
        """Whether the centres fit: along the inner contact's normal, as a logarithm, and across it."""
        grooves = self.grooves
        groove = self.groove_centres(shift)
        compression = jnp.cbrt(jnp.square(load / grooves.stiffness[:, None]))
        turned = angle[1] - angle[0]
        cosine, sine = jnp.cos(turned), jnp.sin(turned)
        along = groove[0] * jnp.sin(angle[0]) + groove[1] * jnp.cos(angle[0])
        across = groove[0] * jnp.cos(angle[0]) - groove[1] * jnp.sin(angle[0])
        opening = grooves.offset[0] + grooves.offset[1] * cosine - along
        apart = compression[0] + compression[1] * cosine + jnp.maximum(opening, 0.0)
        together = film[0] + film[1] * cosine + jnp.maximum(-opening, 0.0)
        reach = grooves.offset[1] + compression[1] - film[1]
        return jnp.stack([jnp.log(apart / together), (reach * sine - across) / grooves.centre_distance])

    def _with_traction(self, state: BallsState, contact: PointContact) -> BallsState:
        motion, races, angle = state.motion, state.races, state.angle
        side = jnp.asarray([[1.0], [-1.0]])
        transverse = side * races.transverse if self.resolved else None
        sliding = Sliding(side * races.rolling, transverse, races.spin)
        shear = self.laws.shear(contact, state.load, state.film, races.mean_speed, sliding, self.oil)
        forward, about = -side * shear.rolling, -shear.moment
        sine, cosine = jnp.sin(angle), jnp.cos(angle)
        arm = 2.0 / self.kinematics.ball_diameter
        axis = forward[1] * cosine[1] - forward[0] * cosine[0] + arm * (about[1] * sine[1] - about[0] * sine[0])
        radius = forward[0] * sine[0] - forward[1] * sine[1] + arm * (about[1] * cosine[1] - about[0] * cosine[0])
        rolling = self.laws.rolling_moment(contact, state.load, state.film, races.mean_speed, self.inlet)
        if rolling is not None:
            axis = axis + arm * (rolling[1] * cosine[1] + rolling[0] * cosine[0])
            radius = radius - arm * (rolling[1] * sine[1] + rolling[0] * sine[0])
        tangential = forward[0] + forward[1]
        drag_force = None
        if self.drag is not None:
            speed = 0.5 * self.kinematics.pitch_diameter * motion.orbital_speed
            drag_force = self.drag.force(speed, self.inlet.viscosity)
            tangential = tangential - drag_force
        pocket = cage_moment = cage_force = None
        if self.cage is not None:
            axial_spin = motion.spin_speed * jnp.cos(motion.attitude)
            radial_spin = motion.spin_speed * jnp.sin(motion.attitude)
            pocket = self.cage.pocket.balance(tangential, axial_spin, radial_spin, self.inlet.viscosity)
            axis, radius = axis + pocket.friction, radius - pocket.transverse
            forward_cage, outward = pocket.load_front - pocket.load_rear, pocket.friction_front - pocket.friction_rear
            half = 0.5 * self.kinematics.pitch_diameter
            cage_moment = forward_cage * half - pocket.friction / arm
            turn, lift = jnp.cos(self.azimuth), jnp.sin(self.azimuth)
            # t = (-sin, cos), n = (cos, sin) in the plane of the bearing, the load along x
            cage_force = jnp.stack([-forward_cage * lift + outward * turn, forward_cage * turn + outward * lift])
            if self.multiplicity > 1:  # all balls alike: the pockets hold each other
                cage_force = jnp.zeros_like(cage_force)
        scale = self.friction_scale()
        couple = arm * self.inertia * motion.orbital_speed
        if self.resolved:
            radius = radius + couple * motion.transverse
        rows = {
            "spin": axis / scale,
            "attitude": -radius / scale,
            "orbit": -tangential / scale,
        }
        if self.resolved:
            assert state.friction is not None
            sideways = state.friction - side * shear.transverse
            rows["transverse"], rows["carried"] = (sideways[0] + sideways[1]) / scale, sideways[0] / scale
        if self.attitude == "min_power":
            rows["attitude"] = state.motion.attitude - self._least_power(state, contact)
        return state._replace(
            traction=shear,
            rolling=rolling,
            pocket=pocket,
            drag_force=drag_force,
            rows=tuple(rows[name] for name in self.own_unknowns),
            cage_moment=cage_moment,
            cage_force=cage_force,
        )

    def _least_power(self, state: BallsState, contact: PointContact) -> Array:
        """Attitude of the least spin power between those of outer and inner control, rad.

        The power is that of rolling without sliding at frozen loads, angles and films. Where it rises from one end on,
        the attitude is that end's, and follows it.
        """
        inner, outer = state.angle

        def slope(part: Array, args):
            system, angle, load, film, contact = args
            motion = system.kinematics
            low, high = motion.outer_control(angle[1]), motion.inner_control(angle[0])

            def power(part: Array) -> Array:
                rolling = motion.rolling(angle[0], angle[1], low + part * (high - low))
                races = [motion.inner_race(rolling, angle[0]), motion.outer_race(rolling, angle[1])]
                spin = jnp.stack([race.spin for race in races])
                speed = jnp.stack([race.mean_speed for race in races])
                sliding = Sliding(jnp.zeros_like(spin), None, spin)
                shear = system.laws.shear(contact, load, film, speed, sliding, system.oil)
                return jnp.sum(shear.moment * spin, axis=0)

            rise = jax.jvp(power, (part,), (jnp.ones_like(part),))[1]
            return rise / (system.friction_scale() * system.spin_unit() * motion.ball_diameter)

        args = (self, state.angle, state.load, state.film, contact)
        half = jnp.full_like(inner, 0.5)
        part = monotone_root(slope, args, 0.0, 1.0, half, tolerance=PART_TOLERANCE).value
        low, high = self.kinematics.outer_control(outer), self.kinematics.inner_control(inner)
        return low + part * (high - low)
