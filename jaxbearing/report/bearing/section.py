"""The most loaded rolling element and its contacts in a section through the axis, to scale."""

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...bearings.ball.scene import BallBearing
from ...bearings.cylindrical.scene import CylindricalRollerBearing
from ...bearings.solution import Solution
from ...bearings.tapered.scene import TaperedRollerBearing
from ..display import digits
from ..drawing import FAINT, RING, RING_THICKNESS, ROLLER
from ..svg import INK, Drawing, Point
from .plots import INNER, OUTER, RIB

_WIDTH = 115.0
"""Width of the rolling element, points of the page."""
_LONGEST = 0.9
"""Longest arrow, in diameters of the element."""
_SIDE = 0.25
"""Ring beside the rolling element, in its diameters."""
_SHOULDER = 0.3
"""Height of a ball bearing's shoulders over the ball's centre, in ball diameters."""
_EDGE = {"stroke": INK, "stroke_width": 1.0}

Contacts = dict[str, tuple[Point, Point]]
"""Side -> where it is, and the direction of the element's force on the ring."""


def section(scene: Any, solution: Solution) -> str:
    """SVG; the axis of the bearing lies below, its positive direction points to the right."""
    elements = solution.elements
    j = int(np.argmax(np.asarray(elements.load_inner)))
    of = lambda name: float(np.asarray(getattr(elements, name))[j])
    diameter = _diameter(scene)
    name = solution.element_name
    drawing = Drawing(f"Section through the axis and the most loaded {name}", _WIDTH / diameter)
    contacts = draw_element(scene, drawing, of)
    loads = {side: of(f"load_{side}") for side in contacts}
    largest, lowest = max(loads.values()), 0.0
    for side, (place, direction) in contacts.items():
        length = _LONGEST * diameter * loads[side] / largest if largest > 0.0 else 0.0
        end = _moved(place, direction, length)
        colour = {"inner": INNER, "outer": OUTER, "flange": RIB}[side]
        drawing.arrow(place, end, colour, width=3.0, data_load=loads[side])
        # that of the rib stands beside the ring
        gap, anchor = (0.45 * diameter, "end") if side == "flange" else (18.0 / drawing.scale, "middle")
        beside = _moved(end, direction, gap)
        drawing.text(beside, f"{_SAID[side]} {digits(loads[side])} N", anchor=anchor, fill=colour)
        lowest = beside[1] if side == "inner" else lowest
    _axial_load(drawing, solution, contacts["inner"][0][0], lowest, diameter)
    return drawing.markup()


def _axial_load(drawing: Drawing, solution: Solution, x: float, lowest: float, diameter: float) -> None:
    """On the inner ring, below all that is drawn of it."""
    axial = getattr(solution.operation, "axial_load", None)
    if axial is None or float(axial) == 0.0:
        return
    reach = math.copysign(0.35 * diameter, float(axial))
    y = lowest - 32.0 / drawing.scale
    drawing.arrow((x - reach, y), (x + reach, y), INK, width=4.0)
    below = x, y - 18.0 / drawing.scale
    drawing.text(below, f"axial load on the inner ring {1e-3 * float(axial):.5g} kN")


_SAID = {"inner": "inner race", "outer": "outer race", "flange": "rib"}


def _diameter(scene: Any) -> float:
    geometry = scene.geometry
    ball = isinstance(scene, BallBearing)
    return 1e3 * float(np.asarray(geometry.ball_diameter if ball else geometry.roller_diameter))


def _moved(place: Point, direction: Point, length: float) -> Point:
    return place[0] + length * direction[0], place[1] + length * direction[1]


@functools.singledispatch
def draw_element(scene: Any, drawing: Any, of: Callable[[str], float]) -> Contacts:
    """Draws rings and element, and says where it touches them.

    **Arguments:**
    - `drawing`: takes polygons, circles and lines, as `svg.Drawing` does.
    - `of`: from the name of a result to its value for this element: contact angles of a ball.
    """
    raise TypeError(f"no section of a {type(scene).__name__}")


@draw_element.register
def _cylindrical(scene: CylindricalRollerBearing, drawing: Drawing, of: Callable[[str], float]) -> Contacts:
    diameter, length = _diameter(scene), 1e3 * float(scene.geometry.roller_length)
    half, end = 0.5 * diameter, 0.5 * length + _SIDE * diameter
    back = half + RING_THICKNESS * diameter
    for sign in (1.0, -1.0):
        drawing.polygon(
            [(-end, sign * half), (end, sign * half), (end, sign * back), (-end, sign * back)], fill=RING, **_EDGE
        )
    x = 0.5 * length
    drawing.polygon([(-x, -half), (x, -half), (x, half), (-x, half)], fill=ROLLER, **_EDGE)
    _axis(drawing, (-end, 0.0), (end, 0.0))
    return {"outer": ((0.0, half), (0.0, 1.0)), "inner": ((0.0, -half), (0.0, -1.0))}


