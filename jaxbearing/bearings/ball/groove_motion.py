r"""Exact motion of the inner grooves of a ball bearing: from ball centres to the displaced and tilted inner ring.

Frames. $e_x$ points along the bearing axis, Y to azimuth 0 and Z to azimuth 90 degrees; positions count from the centre
of the ring without displacement. The *half-plane* of a ball ends at the bearing axis and contains the centre of the
ball; *outward* is the radial direction in it, *along the orbit* the direction normal to it, of growing azimuth. The
ring has the axial, radial and lateral displacement $\delta_a, \delta_r, \delta_l$ and the tilts $\theta_1, \theta_2$,
which move it along $+e_x$ at azimuth 0 and at azimuth 90 degrees. It has a circle of groove centres of radius $R_i$
around its axis, in a plane at the distance s from the centre of the ring, along the axis: 0 if the ring has one groove
arc. The centre moves by $d = \delta_ae_x + \delta_rY + \delta_lZ$; the ring turns by the rotation vector
$\theta_2Y - \theta_1Z$ of length t, and its axis becomes $n' = \cos t\,e_x - \frac{\sin t}{t}(\theta_1Y + \theta_2Z)$.
A ball at azimuth $\psi$ has its centre at B. With $p = B - d$, $h = p\cdot n'$, $u = p - hn'$, $\rho = |u|$ and
$k = R_i/\rho$, the nearest point of the circle is $G = d + sn' + ku$, and the arm from the ball to it is
$G - B = (s - kh)n' + (k - 1)p$.

The first-order form, in which the groove centre moves by $R_i\tau$ along the axis, $\tau = \theta_1\cos\psi +
\theta_2\sin\psi$, leaves out the motion $R_i(1 - \cos t)\cos^2\psi$ towards the axis (of a tilt $\theta_1$): 0.4 um at
6.5 mrad and $R_i$ = 19 mm, which is of the order of the deformation. The first-order form is used where the scene has
neither a moment nor a misalignment, where the user chooses it (`tilt="linear"` of `reaction`; `rating.tilt = "iso"`,
which also takes half the pitch diameter for $R_i$, in motion and moment, as ISO 16281 does), in transient runs and on
shafts. Without a tilt it leaves out $d_t^2/(2R_i)$ with the displacement $d_t$ of the ring along the orbit: 1 nm in the
bearing `turbine_ball` at 20 kN axial and 8 kN radial load, which changes the load of a ball by 6e-5 of its value.

Loads on the ring. F is the force of the ring on the ball. The load that balances the reaction of the ball on the ring
is also F, and acts at the nearest point of the circle. With $W = [F\cdot p - h\,F\cdot n']/\rho^2$ and
$c = k(F\cdot n' - Wh)$, a force F on the nearest point of the circle does, with the ball in its place, the work
$F\cdot\delta(G - B) = P_d\cdot\delta d + P_n\cdot\delta n'$, where $P_d = cn' + kWp - (k - 1)F$ and
$P_n = (s - kh)F - cp$ are the derivatives of $F\cdot(G - B)$ by d and n'. These derivatives are written out as
formulas, because differentiating the formulas takes 0.6 of the operations of differentiating a reverse pass.
"""

from collections.abc import Sequence
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._types import Values
from ...numerics.safe import NORM_FLOOR
from ..ring import LENGTH_UNIT, InnerRing
from .arcs import added

TILT_FLOOR = 1e-9
"""Floor of the tilt, rad, added as a square, so that sin(t)/t has a first derivative at t = 0. It changes values by
less than 1e-17. Second derivatives of sin(t)/t are inaccurate near this tilt; those of the loads of a bearing are right
to 1e-4 there, because the stiffness of the contacts dominates them."""

_OUTWARD = np.asarray([[0.0], [1.0], [0.0]])
# `half_planes` is a sum of three matrices: one that keeps the axial component, one times the cosine of the azimuth and
# one times its sine, which turn (radial, lateral) and both tilts
_AXIAL = np.diag([1.0, 0.0, 0.0, 0.0, 0.0])
_IN_PLANE = np.diag([0.0, 1.0, 1.0, 1.0, 1.0])
_ACROSS = np.zeros((5, 5))
_ACROSS[[1, 3], [2, 4]], _ACROSS[[2, 4], [1, 3]] = 1.0, -1.0


