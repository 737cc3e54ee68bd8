"""A solved bearing seen along its axis, to scale, with the loads of the contacts as arrows."""

import math
from typing import Any

import numpy as np

from ...bearings.operation import LOAD_FIELDS
from ...bearings.outline import RING_THICKNESS
from ...bearings.solution import Solution
from ..drawing import CAGE, FAINT, RING, ROLLER
from ..svg import INK, Drawing, Point
from .operation import field_text
from .plots import INNER, OUTER

_WIDTH = 290.0
"""Width of the outer ring, points of the page."""
_LONGEST = 0.42
"""Longest arrow, in radii of the bore."""


class Sizes:
    """Radii of the drawing, mm: of the pitch circle, the elements, the rings where elements touch or shoulders end."""

    def __init__(self, scene: Any):
        geometry = scene.geometry
        mm = lambda value: 1e3 * float(np.asarray(value))
        self.pitch = 0.5 * mm(geometry.pitch_diameter)
        self.diameter, shoulder = mm(scene.mean_diameter), scene.outline().shoulder
        self.inner, self.outer = self.pitch - shoulder, self.pitch + shoulder
        self.back = (0.5 + RING_THICKNESS) * self.diameter
        cage = getattr(scene, "cage", None)
        self.cage = None if cage is None else (0.5 * mm(cage.bore(geometry)), 0.5 * mm(cage.outside(geometry)))

    @property
    def bore(self) -> float:
        return self.pitch - self.back

    @property
    def outside(self) -> float:
        return self.pitch + self.back


def front_view(scene: Any, solution: Solution) -> str:
    """SVG: rings, elements at their azimuths (0 below, counter-clockwise), the force of each on the rings, the applied
    load."""
    sizes = Sizes(scene)
    elements = solution.elements
    drawing = Drawing("The bearing seen along its axis, with the loads of its contacts", _WIDTH / (2.0 * sizes.outside))
    drawing.ring((0.0, 0.0), sizes.outer, sizes.outside, fill=RING, stroke=INK, stroke_width=1.0)
    drawing.ring((0.0, 0.0), sizes.bore, sizes.inner, fill=RING, stroke=INK, stroke_width=1.0)
    if sizes.cage is not None:
        drawing.ring((0.0, 0.0), *sizes.cage, fill=CAGE, stroke=INK, stroke_width=0.6)
    azimuth = np.asarray(elements.azimuth)
    for angle in azimuth:
        drawing.circle(at(angle, sizes.pitch), 0.5 * sizes.diameter, fill=ROLLER, stroke=INK, stroke_width=1.0)
    _loads(drawing, sizes, azimuth, np.asarray(elements.load_inner), np.asarray(elements.load_outer))
    _applied(drawing, sizes, solution)
    drawing.text(at(0.0, sizes.pitch), "0", size=9.0)
    drawing.circle((0.0, 0.0), sizes.pitch, fill="none", stroke=FAINT, stroke_width=0.8, stroke_dasharray="6 3 1 3")
    return drawing.markup()


def at(azimuth: float, radius: float) -> Point:
    """Azimuth 0 is below, counter-clockwise."""
    return radius * math.sin(azimuth), -radius * math.cos(azimuth)


def _loads(drawing: Drawing, sizes: Sizes, azimuth: np.ndarray, inner: np.ndarray, outer: np.ndarray) -> None:
    largest = float(max(inner.max(), outer.max()))
    if not largest > 0.0:
        return
    length = _LONGEST * sizes.bore / largest
    for angle, on_inner, on_outer in zip(azimuth, inner, outer, strict=True):
        start = sizes.outside
        drawing.arrow(at(angle, start), at(angle, start + length * on_outer), OUTER, data_load=float(on_outer))
        start = sizes.bore
        drawing.arrow(at(angle, start), at(angle, start - length * on_inner), INNER, data_load=float(on_inner))


_SAID = {
    "axial": "axial",
    "moment": "tilt",
    "about the load line": "tilt_lateral",
    "radial": "radial",
    "lateral": "lateral",
}
"""Name of a load, where there is little room, and the freedom of the ring along which it acts."""


def _applied(drawing: Drawing, sizes: Sizes, solution: Solution) -> None:
    """Load on the inner ring and its speed, in the middle."""
    operation = solution.operation
    number = lambda freedom: float(given) if (given := operation.load(freedom)) is not None else 0.0
    radial, lateral = number("radial"), number("lateral")
    words = [field_text(operation, "inner_speed")]
    for name, freedom in _SAID.items():
        if number(freedom):
            words.append(f"{name} {field_text(operation, LOAD_FIELDS[freedom], 5)}")
    if radial or lateral:
        reach = 0.32 * sizes.bore / math.hypot(radial, lateral)
        drawing.arrow((0.0, 0.0), (reach * lateral, -reach * radial), INK, width=4.0)
    # a small bore holds four lines of smaller letters
    size = min(12.0, 0.55 * sizes.bore * drawing.scale / len(words))
    gap = (0.625 * size * len(words) + 6.0) / drawing.scale
    drawing.text((0.0, gap if radial else 0.0), "\n".join(words), size=size)
