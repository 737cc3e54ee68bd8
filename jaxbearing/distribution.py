"""A number that scatters: what a scene file writes as `{mean = ..., deviation = ...}` or `{low = ..., high = ...}`."""

import math
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

Shape = Literal["normal", "uniform"]
SHAPES: tuple[Shape, ...] = get_args(Shape)
SIGMAS = 3.0
"""Standard deviations between the mean and a limit of a normal distribution: a tolerance is six of them wide."""


class MeanUsedWarning(UserWarning):
    """A scene was read with the mean of a field that is given as a distribution."""


@dataclass(frozen=True)
class Distribution:
    """Distribution of one number of a scene, in SI units.

    Makers give a tolerance as two limits. A normal distribution has them at three standard deviations from its mean, so
    0.27 % of all parts lie beyond them; a uniform one has nothing beyond. `Distribution.between` makes one of limits.

    **Arguments:**
    - `mean`: mean value.
    - `deviation`: standard deviation, >= 0.
    - `shape`: "normal" or "uniform".
    - `low`, `high`: limits for the worst case; not given: three standard deviations from the mean of a normal
      distribution, the ends of a uniform one.

    **Raises:** `ValueError` for numbers that are not finite, a negative deviation, an unknown shape, and limits that do
    not hold the mean.
    """

    mean: float
    deviation: float
    shape: Shape = "normal"
    low: float | None = None
    high: float | None = None

    def __post_init__(self):
        numbers = [value for value in (self.mean, self.deviation, self.low, self.high) if value is not None]
        if not all(math.isfinite(value) for value in numbers):
            raise ValueError(f"a distribution must have finite numbers, got {numbers}")
        if self.deviation < 0.0:
            raise ValueError(f"deviation must be >= 0, got {self.deviation:g}")
        if self.shape not in SHAPES:
            raise ValueError(f"shape must be 'normal' or 'uniform', got {self.shape!r}")
        if not self.lowest <= self.mean <= self.highest:
            raise ValueError(
                f"low must be at most the mean {self.mean:g}, and high at least, got {self.low}, {self.high}"
            )

    @staticmethod
    def between(low: float, high: float, shape: Shape = "normal") -> "Distribution":
        """The distribution of a number with these limits. **Raises:** `ValueError` for a low limit above the high."""
        if low > high:
            raise ValueError(f"low must be at most high, {high:g}, got {low:g}")
        deviation = (high - low) / (2.0 * _half_width(shape))
        return Distribution(0.5 * (low + high), deviation, shape, low, high)

    @property
    def lowest(self) -> float:
        """Lower limit."""
        return self.mean - _half_width(self.shape) * self.deviation if self.low is None else self.low

    @property
    def highest(self) -> float:
        """Upper limit."""
        return self.mean + _half_width(self.shape) * self.deviation if self.high is None else self.high

    def samples(self, normal: np.ndarray, uniform: np.ndarray) -> np.ndarray:
        """Random values.

        **Arguments:** `normal`: of the standard normal distribution; `uniform`: evenly distributed from 0 to 1.
        """
        if self.shape == "uniform":
            return self.mean + self.deviation * math.sqrt(3.0) * (2.0 * uniform - 1.0)
        return self.mean + self.deviation * normal


def _half_width(shape: str) -> float:
    """Standard deviations between the mean and a limit."""
    return math.sqrt(3.0) if shape == "uniform" else SIGMAS
