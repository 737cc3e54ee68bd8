"""A number that scatters: what a scene file writes as `{mean = ..., deviation = ...}`, `{low = ..., high = ...}` or
`{median = ..., log_deviation = ...}`."""

import math
from dataclasses import dataclass
from statistics import NormalDist
from typing import Literal, get_args

import numpy as np

Shape = Literal["normal", "uniform", "lognormal"]
SHAPES: tuple[Shape, ...] = get_args(Shape)
SIGMAS = 3.0
"""Standard deviations between the mean and a limit of a normal distribution: a tolerance is six of them wide."""
_NORMAL = NormalDist()
_LEAST = 2.0**-53
"""Smallest probability that is asked of the normal distribution, whose quantile of 0 is infinite."""


@dataclass(frozen=True)
class Distribution:
    """Distribution of one number of a scene, in SI units.

    Makers give a tolerance as two limits. A normal distribution has them at three standard deviations from its mean, so
    0.27 % of all parts lie beyond them; a uniform one has nothing beyond. `Distribution.between` makes one of limits.
    A lognormal one is that of a positive number that is known to a factor only; its limits cut it off.
    `Distribution.lognormal` makes one of its median.

    **Arguments:**
    - `mean`: mean value.
    - `deviation`: standard deviation, >= 0.
    - `shape`: "normal", "uniform" or "lognormal".
    - `low`, `high`: limits for the worst case; not given: three standard deviations from the mean of a normal
      distribution, of a lognormal one three `log_deviation` from the logarithm of its median; the ends of a uniform
      one.
    - `median`, `log_deviation`: of a lognormal distribution before it is cut off: median, and standard deviation of the
      logarithm; not given: from `mean` and `deviation`.

    **Raises:** `ValueError` for numbers that are not finite, a negative deviation, an unknown shape, limits that do not
    hold the mean, and a lognormal distribution that is not positive.
    """

    mean: float
    deviation: float
    shape: Shape = "normal"
    low: float | None = None
    high: float | None = None
    median: float | None = None
    log_deviation: float | None = None

    def __post_init__(self):
        parameters = (self.mean, self.deviation, self.low, self.high, self.median, self.log_deviation)
        numbers = [value for value in parameters if value is not None]
        if not all(math.isfinite(value) for value in numbers):
            raise ValueError(f"a distribution must have finite numbers, got {numbers}")
        if self.deviation < 0.0:
            raise ValueError(f"deviation must be >= 0, got {self.deviation:g}")
        if self.shape not in SHAPES:
            raise ValueError(f"shape must be 'normal', 'uniform' or 'lognormal', got {self.shape!r}")
        if self.shape == "lognormal":
            self._check_lognormal()
        elif self.median is not None or self.log_deviation is not None:
            raise ValueError(f"median and log_deviation are those of a lognormal distribution, got {self.shape!r}")
        if not self.lowest <= self.mean <= self.highest:
            raise ValueError(
                f"low must be at most the mean {self.mean:g}, and high at least, got {self.low}, {self.high}"
            )

    def _check_lognormal(self) -> None:
        if self.mean <= 0.0:
            raise ValueError(f"the mean of a lognormal distribution must be > 0, got {self.mean:g}")
        if (self.median is None) != (self.log_deviation is None):
            raise ValueError("median and log_deviation belong together, got one of them")
        if self.median is None:
            spread = math.log1p((self.deviation / self.mean) ** 2)
            object.__setattr__(self, "median", self.mean * math.exp(-0.5 * spread))
            object.__setattr__(self, "log_deviation", math.sqrt(spread))

    @staticmethod
    def between(low: float, high: float, shape: Shape = "normal") -> "Distribution":
        """The distribution of a number with these limits. **Raises:** `ValueError` for a low limit above the high, of a
        lognormal one also for a low limit that is not positive."""
        if low > high:
            raise ValueError(f"low must be at most high, {high:g}, got {low:g}")
        if shape == "lognormal":
            if low <= 0.0:
                raise ValueError(f"low of a lognormal distribution must be > 0, got {low:g}")
            return Distribution.lognormal(math.sqrt(low * high), math.log(high / low) / (2.0 * SIGMAS), low, high)
        deviation = (high - low) / (2.0 * _half_width(shape))
        return Distribution(0.5 * (low + high), deviation, shape, low, high)

    @staticmethod
    def lognormal(
        median: float, log_deviation: float, low: float | None = None, high: float | None = None
    ) -> "Distribution":
        """The distribution of a positive number that is known to a factor, exp(`log_deviation`), cut off at the limits.

        **Arguments:** `median`: before it is cut off, > 0; `log_deviation`: standard deviation of the logarithm, >= 0.

        **Raises:** `ValueError` for numbers out of these bounds and for limits that do not hold the median.
        """
        if not median > 0.0:
            raise ValueError(f"median must be > 0, got {median:g}")
        if not log_deviation >= 0.0:
            raise ValueError(f"log_deviation must be >= 0, got {log_deviation:g}")
        if (low is not None and low > median) or (high is not None and high < median):
            raise ValueError(f"low must be at most the median {median:g}, and high at least, got {low}, {high}")
        first, second = (_moment(order, median, log_deviation, low, high) for order in (1, 2))
        deviation = math.sqrt(max(second - first**2, 0.0))
        return Distribution(first, deviation, "lognormal", low, high, median, log_deviation)

    @property
    def nominal(self) -> float:
        """Value that the scene has: the mean, of a lognormal distribution the median before it is cut off."""
        return self.mean if self.median is None else self.median

    @property
    def lowest(self) -> float:
        """Lower limit."""
        return self._limit(self.low, -1.0)

    @property
    def highest(self) -> float:
        """Upper limit."""
        return self._limit(self.high, 1.0)

    def _limit(self, limit: float | None, side: float) -> float:
        if limit is not None:
            return limit
        if self.median is not None and self.log_deviation is not None:
            return self.median * math.exp(side * SIGMAS * self.log_deviation)
        return self.mean + side * _half_width(self.shape) * self.deviation

    def quantiles(self, shares: np.ndarray) -> np.ndarray:
        """Values below which these shares of all numbers are, each from 0 to 1."""
        if self.shape == "uniform":
            return self.mean + self.deviation * math.sqrt(3.0) * (2.0 * shares - 1.0)
        if self.median is None or self.log_deviation is None:
            return self.mean + self.deviation * _normal_quantiles(shares)
        below, above = _cut(self.median, self.log_deviation, self.low, self.high)
        normal = _normal_quantiles(below + shares * (above - below))
        low, high = 0.0 if self.low is None else self.low, math.inf if self.high is None else self.high
        return np.clip(self.median * np.exp(self.log_deviation * normal), low, high)

    def samples(self, normal: np.ndarray, uniform: np.ndarray) -> np.ndarray:
        """Random values.

        **Arguments:** `normal`: of the standard normal distribution; `uniform`: evenly distributed from 0 to 1.
        """
        if self.shape == "normal":
            return self.mean + self.deviation * normal
        return self.quantiles(uniform)


