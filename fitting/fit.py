"""The fit: from measured curves and a scene to the oil's rheology with its uncertainty."""

import dataclasses
from collections.abc import Iterable
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.lubricants.ranges import FITTED_PRESSURE
from jaxbearing.machines import TwoDisk
from jaxbearing.numerics.garbage import rare_garbage_collection

from .estimation import Estimate, Problem, linearized
from .identifiability import confounded, elastic_conditions, implausible, in_words, not_determined, viscous_only
from .loss import influence, scale_of
from .measurements import Measurements
from .misfit import NOTHING, curve_fits, information, lack_of_fit, missed_share
from .options import FitOptions
from .parameters import GROUPS, NAMES, POSITIVE, SCALES, SYMBOLS, values_of, with_natural
from .result import FitResult, Parameter
from .search import Search
from .uncertainty import Spread, correlation
from .viscous import held_misfit, plain_rheology, with_viscous_function

OUTLIER = 4.0
"""Robust standard deviations beyond which a point is named an outlier."""
FEW_DEGREES = 3
"""Degrees of freedom below which the intervals are said to lean on little."""
FEWEST_DEGREES = 10
"""Degrees of freedom below which no point is called an outlier."""
MOST_TURNS = 12
"""Times that parameters may be held or released."""
SLACK = 1e-6
"""Correlation of residual and a column of the Jacobian below which a bound does not bind."""
SAME_LOSS = 1e-6
"""Relative difference of losses that count as the same minimum."""
EXACT = 1e-6
"""Residual, in assumed standard deviations, that is no residual at all."""


@rare_garbage_collection()
def fit(measurements: Measurements, scene: TwoDisk, options: FitOptions | None = None) -> FitResult:
    """Shear modulus and characteristic stress of the scene's oil from measured traction curves.

    The model is that of `jaxbearing.solve(scene)`. Start: stress and modulus from the shape of the curves
    (`start.estimated_start`), the best of a scan over the modulus, and random ones about them. Parameters that the data
    cannot tell are held at the scene's values and said so: by rule before (one pressure, one temperature, viscous
    only), by their uncertainty after. Several starts run at once; everything is compiled once for a number of points.

    **Raises:** `ValueError` for options that make no sense, and where the scene's oil has no rheology.
    """
    options = FitOptions() if options is None else options
    options.check()
    if scene.oil.rheology is None:
        raise ValueError("oil.rheology: found nothing, expected first values of shear modulus and stress")
    if not isinstance(scene.oil.rheology, ExponentialRheology):
        found = type(scene.oil.rheology).__name__
        raise ValueError(
            f"oil.rheology: found {found}, expected first values of the law 'exponential', which is fitted"
        )
    scene, model = with_viscous_function(scene, options.model)
    search = Search(measurements, scene, options)
    free, reasons = search.free_by_rule()
    viscous = viscous_only(search.deborah)
    modulus = [i for i in GROUPS[0] if free[i] and i not in search.insisted]
    if viscous and modulus and not search.elastic_part_shows(free):
        free[modulus] = False
        reasons |= dict.fromkeys(GROUPS[0], viscous)
    held = _Held(free, reasons, {})
    problem = search.problem(held.free, held.pinned)
    starts = search.starts(problem, held.free)
    turns = 0
    while True:
        problem, estimate, u = search.optimised(problem, starts)
        # each turn holds one more parameter, or lets one go from a bound that does not bind
        revised, turns = _revised(search, problem, u, held), turns + 1
        if revised is None:
            return _result(search, problem, u, estimate, held, model)
        if turns >= MOST_TURNS:
            lost = estimate._replace(converged=jnp.zeros_like(estimate.converged))
            return _result(search, problem, u, lost, held, model)
        moved = revised.pinned != held.pinned
        held = revised
        problem = search.problem(held.free, held.pinned, search.within_bounds(np.asarray(problem.natural(u))))
        # a parameter moved to its bound may lie far off, and the others must find their way anew
        starts = search.starts(problem, held.free) if moved else np.zeros((len(starts), len(NAMES)))
        if len(starts) > 1:
            starts[-1] = 0.0


def fit_models(
    measurements: Measurements, scene: TwoDisk, models: Iterable[str], options: FitOptions | None = None
) -> dict[str, FitResult]:
    """The same fit with each viscous function, for `comparison.compare`."""
    options = FitOptions() if options is None else options
    return {model: fit(measurements, scene, options._replace(model=model)) for model in models}


