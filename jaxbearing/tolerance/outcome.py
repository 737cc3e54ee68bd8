"""The scatter that tolerances give the results of a scene."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..distribution import SIGMAS, Distribution

_ROUND_OFF = 1e-9
"""Scatter relative to a result that the tolerance of the solver alone may cause."""


@dataclass(frozen=True)
class Sampled:
    """A result in random samples.

    **Arguments:**
    - `mean`, `deviation`: of the samples that converged; NaN for fewer than two.
    - `mean_error`, `deviation_error`: standard errors of both.
    - `low`, `high`: 0.135 and 99.865 % of the samples are below, as of a normal distribution three deviations from its
      mean; for fewer than 1000 samples the smallest and the largest.
    - `values`: one a converged sample.
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
    - `value`: result of the scene whose fields have their means, lognormal ones their medians.
    - `mean`, `deviation`: by the delta method; what a seat that may come loose does is that of a rectified normal
      variable.
    - `worst_low`, `worst_high`: smallest and largest result in the worst cases: for each result all fields at those of
      their limits that make it small by its derivatives, and large. Those whose solve fails are left out.
    - `likely`: 5 and 95 % of the bearings are below, by the derivatives and the shapes of the distributions.
    - `contributions`: share of each field in the variance; they add up to 1 (all 0 without a variance). Fields that
      scatter together part their covariance, so that a share may be negative or above 1.
    - `derivatives`: of the result by each field.
    - `sampled`: `None` without samples.
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
        """Share of the bearings in which the result is negative, of a normal distribution; of the clearance the share
        with radial preload."""
        if self.deviation == 0.0:
            return float(self.mean < 0.0)
        return 0.5 * math.erfc(self.mean / (math.sqrt(2.0) * self.deviation))


@dataclass(frozen=True)
class Samples:
    """The random samples.

    **Arguments:**
    - `count`: how many; `converged`: how many of them have results.
    - `seed`: of the random numbers: the same seed gives the same samples.
    - `failures`: why others have none, and how many.
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
    - `origins`: where a distribution comes from, of fields whose distribution is not given itself; or what a field of
      an oil's law stands for.
    - `results`: scatter of each result, by the path of the result.
    - `samples`: `None` without samples.
    - `warnings`: notes in words.
    - `solution`: that of the scene whose fields have their means.
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
