"""A solution as plain numbers and texts in SI units, ready for `json.dumps`.

The keys are the field names of the result classes: a new result appears here without a change.
"""

import dataclasses
import math
from typing import Any

import numpy as np

from ..bearings.solution import RING_FREEDOMS, Solution
from ..numerics.status import Status
from ..sensitivity import Sensitivities, largest
from .operation import unused_operation

_INSIDE = ("status", "worst_equation", "stiffness", "checks", "ring_freedom", "equation_names", "notes")
"""Fields that are not written as they are, but in words or in another order, or not at all."""


def solution_to_dict(solution: Solution) -> dict[str, Any]:
    """All results of one solution, SI units and radians; numbers that are not finite are `None`.

    Parts that the scene does not model are left out, except `cage`, which is `None` then. Where the solve failed,
    `converged` is false and all results are `None`. So are the oil's temperature and flow where nothing uses them.
    """
    converged = bool(solution.converged)
    results: dict[str, Any] = {
        "converged": converged,
        "status": Status(int(solution.status)).text,
        "warnings": list(solution.warnings),
    }
    for name in _field_names(solution):
        if name not in _INSIDE and not name.startswith("global_"):
            results[name] = _plain(getattr(solution, name))
    results["operation"] |= dict.fromkeys(unused_operation(solution))
    results["stiffness"] = _embedded(np.asarray(solution.stiffness), solution.ring_freedom)
    results["worst_equation"] = solution.equation_names[int(solution.worst_equation)]
    results["life"] = None
    return results


def sensitivities_to_dict(sensitivities: Sensitivities) -> dict[str, Any]:
    """Sensitivities of the two results to every input, largest modulus first; those that are not finite are `None`."""
    named = {"power_loss.total": sensitivities.power_loss, "cage.slip": sensitivities.slip}
    return {
        result: {path: _plain(values[path]) for path in dict.fromkeys([*largest(values, len(values)), *values])}
        for result, values in named.items()
    }


def _field_names(part: Any) -> list[str]:
    return [field.name for field in dataclasses.fields(part)]


def _plain(value: Any) -> Any:
    """Numbers, arrays and classes of the library as JSON has them."""
    if value is None or isinstance(value, bool | str):
        return value
    if dataclasses.is_dataclass(value):
        parts = {name: getattr(value, name) for name in _field_names(value)}
        return {name: _plain(part) for name, part in parts.items() if part is not None}
    if isinstance(value, dict):
        return {str(key): _plain(part) for key, part in value.items()}
    if isinstance(value, tuple | list):
        return [_plain(part) for part in value]
    return _numbers(np.asarray(value).tolist())


def _numbers(value: Any) -> Any:
    if isinstance(value, list):
        return [_numbers(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _embedded(stiffness: np.ndarray, freedoms: tuple[str, ...]) -> list[list[float | None]]:
    """The stiffness of the active freedoms inside that of all five, `None` where the model has none."""
    full: list[list[float | None]] = [[None] * len(RING_FREEDOMS) for _ in RING_FREEDOMS]
    places = [RING_FREEDOMS.index(name) for name in freedoms]
    for row, i in zip(stiffness.tolist(), places, strict=True):
        for entry, j in zip(row, places, strict=True):
            full[i][j] = _numbers(entry)
    return full
