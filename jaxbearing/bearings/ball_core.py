r"""Loads and contact angles of a ball bearing without friction: the block-arrow core of every ball bearing model.

Unknown per ball: its centre (V axial, W radial) from the centre of the outer groove; globally: the displacement of the
inner ring. With $A = (A_1, A_2)$ the centre of the inner groove at the ball's azimuth,

- $l_o = |(V, W)|$, $l_i = |A - (V, W)|$, $\delta_k = l_k - g_k + h_k$, $Q_k = K_k\delta_{k+}^{3/2}$ (source eqs.
  (23)-(26); a film h stores approach like extra metal, and then $Q_k$ is the root of its own equation);
- ball: $Q_o\sin\alpha_o - Q_i\sin\alpha_i - \sigma(T_i\cos\alpha_i - T_o\cos\alpha_o) = 0$ and
  $Q_o\cos\alpha_o - Q_i\cos\alpha_i + \sigma(T_i\sin\alpha_i - T_o\sin\alpha_o) = F_C$ (eqs. (14)-(15));
- ring: $\sum p_x = F_a$, $\sum p_r\cos\psi = F_r$, $\sum(R_ip_x - \sigma T_if_iD)\cos\psi = M$ (eqs. (21)-(22)), with
  $p_x = Q_i\sin\alpha_i + \sigma T_i\cos\alpha_i$ and $p_r = Q_i\cos\alpha_i - \sigma T_i\sin\alpha_i$.

$F_C = \frac12md_m\omega_m^2$, with the orbital speed of rolling without sliding at the ball's own angles and attitude.
Written as forces that grow with their displacement. For T = 0 and frozen $F_C$ they are the gradient of one convex
potential (`ball_start` descends it).
"""

from typing import Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import AbstractArrowSystem, ArrowPoint
from ..numerics.safe import safe_norm
from .ball_kinematics import BallKinematics, BallMotion
from .ball_start import CentrifugalProblem, start
from .gyroscopic import AbstractGyroscopic

LENGTH_UNIT = 1e-5
"""Scale of displacements, m."""
FORCE_FLOOR = 1e-3
"""Added to the centrifugal force, N: a ball that nothing loads stays in its outer groove (load error 1e-3 N)."""


class Grooves(NamedTuple):
    """What the normal loads of a ball need; `offset` and `stiffness` of (inner, outer), m and N/m^(3/2)."""

    offset: Float[Array, "2"]
    stiffness: Float[Array, "2"]
    centre_distance: Float[Array, ""]
    free_cosine: Float[Array, ""]
    free_sine: Float[Array, ""]
    lever: Float[Array, ""]
    """Radius of the circle of inner groove centres, R_i."""
    groove_arm: Float[Array, ""]
    """f_i D: of the friction at the inner race about that circle."""


class BallState(NamedTuple):
    """Everything that happens at the balls for given unknowns; loads and angles (inner, outer) first."""

    load: Float[Array, "2 ball"]
    angle: Float[Array, "2 ball"]
    motion: BallMotion
    centrifugal: Float[Array, " ball"]
    friction: Float[Array, "2 ball"] | None
    balance: Float[Array, "2 ball"]
    """Left side minus right side of the ball's two force balances, N."""
    ring_force: Float[Array, "2 ball"]
    """p_x, p_r: of the balls on the inner ring, N."""
    ring_moment: Float[Array, " ball"]
    """Of a ball on the inner ring about the tangent of the circle of groove centres, N m."""


