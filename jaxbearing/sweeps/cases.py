"""The cases of a sweep: values of fields, in SI, on a grid, in a list or as random samples."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

MOST_CASES = 10_000_000
Kind = Literal["grid", "list", "random", "latin_hypercube"]


@dataclass(frozen=True)
class Cases:
    """Values of fields, case by case.

    **Arguments:**
    - `kind`: how the cases were chosen.
    - `paths`: dotted paths of the fields.
    - `values`: array for each field. For a grid: values along the field's axis; the last field varies fastest.
      Otherwise: one value for each case.

    **Raises:** `ValueError` for no field, no case, too many, or values that are not finite numbers.
    """

    kind: Kind
    paths: tuple[str, ...]
    values: tuple[np.ndarray, ...]

    def __post_init__(self):
        if not self.paths:
            raise ValueError("a sweep needs a field to vary")
        names = [path.replace(".", "_") for path in self.paths]
        for i, name in enumerate(names):
            if name in names[:i]:
                first = self.paths[names.index(name)]
                raise ValueError(f"{first} and {self.paths[i]} would both be called {name} in the data set")
        for path, values in zip(self.paths, self.values, strict=True):
            if values.ndim != 1 or values.size == 0 or not np.all(np.isfinite(values)):
                raise ValueError(f"{path}: expected one or more finite numbers, one after the other")
        if self.kind != "grid" and len({values.size for values in self.values}) != 1:
            raise ValueError("a list of cases needs as many values of each field")
        if len(self) > MOST_CASES:
            raise ValueError(f"{len(self)} cases are too many: at most {MOST_CASES}")

    def __len__(self) -> int:
        return math.prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """Numbers of values along the axes; a list has one axis."""
        sizes = tuple(values.size for values in self.values)
        return sizes if self.kind == "grid" else sizes[:1]

    def part(self, start: int, stop: int) -> dict[str, np.ndarray]:
        """Values of each field in the cases from `start` to `stop`, shape (case,)."""
        if self.kind != "grid":
            return {path: values[start:stop] for path, values in zip(self.paths, self.values, strict=True)}
        places = np.unravel_index(np.arange(start, min(stop, len(self))), self.shape)
        return {path: values[at] for path, values, at in zip(self.paths, self.values, places, strict=True)}

    def corners(self) -> list[dict[str, float]]:
        """Four cases: all fields at their first, their last, their smallest, and their largest values."""
        ends = ([v[0] for v in self.values], [v[-1] for v in self.values])
        ends += ([v.min() for v in self.values], [v.max() for v in self.values])
        return [dict(zip(self.paths, map(float, values), strict=True)) for values in ends]

    def spread(self, count: int) -> Iterator[dict[str, float]]:
        """Up to `count` cases, evenly selected from the first to the last."""
        for place in np.unique(np.linspace(0, len(self) - 1, count).astype(int)):
            yield {path: float(values[0]) for path, values in self.part(place, place + 1).items()}


def _columns(over: Mapping[str, object]) -> tuple[tuple[str, ...], tuple[np.ndarray, ...]]:
    _mapping("over", over)
    return tuple(over), tuple(_numbers(path, values) for path, values in over.items())


def _mapping(name: str, argument: object) -> None:
    """Checks that an argument maps paths of fields to values.

    **Raises:** `ValueError` if it does not.
    """
    if not isinstance(argument, Mapping) or not all(isinstance(path, str) for path in argument):
        raise ValueError(f"{name} must map dotted paths of fields to values, got {argument!r}")


def _numbers(path: str, values: object) -> np.ndarray:
    """The values of a field as an array of floats.

    **Raises:** `ValueError` for values that are not real numbers.
    """
    try:
        array = np.atleast_1d(np.asarray(values))
    except (TypeError, ValueError):  # lists of lists of different lengths, and the like
        array = np.empty(0, object)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{path}: expected one or more finite numbers, got {values!r}")
    return array.astype(np.float64)


def grid(over: Mapping[str, object]) -> Cases:
    """Cases with every combination of the values of all fields. **Arguments:** `over`: SI values by dotted path."""
    return Cases("grid", *_columns(over))


def listed(over: Mapping[str, object]) -> Cases:
    """Cases from lists of values. **Arguments:** `over`: SI values by dotted path, one value of each field for each
    case."""
    return Cases("list", *_columns(over))


def random(bounds: Mapping[str, Sequence[Any]], count: int, seed: int = 0) -> Cases:
    """Random cases; the fields are independent and uniformly distributed between bounds.

    **Arguments:** `bounds`: by dotted path, lowest and highest value in SI, followed by "log" if the logarithm is to be
    uniformly distributed.
    """
    _mapping("bounds", bounds)
    _positive(count)
    return _within("random", bounds, np.random.default_rng(seed).random((count, len(bounds))))


def latin_hypercube(bounds: Mapping[str, Sequence[Any]], count: int, seed: int = 0) -> Cases:
    """Random cases (see `random`), with one case in each of `count` equal parts of every field's range."""
    from scipy.stats import qmc

    _mapping("bounds", bounds)
    _positive(count)
    sampler = qmc.LatinHypercube(max(1, len(bounds)), rng=np.random.default_rng(seed))
    return _within("latin_hypercube", bounds, sampler.random(count))


def _positive(count: int) -> None:
    if isinstance(count, bool) or not isinstance(count, int | np.integer) or not 1 <= count <= MOST_CASES:
        raise ValueError(f"found {count} cases, expected 1 to {MOST_CASES}")


def _within(kind: Kind, bounds: Mapping[str, Sequence[object]], unit: np.ndarray) -> Cases:
    values = {}
    for (path, bound), part in zip(bounds.items(), unit.T, strict=False):
        ends = list(bound) if isinstance(bound, list | tuple | np.ndarray) else []
        if not 2 <= len(ends) <= 3 or ends[2:] not in ([], ["log"]):
            raise ValueError(f"{path}: expected lowest and highest value, and 'log' where wanted, got {bound!r}")
        (low, high), spacing = _numbers(path, ends[:2]), ends[2:]
        values[path] = between(float(low), float(high), part, "log" in spacing, path)
    return Cases(kind, *_columns(values))


def between(low: float, high: float, part: np.ndarray, log: bool, path: str) -> np.ndarray:
    """Values between `low` (`part` 0) and `high` (`part` 1), interpolated linearly or, with `log`, between logarithms;
    the ends are met exactly. **Raises:** `ValueError` if a logarithm does not exist."""
    if not log:
        return low * (1.0 - part) + high * part
    if not (low > 0.0 and high > 0.0):
        raise ValueError(f"{path}: logarithmic spacing needs values > 0, found {low:g} and {high:g} in SI units")
    values = np.exp(math.log(low) * (1.0 - part) + math.log(high) * part)
    return np.where(part == 0.0, low, np.where(part == 1.0, high, values))
