"""A solution as plain numbers and texts in SI units, ready for `json.dumps`."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..sensitivity import Sensitivities, UsualTolerance, largest
from .backends.json import plain
from .registry import output
from .round_off import without_round_off

if TYPE_CHECKING:
    from .._scene import AbstractSolution


def solution_to_dict(solution: "AbstractSolution") -> dict[str, Any]:
    """All results of one solution, SI units and radians; numbers that are not finite are `None`.

    Numbers below the resolution of the solve are 0, as on the screen (`report.round_off`).

    **Raises:** `TypeError` for another kind of solution.
    """
    return output(solution, "json_report", "JSON")(without_round_off(solution))


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
"""Field of `Sensitivities` -> the result that it is about."""


def sensitivities_to_dict(sensitivities: Sensitivities) -> dict[str, Any]:
    """Sensitivities of each result to every input, largest absolute value first; values that are not finite are `None`.
    Results that the scene does not model are left out."""
    return {
        RESULTS[name]: {path: plain(values[path]) for path in dict.fromkeys([*largest(values, len(values)), *values])}
        for name, values in sensitivities.modelled().items()
    }


def effects_to_dict(
    effects: Mapping[str, Mapping[str, float]], tolerances: Mapping[str, UsualTolerance]
) -> dict[str, Any]:
    """Changes of each result due to the usual tolerance of each input, largest first: `effect`, relative to the result
    (absolute for slip and temperature), `tolerance`, SI, and its `reason`."""
    return {
        RESULTS[name]: {
            path: {"effect": plain(value), "tolerance": tolerances[path].size, "reason": tolerances[path].reason}
            for path, value in sorted(changes.items(), key=lambda change: -abs(change[1]))
        }
        for name, changes in effects.items()
    }
