r"""Loads and contact angles of a ball bearing without friction: the block-arrow core of every ball bearing model.

Unknown per ball: its centre (V axial, W radial) from the centre of the outer groove; globally: the displacement of the
inner ring. With $A = (A_1, A_2)$ the centre of the inner groove at the ball's azimuth,

- $l_o = |(V, W)|$, $l_i = |A - (V, W)|$, $\delta_k = l_k - g_k + h_k$, $Q_k = K_k\delta_{k+}^{3/2}$ (source eqs.
  (23)-(26); a film h stores approach like extra metal, and then $Q_k$ is the root of its own equation);
- ball: $Q_o\sin\alpha_o - Q_i\sin\alpha_i - \sigma(T_i\cos\alpha_i - T_o\cos\alpha_o) = 0$ and
  $Q_o\cos\alpha_o - Q_i\cos\alpha_i + \sigma(T_i\sin\alpha_i - T_o\sin\alpha_o) = F_C$ (eqs. (14)-(15));
- ring: $\sum p_x = F_a$, $\sum p_r\cos\psi = F_r$, $\sum(R_ip_x - \sigma T_if_iD)\cos\psi = M$ (eqs. (21)-(22)), with
  $p_x = Q_i\sin\alpha_i + \sigma T_i\cos\alpha_i$ and $p_r = Q_i\cos\alpha_i - \sigma T_i\sin\alpha_i$.

$F_C = \frac12md_m\omega_m^2$, with the orbital speed of rolling without sliding at the ball's own angles and attitude;
or, with `common_orbit`, with one $\omega_m$ for all balls (the source's, of its cage), one more unknown: the mean of
their own, weighted by the inner loads, $\sum Q_{ij}(\omega_{mj} - \omega_m) = 0$. Each ball keeps the spin of its own.
Written as forces that grow with their displacement. For T = 0 and frozen $F_C$ they are the gradient of one convex
potential (`start` descends it).
"""

import dataclasses
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ...numerics.arrow import ArrowPoint, seen_by_elements
from ..elastic_ring import ElasticRing
from ..ring import LENGTH_UNIT
from .kinematics import BallMotion
from .linear_slip import linear_slip, slip_weights
from .springs import CentrifugalProblem
from .start import free_centres, ring_estimate, start
from .system import AbstractBallSystem

FORCE_FLOOR = 1e-3
"""Added to the centrifugal force, N: a ball that nothing loads stays in its outer groove (load error 1e-3 N)."""
FLOOR_SHARE = 1e-4
"""Part of a ball's share of the load that the addition does not exceed: balls at rest would roll down the outer groove
under it, and move the ring along its axis by 20 um where it carries 0.01 N."""
CENTRIFUGAL_SHARE = 1e-3
"""Part of the centrifugal force that the addition may have besides: balls that turn are pressed outwards anyhow."""

ESTIMATES = 3
"""Passes between centrifugal forces and contact angles in the first guess."""

EASY_LOAD = 1e5
"""Load of a ball over the square of its diameter, Pa: so loaded, its contacts are stiffer than their films."""

STEEPEST = 1.4
"""Contact angle, rad, up to which the direction of the inner groove gives the speed of a ball that does not touch it:
the rolling that it stands for has a pole near 90 degrees."""


PRESSED_ROUNDING = 10.0
"""This is `AbstractArrowSystem.rounding`: a clearance of -2 um holds balls of 30 mm by 100 N beside a load of 1 N."""

ORBIT_FLOOR = 1.0
"""Added to the scale of orbital speeds, rad/s, in squares: a bearing at rest has none."""


def orbit_totals(load: Array, own: Array, common: Array) -> Float[Array, "2 ball"]:
    """Contributions of each ball to the two sums of `orbit_row`; inner `load`, N, its `own` and the `common` orbital
    speed, rad/s. `FORCE_FLOOR` is added to the weights: their sum is not 0."""
    weight = load + FORCE_FLOOR
    return jnp.stack([weight * (common - own), weight])


def orbit_row(totals: Float[Array, "2"], unit: Array) -> Array:
    """Common orbital speed minus the weighted mean of the balls' own, scaled."""
    return totals[0] / (totals[1] * unit)


