"""Predictions with calibrated fields: results of another operating point, or of another bearing with the same fields,
with the intervals that follow from the calibration."""

import dataclasses
from collections.abc import Mapping, Sequence

import numpy as np

from fitting.posterior import Posterior
from fitting.predictive import PREDICTED, chosen_samples

from .._scene import AbstractScene
from ..distribution import Distribution
from ..joint import JointDistribution
from ..numerics.newton import NewtonOptions
from .evaluation import Evaluator
from .labels import labels_in
from .parameters import scenes_with
from .result import Calibration


@dataclasses.dataclass(frozen=True)
class Predicted:
    """One predicted result, SI: value with the calibrated fields, its standard deviation and the ends of its interval.

    `before`: the same with the priors alone; `None` where a field has no prior. `samples`: number of posterior samples
    whose median, standard deviation and quantiles these are; 0: they come from the delta method.
    """

    value: float
    deviation: float
    lower: float
    upper: float
    unit: str
    before: "Predicted | None" = None
    samples: int = 0


def predict(
    found: Calibration,
    scene: AbstractScene,
    results: Sequence[str],
    newton: NewtonOptions | None = None,
    posterior: Posterior | None = None,
) -> dict[str, Predicted]:
    """Results of a scene with the calibrated fields, by the delta method with the covariance of all fields, or with
    samples of their posterior; both include the correlation of the fields. The interval does not contain the error of a
    measurement.

    **Arguments:** `found`: a calibration that converged; `scene`: any scene with one or more of its fields; `results`:
    names as in `jaxbearing.tolerances`; `posterior`: of the calibration; 200 of its samples are solved.

    **Raises:** `ValueError` for a calibration without a result, for a scene without any of the fields, for a name that
    is no result, and where a solve fails.
    """
    if not found.converged:
        raise ValueError(found.failure())
    fields = [field for field in found.fields if scenes_with([scene], field.path)]
    if not fields:
        raise ValueError(
            f"scene: found none of the calibrated fields {', '.join(found.parameters)}; expected one or more"
        )
    labels = dict(labels_in(scene, results, newton).values())
    options = NewtonOptions() if newton is None else newton
    evaluator = Evaluator(scene, [field.path for field in fields], labels, options)
    order = [field.path for field in found.fields]
    coordinates = np.asarray(found.settled.problem.natural(found.settled.u))
    covariance = np.where(np.isfinite(found.covariance), found.covariance, 0.0)
    quantile = found.search.quantile(
        found.search.spread(found.settled.problem, found.settled.u, found.settled.held.free)
    )
    if posterior is None:
        after = _at(found, evaluator, order, coordinates, covariance, quantile)
    else:
        after = _by_samples(found, evaluator, order, coordinates, posterior)
    known = found.search.prior_deviation
    own = [order.index(path) for path in evaluator.paths]
    if not np.all(np.isfinite(known[own])):
        return after
    from scipy import stats

    normal = float(stats.norm.ppf(0.5 + 0.5 * found.options.level))
    prior = np.diag(np.square(np.where(np.isfinite(known), known, 0.0)))
    before = _at(found, evaluator, order, found.search.prior_mean, prior, normal)
    return {name: dataclasses.replace(result, before=before[name]) for name, result in after.items()}


def _at(
    calibration: Calibration,
    evaluator: Evaluator,
    order: list[str],
    coordinates: np.ndarray,
    covariance: np.ndarray,
    quantile: float,
) -> dict[str, Predicted]:
    own = [order.index(path) for path in evaluator.paths]
    values = np.array([[float(calibration.fields[i].value(coordinates[i])) for i in own]])
    chain = np.array([float(calibration.fields[i].slope(coordinates[i])) for i in own])
    results, slopes = evaluator({}, values, np.ones(1, dtype=bool))
    if not np.all(np.isfinite(results)):
        raise ValueError("scene: found no solution with the calibrated fields")
    along = slopes[0] * chain[:, None]
    part = covariance[np.ix_(np.array(own), np.array(own))]
    deviation = np.sqrt(np.einsum("fr,fg,gr->r", along, part, along))
    predicted = {}
    for place, (name, label) in enumerate(evaluator.labels.items()):
        value, half = float(results[0, place]), quantile * float(deviation[place])
        predicted[name] = Predicted(value, float(deviation[place]), value - half, value + half, label.unit)
    return predicted