class _Held(NamedTuple):
    """Flags of the fitted parameters, reasons why others cannot be told, natural coordinates of those at a bound."""

    free: np.ndarray
    reasons: dict[int, str]
    pinned: dict[int, float]

    def without(self, index: int, reason: str, at: float | None = None) -> "_Held":
        free = self.free.copy()
        free[index] = False
        pinned = self.pinned if at is None else {**self.pinned, index: at}
        return _Held(free, {**self.reasons, index: reason}, pinned)

    def released(self, index: int) -> "_Held":
        free = self.free.copy()
        free[index] = True
        drop = lambda mapping: {i: value for i, value in mapping.items() if i != index}
        return _Held(free, drop(self.reasons), drop(self.pinned))


def _revised(search: Search, problem: Problem, u: Any, held: _Held) -> _Held | None:
    """Chooses the parameters to hold or release next: bounds first (an active set), then those that the data do not
    determine; `None` if nothing is left."""
    coordinates = np.asarray(problem.natural(u))
    low, high = search.limits
    beyond = np.where(held.free, np.maximum(low - coordinates, coordinates - high), -np.inf)
    index = int(np.argmax(beyond))
    if beyond[index] > 0.0:
        limit = float(low[index] if coordinates[index] < low[index] else high[index])
        return held.without(index, f"at its bound {values_of(np.full(len(NAMES), limit))[index]:g}", limit)
    _, residual, slopes = (np.asarray(part)[: search.count] for part in linearized(problem, u))
    downhill = -slopes.T @ influence(residual, search.options.loss)
    for index, at in held.pinned.items():
        inward = 1.0 if at == low[index] else -1.0
        if inward * downhill[index] > SLACK * np.linalg.norm(slopes[:, index]) * np.linalg.norm(residual):
            return held.released(index)
    judged = held.free & ~_insisted_blindly(search, held)
    elastic = elastic_conditions(search.pressure, search.temperature, search.deborah_at(coordinates))
    elastic = {i: reason for i, reason in elastic.items() if judged[i] and i not in search.insisted}
    if elastic and GROUPS[0][0] in np.flatnonzero(held.free):
        index = min(elastic)
        return held.without(index, elastic[index])
    spread = search.spread(problem, u, judged)
    if spread.degrees <= 0:
        return None
    found = not_determined(spread, np.asarray(problem.directions), judged, search.centre)
    found = {index: reason for index, reason in found.items() if index not in search.insisted}
    if not found:
        return None
    # coefficients first: with beta or alpha held the rest may well be determined
    index = max(found, key=lambda i: i % 3)
    return held.without(index, found[index])


def _insisted_blindly(search: Search, held: _Held) -> np.ndarray:
    """Mask of the parameters that are fitted only because the user insists: nothing is known of them, and the others'
    intervals hold for the values that they took."""
    return np.array([i in search.insisted and i in held.reasons and held.free[i] for i in range(len(NAMES))])


