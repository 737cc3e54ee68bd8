"""Comparison of viscous functions for measured curves: misfit, information criteria, prediction of curves left out."""

from collections.abc import Mapping
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np

from jaxbearing.lubricants import ExponentialRheology

from .estimation import held_out
from .identifiability import frozen_by_rule
from .parameters import NAMES, natural
from .result import FitResult
from .search import Search

DISPLACED = np.array([0.7, -1.0, -0.5, -0.7, 0.5, 0.2])
"""Displacement of the start of each leave-one-out fit from the fit of all curves, in natural coordinates."""


class ModelRow(NamedTuple):
    """Figures of merit of one model: `rms` of the fit, number of fitted `parameters`, `aic` and `bic` (the lowest is
    best; a difference of 10 is strong evidence), and `cross_validated_rms`, see the function of that name."""

    model: str
    converged: bool
    rms: float
    parameters: int
    aic: float
    bic: float
    cross_validated_rms: float | None


def compare(results: Mapping[str, FitResult]) -> list[ModelRow]:
    """A row for every fit of the same measurements, the lowest BIC first. **Arguments:** `results`: by model."""
    rows = [
        ModelRow(
            model=model,
            converged=result.converged,
            rms=result.rms,
            parameters=len(result.fitted),
            aic=result.aic,
            bic=result.bic,
            cross_validated_rms=cross_validated_rms(result),
        )
        for model, result in results.items()
    ]
    return sorted(rows, key=lambda row: (not row.converged, row.bic))


def cross_validated_rms(result: FitResult) -> float | None:
    """Root mean square of model minus measurement when every curve is predicted from a fit of the others.

    The same parameters are fitted as in the result. The start is displaced from the result, because the result already
    contains the curve that is left out. None for a single curve, or where the remaining curves do not have enough
    different pressures or temperatures for the fit. Infinite where a fit without one of the curves does not converge.
    """
    curve = np.asarray(result.measurements.curve)
    if len(result.measurements.curve_names) < 2 or not result.fitted:
        return None
    search = Search(result.measurements, result.scene, result.options)
    search.deviation = result.deviation
    free = np.array([name in result.fitted for name in NAMES])
    rheology = result.oil.rheology
    assert isinstance(rheology, ExponentialRheology)
    others = curve[None, :] != np.arange(len(result.measurements.curve_names))[:, None]
    held = (not free[0], not free[3])
    for kept in others:
        if any(free[i] for i in frozen_by_rule(search.pressure[kept], search.temperature[kept], held)):
            return None
    problem = search.problem(free, {}, np.where(free, natural(rheology) + DISPLACED, natural(rheology)))
    without = search.weight(others.astype(float))
    predicted, converged = held_out(problem, without, result.options.method)
    if not bool(jnp.all(converged)):
        return float("inf")
    own = np.asarray(predicted)[curve, np.arange(len(curve))]
    return float(np.sqrt(np.mean(np.square(own - search.coefficient))))
