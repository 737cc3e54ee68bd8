"""Statistics of a transient run: loads, motion of the cage, variation of orbital speeds, energy lost by sliding,
skidding, and stresses of the cage. Shocks and peaks of each turn are in `history_shocks`."""

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from ..bearings.motion.history import History
from .history_shocks import FACES, SECTORS, angle_of

if TYPE_CHECKING:
    import numpy.typing as npt

SIDES = ("inner", "outer")
SKID = 0.02
"""Slide-to-roll ratio in the rolling direction above which an element counts as skidding: below 1 % already, tractions
reach most of their limit."""
PLACES_PER_POCKET = 4
"""Number of places per pocket at which the bending of the rails is evaluated."""


class CageStress(NamedTuple):
    """Stresses of the cage over time, Pa.

    - `hoop`: hoop stress by rotation, Pa.
    - `rail`: largest bending stress of the rails under the pocket loads at each instant, Pa.
    - `bar`: bending stress of each bar between two pockets, Pa, under the larger of the two peak loads on it since the
      previous instant.
    - `rail_mean`, `rail_range`: mean and range over the run of hoop plus bending stress, Pa, at the place of the rails
      where this range is largest.
    """

    hoop: Float[np.ndarray, " time"]
    rail: Float[np.ndarray, " time"]
    bar: Float[np.ndarray, "time element"]
    rail_mean: float
    rail_range: float


def load_statistics(values: "npt.ArrayLike") -> dict[str, float]:
    """Mean, root mean square, 99 % quantile and maximum of all values."""
    values = np.asarray(values, dtype=float)
    return {
        "mean": float(values.mean()),
        "rms": float(np.sqrt(np.mean(np.square(values)))),
        "p99": float(np.quantile(values, 0.99)),
        "max": float(values.max()),
    }


def cage_orbit(history: History) -> dict[str, float] | None:
    """Orbit of the cage centre: mean position, mean and largest distance from it, m, and standard deviation of the
    centre's speed over its mean (small: steady whirl). `None` without a cage."""
    cage = history.instants.cage
    if cage is None:
        return None
    x, y = np.asarray(cage.x), np.asarray(cage.y)
    away = np.hypot(x - x.mean(), y - y.mean())
    speed = np.hypot(np.asarray(cage.velocity_x), np.asarray(cage.velocity_y))
    return {
        "mean_x": float(x.mean()),
        "mean_y": float(y.mean()),
        "mean_radius": float(away.mean()),
        "max_radius": float(away.max()),
        "deviation_ratio": float(speed.std() / max(float(speed.mean()), 1e-300)),
    }


def speed_variation(history: History) -> dict[str, float] | None:
    """Variation of the orbital speeds; `None` for families without them.

    `range_of_one`: largest range of one element's speed over the run; `between_elements`: largest range of the speeds
    of all elements at one instant; both over the mean speed. `excursion`: largest displacement of an element along the
    pitch circle from its mean place in the row, m.
    """
    speeds = getattr(history.instants.elements, "orbital_speed", None)
    if speeds is None:
        return None
    speed = np.asarray(speeds)
    along = np.asarray(history.instants.state_elements)[:, 0]
    along = along - along.mean(axis=1, keepdims=True)
    along = along - along.mean(axis=0, keepdims=True)
    # a uniform change of all speeds, as in a start, is no variation between elements
    own = speed - speed.mean(axis=1, keepdims=True)
    scale = max(float(np.abs(speed).mean()), 1e-300)
    return {
        "range_of_one": float(np.ptp(speed, axis=0).max()) / scale,
        "between_elements": float(np.ptp(own, axis=1).max()) / scale,
        "excursion": float(np.abs(along).max()),
    }


def sliding_power(history: History) -> dict[str, Float[np.ndarray, "time element"]]:
    """Power loss by sliding of each element, W: on the raceways and in the pocket, as far as the run has them."""
    instants, elements = history.instants, history.instants.elements
    powers = {}
    for side in SIDES:
        own = getattr(instants, f"sliding_power_{side}", None)
        if own is None:
            force, speed = (getattr(elements, f"{name}_{side}", None) for name in ("traction", "sliding"))
            own = None if force is None or speed is None else np.abs(np.asarray(force) * np.asarray(speed))
        if own is not None:
            powers[side] = np.asarray(own)
    pocket = getattr(instants, "pocket_power", None)
    return powers if pocket is None else powers | {"pocket": np.asarray(pocket)}


