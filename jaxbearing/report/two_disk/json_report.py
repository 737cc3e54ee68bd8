"""Traction curves as plain numbers and texts, for JSON."""

from typing import Any

import numpy as np

from ...machines import TwoDiskSolution
from ...numerics.status import Status
from ..backends.json import finite, plain
from ..labels import labelled
from .curves import curves_of

_ONCE = ("status", "inner_residual", "deborah_number")
"""Results at each point of which only one number is written, for each curve or for all curves."""


def to_dict(solution: TwoDiskSolution) -> dict[str, Any]:
    """Dictionary of traction curves; see `report.json_report.solution_to_dict`.

    `deborah_number` of a curve is the value at the slide-to-roll ratio of smallest modulus. Points that failed are
    `None`; `converged` is True if no point failed.
    """
    slide = plain(solution.operation.slide_to_roll)
    along = {
        name: value for name, value, metadata in labelled(solution) if "slide" in metadata["dims"] and "." not in name
    }
    once = {
        name: plain(value) for name, value, metadata in labelled(solution) if metadata["derived"] and name not in along
    }
    curves = [
        {"slide_to_roll": slide}
        | {name: plain(curve.of(values)) for name, values in along.items() if name not in _ONCE}
        | {
            "pressure": finite(curve.pressure),
            "load": finite(curve.load),
            "entrainment_speed": finite(curve.entrainment_speed),
            "temperature": finite(curve.temperature),
            "deborah_number": finite(float(curve.of(solution.deborah_number)[curve.slowest])),
        }
        for curve in curves_of(solution)
    ]
    return {
        "converged": bool(solution.converged),
        "status": Status(int(np.max(np.asarray(solution.status)))).text,
        "warnings": list(solution.warnings),
        "inner_residual": finite(float(np.max(np.asarray(solution.inner_residual)))),
        "operation": plain(solution.operation),
        "curves": curves,
        **once,
    }
