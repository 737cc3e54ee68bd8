"""A solution as plain numbers and texts in SI units, ready for `json.dumps`."""

import functools
from typing import Any

from ..bearings.solution import Solution
from ..ehl import LineContactSolution
from ..machines import TwoDiskSolution
from ..sensitivity import Sensitivities, largest
from .bearing.json_report import bearing_to_dict
from .line_contact.json_report import line_contact_to_dict
from .plain import plain
from .two_disk.json_report import two_disk_to_dict


@functools.singledispatch
def solution_to_dict(solution: Any) -> dict[str, Any]:
    """All results of one solution, SI units and radians; numbers that are not finite are `None`.

    **Raises:** `TypeError` for another kind of solution.
    """
    raise TypeError(f"no JSON of a {type(solution).__name__}")


solution_to_dict.register(Solution, bearing_to_dict)
solution_to_dict.register(TwoDiskSolution, two_disk_to_dict)
solution_to_dict.register(LineContactSolution, line_contact_to_dict)


RESULTS = {
    "power_loss": "power_loss.total",
    "slip": "cage.slip",
    "life": "life.L10r",
    "modified_life": "life.Lnmr",
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