def _half_width(shape: str) -> float:
    """Standard deviations between the mean and a limit."""
    return math.sqrt(3.0) if shape == "uniform" else SIGMAS


def _normal_quantiles(shares: np.ndarray) -> np.ndarray:
    flat = np.clip(np.asarray(shares, dtype=float), _LEAST, 1.0 - _LEAST).ravel()
    return np.fromiter(map(_NORMAL.inv_cdf, flat), dtype=float, count=flat.size).reshape(np.shape(shares))


def _cut(
    median: float, log_deviation: float, low: float | None, high: float | None, order: int = 0
) -> tuple[float, float]:
    """Shares of a lognormal distribution, each value weighted by its power `order`, below both limits."""
    if log_deviation == 0.0:
        return 0.0, 1.0
    at = lambda limit: (math.log(limit / median) / log_deviation) - order * log_deviation
    below = 0.0 if low is None or low <= 0.0 else _NORMAL.cdf(at(low))
    return below, 1.0 if high is None else _NORMAL.cdf(at(high))


def _moment(order: int, median: float, log_deviation: float, low: float | None, high: float | None) -> float:
    """Mean of a power of a lognormal number that is cut off at the limits."""
    whole = median**order * math.exp(0.5 * (order * log_deviation) ** 2)
    below, above = _cut(median, log_deviation, low, high)
    weighted_below, weighted_above = _cut(median, log_deviation, low, high, order)
    return whole * (weighted_above - weighted_below) / (above - below)
