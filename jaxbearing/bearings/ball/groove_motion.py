r"""Exact motion of the inner grooves of a ball bearing: from ball centres to the displaced and tilted inner ring.

Frames. $e_x$ along the bearing axis, Y along azimuth 0, Z along azimuth 90 degrees. The centre of the circle of inner
groove centres, of radius $R_i$, moves by $d = \delta_ae_x + \delta_rY + \delta_lZ$; the ring turns by the rotation
vector $\theta_2Y - \theta_1Z$ of length t, and its axis becomes
$n' = \cos t\,e_x - \frac{\sin t}{t}(\theta_1Y + \theta_2Z)$. A ball at azimuth $\psi$ has its centre at B. With
$p = B - d$, $h = p\cdot n'$, $u = p - hn'$ and $\rho = |u|$ the nearest point of the circle is
$G = d + R_iu/\rho$, and the arm from the ball to it is $G - B = -hn' + (R_i - \rho)u/\rho$.

The first-order form, in which the groove centre moves by $R_i\tau$ along the axis, $\tau = \theta_1\cos\psi +
\theta_2\sin\psi$, leaves out the motion $R_i(1 - \cos t)\cos^2\psi$ towards the axis: 0.4 um at 6.5 mrad and
$R_i$ = 19 mm, which is of the order of the deformation. Where the ring cannot tilt (neither a moment nor a misalignment
in the scene) the first-order form is used: what it leaves out is then $d_t^2/(2R_i)$ with the displacement $d_t$ of the
ring along the orbit, 1 nm in the bearing of table 15 at 20 kN axial and 8 kN radial load, 6e-5 of a ball's load.
"""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Values
from ...numerics.safe import NORM_FLOOR, safe_norm

TILT_FLOOR = 1e-9
"""Added to the tilt in squares, rad: its direction then has a slope at 0, and sine and cosine are exact to 1e-17."""


class RingFrame(NamedTuple):
    """The displaced inner ring, seen from every ball: components along the bearing axis, outward and along the orbit.

    `shift`: of the centre of the circle of groove centres, m; `axis`: direction n' of the tilted axis.
    """

    shift: Float[Array, "3 ball"]
    axis: Float[Array, "3 ball"]

    @property
    def turned(self) -> Float[Array, " ball"]:
        """Angle by which the inner groove turns in the half-plane of each ball, rad.

        The contact angle on the tilted race is that in the fixed frame minus this one; where the ring is displaced by
        $d_t$ along the orbit, within $t\\,d_t/R_i$, below 1e-5 rad.
        """
        return jnp.arctan2(-self.axis[1], self.axis[0])


def length_of(vector: Float[Array, "component ball"]) -> Float[Array, " ball"]:
    """Length over the first axis, with gradient 0 at the origin."""
    return jnp.sqrt(jnp.sum(jnp.square(vector), axis=0) + NORM_FLOOR**2)


def ring_frame(ring: Float[Array, "5 ball"], azimuth: Float[Array, " ball"]) -> RingFrame:
    r"""The ring from its displacements.

    **Arguments:** `ring`: $\delta_a, \delta_r, \delta_l$, m, and $\theta_1, \theta_2$, rad, which move azimuth 0 and
    90 degrees along $+e_x$; `azimuth`: $\psi$ of the balls, rad.
    """
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    outward, along = jnp.stack([cosine, sine]), jnp.stack([-sine, cosine])
    # of (radial, lateral) and of the two tilts
    planes = jnp.stack([outward, along])
    shift = jnp.concatenate([ring[:1], jnp.sum(planes * ring[None, 1:3], axis=1)])
    size = safe_norm(ring[3], ring[4], TILT_FLOOR)
    side = -(jnp.sin(size) / size)[None] * jnp.sum(planes * ring[None, 3:], axis=1)
    return RingFrame(shift, jnp.concatenate([jnp.cos(size)[None], side]))


def inner_arm(
    frame: RingFrame, centre: Float[Array, "2 ball"], lever: Values, side: Values = 0.0
) -> Float[Array, "3 ball"]:
    r"""The arms from ball centres to the nearest inner groove centres of a displaced and tilted ring, m: components
    along the bearing axis, outward and along the orbit; exact.

    **Arguments:**
    - `centre`: of the balls along the axis, from the plane in which the ring's axial displacement counts, and distance
      from the axis less $R_i$, m: small numbers, and nothing here subtracts large ones.
    - `lever`: $R_i$, m.
    - `side`: distance of the circle along $n'$ from the centre that moves by `frame.shift`, m: of the arcs of a ring
      that has two.
    """
    # R_i e_r is taken out of p and of u, and R_i - rho is (R_i^2 - rho^2)/(R_i + rho)
    ball = jnp.concatenate([centre, jnp.zeros_like(centre[:1])]) - frame.shift
    height = (jnp.sum(ball * frame.axis, axis=0) + lever * frame.axis[1])[None]
    flat = ball - height * frame.axis
    inward = -(2.0 * lever * flat[1] + jnp.sum(jnp.square(flat), axis=0))
    flat = flat.at[1].add(lever)
    radius = length_of(flat)
    return (side - height) * frame.axis + (inward / ((lever + radius) * radius))[None] * flat
