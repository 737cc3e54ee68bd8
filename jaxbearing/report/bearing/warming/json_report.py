"""A transient run of bearing temperatures: its statistics, and the run as plain numbers and texts."""

from typing import Any

import numpy as np

from ....bearings.warming.history import WarmUpHistory, play_of
from ....numerics.status import Status
from ...backends.json import finite, plain


def statistics(history: WarmUpHistory) -> dict[str, Any]:
    """Values at the start and the end, and extremes with their times, in SI units. The extremes of play, load and
    hottest node include those between the instants."""
    instants, time = history.instants, np.asarray(history.time)
    spread = lambda values: _spread(time, values)
    numbers: dict[str, Any] = {
        "inner_speed": spread(instants.inner_speed),
        "temperatures": {name: spread(getattr(instants.temperatures, name)) for name in history.nodes},
        "oil_inlet": spread(instants.oil_inlet),
        "power_loss": {name: spread(value) for name, value in losses(history).items()},
        "heat_to_oil": spread(instants.heat_to_oil),
        "heat_to_ambient": spread(instants.heat_to_ambient),
        "heat_stored": spread(instants.heat_stored),
        "largest_load": spread(instants.largest_load),
        "largest_pressure": spread(instants.largest_pressure),
    }
    if instants.oil_out is not None:
        numbers["oil_out"] = spread(instants.oil_out)
    if instants.smallest_film is not None:
        numbers["smallest_film"] = spread(instants.smallest_film)
    if instants.cage is not None:
        numbers["cage"] = {"speed": spread(instants.cage.speed), "slip": spread(instants.cage.slip)}
    play, peaks = play_of(instants), history.peaks
    hottest = max(numbers["temperatures"].values(), key=lambda node: node["max"])
    if float(peaks.highest_temperature) > hottest["max"]:
        hottest |= {"max": float(peaks.highest_temperature), "max_time": float(peaks.highest_temperature_time)}
    load = numbers["largest_load"]
    load |= {"max": float(peaks.largest_load), "max_time": float(peaks.largest_load_time)}
    if play is not None and peaks.least_play is not None and peaks.least_play_time is not None:
        least = {"min": float(peaks.least_play), "min_time": float(peaks.least_play_time)}
        numbers[play[0]] = spread(play[1]) | least
    return numbers


def losses(history: WarmUpHistory) -> dict[str, Any]:
    """The total power loss and the losses that the scene models, W."""
    loss = history.instants.power_loss
    return {name: getattr(loss, name) for name in ("total", *vars(loss)) if getattr(loss, name) is not None}


def _spread(time: np.ndarray, values: object) -> dict[str, float]:
    values = np.asarray(values)
    low, high = int(np.argmin(values)), int(np.argmax(values))
    return {
        "start": float(values[0]),
        "min": float(values[low]),
        "min_time": float(time[low]),
        "max": float(values[high]),
        "max_time": float(time[high]),
        "end": float(values[-1]),
    }


def to_dict(history: WarmUpHistory) -> dict[str, Any]:
    """See `report.histories.history_to_dict`."""
    return {
        "completed": history.completed,
        "status": Status(int(history.status)).text,
        "interrupted": history.interrupted,
        "warnings": list(history.warnings),
        "not_modelled": list(history.not_modelled),
        "time": {"start": float(history.time[0]), "stop": float(history.time[-1]), "wanted": float(history.stop)},
        "steps": {"accepted": int(history.accepted), "rejected": int(history.rejected)},
        "solver": history.solver,
        "energy_error": finite(float(history.energy.error)),
        "energy": plain(history.energy),
        "peaks": plain(history.peaks),
        "operation": plain(history.operation),
        "summary": plain(statistics(history)),
    }
