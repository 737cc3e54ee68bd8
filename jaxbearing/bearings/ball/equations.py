r"""Equations of the steady lubricated ball bearing, as a block-arrow system.

Unknowns per ball: ln Qi and the inner contact angle; with traction the spin and, with `attitude="min_power"`, the
attitude beta, or, with `"equilibrium"`, the axial and the radial part of the spin (polar coordinates are singular where
the spin of a skidding ball turns round through 0); with a resolved gyroscopic couple the spin about the orbit's
tangent; without a cage the orbital speed, with one the radial friction of the pocket. Globally: ring displacements,
with a cage its speed (all balls orbit with it), and without traction, on request, one orbital speed for all.

The force of the inner race, the centrifugal force and the pocket's friction along the radius, $F_{C2} - F_{C1}$, give
load and angle of the outer contact, so that both force balances of a ball hold identically (source eqs. (14)-(15)), and
what is solved is that the centres fit (source eqs. (23)-(26)): with $n = (\sin\alpha, \cos\alpha)$,
$t = (\cos\alpha, -\sin\alpha)$ and $l_k = g_k + (Q_k/K_k)^{2/3} - h_k$, $l_in_i + l_on_o = A$, its component along
$n_i$ as the logarithm of the ratio of the positive terms on its two sides.

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

The massless cage hands the pocket forces on to its lands, and where the inner ring guides it they stand in that ring's
balance, $F_r = \sum p_r\cos\psi + W_{FCi}\cos\chi$, $W_{FCi}\cos\chi = \sum(F_{C2} - F_{C1})\cos\psi$ (source eqs.
(18)-(19), (22)): to the radial force of each ball on the ring comes the radial friction of its pocket, which has no
moment. Tangential forces, those of the pockets through the lands and $F_{ti}$ of the balls, have no sum along the load
line, since balls on both sides of it run alike; the balances of the ring, and its stiffness, leave out both.

Heathcote slip (`PointLaws.heathcote`). Ball and race meet in a surface that bends around the ball across rolling, by
$z = -y^2/(2R_k)$ along $n_k$, $1/R_k$ the mean of the curvatures $2/D$ and $1/(f_kD)$. The relative roll
$\omega_{rk}$ about $b_k$ adds $\omega_{rk}z\,b_k\times n_k = \omega_{rk}z\,e_t$ to the sliding: along $e_t$ it is
$u_t - \omega_sy - \omega_ry^2/(2R_k)$. The traction law's x is $s\,e_t$ and its y is $s\,b_k$: its sliding along x is s
times that, and lacks $c\,y^2$ with $c = s\,\omega_{rk}/(2R_k)$ at both races; c > 0 in normal running, where
$s\,\omega_{rk} > 0$. The stress $\tau_x$ on the race acts on the ball as $-s\tau_xe_t$ at $z\,n_k$ from the contact's
centre: the moment $z(-s\tau_x)\,n_k\times e_t = s\tau_xy^2/(2R_k)\,b_k$ on the ball. A rolling resistance $M_{rk}$ is
$-sM_{rk}b_k$ on the ball, hence slip by curvature is one more, $M_{ck} = -\int\tau_xy^2dA/(2R_k)$, in the same places:
the moments about axis and radius, the torques on the rings, and the power, $sM_{ck}\omega_{rk} = -c\int\tau_xy^2dA$,
which is what $\int\tau\cdot\Delta u\,dA$ has beside sliding of the centre and spin. The least spin power of
`"min_power"` stays that of flat patches, as the source has it.
"""

import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._types import Scalar
from ...contacts import PointContact
from ...contacts.distributed import Traction
from ...contacts.point_laws import PointFilm, PointLaws
from ...contacts.shear import Sliding
from ...gaps.ball_pocket import BallPocketFilm
from ...lubricants import InletOil, Lubricant
from ...numerics.arrow import ArrowPoint
from ...numerics.precision import as_float
from ...numerics.roots import monotone_root
from ...numerics.safe import safe_norm
from ..inlet import OilElsewhere
from ..land import LandState, guided_land
from ..ring import LENGTH_UNIT
from .core import orbit_row, orbit_totals
from .geometry import BallGeometry
from .kinematics import BallMotion
from .state import BallCageParts, BallDrag, BallGuess, BallsState
from .system import AbstractBallSystem, InnerArm, OnRing

