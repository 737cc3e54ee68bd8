"""The search for the values of scene fields that fit measurements, by the estimation core of `fitting`."""

import dataclasses
import functools
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Array

from fitting.holding import AbstractSearch, Held, Settled
from fitting.levenberg import minimised_outside
from fitting.loss import TUNING, robust_with_slope, scale_of, variance_factor
from fitting.uncertainty import Spread, spread

from .data import Data, Observations
from .evaluation import Evaluator
from .parameters import FreeField
from .words import why_undetermined

OFFSET = 1e-5
"""The search ends at this offset (see `fitting.levenberg.OFFSET`): the next step would lower the sum of squares by
1e-10, and move no parameter by more than 1e-5 of its standard error times the square root of the number of points."""
MOST_EVALUATIONS = 100
ROUNDS, SAME_SCALE = 12, 1e-4
"""Largest number of updates of the size of the errors, and the relative change up to which it counts as unchanged."""
WIDTH = 0.5
"""Standard deviation of random starts in the coordinate of a field without a prior."""


@dataclasses.dataclass(frozen=True)
class Options:
    """Options of a calibration.

    **Arguments:**
    - `loss`: one of `fitting.loss.LOSSES`.
    - `relative_error`: standard deviation over value that is assumed where none is given; only the ratios of assumed
      deviations matter, unless `known_errors`.
    - `known_errors`: whether the deviations are taken as they are, and not scaled by the differences found.
    - `level`: of the intervals.
    - `starts`: number of starting points; `seed`: of the random ones.
    """

    loss: str = "linear"
    relative_error: float = 0.02
    known_errors: bool = False
    level: float = 0.95
    starts: int = 1
    seed: int = 0


class Problem(NamedTuple):
    """Coordinates at u = 0, mask of the free fields, size of the errors, and weights of the measured values.

    The unknowns u of each search ("lane") are displacements from `base`; those of held fields have no effect.
    """

    base: np.ndarray
    free: np.ndarray
    scale: float
    weight: np.ndarray

    @property
    def directions(self) -> np.ndarray:
        """Matrix from unknowns to coordinates."""
        return np.diag(self.free.astype(float))

    def natural(self, u: Array | np.ndarray) -> np.ndarray:
        """Coordinates that belong to the unknowns of one lane or of several."""
        return self.base + np.where(self.free, np.asarray(u), 0.0)


class Estimates(NamedTuple):
    """Results of several searches: unknowns, half the sums of squares, mask of the converged ones, and numbers of
    evaluations; the first axis is the search."""

    u: np.ndarray
    loss: np.ndarray
    converged: np.ndarray
    steps: np.ndarray


