"""The most loaded rolling element and its contacts in a section through the axis, to scale."""

import math
from typing import TYPE_CHECKING

import numpy as np

from ....bearings.bearing import AbstractBearing
from ....bearings.facts import LOADED
from ....bearings.flanks import SECOND, on_heavier_flanks
from ....bearings.outline import Outline, moved
from ....bearings.solution import Solution
from ...backends.svg import Drawing
from ...colours import CENTRE_LINE, INK, INNER, OUTER, RIB, RING, ROLLER
from ...display import digits

if TYPE_CHECKING:
    from .any_family import _Patches

_WIDTH = 115.0
"""Diameter of the rolling element, points of the page."""
_LONGEST = 0.9
"""Longest arrow, in diameters of the element."""
_EDGE = {"stroke": INK, "stroke_width": 1.0}


def section(scene: AbstractBearing, solution: Solution) -> str:
    """The section as SVG; the bearing axis is below, with its positive direction to the right."""
    elements = solution.elements
    j = int(np.argmax(np.asarray(on_heavier_flanks(elements).load_inner)))
    of = lambda name: float(np.asarray(getattr(elements, name))[j])
    outline = scene.outline(of)
    diameter, name, contacts = outline.diameter, solution.element_name, outline.contacts
    drawing = Drawing(f"Section through the axis and the most loaded {name}", _WIDTH / diameter)
    draw_outline(drawing, outline)
    loads = {side: of(f"load_{side}") for side in contacts}
    largest, lowest = max(loads.values()), 0.0
    for side, (place, direction) in contacts.items():
        race = side.removesuffix(SECOND)
        if f"{race}{SECOND}" in contacts and loads[side] <= LOADED * largest:
            continue  # a flank that carries no load
        length = _LONGEST * diameter * loads[side] / largest if largest > 0.0 else 0.0
        end = moved(place, direction, length)
        colour = {"inner": INNER, "outer": OUTER, "flange": RIB}[race]
        drawing.arrow(place, end, colour, width=3.0, data_load=loads[side])
        # the text of the rib load is placed beside the ring
        gap, anchor = (0.45 * diameter, "end") if side == "flange" else (18.0 / drawing.scale, "middle")
        beside = moved(end, direction, gap)
        drawing.text(beside, f"{_SAID[race]} {digits(loads[side])} N", anchor=anchor, fill=colour)
        lowest = min(beside[1], lowest) if race == "inner" else lowest
    _axial_load(drawing, solution, outline.line[0][0], lowest, diameter)
    return drawing.markup()


def _axial_load(drawing: Drawing, solution: Solution, x: float, lowest: float, diameter: float) -> None:
    """Draws the axial load on the inner ring, below the ring."""
    axial = getattr(solution.operation, "axial_load", None)
    if axial is None or float(axial) == 0.0:
        return
    reach = math.copysign(0.35 * diameter, float(axial))
    y = lowest - 32.0 / drawing.scale
    drawing.arrow((x - reach, y), (x + reach, y), INK, width=4.0)
    below = x, y - 18.0 / drawing.scale
    drawing.text(below, f"axial load on the inner ring {1e-3 * float(axial):.5g} kN")


_SAID = {"inner": "inner race", "outer": "outer race", "flange": "rib"}


def draw_outline(drawing: "Drawing | _Patches", outline: Outline) -> None:
    """Draws rings and element. **Arguments:** `drawing`: object with the drawing methods of `svg.Drawing`."""
    for ring in outline.rings:
        drawing.polygon(ring, fill=RING, **_EDGE)
    if outline.element is None:
        drawing.circle((0.0, 0.0), 0.5 * outline.diameter, fill=ROLLER, **_EDGE)
    else:
        drawing.polygon(outline.element, fill=ROLLER, **_EDGE)
    drawing.line(list(outline.line), stroke=CENTRE_LINE, stroke_width=0.9, stroke_dasharray="6 3 1 3")
