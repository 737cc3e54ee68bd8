"""Base of the equations of ball bearings with and without films: grooves, ring, centrifugal force."""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.arrow import AbstractArrowSystem
from ...numerics.convex import anchored
from ...numerics.safe import safe_norm
from ..ring import ANCHOR, LENGTH_UNIT, TILTS, InnerRing
from .groove_motion import RingFrame, inner_arm, length_of, ring_frame
from .gyroscopic import AbstractGyroscopic
from .kinematics import BallKinematics, BallMotion

Attitude = Literal["outer", "inner", "min_power", "equilibrium"]


class Grooves(NamedTuple):
    """Geometry and stiffness of the grooves; `offset` and `stiffness` of (inner, outer), m and N/m^(3/2)."""

    offset: Float[Array, "2"]
    stiffness: Float[Array, "2"]
    centre_distance: Float[Array, ""]
    free_cosine: Float[Array, ""]
    free_sine: Float[Array, ""]
    aligned: Float[Array, ""]
    """Axial displacement of the ring at which the planes of the grooves coincide, m: 0, or less than 0 where
    displacements count from first contact."""
    lever: Float[Array, ""]
    """Radius of the circle of inner groove centres, R_i."""
    groove_arm: Float[Array, ""]
    """f_i D: of the friction at the inner race about that circle."""

    expansion: Float[Array, ""] | None = None
    """See `InnerRing.expansion`."""

    @property
    def free_angle(self) -> Float[Array, ""]:
        """Contact angle of the unloaded bearing, rad."""
        return jnp.arctan2(self.free_sine, self.free_cosine)

    @property
    def free_normal(self) -> Float[Array, "2 1"]:
        """Direction (axial, radial) from the outer to the inner groove centre of the ring without displacement."""
        return self.rest / safe_norm(self.rest[0], self.rest[1])[None]

    @property
    def rest(self) -> Float[Array, "2 1"]:
        """Inner groove centre (axial, radial) from the outer one, of the ring without displacement, m."""
        radial = self.centre_distance * self.free_cosine
        return jnp.stack([-self.aligned, radial if self.expansion is None else radial + self.expansion])[:, None]


class InnerArm(NamedTuple):
    """Vectors from the ball centres to the nearest inner groove centres, m.

    Components in the half-plane of the ball (axial, outward) and along the orbit, and the distance. `turned` is the
    rotation of the groove by the tilt (`RingFrame.turned`). It and the component along the orbit are `None` where the
    ring cannot tilt."""

    in_plane: Float[Array, "2 ball"]
    along: Float[Array, " ball"] | None
    length: Float[Array, " ball"]
    turned: Float[Array, " ball"] | None

    @property
    def share(self) -> Float[Array, " ball"]:
        """Part of the distance that lies in the half-plane."""
        return length_of(self.in_plane) / self.length


OnRing: TypeAlias = Callable[[Float[Array, "component ball"], Float[Array, " ball"]], Float[Array, "freedom ball"]]
"""Contributions of every ball to the forces on the ring's freedoms, N (moments in units of R_i), from its force on the
ring, axial, outward and, of an `exact` system, along the orbit, N, and its moment in the half-plane, N m."""