def sliding_energy(history: History) -> dict[str, Float[np.ndarray, " element"]]:
    """Energy lost by sliding of each element over the run, J: `sliding_power` integrated by the trapezoidal rule."""
    time = np.asarray(history.time)
    return {place: _integral(time, power) for place, power in sliding_power(history).items()}


def groove_energy(history: History) -> dict[str, Float[np.ndarray, " groove_angle"]]:
    """Energy lost by sliding over the run in each angle interval of the grooves (`Instant.groove_angles`), J, by side:
    trapezoidal rule over the instants. It is empty for families and laws that do not resolve the loss in a contact."""
    instants, time = history.instants, np.asarray(history.time)
    losses = {side: getattr(instants, f"groove_loss_{side}", None) for side in SIDES}
    return {side: _integral(time, np.asarray(loss)) for side, loss in losses.items() if loss is not None}


def _integral(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    steps = np.diff(time)[:, None]
    return np.sum(0.5 * (values[1:] + values[:-1]) * steps, axis=0)


def turns_done(history: History) -> float:
    """Number of turns of the cage in the run; of the first element, if there is no cage."""
    return float(np.abs(angle_of(history)[-1])) / (2.0 * math.pi)


def skidding(history: History) -> dict[str, dict[str, Any]]:
    """Places and times at which elements skid on each raceway; empty for families without `slide_to_roll`.

    For each side: share of the instants and elements that skid (above `SKID`), mean and largest slide-to-roll ratio,
    share by azimuth (`SECTORS` sectors from the load line), and time intervals, s, in which more than half of the
    elements skid.
    """
    instants, results = history.instants, {}
    time = np.asarray(history.time)
    azimuth = np.mod(np.asarray(instants.elements.azimuth), 2.0 * math.pi)
    sector = np.minimum((azimuth / (2.0 * math.pi) * SECTORS).astype(int), SECTORS - 1)
    for side in SIDES:
        values = getattr(instants, f"slide_to_roll_{side}", None)
        if values is None:
            continue
        size = np.abs(np.asarray(values))
        over = size > SKID
        shares = [float(over[sector == index].mean()) if np.any(sector == index) else None for index in range(SECTORS)]
        results[side] = {
            "share": float(over.mean()),
            "mean": float(size.mean()),
            "max": float(size.max()),
            "by_sector": shares,
            "times": _stretches(time, over.mean(axis=1) > 0.5),
        }
    return results


def _stretches(time: np.ndarray, on: np.ndarray) -> list[tuple[float, float]]:
    """First and last instant of each time interval in which `on` is true."""
    edges = np.diff(np.concatenate([[0], on.astype(int), [0]]))
    begins, ends = np.flatnonzero(edges > 0), np.flatnonzero(edges < 0) - 1
    return [(float(time[a]), float(time[b])) for a, b in zip(begins, ends, strict=True)]


def cage_stress(history: History) -> CageStress | None:
    """Stresses of the cage; `None` without a cage, or if the run lacks its section or the peaks of pocket loads."""
    section, instants = history.cage_section, history.instants
    if section is None or instants.cage is None or instants.pocket_peaks is None:
        return None
    elements, peaks = instants.elements, instants.pocket_peaks
    front, rear = (np.asarray(getattr(elements, f"pocket_load_{face}")) for face in FACES)
    count = front.shape[1]
    pockets = 2.0 * np.pi * np.arange(count) / count
    places = 2.0 * np.pi * np.arange(PLACES_PER_POCKET * count) / (PLACES_PER_POCKET * count)
    # elements push the cage forward at the front walls of the pockets
    rails = np.asarray(section.rails(jnp.asarray(places), jnp.asarray(pockets), jnp.asarray(front - rear)))
    hoop = np.asarray(section.hoop(jnp.asarray(instants.cage.speed)))
    # a bar is the front wall of its pocket and the rear wall of the next pocket ahead
    on_bar = np.maximum(np.asarray(peaks.front), np.roll(np.asarray(peaks.rear), -1, axis=1))
    together = hoop[:, None] + rails
    worst = int(np.argmax(np.ptp(together, axis=0)))
    return CageStress(
        hoop=hoop,
        rail=np.abs(rails).max(axis=1),
        bar=np.asarray(section.bar(jnp.asarray(on_bar))),
        rail_mean=float(together[:, worst].mean()),
        rail_range=float(np.ptp(together[:, worst])),
    )
