"""Grouping of points into curves by their test conditions, for files that do not name the curves."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Bool, Float64, Int64

RELATIVE_STEP = 0.02
"""Relative step between neighbouring pressures, loads or speeds above which they are two conditions."""
TEMPERATURE_STEP = 2.0
"""Step between neighbouring temperatures, in K, above which they are two conditions."""

_SHOWN = {"pressure": (1e9, 0.0, "GPa"), "load": (1.0, 0.0, "N"), "entrainment_speed": (1.0, 0.0, "m/s")}
_SHOWN |= {"temperature": (1.0, 273.15, "degC")}
"""Display of a condition in names of curves: divisor of the SI value, number that is then subtracted, and unit."""


def group(
    conditions: Mapping[str, Float64[np.ndarray, " point"]], point_count: int
) -> tuple[Int64[np.ndarray, " point"], tuple[str, ...], tuple[str, ...]]:
    """Curve index of each point, names of the curves, and notes, from the conditions measured with each point.

    The numbers of one condition are not equal: a set load or speed scatters by a percent, an oil temperature drifts by
    degrees. So each quantity is sorted, and a step of more than 2 % (2 K for temperatures) between neighbours separates
    two conditions. With many points, scatter and drift have no such steps. With few points they may have, and most
    points are then alone in their condition. So a quantity separates curves only if at least half of the points share
    their value with another point, or their condition with two others. A curve is a combination of the conditions of
    all quantities. Conditions closer together than these limits are merged, even if they were set on purpose.

    **Arguments:**
    - `conditions`: name and SI values of each quantity that the file has.
    - `point_count`: number of points, for files without any.
    """
    key = np.zeros(point_count, dtype=np.int64)
    parting, notes = [], []
    for name, values in conditions.items():
        level = _levels(values, _steps(name, values))
        if level.any() and _mostly_alone(values, level):
            low, high = (_as_shown(name, value) for value in (values.min(), values.max()))
            notes.append(f"Column '{name}' scatters from {low} to {high}: taken as one condition.")
        elif level.any():
            parting.append(name)
            key = key * (level.max() + 1) + level
    curve = _by_first_appearance(key)
    if not parting:
        return curve, ("1",), ("No column 'curve': all points are taken as one curve.", *notes)
    count = int(curve.max()) + 1
    names = tuple(_name({name: conditions[name][curve == index] for name in parting}) for index in range(count))
    how = f"grouped by {' and '.join(parting)} into {count} curves"
    limits = f"less than {RELATIVE_STEP:.0%} or {TEMPERATURE_STEP:g} K apart is one condition"
    return curve, names, (f"No column 'curve': points are {how} ({limits}).", *notes)


def _steps(name: str, values: Float64[np.ndarray, " point"]) -> Bool[np.ndarray, " gap"]:
    """True if the sorted values step from one condition to the next, for each pair of neighbours."""
    ordered = np.sort(values)
    limit = TEMPERATURE_STEP if name == "temperature" else RELATIVE_STEP * ordered[:-1]
    return np.diff(ordered) > limit


def _levels(values: Float64[np.ndarray, " point"], steps: Bool[np.ndarray, " gap"]) -> Int64[np.ndarray, " point"]:
    level = np.empty(values.size, dtype=np.int64)
    level[np.argsort(values)] = np.concatenate([[0], np.cumsum(steps)])
    return level


def _mostly_alone(values: Float64[np.ndarray, " point"], level: Int64[np.ndarray, " point"]) -> bool:
    _, inverse, count = np.unique(values, return_inverse=True, return_counts=True)
    in_company = (count[inverse] > 1) | (np.bincount(level)[level] > 2)
    return int(np.count_nonzero(in_company)) < values.size / 2


def _by_first_appearance(key: Int64[np.ndarray, " point"]) -> Int64[np.ndarray, " point"]:
    _, first, inverse = np.unique(key, return_index=True, return_inverse=True)
    rank = np.empty(first.size, dtype=np.int64)
    rank[np.argsort(first)] = np.arange(first.size)
    return rank[inverse]


def _name(conditions: Mapping[str, np.ndarray]) -> str:
    middle = {name: np.sort(values)[values.size // 2] for name, values in conditions.items()}
    return ", ".join(_as_shown(name, value) for name, value in middle.items())


def _as_shown(name: str, value: float) -> str:
    scale, zero, unit = _SHOWN[name]
    return f"{value / scale - zero:.4g} {unit}"
