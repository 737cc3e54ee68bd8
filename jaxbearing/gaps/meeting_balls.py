"""Two like balls that meet: film between them, or contact."""

from typing import NamedTuple

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import safe_norm
from .ball_pocket_face import Entering, yielding_film

SHARPNESS = 8.0
"""n of the friction: how sharply it ends at a gap of R_b; a gap of R_b/10 has that of n = oo to 1e-9."""


class MetBalls(NamedTuple):
    """Load, N, film, m, friction over the sliding speed, N s/m, residual of the gap equation relative to the film."""

    load: Batch
    film: Batch
    friction: Batch
    residual: Batch


class MeetingBalls(Checked):
    r"""Film between two like balls that meet, or contact between them: any rigid gap, also negative.

    The load is that of `CompliantBallPocketFace` with $R_1 = R_2 = R_b/2$. Balls that turn alike have surfaces that
    move against each other where they meet: they slide by twice that speed and carry no oil in, so that only squeeze
    and elastic contact keep them apart. The friction is $\mu uA$, $A = \frac{\pi R_b}{n}\ln(1 + (R_b/h)^n)$ with
    n = 8: that of a parabolic gap, $\pi R_b\ln(R_b/h)$, which oil fills up to the width $R_b$.

    **Limits:** in deep overlap Hertz; the friction ends where the gap is as wide as R_b: a film does not reach from one
    ball to another that is far away, whose lever, half the distance of the centres, would make much of it.
    **Validity:** isoviscous, half Sommerfeld. The friction of a contact that touches is that of its film.
    **Reference:** as `CompliantBallPocketFace`; the friction is that of a parabolic gap, cut where it is as wide as
    R_b.

    **Arguments:**
    - `ball_radius`: R_b, m, > 0.
    - `stiffness`: of the Hertz contact of two balls, N/m^1.5, > 0.
    - `minimum_speed`: added to the entraining speed in squares, m/s, > 0.
    - `minimum_film`: of the ratio of squeeze to entrainment, m, > 0.
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

        **Arguments:** `gap`, m, any sign; `gap_rate`, m/s; `entraining`: sum of both surface speeds, m/s;
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
