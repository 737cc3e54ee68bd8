"""A line contact as plain numbers and texts."""

from typing import Any

from ...ehl import LineContactSolution
from ...numerics.status import Status
from ..backends.json import finite, plain
from ..labels import labelled


def to_dict(solution: LineContactSolution) -> dict[str, Any]:
    """See `report.json_report.solution_to_dict`."""
    results = {
        "converged": bool(solution.converged),
        "status": Status(int(solution.status)).text,
        "warnings": list(solution.warnings),
        "iterations": int(solution.iterations),
        "residual_norm": finite(float(solution.residual_norm)),
        "last_step": finite(float(solution.last_step)),
        "unknowns": solution.unknowns,
        "operation": plain(solution.operation),
        "film": plain(solution.film),
        "hertz": plain(solution.hertz),
        "profile": plain(solution.profile),
        "formulas": plain(solution.formulas),
    }
    others = {path: plain(value) for path, value, _ in labelled(solution) if path not in results and "." not in path}
    return results | others