@draw_element.register
def _ball(scene: BallBearing, drawing: Drawing, of: Callable[[str], float]) -> Contacts:
    diameter = _diameter(scene)
    contacts: Contacts = {}
    for side, sign in (("outer", 1.0), ("inner", -1.0)):
        angle = of(f"contact_angle_{side}")
        direction = sign * math.sin(angle), sign * math.cos(angle)
        conformity = float(getattr(scene.geometry, f"conformity_{side}"))
        _groove(drawing, diameter, conformity, direction, sign)
        contacts[side] = _moved((0.0, 0.0), direction, 0.5 * diameter), direction
    drawing.circle((0.0, 0.0), 0.5 * diameter, fill=ROLLER, **_EDGE)
    drawing.line([contacts["inner"][0], contacts["outer"][0]], stroke=FAINT, stroke_width=1.0, stroke_dasharray="5 3")
    return contacts


def _groove(drawing: Drawing, diameter: float, conformity: float, direction: Point, sign: float) -> None:
    """A ring whose groove touches the ball in this direction; what is above (`sign` 1) or below the shoulders."""
    radius = conformity * diameter
    cx, cy = _moved((0.0, 0.0), direction, (0.5 - conformity) * diameter)
    shoulder = sign * _SHOULDER * diameter
    reach = math.sqrt(max(radius * radius - (shoulder - cy) ** 2, 0.0))
    start = math.atan2(sign * (shoulder - cy), reach)
    angles = np.linspace(math.pi - start, start, 40)
    arc = [(cx + radius * math.cos(a), cy + sign * radius * math.sin(a)) for a in angles]
    end, back = (0.5 + _SIDE) * diameter, sign * (0.5 + RING_THICKNESS) * diameter
    corners = [(-end, shoulder), *arc, (end, shoulder), (end, back), (-end, back)]
    drawing.polygon(corners, fill=RING, **_EDGE)


@draw_element.register
def _tapered(scene: TaperedRollerBearing, drawing: Drawing, of: Callable[[str], float]) -> Contacts:
    """The common apex of the cones lies to the right, on the axis."""
    geometry, diameter = scene.geometry, _diameter(scene)
    number = lambda value: float(np.asarray(value))
    far, length = 1e3 * number(geometry.apex_distance), 1e3 * number(geometry.roller_length)
    cup, cone, axis = (number(a) for a in (geometry.contact_angle, geometry.cone_angle, geometry.axis_angle))
    on = lambda angle, reach: (-reach * math.cos(angle), reach * math.sin(angle))
    side, thick = _SIDE * diameter, RING_THICKNESS * diameter
    big, small = far, far - length
    _cup(drawing, on(cup, big + side), on(cup, small - side), thick)
    _cone(drawing, on(cone, big), on(cone, small - side), axis, 0.22 * diameter, side, thick)
    drawing.polygon([on(cone, big), on(cup, big), on(cup, small), on(cone, small)], fill=ROLLER, **_EDGE)
    reach = far * math.cos(number(geometry.roller_half_angle))
    _axis(drawing, on(axis, reach + side), on(axis, reach - length - side))
    middle = far - 0.5 * length
    touch = _moved(on(cone, big), (math.sin(axis), math.cos(axis)), 0.12 * diameter)
    return {
        "outer": (on(cup, middle), (math.sin(cup), math.cos(cup))),
        "inner": (on(cone, middle), (-math.sin(cone), -math.cos(cone))),
        "flange": (touch, (-math.cos(axis), math.sin(axis))),
    }


def _cup(drawing: Drawing, big: Point, small: Point, thick: float) -> None:
    top = max(big[1], small[1]) + thick
    drawing.polygon([big, small, (small[0], top), (big[0], top)], fill=RING, **_EDGE)


def _cone(drawing: Drawing, big: Point, small: Point, axis: float, height: float, side: float, thick: float) -> None:
    """With the rib at the big ends."""
    up = math.sin(axis), math.cos(axis)
    top = _moved(big, up, height)
    bottom = min(big[1], small[1]) - thick
    left = big[0] - 1.4 * side
    drawing.polygon([small, big, top, (left, top[1]), (left, bottom), (small[0], bottom)], fill=RING, **_EDGE)


def _axis(drawing: Drawing, start: Point, end: Point) -> None:
    drawing.line([start, end], stroke=FAINT, stroke_width=0.8, stroke_dasharray="6 3 1 3")
