"""Statistics of a run in time, and its summary on the screen and as plain numbers."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..bearings.history import History
from ..numerics.status import Status
from .display import with_unit
from .plain import finite, plain

if TYPE_CHECKING:
    from rich.console import Console

FACES = ("front", "rear")


def turns(history: History) -> np.ndarray:
    """Whole turns of the cage (or, without one, of the first roller) since the start, at each time."""
    instants = history.instants
    speed = instants.elements.orbital_speed[:, 0] if instants.cage is None else instants.cage.speed
    time, speed = np.asarray(history.time), np.asarray(speed)
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time)
    angle = np.concatenate([[0.0], np.cumsum(steps)])
    return np.floor(np.abs(angle) / (2.0 * math.pi) + 1e-12).astype(int)


def shocks(history: History) -> dict[str, list[dict[str, float]]]:
    """Largest load of each roller on the front and the rear wall of its pocket, turn by turn: mean and maximum over the
    rollers, N; the last turn may not be a whole one (`part` says how much of it there is)."""
    elements = history.instants.elements
    if elements.pocket_load_front is None:
        return {}
    number, time = turns(history), np.asarray(history.time)
    found: dict[str, list[dict[str, float]]] = {}
    for face in FACES:
        load = np.asarray(getattr(elements, f"pocket_load_{face}"))
        peaks = [load[number == turn].max(axis=0) for turn in range(number[-1] + 1)]
        found[face] = [{"mean": float(peak.mean()), "max": float(peak.max())} for peak in peaks]
    lengths = [float(np.ptp(time[number == turn])) for turn in range(number[-1] + 1)]
    whole = max(lengths)
    for face in FACES:
        for entry, length in zip(found[face], lengths, strict=True):
            entry["part"] = length / whole if whole > 0 else 0.0
    return found


def whirl_ratio(history: History) -> float | None:
    """Mean angular speed of the cage's centre about its mean place over the mean cage speed."""
    cage, time = history.instants.cage, np.asarray(history.time)
    if cage is None or time.size < 3:
        return None
    x, y = np.asarray(cage.x) - np.mean(cage.x), np.asarray(cage.y) - np.mean(cage.y)
    turned = np.unwrap(np.arctan2(y, x))
    return float((turned[-1] - turned[0]) / (time[-1] - time[0]) / np.mean(cage.speed))


def statistics(history: History) -> dict[str, Any]:
    """Means and extremes over the run, SI."""
    instants = history.instants
    found: dict[str, Any] = {
        "inner_speed": _spread(instants.inner_speed),
        "ring": {"radial": _spread(instants.ring.radial)},
        "power_loss": {name: float(np.mean(value)) for name, value in _losses(history).items()},
        "drive_power": float(np.mean(instants.drive_power)),
        "pressure_max": float(max(np.max(instants.elements.pressure_inner), np.max(instants.elements.pressure_outer))),
        "sliding_max": float(
            max(np.abs(instants.elements.sliding_inner).max(), np.abs(instants.elements.sliding_outer).max())
        ),
    }
    if instants.cage is not None:
        found["cage"] = {
            "speed": _spread(instants.cage.speed),
            "slip": _spread(instants.cage.slip),
            "eccentricity_ratio": _spread(instants.cage.eccentricity_ratio),
            "whirl_ratio": whirl_ratio(history),
        }
    peaks = shocks(history)
    if peaks:
        found["pocket_load"] = {
            face: {"max": max(entry["max"] for entry in peaks[face]), "turns": peaks[face]} for face in FACES
        }
    return found


def _spread(values: Any) -> dict[str, float]:
    values = np.asarray(values)
    return {
        "mean": float(values.mean()),
        "min": float(values.min()),
        "max": float(values.max()),
        "end": float(values[-1]),
    }


def _losses(history: History) -> dict[str, Any]:
    loss = history.instants.power_loss
    return {name: getattr(loss, name) for name in ("total", *vars(loss)) if getattr(loss, name) is not None}


def history_to_dict(history: History) -> dict[str, Any]:
    """The run as plain numbers and texts in SI units, ready for `json.dumps`; what is not finite is `None`."""
    return {
        "completed": history.completed,
        "status": Status(int(history.status)).text,
        "interrupted": history.interrupted,
        "warnings": list(history.warnings),
        "time": {"start": float(history.time[0]), "stop": float(history.time[-1]), "wanted": float(history.stop)},
        "steps": {"accepted": int(history.accepted), "rejected": int(history.rejected)},
        "solver": history.solver,
        "energy_error": finite(float(history.energy.error)),
        "energy": plain(history.energy),
        "operation": plain(history.operation),
        "summary": plain(statistics(history)),
    }


def print_history(history: History, label: str, console: "Console") -> None:
    """The run on the screen."""
    from rich.table import Table
    from rich.text import Text

    found = statistics(history)
    console.print(Text(label, style="bold"))
    steps = f"{int(history.accepted)} steps ({int(history.rejected)} more tried)"
    console.print(f"{1e3 * float(history.time[-1]):.6g} ms in {steps}, {history.solver}")
    if not history.completed:
        console.print(Text(history.failure(), style="bold red"))
    table = Table("", "mean", "least", "largest", "at the end", box=None, pad_edge=False)
    rows = [("inner ring speed", found["inner_speed"], "rad/s"), ("ring displacement", found["ring"]["radial"], "m")]
    if "cage" in found:
        cage = found["cage"]
        rows += [("cage speed", cage["speed"], "rad/s"), ("cage slip", cage["slip"], "1")]
        rows += [("cage eccentricity ratio", cage["eccentricity_ratio"], "1")]
    for name, spread, unit in rows:
        table.add_row(name, *(with_unit(spread[key], unit) for key in ("mean", "min", "max", "end")))
    console.print(table)
    if "pocket_load" in found:
        console.print("\nLargest pocket load of a roller in a turn of the cage, N (mean over the rollers, largest)")
        table = Table("turn", "front", "", "rear", "", box=None, pad_edge=False)
        front, rear = (found["pocket_load"][face]["turns"] for face in FACES)
        for number, (a, b) in enumerate(zip(front, rear, strict=True), 1):
            name = f"{number}" if a["part"] > 0.95 else f"{number} ({100 * a['part']:.0f} % of it)"
            table.add_row(name, *(with_unit(v, "N") for v in (a["mean"], a["max"], b["mean"], b["max"])))
        console.print(table)
    console.print("\nMean power loss")
    table = Table("", "", box=None, pad_edge=False, show_header=False)
    for name, watts in sorted(found["power_loss"].items(), key=lambda item: (item[0] != "total", -item[1])):
        table.add_row(name.replace("_", " "), with_unit(watts, "W"))
    table.add_row("drive power", with_unit(found["drive_power"], "W"))
    console.print(table)
    console.print(
        f"\nThe energy balance leaves {float(history.energy.error):.1e} of the drive work open. Shocks are not "
        "repeatable turn by turn: compare statistics, to 10-20 %."
    )
    for text in history.warnings:
        console.print(Text(f"- {text}", style="yellow"))
