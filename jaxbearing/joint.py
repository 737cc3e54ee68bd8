"""Joint distribution of several numbers of a scene: a posterior, whose fields are correlated."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .distribution import Distribution

_ROUND_OFF = 1e-10
"""Tolerance of the eigenvalues of a correlation matrix: they may be negative by so much, and in `axes` an eigenvalue
below this part of the largest one counts as 0."""


@dataclass(frozen=True, eq=False)
class JointDistribution:
    r"""Joint distribution of several fields of a scene, in SI units. It is normal in its coordinates: the coordinate of
    a positive field is the logarithm of its value, that of any other field is the value.

    A calibration results in such a distribution. Data that determine only the product of two fields, for instance, make
    the fields correlated. If there are samples, random values are rows of the samples, whatever their distribution;
    centre and covariance are then used by the delta method.

    **Arguments:**
    - `fields`: dotted paths of the n fields.
    - `centre`: shape (n,): medians of positive fields, means of other fields.
    - `positive`: shape (n,): whether the coordinate of a field is the logarithm.
    - `covariance`: of the coordinates, shape (n, n).
    - `samples`: shape (count, n), SI; `None`: random values are normal in the coordinates.

    **Raises:** `ValueError` for shapes that do not fit together, numbers that are not finite, a centre or samples of a
    positive field that are not positive, and a matrix that is not a covariance.
    """

    fields: tuple[str, ...]
    centre: np.ndarray
    positive: np.ndarray
    covariance: np.ndarray
    samples: np.ndarray | None = None

    def __post_init__(self):
        count = len(self.fields)
        if not count or len(set(self.fields)) != count:
            raise ValueError(f"fields: found {list(self.fields)}; expected one or more different paths")
        shapes = {"centre": (count,), "positive": (count,), "covariance": (count, count)}
        for name, shape in shapes.items():
            array = np.asarray(getattr(self, name))
            if array.shape != shape:
                raise ValueError(f"{name}: found the shape {array.shape}; expected {shape} of {count} fields")
            if not np.all(np.isfinite(array)):
                raise ValueError(f"{name}: found a number that is not finite")
        if np.any(self.centre[self.positive] <= 0.0):
            raise ValueError("centre: found a number <= 0 where the logarithm scatters")
        self._check_covariance()
        if self.samples is not None:
            self._check_samples(self.samples)

    def _check_covariance(self) -> None:
        matrix = np.asarray(self.covariance)
        size = np.sqrt(np.abs(np.diag(matrix)))
        scaled = matrix / np.where(size > 0.0, size, 1.0) / np.where(size > 0.0, size, 1.0)[:, None]
        if np.any(np.abs(scaled - scaled.T) > _ROUND_OFF) or np.min(np.linalg.eigvalsh(scaled)) < -_ROUND_OFF:
            raise ValueError("covariance: found a matrix that is not symmetric and positive; expected a covariance")

    def _check_samples(self, samples: np.ndarray) -> None:
        if samples.ndim != 2 or samples.shape[1] != len(self.fields) or len(samples) < 2:
            raise ValueError(f"samples: found the shape {samples.shape}; expected (count, {len(self.fields)})")
        if not np.all(np.isfinite(samples)) or np.any(samples[:, self.positive] <= 0.0):
            raise ValueError("samples: found a number that is not finite, or <= 0 where the logarithm scatters")

    @staticmethod
    def of_samples(
        fields: Sequence[str], samples: np.ndarray, positive: Sequence[bool] | np.ndarray
    ) -> "JointDistribution":
        """The distribution of samples, with the mean and the covariance of their coordinates.

        **Arguments:** `samples`: shape (count, n), SI; `fields`, `positive`: as in the class.

        **Raises:** `ValueError` as in the class.
        """
        values, logarithmic = np.asarray(samples, dtype=np.float64), np.asarray(positive, dtype=bool)
        if values.ndim != 2 or values.shape != (len(values), len(fields)) or len(values) < 2:
            raise ValueError(f"samples: found the shape {values.shape}; expected (count, {len(fields)})")
        if np.any(values[:, logarithmic] <= 0.0):
            raise ValueError("samples: found a number <= 0 where the logarithm scatters")
        coordinates = np.where(logarithmic, np.log(np.where(logarithmic, values, 1.0)), values)
        middle = coordinates.mean(axis=0)
        centre = np.where(logarithmic, np.exp(np.where(logarithmic, middle, 0.0)), middle)
        covariance = np.atleast_2d(np.cov(coordinates, rowvar=False))
        return JointDistribution(tuple(fields), centre, logarithmic, covariance, values)

    def only(self, fields: Sequence[str]) -> "JointDistribution":
        """Marginal distribution of the given fields."""
        place = np.array([self.fields.index(path) for path in fields])
        samples = None if self.samples is None else self.samples[:, place]
        covariance = self.covariance[np.ix_(place, place)]
        return JointDistribution(tuple(fields), self.centre[place], self.positive[place], covariance, samples)

    @property
    def marginals(self) -> dict[str, Distribution]:
        """Marginal distribution of each field: lognormal for positive fields, normal for others."""
        deviations = np.sqrt(np.maximum(np.diag(self.covariance), 0.0))
        return {
            path: Distribution.lognormal(float(middle), float(deviation))
            if positive
            else Distribution(float(middle), float(deviation))
            for path, middle, deviation, positive in zip(
                self.fields, self.centre, deviations, self.positive, strict=True
            )
        }

    @property
    def of_values(self) -> np.ndarray:
        r"""Covariance of the SI values, shape (n, n), from the covariance $C_{ij}$ of the coordinates. For two positive
        fields with means $m_i$, $m_j$ it is $m_im_j(e^{C_{ij}}-1)$; if only field i is positive, $m_iC_{ij}$."""
        variance = np.diag(self.covariance)
        means = np.where(self.positive, self.centre * np.exp(np.where(self.positive, 0.5 * variance, 0.0)), 1.0)
        both = np.logical_and.outer(self.positive, self.positive)
        return np.outer(means, means) * np.where(both, np.expm1(np.where(both, self.covariance, 0.0)), self.covariance)

    @property
    def axes(self) -> np.ndarray:
        """Principal axes of the covariance in coordinates, shape (axis, n), the longest first. Each axis is one
        standard deviation long; normal numbers along them are independent. Axes without a length are left out.

        The axes are computed for coordinates scaled by their standard deviations, so that they do not depend on units.
        """
        size = np.sqrt(np.maximum(np.diag(self.covariance), 0.0))
        scale = np.where(size > 0.0, size, 1.0)
        lengths, directions = np.linalg.eigh(self.covariance / np.outer(scale, scale))
        axes = [
            np.sqrt(length) * scale * direction
            for length, direction in zip(lengths, directions.T, strict=True)
            if length > _ROUND_OFF * max(lengths[-1], 0.0) and length > 0.0
        ]
        return np.array(axes[::-1]).reshape(len(axes), len(self.fields))

    @property
    def tangent(self) -> np.ndarray:
        """Derivative of each SI value by its coordinate, at the centre."""
        return np.where(self.positive, self.centre, 1.0)

    def at(self, offset: np.ndarray) -> dict[str, float]:
        """SI values at an offset from the centre. **Arguments:** `offset`: in coordinates, shape (n,)."""
        moved = np.where(
            self.positive, self.centre * np.exp(np.where(self.positive, offset, 0.0)), self.centre + offset
        )
        return dict(zip(self.fields, map(float, moved), strict=True))

    def steepest(self, slopes: Mapping[str, float]) -> tuple[np.ndarray, float]:
        """Point of the ellipsoid of one standard deviation where a linear result is largest, as an offset from the
        centre in coordinates, and the standard deviation of the result.

        **Arguments:** `slopes`: derivatives of the result by the fields, SI.
        """
        along = self.tangent * np.array([slopes[path] for path in self.fields])
        deviation = float(np.sqrt(max(along @ self.covariance @ along, 0.0)))
        if deviation == 0.0:
            return np.zeros(len(self.fields)), 0.0
        return self.covariance @ along / deviation, deviation

    def draws(self, random: np.random.Generator, count: int) -> np.ndarray:
        """Random SI values, shape (count, n): random rows of the samples if there are samples, else values that are
        normal in the coordinates. With the same seed, a larger `count` continues the values of a smaller one."""
        if self.samples is not None:
            place = np.floor(random.random(count) * len(self.samples)).astype(int)
            return self.samples[place]
        axes = self.axes
        offsets = random.standard_normal((count, len(axes))) @ axes
        moved = self.centre * np.exp(np.where(self.positive, offsets, 0.0))
        return np.where(self.positive, moved, self.centre + offsets)
