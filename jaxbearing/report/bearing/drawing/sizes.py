"""Sizes of a bearing seen along its axis."""

import math
from typing import SupportsFloat

from ....bearings.bearing import AbstractBearing
from ....bearings.cage import AbstractCage
from ....bearings.outline import RING_THICKNESS
from ....bearings.parts import AbstractGeometry

DRAWN_CLEARANCE = 0.07
"""Size at which a clearance is drawn, in diameters of the rolling element."""


class FrontSizes:
    """Dimensions of a bearing seen along its axis, mm, and its number of rolling elements.

    **Arguments:** `shoulder`: distance from the pitch circle to the ring shoulders, mm; by default that to the
    raceways.
    """

    def __init__(self, scene: AbstractBearing, shoulder: float | None = None):
        geometry = scene.geometry
        self.diameter = millimetres(scene.element_diameter)
        self.pitch = millimetres(geometry.pitch_diameter) / 2.0
        reach = self.diameter / 2.0 if shoulder is None else shoulder
        self.inner, self.outer = self.pitch - reach, self.pitch + reach
        self.ring = RING_THICKNESS * self.diameter
        back = self.diameter / 2.0 + self.ring
        self.bore, self.outside = self.pitch - back, self.pitch + back
        self.count, self.counted = scene.n_elements, f"n_{scene.element}s"
        self.step = 2.0 * math.pi / self.count
        self.first = first_angle(geometry)
        between = 2.0 * self.pitch * math.sin(math.pi / max(self.count, 2)) - self.diameter
        self.pocket = min(DRAWN_CLEARANCE * self.diameter, 0.3 * between)
        cage: AbstractCage | None = getattr(scene, "cage", None)
        self.cage: tuple[float, float] | None = None
        if cage is not None:
            self.cage = millimetres(cage.bore(geometry)) / 2.0, millimetres(cage.outside(geometry)) / 2.0


def millimetres(metres: SupportsFloat) -> float:
    return 1e3 * float(metres)


def first_angle(geometry: AbstractGeometry) -> float:
    """Azimuth of the first rolling element, rad."""
    return 0.0 if geometry.first_element_angle is None else float(geometry.first_element_angle)
