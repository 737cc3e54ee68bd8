"""Monte Carlo: random samples of the fields, solved by the engine of sweeps."""

import collections
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from ..sweeps.cases import MOST_CASES, Cases
from .outcome import Sampled
from .results import Label
from .scatter import Scatter

FEWEST_FOR_TAILS = 1000
"""Least number of samples for tails by quantiles: 0.135 % of them is then more than one sample."""
_TAIL = 0.00135
"""Share of a normal distribution beyond three deviations, on one side."""


def cases_of(scatter: Scatter, count: int, seed: int) -> Cases:
    """Random samples (`count`) of the fields, which are independent except those that scatter together.

    The first samples of a longer run with the same seed are those of a shorter one.

    **Raises:** `ValueError` for a count that is not possible.
    """
    if isinstance(count, bool) or not isinstance(count, int | np.integer) or not 2 <= count <= MOST_CASES:
        raise ValueError(f"samples: found {count}, expected 2 to {MOST_CASES}")
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        raise ValueError(f"seed: found {seed}, expected a whole number >= 0")
    several = np.random.default_rng(seed).spawn(3)
    normal = several[0].standard_normal((count, len(scatter.fields)))
    uniform = several[1].random((count, len(scatter.fields)))
    columns = [field.samples(normal[:, i], uniform[:, i]) for i, field in enumerate(scatter.fields.values())]
    if scatter.joint is not None:
        drawn = dict(zip(scatter.joint.fields, scatter.joint.draws(several[2], count).T, strict=True))
        columns = [drawn.get(path, column) for path, column in zip(scatter.fields, columns, strict=True)]
    return Cases("random", tuple(scatter.fields), tuple(columns))


def sampled(dataset: xr.Dataset, labels: Mapping[str, Label]) -> dict[str, Sampled]:
    """Statistics of each result over the samples that converged."""
    good = dataset["failure"].values == ""
    statistics = {}
    for name, label in labels.items():
        data = dataset[label.variable]
        if label.along is not None:
            dimension, entry = label.along
            data = data.sel({dimension: entry})
        values = np.asarray(data.values, dtype=np.float64)
        if values.shape[:1] != good.shape:
            # all samples share it
            values = np.broadcast_to(values, (good.size, *values.shape))
        statistics[name] = _statistics(values[(slice(None), *label.place)].reshape(good.size)[good])
    return statistics


def failures_in(dataset: xr.Dataset) -> dict[str, int]:
    """Reasons why samples have no results -> number of such samples, the most frequent reason first."""
    texts = dataset["failure"].values.astype(object).tolist()
    return dict(collections.Counter(text for text in texts if text).most_common())


def _statistics(values: np.ndarray) -> Sampled:
    """Statistics of a result; standard errors for any distribution: s/sqrt(n) of the mean, of the deviation from the
    fourth moment."""
    values = values[np.isfinite(values)]
    n = values.size
    if n < 2:
        nothing = float("nan")
        return Sampled(nothing, nothing, nothing, nothing, nothing, nothing, values)
    mean, deviation = float(np.mean(values)), float(np.std(values, ddof=1))
    fourth = float(np.mean((values - mean) ** 4))
    of_variance = max(fourth - (n - 3) / (n - 1) * deviation**4, 0.0) / n
    error = 0.0 if deviation == 0.0 else float(np.sqrt(of_variance)) / (2.0 * deviation)
    ends: Any = (values.min(), values.max())
    if n >= FEWEST_FOR_TAILS:
        ends = np.quantile(values, (_TAIL, 1.0 - _TAIL))
    return Sampled(mean, deviation / float(np.sqrt(n)), deviation, error, float(ends[0]), float(ends[1]), values)
