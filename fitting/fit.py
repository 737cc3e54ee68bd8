"""The fit: from measured curves and a scene to the oil's rheology with its uncertainty."""

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from jaxbearing.machines import TwoDisk

from .estimation import Problem
from .identifiability import in_words, not_determined
from .loss import scale_of
from .measurements import Measurements
from .misfit import curve_fits, information, lack_of_fit
from .options import FitOptions
from .parameters import NAMES, POSITIVE, SCALES, SYMBOLS, values_of, with_natural
from .result import FitResult, Parameter
from .search import Search
from .uncertainty import correlation
from .viscous import plain_rheology, with_viscous_function

OUTLIER = 4.0
"""Robust standard deviations beyond which a point is named an outlier."""
SAME_LOSS = 1e-6
"""Relative difference of losses that count as the same minimum."""
EXACT = 1e-6
"""Residual, in assumed standard deviations, that is no residual at all."""


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
    scene, model = with_viscous_function(scene, options.model)
    search = Search(measurements, scene, options)
    free, reasons = search.free_by_rule()
    pinned: dict[int, float] = {}
    problem = search.problem(free, pinned)
    starts = search.starts(problem, free)
    while True:
        problem, estimate, u_best = search.optimised(problem, starts)
        # each turn holds one more parameter
        free, reasons, changed = _revised(search, problem, u_best, free, reasons, pinned)
        if not changed:
            return _result(search, problem, u_best, estimate, free, reasons, pinned, model)
        problem = search.problem(free, pinned, np.asarray(problem.natural(u_best)))
        starts = np.zeros((len(starts), len(NAMES)))


def fit_models(
    measurements: Measurements, scene: TwoDisk, models: Iterable[str], options: FitOptions | None = None
) -> dict[str, FitResult]:
    """The same fit with each viscous function, for `comparison.compare`."""
    options = FitOptions() if options is None else options
    return {model: fit(measurements, scene, options._replace(model=model)) for model in models}


def _revised(
    search: Search, problem: Problem, u: Any, free: np.ndarray, reasons: dict[int, str], pinned: dict[int, float]
) -> tuple[np.ndarray, dict[int, str], bool]:
    """Freezes what is outside its bounds, or else what the data do not determine."""
    coordinates = np.asarray(problem.natural(u))
    values = values_of(coordinates)
    for name, (low, high) in search.options.bounds.items():
        index = NAMES.index(name)
        below = low is not None and values[index] < low
        above = high is not None and values[index] > high
        if free[index] and (below or above):
            limit = float(low if below else high)  # pyright: ignore[reportArgumentType]
            free = free.copy()
            free[index] = False
            pinned[index] = float(np.log(limit)) if POSITIVE[index] else limit / float(SCALES[index])
            return free, {**reasons, index: f"at its bound {limit:g}"}, True
    found = not_determined(search.spread(problem, u, free), np.asarray(problem.directions), free, search.centre)
    insisted = {NAMES.index(name) for name in search.options.free}
    worst = {index: reason for index, reason in found.items() if index not in insisted}
    reasons = {**reasons, **{i: r for i, r in found.items() if i in insisted}}
    if not worst:
        return free, reasons, False
    # coefficients first: with beta or alpha held the rest may well be determined
    index = max(worst, key=lambda i: i % 3)
    free = free.copy()
    free[index] = False
    return free, {**reasons, index: worst[index]}, True


def _result(
    search: Search,
    problem: Problem,
    u: Any,
    estimate: Any,
    free: np.ndarray,
    reasons: Mapping[int, str],
    pinned: Mapping[int, float],
    model: str,
) -> FitResult:
    coordinates = np.asarray(problem.natural(u))
    spread = search.spread(problem, u, free)
    predicted = search.predicted(coordinates)
    difference = predicted - search.coefficient
    standard = difference / search.deviation
    rheology = plain_rheology(with_natural(search.rheology, jnp.asarray(coordinates)), model, search.scene)
    oil = dataclasses.replace(search.scene.oil, rheology=rheology)
    best = float(jnp.min(estimate.loss))
    index = int(jnp.argmin(jnp.where(jnp.isfinite(estimate.loss), estimate.loss, jnp.inf)))
    exact = EXACT**2 * len(search.coefficient)
    agree = int(jnp.sum(estimate.loss <= best * (1.0 + SAME_LOSS) + exact))
    fitted = [i for i in range(len(NAMES)) if free[i]]
    judged = {i: r for i, r in reasons.items() if i not in pinned}
    outlier = np.abs(standard) > OUTLIER * scale_of(standard)
    aic, bic = information(standard, len(fitted))
    notes = [in_words(i, reason) for i, reason in sorted(judged.items()) if NAMES[i] not in search.options.fixed]
    notes += [f"{SYMBOLS[i]} is at its bound and has no interval." for i in pinned]
    held = [SYMBOLS[i] for i in sorted(judged) if not free[i]]
    if held and fitted:
        notes.append(f"All intervals hold for the held values of {', '.join(held)}.")
    if best > exact:
        notes += lack_of_fit(search.measurements, standard, difference)
    if best > exact and np.any(outlier):
        notes.append(f"{int(np.sum(outlier))} of {len(outlier)} points are outliers (beyond {OUTLIER:g} sigma).")
    if agree < len(estimate.loss):
        notes.append(f"{agree} of {len(estimate.loss)} starts ended at the best fit.")
    return FitResult(
        converged=bool(estimate.converged[index]),
        model=model,
        method=search.options.method,
        rms=float(np.sqrt(np.mean(np.square(difference)))),
        parameters=_parameters(search, coordinates, spread, free, reasons),
        unidentifiable=tuple(NAMES[i] for i in sorted(judged)),
        fitted=tuple(NAMES[i] for i in fitted),
        correlation=correlation(spread.covariance)[np.ix_(fitted, fitted)],
        covariance=spread.covariance[np.ix_(fitted, fitted)],
        condition=spread.condition,
        curves=curve_fits(search.measurements, search.state, search.scene, oil, difference),
        loss=best,
        steps=int(estimate.steps[index]),
        starts=(agree, len(estimate.loss)),
        aic=aic,
        bic=bic,
        oil=oil,
        measurements=search.measurements,
        predicted=predicted,
        deviation=search.deviation,
        outlier=outlier,
        level=search.options.level,
        notes=tuple(notes),
        scene=eqx.tree_at(lambda s: s.oil, search.scene, oil),
        options=search.options,
    )


def _parameters(
    search: Search, coordinates: np.ndarray, spread: Any, free: np.ndarray, reasons: Mapping[int, str]
) -> dict[str, Parameter]:
    values, found = values_of(coordinates), {}
    for index, name in enumerate(NAMES):
        deviation = np.sqrt(spread.covariance[index, index])
        half = spread.quantile * deviation
        if not free[index] or index in reasons or not np.isfinite(half):
            reason = reasons.get(index, "held at the scene's value")
            found[name] = Parameter(float(values[index]), None, None, None, not bool(free[index]), reason)
            continue
        low, high = values_of(coordinates - half)[index], values_of(coordinates + half)[index]
        error = deviation * (values[index] if POSITIVE[index] else SCALES[index])
        found[name] = Parameter(float(values[index]), float(error), float(low), float(high), False)
    return found