class Search(AbstractSearch[Problem, Estimates, np.ndarray]):
    """Data and methods of one calibration that all its searches share.

    **Arguments:**
    - `evaluators`: of each rig, with all calibrated fields that its scene has.
    - `rigs`: measurements of each rig.
    - `fields`: the fields to fit.
    """

    def __init__(
        self, evaluators: Sequence[Evaluator], rigs: Sequence[Data], fields: Sequence[FreeField], options: Options
    ):
        self.evaluators, self.rigs, self.fields, self.options = list(evaluators), list(rigs), tuple(fields), options
        self.observed = Observations.of(self.rigs, options.relative_error)
        limits = np.array([field.limits for field in fields], dtype=float).reshape(-1, 2)
        self.loss, self.limits = options.loss, (limits[:, 0], limits[:, 1])
        self.weight = np.where(self.observed.held_back, 0.0, 1.0)
        self.scale = 1.0
        known = [field.normal_prior for field in fields]
        self.prior_mean = np.array([0.0 if prior is None else prior[0] for prior in known])
        self.prior_deviation = np.array([np.inf if prior is None else prior[1] for prior in known])
        self.evaluations = 0

    @property
    def count(self) -> int:
        """Number of values that are fitted."""
        return int(np.sum(self.weight > 0))

    def predicted(self, coordinates: np.ndarray, active: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Values of the model for all measured values, (lane, value), and their derivatives by the coordinates,
        (lane, value, field); NaN where a solve failed and for lanes that are not `active`."""
        lanes = len(coordinates)
        active = np.ones(lanes, dtype=bool) if active is None else active
        gathered = np.full((lanes, len(self.observed)), np.nan)
        slopes = np.zeros((lanes, len(self.observed), len(self.fields)))
        values = np.stack([field.value(coordinates[:, i]) for i, field in enumerate(self.fields)], axis=1)
        chain = np.stack([field.slope(coordinates[:, i]) for i, field in enumerate(self.fields)], axis=1)
        paths = [field.path for field in self.fields]
        for number, (evaluator, data) in enumerate(zip(self.evaluators, self.rigs, strict=True)):
            own = [paths.index(path) for path in evaluator.paths]
            conditions = {path: np.tile(column, lanes) for path, column in data.conditions.items()}
            repeated = np.repeat(values[:, own], data.points, axis=0)
            results, derived = evaluator(conditions, repeated, np.repeat(active, data.points))
            self.evaluations += int(np.sum(active)) * data.points
            results = results.reshape(lanes, data.points, -1)
            derived = derived.reshape(lanes, data.points, len(own), -1)
            mine = np.flatnonzero(self.observed.rig == number)
            column = np.array([evaluator.wanted.index(name) for name in self.observed.name[mine]])
            point = self.observed.point[mine]
            gathered[:, mine] = results[:, point, column]
            part = derived[:, point, :, column]
            # an advanced index on both sides of a slice comes first
            slopes[np.ix_(np.arange(lanes), mine, np.array(own))] = np.moveaxis(part, 0, 1) * chain[:, None, own]
        return gathered, slopes

    def residuals(
        self, problem: Problem, u: np.ndarray, active: np.ndarray, weight: np.ndarray, measured: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Residuals whose sum of squares is minimised, and their Jacobian: differences from the measured values, in
        standard deviations and bent by a robust loss, followed by the distances from the priors.

        **Arguments:** `weight`, `measured`: of each value, (lane, value).
        """
        coordinates = problem.natural(u)
        values, slopes = self.predicted(coordinates, active)
        bend = self.bend
        size = self.observed.deviation * problem.scale * bend
        plain = np.where(weight > 0, (values - measured) / size, 0.0)
        bent, factor = robust_with_slope(plain, self.loss)
        jacobian = np.where(weight[..., None] > 0, slopes, 0.0) * (factor * bend / size)[..., None]
        residual, jacobian = self.with_priors(bend * bent, jacobian, coordinates)
        return residual, jacobian * problem.free

    def with_priors(
        self, residual: np.ndarray, jacobian: np.ndarray, coordinates: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Residuals, (lane, value), and Jacobian, each with one more row for each field's prior."""
        distance = (coordinates - self.prior_mean) / self.prior_deviation
        rows = np.broadcast_to(np.diag(1.0 / self.prior_deviation), (*coordinates.shape, coordinates.shape[-1]))
        return np.concatenate([residual, distance], axis=-1), np.concatenate([jacobian, rows], axis=-2)

    @property
    def bend(self) -> float:
        """Residual, in standard deviations, at which a robust loss departs from the square; 1 for the linear loss."""
        return TUNING[self.loss] if self.loss != "linear" else 1.0

    @property
    def scale_matters(self) -> bool:
        """True if the estimates depend on the size of the errors, which is then found by iteration."""
        return self.loss != "linear" or bool(np.any(np.isfinite(self.prior_deviation)))

    def lanes(
        self, problem: Problem, starts: np.ndarray, weight: np.ndarray | None = None, measured: np.ndarray | None = None
    ) -> Estimates:
        """Several searches side by side, one for each of `starts`, if wanted each with its own weights or measured
        values."""
        lanes = len(starts)
        full = lambda own, usual: np.broadcast_to(usual, (lanes, len(self.observed))) if own is None else own
        weights, values = full(weight, problem.weight), full(measured, self.observed.value)
        evaluate = lambda u, active: self.residuals(problem, u, active, weights, values)
        end = minimised_outside(evaluate, starts, MOST_EVALUATIONS, OFFSET)
        return Estimates(*(np.asarray(part) for part in (end.u, end.loss, end.converged, end.steps)))

    def problem(self, free: np.ndarray, pinned: dict[int, float], base: np.ndarray | None = None) -> Problem:
        start = np.array([field.coordinate(field.start) for field in self.fields])
        coordinates = np.where(free, start if base is None else base, start)
        for index, value in pinned.items():
            coordinates[index] = value
        return Problem(coordinates, np.asarray(free), self.scale, self.weight)

    def starts(self, problem: Problem, free: np.ndarray) -> np.ndarray:
        """The first values, and random starts about them with the standard deviations of the priors, or 0.5 for a
        coordinate without a prior."""
        rng = np.random.default_rng(self.options.seed)
        width = np.where(np.isfinite(self.prior_deviation), self.prior_deviation, WIDTH)
        starts = rng.normal(size=(self.options.starts, len(free))) * width * free
        starts[0] = 0.0
        low, high = self.limits
        return np.clip(starts, low - problem.base, high - problem.base)

    def optimised(self, problem: Problem, starts: np.ndarray) -> tuple[Problem, Estimates, np.ndarray]:
        estimates, u = self.best(problem, starts)
        for _ in range(ROUNDS if self.scale_matters else 0):
            before, self.scale = self.scale, self.renewed_scale(problem, u)
            problem = problem._replace(scale=self.scale)
            if abs(self.scale / before - 1.0) <= SAME_SCALE:
                break
            estimates, u = self.best(problem, np.tile(u, (len(starts), 1)))
        return problem, estimates, u

    def best(self, problem: Problem, starts: np.ndarray) -> tuple[Estimates, np.ndarray]:
        """Results of the searches from all starts, and the unknowns of the best."""
        estimates = self.lanes(problem, starts)
        return estimates, estimates.u[int(np.argmin(np.where(np.isfinite(estimates.loss), estimates.loss, np.inf)))]

    def renewed_scale(self, problem: Problem, u: np.ndarray) -> float:
        """Size of the errors, over the deviations, estimated from the differences."""
        used = problem.weight > 0
        residual, slopes = self.at(problem, u)
        if self.loss != "linear":
            return scale_of(residual[used])
        # parameters that the priors determine use up no degrees of freedom of the differences
        variance = self.variance_of(residual[used], slopes[used], problem.scale, problem.free)
        return max(float(np.sqrt(variance)), float(np.finfo(float).tiny) ** 0.25)

    def _determined(self, slopes: np.ndarray, free: np.ndarray) -> float:
        """Effective number of parameters that the data determine, as opposed to the priors."""
        normal = slopes[:, free].T @ slopes[:, free]
        prior = np.diag(np.square(1.0 / self.prior_deviation[free]))
        return float(np.trace(np.linalg.pinv(normal + prior) @ normal))

    def at(self, problem: Problem, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Differences of all values, over the given or assumed deviations, and their derivatives by the coordinates."""
        values, slopes = self._remembered(tuple(problem.natural(u)))
        deviation = self.observed.deviation
        return (values - self.observed.value) / deviation, slopes / deviation[:, None]

    @functools.lru_cache(maxsize=8)  # noqa: B019  (a search lives as long as its calibration)
    def _remembered(self, coordinates: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
        values, slopes = self.predicted(np.asarray(coordinates)[None])
        return values[0], slopes[0]

    def slopes(self, problem: Problem, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        residual, jacobian = self.at(problem, u)
        used = problem.weight > 0
        size = problem.scale * self.bend
        rows = self.with_priors(residual[used][None] / size, jacobian[used][None] / size, problem.natural(u)[None])
        return rows[0][0], rows[1][0]

    def variance(self, problem: Problem, u: np.ndarray, free: np.ndarray) -> float:
        """Variance of the errors over the squares of the deviations."""
        residual, slopes = self.at(problem, u)
        used = problem.weight > 0
        return self.variance_of(residual[used], slopes[used], problem.scale, free)

    def variance_of(self, residual: np.ndarray, slopes: np.ndarray, scale: float, free: np.ndarray) -> float:
        """Variance of the errors as in `variance`, from differences over the deviations and their derivatives."""
        # values that are met exactly have an error of round-off, not of 0
        least = np.finfo(float).eps ** 2
        if self.loss != "linear":
            size = scale * self.bend
            return max(variance_factor(residual / size, self.loss, int(np.sum(free))) * size**2, least)
        if self.options.known_errors:
            return 1.0
        degrees = max(len(residual) - self._determined(slopes / scale, free), 1.0)
        return max(float(np.sum(np.square(residual)) / degrees), least)

    def spread(self, problem: Problem, u: np.ndarray, free: np.ndarray) -> Spread:
        """Uncertainty of the free fields: the priors count as measurements of the fields themselves."""
        _, jacobian = self.at(problem, u)
        size = np.sqrt(self.variance(problem, u, free))
        used = problem.weight > 0
        coordinates = problem.natural(u)[None]
        _, rows = self.with_priors(np.zeros((1, int(np.sum(used)))), jacobian[used][None] / size, coordinates)
        uncertainty = spread(rows[0], free, 1.0, self.options.level)
        return uncertainty._replace(quantile=self.quantile(uncertainty))

    def quantile(self, uncertainty: Spread) -> float:
        """Half-width of an interval in standard errors: that of the normal distribution where the errors are known."""
        if not self.options.known_errors or self.loss != "linear":
            return uncertainty.quantile
        from scipy import stats

        return float(stats.norm.ppf(0.5 + 0.5 * self.options.level))

    def covariance_of(self, slopes: np.ndarray, settled: Settled) -> np.ndarray:
        """Covariance of the coordinates from the priors and from values with this Jacobian, in standard deviations."""
        _, rows = self.with_priors(np.zeros((1, len(slopes))), slopes[None], settled.problem.natural(settled.u)[None])
        covariance = spread(rows[0], settled.held.free, 1.0, self.options.level).covariance
        return np.where(np.isfinite(covariance), covariance, 0.0)

    def undetermined(self, problem: Problem, u: np.ndarray, held: Held) -> tuple[int, str] | None:
        uncertainty = self.spread(problem, u, held.free)
        _, jacobian = self.at(problem, u)
        rows = jacobian[problem.weight > 0]
        return why_undetermined(uncertainty, rows, held.free, self.fields, problem.natural(u))

    def value_in_words(self, index: int, coordinate: float) -> str:
        from ..report.display import with_unit

        field = self.fields[index]
        return with_unit(float(field.value(coordinate)), field.unit)
