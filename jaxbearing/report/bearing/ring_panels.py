"""Charts of a flexible outer ring: its deformed shape, exaggerated, and its deflection over the azimuth."""

import math

import numpy as np

from ...bearings.solution import Solution
from ..colours import OUTER
from ..display import axis_unit, digits
from ..panels import Axis, Curves, Polar, Series
from .azimuth import signed_degrees
from .operation import load_angle

DRAWN = 0.2
"""Largest deflection in the drawing over the radius of the ring."""


def ring_panels(solution: Solution) -> list[Polar | Curves]:
    """The charts; none of a rigid ring."""
    ring = solution.outer_ring
    if ring is None:
        return []
    azimuth, deflection = np.asarray(ring.azimuth), np.asarray(ring.deflection)
    largest, radius = float(np.max(np.abs(deflection))), float(ring.radius)
    factor = exaggeration(largest, radius)
    unit, scale = axis_unit("m", radius)
    shape = Polar(
        name="outer_ring_shape",
        title="Deformed outer ring",
        caption=f"Centroid circle of the outer ring with deflections {digits(factor)} times as large as they are, and "
        "the round one; azimuth 0 is below.",
        series=[
            Series("round", azimuth, np.full_like(azimuth, scale * radius), OUTER, dash="dot", faint=True),
            Series("deformed", azimuth, scale * (radius + factor * deflection), OUTER),
        ],
        unit=unit,
        arrow=load_angle(solution.operation),
    )
    unit, scale = axis_unit("m", largest)
    # both ends of the azimuth are one point: the second one is left out
    degrees = signed_degrees(azimuth[:-1])
    order = np.argsort(degrees)
    curve = Curves(
        name="outer_ring_deflection",
        title="Deflection of the outer ring",
        caption="Outward deflection of the centroid circle.",
        series=[Series("outer ring", degrees[order], scale * deflection[:-1][order], OUTER)],
        unit=unit,
        x=Axis("azimuth from the load line, deg", (-188.0, 188.0), (-180, -90, 0, 90, 180)),
    )
    return [shape, curve]


def exaggeration(largest: float, radius: float) -> float:
    """Factor of the drawing, with one digit: 1, 2 or 5 times a power of ten.

    **Arguments:** largest deflection and radius, m.
    """
    if not largest > 0.0:
        return 1.0
    factor = DRAWN * radius / largest
    power = 10.0 ** math.floor(math.log10(factor))
    return power * max(step for step in (1.0, 2.0, 5.0) if step * power <= factor * (1.0 + 1e-9))