class BallState(NamedTuple):
    """Everything that happens at the balls for given unknowns; loads and angles have an axis of contacts
    (`arcs`) first: inner, outer of rings with one arc each."""

    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    """Contact angles on the races: of the inner one against the tilted ring."""
    direction: Float[Array, "contact ball"]
    """Direction of the normal forces on the ball, from the radius towards the axis, in the fixed frame, rad."""
    centre: Float[Array, "2 ball"]
    """Centre of the ball, from the outer groove centre, m."""
    motion: BallMotion
    own_orbit: Float[Array, " ball"]
    """Orbital speed of rolling without sliding at the ball's own angles, rad/s; `motion` may have the common one."""
    balance: Float[Array, "2 ball"]
    """Left side minus right side of the ball's two force balances, N."""
    on_ring: Float[Array, "row ball"]
    """Contributions of each ball to the forces on the ring's degrees of freedom, N: of p_x, p_r, the force along the
    orbit where the ring may tilt, and the moment about the tangent of the circle of groove centres; then the radial
    forces on flexible rings."""


class BallCore(AbstractBallSystem):
    """Balls that roll without sliding, with the attitude of outer or inner race control; or that slide as little as
    their contacts allow (`linear_slip`).

    Its iteration begins at `guess`, and in an easier system (`parameter` > 0 of `homotopy`) at `heavy_guess`
    (`started`); where these are `None`, at estimates by formulas.
    """

    guess: ArrowPoint | None = None
    heavy_guess: ArrowPoint | None = None
    parameter: Float[Array, ""] | None = None
    common_orbit: bool = eqx.field(static=True, default=False)
    spread: Float[Array, "2"] | None = None
    """Weights of `linear_slip`; `None` under race control."""
    floor: Float[Array, ""] | None = None
    """Added to the centrifugal force, N: `FORCE_FLOOR`, or less under small loads (`FLOOR_SHARE`); `None`: the
    former."""

    # -- scales ---------------------------------------------------------------------------------------------------

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return jnp.sqrt(jnp.square(self.ring.size()) + (self.ball_count * FORCE_FLOOR) ** 2)

    def ball_scale(self) -> Array:
        """Scale of a ball's balances, N."""
        angle = self.grooves.free_angle
        free = self.kinematics.rolling(angle, angle, angle)
        return self.load_scale() / self.ball_count + self.outward_force(free)

    def free_orbit(self) -> Array:
        """Orbital speed at the free contact angle, rad/s."""
        angle = self.grooves.free_angle
        return self.kinematics.rolling(angle, angle, angle).orbital_speed

    @property
    def orbit_unit(self) -> Array:
        """Scale of orbital speeds, rad/s."""
        return self.kinematics.orbit_scale(self.free_orbit(), ORBIT_FLOOR)

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        orbit = ("common orbital speed",) if self.common_orbit else ()
        return ("axial balance of a ball", "radial balance of a ball", *self.ring_names(), *orbit)

    def step_caps(self) -> ArrowPoint:
        half = 0.5 * self.grooves.centre_distance / LENGTH_UNIT
        ring = jnp.full(self.ring_unknowns, half)
        if self.common_orbit:
            ring = jnp.append(ring, 0.5)
        return ArrowPoint(jnp.stack([half, half])[:, None], ring)

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        far = 1e6
        elements, ring = jnp.full((2, 1), far), jnp.full(self.ring_unknowns + self.common_orbit, far)
        return ArrowPoint(-elements, -ring), ArrowPoint(elements, ring)

    @property
    def heavier(self) -> Array:
        """The ratio of the easiest load to the load on the ring: centrifugal forces and films are small beside it."""
        angle = self.grooves.free_angle
        force = self.outward_force(self.kinematics.rolling(angle, angle, angle))
        force = force + EASY_LOAD * jnp.square(self.kinematics.ball_diameter)
        return 1.0 + self.ball_count * force / self.load_scale()

    def guesses(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Gives the points where the iteration starts under the load on the ring, and under the easiest one."""
        if self.guess is not None and self.heavy_guess is not None:
            return self.guess, self.heavy_guess
        _, centres, rings = self._estimates()
        return self._points(centres, rings)

    def initial(self) -> ArrowPoint:
        guess, heavy = self.guesses()
        if self.parameter is None:
            return guess
        return ArrowPoint(*(jnp.where(self.parameter == 0.0, x, y) for x, y in zip(guess, heavy, strict=True)))

    def started(self) -> tuple["BallCore", Int[Array, ""]]:
        """These equations with the minimum of the convex problem as first guess, and the Newton steps to that."""
        problem, centres, rings = self._estimates()
        found = start(problem, rings[0])
        guess, heavy = self._points(centres.at[0].set(found.centre), rings.at[0].set(found.ring))
        return dataclasses.replace(self, guess=guess, heavy_guess=heavy), found.steps

    def _points(
        self, centres: Float[Array, "2 2 ball"], rings: Float[Array, "2 coordinate"]
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """Unknowns at ball centres and displacements of the rings, m, under the load and under the easiest one."""
        points = jax.lax.stop_gradient(jax.vmap(self._point)(centres, rings))
        own, easiest = (jax.tree.map(lambda leaf, i=i: leaf[i], points) for i in (0, 1))
        return own, easiest

    def _point(self, centre: Float[Array, "2 ball"], moved: Float[Array, " coordinate"]) -> ArrowPoint:
        elements, ring = (centre - self.free_centre()) / LENGTH_UNIT, moved / LENGTH_UNIT
        if not self.common_orbit:
            return ArrowPoint(elements, ring)
        at_rest = jnp.append(ring, 0.0)
        state = self.at(ArrowPoint(elements, at_rest))
        away = orbit_totals(self.arcs.on_inner(state.load), state.own_orbit, state.motion.orbital_speed)
        return ArrowPoint(elements, at_rest.at[-1].set(-orbit_row(jnp.sum(away, axis=1), self.orbit_unit)))

    def _estimates(self) -> tuple[CentrifugalProblem, Float[Array, "2 2 ball"], Float[Array, "2 coordinate"]]:
        """The convex problem at the centrifugal forces of the estimated contact angles, and estimates of ball centres
        and displacements of the rings under the load and under the easiest one; not differentiated."""
        core = jax.lax.stop_gradient(self)
        free = jnp.broadcast_to(core.grooves.free_angle, (2, core.azimuth.shape[0]))
        first = core._frozen(free)

        def under(rings: tuple[Array, ElasticRing | None]) -> tuple[Array, Array, Array]:
            problem = dataclasses.replace(first, ring_load=rings[0], outer=rings[1])
            ring = ring_estimate(problem)
            groove = problem.groove_at(ring)

            def better(turn: Array, last: tuple[Array, Array]) -> tuple[Array, Array]:
                placed = turn == ESTIMATES  # the forces are known, and the balls are placed
                centre, _ = free_centres(dataclasses.replace(problem, centrifugal=last[1]), groove, placed)
                inner, outer = core._loaded_side(groove, centre)
                angle = jnp.stack([jnp.arctan2(inner[0], inner[1]), jnp.arctan2(outer[0], outer[1])])
                return centre, jnp.where(placed, last[1], core.outward_force(core.motion(angle)))

            return *jax.lax.fori_loop(
                0, ESTIMATES + 1, better, (jnp.zeros((2, groove.shape[1])), problem.centrifugal)
            ), ring

        centres, forces, rings = jax.vmap(under)(core.own_and_easiest())
        return dataclasses.replace(first, centrifugal=forces[0]), centres, rings

    def own_and_easiest(self) -> tuple[Float[Array, "2 freedom"], ElasticRing | None]:
        """The load on the inner ring and the outer one if it bends: under their own loads and under the easiest ones,
        along a first axis."""
        ring, outer = self.rings_under(self.heavier)
        return jax.tree.map(lambda a, b: jnp.stack([a, b]), (self.ring.load, self.outer), (ring.load, outer))

    def _loaded_side(self, groove: Array, centre: Array) -> tuple[Array, Array]:
        """Arms of the contacts on the side towards which the inner ring has moved: from the ball centre to the inner
        arc, and from the outer arc to the ball centre, m."""
        pair, side = self.arcs.facing(groove)
        if self.arcs.outer is not None and side is not None:
            centre = centre.at[0].add(side * self.arcs.outer)
        return pair - centre, centre

    def at_free_angle(self) -> CentrifugalProblem:
        """The convex problem at the centrifugal forces of the contact angle of the unloaded bearing. They have no
        `FORCE_FLOOR`: balls at rest that nothing presses carry nothing."""
        angle = jnp.broadcast_to(self.grooves.free_angle, (2, self.azimuth.shape[0]))
        centrifugal = self.centrifugal(self.motion(angle).orbital_speed)
        return dataclasses.replace(self._frozen(angle), centrifugal=centrifugal)

    def _frozen(self, angle: Float[Array, "2 ball"]) -> CentrifugalProblem:
        """The convex problem at the centrifugal forces of given contact angles."""
        return CentrifugalProblem(
            offset=self.grooves.offset,
            stiffness=self.grooves.stiffness,
            groove=self._groove_at_rest(),
            directions=self._directions_of_rings(),
            ring_load=self.ring.load,
            held_load=self.ring.held_load,
            centrifugal=self.outward_force(self.motion(angle)),
            multiplicity=self.multiplicity,
            centre_distance=self.grooves.centre_distance,
            free_cosine=self.grooves.free_cosine,
            aligned=self.grooves.aligned,
            freedoms=self.freedoms,
            arcs=self.arcs,
            outer=self.outer,
            inner=self.inner,
        )

    def _directions_of_rings(self) -> Float[Array, "coordinate p ball"]:
        """Change of the coordinates of the inner groove, seen from the outer one, for a unit of each freedom of the
        inner ring and of each amplitude of flexible rings, m."""
        if not self.bent:
            return self.directions
        p, count = self.arcs.coordinates, self.azimuth.shape[0]
        bent = jnp.zeros((self.bent.modes, p, count)).at[:, 1].set(-self.bent.shapes())
        return jnp.concatenate([self.directions, bent])

    def _groove_at_rest(self) -> Float[Array, "p ball"]:
        """Coordinates of the inner groove of the ring without displacement, at its misalignment, m."""
        shift = jnp.zeros((len(self.freedoms), self.azimuth.shape[0]))
        if not self.exact:
            places = self.groove_centres(shift)
            return places if self.out_of_round is None else places.at[1].add(self.out_of_round)
        centre = jnp.broadcast_to(self.free_centre(), (2, self.azimuth.shape[0]))
        round_centre = centre if self.out_of_round is None else centre.at[1].add(-self.out_of_round)
        places = [centre + arm.in_plane for arm in self.inner_arms(shift, round_centre)[0]]
        if len(places) == 1:
            return places[0]
        front, back = places
        return jnp.concatenate([0.5 * (front + back), 0.5 * (back[1:] - front[1:])])

    @property
    def lanes_together(self) -> bool:
        return True

    @property
    def rounding(self) -> float:
        """Balls pressed between four contacts carry much more than the load on the ring, in which residuals are
        scaled: round-off of the distances leaves a few tolerances."""
        return 1.0 if self.arcs.single else PRESSED_ROUNDING

    @property
    def homotopies(self) -> int:
        return 1 if self.gyroscopic is None else 2

    def homotopy(self, parameter, path):
        """More load: the inner contacts of a fast, lightly loaded bearing are nearly lost; or less of the couple."""
        ratio = self.heavier
        guess, heavy = self.guesses()
        share = self.couple_share
        if self.gyroscopic is not None:
            ratio = jnp.where(path == 0, ratio, 1.0)
            heavy = jax.tree.map(lambda a, b: jnp.where(path == 0, a, b), heavy, guess)
            share = share * jnp.where(path == 0, 1.0, 1.0 - parameter)
        ring, outer = self.rings_under(ratio**parameter)
        return dataclasses.replace(
            self,
            ring=ring,
            outer=outer,
            couple_share=share,
            guess=guess,
            heavy_guess=heavy,
            parameter=parameter,
        )

    @property
    def extra_totals(self) -> int:
        # weighted speeds and weights
        return 1 if self.common_orbit else 0

    def element(self, unknowns, shared):
        local, totals, _ = self.seen(unknowns, shared)
        return local, totals, jnp.zeros(())

    def seen(self, unknowns: Float[Array, "2 ball"], shared: Float[Array, "g ball"]) -> tuple[Array, Array, BallState]:
        """Local residuals and contributions to the totals, as `element` gives them, and the state that they are of."""
        state = self.balls(unknowns, shared)
        totals = state.on_ring
        if self.common_orbit:
            speeds = orbit_totals(self.arcs.on_inner(state.load), state.own_orbit, state.motion.orbital_speed)
            totals = jnp.concatenate([totals, self.multiplicity * speeds])
        return state.balance / self.ball_scale(), totals, state

    def global_residual(self, globals_, totals):
        rows = self.ring_balance(globals_, totals, self.ring.needs_held_load) / self.load_scale()
        if self.common_orbit:
            rows = jnp.append(rows, orbit_row(totals[self.ring_unknowns :], self.orbit_unit))
        return rows, jnp.zeros(())

    # -- physics --------------------------------------------------------------------------------------------------

    def outward_force(self, motion: BallMotion) -> Array:
        """Centrifugal force with its `floor`, N."""
        return self.centrifugal(motion.orbital_speed) + (FORCE_FLOOR if self.floor is None else self.floor)

    def with_floor(self) -> "BallCore":
        """These equations with the addition to the centrifugal force for the load on the ring."""
        share = FLOOR_SHARE * self.load_scale() / self.ball_count
        turning = CENTRIFUGAL_SHARE * self.centrifugal(self.free_orbit())
        return dataclasses.replace(self, floor=jnp.minimum(FORCE_FLOOR, share + turning))

    def at(self, point: ArrowPoint) -> BallState:
        return self.balls(point.elements, seen_by_elements(self, point))

    def balls(self, unknowns: Float[Array, "2 ball"], shared: Float[Array, "g ball"]) -> BallState:
        centre = self.free_centre() + LENGTH_UNIT * unknowns[:2]
        touch = self.touch(shared, centre)
        load = self.loads(touch.apart)
        motion = self.rolling(touch.angle, load)
        own_orbit = motion.orbital_speed
        if self.common_orbit:
            motion = motion._replace(orbital_speed=self.free_orbit() + self.orbit_unit * shared[len(self.freedoms)])
        push = self.push(touch, load, self.couple_friction(motion, load))
        return BallState(
            load=load,
            angle=touch.angle,
            direction=touch.direction,
            centre=centre,
            motion=motion,
            own_orbit=own_orbit,
            balance=push.balance(self.outward_force(motion)),
            on_ring=push.on_ring,
        )

    def loads(self, apart: Float[Array, "contact ball"]) -> Float[Array, "contact ball"]:
        """Hertz loads from the distances of the centres, N; 0 and without slope where a contact is open."""
        approach = apart - self.arcs.of_contacts(self.grooves.offset)[:, None]
        closed = approach > 0
        power = jnp.where(closed, approach, 0.0) * jnp.sqrt(jnp.where(closed, approach, 1.0))
        return self.arcs.of_contacts(self.grooves.stiffness)[:, None] * power

    def rolling(self, angle: Float[Array, "contact ball"], load: Float[Array, "contact ball"]) -> BallMotion:
        """The motion at contact angles, rad, under loads, N."""
        if self.spread is None:
            return self.motion(angle, load[0] > 0)
        weight = slip_weights(load, self.arcs, FORCE_FLOOR)
        return linear_slip(self.kinematics, angle, weight, self.spread, self.arcs.races)

    def motion(self, angle: Float[Array, "2 ball"], touching: Bool[Array, " ball"] | None = None) -> BallMotion:
        """Rolling of two contacts without sliding, with the attitude of the controlling race. Of `linear_slip`, for
        which it only makes estimates, that is the outer one.

        Of a ball that does not touch the inner race (not `touching`) the direction of the inner groove's centre stands
        for the contact angle, up to `STEEPEST`.
        """
        inner, outer = angle
        rolls = jnp.abs(inner) <= STEEPEST
        rolls = rolls if touching is None else rolls | touching
        inner = jnp.where(rolls, inner, STEEPEST * jnp.sign(inner))
        return self.kinematics.rolling(inner, outer, self._attitude(inner, outer))

    def _attitude(self, inner: Array, outer: Array) -> Array:
        if self.attitude == "inner":
            return self.kinematics.inner_control(inner)
        return self.kinematics.outer_control(outer)
