r"""Effect of a seat with scattering interference on the rings: none while the seat is loose.

The interference that presses the rings is a sum of rectified lines, $u = \sum_j s_j \max(I - b_j, 0)$: one line for a
given smoothing, three where the default smoothing flattens the curve of a seat that temperatures keep tight. For a
normal variable $I$ the mean and variance of $u$ and its covariance with $I$ are exact,
$\mathrm{cov}(u, I) = s^2\sum_j s_j\Phi((m - b_j)/s)$ (Stein's lemma), and so is the scatter of a result that is linear
in $u$.
"""

from dataclasses import dataclass

import jax.numpy as jnp
from jax.scipy.stats import norm

from ..mounting.rectified import rectified_normal
from ..mounting.seats import SMOOTHING, Fits

NEVER = 8.0
"""Number of standard deviations beyond which a bend does not count: the probability beyond is below 1e-15."""
_TIGHT = 1e-12
"""Interference beyond the bend at which the slope is that of a tight seat, m."""


@dataclass(frozen=True)
class Seat:
    """Seat of a ring whose interference scatters.

    **Arguments:**
    - `name`: "shaft" or "housing".
    - `mean`: mean interference as machined, m.
    - `deviation`: standard deviation of the interference in operation by all fields, m.
    - `bends`: change of slope, 1 or -1, and the interference where it occurs, m; in ascending order.
    """

    name: str
    mean: float
    deviation: float
    bends: tuple[tuple[float, float], ...]

    @property
    def pressing(self) -> float:
        """Interference that presses the rings at the mean, m."""
        return sum(slope * max(self.mean - bend, 0.0) for slope, bend in self.bends)

    @property
    def slope(self) -> float:
        """Change of `pressing` with the interference at the mean; at a bend that of the tighter side."""
        return sum(slope for slope, bend in self.bends if self.mean >= bend)

    @property
    def tight(self) -> float:
        """Interference nearest to the mean where the slope is 1 and `pressing` is the same as at the mean, m."""
        if self.slope > 0.0:
            return self.mean
        rising = [bend for slope, bend in self.bends if slope > 0.0]
        return min(rising, key=lambda bend: abs(bend - self.mean)) + _TIGHT

    @property
    def bends_within(self) -> bool:
        """True if there is a bend within the scatter of the interference."""
        return any(abs(self.mean - bend) < NEVER * self.deviation for _, bend in self.bends)

    @property
    def loose_share(self) -> float:
        """Share of the bearings whose seat is loose."""
        reach = self.mean - self.bends[0][1]
        if self.deviation == 0.0:
            return float(reach < 0.0)
        return float(norm.cdf(-reach / self.deviation))

    @property
    def gain(self) -> float:
        """Covariance of `pressing` and interference over the variance of the latter."""
        if self.deviation == 0.0:
            return self.slope
        return sum(slope * float(norm.cdf((self.mean - bend) / self.deviation)) for slope, bend in self.bends)

    def moments(self) -> tuple[float, float]:
        """Mean, m, and variance, m^2, of the interference that presses the rings."""
        if self.deviation == 0.0:
            return self.pressing, 0.0
        parts = [self._rectified(bend) for _, bend in self.bends]
        mean = sum(slope * first for (slope, _), (first, _) in zip(self.bends, parts, strict=True))
        square = 0.0
        for slope, bend in self.bends:
            for other, beyond in self.bends:
                first, second = self._rectified(max(bend, beyond))
                square += slope * other * (second + abs(bend - beyond) * first)
        return mean, max(square - mean * mean, 0.0)

    def _rectified(self, bend: float) -> tuple[float, float]:
        """Mean of max(I - bend, 0), and mean of its square, for the interference I."""
        mean, variance = (float(value) for value in rectified_normal(self.mean - bend, self.deviation))
        return mean, variance + mean * mean


def seat_of(fits: Fits, name: str, interference: float, running: float, deviation: float) -> Seat:
    """The seat of a ring, with its bends.

    **Arguments:**
    - `fits`: a `mounting.Fits` with numbers for its interferences.
    - `interference`, `running`: mean interference as machined, and in operation, m.
    - `deviation`: standard deviation of the interference in operation, m.
    """
    by_state = running - interference + float(fits.smoothed(jnp.asarray(interference)))
    if fits.smoothing is not None:
        bends = ((1.0, float(fits.smoothing) - by_state),)
    elif by_state <= 0.0:
        bends = ((1.0, SMOOTHING - by_state),)
    else:
        # temperatures keep the ring tight: smoothing changes nothing for a seat that was machined without interference
        bends = ((1.0, -by_state), (-1.0, 0.0), (1.0, SMOOTHING))
    return Seat(name, interference, deviation, bends)
