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

from .._types import Values
from ..numerics.safe import safe_norm

TILT_FLOOR = 1e-9
"""Added to the tilt in squares, rad: its direction then has a slope at 0, and its sine and cosine are exact to 1e-17."""



class InnerArm(NamedTuple):
    """From ball centres to the nearest inner groove centres: components along the bearing axis, outward and along the
    orbit, m."""

    axial: Float[Array, "..."]
    radial: Float[Array, "..."]
    along: Float[Array, "..."]

    @property
    def in_plane(self) -> Float[Array, "..."]:
        """Length of the part in the half-plane of the ball, m."""
        return safe_norm(self.axial, self.radial)

    @property
    def length(self) -> Float[Array, "..."]:
        """Distance of the ball centre from the circle of groove centres, m."""
        return safe_norm(self.in_plane, self.along)


def ring_axis(tilt: tuple[Values, Values], azimuth: Values) -> tuple[Array, Array, Array]:
    """Direction n' of the tilted axis, seen from each ball: components along the bearing axis, outward, along the
    orbit. **Arguments:** as in `inner_arm`."""
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    size = safe_norm(*tilt, TILT_FLOOR)
    part = jnp.sin(size) / size
    outward = -part * (tilt[0] * cosine + tilt[1] * sine)
    return jnp.cos(size), outward, -part * (tilt[1] * cosine - tilt[0] * sine)


def turned_angle(axis: tuple[Array, Array, Array]) -> Float[Array, "..."]:
    """Angle by which the inner groove turns in the half-plane of each ball, rad.

    The contact angle on the tilted race is that in the fixed frame minus this one; where the ring is displaced by
    $d_t$ along the orbit, within $t\\,d_t/R_i$, below 1e-5 rad. **Arguments:** `axis`: of `ring_axis`.
    """
    return jnp.arctan2(-axis[1], axis[0])


def inner_arm(
    shift: tuple[Values, Values, Values],
    axis: tuple[Array, Array, Array],
    azimuth: Values,
    centre: tuple[Values, Values],
    lever: Values,
    side: Values = 0.0,
) -> InnerArm:
    r"""The arms from ball centres to the inner grooves of a displaced and tilted ring; exact.

    **Arguments:**
    - `shift`: $\delta_a, \delta_r, \delta_l$ of the centre of the circle of groove centres from the plane and axis in
      which ball centres are counted, m.
    - `axis`: of `ring_axis`, for the tilt $\theta_1, \theta_2$, rad; positive values move azimuth 0 and 90 degrees
      along $+e_x$.
    - `azimuth`: $\psi$ of the balls, rad.
    - `centre`: of the balls along the axis, and distance from the axis, m.
    - `lever`: $R_i$, m.
    - `side`: distance of the circle along $n'$ from the centre that `shift` moves, m: of the arcs of a ring that has
      two.
    """
    cosine, sine = jnp.cos(azimuth), jnp.sin(azimuth)
    # the ball from the displaced centre
    ball = (
        centre[0] - shift[0],
        centre[1] - (shift[1] * cosine + shift[2] * sine),
        shift[1] * sine - shift[2] * cosine,
    )
    height = ball[0] * axis[0] + ball[1] * axis[1] + ball[2] * axis[2]
    flat = [p - height * n for p, n in zip(ball, axis, strict=True)]
    radius = safe_norm(safe_norm(flat[0], flat[1]), flat[2])
    reach, lift = (lever - radius) / radius, side - height
    return InnerArm(*(lift * n + reach * u for n, u in zip(axis, flat, strict=True)))
