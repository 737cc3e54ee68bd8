"""A drawing as one SVG element for a page: shapes in millimetres, texts in points of the page."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence

from ..colours import FAINT, INK
from ..diagrams import LETTER, TEXT, Diagram

_MARGIN = 8.0
_LINE = 1.25
"""Height of a line of text, in multiples of the font size."""

Point = tuple[float, float]


class Drawing:
    """A drawing of shapes to one scale, with x to the right and y up. The picture is as large as its shapes and texts
    need.

    **Arguments:**
    - `title`: description of the drawing for screen readers.
    - `scale`: points of the page per millimetre.
    """

    def __init__(self, title: str, scale: float):
        self.scale = scale
        self._root = ET.Element("svg", {"role": "img", "aria-label": title})
        ET.SubElement(self._root, "title").text = title
        self._seen: list[Point] = []

    def circle(self, centre: Point, radius: float, **style: str | float) -> None:
        x, y = self._at(centre)
        r = radius * self.scale
        self._seen += [(x - r, y - r), (x + r, y + r)]
        self._add("circle", cx=x, cy=y, r=r, **style)

    def ring(self, centre: Point, inside: float, outside: float, **style: str | float) -> None:
        x, y = self._at(centre)
        r = outside * self.scale
        self._seen += [(x - r, y - r), (x + r, y + r)]
        path = " ".join(
            f"M{x - q:.2f},{y:.2f} a{q:.2f},{q:.2f} 0 1,0 {2 * q:.2f},0 a{q:.2f},{q:.2f} 0 1,0 {-2 * q:.2f},0 Z"
            for q in (r, inside * self.scale)
        )
        self._add("path", d=path, fill_rule="evenodd", **style)

    def polygon(self, points: Iterable[Point], **style: str | float) -> None:
        places = [self._at(point) for point in points]
        self._seen += places
        self._add("polygon", points=" ".join(f"{x:.2f},{y:.2f}" for x, y in places), **style)

    def line(self, points: Iterable[Point], **style: str | float) -> None:
        places = [self._at(point) for point in points]
        self._seen += places
        text = " ".join(f"{x:.2f},{y:.2f}" for x, y in places)
        self._add("polyline", points=text, **{"fill": "none", **style})

    def arrow(self, start: Point, end: Point, colour: str, width: float = 2.0, **attributes: str | float) -> None:
        """Draws a straight arrow. The head is part of its length and shrinks with it, so that the length stays to
        scale."""
        (x0, y0), (x1, y1) = self._at(start), self._at(end)
        length = math.hypot(x1 - x0, y1 - y0)
        if length < 0.5:
            return
        self._seen += [(x0, y0), (x1, y1)]
        ux, uy = (x1 - x0) / length, (y1 - y0) / length
        head, half = min(4.0 * width, 0.6 * length), min(1.6 * width, 0.24 * length)
        bx, by = x1 - head * ux, y1 - head * uy
        self._add("line", x1=x0, y1=y0, x2=bx, y2=by, stroke=colour, stroke_width=width, **attributes)
        corners = [(x1, y1), (bx - half * uy, by + half * ux), (bx + half * uy, by - half * ux)]
        self._add("polygon", points=" ".join(f"{x:.2f},{y:.2f}" for x, y in corners), fill=colour)

    def text(
        self,
        place: Point,
        words: str,
        size: float = 12.0,
        anchor: str = "middle",
        fill: str = INK,
        edge: bool = True,
    ) -> None:
        """Writes lines of text, vertically centred at the place; a white `edge` keeps them readable on top of lines."""
        x, y = self._at(place)
        lines = words.split("\n")
        width = LETTER * size * max(map(len, lines))
        left = x - {"start": 0.0, "middle": 0.5, "end": 1.0}[anchor] * width
        height = _LINE * size * len(lines)
        self._seen += [(left, y - height / 2), (left + width, y + height / 2)]
        halo: dict[str, str | float] = {}
        if edge:
            halo = {"paint_order": "stroke", "stroke": "#ffffff", "stroke_width": 3.5, "stroke_linejoin": "round"}
        element = self._add("text", font_size=size, text_anchor=anchor, fill=fill, **halo)
        for i, line in enumerate(lines):
            base = y + size * (0.35 + _LINE * (i - (len(lines) - 1) / 2))
            ET.SubElement(element, "tspan", {"x": f"{x:.2f}", "y": f"{base:.2f}"}).text = line

    def markup(self, natural: bool = False) -> str:
        """The SVG element, as wide as its container; with `natural`, at most as wide as the drawing's own size in
        points."""
        x, y = (sorted(values) for values in zip(*self._seen, strict=True))
        left, top = x[0] - _MARGIN, y[0] - _MARGIN
        width, height = x[-1] - left + _MARGIN, y[-1] - top + _MARGIN
        self._root.set("viewBox", f"{left:.1f} {top:.1f} {width:.1f} {height:.1f}")
        if natural:
            self._root.set("style", f"max-width:{width:.1f}pt")
        return ET.tostring(self._root, encoding="unicode")

    def _at(self, point: Sequence[float]) -> Point:
        return float(point[0]) * self.scale, -float(point[1]) * self.scale

    def _add(self, kind: str, **attributes: str | float) -> ET.Element:
        written = {
            name.replace("_", "-"): f"{value:.2f}" if isinstance(value, float) else str(value)
            for name, value in attributes.items()
        }
        return ET.SubElement(self._root, kind, written)


def diagram_markup(diagram: Diagram) -> str:
    """A diagram as one SVG element, which shrinks together with its texts if there is too little room."""
    drawing = Drawing(f"{diagram.title}. {diagram.caption}", 1.0)
    for arrow in diagram.arrows:
        drawing.polygon(arrow.outline(), fill=arrow.colour)
    for box in diagram.boxes:
        if box.fill != "none":
            x, y = box.width / 2.0, box.height / 2.0
            corners = [(-x, -y), (x, -y), (x, y), (-x, y)]
            places = [(box.centre[0] + right, box.centre[1] + up) for right, up in corners]
            drawing.polygon(places, fill=box.fill, stroke=FAINT, stroke_width=0.8)
        drawing.text(box.centre, box.text, size=TEXT, edge=False)
    for arrow in diagram.arrows:
        if arrow.text:
            drawing.text(arrow.at, arrow.text, size=TEXT)
    return drawing.markup(natural=True)
