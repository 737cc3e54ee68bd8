"""A transient run of a line contact: its statistics, and the run as plain numbers and texts."""

from typing import Any

import numpy as np

from ....ehl import LineContactHistory
from ....numerics.status import Status
from ...backends.json import plain


def statistics(history: LineContactHistory) -> dict[str, Any]:
    """Statistics of a run, in SI units."""
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


def to_dict(history: LineContactHistory) -> dict[str, Any]:
    """See `report.histories.history_to_dict`. There is no energy balance; the mass balance is in `summary`."""
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
        "summary": plain(statistics(history)),
    }
