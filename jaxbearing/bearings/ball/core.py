r"""Loads and contact angles of a ball bearing without friction: the block-arrow core of every ball bearing model.

The unknowns of each ball are the position of its centre from the centre of the outer groove (V axial, W radial); the
global unknowns are the displacements of the inner ring. With the centre $A = (A_1, A_2)$ of the inner groove at the
azimuth of the ball,

- contacts: $l_o = |(V, W)|$, $l_i = |A - (V, W)|$, $\delta_k = l_k - g_k + h_k$, $Q_k = K_k\delta_{k+}^{3/2}$ (source
  eqs. (23)-(26)); a film of thickness h adds to the approach as if the ball were larger, and $Q_k$ is then the root of
  this equation, because h depends on $Q_k$;
- ball: $Q_o\sin\alpha_o - Q_i\sin\alpha_i - \sigma(T_i\cos\alpha_i - T_o\cos\alpha_o) = 0$ and
  $Q_o\cos\alpha_o - Q_i\cos\alpha_i + \sigma(T_i\sin\alpha_i - T_o\sin\alpha_o) = F_C$ (eqs. (14)-(15));
- ring: $\sum p_x = F_a$, $\sum p_r\cos\psi = F_r$, $\sum(R_ip_x - \sigma T_if_iD)\cos\psi = M$ (eqs. (21)-(22)), with
  $p_x = Q_i\sin\alpha_i + \sigma T_i\cos\alpha_i$ and $p_r = Q_i\cos\alpha_i - \sigma T_i\sin\alpha_i$.

The centrifugal force is $F_C = \frac12md_m\omega_m^2$. Its orbital speed $\omega_m$ is that of rolling without sliding
at the angles and the attitude of the ball. With `common_orbit`, all balls have one $\omega_m$ (in the source that of
the cage), which is one more unknown: the mean of their own speeds, weighted by the inner loads,
$\sum Q_{ij}(\omega_{mj} - \omega_m) = 0$. The spin of each ball remains that of its own rolling. The equations are
written as forces that grow with their displacement. For T = 0 and constant $F_C$ they are the gradient of a convex
potential, which `start` minimises.
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
"""Force added to the centrifugal force, N. It keeps unloaded balls in the outer groove (load error 1e-3 N)."""
FLOOR_SHARE = 1e-4
"""Largest added force over the mean load of a ball. A larger force would make balls at rest roll down the outer groove,
and move a ring that carries 0.01 N by 20 um along its axis."""
CENTRIFUGAL_SHARE = 1e-3
"""The outward force that is added to a ball may be as large as this fraction of its centrifugal force, which presses
the ball outwards anyway."""

ESTIMATES = 3
"""Fixed-point passes between centrifugal forces and contact angles in the first guess."""

EASY_LOAD = 1e5
"""Load of a ball over the square of its diameter in the easiest system, Pa. Under this load the contacts are stiffer
than their films."""

STEEPEST = 1.4
"""Largest contact angle, rad, assumed for the speed of a ball that does not touch the inner groove: the speed of
rolling without sliding has a pole near 90 degrees."""


PRESSED_ROUNDING = 10.0
"""Value of `AbstractArrowSystem.rounding` for rings with two arcs. A clearance of -2 um, for example, presses balls of
30 mm with 100 N, while the load on the ring is 1 N."""

ORBIT_FLOOR = 1.0
"""Floor of the scale of orbital speeds, rad/s, added as a square: without it the scale is 0 for a bearing at rest."""


def orbit_totals(load: Array, own: Array, common: Array) -> Float[Array, "2 ball"]:
    """Contributions of each ball to the two sums of `orbit_row`: its weighted speed difference and its weight.

    **Arguments:** `load`: inner load, N; `own`, `common`: orbital speed of the ball's own rolling and that of all
    balls, rad/s. `FORCE_FLOOR` is added to the weights, so that their sum is not 0."""
    weight = load + FORCE_FLOOR
    return jnp.stack([weight * (common - own), weight])


def orbit_row(totals: Float[Array, "2"], unit: Array) -> Array:
    """Scaled difference between the common orbital speed and the weighted mean of the balls' own speeds.

    **Arguments:** `totals`: sums over the balls of `orbit_totals`; `unit`: scale of orbital speeds, rad/s."""
    return totals[0] / (totals[1] * unit)


class BallState(NamedTuple):
    """State of the balls for given unknowns. The first axis of loads and angles is that of the contacts (`arcs`):
    inner, outer if each ring has one arc."""

    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    """Contact angles, rad; that at the inner race is relative to the tilted ring."""
    direction: Float[Array, "contact ball"]
    """Angle of the contact normals from the outward radius towards the axis $+e_x$, in the fixed frame, rad."""
    centre: Float[Array, "2 ball"]
    """Centre of the ball, from the outer groove centre, m."""
    motion: BallMotion
    own_orbit: Float[Array, " ball"]
    """Orbital speed of rolling without sliding at the ball's own angles, rad/s. With `common_orbit` it differs from
    that of `motion`."""
    balance: Float[Array, "2 ball"]
    """Left side minus right side of the axial and the radial force balance of the ball, N."""
    on_ring: Float[Array, "row ball"]
    """Contributions of each ball to the forces on the degrees of freedom of the ring, N, then the radial forces on
    flexible rings. The former come from p_x, p_r, the moment about the tangent of the circle of groove centres and, if
    the ring may tilt, the force along the orbit."""


class BallCore(AbstractBallSystem):
    """Balls that roll without sliding, under outer or inner race control, or that slide as little as their contacts
    allow (`linear_slip`).

    The iteration starts at `guess`, and that of an easier system (`parameter` > 0, see `homotopy`) at `heavy_guess`.
    Both come from `started`; if they are `None`, it starts at estimates by formulas.
    """

    guess: ArrowPoint | None = None
    heavy_guess: ArrowPoint | None = None
    parameter: Float[Array, ""] | None = None
    common_orbit: bool = eqx.field(static=True, default=False)
    spread: Float[Array, "2"] | None = None
    """Size of the contact ellipses as in `linear_slip`, m^2/N^(2/3); `None` under race control."""
    floor: Float[Array, ""] | None = None
    """Force added to the centrifugal force, N: `FORCE_FLOOR`, or less under small loads (see `with_floor`); `None`:
    `FORCE_FLOOR`."""

    # -- scales ---------------------------------------------------------------------------------------------------

    def load_scale(self) -> Array:
        """Scale of the force balances of the ring, N."""
        return jnp.sqrt(jnp.square(self.ring.size()) + (self.ball_count * FORCE_FLOOR) ** 2)

    def ball_scale(self) -> Array:
        """Scale of the force balances of a ball, N."""
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
        """Ratio of the easiest load to the load on the ring. The easiest load has, for each ball, the centrifugal force
        of rolling and `EASY_LOAD` D^2 more."""
        angle = self.grooves.free_angle
        force = self.outward_force(self.kinematics.rolling(angle, angle, angle))
        force = force + EASY_LOAD * jnp.square(self.kinematics.ball_diameter)
        return 1.0 + self.ball_count * force / self.load_scale()

    def guesses(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Initial guesses of the unknowns under the load on the ring and under the easiest load."""
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
        """These equations with the minimum of the convex problem as first guess, and the number of Newton steps of
        that minimisation."""
        problem, centres, rings = self._estimates()
        minimum = start(problem, rings[0])
        guess, heavy = self._points(centres.at[0].set(minimum.centre), rings.at[0].set(minimum.ring))
        return dataclasses.replace(self, guess=guess, heavy_guess=heavy), minimum.steps

    def _points(
        self, centres: Float[Array, "2 2 ball"], rings: Float[Array, "2 coordinate"]
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """Unknowns from ball centres and displacements of the rings, m, under the load on the ring and under the
        easiest load (the first axis of both arguments)."""
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
        """The convex problem with the centrifugal forces of the estimated contact angles, and estimates of ball centres
        and displacements of the rings, m, under the load on the ring and under the easiest load. Not differentiated."""
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
        """Load on the inner ring, N, and the outer ring with its loads if it is flexible. Both are stacked along a
        first axis: own load, easiest load."""
        ring, outer = self.rings_under(self.heavier)
        return jax.tree.map(lambda a, b: jnp.stack([a, b]), (self.ring.load, self.outer), (ring.load, outer))

    def _loaded_side(self, groove: Array, centre: Array) -> tuple[Array, Array]:
        """Vectors from the ball centre to the centre of the inner arc, and from the centre of the outer arc to the ball
        centre, m; both arcs are those on the side towards which the inner ring has moved axially."""
        pair, side = self.arcs.facing(groove)
        if self.arcs.outer is not None and side is not None:
            centre = centre.at[0].add(side * self.arcs.outer)
        return pair - centre, centre

    def at_free_angle(self) -> CentrifugalProblem:
        """The convex problem with the centrifugal forces at the contact angle of the unloaded bearing. `FORCE_FLOOR`
        is not added, so unloaded balls at rest have exactly zero load."""
        angle = jnp.broadcast_to(self.grooves.free_angle, (2, self.azimuth.shape[0]))
        centrifugal = self.centrifugal(self.motion(angle).orbital_speed)
        return dataclasses.replace(self._frozen(angle), centrifugal=centrifugal)

    def _frozen(self, angle: Float[Array, "2 ball"]) -> CentrifugalProblem:
        """The convex problem with the centrifugal forces at given contact angles, rad."""
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
        """Derivatives of the coordinates of the inner groove relative to the outer groove by each freedom of the inner
        ring and by each amplitude of flexible rings."""
        if not self.bent:
            return self.directions
        p, count = self.arcs.coordinates, self.azimuth.shape[0]
        bent = jnp.zeros((self.bent.modes, p, count)).at[:, 1].set(-self.bent.shapes())
        return jnp.concatenate([self.directions, bent])

    def _groove_at_rest(self) -> Float[Array, "p ball"]:
        """Coordinates of the inner groove if the unknown displacements of the ring are 0 and the prescribed ones (a
        misalignment, for example) have their values, m."""
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
        """Balls pressed between four contacts can carry much more than the load on the ring, by which residuals are
        scaled. The round-off of the distances then amounts to a few tolerances."""
        return 1.0 if self.arcs.single else PRESSED_ROUNDING

    @property
    def homotopies(self) -> int:
        return 1 if self.gyroscopic is None else 2

    def homotopy(self, parameter, path):
        """The first path of easier systems has a larger load on the ring, because the inner contacts of a fast, lightly
        loaded bearing are nearly lost. The second path, if there is a gyroscopic couple, has a smaller couple."""
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
        """Local residuals and contributions to the totals as in `element`, and the state of the balls."""
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
        """Centrifugal force plus the added force `floor`, N."""
        return self.centrifugal(motion.orbital_speed) + (FORCE_FLOOR if self.floor is None else self.floor)

    def with_floor(self) -> "BallCore":
        """These equations with the `floor` that fits the load on the ring and the centrifugal force."""
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
        """Hertz loads, N, from the distances between ball and groove centres, m. Load and derivative are 0 where a
        contact is open."""
        approach = apart - self.arcs.of_contacts(self.grooves.offset)[:, None]
        closed = approach > 0
        power = jnp.where(closed, approach, 0.0) * jnp.sqrt(jnp.where(closed, approach, 1.0))
        return self.arcs.of_contacts(self.grooves.stiffness)[:, None] * power

    def rolling(self, angle: Float[Array, "contact ball"], load: Float[Array, "contact ball"]) -> BallMotion:
        """Motion of the balls at given contact angles, rad, and loads, N."""
        if self.spread is None:
            return self.motion(angle, load[0] > 0)
        weight = slip_weights(load, self.arcs, FORCE_FLOOR)
        return linear_slip(self.kinematics, angle, weight, self.spread, self.arcs.races)

    def motion(self, angle: Float[Array, "2 ball"], touching: Bool[Array, " ball"] | None = None) -> BallMotion:
        """Motion of balls with two contacts that roll without sliding, with the attitude of the controlling race. With
        `linear_slip`, where this motion is only an estimate, the outer race controls.

        A ball that does not touch the inner race (not `touching`) is assigned the direction of the inner groove centre,
        limited to `STEEPEST`, as contact angle.
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