SIDES = np.array([[1.0], [-1.0]])
"""Inner, outer: the sense of the contact's x axis along the orbit."""
LOG_LOAD_RANGE = (-200.0, 18.0)
"""ln(load / 1 N) that an iterate may take."""
ROLLING_PASSES = 5
"""Newton steps for the orbital speed of a ball that rolls without sliding, with the outer contact angle that goes with
it. Light balls between fast rings that turn against each other take all of them, usual ones two."""
FRICTION_PASSES = 3
"""Load and angle of the outer contact under the friction that carries the couple: the error falls as fast."""
EASIEST_SLIDE = 1e-3
"""Part of the sliding that the traction law of the easiest system sees."""
THINNEST_FILM = 1e-3
"""Part of the films that the easiest system has."""
PART_TOLERANCE = 1e-12
"""Tolerance of the attitude of least spin power, as a part of the way from outer to inner control."""


class LubricatedBallSystem(AbstractBallSystem):
    """Lubricated ball bearing; see the module."""

    geometry: BallGeometry
    reduced_modulus: Float[Array, ""]
    laws: PointLaws
    oil: Lubricant
    inlet: InletOil
    guess: BallGuess
    reference: BallMotion
    """Rolling at the free contact angle, half way between outer and inner control."""
    orbit_unit: Float[Array, ""]
    """Scale of orbital speeds, rad/s; not 0 while a ring turns."""
    resolved: bool = eqx.field(static=True, default=False)
    cage: BallCageParts | None = None
    drag: BallDrag | None = None
    common_orbit: bool = eqx.field(static=True, default=False)
    """True if balls that roll without sliding have one orbital speed."""
    slide_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Part of the sliding that the traction law sees: 1, less in an easier system."""
    heavy_guess: BallGuess | None = None
    """The easiest system starts here; only balls that do not slide have it."""
    heavier: Float[Array, ""] | None = None
    """The easiest load over the load on the ring."""
    film_share: Scalar = eqx.field(converter=as_float, default=1.0)
    """Part of the films that keeps the surfaces apart: 1, less in an easier system."""
    elsewhere: OilElsewhere | None = None
    """Oil of the other interactions where it is not that of the raceways, `inlet`."""

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
        if self.attitude == "equilibrium":
            names = ["axial spin", "radial spin"]
        elif self.attitude == "min_power":
            names.append("attitude")
        names.append("orbit" if self.cage is None else "outward")
        if self.resolved:
            names += ["transverse", "carried"]
        return tuple(names)

    @property
    def global_orbit(self) -> bool:
        return self.cage is not None or self.common_orbit

    def oil_of(self, place: str) -> InletOil:
        """The oil that enters an interaction beside the raceways."""
        return self.inlet if self.elsewhere is None else getattr(self.elsewhere, place)

    # -- scales ---------------------------------------------------------------------------------------------------

    def spin_unit(self) -> Array:
        return self.orbit_unit / self.kinematics.ratio

    def load_scale(self) -> Array:
        return self.ring.size()

    def friction_scale(self) -> Array:
        """Scale of a ball's friction forces, N: 1 % of its share of the load and of its centrifugal force."""
        force = self.centrifugal(self.reference.orbital_speed)
        return 0.01 * (self.load_scale() / self.ball_count + force)

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        text = {
            "spin": "moment about the bearing axis on a ball",
            "axial spin": "moment about the bearing axis on a ball",
            "radial spin": "moment about the radius on a ball",
            "attitude": "least spin power of a ball",
            "orbit": "tangential force on a ball",
            "outward": "radial pocket friction on a ball",
            "transverse": "moment about the tangent on a ball",
            "carried": "transverse friction at the inner race of a ball",
        }
        own = tuple(text[name] for name in self.own_unknowns)
        orbit = "common orbital speed" if self.cage is None else "moment balance of the cage"
        return (
            "approach of the rings at a ball",
            "direction of the contacts of a ball",
            *own,
            *self.ring.equation_names(),
            *((orbit,) if self.global_orbit else ()),
        )

    def step_caps(self) -> ArrowPoint:
        caps = dict.fromkeys(("spin", "axial spin", "radial spin", "orbit"), 0.15)
        caps |= {"attitude": 0.3, "outward": 1.0, "transverse": 0.02, "carried": 1.0}
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
        guess, reference = self.guess, self.reference
        zeros = jnp.zeros_like(guess.log_load)
        inner = guess.angle
        outer = self._outer_contact(guess.log_load, inner, self.centrifugal(reference.orbital_speed), None)[1]
        rolling = self.kinematics.rolling(inner, outer, guess.attitude)
        orbit = common = (rolling.orbital_speed - reference.orbital_speed) / self.orbit_unit
        if self.global_orbit:
            weights = jnp.exp(guess.log_load)
            common = jnp.sum(weights * orbit) / jnp.sum(weights)
            rolling = self.kinematics.held(self.orbit(common), inner, outer, guess.attitude)
        start = {
            "spin": (rolling.spin_speed - reference.spin_speed) / self.spin_unit(),
            "attitude": guess.attitude,
            "orbit": orbit,
            "outward": zeros,
            "transverse": zeros,
            "carried": zeros,
        }
        parts = zip(self._spin_parts(rolling), self._spin_parts(reference), strict=True)
        start |= {name: (value - ref) / self.spin_unit() for (name, value), (_, ref) in parts}
        elements = jnp.stack([guess.log_load, inner, *(start[name] for name in self.own_unknowns)])
        ring = guess.ring / LENGTH_UNIT
        if self.global_orbit:
            ring = jnp.append(ring, common)
        return ArrowPoint(elements, ring)

    @property
    def increasing(self) -> bool:
        """Not where a ball has nearly lost its inner race."""
        return False

    @property
    def rounding(self) -> float:
        """Slow, heavily loaded contacts make a force of the last bit of a speed: 1e-8 of 1 % of a ball's load."""
        return 100.0

    @property
    def homotopies(self) -> int:
        return 2 if self.resolved or self.heavier is not None else 1

    def homotopy(self, parameter, path):
        """Slower sliding in the traction law, which then saturates less; first, where traction has to carry the
        gyroscopic couple, a part of that. Without traction more load first, as much as makes contacts stiffer than
        films, and then thinner films: the lightest balls hang in films far thicker than their contacts give."""
        if self.heavier is not None:
            of_load, of_films = jnp.where(path == 0, parameter, 0.0), jnp.where(path == 0, 0.0, parameter)
            guess = jax.tree.map(lambda a, b: jnp.where(of_load > 0, a, b), self.heavy_guess, self.guess)
            ring = self.ring.under(self.ring.load * self.heavier**of_load)
            return dataclasses.replace(self, ring=ring, film_share=THINNEST_FILM**of_films, guess=guess)
        slide = EASIEST_SLIDE**parameter
        if not self.resolved:
            return dataclasses.replace(self, slide_share=slide)
        couple = self.couple_share * jnp.where(path == 0, 1.0 - parameter, 1.0)
        return dataclasses.replace(self, couple_share=couple, slide_share=jnp.where(path == 0, 1.0, slide))

    @property
    def extra_totals(self) -> int:
        # moment on the cage, and two components of the force for one global; weighted speeds and weights
        return 1 if self.common_orbit else 0 if self.cage is None else 2

    def element(self, unknowns, shared):
        state = self.balls(unknowns, shared)
        totals = [state.on_ring]
        if state.cage_moment is not None and state.cage_force is not None:
            totals += [self.multiplicity * state.cage_moment[None, :], state.cage_force]
        if self.common_orbit:
            own = self.kinematics.rolling(state.angle[0], state.angle[1], state.motion.attitude).orbital_speed
            totals.append(self.multiplicity * orbit_totals(state.load[0], own, state.motion.orbital_speed))
        local = jnp.concatenate([state.fit, *(row[None, :] for row in state.rows)])
        return local, jnp.concatenate(totals), jnp.maximum(jnp.max(state.film.residual), state.orbit_residual)

    def global_residual(self, globals_, totals):
        d = len(self.freedoms)
        ring = self.load_balance(globals_[:d], totals[:d]) / self.load_scale()
        if self.common_orbit:
            return jnp.append(ring, orbit_row(totals[d:], self.orbit_unit)), jnp.zeros(())
        if self.cage is None:
            return ring, jnp.zeros(())
        land = self.land(self.orbit(globals_[d]), totals[d + 1], totals[d + 2])
        scale = self.friction_scale() * 0.5 * self.kinematics.pitch_diameter * self.ball_count
        # the moment falls with the cage speed
        return jnp.concatenate([ring, -(totals[d] + land.cage_torque)[None] / scale]), land.residual

    # -- physics --------------------------------------------------------------------------------------------------

    def orbit(self, scaled: Array) -> Array:
        return self.reference.orbital_speed + self.orbit_unit * scaled

    def at(self, point: ArrowPoint) -> BallsState:
        shape = (point.globals.shape[0], point.elements.shape[1])
        return self.balls(point.elements, jnp.broadcast_to(point.globals[:, None], shape))

    def land(self, orbit: Array, force_x: Array, force_y: Array) -> LandState:
        """The lands that carry the pocket forces."""
        cage, motion = self.cage, self.kinematics
        assert cage is not None
        return guided_land(
            cage.land,
            cage.guidance,
            motion.inner_speed,
            motion.outer_speed,
            orbit,
            force_x,
            force_y,
            self.oil_of("cage_pilot"),
        )

    def land_at(self, point: ArrowPoint, state: BallsState) -> LandState:
        assert state.cage_force is not None
        force = jnp.sum(state.cage_force, axis=1)
        return self.land(self.orbit(point.globals[-1]), force[0], force[1])

    def balls(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        state, contact = self.frictionless(unknowns, shared)
        return self._with_traction(state, contact) if self.slips else state

    def frictionless(
        self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"], film: PointFilm | None = None
    ) -> tuple[BallsState, PointContact]:
        """All but what traction does; `film`: where it is known and stays."""
        d = len(self.freedoms)
        own = dict(zip(self.own_unknowns, unknowns[2:], strict=True))
        log_load, inner = unknowns[0], unknowns[1]
        orbit = None
        if self.slips or self.common_orbit:
            orbit = self.orbit(shared[d] if self.global_orbit else own["orbit"])
        pocket = self.friction_scale() * own["outward"] if "outward" in own else None
        turned = self.ring_frame(shared[:d]).turned if self.exact else None
        seen = inner if turned is None else inner - turned  # by the tilted race
        load, outer, motion, friction, orbit_residual = self._contacts(log_load, inner, seen, orbit, own, pocket)
        angle, direction = jnp.stack([seen, outer]), jnp.stack([inner, outer])
        races = jax.tree.map(
            lambda a, b: jnp.stack([a, b]),
            self.kinematics.inner_race(motion, seen),
            self.kinematics.outer_race(motion, outer),
        )
        cosine = jnp.cos(angle)
        contact = self.geometry.contacts(cosine[0], cosine[1], self.reduced_modulus).shaped()
        if film is None:
            film = self.laws.film_state(contact, load, races.mean_speed, races.rolling, self.oil, self.inlet)
        fit, centre, arm, on_ring = self._fit(load, direction, film.film, shared[:d])
        axial, radial, moment = self.with_friction(load, direction, friction)
        sideways = ()
        if arm.along is not None:
            # a film thicker than the groove's radius is larger than the ball's puts the ball beyond the groove centre
            forward = arm.in_plane[0] * jnp.sin(inner) + arm.in_plane[1] * jnp.cos(inner) > 0
            within = arm.length * arm.share
            sideways = (load[0] * arm.along / jnp.where(forward, within, -within),)
        on_ring = on_ring(jnp.stack([axial[0], radial[0], *sideways]), moment)
        if pocket is not None and self.cage is not None and self.cage.guidance == "inner_ring":
            on_ring = on_ring + self._through_land(pocket)
        state = BallsState(
            load=load,
            angle=angle,
            centre=centre,
            motion=motion,
            races=races,
            friction=friction,
            film=film,
            orbit_residual=orbit_residual,
            traction=None,
            rolling=None,
            curvature=None,
            pocket_force=pocket,
            pocket=None,
            drag_force=None,
            fit=fit,
            rows=(),
            on_ring=on_ring,
            cage_moment=None,
            cage_force=None,
        )
        return state, contact

    def _through_land(self, pocket: Float[Array, " ball"]) -> Float[Array, "freedom ball"]:
        """Gives the contributions of the pockets' outward friction, N, to the forces on the ring.

        They go through cage and land and act in the middle plane, hence without a moment."""
        along = {"radial": jnp.cos(self.azimuth), "lateral": jnp.sin(self.azimuth)}
        zero = jnp.zeros_like(pocket)
        rows = [along.get(name, zero) * pocket for name in self.freedoms]
        return self.multiplicity * jnp.stack(rows) if rows else zero[None][:0]

    def _outer_contact(
        self, log_load: Array, inner: Array, outward: Array, friction: Array | None
    ) -> tuple[Array, Array]:
        """Load and angle of the outer contact from the forces on the ball; `outward`, N, those along the radius;
        `friction` T_i, T_o with its sign."""
        load = jnp.exp(log_load)
        axial, radial = load * jnp.sin(inner), load * jnp.cos(inner) + outward
        if friction is None:
            return safe_norm(axial, radial), jnp.arctan2(axial, radial)
        axial, radial = axial + friction[0] * jnp.cos(inner), radial - friction[0] * jnp.sin(inner)
        # the outer race's load and friction, at right angles to each other, carry that
        total = jnp.square(axial) + jnp.square(radial)
        outer = jnp.sqrt(jnp.maximum(total - jnp.square(friction[1]), 1e-6 * total))
        return outer, jnp.arctan2(axial, radial) - jnp.arctan2(friction[1], outer)

    def _contacts(self, log_load, inner, seen, orbit, own, pocket):
        """Loads, outer angle, motion of the ball, friction that carries the couple, and by how much the centrifugal
        force misses that of rolling, over the loads.

        `inner`: direction of the inner normal force, `seen`: contact angle on the inner race, rad; `pocket`: its force
        outward.
        """
        motion_at = lambda angle, orbital: self._motion(seen, angle, orbital, own)
        rolls, friction, residual = orbit is None, None, jnp.zeros(())
        if orbit is None:
            orbit = self._rolling_orbit(log_load, inner, seen, own)
        outward = self.centrifugal(orbit) if pocket is None else self.centrifugal(orbit) + pocket
        load, outer = self._outer_contact(log_load, inner, outward, None)
        motion = motion_at(outer, orbit)
        if rolls:
            # the motion is that of rolling at the angles which the orbital speed makes
            missed = self.centrifugal(motion.orbital_speed) - self.centrifugal(orbit)
            residual = jnp.max(jnp.abs(missed) / (jnp.exp(log_load) + self.centrifugal(orbit)))
        for _ in range(0 if self.gyroscopic is None and not self.resolved else FRICTION_PASSES):
            couple = self.couple(motion)
            if self.gyroscopic is None:
                taken = 2.0 * couple / self.kinematics.ball_diameter
                carried = self.friction_scale() * own["carried"]
                friction = jnp.stack([carried, taken - carried])
            else:
                parts = self.gyroscopic.friction(couple, self.kinematics.ball_diameter, jnp.exp(log_load), load)
                friction = self.gyroscopic.sign * jnp.stack(parts)
            load, outer = self._outer_contact(log_load, inner, outward, friction)
            motion = motion_at(outer, orbit)
        return jnp.stack([jnp.exp(log_load), load]), outer, motion, friction, residual

    def _rolling_orbit(self, log_load: Array, inner: Array, seen: Array, own: dict[str, Array]) -> Array:
        """Orbital speed without sliding, rad/s: it needs the outer angle, which needs the centrifugal force."""

        def next_orbit(orbit: Array) -> Array:
            angle = self._outer_contact(log_load, inner, self.centrifugal(orbit), None)[1]
            return jnp.broadcast_to(self._motion(seen, angle, None, own).orbital_speed, inner.shape)

        def better(_, orbit: Array) -> Array:
            value, slope = jax.jvp(next_orbit, (orbit,), (jnp.ones_like(orbit),))
            return orbit - (value - orbit) / (slope - 1.0)

        start = jnp.broadcast_to(self.reference.orbital_speed, inner.shape)
        return jax.lax.fori_loop(0, ROLLING_PASSES, better, start)

    def _motion(self, inner: Array, outer: Array, orbit: Array | None, own: dict[str, Array]) -> BallMotion:
        reference, unit = self.reference, self.spin_unit()
        if self.attitude == "equilibrium":
            axial, radial = (ref + unit * own[name] for name, ref in self._spin_parts(reference))
            sense = jnp.where(reference.spin_speed < 0, -1.0, 1.0)
            spin = sense * safe_norm(axial, radial)
            still = (axial == 0) & (radial == 0)
            attitude = jnp.arctan2(sense * jnp.where(still, 0.0, radial), sense * jnp.where(still, sense, axial))
        else:
            attitude = self._assumed_attitude(inner, outer, own)
            if not self.slips:
                rolling = self.kinematics.rolling(inner, outer, attitude)
                return rolling._replace(orbital_speed=orbit) if self.common_orbit and orbit is not None else rolling
            spin = reference.spin_speed + unit * own["spin"]
        assert orbit is not None
        transverse = unit * own["transverse"] if self.resolved else jnp.zeros_like(spin)
        return BallMotion(orbit, spin, attitude, transverse)

    @staticmethod
    def _spin_parts(motion: BallMotion) -> tuple[tuple[str, Array], ...]:
        """Names of the unknowns of the spin in equilibrium, and their values, rad/s."""
        return ("axial spin", motion.axial_spin), ("radial spin", motion.radial_spin)

    def _assumed_attitude(self, inner: Array, outer: Array, own: dict[str, Array]) -> Array:
        if self.attitude == "outer":
            return self.kinematics.outer_control(outer)
        if self.attitude == "inner":
            return self.kinematics.inner_control(inner)
        return own["attitude"]

    def _fit(
        self, load: Array, angle: Array, film: Array, shift: Array
    ) -> tuple[Float[Array, "2 ball"], Float[Array, "2 ball"], InnerArm, OnRing]:
        """Misfit of the centres, along the inner contact's normal, as a logarithm, and across it; ball centres, from
        the outer groove centre, m, the arms from them to the inner groove, and what forces there do. `angle`: of the
        normal forces."""
        grooves = self.grooves
        if not self.slips:
            film = self.film_share * film
        compression = jnp.cbrt(jnp.square(load / grooves.stiffness[:, None]))
        reach = grooves.offset[1] + compression[1] - film[1]
        centre = reach[None] * jnp.stack([jnp.sin(angle[1]), jnp.cos(angle[1])])
        arm, on_ring = self.reach(shift, centre)
        # the arm laid into the half-plane
        groove = centre + (arm.in_plane / arm.share[None] if self.exact else arm.in_plane)
        turned = angle[1] - angle[0]
        cosine, sine = jnp.cos(turned), jnp.sin(turned)
        along = groove[0] * jnp.sin(angle[0]) + groove[1] * jnp.cos(angle[0])
        across = groove[0] * jnp.cos(angle[0]) - groove[1] * jnp.sin(angle[0])
        opening = grooves.offset[0] + grooves.offset[1] * cosine - along
        # all terms of both sides are positive, also of contacts whose normals make an obtuse angle
        same, against = jnp.maximum(cosine, 0.0), jnp.maximum(-cosine, 0.0)
        apart = compression[0] + compression[1] * same + film[1] * against + jnp.maximum(opening, 0.0)
        together = film[0] + film[1] * same + compression[1] * against + jnp.maximum(-opening, 0.0)
        fit = jnp.stack([jnp.log(apart / together), (reach * sine - across) / grooves.centre_distance])
        return fit, centre, arm, on_ring

    def _with_traction(self, state: BallsState, contact: PointContact) -> BallsState:
        """The state with all friction on the balls, and the equations of their motion."""
        motion = state.motion
        shear, rolling, curvature = self._friction(state, contact)
        forward, about = jnp.asarray(-SIDES * shear.rolling), -shear.moment
        axis, radius = self._moments(state.angle, forward, about, (rolling, curvature))
        tangential, drag_force, pocket = forward[0] + forward[1], None, None
        if self.drag is not None:
            speed = 0.5 * self.kinematics.pitch_diameter * motion.orbital_speed
            drag_force = self.drag.force(speed, self.oil_of("drag").viscosity)
            tangential = tangential - drag_force
        if self.cage is not None:
            viscosity = self.oil_of("pocket").viscosity
            pocket = self.cage.pocket.balance(tangential, motion.axial_spin, motion.radial_spin, viscosity)
            axis, radius = axis + pocket.friction, radius - pocket.transverse
        if self.resolved:
            couple = 2.0 / self.kinematics.ball_diameter * self.inertia * motion.orbital_speed
            radius = radius + couple * motion.transverse
        cage_moment, cage_force = (None, None) if pocket is None else self._on_cage(pocket)
        state = state._replace(
            traction=shear,
            rolling=rolling,
            curvature=curvature,
            pocket=pocket,
            drag_force=drag_force,
            cage_moment=cage_moment,
            cage_force=cage_force,
        )
        return state._replace(rows=self._rows(state, contact, axis, radius, tangential))

    def _friction(self, state: BallsState, contact: PointContact) -> tuple[Traction, Array | None, Array | None]:
        """Traction of both contacts; moments against the roll by the film's pressure and by Heathcote slip, N m;
        `None`: not modelled."""
        races = state.races
        slide = self.slide_share * SIDES
        transverse = slide * races.transverse if self.resolved else None
        bend = 0.5 / self._patch_radius() if self.laws.heathcote else None
        curved = None if bend is None else bend * slide * races.roll
        sliding = Sliding(slide * races.rolling, transverse, self.slide_share * races.spin, curved)
        shear = self.laws.shear(contact, state.load, state.film, races.mean_speed, sliding, self.oil)
        turn = SIDES * races.roll
        rolling = self.laws.rolling_moment(contact, state.load, state.film, races.mean_speed, turn, self.inlet)
        curvature = None if bend is None or shear.curvature is None else -bend * shear.curvature
        return shear, rolling, curvature

    def _moments(
        self, angle: Array, forward: Array, about: Array, resistances: tuple[Array | None, ...]
    ) -> tuple[Array, Array]:
        """Moments on each ball about the bearing's axis and about the radius, over half of the ball's diameter, N.

        **Arguments:** on the ball, races first: `forward`, force along the orbit, N; `about`, moment about the normal,
        and `resistances`, moments against the roll, N m.
        """
        sine, cosine, arm = jnp.sin(angle), jnp.cos(angle), 2.0 / self.kinematics.ball_diameter
        axis = forward[1] * cosine[1] - forward[0] * cosine[0] + arm * (about[1] * sine[1] - about[0] * sine[0])
        radius = forward[0] * sine[0] - forward[1] * sine[1] + arm * (about[1] * cosine[1] - about[0] * cosine[0])
        for resistance in resistances:
            if resistance is not None:
                axis = axis + arm * (resistance[1] * cosine[1] + resistance[0] * cosine[0])
                radius = radius - arm * (resistance[1] * sine[1] + resistance[0] * sine[0])
        return axis, radius

    def _on_cage(self, pocket: BallPocketFilm) -> tuple[Array, Array]:
        """Moment, N m, and force, N, of each ball on the cage, (along, across) the load line."""
        forward, outward = pocket.load_front - pocket.load_rear, pocket.friction_front - pocket.friction_rear
        moment = 0.5 * (self.kinematics.pitch_diameter * forward - self.kinematics.ball_diameter * pocket.friction)
        cosine, sine = jnp.cos(self.azimuth), jnp.sin(self.azimuth)
        # t = (-sin, cos), n = (cos, sin) in the plane of the bearing, the load along x
        force = jnp.stack([-forward * sine + outward * cosine, forward * cosine + outward * sine])
        if self.multiplicity > 1:  # all balls alike: the pockets hold each other
            force = jnp.zeros_like(force)
        return moment, force

    def _rows(
        self, state: BallsState, contact: PointContact, axis: Array, radius: Array, tangential: Array
    ) -> tuple[Array, ...]:
        """Residuals of the ball's motion, in the order of its unknowns; moments over half of its diameter, N."""
        scale, shear, pocket = self.friction_scale(), state.traction, state.pocket
        assert shear is not None
        rows = {
            "spin": axis / scale,
            "axial spin": axis / scale,
            "radial spin": -radius / scale,
            "orbit": -tangential / scale,
        }
        if state.pocket_force is not None and pocket is not None:
            rows["outward"] = (state.pocket_force + (pocket.friction_front - pocket.friction_rear)) / scale
        if self.resolved:
            assert state.friction is not None
            sideways = state.friction - SIDES * shear.transverse
            rows["transverse"], rows["carried"] = (sideways[0] + sideways[1]) / scale, sideways[0] / scale
        if self.attitude == "min_power":
            rows["attitude"] = state.motion.attitude - self._least_power(state, contact)
        return tuple(rows[name] for name in self.own_unknowns)

    def _patch_radius(self) -> Float[Array, "2 1"]:
        """R_k = 2 f_k D/(2 f_k + 1): of the surface in which ball and race meet, across rolling, (inner, outer), m."""
        conformities = jnp.stack([jnp.asarray(self.geometry.conformity_inner), self.geometry.conformity_outer])
        return (2.0 * conformities * self.geometry.ball_diameter / (2.0 * conformities + 1.0))[:, None]

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
