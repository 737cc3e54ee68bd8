r"""Base of the equations of ball bearings with and without films: grooves, ring, centrifugal force, gyroscopic couple.

Terms. The *half-plane* of a ball ends at the bearing axis and contains the centre of the ball; *outward* is the radial
direction in it. A groove has one circular *arc* in the half-plane, or two, which lie at equal distances e from the
middle plane of the ring (module `arcs`). The *coordinates of the inner groove* at a ball are the axial and the outward
place of the centre of its arc, or of the middle between the centres of its two arcs, from that of the outer groove, m.
With two arcs there is a third one, $e\tau$, m, with the rotation $\tau$ of the groove in the half-plane, positive where
it moves the arc at +e inwards. The dimension p of arrays counts these two or three coordinates, or the *shared*
unknowns: those that all balls have in common, as each ball sees them (displacements of the ring first, then deflections
of flexible rings). The grooves of an *exact* system move with the exact rotation of the ring (module `groove_motion`),
otherwise with its first-order displacement. The *attitude* of a ball is the angle of its spin axis from the bearing
axis, in the half-plane; `Attitude` names the hypothesis that gives it.
"""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeAlias

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...numerics.safe import safe_norm
from ..elastic_ring import ElasticRing
from ..ring import LENGTH_UNIT, TILTS, InnerRing
from ..rings import AbstractBetweenRings
from .arcs import Arcs, added
from .groove_motion import RingMotion, conjugate_loads, inner_arm, length_of
from .gyroscopic import NO_LOAD, AbstractGyroscopic
from .kinematics import BallKinematics, BallMotion

Attitude = Literal["outer", "inner", "linear_slip", "min_power", "equilibrium"]
"""Rule that gives the attitude angle of the balls, the direction of their spin axis."""
_OUTWARD = np.asarray([[0.0], [1.0]])


class Grooves(NamedTuple):
    """Geometry and stiffness of the grooves.

    - `offset`: distance of the (inner, outer) groove centre from the centre of a ball that touches the groove without
      load, m; `stiffness`: contact stiffness (inner, outer), N/m^(3/2).
    - `centre_distance`: distance between the inner and the outer groove centre at first contact, m; `free_cosine`,
      `free_sine`: cosine and sine of `free_angle`.
    """

    offset: Float[Array, "2"]
    stiffness: Float[Array, "2"]
    centre_distance: Float[Array, ""]
    free_cosine: Float[Array, ""]
    free_sine: Float[Array, ""]
    aligned: Float[Array, ""]
    """Axial displacement of the ring at which the planes of the grooves coincide, m: 0, or less than 0 where
    displacements count from first contact."""
    lever: Float[Array, ""]
    """Radius R_i of the circle of inner groove centres, m; half the pitch diameter if the tilt is that of the standard
    (`Rating.tilt`)."""
    groove_arm: Float[Array, ""]
    """Radius f_i D of the inner groove, m: arm of the friction at the inner race about the circle of groove centres."""

    expansion: Float[Array, ""] | None = None
    """Expansion of the radius of the inner raceway minus that of the outer raceway, m (see `InnerRing.expansion`)."""
    arcs: Arcs = Arcs()

    @property
    def free_angle(self) -> Float[Array, ""]:
        """Contact angle at first contact without `expansion`, rad. It may differ from the angle of `free_normal`, which
        belongs to the ring without displacement."""
        return jnp.arctan2(self.free_sine, self.free_cosine)

    @property
    def free_normal(self) -> Float[Array, "2 1"]:
        """Direction (axial, radial) from the outer to the inner groove centre of the ring without displacement."""
        return self.rest / safe_norm(self.rest[0], self.rest[1])[None]

    @property
    def rest(self) -> Float[Array, "2 1"]:
        """Vector (axial, radial) from the outer to the inner groove centre of the ring without displacement, m."""
        radial = self.centre_distance * self.free_cosine
        radial = radial if self.expansion is None else radial + self.expansion
        return jnp.stack([-self.aligned, radial])[:, None]

    @property
    def of_ring(self) -> Float[Array, "p 1"]:
        """Coordinates of the inner groove of the ring without displacement, m."""
        return self.rest if self.arcs.inner is None else jnp.concatenate([self.rest, jnp.zeros((1, 1))])

    @property
    def turning(self) -> Array | None:
        """Distance of the inner arcs from the middle plane over R_i; `None` if the inner ring has one arc."""
        return None if self.arcs.inner is None else self.arcs.inner / self.lever


