"""A line contact as plain numbers and texts."""

from typing import Any

import numpy as np

from ...ehl import LineContactHistory, LineContactSolution
from ...numerics.status import Status
from ..labelled import labelled
from ..plain import finite, plain


def line_contact_to_dict(solution: LineContactSolution) -> dict[str, Any]:
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


def film_statistics(history: LineContactHistory) -> dict[str, Any]:
    """Summary of a run, SI."""
    time, central = np.asarray(history.time), np.asarray(history.film.central)
    minimum, place = np.asarray(history.film.minimum), np.asarray(history.film.minimum_position)
    lowest = int(np.argmin(minimum))
    changed = np.abs(central / central[0] - 1.0) > 0.01
    return {
        "central": _ends(central),
        "minimum": _ends(minimum),
        "minimum_time": float(time[lowest]),
        "minimum_position": {"start": float(place[0]), "end": float(place[-1])},
        "central_constant_until": float(time[np.argmax(changed)]) if changed.any() else None,
        "pressure_max": float(np.max(np.asarray(history.pressure.maximum))),
        "entrainment_speed": _ends(np.asarray(history.entrainment_speed)),
        "mass_balance_error": float(history.mass_balance),
        "newton_steps": int(history.newton_steps),
        "ended_at_film_limit": history.ended_thin,
        "hertz": plain(history.hertz),
    }


def _ends(values: np.ndarray) -> dict[str, float]:
    return {
        "start": float(values[0]),
        "min": float(values.min()),
        "max": float(values.max()),
        "end": float(values[-1]),
    }


def film_history_to_dict(history: LineContactHistory) -> dict[str, Any]:
    """See `report.histories.history_to_dict`. There is no balance of energy: that of mass stands in the summary."""
    return {
        "completed": history.completed,
        "status": Status(int(history.status)).text,
        "interrupted": history.interrupted,
        "warnings": list(history.warnings),
        "time": {"start": float(history.time[0]), "stop": float(history.time[-1]), "wanted": float(history.stop)},
        "steps": {"accepted": int(history.accepted), "rejected": int(history.rejected)},
        "solver": history.solver,
        "energy_error": None,
        "operation": plain(history.operation),
        "summary": plain(film_statistics(history)),
    }