def _result(search: Search, problem: Problem, u: Any, estimate: Estimate, held: _Held, model: str) -> FitResult:
    free, reasons, pinned = held
    coordinates = np.asarray(problem.natural(u))
    blind = _insisted_blindly(search, held)
    spread = search.spread(problem, u, free & ~blind)
    predicted = search.predicted(coordinates)
    difference = predicted - search.coefficient
    standard = difference / search.deviation
    rheology = plain_rheology(with_natural(search.rheology, jnp.asarray(coordinates)), model, search.scene)
    oil = dataclasses.replace(search.scene.oil, rheology=rheology)
    losses = np.asarray(estimate.loss)
    best, index = float(np.nanmin(losses)), int(np.nanargmin(losses))
    exact = EXACT**2 * search.count
    agree = int(np.sum(losses <= best * (1.0 + SAME_LOSS) + exact))
    fitted = [i for i in range(len(NAMES)) if free[i]]
    judged = {i: r for i, r in reasons.items() if i not in pinned}
    aic, bic = information(difference, search.deviation, len(fitted))
    outlier = np.zeros(search.count, dtype=bool)
    if best > exact and spread.degrees >= FEWEST_DEGREES:
        size = scale_of(standard) * np.sqrt(search.count / spread.degrees)
        outlier = np.abs(standard) > OUTLIER * size

    why_none = ""
    if spread.degrees <= 0:
        why_none = "as many parameters as points that tell something"
    elif best <= exact:
        why_none = "the curves are met to rounding, and nothing tells their errors"
    notes = [in_words(i, reason) for i, reason in sorted(judged.items()) if NAMES[i] not in search.options.fixed]
    notes += [f"{SYMBOLS[i]} is at its bound and has no interval." for i in pinned]
    if why_none and fitted and best > exact:
        notes.append(f"No intervals: {why_none}.")
    conditions = [SYMBOLS[i] for i in sorted(judged) if not free[i] or blind[i]]
    if conditions and np.any(free & ~blind):
        notes.append(f"All intervals hold for these values of {', '.join(conditions)}.")
    notes += held_misfit(search.scene, tuple(NAMES[i] for i in fitted))
    notes += [confounded(search.pressure, search.temperature)]
    if best > exact:
        notes += lack_of_fit(search.measurements, standard, difference, outlier)
    if 0 < spread.degrees < FEW_DEGREES and not why_none:
        notes.append(f"Only {spread.degrees} points more than parameters: the intervals lean on very little.")
    centre = with_natural(search.rheology, jnp.asarray(coordinates))
    place = (search.centre.pressure, 1.0 / search.centre.inverse_temperature)
    notes += implausible(*(float(np.exp(law(*place))) for law in (centre.log_shear_modulus, centre.log_stress)))
    if np.max(search.pressure) > FITTED_PRESSURE:
        notes.append("mean contact pressure beyond 1.8 GPa: the traction rheology is extrapolated")
    if np.any(outlier):
        notes.append(f"{int(np.sum(outlier))} of {len(outlier)} points are outliers (beyond {OUTLIER:g} sigma).")
    if agree < len(losses):
        notes.append(f"{agree} of {len(losses)} starts ended at the best fit.")
    reason = ""
    if not fitted:
        said = "; ".join(in_words(i, why).rstrip(".") for i, why in sorted(judged.items()))
        reason = f"the {search.count} points cannot tell any parameter ({said})"
    elif not np.all(np.isfinite(predicted)):
        reason = "the model has no finite value at the end of the search"
    elif missed_share(search.measurements, difference, outlier) > NOTHING:
        reason = "no parameters found with which the model follows the curves"
    return FitResult(
        converged=bool(estimate.converged[index]) and not reason,
        reason=reason,
        model=model,
        method=search.options.method,
        rms=float(np.sqrt(np.mean(np.square(difference)))),
        parameters=_parameters(search, coordinates, spread, held, blind, why_none),
        unidentifiable=tuple(NAMES[i] for i in sorted(judged)),
        fitted=tuple(NAMES[i] for i in fitted),
        correlation=correlation(spread.covariance)[np.ix_(fitted, fitted)],
        covariance=spread.covariance[np.ix_(fitted, fitted)],
        condition=spread.condition,
        curves=curve_fits(search.measurements, search.state, search.scene, oil, difference),
        loss=best,
        steps=int(estimate.steps[index]),
        starts=(agree, len(losses)),
        aic=aic,
        bic=bic,
        oil=oil,
        measurements=search.measurements,
        predicted=predicted,
        deviation=search.deviation,
        outlier=outlier,
        level=search.options.level,
        notes=tuple(note for note in notes if note),
        scene=eqx.tree_at(lambda s: s.oil, search.scene, oil),
        options=search.options,
    )


def _parameters(
    search: Search, coordinates: np.ndarray, spread: Spread, held: _Held, blind: np.ndarray, why_none: str
) -> dict[str, Parameter]:
    values, found = values_of(coordinates), {}
    for index, name in enumerate(NAMES):
        deviation = np.sqrt(spread.covariance[index, index])
        half = spread.quantile * deviation
        if not held.free[index] or blind[index] or index in held.reasons or why_none or not np.isfinite(half):
            reason = held.reasons.get(index, why_none if held.free[index] else "held at the scene's value")
            found[name] = Parameter(float(values[index]), None, None, None, not bool(held.free[index]), reason)
            continue
        low, high = values_of(coordinates - half)[index], values_of(coordinates + half)[index]
        error = deviation * (values[index] if POSITIVE[index] else SCALES[index])
        found[name] = Parameter(float(values[index]), float(error), float(low), float(high), False)
    return found
