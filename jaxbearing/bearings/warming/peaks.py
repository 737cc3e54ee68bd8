"""The hardest moments of a run of temperatures: the least play, the largest contact load and the highest temperature,
between the instants too.

An inner ring that warms before the housing takes the play away for a while: the peak of preload at a start. The
instants of a history may pass it by, but the steps of the integrator are as short as the temperatures need. So the
bearing is looked at where its steps end too. The run is then integrated again around the time with the extreme value,
at times that lie closer together, and once more around the best of these.
"""

from collections.abc import Callable
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from .history import WarmInstant, WarmPeaks, play_of

LEAST_PLAY_DEPTH = 1e-9
"""Least difference of the play to that at both ends of a run for which an extreme is one, m."""
LEAST_LOAD_DEPTH = 1e-6
"""The same of the largest contact load, relative."""
LEAST_HEAT_DEPTH = 1e-2
"""The same of the highest temperature, K; the temperatures themselves are right to a third of it."""


class Extreme(NamedTuple):
    """An extreme value among times: the place, and `inside`: whether it lies below both ends by more than the least
    depth."""

    place: int
    inside: bool


Finer = Callable[[np.ndarray, WarmInstant, int], tuple[np.ndarray, WarmInstant]]
"""Function of times, s, their instants and an index: times and instants from one neighbour of it to the other."""
REFINEMENTS = 2
"""Number of times that the run is integrated again around an extreme."""


def lowest(values: Float[np.ndarray, " time"], depth: float) -> Extreme:
    """The lowest value. **Arguments:** `depth`: in the unit of the values."""
    index = int(np.argmin(values))
    return Extreme(index, float(min(values[0], values[-1]) - values[index]) > depth)


def find_peaks(time: Float[np.ndarray, " time"], instants: WarmInstant, finer: Finer | None) -> WarmPeaks:
    """The peaks of a run. **Arguments:** `time`: of the instants and of the ends of steps, s; `instants`: the bearing
    there; `finer`: left out: only these are looked at."""
    play = play_of(instants)
    load = lambda one: -np.asarray(one.largest_load)
    depth = LEAST_LOAD_DEPTH * float(np.max(np.asarray(instants.largest_load)))
    found = _peak(time, instants, load, depth, finer)
    least = None
    if play is not None:
        least = _peak(time, instants, lambda one: np.asarray(getattr(one.fit, play[0])), LEAST_PLAY_DEPTH, finer)
    hottest = _peak(time, instants, lambda one: -_highest(one), LEAST_HEAT_DEPTH, finer)
    number = lambda value: jnp.asarray(value, dtype=float)
    return WarmPeaks(
        least_play=None if least is None else number(least[1]),
        least_play_time=None if least is None else number(least[0]),
        largest_load=number(-found[1]),
        largest_load_time=number(found[0]),
        highest_temperature=number(-hottest[1]),
        highest_temperature_time=number(hottest[0]),
    )


def _highest(instants: WarmInstant) -> Float[np.ndarray, " time"]:
    """The temperature of the hottest node, K."""
    return np.max([np.asarray(one) for one in vars(instants.temperatures).values() if one is not None], axis=0)


def _peak(
    time: Float[np.ndarray, " time"],
    instants: WarmInstant,
    values_of: Callable[[WarmInstant], Float[np.ndarray, " time"]],
    depth: float,
    finer: Finer | None,
) -> tuple[float, float]:
    """Time and value of the lowest value."""
    values = values_of(instants)
    found = lowest(values, depth)
    place, best = found.place, (float(time[found.place]), float(values[found.place]))
    for _ in range(REFINEMENTS if finer is not None and found.inside else 0):
        assert finer is not None
        if not 0 < place < time.size - 1:
            break
        time, instants = finer(time, instants, place)
        values = values_of(instants)
        place = int(np.argmin(values))
        best = min(best, (float(time[place]), float(values[place])), key=lambda one: one[1])
    return best
