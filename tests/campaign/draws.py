"""Random numbers of the campaign: each comes from one coordinate of a unit cube, so that a seeded generator and
hypothesis draw the same scenes, and a case is known by its coordinates."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

Numbers = dict[str, np.ndarray]
"""Name -> values of all cases."""


class Range(NamedTuple):
    """From `low` to `high`, evenly or evenly in the logarithm; a part of the cases is exactly 0, a part negative."""

    low: float
    high: float
    log: bool = False
    zero: float = 0.0
    negative: float = 0.0

    def values(self, unit: np.ndarray) -> np.ndarray:
        """**Arguments:** `unit`: between 0 and 1."""
        rest = np.clip((unit - self.zero) / (1.0 - self.zero), 0.0, 1.0)
        sign = np.where(rest < self.negative, -1.0, 1.0)
        if self.negative:
            below, above = rest / self.negative, (rest - self.negative) / (1.0 - self.negative)
            rest = np.where(rest < self.negative, below, above)
        span = self.high - self.low
        size = self.low * (self.high / self.low) ** rest if self.log else self.low + span * rest
        return np.where(unit < self.zero, 0.0, sign * size)


def even(low: float, high: float, **kwargs: float) -> Range:
    return Range(low, high, False, **kwargs)


def log(low: float, high: float, **kwargs: float) -> Range:
    return Range(low, high, True, **kwargs)


def drawn(ranges: Mapping[str, Range], units: np.ndarray) -> Numbers:
    """**Arguments:** `units`: one row a case, one column a range."""
    return {name: one.values(units[:, i]) for i, (name, one) in enumerate(ranges.items())}


def single(numbers: Numbers, case: int) -> dict[str, float]:
    """The numbers of one case."""
    return {name: values[case].item() if values[case].ndim == 0 else values[case] for name, values in numbers.items()}


def pick(numbers: Numbers, cases: np.ndarray | slice) -> Numbers:
    return {name: values[cases] for name, values in numbers.items()}


def joined(parts: list[Numbers]) -> Numbers:
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