def half_planes(azimuth: Float[Array, " ball"]) -> Float[Array, "5 5 ball"]:
    r"""Matrices that turn the five displacements of a ring into the half-plane of each ball.

    They take $\delta_a, \delta_r, \delta_l$ (m) and $\theta_1, \theta_2$ (rad), which move azimuth 0 and 90 degrees
    along $+e_x$, to the displacements along the axis, outward and along the orbit, and the tilts in the half-plane and
    across it.

    **Arguments:** `azimuth`: $\psi$ of the balls, rad.
    """
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    turned = _IN_PLANE[:, :, None] * cosine[None, None] + _ACROSS[:, :, None] * sine[None, None]
    return jnp.asarray(_AXIAL[:, :, None] + turned)


class RingFrame(NamedTuple):
    """The displaced inner ring, seen from every ball: components along the bearing axis, outward and along the orbit.

    - `displacement`: d, of the centre of the ring, m; `axis`: direction n' of the tilted axis of the ring.
    - `tilt`: tilts in the half-plane of the ball and across it, rad; `square`: t^2; `mean`: sin(t)/t.
    """

    displacement: Float[Array, "3 ball"]
    axis: Float[Array, "3 ball"]
    tilt: Float[Array, "2 ball"]
    square: Float[Array, " ball"]
    mean: Float[Array, " ball"]

    @property
    def turned(self) -> Float[Array, " ball"]:
        """Angle by which the inner groove turns in the half-plane of each ball, rad.

        The contact angle on the tilted race is that in the fixed frame minus this angle. If the ring is displaced by
        $d_t$ along the orbit, the error is at most $t\\,d_t/R_i$, below 1e-5 rad.
        """
        return jnp.arctan2(-self.axis[1], self.axis[0])

    def on_turned(self, moment: Float[Array, " ball"]) -> Float[Array, "3 ball"]:
        """Part of $P_n$, N m, that comes from a moment on the angle `turned`, N m."""
        square = jnp.square(self.axis[0]) + jnp.square(self.axis[1])
        return (moment / square)[None] * jnp.stack([self.axis[1], -self.axis[0], jnp.zeros_like(moment)])

    def on_tilt(self, on_axis: Float[Array, "3 ball"]) -> Float[Array, "2 ball"]:
        r"""Moments on the tilts, N m, from $P_n$: $n'$ is $\cos t$ along the axis and
        $-\frac{\sin t}{t}(\tau_1, \tau_2)$ across it, with the tilts in the half-plane and across it."""
        along, across = on_axis[0], on_axis[1:]
        bend = (self.axis[0] - self.mean) / self.square
        both = self.mean * along + bend * jnp.sum(across * self.tilt, axis=0)
        return -(both[None] * self.tilt + self.mean[None] * across)


def length_of(vector: Float[Array, "component ball"]) -> Float[Array, " ball"]:
    """Length of every vector; its gradient at the origin is 0."""
    return jnp.sqrt(jnp.sum(jnp.square(vector), axis=0) + NORM_FLOOR**2)


def ring_frame(displaced: Float[Array, "5 ball"]) -> RingFrame:
    """The displaced ring, from its displacements in the half-plane of every ball (`half_planes`), m and rad."""
    tilt = displaced[3:]
    square = jnp.sum(jnp.square(tilt), axis=0) + TILT_FLOOR**2
    size = jnp.sqrt(square)
    mean = jnp.sin(size) / size
    axis = jnp.concatenate([jnp.cos(size)[None], -mean[None] * tilt])
    return RingFrame(displaced[:3], axis, tilt, square, mean)


