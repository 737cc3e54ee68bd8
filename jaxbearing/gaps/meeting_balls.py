"""Ball-to-ball contact: two equal balls that meet, with a film between them or in contact."""

from typing import NamedTuple

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import safe_norm
from .ball_pocket_face import Entering, yielding_film

SHARPNESS = 8.0
"""Exponent n of the friction: how sharply it ends at a gap of R_b; at R_b/10 it is that of n -> oo to 1e-9."""


class MetBalls(NamedTuple):
    """Load, N, film, m, friction force over sliding speed, N s/m, and residual of the gap equation over the film."""

    load: Batch
    film: Batch
    friction: Batch
    residual: Batch


class MeetingBalls(Checked):
    r"""Film or contact between two equal balls that meet, for any rigid gap, also negative.

    The load is that of `CompliantBallPocketFace` with $R_1 = R_2 = R_b/2$. Where two balls of equal spin meet, their
    surfaces move in opposite directions: they slide at twice the surface speed and entrain no oil, so that only squeeze
    and elastic contact keep them apart. The friction is $\mu uA$, $A = \frac{\pi R_b}{n}\ln(1 + (R_b/h)^n)$ with
    n = 8: that of a parabolic gap filled with oil up to the gap R_b, $\pi R_b\ln(R_b/h)$.

    **Limits:** Hertz in deep overlap. The friction ends where the gap reaches R_b: no film spans the gap between
    distant balls, whose large lever, half the distance of the centres, would exaggerate its moment.
    **Validity:** isoviscous, half Sommerfeld. In contact, too, the friction is that of the film.
    **Reference:** as `CompliantBallPocketFace`; friction of a parabolic gap, cut off at the gap R_b.

    **Arguments:**
    - `ball_radius`: R_b, m, > 0.
    - `stiffness`: of the Hertz contact of two balls, N/m^1.5, > 0.
    - `minimum_speed`: floor of the entraining speed (root of the sum of squares), m/s, > 0.
    - `minimum_film`: floor of the film in the ratio of squeeze to entrainment, m, > 0.
    """

    ball_radius: Scalar = bounded("> 0")
    stiffness: Scalar = bounded("> 0")
    minimum_speed: Scalar = bounded("> 0", default=0.5)
    minimum_film: Scalar = bounded("> 0", default=0.3e-6)

    def elastic_energy(self, load: Values) -> Batch:
        """Elastic energy of one contact, J. **Arguments:** `load`, N."""
        return 0.4 * jnp.asarray(load) ** (5.0 / 3.0) / self.stiffness ** (2.0 / 3.0)

    def contact(self, gap: Values, gap_rate: Values, entraining: Values, viscosity: Values) -> MetBalls:
        """Load, film and friction at a rigid gap.

        **Arguments:** `gap`, m, of either sign; `gap_rate`, m/s; `entraining`: sum of both surface speeds, m/s;
        `viscosity`, Pa s.
        """
        radius = 0.5 * jnp.asarray(self.ball_radius)
        squeeze = -3.0 * viscosity * radius * jnp.asarray(gap_rate)
        rolling = 1.2 * jnp.sqrt(2.0 * radius) * viscosity * safe_norm(entraining, self.minimum_speed)
        entering = Entering(squeeze, rolling, radius)
        load, film, residual = yielding_film(gap, entering, self.stiffness, self.minimum_film)
        width = jnp.log(2.0 * radius) - jnp.log(film)
        area = 2.0 * jnp.pi * radius * jnp.logaddexp(0.0, SHARPNESS * width) / SHARPNESS
        return MetBalls(load, film, viscosity * area, residual)
