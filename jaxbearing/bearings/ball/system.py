"""Base of the equations of ball bearings with and without films: grooves, ring, centrifugal force."""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.safe import safe_norm
from ..elastic_ring import ElasticRing
from ..ring import LENGTH_UNIT, TILTS, InnerRing
from ..rings import AbstractBetweenRings
from .arcs import Arcs, added
from .groove_motion import RingFrame, inner_arm, length_of, ring_frame
from .gyroscopic import NO_LOAD, AbstractGyroscopic
from .kinematics import BallKinematics, BallMotion

Attitude = Literal["outer", "inner", "linear_slip", "min_power", "equilibrium"]


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
    arcs: Arcs = Arcs()

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
        radial = radial if self.expansion is None else radial + self.expansion
        return jnp.stack([-self.aligned, radial])[:, None]

    @property
    def of_ring(self) -> Float[Array, "p 1"]:
        """Coordinates of the inner groove (`arcs`) of the ring without displacement, m."""
        return self.rest if self.arcs.inner is None else jnp.concatenate([self.rest, jnp.zeros((1, 1))])

    @property
    def turning(self) -> Array | None:
        """e_i/R_i; `None` if the inner ring has one arc."""
        return None if self.arcs.inner is None else self.arcs.inner / self.lever


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


OnRing: TypeAlias = Callable[
    [tuple[Float[Array, "component ball"], ...], Float[Array, " ball"]], Float[Array, "freedom ball"]
]
"""Contributions of every ball to the forces on the ring's freedoms, N (moments in units of R_i), from its forces on the
arcs of the ring, axial, outward and, of an `exact` system, along the orbit, N, and its moment in the half-plane, N m.
"""


class Touch(NamedTuple):
    """Contacts of the balls for given places of their centres, before any load is known.

    - `apart`: distances of the groove centres from the ball centre, m.
    - `direction`: of the normal forces on the ball, from the radius towards the axis, in the fixed frame, rad; `angle`:
      contact angles, on the inner race against the tilted ring.
    - `arms`: from the ball centres to the inner groove centres; `on_ring`: of `AbstractBallSystem.reach`.
    """

    apart: Float[Array, "contact ball"]
    direction: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    arms: tuple[InnerArm, ...]
    on_ring: OnRing


class Push(NamedTuple):
    """Forces of the contacts: on the outer ring less those on the inner one, axial and outward, N, and what they
    contribute to the forces on the rings, N: on the freedoms of the inner one, and the radial forces on rings that
    bend (`AbstractBetweenRings`)."""

    axial: Float[Array, " ball"]
    outward: Float[Array, " ball"]
    on_ring: Float[Array, "row ball"]


