"""Charts of flexible rings: deformed shape (exaggerated), deflection over the azimuth, and loads compared with those in
rigid rings."""

import dataclasses
import math

import numpy as np

from ...bearings.bearing import AbstractBearing
from ...bearings.ring_deflection import AbstractRingDeflection, InnerRingDeflection
from ...bearings.solution import Solution
from ...solve import solve
from ..colours import FAINT, INNER, OUTER
from ..display import axis_unit, with_unit
from ..panels import Axis, Curves, Polar, Series
from .azimuth import signed_degrees
from .operation import load_angle

DRAWN = 0.2
"""Largest deflection as drawn, as a fraction of the ring radius."""


def ring_panels(solution: Solution, rigid: Solution | None = None) -> list[Polar | Curves]:
    """The charts; none if both rings are rigid.

    **Arguments:** `rigid`: result of `rigid_counterpart`; with `None` the loads are not compared.
    """
    rings = bent_rings(solution)
    shapes = [panel for ring in rings for panel in shape_panels(solution, ring)]
    return [load_polygon(solution, rigid), *shapes] if rings and rigid is not None else shapes


def bent_rings(solution: Solution) -> list[AbstractRingDeflection]:
    """Deflections of the flexible rings, outer ring first."""
    return [ring for ring in (solution.outer_ring, solution.inner_ring) if ring is not None]


def side_of(ring: AbstractRingDeflection) -> str:
    """Name of the ring: "inner" or "outer"."""
    return "inner" if isinstance(ring, InnerRingDeflection) else "outer"


def rigid_counterpart(scene: AbstractBearing, solution: Solution) -> Solution | None:
    """Solution of the same scene with rigid rings; `None` if the rings already are rigid or the solve fails."""
    if not bent_rings(solution):
        return None
    rigid = solve(dataclasses.replace(scene, outer_ring=None, inner_ring=None), throw=False)
    return rigid if bool(rigid.converged) else None


def load_polygon(solution: Solution, rigid: Solution) -> Polar:
    """Loads on the race of the flexible ring and those with rigid rings; if both rings are flexible, on the outer
    race."""
    rings = bent_rings(solution)
    side = side_of(rings[0])
    bent, stiff = (np.asarray(getattr(solved.elements, f"load_{side}")) for solved in (solution, rigid))
    unit, factor = axis_unit("N", float(max(np.max(bent), np.max(stiff))))
    azimuth, name = np.asarray(solution.elements.azimuth), solution.element_name
    largest = f"{with_unit(float(np.max(bent)), 'N')} and {with_unit(float(np.max(stiff)), 'N')}"
    single = len(rings) == 1
    return Polar(
        name=f"{side}_ring_load",
        title="Loads in a flexible and in a rigid ring" if single else "Loads in flexible and in rigid rings",
        caption=f"Load of each {name} on the {side} race, and that of the same scene with "
        f"{f'a rigid {side} ring' if single else 'rigid rings'}; the largest are {largest}. Azimuth 0 is below.",
        series=[
            Series("rigid", azimuth, factor * stiff, FAINT, dash="dash", faint=True),
            Series("flexible", azimuth, factor * bent, colour_of(rings[0]), "square"),
        ],
        unit=unit,
        arrow=load_angle(solution.operation),
    )


def colour_of(ring: AbstractRingDeflection) -> str:
    """Colour for results of the ring."""
    return INNER if isinstance(ring, InnerRingDeflection) else OUTER


def shape_panels(
    solution: Solution, ring: AbstractRingDeflection, name: str = "", of: str = "", zero: str = "the load line"
) -> list[Polar | Curves]:
    """Charts of the deformed ring and of its deflection over the azimuth.

    **Arguments:** `name`: name of the bearing in the names of the charts; `of`: addition to the titles that names the
    bearing; `zero`: text for the location of azimuth 0.
    """
    side, colour = side_of(ring), colour_of(ring)
    name = f"{side}_ring_{name}" if name else f"{side}_ring"
    azimuth, deflection = np.asarray(ring.azimuth), np.asarray(ring.deflection)
    largest, radius = float(np.max(np.abs(deflection))), float(ring.radius)
    factor = exaggeration(largest, radius)
    unit, scale = axis_unit("m", radius)
    shape = Polar(
        name=f"{name}_shape",
        title=f"Deformed {side} ring{of}",
        caption=f"Centroid circle of the {side} ring with deflections {factor:g} times as large as they are, and the "
        "round one; azimuth 0 is below.",
        series=[
            Series("round", azimuth, np.full_like(azimuth, scale * radius), FAINT, dash="dash", faint=True),
            Series("deformed", azimuth, scale * (radius + factor * deflection), colour),
        ],
        unit=unit,
        arrow=load_angle(solution.operation),
    )
    unit, scale = axis_unit("m", largest)
    # first and last azimuth are the same point: the last is left out
    degrees = signed_degrees(azimuth[:-1])
    order = np.argsort(degrees)
    curve = Curves(
        name=f"{name}_deflection",
        title=f"Deflection of the {side} ring{of}",
        caption="Outward deflection of the centroid circle" + (" against the shaft." if side == "inner" else "."),
        series=[Series(f"{side} ring", degrees[order], scale * deflection[:-1][order], colour)],
        unit=unit,
        x=Axis(f"azimuth from {zero}, deg", (-188.0, 188.0), (-180, -90, 0, 90, 180)),
    )
    return [shape, curve]


def exaggeration(largest: float, radius: float) -> float:
    """Factor by which deflections are drawn larger: 1, 2 or 5 times a power of ten.

    **Arguments:** largest deflection and radius of the ring, m.
    """
    if not largest > 0.0:
        return 1.0
    factor = DRAWN * radius / largest
    power = 10.0 ** math.floor(math.log10(factor))
    return power * max(step for step in (1.0, 2.0, 5.0) if step * power <= factor * (1.0 + 1e-9))
