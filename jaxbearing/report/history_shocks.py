"""Shocks between rolling elements and cage: peaks turn by turn, their distribution over the azimuth, and cage whirl."""

import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from ..bearings.motion.history import History
from .round_off import RESOLUTIONS

FACES = ("front", "rear")
SECTORS = 12
"""Number of equal sectors of the circumference; the first begins at the load line."""
SHOCK_OVER_MEDIAN, SHOCK_OVER_LARGEST = 10.0, 0.1
"""A pocket load counts as a shock if it exceeds both this multiple of the median of all pocket loads of the run and
this fraction of the largest."""
SHOCK = "a tenth of the largest and ten times the median pocket load"
"""Threshold of a shock in words."""


class Sectors(NamedTuple):
    """Shocks by azimuth, on the front and the rear walls: `number` and `mean_peak`, N (NaN without shocks), in each
    sector; `edges` of the sectors, rad, from the load line; `threshold`, N, above which a load is a shock. Neighbouring
    intervals above it are one shock."""

    edges: Float[np.ndarray, " edge"]
    threshold: float
    number: Int[np.ndarray, "2 sector"]
    mean_peak: Float[np.ndarray, "2 sector"]


def angle_of(history: History) -> Float[np.ndarray, " time"]:
    """Angle through which the cage (without a cage, the first rolling element) has turned since the start, at each
    time, rad."""
    instants = history.instants
    if instants.cage is None and getattr(instants.elements, "orbital_speed", None) is None:
        azimuth = np.asarray(instants.elements.azimuth)[:, 0]
        return azimuth - azimuth[0]
    speed = instants.elements.orbital_speed[:, 0] if instants.cage is None else instants.cage.speed
    time, speed = np.asarray(history.time), np.asarray(speed)
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time)
    return np.concatenate([[0.0], np.cumsum(steps)])


def turns(history: History) -> Int[np.ndarray, " time"]:
    """Number of whole turns of the cage (without a cage, of the first rolling element) since the start, at each
    time."""
    return np.floor(np.abs(angle_of(history)) / (2.0 * math.pi) + 1e-12).astype(int)


def pocket_peaks(history: History) -> Float[np.ndarray, "2 time element"] | None:
    """Largest pocket loads since the previous instant, front and rear, N; `None` without pockets."""
    peaks = history.instants.pocket_peaks
    return None if peaks is None else np.stack([np.asarray(getattr(peaks, face)) for face in FACES])


def peaks_by_turn(history: History) -> Float[np.ndarray, "2 turn element"] | None:
    """Largest pocket load of each rolling element in each turn of the cage, front and rear, N; the last turn may be
    incomplete. `None` without pockets."""
    load = pocket_peaks(history)
    if load is None:
        return None
    number = turns(history)
    # where instants are far apart, a turn may contain none
    return np.stack([load[:, number == turn].max(axis=1, initial=0.0) for turn in range(number[-1] + 1)], axis=1)


def shocks(history: History) -> dict[str, list[dict[str, float]]]:
    """Largest load of each rolling element on the front and the rear wall of its pocket, turn by turn: mean and maximum
    over the elements, N. The last turn may be incomplete: `part` is the fraction of a turn that was run."""
    peaks = peaks_by_turn(history)
    if peaks is None:
        return {}
    # all turns but the last are complete
    done = float(np.abs(angle_of(history)[-1])) / (2.0 * math.pi)
    parts = [min(1.0, done - turn) for turn in range(peaks.shape[1])]
    return {
        face: [
            {"mean": float(peak.mean()), "max": float(peak.max()), "part": part}
            for peak, part in zip(of_face, parts, strict=True)
        ]
        for face, of_face in zip(FACES, peaks, strict=True)
    }


def sectors(history: History) -> Sectors | None:
    """Distribution of shocks over the azimuth; `None` without pockets."""
    load = pocket_peaks(history)
    if load is None:
        return None
    azimuth = np.mod(np.asarray(history.instants.elements.azimuth), 2.0 * math.pi)
    threshold = max(SHOCK_OVER_MEDIAN * float(np.median(load)), SHOCK_OVER_LARGEST * float(np.max(load)))
    count, total = np.zeros((2, SECTORS), dtype=int), np.zeros((2, SECTORS))
    for face in range(2):
        for element in range(load.shape[2]):
            for at, peak in single_shocks(load[face, :, element], threshold):
                sector = min(int(azimuth[at, element] / (2.0 * math.pi) * SECTORS), SECTORS - 1)
                count[face, sector] += 1
                total[face, sector] += peak
    mean = np.where(count > 0, total / np.maximum(count, 1), np.nan)
    return Sectors(np.linspace(0.0, 2.0 * math.pi, SECTORS + 1), threshold, count, mean)


def single_shocks(load: Float[np.ndarray, " time"], threshold: float) -> list[tuple[int, float]]:
    """Index and height of the peak of each uninterrupted interval above a threshold."""
    above = np.concatenate([[False], load > threshold, [False]])
    begins, ends = np.flatnonzero(above[1:] & ~above[:-1]), np.flatnonzero(above[:-1] & ~above[1:])
    peaks = [int(begin) + int(np.argmax(load[begin:end])) for begin, end in zip(begins, ends, strict=True)]
    return [(at, float(load[at])) for at in peaks]


def whirl_ratio(history: History) -> float | None:
    """Mean angular speed of the cage centre about its mean position over the mean cage speed; > 0: whirl in the
    direction of rotation. `None` without a cage, for a run of less than one cage turn (its mean position is that of an
    arc), and for a centre that does not move."""
    cage, time = history.instants.cage, np.asarray(history.time)
    if cage is None:
        return None
    speed, x, y = float(np.mean(cage.speed)), np.asarray(cage.x), np.asarray(cage.y)
    turns = abs(speed) * float(time[-1] - time[0]) / (2.0 * math.pi)
    if turns < 1.0 or np.hypot(np.std(x), np.std(y)) < RESOLUTIONS["m"].absolute:
        return None
    return mean_whirl(time, x, y) / speed


def mean_whirl(time: np.ndarray, x: np.ndarray, y: np.ndarray) -> float:
    """Mean angular speed of a point about its mean position, rad/s; positive from X (right) to Y (up)."""
    turned = np.unwrap(np.arctan2(y - np.mean(y), x - np.mean(x)))
    return float((turned[-1] - turned[0]) / (time[-1] - time[0]))
