"""Solution of a shaft as plain numbers and texts, for JSON."""

from typing import Any

from ...numerics.status import Status
from ...shafts.solution import BearingOnShaft, DutyResult, ShaftSolution
from ..backends.json import finite, plain
from ..bearing.json_report import to_dict as bearing_to_dict
from .facts import plain_array, shaft_warnings

_OF_SHAFT = ("operation", "ring", "force", "stiffness", "life", "iterations", "unknowns", "residual_norm")
"""Results of a single bearing that are not taken over: on a shaft they have another meaning."""


def to_dict(solution: ShaftSolution) -> dict[str, Any]:
    """Dictionary of a shaft's solution; see `report.json_report.solution_to_dict`.

    - `bearings`: name -> displacement of the inner ring (`ring`), the load that holds it (`force`) and `stiffness`, all
      in the frame of the bearing; its force on the shaft (`on_shaft`) in the frame of the shaft; and the results of its
      own family.
    - `shaft.nodes`: arrays over the nodes.

    If the solve failed, all results are `None`.
    """
    converged = bool(solution.converged)
    nodes = {name: plain_array(getattr(solution.shaft, name)) for name in ("position", "displacement", "load")}
    return {
        "converged": converged,
        "status": Status(int(solution.status)).text,
        "warnings": shaft_warnings(solution) if converged else list(solution.warnings),
        "iterations": int(solution.iterations),
        "start_steps": int(solution.start_steps),
        "newton_steps": int(solution.newton_steps),
        "residual_norm": finite(float(solution.residual_norm)),
        "unknowns": solution.unknowns,
        "bearings": {name: _bearing(bearing, converged) for name, bearing in solution.bearings.items()},
        "shaft": {"nodes": nodes},
        "sets": {name: plain(result) for name, result in solution.sets.items()},
        "torque": plain(solution.torque),
        "thermal": None if solution.thermal is None else plain(solution.thermal),
        "system_life": None if solution.life is None else plain(solution.life),
        "duty": None if solution.duty is None else _duty(solution.duty),
    }


def _bearing(bearing: BearingOnShaft, converged: bool) -> dict[str, Any]:
    family = bearing_to_dict(bearing.solution) if bearing.solution is not None and converged else {}
    results = {name: value for name, value in family.items() if name not in _OF_SHAFT}
    results |= {
        "position": plain(bearing.position),
        "sense": bearing.sense,
        "ring": plain(bearing.ring),
        "force": plain_array(bearing.force),
        "stiffness": plain_array(bearing.stiffness),
        "on_shaft": plain_array(bearing.on_shaft),
        "radial_force": plain(bearing.radial_force),
        "azimuth": plain(bearing.azimuth),
        "outer": plain_array(bearing.outer),
        "closure": plain(bearing.closure),
        "expansion": plain(bearing.expansion),
        "largest_load": plain(bearing.largest_load),
        "pressure_centre": plain(bearing.pressure_centre),
        "life": None if bearing.life is None else plain(bearing.life),
    }
    results.setdefault("power_loss", None)
    return results


def _duty(duty: DutyResult) -> dict[str, Any]:
    shares = dict(zip(duty.names, plain_array(duty.shares), strict=True))
    return {
        "shares": shares,
        "bearing_hours": {name: plain(value) for name, value in duty.bearing_hours.items()},
        "system_hours": None if duty.system_hours is None else plain(duty.system_hours),
        "lives": plain(duty.lives),
        "system_life": plain(duty.system),
    }
