"""Extreme values of a run of temperatures: least play, largest contact load and highest temperature, also between the
instants.

If the inner ring warms before the housing, the play decreases for a while: this is the peak of preload at a start. The
instants of a history may miss it, but the steps of the integrator are as short as the temperatures need, so the bearing
is evaluated at the ends of these steps too. The run is then integrated again around the time of the extreme value, with
times that lie closer together, and once more around the best of these.
"""

from collections.abc import Callable
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from .history import WarmInstant, WarmPeaks, play_of

LEAST_PLAY_DEPTH = 1e-9
"""Difference, m, by which the least play must lie below the play at both ends of a run to count as an extreme."""
LEAST_LOAD_DEPTH = 1e-6
"""The same difference for the largest contact load, relative."""
LEAST_HEAT_DEPTH = 1e-2
"""The same difference for the highest temperature, K. The error of the temperatures is about a third of it."""


class Extreme(NamedTuple):
    """Index of the lowest of several values, and whether it lies inside, that is below the first and the last value by
    more than a given depth."""

    place: int
    inside: bool


Finer = Callable[[np.ndarray, WarmInstant, int], tuple[np.ndarray, WarmInstant]]
"""Function that takes times, s, the instants at these times and an index, and returns closer times and instants between
the two neighbours of the index."""
REFINEMENTS = 2
"""Number of repeated integrations around an extreme value."""


def lowest(values: Float[np.ndarray, " time"], depth: float) -> Extreme:
    """Finds the lowest value. **Arguments:** `depth`: see `Extreme`, in the unit of the values."""
    index = int(np.argmin(values))
    return Extreme(index, float(min(values[0], values[-1]) - values[index]) > depth)


def find_peaks(time: Float[np.ndarray, " time"], instants: WarmInstant, finer: Finer | None) -> WarmPeaks:
    """The extreme values of a run.

    **Arguments:** `time`: times of the instants and of the ends of steps, s; `instants`: the bearing at these times;
    `finer`: function that refines them, `None` to search only these times."""
    play = play_of(instants)
    load = lambda part: -np.asarray(part.largest_load)
    depth = LEAST_LOAD_DEPTH * float(np.max(np.asarray(instants.largest_load)))
    peak = _peak(time, instants, load, depth, finer)
    least = None
    if play is not None:
        least = _peak(time, instants, lambda part: np.asarray(getattr(part.fit, play[0])), LEAST_PLAY_DEPTH, finer)
    hottest = _peak(time, instants, lambda part: -_highest(part), LEAST_HEAT_DEPTH, finer)
    number = lambda value: jnp.asarray(value, dtype=float)
    return WarmPeaks(
        least_play=None if least is None else number(least[1]),
        least_play_time=None if least is None else number(least[0]),
        largest_load=number(-peak[1]),
        largest_load_time=number(peak[0]),
        highest_temperature=number(-hottest[1]),
        highest_temperature_time=number(hottest[0]),
    )


def _highest(instants: WarmInstant) -> Float[np.ndarray, " time"]:
    """The temperature of the hottest node, K."""
    return np.max(
        [np.asarray(temperature) for temperature in vars(instants.temperatures).values() if temperature is not None],
        axis=0,
    )


def _peak(
    time: Float[np.ndarray, " time"],
    instants: WarmInstant,
    values_of: Callable[[WarmInstant], Float[np.ndarray, " time"]],
    depth: float,
    finer: Finer | None,
) -> tuple[float, float]:
    """Time, s, and value of the minimum of `values_of`."""
    values = values_of(instants)
    minimum = lowest(values, depth)
    place, best = minimum.place, (float(time[minimum.place]), float(values[minimum.place]))
    for _ in range(REFINEMENTS if finer is not None and minimum.inside else 0):
        assert finer is not None
        if not 0 < place < time.size - 1:
            break
        time, instants = finer(time, instants, place)
        values = values_of(instants)
        place = int(np.argmin(values))
        best = min(best, (float(time[place]), float(values[place])), key=lambda peak: peak[1])
    return best
