"""Shapes that a drawing shows of a bearing, in a section through its axis and one rolling element, mm.

The origin is the middle of the element; x points along the axis of the bearing, which lies below, and y outwards.
"""

from typing import NamedTuple

Point = tuple[float, float]

RING_THICKNESS = 0.45
"""Thickness of a ring at its raceway, in diameters of the element: a scene does not have it."""
RING_SIDE = 0.25
"""Ring beside the rolling element, in its diameters."""


class Outline(NamedTuple):
    """Shapes of one rolling element and what it touches.

    **Arguments:**
    - `diameter`: of the element.
    - `rings`: corners of the rings in this section.
    - `element`: corners of a roller; `None`: a ball.
    - `line`: ends of the roller's axis, or of the line through both contacts of a ball.
    - `contacts`: side -> where it is, and the direction of the element's force on the ring.
    - `shoulder`: height of the rings' shoulders over the pitch circle, seen along the axis.
    - `dimensions`: ends of the lines that stand for a dimension.
    - `labels`: field of `geometry` -> the point that shows it.
    - `own_directions`: whether the directions of the contacts are results, or dimensions of the bearing.
    """

    diameter: float
    rings: list[list[Point]]
    element: list[Point] | None
    line: tuple[Point, Point]
    contacts: dict[str, tuple[Point, Point]]
    shoulder: float
    dimensions: list[tuple[Point, Point]]
    labels: dict[str, Point]
    own_directions: bool = True


def moved(place: Point, direction: Point, length: float) -> Point:
    """The point at this distance from another one."""
    return place[0] + length * direction[0], place[1] + length * direction[1]


def between(start: Point, end: Point, part: float) -> Point:
    """The point at this part of the way."""
    return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])
