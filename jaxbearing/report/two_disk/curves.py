"""The curves of a family, one after the other."""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ...machines import TwoDiskSolution


class Curve(NamedTuple):
    """Place of one curve in the arrays of a solution, and its operating point, SI."""

    place: tuple[int, ...]
    """Indices of temperature, speed and load."""
    temperature: float
    entrainment_speed: float
    pressure: float
    load: float
    slowest: int
    """Index of the smallest slide-to-roll ratio, by modulus."""

    def of(self, values: object) -> np.ndarray:
        """This curve's part of a result, over the slide-to-roll ratio."""
        return np.asarray(values)[self.place]


def curves_of(solution: TwoDiskSolution) -> Iterator[Curve]:
    """**Raises:** `ValueError` for a batch of families."""
    if np.ndim(solution.traction_coefficient) != 4:
        raise ValueError("expected one family of traction curves, got a batch of them: take one lane of it")
    operation = solution.operation
    axes = [np.asarray(axis) for axis in (operation.temperature, operation.entrainment_speed, solution.pressure)]
    load = np.asarray(solution.load)
    slowest = int(np.argmin(np.abs(np.asarray(operation.slide_to_roll))))
    for place in itertools.product(*(range(axis.size) for axis in axes)):
        temperature, speed, pressure = (float(axis[i]) for axis, i in zip(axes, place, strict=True))
        yield Curve(place, temperature, speed, pressure, float(load[place[2]]), slowest)
