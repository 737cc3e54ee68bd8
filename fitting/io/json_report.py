"""A fit as plain numbers and texts in SI units, ready for `json.dumps`."""

from collections.abc import Iterable
from typing import Any

import numpy as np

from jaxbearing.report.backends.json import plain

from ..comparison import ModelRow
from ..result import FitResult


def fit_to_dict(
    result: FitResult,
    data: str = "",
    scene: str = "",
    notes: Iterable[str] = (),
    oil: str | None = None,
    comparison: Iterable[ModelRow] = (),
) -> dict[str, Any]:
    """All results of a fit, SI units; numbers that are not finite are `None`.

    **Arguments:**
    - `data`, `scene`: names of the file and the scene.
    - `notes`: notes on the file and the scene, which follow those of the fit.
    - `oil`: file that the oil was written to.
    - `comparison`: rows of all models that were compared; `result` is that of the best.

    Where the fit did not converge its numbers are `None`, because the last iterate is not a result. Where the data
    determine no parameter, the numbers are those of the first values.
    """
    good = result.converged or result.undetermined
    shown = lambda value: plain(value) if good else None
    parameters = {
        name: {
            "value": plain(parameter.value) if good or parameter.fixed else None,
            "standard_error": shown(parameter.standard_error),
            "lower": shown(parameter.lower),
            "upper": shown(parameter.upper),
            "fixed": parameter.fixed,
            "reason": parameter.reason,
        }
        for name, parameter in result.parameters.items()
    }
    curves = [curve._asdict() | {"rms": curve.rms if good else None} for curve in result.curves]
    results = {
        "converged": result.converged,
        "status": result.status,
        "rms": shown(result.rms),
        "parameters": parameters,
        "unidentifiable": list(result.unidentifiable),
        "data": data,
        "scene": scene,
        "points": len(result.predicted),
        "outliers": int(np.sum(result.outlier)) if good else None,
        "model": result.model,
        "method": result.method,
        "loss": result.options.loss,
        "steps": result.steps,
        "starts": {"agreeing": result.starts[0], "total": result.starts[1]},
        "level": result.level,
        "condition": shown(result.condition),
        "aic": shown(result.aic),
        "bic": shown(result.bic),
        "fitted": list(result.fitted),
        "correlation": shown(result.correlation),
        "curves": plain(curves),
        "notes": [*([] if result.converged else [result.failure()]), *(result.notes if good else []), *notes],
        "oil": oil,
    }
    rows = [row._asdict() for row in comparison]
    return results | ({"comparison": plain(rows)} if rows else {})