class GrooveArm(NamedTuple):
    """The arm from every ball centre to the nearest point of a circle of groove centres; symbols as in the module.

    - `vector`: the arm, m: components along the bearing axis, outward and along the orbit.
    - `place`: p, vector from the displaced centre of the ring to the ball, m; `height`: h, m; `lift`: s - kh, m.
    - `excess`: k - 1; `square`: $\\rho^2$, m^2.
    """

    vector: Float[Array, "3 ball"]
    place: Float[Array, "3 ball"]
    height: Float[Array, " ball"]
    lift: Float[Array, " ball"]
    excess: Float[Array, " ball"]
    square: Float[Array, " ball"]

    def conjugate(
        self, axis: Float[Array, "3 ball"], force: Float[Array, "3 ball"]
    ) -> tuple[Float[Array, "3 ball"], Float[Array, "3 ball"]]:
        """$P_d$, N, and $P_n$, N m, of a `force` F on the circle, N (see the module). **Arguments:** `axis`: n'."""
        along, ratio = jnp.sum(force * axis, axis=0), 1.0 + self.excess
        weight = (jnp.sum(force * self.place, axis=0) - self.height * along) / self.square
        both = ratio * (along - weight * self.height)
        on_centre = both[None] * axis + (ratio * weight)[None] * self.place - self.excess[None] * force
        return on_centre, self.lift[None] * force - both[None] * self.place


def inner_arm(frame: RingFrame, centre: Float[Array, "2 ball"], lever: Values, side: Values = 0.0) -> GrooveArm:
    r"""The exact arms from the ball centres to the nearest inner groove centres of a displaced and tilted ring.

    **Arguments:**
    - `centre`: ball centres, m: axial position from the middle plane of the ring without displacement, and distance
      from the axis minus $R_i$. Both are small, so that no digits are lost.
    - `lever`: $R_i$, m.
    - `side`: s, distance of the circle from the centre of the ring along its axis, m.
    """
    # p less R_i outward is small; R_i^2 - rho^2 = h^2 - (p^2 - R_i^2)
    near = jnp.concatenate([centre, jnp.zeros_like(centre[:1])]) - frame.displacement
    outward = lever * _OUTWARD
    place = near + outward
    height = jnp.sum(place * frame.axis, axis=0)
    inward = jnp.square(height) - jnp.sum(near * (place + outward), axis=0)
    square = jnp.square(lever) - inward
    radius = jnp.sqrt(square)
    excess = inward / ((lever + radius) * radius)
    lift = side - (1.0 + excess) * height
    return GrooveArm(lift[None] * frame.axis + excess[None] * place, place, height, lift, excess, square)


def conjugate_loads(
    frame: RingFrame,
    arms: Sequence[GrooveArm],
    forces: Sequence[Float[Array, "3 ball"]],
    moment: Float[Array, " ball"] | None,
) -> Float[Array, "5 ball"]:
    """Loads on the five displacements in the half-planes, N and N m, that do the same work as the given forces on the
    circles and the given moment on the angle `turned`.

    **Arguments:** `forces`: force on the circle of each arm, N; `moment`: moment on `frame.turned`, N m; `None` without
    friction.
    """
    parts = [arm.conjugate(frame.axis, force) for arm, force in zip(arms, forces, strict=True)]
    on_centre, on_axis = added([centre for centre, _ in parts]), added([axis for _, axis in parts])
    if moment is not None:
        on_axis = on_axis + frame.on_turned(moment)
    return jnp.concatenate([on_centre, frame.on_tilt(on_axis)])


class RingMotion(NamedTuple):
    """Displacements of the inner ring in the half-plane of every ball (`half_planes`), m and rad.

    `held`: those caused by the prescribed displacements of the ring; `directions`: those per metre of each unknown
    freedom (all freedoms are lengths)."""

    held: Float[Array, "5 ball"]
    directions: Float[Array, "5 freedom ball"]

    def frame(self, shift: Float[Array, "freedom ball"]) -> RingFrame:
        """The displaced ring. **Arguments:** `shift`: displacements in units of `LENGTH_UNIT`."""
        return ring_frame(self.held + LENGTH_UNIT * jnp.sum(self.directions * shift[None], axis=1))

    def on_freedoms(self, loads: Float[Array, "5 ball"]) -> Float[Array, "freedom ball"]:
        """Contributions of every ball to the forces on the unknown degrees of freedom, N, from the loads of
        `conjugate_loads`."""
        return jnp.sum(self.directions * loads[:, None], axis=0)


def ring_motion(ring: InnerRing, azimuth: Float[Array, " ball"]) -> RingMotion:
    """The motion of a ring, seen from balls at these azimuths, rad."""
    planes, units = half_planes(azimuth), ring.units
    free = planes[:, ring.places] * ring.of_unknown(units)[None, :, None]
    return RingMotion(jnp.sum(planes * (ring.held * units)[None, :, None], axis=1), free)
