"""A solved bearing seen along its axis, to scale, with the loads of the contacts as arrows."""

import math

import numpy as np

from ....bearings.bearing import AbstractBearing
from ....bearings.flanks import by_flank
from ....bearings.operation import LOAD_FIELDS
from ....bearings.solution import Solution
from ...backends.svg import Drawing
from ...colours import CAGE, CENTRE_LINE, INK, INNER, OUTER, RING, ROLLER
from ..azimuth import place_at
from ..operation import field_text
from .sizes import FrontSizes

_WIDTH = 290.0
"""Width of the outer ring, points of the page."""
_LONGEST = 0.42
"""Longest arrow, in radii of the bore."""


def front_view(scene: AbstractBearing, solution: Solution) -> str:
    """The view as SVG: rings, elements at their azimuths (0 at the bottom, counter-clockwise), their forces on the
    rings, and the applied load."""
    sizes = FrontSizes(scene, scene.outline().shoulder)
    elements = solution.elements
    drawing = Drawing("The bearing seen along its axis, with the loads of its contacts", _WIDTH / (2.0 * sizes.outside))
    drawing.ring((0.0, 0.0), sizes.outer, sizes.outside, fill=RING, stroke=INK, stroke_width=1.0)
    drawing.ring((0.0, 0.0), sizes.bore, sizes.inner, fill=RING, stroke=INK, stroke_width=1.0)
    if sizes.cage is not None:
        drawing.ring((0.0, 0.0), *sizes.cage, fill=CAGE, stroke=INK, stroke_width=0.6)
    azimuth = np.asarray(elements.azimuth)
    for angle in azimuth:
        drawing.circle(place_at(angle, sizes.pitch), 0.5 * sizes.diameter, fill=ROLLER, stroke=INK, stroke_width=1.0)
    # sum over both flanks of a race
    load = lambda race: np.sum([getattr(flank, f"load_{race}") for flank in by_flank(elements)], axis=0)
    _loads(drawing, sizes, azimuth, load("inner"), load("outer"))
    _applied(drawing, sizes, solution)
    drawing.text(place_at(0.0, sizes.pitch), "0", size=9.0)
    drawing.circle(
        (0.0, 0.0), sizes.pitch, fill="none", stroke=CENTRE_LINE, stroke_width=0.8, stroke_dasharray="6 3 1 3"
    )
    return drawing.markup()


def _loads(drawing: Drawing, sizes: FrontSizes, azimuth: np.ndarray, inner: np.ndarray, outer: np.ndarray) -> None:
    largest = float(max(inner.max(), outer.max()))
    if not largest > 0.0:
        return
    length = _LONGEST * sizes.bore / largest
    for angle, on_inner, on_outer in zip(azimuth, inner, outer, strict=True):
        start = sizes.outside
        drawing.arrow(
            place_at(angle, start), place_at(angle, start + length * on_outer), OUTER, data_load=float(on_outer)
        )
        start = sizes.bore
        drawing.arrow(
            place_at(angle, start), place_at(angle, start - length * on_inner), INNER, data_load=float(on_inner)
        )


_SAID = {
    "axial": "axial",
    "moment": "tilt",
    "about the load line": "tilt_lateral",
    "radial": "radial",
    "lateral": "lateral",
}
"""Short name of a load -> degree of freedom of the ring along which it acts."""


def _applied(drawing: Drawing, sizes: FrontSizes, solution: Solution) -> None:
    """Draws the load on the inner ring and its speed in the middle."""
    operation = solution.operation
    number = lambda freedom: float(load) if (load := operation.load(freedom)) is not None else 0.0
    radial, lateral = number("radial"), number("lateral")
    words = [field_text(operation, "inner_speed")]
    for name, freedom in _SAID.items():
        if number(freedom):
            words.append(f"{name} {field_text(operation, LOAD_FIELDS[freedom], 5)}")
    if radial or lateral:
        reach = 0.32 * sizes.bore / math.hypot(radial, lateral)
        drawing.arrow((0.0, 0.0), (reach * lateral, -reach * radial), INK, width=4.0)
    # smaller letters where the bore is small
    size = min(12.0, 0.55 * sizes.bore * drawing.scale / len(words))
    gap = (0.625 * size * len(words) + 6.0) / drawing.scale
    drawing.text((0.0, gap if radial else 0.0), "\n".join(words), size=size)
