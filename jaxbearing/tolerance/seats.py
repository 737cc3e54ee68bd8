r"""The effect on the rings of a seat whose interference scatters: none where it is loose.

The interference that presses the rings is a sum of rectified lines, $u = \sum_j s_j \max(I - b_j, 0)$: one line for a
given smoothing, three where the default one flattens a seat that the temperatures hold. For a normal variable its mean,
its variance and its covariance with $I$ are exact, $\mathrm{cov}(u, I) = s^2\sum_j s_j\Phi((m - b_j)/s)$ (Stein's
lemma), and so is the scatter of a result that is linear in $u$.
"""

from dataclasses import dataclass

import jax.numpy as jnp
from jax.scipy.stats import norm

from ..mounting.rectified import rectified_normal
from ..mounting.seats import SMOOTHING, Fits

NEVER = 8.0
"""Standard deviations beyond which a bend in the line is not met: the share beyond is below 1e-15."""
_TIGHT = 1e-12
"""Interference beyond the bend at which the slope is that of a tight seat, m."""


@dataclass(frozen=True)
class Seat:
    """A seat.

    **Arguments:**
    - `name`: "shaft" or "housing".
    - `mean`: of the interference as machined, m.
    - `deviation`: of the interference in operation, m, by all that scatters.
    - `bends`: slope that begins, 1 or -1, and where, m; in ascending order.
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
        """The nearest interference where the slope is 1 and `pressing` is as at the mean, m."""
        if self.slope > 0.0:
            return self.mean
        rising = [bend for slope, bend in self.bends if slope > 0.0]
        return min(rising, key=lambda bend: abs(bend - self.mean)) + _TIGHT

    @property
    def bends_within(self) -> bool:
        """True if the line may bend within what the interference scatters."""
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
        """Mean, m, and variance, m^2, of what presses the rings."""
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
        """Means of max(I - bend, 0) and of its square."""
        mean, variance = (float(value) for value in rectified_normal(self.mean - bend, self.deviation))
        return mean, variance + mean * mean


def seat_of(fits: Fits, name: str, interference: float, running: float, deviation: float) -> Seat:
    """The seat of a bearing.

    **Arguments:**
    - `fits`: a `mounting.Fits` with numbers for its interferences.
    - `interference`, `running`: as machined, and in operation, m.
    - `deviation`: of that in operation, m.
    """
    by_state = running - interference + float(fits.smoothed(jnp.asarray(interference)))
    if fits.smoothing is not None:
        bends = ((1.0, float(fits.smoothing) - by_state),)
    elif by_state <= 0.0:
        bends = ((1.0, SMOOTHING - by_state),)
    else:
        # temperatures hold the ring: a seat without interference loses nothing by smoothing
        bends = ((1.0, -by_state), (-1.0, 0.0), (1.0, SMOOTHING))
    return Seat(name, interference, deviation, bends)