def _by_samples(
    calibration: Calibration, evaluator: Evaluator, order: list[str], coordinates: np.ndarray, posterior: Posterior
) -> dict[str, Predicted]:
    """Median, standard deviation and quantiles of the results with samples of the posterior; fields without samples
    keep their values."""
    place = chosen_samples(posterior, PREDICTED)
    parameters = list(posterior.parameters)
    drawn = posterior.values.reshape(-1, len(parameters))[place]
    columns = []
    for path in evaluator.paths:
        i = order.index(path)
        own = (
            drawn[:, parameters.index(path)]
            if path in parameters
            else np.full(len(place), calibration.fields[i].value(coordinates[i]))
        )
        columns.append(own)
    results, _ = evaluator({}, np.stack(columns, axis=1), np.ones(len(place), dtype=bool))
    failed = int(np.sum(~np.all(np.isfinite(results), axis=1)))
    if failed:
        raise ValueError(f"scene: found no solution with {failed} of {len(place)} samples of the posterior")
    tail = 0.5 - 0.5 * posterior.level
    lower, median, upper = np.quantile(results, (tail, 0.5, 1.0 - tail), axis=0)
    deviation = np.std(results, axis=0)
    return {
        name: Predicted(
            value=float(median[i]),
            deviation=float(deviation[i]),
            lower=float(lower[i]),
            upper=float(upper[i]),
            unit=label.unit,
            samples=len(place),
        )
        for i, (name, label) in enumerate(evaluator.labels.items())
    }


def distributions_of(found: Calibration) -> Mapping[str, Distribution]:
    """The fitted fields as distributions for `jaxbearing.tolerances`: lognormal for positive fields, normal for others.
    They are independent there, whereas `predict` and `joint_of` include the correlation of the fields."""
    coordinates = np.asarray(found.settled.problem.natural(found.settled.u))
    made = {}
    for i, field in enumerate(found.fields):
        if field.path not in found.fitted:
            continue
        deviation = float(np.sqrt(found.covariance[i, i]))
        value = float(field.value(coordinates[i]))
        if field.positive:
            made[field.path] = Distribution.lognormal(value, deviation)
        else:
            made[field.path] = Distribution(value, deviation * field.scale)
    return made


def joint_of(found: Calibration, posterior: Posterior | None = None) -> JointDistribution:
    """The fitted fields as one joint distribution, with their correlation, for `jaxbearing.tolerances`.

    **Arguments:** `found`: a calibration that converged; `posterior`: its samples give the distribution; `None`: it is
    normal in the coordinates, with the covariance of least squares.

    **Raises:** `ValueError` for a calibration without a result, and where no field was fitted.
    """
    if not found.converged:
        raise ValueError(found.failure())
    if not found.fitted:
        raise ValueError("the measurements tell none of the fields")
    place = [i for i, field in enumerate(found.fields) if field.path in found.fitted]
    fields = [found.fields[i] for i in place]
    positive = np.array([field.positive for field in fields])
    if posterior is not None:
        order = [list(posterior.parameters).index(field.path) for field in fields]
        values = posterior.values.reshape(-1, posterior.values.shape[-1])[:, order]
        return JointDistribution.of_samples([field.path for field in fields], values, positive)
    coordinates = np.asarray(found.settled.problem.natural(found.settled.u))
    centre = np.array([float(field.value(coordinates[i])) for i, field in zip(place, fields, strict=True)])
    scale = np.array([1.0 if field.positive else field.scale for field in fields])
    covariance = found.covariance[np.ix_(place, place)] * np.outer(scale, scale)
    return JointDistribution(tuple(field.path for field in fields), centre, positive, covariance)
