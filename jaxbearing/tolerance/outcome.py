"""Scatter of the results of a scene, caused by tolerances."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..distribution import SIGMAS, Distribution

_ROUND_OFF = 1e-9
"""Relative scatter of a result that the tolerance of the solver alone may cause."""


@dataclass(frozen=True)
class Sampled:
    """A result in random samples.

    **Arguments:**
    - `mean`, `deviation`: of the samples that converged; NaN for fewer than two.
    - `mean_error`, `deviation_error`: standard errors of both.
    - `low`, `high`: values below which 0.135 % and 99.865 % of the samples are: three deviations from the mean for a
      normal distribution; for fewer than 1000 samples the smallest and the largest value.
    - `values`: one value for each converged sample.
    """

    mean: float
    mean_error: float
    deviation: float
    deviation_error: float
    low: float
    high: float
    values: np.ndarray = field(repr=False)

    @property
    def below_zero(self) -> float:
        """Share of the samples in which the result is negative."""
        return float(np.mean(self.values < 0.0)) if self.values.size else float("nan")


@dataclass(frozen=True)
class Spread:
    """Scatter of one result, in SI units.

    **Arguments:**
    - `value`: result with all fields at their means, lognormal ones at their medians.
    - `mean`, `deviation`: by the delta method; the interference of a seat that may come loose counts as a rectified
      normal variable.
    - `worst_low`, `worst_high`: smallest and largest result in the worst cases: for each result, all fields at the
      limits that, by its derivatives, make it smallest, and largest. Cases whose solve fails are left out.
    - `likely`: results below which 5 % and 95 % of the bearings are, by the derivatives and the shapes of the
      distributions.
    - `contributions`: share of each field in the variance; they add up to 1 (all 0 without a variance). Fields that
      scatter together share their covariance, so that a contribution may be negative or above 1.
    - `derivatives`: of the result by each field.
    - `sampled`: statistics of the random samples; `None` without samples.
    """

    value: float
    mean: float
    deviation: float
    worst_low: float
    worst_high: float
    unit: str
    description: str
    contributions: Mapping[str, float]
    derivatives: Mapping[str, float]
    likely: tuple[float, float] = (math.nan, math.nan)
    sampled: Sampled | None = None

    @property
    def moves(self) -> bool:
        """True if the fields change the result by more than round-off."""
        return max(self.deviation, self.worst_high - self.worst_low) > _ROUND_OFF * abs(self.value)

    @property
    def low(self) -> float:
        """Three standard deviations below the mean."""
        return self.mean - SIGMAS * self.deviation

    @property
    def high(self) -> float:
        """Three standard deviations above the mean."""
        return self.mean + SIGMAS * self.deviation

    @property
    def likely_low(self) -> float:
        """Result below which 5 % of the bearings are."""
        return self.likely[0]

    @property
    def likely_high(self) -> float:
        """Result below which 95 % of the bearings are."""
        return self.likely[1]

    @property
    def below_zero(self) -> float:
        """Share of the bearings in which the result is negative, by a normal distribution; for the clearance, the share
        with radial preload."""
        if self.deviation == 0.0:
            return float(self.mean < 0.0)
        return 0.5 * math.erfc(self.mean / (math.sqrt(2.0) * self.deviation))


@dataclass(frozen=True)
class Samples:
    """The random samples.

    **Arguments:**
    - `count`: number of samples; `converged`: number of those that have results.
    - `seed`: of the random numbers: the same seed gives the same samples.
    - `failures`: reasons why others have no results -> number of such samples.
    - `file`: the data set of all samples; `None` where it was not kept.
    """

    count: int
    converged: int
    seed: int
    failures: Mapping[str, int]
    file: str | None = None


@dataclass(frozen=True)
class Tolerances:
    """Result of `jaxbearing.tolerances`.

    **Arguments:**
    - `fields`: distribution of each field that scatters, by dotted path, in SI units.
    - `units`: SI units of these fields.
    - `origins`: where the distribution of a field comes from, if it was not given; or what a field of an oil's law
      stands for.
    - `results`: scatter of each result, by the path of the result.
    - `samples`: `None` without samples.
    - `warnings`: notes in words.
    - `solution`: solution with all fields at their means, lognormal ones at their medians.
    """

    fields: Mapping[str, Distribution]
    units: Mapping[str, str]
    origins: Mapping[str, str]
    results: Mapping[str, Spread]
    samples: Samples | None
    warnings: tuple[str, ...]
    solution: Any = field(repr=False)

    def __getitem__(self, name: str) -> Spread:
        return self.results[name]
