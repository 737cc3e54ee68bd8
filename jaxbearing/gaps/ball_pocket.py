"""Ball between the walls of its round cage pocket: balance of two rigid films."""

from typing import NamedTuple

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import safe_norm, smooth_abs
from ..numerics.structure import choice

SPIN_FLOOR = 1.0
"""Smoothing of |spin|, rad/s: keeps a film on a ball at rest and raises the load by 1.4e-8 at 6000 rad/s."""
CUT_FILMS = 20.0
"""Gap, over the central film, up to which the friction is integrated; up to the clearance if that is larger."""
SUPERPOSITIONS = ("root_of_squares", "sum")
"""Rules that add the loads of entrainment along and across the pocket's axis: exact, and as in the source."""


class BallPocketFilm(NamedTuple):
    """Films (m), loads (N) and friction forces (N) on the front and the rear side of the pocket.

    `friction` opposes the ball's spin about the bearing axis and has its sign: if positive, it acts on the ball inward
    in front and outward behind. `transverse` opposes the spin about the radial axis.
    """

    film_front: Batch
    film_rear: Batch
    load_front: Batch
    load_rear: Batch
    friction_front: Batch
    friction_rear: Batch
    transverse_front: Batch
    transverse_rear: Batch

    @property
    def friction(self) -> Batch:
        return self.friction_front + self.friction_rear

    @property
    def transverse(self) -> Batch:
        return self.transverse_front + self.transverse_rear


class BallPocket(Checked):
    r"""A ball floating in a cylindrical pocket with a radial axis, between two elliptical rigid isoviscous films.

    On each side $W = \sqrt{W_1^2 + W_2^2}$ with $W_i(h) = 6\sqrt2\,\pi\mu u_iR_i\sqrt{R_j/h}/(3 + 2R_i/R_j)$. $W_1$ is
    the load by entrainment along the pocket's axis ($R_1 = R_b$), $W_2$ that by entrainment across it ($R_2 = R_c =
    R_bR_p/(R_p - R_b)$). The root of the squares is exact: the pressures $(c_1x + c_2y)/h^2$ of both add up, and the
    film ruptures along the line where their sum is zero. With `superposition="sum"`, as in the source, each pressure
    ends at its own line, and the load is up to 41 % larger. The friction is $\mu uA$ with
    $A = 2\pi\sqrt{R_bR_c}\ln(h_{cut}/h)$, $h_{cut} = \max(20h, J_p)$. Both films fill the clearance, $H_1 + H_2 = J_p$.

    **Limits:** a film remains on a ball at rest (`SPIN_FLOOR`); its friction vanishes with the spin.
    **Validity:** rigid, isoviscous, half Sommerfeld films; light loads. The source superposes a long and a short
    bearing without giving their lengths; here the classical point-contact solutions replace them.
    **Reference:** Kapitza (1955), Zh. Tekh. Fiz. 25, 747; source, Table 1. `CompliantBallPocketFace` adds squeeze.

    **Arguments:**
    - `clearance`: J_p, DIAMETRAL: pocket diameter minus ball diameter, m, > 0.
    - `ball_radius`: m, > 0.
    - `superposition`: one of `SUPERPOSITIONS`; structure.
    """

    clearance: Scalar = bounded("> 0")
    ball_radius: Scalar = bounded("> 0")
    superposition: str = choice("superposition", SUPERPOSITIONS, "root_of_squares")

    def balance(self, net_load: Values, axial_spin: Values, radial_spin: Values, viscosity: Values) -> BallPocketFilm:
        r"""Films that carry a given net load, in closed form.

        With the load $W = B/\sqrt h$ of each film, $H_1 = J_p\sin^2\theta$, $H_2 = J_p\cos^2\theta$ and
        $k = P\sqrt{J_p}/B$: $\cos\theta - \sin\theta = d = k/(1 + \sqrt{1 + k^2})$.

        **Arguments:**
        - `net_load`: P = front load minus rear load, N, of either sign.
        - `axial_spin`, `radial_spin`: spin of the ball in the orbiting frame, rad/s: about the bearing axis, positive
          against the orbit; about the radial axis, positive outward.
        - `viscosity`, Pa s.
        """
        shape = 2.0 * self.ball_radius + self.clearance
        conforming = self.ball_radius * shape / self.clearance
        along = self.ball_radius * smooth_abs(axial_spin, SPIN_FLOOR)
        across = self.ball_radius * smooth_abs(radial_spin, SPIN_FLOOR)
        ratio = self.ball_radius / conforming
        factor = 6.0 * jnp.sqrt(2.0) * jnp.pi * viscosity
        first = along * self.ball_radius * jnp.sqrt(conforming) / (3.0 + 2.0 * ratio)
        second = across * conforming * jnp.sqrt(self.ball_radius) / (3.0 + 2.0 / ratio)
        strength = factor * (first + second if self.superposition == "sum" else safe_norm(first, second))
        k = net_load * jnp.sqrt(self.clearance) / strength
        root = jnp.sqrt(1.0 + jnp.square(k))
        d = k / (1.0 + root)
        rest = 2.0 / (1.0 + root)  # 1 - d^2
        # cos + sin = sqrt(1 + rest): the smaller of the two from their product, so that nothing cancels; `where` and
        # not `abs`, whose slope is 0 at k = 0, where the films depend on k
        both, forward = jnp.sqrt(1.0 + rest), k >= 0
        signed = jnp.where(forward, d, -d)
        wide, tight = 0.5 * (both + signed), rest / (both + signed)
        front = self.clearance * jnp.square(jnp.where(forward, tight, wide))
        rear = self.clearance * jnp.square(jnp.where(forward, wide, tight))
        area = lambda film: (
            2.0
            * jnp.pi
            * jnp.sqrt(self.ball_radius * conforming)
            * jnp.log(jnp.maximum(CUT_FILMS, self.clearance / film))
        )
        rolling, crossing = viscosity * self.ball_radius * axial_spin, viscosity * self.ball_radius * radial_spin
        return BallPocketFilm(
            film_front=front,
            film_rear=rear,
            load_front=strength / jnp.sqrt(front),
            load_rear=strength / jnp.sqrt(rear),
            friction_front=rolling * area(front),
            friction_rear=rolling * area(rear),
            transverse_front=crossing * area(front),
            transverse_rear=crossing * area(rear),
        )
