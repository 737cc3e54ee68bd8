"""Fit of an oil's rheology, with its uncertainty, to measured traction curves."""

import dataclasses
from collections.abc import Iterable

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array

from jaxbearing.lubricants.ranges import FITTED_PRESSURE
from jaxbearing.machines import TwoDisk
from jaxbearing.numerics.garbage import rare_garbage_collection

from .estimation import Estimate
from .holding import Held, settled
from .identifiability import confounded, implausible, in_words, viscous_only
from .loss import scale_of
from .measurements import Measurements
from .misfit import NOTHING, curve_fits, information, lack_of_fit, missed_share
from .options import FitOptions
from .parameters import GROUPS, NAMES, POSITIVE, SCALES, SYMBOLS, values_of, with_natural
from .result import FitResult, Parameter
from .search import Search
from .traction import Problem
from .uncertainty import Spread, correlation
from .viscous import held_misfit, plain_rheology, with_viscous_function

OUTLIER = 4.0
"""Robust standard deviations beyond which a point is named an outlier."""
FEW_DEGREES = 3
"""Informative points minus parameters below which a note says that the intervals rest on too few points."""
FEWEST_DEGREES = 10
"""Informative points minus parameters below which no point is called an outlier."""
SAME_LOSS = 1e-6
"""Relative difference of losses up to which two starts count as ended at the same minimum."""
EXACT = 1e-6
"""Root mean square residual, in assumed standard deviations, below which the curves count as met exactly."""


@rare_garbage_collection()
def fit(measurements: Measurements, scene: TwoDisk, options: FitOptions | None = None) -> FitResult:
    """Shear modulus and characteristic stress of the scene's oil from measured traction curves.

    The model is that of `jaxbearing.solve(scene)` with the exponential law of the rheology. If the oil has another law,
    as standard oils have, the first values are those of the exponential law that is tangent to it in the middle of the
    data (`start.exponential_about`). Starting points: stress and modulus from the shape of the curves
    (`start.estimated_start`), the best of a scan over the modulus, and random points about them. Parameters that the
    data do not determine are held at the scene's values, and a note says so: before the fit by rule (one pressure, one
    temperature, viscous data only), after it by their uncertainty. The starts run together; the program is compiled
    once for each (rounded) number of points.

    **Raises:** `TypeError` for arguments of another kind; `ValueError` for options that make no sense, and where the
    scene's oil has no rheology.
    """
    for name, value, kind in (("measurements", measurements, Measurements), ("scene", scene, TwoDisk)):
        if not isinstance(value, kind):
            raise TypeError(f"fit: {name} must be {kind.__name__}, got {type(value).__name__}")
    options = FitOptions() if options is None else options
    options.check()
    if scene.oil.rheology is None:
        raise ValueError("oil.rheology: found nothing, expected first values of shear modulus and stress")
    scene, model = with_viscous_function(scene, options.model)
    search = Search(measurements, scene, options)
    free, reasons = search.free_by_rule()
    viscous = viscous_only(search.deborah)
    modulus = [i for i in GROUPS[0] if free[i] and i not in search.insisted]
    if viscous and modulus and not search.elastic_part_shows(free):
        free[modulus] = False
        reasons |= dict.fromkeys(GROUPS[0], viscous)
    outcome = settled(search, Held(free, reasons, {}))
    estimate = outcome.estimate
    if not outcome.ended:
        estimate = estimate._replace(converged=jnp.zeros_like(estimate.converged))
    touched = "" if search.scene is scene else _tangent_note(search)
    return _result(search, outcome.problem, outcome.u, estimate, outcome.held, model, touched)


def _tangent_note(search: Search) -> str:
    pressure, temperature = 1e-9 * search.centre.pressure, 1.0 / search.centre.inverse_temperature
    return (
        "The first values are those of the exponential law that touches the law of the scene's oil in the middle of "
        f"the data, at a mean pressure of {pressure:.3g} GPa and at {temperature:.4g} K."
    )


def fit_models(
    measurements: Measurements, scene: TwoDisk, models: Iterable[str], options: FitOptions | None = None
) -> dict[str, FitResult]:
    """Fits of the same measurements with several viscous functions, by name, for `comparison.compare`."""
    options = FitOptions() if options is None else options
    return {model: fit(measurements, scene, options._replace(model=model)) for model in models}


def _result(
    search: Search, problem: Problem, u: Array, estimate: Estimate, held: Held, model: str, touched: str
) -> FitResult:
    free, reasons, pinned = held
    coordinates = np.asarray(problem.natural(u))
    blind = search.insisted_blindly(held)
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
    notes = [touched] if touched else []
    notes += [in_words(i, reason) for i, reason in sorted(judged.items()) if NAMES[i] not in search.options.fixed]
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
    undetermined = not fitted and bool(np.all(np.isfinite(predicted)))
    if undetermined:
        text = "; ".join(in_words(i, why).rstrip(".") for i, why in sorted(judged.items()))
        reason = f"the {search.count} points cannot tell any parameter ({text})"
    elif not np.all(np.isfinite(predicted)):
        reason = "the model has no finite value at the end of the search"
    elif missed_share(search.measurements, difference, outlier) > NOTHING:
        reason = "no parameters found with which the model follows the curves"
    return FitResult(
        converged=bool(estimate.converged[index]) and not reason,
        reason=reason,
        undetermined=undetermined,
        first_values=touched,
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
    search: Search, coordinates: np.ndarray, spread: Spread, held: Held, blind: np.ndarray, why_none: str
) -> dict[str, Parameter]:
    values, parameters = values_of(coordinates), {}
    for index, name in enumerate(NAMES):
        deviation = np.sqrt(spread.covariance[index, index])
        half = spread.quantile * deviation
        if not held.free[index] or blind[index] or index in held.reasons or why_none or not np.isfinite(half):
            reason = held.reasons.get(index, why_none if held.free[index] else "held at the scene's value")
            parameters[name] = Parameter(float(values[index]), None, None, None, not bool(held.free[index]), reason)
            continue
        low, high = values_of(coordinates - half)[index], values_of(coordinates + half)[index]
        error = deviation * (values[index] if POSITIVE[index] else SCALES[index])
        parameters[name] = Parameter(float(values[index]), float(error), float(low), float(high), False)
    return parameters
