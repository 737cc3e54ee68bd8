"""Traction curves of a solution, one after the other."""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...machines import TwoDiskSolution


class Curve(NamedTuple):
    """Indices of one traction curve in the arrays of a solution, and its operating point in SI units."""

    place: tuple[int, ...]
    """Indices along temperature, entrainment speed and load."""
    temperature: float
    entrainment_speed: float
    pressure: float
    load: float
    slowest: int
    """Index of the slide-to-roll ratio of smallest modulus."""

    def of(self, values: object) -> np.ndarray:
        """The values of a result on this curve, over the slide-to-roll ratio."""
        return np.asarray(values)[self.place]


def curves_of(solution: TwoDiskSolution) -> Iterator[Curve]:
    """All traction curves of a solution. **Raises:** `ValueError` for a batch of solutions."""
    if np.ndim(solution.traction_coefficient) != 4:
        raise ValueError("expected one family of traction curves, got a batch of them: take one lane of it")
    operation = solution.operation
    axes = [np.asarray(axis) for axis in (operation.temperature, operation.entrainment_speed, solution.pressure)]
    load = np.asarray(solution.load)
    slowest = int(np.argmin(np.abs(np.asarray(operation.slide_to_roll))))
    for place in itertools.product(*(range(axis.size) for axis in axes)):
        temperature, speed, pressure = (float(axis[i]) for axis, i in zip(axes, place, strict=True))
        yield Curve(place, temperature, speed, pressure, float(load[place[2]]), slowest)