class BallCore(AbstractArrowSystem):
    """Balls that roll without sliding, with the attitude of outer or inner race control.

    `directions[f]` are the changes of (A1, A2) at every ball for a unit of freedom f; tilts are multiplied by R_i, so
    that every unknown of the ring is a length. `held` displaces the inner groove centres beside that (misalignment).
    """

    kinematics: BallKinematics
    grooves: Grooves
    directions: Float[Array, "freedom 2 ball"]
    held: Float[Array, "2 ball"]
    ring_load: Float[Array, " freedom"]
    mass: Float[Array, ""]
    inertia: Float[Array, ""]
    freedoms: tuple[str, ...] = eqx.field(static=True)
    multiplicity: int = eqx.field(static=True)
    """Balls that each ball stands for."""
    attitude: Literal["outer", "inner"] = eqx.field(static=True, default="outer")
    gyroscopic: AbstractGyroscopic | None = None

    # -- scales ---------------------------------------------------------------------------------------------------

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return jnp.sqrt(jnp.sum(jnp.square(self.ring_load)) + (self.ball_count * FORCE_FLOOR) ** 2)

    def ball_scale(self) -> Array:
        """Scale of a ball's balances, N."""
        angle = jnp.arctan2(self.grooves.free_sine, self.grooves.free_cosine)
        free = self.kinematics.rolling(angle, angle, angle)
        return self.load_scale() / self.ball_count + self.centrifugal(free)

    @property
    def ball_count(self) -> int:
        return self.multiplicity * self.held.shape[1]

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        ring = tuple(f"{name} load balance of the ring" for name in self.freedoms)
        return ("axial balance of a ball", "radial balance of a ball", *ring)

    def step_caps(self) -> ArrowPoint:
        half = 0.5 * self.grooves.centre_distance / LENGTH_UNIT
        return ArrowPoint(jnp.stack([half, half])[:, None], jnp.full(len(self.freedoms), half))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        far = 1e6
        elements, ring = jnp.full((2, 1), far), jnp.full(len(self.freedoms), far)
        return ArrowPoint(-elements, -ring), ArrowPoint(elements, ring)

    def initial(self) -> ArrowPoint:
        """From the convex problem at the centrifugal force of the free contact angle."""
        angle = jnp.arctan2(self.grooves.free_sine, self.grooves.free_cosine)
        free = self.kinematics.rolling(angle, angle, self._attitude(angle, angle))
        problem = CentrifugalProblem(
            offset=self.grooves.offset,
            stiffness=self.grooves.stiffness,
            groove=self.free_groove() + self.held,
            directions=self.directions,
            ring_load=self.ring_load,
            centrifugal=self.centrifugal(free),
            multiplicity=self.multiplicity,
            centre_distance=self.grooves.centre_distance,
            free_cosine=self.grooves.free_cosine,
            freedoms=self.freedoms,
        )
        found = start(problem)
        return ArrowPoint((found.centre - self.free_centre()) / LENGTH_UNIT, found.ring / LENGTH_UNIT)

    @property
    def paths(self) -> int:
        return 1

    def eased(self, ease, path):
        """More load: the inner contacts of a fast, lightly loaded bearing are nearly lost."""
        free = self.ball_count * (self.ball_scale() - self.load_scale() / self.ball_count)
        return eqx.tree_at(
            lambda system: system.ring_load, self, self.ring_load * (1.0 + free / self.load_scale()) ** ease
        )

    def element(self, unknowns, shared):
        state = self.balls(unknowns, shared)
        return state.balance / self.ball_scale(), self.contributions(state), jnp.zeros(())

    def contributions(self, state: BallState) -> Float[Array, "freedom ball"]:
        """Of every ball to the forces on the ring's freedoms, N."""
        rows = []
        for direction, name in zip(self.directions, self.freedoms, strict=True):
            force = jnp.sum(state.ring_force * direction, axis=0)
            if name.startswith("tilt"):
                # the tilt turns the axial direction of (A1, A2); the moment is in units of R_i
                force = force + state.ring_moment * direction[0] / self.grooves.lever
            rows.append(self.multiplicity * force)
        return jnp.stack(rows)

    def closure(self, globals_, totals):
        return (totals - self.ring_load) / self.load_scale(), jnp.zeros(())

    # -- physics --------------------------------------------------------------------------------------------------

    def free_centre(self) -> Float[Array, "2 1"]:
        """Centre of an unloaded ball at the free contact angle, m."""
        grooves = self.grooves
        return grooves.offset[1] * jnp.stack([grooves.free_sine, grooves.free_cosine])[:, None]

    def free_groove(self) -> Float[Array, "2 1"]:
        """Centre of the inner groove of the bearing at rest, m."""
        grooves = self.grooves
        return grooves.centre_distance * jnp.stack([grooves.free_sine, grooves.free_cosine])[:, None]

    def centrifugal(self, motion: BallMotion) -> Array:
        """N, with `FORCE_FLOOR`."""
        return 0.5 * self.mass * self.kinematics.pitch_diameter * jnp.square(motion.orbital_speed) + FORCE_FLOOR

    def balls(self, unknowns: Float[Array, "2 ball"], shared: Float[Array, "g ball"]) -> BallState:
        freedoms = len(self.freedoms)
        centre = self.free_centre() + LENGTH_UNIT * unknowns[:2]
        shift = LENGTH_UNIT * jnp.einsum("fn,fcn->cn", shared[:freedoms], self.directions)
        inner = self.free_groove() + self.held + shift - centre
        apart = jnp.stack([safe_norm(inner[0], inner[1]), safe_norm(centre[0], centre[1])])
        angle = jnp.stack([jnp.arctan2(inner[0], inner[1]), jnp.arctan2(centre[0], centre[1])])
        load = self.loads(apart)
        motion = self.motion(angle)
        centrifugal = self.centrifugal(motion)
        sine, cosine = jnp.sin(angle), jnp.cos(angle)
        axial, radial = load * sine, load * cosine
        friction, moment = None, jnp.zeros_like(centrifugal)
        if self.gyroscopic is not None:
            couple = self.inertia * motion.spin_speed * motion.orbital_speed * jnp.sin(motion.attitude)
            carried = self.gyroscopic.friction(couple, self.kinematics.ball_diameter, load[0], load[1])
            friction = self.gyroscopic.sign * jnp.stack(carried)
            axial, radial = axial + friction * cosine, radial - friction * sine
            moment = -friction[0] * self.grooves.groove_arm
        balance = jnp.stack([axial[1] - axial[0], radial[1] - radial[0] - centrifugal])
        return BallState(
            load=load,
            angle=angle,
            motion=motion,
            centrifugal=centrifugal,
            friction=friction,
            balance=balance,
            ring_force=jnp.stack([axial[0], radial[0]]),
            ring_moment=moment,
        )

    def loads(self, apart: Float[Array, "2 ball"]) -> Float[Array, "2 ball"]:
        """Hertz loads from the distances of the centres, N; 0 and without slope where a contact is open."""
        approach = apart - self.grooves.offset[:, None]
        closed = approach > 0
        power = jnp.where(closed, approach, 0.0) * jnp.sqrt(jnp.where(closed, approach, 1.0))
        return self.grooves.stiffness[:, None] * power

    def motion(self, angle: Float[Array, "2 ball"]) -> BallMotion:
        """Rolling without sliding, with the attitude of the controlling race."""
        return self.kinematics.rolling(angle[0], angle[1], self._attitude(angle[0], angle[1]))

    def _attitude(self, inner: Array, outer: Array) -> Array:
        if self.attitude == "outer":
            return self.kinematics.outer_control(outer)
        return self.kinematics.inner_control(inner)
