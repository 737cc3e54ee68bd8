"""Shapes for the drawing of a bearing in a section through its axis and one rolling element, mm.

The origin is the middle of the element; x points along the bearing axis, which lies below, and y radially outwards.
"""

from typing import NamedTuple

Point = tuple[float, float]

RING_THICKNESS = 0.45
"""Drawn thickness of a ring at its raceway over the element diameter; scenes do not give it."""
RING_SIDE = 0.25
"""Drawn length of a ring beside the rolling element over the element diameter."""


class Outline(NamedTuple):
    """Shapes of one rolling element and of the parts that it touches.

    **Arguments:**
    - `diameter`: diameter of the element.
    - `rings`: corners of the rings in this section.
    - `element`: corners of a roller; `None` for a ball.
    - `line`: ends of the axis of a roller, or of the line through both contacts of a ball.
    - `contacts`: name of a contact -> its position, and the direction of the force of the element on the ring.
    - `shoulder`: distance of the shoulders of the rings from the pitch circle, seen along the axis.
    - `dimensions`: ends of the dimension lines.
    - `labels`: field of `geometry` -> point at which it is labelled.
    - `own_directions`: True if the directions of the contacts are results, False if they are dimensions of the bearing.
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
    """The point at a distance from `place` along a direction."""
    return place[0] + length * direction[0], place[1] + length * direction[1]


def between(start: Point, end: Point, part: float) -> Point:
    """The point at the fraction `part` of the way from `start` to `end`."""
    return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])
