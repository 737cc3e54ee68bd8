"""Charts of a flexible outer ring: its deformed shape, exaggerated, its deflection over the azimuth, and the loads
beside those in a rigid ring."""

import dataclasses
import math

import numpy as np

from ...bearings.bearing import AbstractBearing
from ...bearings.ring_deflection import RingDeflection
from ...bearings.solution import Solution
from ...solve import solve
from ..colours import FAINT, OUTER
from ..display import axis_unit, with_unit
from ..panels import Axis, Curves, Polar, Series
from .azimuth import signed_degrees
from .operation import load_angle

DRAWN = 0.2
"""Largest deflection in the drawing over the radius of the ring."""


def ring_panels(solution: Solution, rigid: Solution | None = None) -> list[Polar | Curves]:
    """The charts; none of a rigid ring.

    **Arguments:** `rigid`: `rigid_counterpart`; `None`: the loads are not compared.
    """
    ring = solution.outer_ring
    if ring is None:
        return []
    shapes = shape_panels(solution, ring)
    return shapes if rigid is None else [load_polygon(solution, rigid), *shapes]


def rigid_counterpart(scene: AbstractBearing, solution: Solution) -> Solution | None:
    """Solution of the same scene with a rigid outer ring; `None` where the ring is rigid or that solve fails."""
    if solution.outer_ring is None:
        return None
    found = solve(dataclasses.replace(scene, outer_ring=None), throw=False)
    return found if bool(found.converged) else None


def load_polygon(solution: Solution, rigid: Solution) -> Polar:
    """Loads on the outer race in the flexible and in the rigid ring."""
    bent, stiff = (np.asarray(one.elements.load_outer) for one in (solution, rigid))
    unit, factor = axis_unit("N", float(max(np.max(bent), np.max(stiff))))
    azimuth, name = np.asarray(solution.elements.azimuth), solution.element_name
    largest = f"{with_unit(float(np.max(bent)), 'N')} and {with_unit(float(np.max(stiff)), 'N')}"
    return Polar(
        name="outer_ring_load",
        title="Loads in a flexible and in a rigid ring",
        caption=f"Load of each {name} on the outer race, and that of the same scene with a rigid outer ring; the "
        f"largest are {largest}. Azimuth 0 is below.",
        series=[
            Series("rigid", azimuth, factor * stiff, FAINT, dash="dash", faint=True),
            Series("flexible", azimuth, factor * bent, OUTER, "square"),
        ],
        unit=unit,
        arrow=load_angle(solution.operation),
    )


def shape_panels(
    solution: Solution, ring: RingDeflection, name: str = "outer_ring", of: str = "", zero: str = "the load line"
) -> list[Polar | Curves]:
    """The deformed ring, and its deflection over the azimuth.

    **Arguments:** `name`: with which the names of the charts begin; `of`: the bearing, behind the titles; `zero`: where
    azimuth 0 is, in words.
    """
    azimuth, deflection = np.asarray(ring.azimuth), np.asarray(ring.deflection)
    largest, radius = float(np.max(np.abs(deflection))), float(ring.radius)
    factor = exaggeration(largest, radius)
    unit, scale = axis_unit("m", radius)
    shape = Polar(
        name=f"{name}_shape",
        title=f"Deformed outer ring{of}",
        caption=f"Centroid circle of the outer ring with deflections {factor:g} times as large as they are, and the "
        "round one; azimuth 0 is below.",
        series=[
            Series("round", azimuth, np.full_like(azimuth, scale * radius), FAINT, dash="dash", faint=True),
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
        name=f"{name}_deflection",
        title=f"Deflection of the outer ring{of}",
        caption="Outward deflection of the centroid circle.",
        series=[Series("outer ring", degrees[order], scale * deflection[:-1][order], OUTER)],
        unit=unit,
        x=Axis(f"azimuth from {zero}, deg", (-188.0, 188.0), (-180, -90, 0, 90, 180)),
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
