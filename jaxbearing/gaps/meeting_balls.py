"""Two like balls that meet: film between them, or contact."""

from typing import NamedTuple

import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.safe import safe_norm
from .ball_pocket_face import Entering, yielding_film


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
    and elastic contact keep them apart. The friction is $\mu uA$, $A = \pi R_b\cdot\tfrac12\ln(1 + (R_b/h)^2)$.

    **Limits:** in deep overlap Hertz; far apart the friction falls with the square of the gap.
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
        area = jnp.pi * radius * jnp.log1p(jnp.square(2.0 * radius / film))
        return MetBalls(load, film, viscosity * area, residual)
