"""Predictions of a calibrated scene: results of another operating point, or of another bearing with the same fields,
with the interval that the calibration leaves."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .._scene import AbstractScene
from ..distribution import Distribution
from ..numerics.newton import NewtonOptions
from .evaluation import Evaluator
from .labels import labels_in
from .parameters import scenes_with
from .result import Calibration


@dataclass(frozen=True)
class Predicted:
    """One result, SI: its value with the calibrated fields, standard deviation and ends of the interval that these
    leave, and the same with what was known before, the priors; `None` where a field has no prior."""

    value: float
    deviation: float
    lower: float
    upper: float
    unit: str
    before: "Predicted | None" = None


def predict(
    found: Calibration, scene: AbstractScene, results: Sequence[str], newton: NewtonOptions | None = None
) -> dict[str, Predicted]:
    """Results of a scene with the calibrated fields, by the delta method with the covariance of all fields: what they
    share is counted as it is. The interval is that of the mean, without an error of measurement.

    **Arguments:** `found`: a calibration that converged; `scene`: any that has one or more of its fields; `results`: as
    those of `jaxbearing.tolerances`.

    **Raises:** `ValueError` for a calibration without a result, for a scene without any of the fields, for a name that
    is no result, and where the solve fails.
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
    after = _at(found, evaluator, order, coordinates, covariance, quantile)
    known = found.search.prior_deviation
    own = [order.index(path) for path in evaluator.paths]
    if not np.all(np.isfinite(known[own])):
        return after
    from scipy import stats

    normal = float(stats.norm.ppf(0.5 + 0.5 * found.options.level))
    prior = np.diag(np.square(np.where(np.isfinite(known), known, 0.0)))
    before = _at(found, evaluator, order, found.search.prior_mean, prior, normal)
    return {
        name: Predicted(one.value, one.deviation, one.lower, one.upper, one.unit, before[name])
        for name, one in after.items()
    }


def _at(
    found: Calibration,
    evaluator: Evaluator,
    order: list[str],
    coordinates: np.ndarray,
    covariance: np.ndarray,
    quantile: float,
) -> dict[str, Predicted]:
    own = [order.index(path) for path in evaluator.paths]
    values = np.array([[float(found.fields[i].value(coordinates[i])) for i in own]])
    chain = np.array([float(found.fields[i].slope(coordinates[i])) for i in own])
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


def distributions_of(found: Calibration) -> Mapping[str, Distribution]:
    """The told fields as distributions, for `jaxbearing.tolerances`: lognormal ones of positive fields, normal ones of
    others. They are independent there, while `predict` counts what the fields share."""
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
