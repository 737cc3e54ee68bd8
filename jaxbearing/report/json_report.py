"""A solution as plain numbers and texts in SI units, ready for `json.dumps`."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..sensitivity import Sensitivities, UsualTolerance, largest
from .backends.json import plain
from .registry import output

if TYPE_CHECKING:
    from .._scene import AbstractSolution


def solution_to_dict(solution: "AbstractSolution") -> dict[str, Any]:
    """All results of one solution, SI units and radians; numbers that are not finite are `None`.

    **Raises:** `TypeError` for another kind of solution.
    """
    return output(solution, "json_report", "JSON")(solution)


RESULTS = {
    "power_loss": "power_loss.total",
    "slip": "cage.slip",
    "life": "life.L10r",
    "modified_life": "life.Lnmr",
    "stiffness": "stiffness.radial",
    "axial_stiffness": "stiffness.axial",
    "temperature": "thermal.temperatures",
    "film": "film.central",
    "traction": "traction_coefficient",
}
"""Fields of `Sensitivities` and the results that they are about."""


def sensitivities_to_dict(sensitivities: Sensitivities) -> dict[str, Any]:
    """Sensitivities of each result to every input, largest modulus first; those that are not finite are `None`.
    Results that the scene does not have are left out."""
    return {
        RESULTS[name]: {path: plain(values[path]) for path in dict.fromkeys([*largest(values, len(values)), *values])}
        for name, values in sensitivities.modelled().items()
    }


def effects_to_dict(
    effects: Mapping[str, Mapping[str, float]], tolerances: Mapping[str, UsualTolerance]
) -> dict[str, Any]:
    """By how much each result moves for the usual tolerance of each input, the largest first: `effect`, relative to the
    result (slip and temperature: absolute), `tolerance`, SI, and its `reason`."""
    return {
        RESULTS[name]: {
            path: {"effect": plain(value), "tolerance": tolerances[path].size, "reason": tolerances[path].reason}
            for path, value in sorted(found.items(), key=lambda one: -abs(one[1]))
        }
        for name, found in effects.items()
    }
