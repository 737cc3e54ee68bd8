"""A bearing's solution as plain numbers and texts. The keys are the field names of the result classes: new results
appear here automatically."""

from typing import Any

import numpy as np

from ...bearings.solution import RING_FREEDOMS, Solution
from ...numerics.status import Status
from ..backends.json import finite, names_of, plain
from .facts import left_out_couple
from .operation import unused_operation

_INSIDE = (
    "status",
    "worst_equation",
    "force",
    "stiffness",
    "checks",
    "ring_freedom",
    "equation_names",
    "notes",
    "laminae",
    "failure_causes",
)
_NAMES = ("stiffness_freedom", "held_freedom", "element_name")
"""Names that are not written as results of their own."""


def to_dict(solution: Solution) -> dict[str, Any]:
    """See `report.json_report.solution_to_dict`.

    Parts that the scene does not model are `None`; inside a part, results that are not modelled are left out. If the
    solve failed, `converged` is false and all results are `None`. The oil temperature and flow are `None` if nothing
    uses them.
    """
    converged = bool(solution.converged)
    results: dict[str, Any] = {
        "converged": converged,
        "status": Status(int(solution.status)).text,
        "warnings": list(solution.warnings),
        "not_modelled": [*solution.not_modelled, *(["gyroscopic_couple"] if left_out_couple(solution) else [])],
    }
    for name in names_of(solution):
        if name not in (*_INSIDE, *_NAMES) and not name.startswith("global_"):
            results[name] = plain(getattr(solution, name))
    results["operation"] |= dict.fromkeys(unused_operation(solution))
    # the key is always there: without friction in the scene it is `None`, which is not a loss of 0
    results["power_loss"].setdefault("total", None)
    modelled = [name in solution.freedoms_of_stiffness for name in RING_FREEDOMS]
    results["force"] = finite(np.where(modelled, np.asarray(solution.force), np.nan).tolist())
    results["stiffness"] = modelled_only(np.asarray(solution.stiffness), solution.freedoms_of_stiffness)
    results["worst_equation"] = solution.equation_names[int(solution.worst_equation)]
    results.setdefault("life", None)
    return results


def modelled_only(stiffness: np.ndarray, freedoms: tuple[str, ...]) -> list[Any]:
    """The stiffness of all five degrees of freedom, for any number of bearings; `None` for degrees of freedom that are
    not modelled."""
    modelled = np.asarray([name in freedoms for name in RING_FREEDOMS])
    return finite(np.where(modelled[:, None] & modelled, stiffness, np.nan).tolist())