class InnerArm(NamedTuple):
    """Vectors from the ball centres to the nearest inner groove centres, m.

    Components in the half-plane of the ball (axial, outward) and, in an `exact` system, along the orbit; and the
    distance. `turned` is the rotation of the groove by the tilt (`RingFrame.turned`), `None` if the grooves move to
    first order."""

    vector: Float[Array, "component ball"]
    length: Float[Array, " ball"]
    turned: Float[Array, " ball"] | None

    @property
    def in_plane(self) -> Float[Array, "2 ball"]:
        return self.vector[:2]

    @property
    def along(self) -> Float[Array, " ball"] | None:
        """Component of the vector along the orbit, m; `None` if the grooves move to first order."""
        return None if self.turned is None else self.vector[2]

    @property
    def share(self) -> Float[Array, " ball"]:
        """Length of the component in the half-plane over the total length of the vector."""
        return length_of(self.in_plane) / self.length


OnRing: TypeAlias = Callable[
    [tuple[Float[Array, "component ball"], ...], Float[Array, " ball"] | None], Float[Array, "freedom ball"]
]
"""Contributions of every ball to the forces that hold the ring's degrees of freedom, N (moments are divided by R_i).
They follow from the forces of the ring on the ball at each of its arcs, axial, outward and, in an `exact` system,
along the orbit, N, and from the moment of friction in the half-plane, N m (`None`: no friction)."""


class Touch(NamedTuple):
    """Contacts of the balls for given places of their centres, before any load is known.

    - `apart`: distances of the groove centres from the ball centre, m; `normals`: unit vectors along them, from the
      ball centre to the inner groove centre, and from the outer groove centre to the ball centre: axial, outward and,
      of an inner arm of an `exact` system, along the orbit. Both point away from the axis of the bearing.
    - `direction`: angle of each normal from the outward radius towards $+e_x$, in the fixed frame, rad; `angle`:
      contact angles, rad: `direction`, less the rotation of the ring by its tilt on the inner race of an `exact`
      system.
    - `on_ring`: function from the forces on the arcs to those on the ring, as returned by `AbstractBallSystem.reach`.
    """

    apart: Float[Array, "contact ball"]
    normals: tuple[Float[Array, "component ball"], ...]
    direction: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    on_ring: OnRing


class Push(NamedTuple):
    """Forces of the contacts, N.

    - `net`: forces of each ball on the outer ring minus those of the inner ring on the ball, axial and outward.
    - `on_ring`: contributions to the forces that hold the rings: the degrees of freedom of the inner one, and the
      radial forces on flexible rings (`AbstractBetweenRings`).
    """

    net: Float[Array, "2 ball"]
    on_ring: Float[Array, "row ball"]

    def balance(self, outward: Float[Array, " ball"]) -> Float[Array, "2 ball"]:
        """Left side minus right side of the balances of forces on the balls, N. **Arguments:** `outward`: sum of all
        other forces on a ball, which act outward, N."""
        return self.net - outward[None] * _OUTWARD


def unit_normals(direction: Float[Array, "contact ball"]) -> Float[Array, "2 contact ball"]:
    """Axial and outward components of the normals in the half-planes. **Arguments:** `direction`: angle from
    the outward radius towards $+e_x$, rad."""
    return jnp.stack([jnp.sin(direction), jnp.cos(direction)])


