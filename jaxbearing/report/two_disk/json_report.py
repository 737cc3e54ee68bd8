"""Traction curves as plain numbers and texts."""

from typing import Any

import numpy as np

from ...machines import TwoDiskSolution
from ...numerics.status import Status
from ..plain import finite, plain
from .curves import curves_of

_ALONG = ("traction_coefficient", "film", "inlet_temperature", "power", "film_rise", "surface_rise")
"""Results that a curve has for each slide-to-roll ratio."""


def two_disk_to_dict(solution: TwoDiskSolution) -> dict[str, Any]:
    """See `report.json_report.solution_to_dict`.

    `deborah_number` of a curve is that at its smallest slide. Points that failed are `None`; `converged` says whether
    all points are there.
    """
    slide = plain(solution.operation.slide_to_roll)
    curves = []
    for curve in curves_of(solution):
        known = [name for name in _ALONG if getattr(solution, name) is not None]
        curves.append(
            {"slide_to_roll": slide}
            | {name: plain(curve.of(getattr(solution, name))) for name in known}
            | {
                "pressure": finite(curve.pressure),
                "load": finite(curve.load),
                "entrainment_speed": finite(curve.entrainment_speed),
                "temperature": finite(curve.temperature),
                "deborah_number": finite(float(curve.of(solution.deborah_number)[curve.slowest])),
            }
        )
    return {
        "converged": bool(solution.converged),
        "status": Status(int(np.max(np.asarray(solution.status)))).text,
        "warnings": list(solution.warnings),
        "inner_residual": finite(float(np.max(np.asarray(solution.inner_residual)))),
        "operation": plain(solution.operation),
        "curves": curves,
    }
