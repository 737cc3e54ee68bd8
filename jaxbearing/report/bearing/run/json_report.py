"""JSON report of a transient run of a bearing, and its statistics."""

import math
from typing import Any

import equinox as eqx
import numpy as np
from jaxtyping import Array

from ....bearings.motion.history import History, Instant
from ....numerics.status import Status
from ...backends.json import finite, plain
from ...history_shocks import FACES, Sectors, sectors, shocks, whirl_ratio
from ...run_statistics import (
    SKID,
    cage_orbit,
    cage_stress,
    groove_energy,
    load_statistics,
    skidding,
    sliding_energy,
    speed_variation,
    turns_done,
)


def statistics(history: History) -> dict[str, Any]:
    """Means and extremes of the results over the run, SI."""
    instants, elements = history.instants, history.instants.elements
    numbers: dict[str, Any] = {
        "inner_speed": _spread(instants.inner_speed),
        "ring": {name: _spread(getattr(instants.ring, name)) for name in _moved(instants)},
        "power_loss": {name: float(np.mean(value)) for name, value in _losses(history).items()},
        "drive_power": float(np.mean(instants.drive_power)),
        "power": {"loss": _spread(instants.power_loss.total), "drive": _spread(instants.drive_power)}
        | _stored(history),
    }
    for name in ("pressure", "sliding"):
        # not all families have both results
        values = by_side(elements, name).values()
        if values:
            numbers[f"{name}_max"] = float(max(np.abs(array).max() for array in values))
    if "axial" in numbers["ring"]:
        numbers["excursion"] = _excursion(instants)
    if instants.cage is not None:
        numbers["cage"] = {
            "speed": _spread(instants.cage.speed),
            "slip": _spread(instants.cage.slip),
            "eccentricity_ratio": _spread(instants.cage.eccentricity_ratio),
            "whirl_ratio": whirl_ratio(history),
            "orbit": cage_orbit(history),
        }
    peaks = shocks(history)
    if peaks:
        at_instants = {face: load_statistics(getattr(elements, f"pocket_load_{face}")) for face in FACES}
        numbers["pocket_load"] = {
            face: at_instants[face] | {"max": max(entry["max"] for entry in peaks[face]), "turns": peaks[face]}
            for face in FACES
        }
    numbers |= _motion_statistics(history)
    spread = sectors(history)
    if spread is not None:
        numbers["shocks"] = _by_sector(spread)
    return numbers


def _motion_statistics(history: History) -> dict[str, Any]:
    """Statistics that only transient runs have: speed variation, sliding energy, skidding, land load, cage stress."""
    numbers: dict[str, Any] = {}
    instants, variation, stress = history.instants, speed_variation(history), cage_stress(history)
    if variation is not None:
        numbers["speed_variation"] = variation
    energy, turns = sliding_energy(history), turns_done(history)
    if energy:
        numbers["sliding_energy"] = {
            place: {
                "total": float(own.sum()),
                "largest": float(own.max()),
                "per_turn": float(own.sum()) / turns if turns > 0 else None,
            }
            for place, own in energy.items()
        }
    across = groove_energy(history)
    if across:
        angle = np.degrees(instants.groove_angles)
        numbers["groove_energy"] = {side: _across(angle, own) for side, own in across.items()}
    skids = skidding(history)
    if skids:
        numbers["skidding"] = {"threshold": SKID} | skids
    land = getattr(instants, "land_load", None)
    if land is not None:
        peaks = instants.pocket_peaks
        assert peaks is not None
        numbers["land_load"] = load_statistics(land) | {"max": float(np.max(np.asarray(peaks.land)))}
    if stress is not None:
        numbers["cage_stress"] = {
            "hoop": float(stress.hoop.max()),
            "rail_bending": float(stress.rail.max()),
            "rail_mean": stress.rail_mean,
            "rail_range": stress.rail_range,
            "bar_bending": float(stress.bar.max()),
        }
    return numbers


def _across(angle: np.ndarray, energy: np.ndarray) -> dict[str, Any]:
    """Sliding energy in each interval of angle across a groove, from the first to the last interval with contact; the
    largest of these energies and its angle."""
    touched = np.flatnonzero(energy)
    part = slice(touched[0], touched[-1] + 1) if touched.size else slice(0)
    return {
        "angle_deg": angle[part].tolist(),
        "energy": energy[part].tolist(),
        "largest": float(energy.max()),
        "largest_at_deg": float(angle[np.argmax(energy)]),
    }


def _moved(instants: Instant) -> tuple[str, ...]:
    """Names of the ring displacements in the statistics; the axial one only if an axial load can move the ring."""
    return ("axial", "radial") if hasattr(instants, "axial_load") else ("radial",)


def _excursion(instants: Instant) -> float:
    """Largest departure of an element from equal spacing along the pitch circle, relative to the mean of all, m."""
    along = np.asarray(instants.state_elements)[:, 0]
    return float(np.abs(along - along.mean(axis=1, keepdims=True)).max())


def by_side(elements: eqx.Module, name: str) -> dict[str, np.ndarray]:
    """A result of the contacts on the inner and outer raceway; a raceway without this result is left out."""
    results = {side: getattr(elements, f"{name}_{side}", None) for side in ("inner", "outer")}
    return {side: np.asarray(values) for side, values in results.items() if values is not None}


def _by_sector(spread: Sectors) -> dict[str, Any]:
    faces = {
        face: {"count": spread.number[i].tolist(), "mean_peak": finite(spread.mean_peak[i].tolist())}
        for i, face in enumerate(FACES)
    }
    return {"threshold": spread.threshold, "sector_edges": spread.edges.tolist()} | faces


def _spread(values: Array | np.ndarray) -> dict[str, float]:
    values = np.asarray(values)
    return {
        "mean": float(values.mean()),
        "min": float(values.min()),
        "max": float(values.max()),
        "end": float(values[-1]),
    }


def _stored(history: History) -> dict[str, float]:
    """Mean powers over the run that the drive supplies in addition to the dissipation, W."""
    energy, time = history.energy, float(history.time[-1] - history.time[0])
    names = ("pocket_films", "lever_arm", "damping", "kinetic")
    works = {name: getattr(energy, name) for name in names if hasattr(energy, name)}
    return {name: float(work) / time if time > 0 else math.nan for name, work in works.items()}


def _losses(history: History) -> dict[str, Array | np.ndarray]:
    loss = history.instants.power_loss
    return {name: getattr(loss, name) for name in ("total", *vars(loss)) if getattr(loss, name) is not None}


def to_dict(history: History) -> dict[str, Any]:
    """The run as numbers and texts in SI units, ready for `json.dumps`. Numbers that are not finite become `None`.
    A run that did not begin has no time and no summary."""
    begun = np.size(history.time) > 0
    ends = (float(history.time[0]), float(history.time[-1])) if begun else (None, None)
    return {
        "completed": history.completed,
        "status": Status(int(history.status)).text,
        "interrupted": history.interrupted,
        "warnings": list(history.warnings),
        "not_modelled": list(history.not_modelled),
        "time": {"start": ends[0], "stop": ends[1], "wanted": float(history.stop)},
        "steps": {"accepted": int(history.accepted), "rejected": int(history.rejected)},
        "solver": history.solver,
        "energy_error": finite(float(history.energy.error)),
        "energy": plain(history.energy),
        "operation": plain(history.operation),
        "summary": plain(statistics(history)) if begun else {},
    }