class AbstractBallSystem(AbstractArrowSystem):
    """Balls between two grooved rings; globals: first the displacements of the inner ring.

    `directions[f]` are the changes of the inner groove centre (axial, radial) at every ball for a unit of freedom f, to
    first order; the lever of the `ring` is R_i. `held_shift`: their changes by what the ring is held at, m. `exact`:
    whether the grooves move with the exact rotation of the ring (`groove_motion`).
    """

    kinematics: BallKinematics
    grooves: Grooves
    directions: Float[Array, "freedom 2 ball"]
    azimuth: Float[Array, " ball"]
    ring: InnerRing
    held_shift: Float[Array, "2 ball"]
    mass: Float[Array, ""]
    inertia: Float[Array, ""]
    gyroscopic: AbstractGyroscopic | None
    couple_share: Float[Array, ""]
    """Part of the gyroscopic couple that acts: 1, less in an easier system."""
    multiplicity: int = eqx.field(static=True)
    """Balls that each ball stands for."""
    attitude: Attitude = eqx.field(static=True)
    exact: bool = eqx.field(static=True)

    @property
    def ball_count(self) -> int:
        return self.multiplicity * self.azimuth.shape[0]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Freedoms of the ring that are unknown."""
        return self.ring.freedoms

    def load_balance(self, unknowns: Float[Array, " freedom"], totals: Float[Array, " freedom"]) -> Array:
        """Returns the forces of the balls on the unknown freedoms of the ring less the load on these, N.

        A ring that is held so that no ball touches it may float along the others: it is anchored.
        """
        balance = totals - self.ring.load
        return balance + anchored(unknowns, ANCHOR * LENGTH_UNIT) if self.ring.asks else balance

    def groove_centres(self, shift: Float[Array, "freedom ball"]) -> Float[Array, "2 ball"]:
        """Centres of the inner groove at every ball, (axial, radial) from those of the outer one, m, for displacements
        of the ring in units of `LENGTH_UNIT`; to first order."""
        moved = LENGTH_UNIT * jnp.einsum("fn,fcn->cn", shift, self.directions)
        return self.grooves.rest + moved + self.held_shift

    def ring_frame(self, shift: Float[Array, "freedom ball"]) -> RingFrame:
        """The displaced ring of an `exact` system, for displacements in units of `LENGTH_UNIT`."""
        return ring_frame(self.ring.moved(shift) * self.ring.units[:, None], self.azimuth)

    def inner_arm(self, shift: Float[Array, "freedom ball"], centre: Float[Array, "2 ball"]) -> InnerArm:
        """From ball centres, counted from the outer groove centre (axial, radial), m, to the inner groove centres."""
        if not self.exact:
            arm = self.groove_centres(shift) - centre
            return InnerArm(arm, None, safe_norm(arm[0], arm[1]), None)
        grooves, frame = self.grooves, self.ring_frame(shift)
        arm = inner_arm(frame, centre - grooves.rest, grooves.lever)
        return InnerArm(arm[:2], arm[2], length_of(arm), frame.turned)

    def centrifugal(self, orbital_speed: Array) -> Array:
        """N, of balls on the pitch circle."""
        return 0.5 * self.mass * self.kinematics.pitch_diameter * jnp.square(orbital_speed)

    def couple(self, motion: BallMotion) -> Array:
        """The gyroscopic couple that acts, N m (source eq. (13))."""
        spin = motion.spin_speed * motion.orbital_speed * jnp.sin(motion.attitude)
        return self.couple_share * self.inertia * spin

    def with_friction(
        self, load: Float[Array, "2 ball"], angle: Float[Array, "2 ball"], friction: Float[Array, "2 ball"] | None
    ) -> tuple[Array, Array, Array]:
        """Axial and radial force (both contacts) and moment (of the inner one, about the circle of groove centres) that
        normal loads and the friction that carries the couple make on the ring, N and N m."""
        sine, cosine = jnp.sin(angle), jnp.cos(angle)
        axial, radial = load * sine, load * cosine
        if friction is None:
            return axial, radial, jnp.zeros_like(load[0])
        moment = -friction[0] * self.grooves.groove_arm
        return axial + friction * cosine, radial - friction * sine, moment

    def reach(self, shift: Float[Array, "freedom ball"], centre: Float[Array, "2 ball"]) -> tuple[InnerArm, OnRing]:
        r"""From ball centres, counted from the outer groove centre (axial, radial), m, to the inner groove centres; and
        what forces there contribute to those on the ring's freedoms.

        The contributions are conjugate to the displacements: force times the motion of the nearest groove centre,
        moment times the turning of the groove. To second order the moment is
        $R_i(p_x\cos t\cos\psi - p_r\sin t\cos^2\psi)$.
        """
        if not self.exact:
            return self.inner_arm(shift, centre), self._to_first_order

        def move(shift: Array) -> tuple[Array, InnerArm]:
            arm = self.inner_arm(shift, centre)
            assert arm.turned is not None
            assert arm.along is not None
            return jnp.concatenate([arm.in_plane, jnp.stack([arm.along, arm.turned])]), arm

        _, pull, arm = jax.vjp(move, shift, has_aux=True)

        def on_ring(force: Array, moment: Array) -> Array:
            return (self.multiplicity / LENGTH_UNIT) * pull(jnp.concatenate([force, moment[None]]))[0]

        return arm, on_ring

    def _to_first_order(self, force: Array, moment: Array) -> Array:
        if not self.freedoms:
            return jnp.zeros((0, self.azimuth.shape[0]))
        rows = []
        for direction, name in zip(self.directions, self.freedoms, strict=True):
            row = jnp.sum(force * direction, axis=0)
            if name in TILTS:
                # the tilt turns the axial direction of the groove's centre
                row = row + moment * direction[0] / self.grooves.lever
            rows.append(self.multiplicity * row)
        return jnp.stack(rows)

    def shared_fields(self) -> dict[str, Any]:
        """Arguments of another system of the same balls."""
        return {name: getattr(self, name) for name in AbstractBallSystem.__dataclass_fields__}
