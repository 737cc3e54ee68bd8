"""Posterior prediction of a repeated measurement: the model's results for the samples, with new random errors."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .posterior import Posterior

PREDICTED = 200
"""Samples of the posterior whose predictions are computed."""


@dataclass(frozen=True)
class Predictive:
    """Prediction of the measured values if they were measured again, SI.

    **Arguments:**
    - `median`, `lower`, `upper`: median and ends of the interval of each predicted value.
    - `measured`: the values that were measured; `deviation`: their standard deviations, scaled by the posterior median
      size of the errors.
    - `names`: of the values.
    - `inside`: share of the measured values within their intervals.
    - `level`: of the intervals; `samples`: number of samples whose predictions were computed.
    """

    median: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    measured: np.ndarray
    deviation: np.ndarray
    names: tuple[str, ...]
    inside: float
    level: float
    samples: int

    def in_words(self) -> str:
        """A sentence on how many of the measured values the posterior predicts."""
        count = round(self.inside * len(self.measured))
        return (
            f"{count} of {len(self.measured)} measured values lie within the {100.0 * self.level:g} % intervals in "
            f"which {self.samples} samples predict a new measurement"
        )

    def to_dict(self) -> dict[str, Any]:
        """The predicted values and the share of the measured ones inside."""
        parts = {name: getattr(self, name).tolist() for name in ("median", "lower", "upper")}
        return parts | {"inside": self.inside, "level": self.level, "samples": self.samples}


def chosen_samples(posterior: Posterior, count: int) -> np.ndarray:
    """Indices of `count` samples, selected evenly from all chains."""
    total = posterior.coordinates.shape[0] * posterior.coordinates.shape[1]
    return np.linspace(0, total - 1, min(count, total)).astype(int)


def measured_again(
    posterior: Posterior,
    place: np.ndarray,
    values: np.ndarray,
    measured: np.ndarray,
    deviation: np.ndarray,
    names: tuple[str, ...],
    seed: int = 0,
) -> Predictive:
    """The predictive distribution of measured values.

    **Arguments:**
    - `place`: indices of the samples, from `chosen_samples`; `values`: their results, (sample, value).
    - `measured`, `deviation`: each value and its assumed deviation, not yet scaled by the size of the errors;
      `names`: of the values.

    **Raises:** `ValueError` where a sample has no solution.
    """
    failed = int(np.sum(~np.all(np.isfinite(values), axis=1)))
    if failed:
        raise ValueError(f"posterior: found no solution with {failed} of {len(values)} samples")
    scale = posterior.scale.reshape(-1)[place]
    errors = np.random.default_rng(seed).normal(size=values.shape)
    again = values + errors * scale[:, None] * deviation
    tail = 0.5 - 0.5 * posterior.level
    lower, median, upper = np.quantile(again, (tail, 0.5, 1.0 - tail), axis=0)
    inside = float(np.mean((lower <= measured) & (measured <= upper)))
    size = float(np.median(scale)) * deviation
    return Predictive(median, lower, upper, measured, size, names, inside, posterior.level, len(place))