class AbstractBallSystem(AbstractBetweenRings):
    """Balls between two grooved rings.

    Ball centres count from the centre of the outer groove at the azimuth of the ball. This centre moves outwards by the
    deflection of the outer ring there, and the inner groove by that of the inner ring.

    - `directions[f]`: changes of the coordinates of the inner groove (see the module) at every ball per metre of
      freedom f, to first order; a tilt counts as its angle times R_i, the lever of the `ring`.
    - `held_shift`: changes of these coordinates by the given displacements of the ring, m, to first order; an `exact`
      system has them in `ring_motion`.
    - `ring_motion`: the motion of the ring as the balls see it, of grooves that move with its exact rotation
      (`groove_motion`); `None`: to first order.
    - `out_of_round`: displacement towards each ball of races that are not round, m; `outer`, `inner`: the rings if they
      bend; `None` where they are round and rigid.
    """

    kinematics: BallKinematics
    grooves: Grooves
    directions: Float[Array, "freedom p ball"]
    azimuth: Float[Array, " ball"]
    ring: InnerRing
    held_shift: Float[Array, "p ball"]
    ring_motion: RingMotion | None
    mass: Float[Array, ""]
    inertia: Float[Array, ""]
    gyroscopic: AbstractGyroscopic | None
    couple_share: Float[Array, ""]
    """Factor on the gyroscopic couple: 1, or less in the easier systems of a homotopy."""
    out_of_round: Float[Array, " ball"] | None
    outer: ElasticRing | None
    inner: ElasticRing | None
    multiplicity: int = eqx.field(static=True)
    """Number of balls of the bearing that each ball of the equations stands for, by symmetry."""
    attitude: Attitude = eqx.field(static=True)

    @property
    def exact(self) -> bool:
        """True if the grooves move with the exact rotation of the ring."""
        return self.ring_motion is not None

    @property
    def ball_count(self) -> int:
        return self.multiplicity * self.azimuth.shape[0]

    @property
    def arcs(self) -> Arcs:
        return self.grooves.arcs

    def free_centre(self) -> Float[Array, "2 1"]:
        """Centre of an unloaded ball, from the outer groove centre, m. It lies on the line between the groove centres
        of the ring without displacement."""
        return self.grooves.offset[1] * self.grooves.free_normal

    def groove_centres(self, shift: Float[Array, "freedom ball"]) -> Float[Array, "p ball"]:
        """Coordinates of the inner groove at every ball (`arcs`; axial and radial from the centre of the outer one), m,
        for displacements of the ring in units of `LENGTH_UNIT`; to first order."""
        moved = LENGTH_UNIT * jnp.einsum("fn,fcn->cn", shift, self.directions)
        return self.grooves.of_ring + moved + self.held_shift

    def from_round(self, centre: Float[Array, "2 ball"], shared: Float[Array, "p ball"]) -> Float[Array, "2 ball"]:
        """Equivalent ball centres (axial, radial) between round and rigid rings, m, from the outer groove centre: the
        radial component is corrected for the deflections of flexible rings and for races that are not round."""
        # `opened` gives the radial widening of the gap between the races at each ball
        for opening in self.opened(shared).values():
            centre = jnp.stack([centre[0], centre[1] + opening])
        if self.out_of_round is not None:
            centre = jnp.stack([centre[0], centre[1] - self.out_of_round])
        return centre

    def inner_arms(
        self, shift: Float[Array, "freedom ball"], centre: Float[Array, "2 ball"]
    ) -> tuple[tuple[InnerArm, ...], OnRing]:
        r"""Vectors from the ball centres to the nearest centre of each inner arc, and the function `OnRing` from the
        forces on these arcs to those on the degrees of freedom of the ring.

        The forces on the degrees of freedom are conjugate to the displacements: they follow from the work of the forces
        at the nearest groove centre and of the friction moment on the rotation of the groove. To second order, a force
        $(F_x, F_r)$ on the groove centre gives the moment $R_i(F_x\cos t\cos\psi - F_r\sin t\cos^2\psi)$ on a tilt t
        that moves azimuth 0 along the axis.

        **Arguments:** `shift`: displacements of the ring in units of `LENGTH_UNIT`; `centre`: ball centres as returned
        by `from_round`, m.
        """
        if self.ring_motion is None:
            arms = [groove - centre for groove in self.arcs.inner_centres(self.groove_centres(shift))]
            return tuple(InnerArm(arm, safe_norm(arm[0], arm[1]), None) for arm in arms), self._to_first_order
        grooves, motion = self.grooves, self.ring_motion
        frame = motion.frame(shift)
        place = centre - grooves.rest
        offsets = [0.0 if self.arcs.inner is None else side * self.arcs.inner for side in self.arcs.inner_sides]
        inner = [inner_arm(frame, place, grooves.lever, offset) for offset in offsets]

        def on_ring(forces: tuple[Array, ...], moment: Array | None) -> Array:
            return self.multiplicity * motion.on_freedoms(conjugate_loads(frame, inner, forces, moment))

        return tuple(InnerArm(arm.vector, length_of(arm.vector), frame.turned) for arm in inner), on_ring

    def centrifugal(self, orbital_speed: Array) -> Array:
        """Centrifugal force of balls on the pitch circle, N."""
        return 0.5 * self.mass * self.kinematics.pitch_diameter * jnp.square(orbital_speed)

    def couple(self, motion: BallMotion) -> Array:
        """Gyroscopic couple on each ball, N m (source eq. (13)), times `couple_share`."""
        spin = motion.spin_speed * motion.orbital_speed * jnp.sin(motion.attitude)
        return self.couple_share * self.inertia * spin

    def forces(
        self,
        load: Float[Array, "contact ball"],
        normal: Float[Array, "2 contact ball"],
        friction: Float[Array, "contact ball"] | None,
    ) -> tuple[Float[Array, "2 contact ball"], Float[Array, " ball"] | None]:
        """Axial and outward forces of normal loads and of the friction that carries the couple, N, and the moment that
        holds the inner ring against it (`couple_forces`; `None` without friction). **Arguments:** `normal`: of
        `unit_normals`."""
        pressed = load[None] * normal
        if friction is None:
            return pressed, None
        dragged, moment = self.couple_forces(normal, friction)
        return pressed + dragged, moment

    def couple_forces(
        self, normal: Float[Array, "2 contact ball"], friction: Float[Array, "contact ball"]
    ) -> tuple[Float[Array, "2 contact ball"], Float[Array, " ball"]]:
        """Axial and outward forces of the friction that carries the couple, N, and the moment about the groove
        centres that holds the inner ring against it, N m. **Arguments:** `normal`: of `unit_normals`."""
        moment = -self.arcs.on_inner(friction) * self.grooves.groove_arm
        return friction[None] * jnp.stack([normal[1], -normal[0]]), moment

    def couple_friction(
        self, motion: BallMotion, load: Float[Array, "contact ball"]
    ) -> Float[Array, "contact ball"] | None:
        """Friction forces of the contacts that carry the gyroscopic couple, with their sign, N; `None` without a law
        for them. The two contacts on a ring with two arcs share the friction in proportion to their loads."""
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
        """The result of `inner_arms` for ball centres relative to the outer groove centre.

        **Arguments:** `shared`: the unknowns that all balls share, as each ball sees them; those of the ring come
        first; `centre`: ball centres (axial, radial), m.
        """
        return self.inner_arms(shared[: len(self.freedoms)], self.from_round(centre, shared))

    def touch(self, shared: Float[Array, "p ball"], centre: Float[Array, "2 ball"]) -> Touch:
        """The contacts of the balls for given ball centres.

        **Arguments:** `shared`: as in `reach`; `centre`: ball centres (axial, radial) from the outer groove centre or
        the point midway between the outer arc centres, m."""
        arms, on_ring = self.reach(shared, centre)
        rests = self.arcs.from_outer(centre)
        lengths = [*(arm.length for arm in arms), *(safe_norm(rest[0], rest[1]) for rest in rests)]
        leaning = [*(arm.vector for arm in arms), *rests]
        axial, outward = jnp.stack([vector[:2] for vector in leaning], axis=1)
        direction = angle = jnp.arctan2(axial, outward)
        if arms[0].turned is not None:
            # senses are 1 at inner arcs and -1 at outer ones: only the inner race turns with the ring
            angle = direction - arms[0].turned[None] * np.maximum(self.arcs.senses, 0.0)
        normals = tuple(vector / length[None] for vector, length in zip(leaning, lengths, strict=True))
        return Touch(jnp.stack(lengths), normals, direction, angle, on_ring)

    def push(
        self, touch: Touch, load: Float[Array, "contact ball"], friction: Float[Array, "contact ball"] | None
    ) -> Push:
        """The forces of all contacts. **Arguments:** `touch`: see `touch`; `load`: contact loads, N; `friction`: see
        `couple_friction`, N."""
        forces, moment = [load[k][None] * normal for k, normal in enumerate(touch.normals)], None
        if friction is not None:
            dragged, moment = self.couple_forces(unit_normals(touch.direction), friction)
            forces = [force.at[:2].add(dragged[:, k]) for k, force in enumerate(forces)]
        first_outer = self.arcs.first_outer
        inner, outer = added(forces[:first_outer])[:2], added(forces[first_outer:])
        on_ring = touch.on_ring(tuple(forces[:first_outer]), moment)
        on_ring = self.on_both(on_ring, outer[1], inner[1])
        return Push(outer - inner, on_ring)

    def _to_first_order(self, forces: tuple[Array, ...], moment: Array | None) -> Array:
        if not self.freedoms:
            return jnp.zeros((0, self.azimuth.shape[0]))
        force = self._on_coordinates(forces)
        rows = []
        for direction, name in zip(self.directions, self.freedoms, strict=True):
            row = jnp.sum(force * direction, axis=0)
            if name in TILTS and moment is not None:
                # a tilt also rotates the groove, by the axial displacement of the groove over R_i
                row = row + moment * direction[0] / self.grooves.lever
            rows.append(self.multiplicity * row)
        return jnp.stack(rows)

    def _on_coordinates(self, forces: tuple[Array, ...]) -> Float[Array, "p ball"]:
        """Forces on the coordinates of the inner groove, N, from the axial and outward forces on its arcs, N."""
        if self.arcs.inner is None:
            return forces[0]
        turning = added([-side * force[1] for side, force in zip(self.arcs.inner_sides, forces, strict=True)])
        return jnp.concatenate([added(forces), turning[None]])

    def shared_fields(self) -> dict[str, Any]:
        """Fields of this base class, as arguments for another system of equations of the same balls."""
        return {name: getattr(self, name) for name in AbstractBallSystem.__dataclass_fields__}
