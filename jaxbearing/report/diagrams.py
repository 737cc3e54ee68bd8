"""Description of a diagram of boxes and arrows, which matplotlib draws on paper and the SVG backend on an HTML page.

Places, sizes and widths are in points, x to the right and y up. A backend that draws a diagram larger or smaller
scales the texts with it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .colours import INK, RING

Place = tuple[float, float]

TEXT = 9.5
"""Size of the texts, points."""
LETTER = 0.56
"""Width allowed for a letter, as a fraction of the text size."""


@dataclass(frozen=True)
class Box:
    """A rectangle with lines of text in its middle; `fill` is the colour of its surface, "none" for a text alone."""

    centre: Place
    width: float
    height: float
    text: str
    fill: str = RING


@dataclass(frozen=True)
class Arrow:
    """A straight arrow. `at`: centre of its text; `width`: width of its shaft."""

    start: Place
    end: Place
    text: str
    at: Place
    width: float
    colour: str = INK

    def outline(self) -> list[Place]:
        """Corners of the arrow. The head is a little wider than the shaft, and shorter on a short arrow."""
        (x0, y0), (x1, y1) = self.start, self.end
        length = math.hypot(x1 - x0, y1 - y0)
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        head, half, side = min(5.0 + self.width, 0.6 * length), 3.0 + 0.75 * self.width, 0.5 * self.width
        along = ((0.0, -side), (length - head, -side), (length - head, -half), (length, 0.0))
        corners = [*along, *((x, -y) for x, y in reversed(along[:-1]))]
        return [(x0 + x * ux - y * uy, y0 + x * uy + y * ux) for x, y in corners]


@dataclass(frozen=True)
class Diagram:
    """Boxes and arrows. `low`, `high`: lower left and upper right corner of the picture."""

    name: str
    title: str
    caption: str
    boxes: Sequence[Box]
    arrows: Sequence[Arrow]
    low: Place
    high: Place

    @property
    def size(self) -> Place:
        """Width and height of the picture, points."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]