class AbstractBallSystem(AbstractBetweenRings):
    """Balls between two grooved rings.

    Ball centres count from the centre of the outer groove at the azimuth of the ball, which moves outwards by the
    deflection of the outer ring there, as the inner groove does by that of the inner ring.

    `directions[f]` are the changes of the coordinates of the inner groove (`arcs`; of one arc its centre, axial and
    radial) at every ball for a unit of freedom f, to first order; the lever of the `ring` is R_i. `held_shift`: their
    changes by what the ring is held at, m. `exact`: whether the grooves move with the exact rotation of the ring
    (`groove_motion`). `out_of_round`: displacement towards each ball of races that are not round, m, and `outer`,
    `inner`: the rings if they bend; `None` where they are round and rigid.
    """

    kinematics: BallKinematics
    grooves: Grooves
    directions: Float[Array, "freedom p ball"]
    azimuth: Float[Array, " ball"]
    ring: InnerRing
    held_shift: Float[Array, "p ball"]
    mass: Float[Array, ""]
    inertia: Float[Array, ""]
    gyroscopic: AbstractGyroscopic | None
    couple_share: Float[Array, ""]
    """Part of the gyroscopic couple that acts: 1, less in an easier system."""
    out_of_round: Float[Array, " ball"] | None
    outer: ElasticRing | None
    inner: ElasticRing | None
    multiplicity: int = eqx.field(static=True)
    """Balls that each ball stands for."""
    attitude: Attitude = eqx.field(static=True)
    exact: bool = eqx.field(static=True)

    @property
    def ball_count(self) -> int:
        return self.multiplicity * self.azimuth.shape[0]

    @property
    def arcs(self) -> Arcs:
        return self.grooves.arcs

    def free_centre(self) -> Float[Array, "2 1"]:
        """Centre of an unloaded ball at the free contact angle, m."""
        return self.grooves.offset[1] * self.grooves.free_normal

    def groove_centres(self, shift: Float[Array, "freedom ball"]) -> Float[Array, "p ball"]:
        """Coordinates of the inner groove at every ball (`arcs`; axial and radial from the centre of the outer one), m,
        for displacements of the ring in units of `LENGTH_UNIT`; to first order."""
        moved = LENGTH_UNIT * jnp.einsum("fn,fcn->cn", shift, self.directions)
        return self.grooves.of_ring + moved + self.held_shift

    def ring_frame(self, shift: Float[Array, "freedom ball"]) -> RingFrame:
        """The displaced ring of an `exact` system, for displacements in units of `LENGTH_UNIT`."""
        return ring_frame(self.ring.moved(shift) * self.ring.units[:, None], self.azimuth)

    def from_round(self, centre: Float[Array, "2 ball"], shared: Float[Array, "p ball"]) -> Float[Array, "2 ball"]:
        """Ball centres (axial, radial), m, counted from the centre of the outer groove, as they are for rings that are
        round and rigid."""
        for opening in self.opened(shared).values():
            centre = jnp.stack([centre[0], centre[1] + opening])
        if self.out_of_round is not None:
            centre = jnp.stack([centre[0], centre[1] - self.out_of_round])
        return centre

    def inner_arms(self, shift: Float[Array, "freedom ball"], centre: Float[Array, "2 ball"]) -> tuple[InnerArm, ...]:
        """From ball centres of `from_round`, m, to the centres of each inner arc."""
        if not self.exact:
            arms = [groove - centre for groove in self.arcs.inner_centres(self.groove_centres(shift))]
            return tuple(InnerArm(arm, None, safe_norm(arm[0], arm[1]), None) for arm in arms)
        grooves, frame = self.grooves, self.ring_frame(shift)
        place = centre - grooves.rest
        found = []
        for side in self.arcs.inner_sides:
            offset = 0.0 if self.arcs.inner is None else side * self.arcs.inner
            arm = inner_arm(frame, place, grooves.lever, offset)
            found.append(InnerArm(arm[:2], arm[2], length_of(arm), frame.turned))
        return tuple(found)

    def centrifugal(self, orbital_speed: Array) -> Array:
        """N, of balls on the pitch circle."""
        return 0.5 * self.mass * self.kinematics.pitch_diameter * jnp.square(orbital_speed)

    def couple(self, motion: BallMotion) -> Array:
        """The gyroscopic couple that acts, N m (source eq. (13))."""
        spin = motion.spin_speed * motion.orbital_speed * jnp.sin(motion.attitude)
        return self.couple_share * self.inertia * spin

    def with_friction(
        self,
        load: Float[Array, "contact ball"],
        angle: Float[Array, "contact ball"],
        friction: Float[Array, "contact ball"] | None,
    ) -> tuple[Array, Array, Array]:
        """Axial and radial force (all contacts) and moment (of the inner ones, about their groove centres) that normal
        loads and the friction that carries the couple make on the ring, N and N m."""
        sine, cosine = jnp.sin(angle), jnp.cos(angle)
        axial, radial = load * sine, load * cosine
        if friction is None:
            return axial, radial, jnp.zeros_like(load[0])
        moment = -self.arcs.on_inner(friction) * self.grooves.groove_arm
        return axial + friction * cosine, radial - friction * sine, moment

    def couple_friction(
        self, motion: BallMotion, load: Float[Array, "contact ball"]
    ) -> Float[Array, "contact ball"] | None:
        """Friction of each contact that carries the gyroscopic couple, with its sign, N; `None` where no law says. The
        contacts of a ring with two arcs share in proportion to their loads, N."""
        if self.gyroscopic is None:
            return None
        loads = self.arcs.on_inner(load), self.arcs.on_outer(load)
        parts = self.gyroscopic.friction(self.couple(motion), self.kinematics.ball_diameter, *loads)
        if self.arcs.single:
            return self.gyroscopic.sign * jnp.stack(parts)
        shares = [parts[race] * load[k] / (loads[race] + NO_LOAD) for k, race in enumerate(self.arcs.races)]
        return self.gyroscopic.sign * jnp.stack(shares)

    def reach(
        self, shared: Float[Array, "p ball"], centre: Float[Array, "2 ball"]
    ) -> tuple[tuple[InnerArm, ...], OnRing]:
        r"""From ball centres, counted from the outer groove centre (axial, radial), m, to the inner arcs' centres;
        and what forces there contribute to those on the ring's freedoms.

        The contributions are conjugate to the displacements: force times the motion of the nearest groove centre,
        moment times the turning of the groove. To second order the moment is
        $R_i(p_x\cos t\cos\psi - p_r\sin t\cos^2\psi)$.
        """
        shift, centre = shared[: len(self.freedoms)], self.from_round(centre, shared)
        if not self.exact:
            return self.inner_arms(shift, centre), self._to_first_order

        def move(shift: Array) -> tuple[Array, tuple[InnerArm, ...]]:
            arms, parts = self.inner_arms(shift, centre), []
            for arm in arms:
                assert arm.along is not None
                parts += [arm.in_plane, arm.along[None]]
            turned = arms[0].turned
            assert turned is not None
            return jnp.concatenate([*parts, turned[None]]), arms

        _, pull, arms = jax.vjp(move, shift, has_aux=True)

        def on_ring(forces: tuple[Array, ...], moment: Array) -> Array:
            return (self.multiplicity / LENGTH_UNIT) * pull(jnp.concatenate([*forces, moment[None]]))[0]

        return arms, on_ring

    def touch(self, shared: Float[Array, "p ball"], centre: Float[Array, "2 ball"]) -> Touch:
        """The contacts of balls whose centres are known, m from the middle of the outer arcs (axial, radial)."""
        arms, on_ring = self.reach(shared, centre)
        rests = self.arcs.from_outer(centre)
        apart = jnp.stack([*(arm.length for arm in arms), *(safe_norm(rest[0], rest[1]) for rest in rests)])
        leaning = [*(arm.in_plane for arm in arms), *rests]
        direction = angle = jnp.stack([jnp.arctan2(one[0], one[1]) for one in leaning])
        for k, arm in enumerate(arms):
            if arm.turned is not None:
                angle = angle.at[k].add(-arm.turned)
        return Touch(apart, direction, angle, arms, on_ring)

    def push(
        self, touch: Touch, load: Float[Array, "contact ball"], friction: Float[Array, "contact ball"] | None
    ) -> Push:
        """The forces of all contacts. **Arguments:** `load`, N; `friction`: of `couple_friction`, N."""
        pressing = load
        for k, arm in enumerate(touch.arms):
            if arm.turned is not None:
                pressing = pressing.at[k].multiply(arm.share)
        axial, radial, moment = self.with_friction(pressing, touch.direction, friction)
        forces = []
        for k, arm in enumerate(touch.arms):
            sideways = () if arm.along is None else (load[k] * arm.along / arm.length,)
            forces.append(jnp.stack([axial[k], radial[k], *sideways]))
        (pushed, held), (raised, lowered) = self.arcs.by_race(axial), self.arcs.by_race(radial)
        on_ring = touch.on_ring(tuple(forces), moment)
        on_ring = self.on_both(on_ring, lowered, raised)
        return Push(held - pushed, lowered - raised, on_ring)

    def _to_first_order(self, forces: tuple[Array, ...], moment: Array) -> Array:
        if not self.freedoms:
            return jnp.zeros((0, self.azimuth.shape[0]))
        force = self._on_coordinates(forces)
        rows = []
        for direction, name in zip(self.directions, self.freedoms, strict=True):
            row = jnp.sum(force * direction, axis=0)
            if name in TILTS:
                # the tilt turns the axial direction of the groove's centre
                row = row + moment * direction[0] / self.grooves.lever
            rows.append(self.multiplicity * row)
        return jnp.stack(rows)

    def _on_coordinates(self, forces: tuple[Array, ...]) -> Float[Array, "p ball"]:
        """Forces on the coordinates of the inner groove, N, from those on its arcs, axial and outward."""
        if self.arcs.inner is None:
            return forces[0]
        turning = added([-side * force[1] for side, force in zip(self.arcs.inner_sides, forces, strict=True)])
        return jnp.concatenate([added(forces), turning[None]])

    def shared_fields(self) -> dict[str, Any]:
        """Arguments of another system of the same balls."""
        return {name: getattr(self, name) for name in AbstractBallSystem.__dataclass_fields__}
