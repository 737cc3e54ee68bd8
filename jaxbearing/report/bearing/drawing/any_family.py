"""Drawing of a bearing of any family: a view along the axis, and one element in a section through the axis."""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, SupportsFloat

import equinox as eqx
import numpy as np

from ....bearings.bearing import AbstractBearing
from ....bearings.operation import LOAD_FIELDS
from ...colours import INK
from ...display import display_unit, displayed
from ..operation import field_text
from .front import draw_front
from .marks import DIMENSION, dimension, leader, length_text
from .section import draw_outline
from .sizes import FrontSizes
from .view import view

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_CAPTION = (
    "Names as in --set and in Python; those without a dot belong to geometry. To scale, except for bore, outside "
    "diameter and width\nof the rings, which have usual proportions. The section shows the unloaded bearing, its axis "
    "below."
)
Label = tuple[str, tuple[float, float]]


class _Patches:
    """Matplotlib axes with the drawing methods that `section` uses."""

    def __init__(self, axes: "matplotlib.axes.Axes"):
        self.axes = axes
        self.points: list[tuple[float, float]] = []

    def polygon(self, points: Sequence[tuple[float, float]], fill: str, stroke: str, stroke_width: float) -> None:
        x, y = zip(*points, strict=True)
        self.points += points
        self.axes.fill(x, y, facecolor=fill, edgecolor=stroke, linewidth=0.9 * stroke_width)

    def circle(self, centre: tuple[float, float], radius: float, fill: str, stroke: str, stroke_width: float) -> None:
        from matplotlib.patches import Circle

        style = {"facecolor": fill, "edgecolor": stroke, "linewidth": 0.9 * stroke_width, "zorder": 3}
        self.axes.add_patch(Circle(centre, radius, **style))

    def line(
        self, points: Sequence[tuple[float, float]], stroke: str, stroke_width: float, stroke_dasharray: str
    ) -> None:
        dashes = (0, tuple(map(float, stroke_dasharray.split())))
        self.axes.plot(*zip(*points, strict=True), color=stroke, linewidth=stroke_width, linestyle=dashes, zorder=4)


def draw_in_section(scene: AbstractBearing) -> "matplotlib.figure.Figure":
    """See `report.drawing.draw_bearing`."""
    from ...backends.matplotlib.page import Page

    figure = Page()
    front = view(figure, "Seen along the axis", (0.01, 0.09, 0.47, 0.85))
    section = view(figure, "One element in a section through the axis", (0.50, 0.34, 0.48, 0.60))
    draw_front(front, scene, FrontSizes(scene))
    patches = _Patches(section)
    outline, texts = scene.outline(), dict(_dimensions(scene))
    draw_outline(patches, outline)
    for ends in outline.dimensions:
        dimension(section, *ends)
    labels = [(texts[f"geometry.{name}"], place) for name, place in outline.labels.items()]
    drawn = {f"n_{scene.element}s", "pitch_diameter", *outline.labels}
    _beside(section, np.asarray(patches.points), labels)
    rest = [text for path, text in texts.items() if path.removeprefix("geometry.") not in drawn]
    figure.text(0.52, 0.30, "\n".join(rest), fontsize=8.5, color=DIMENSION, va="top", linespacing=1.5)
    figure.text(0.02, 0.02, _CAPTION, fontsize=8, color=INK, linespacing=1.4)
    return figure


def _beside(axes: "matplotlib.axes.Axes", points: np.ndarray, labels: list[Label]) -> None:
    """Places labels on both sides of the section, evenly spaced and in the order of the heights of the features they
    mark."""
    (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
    width, height, middle = right - left, high - low, 0.5 * (left + right)
    for side in (-1.0, 1.0):
        own = sorted(
            (label for label in labels if (label[1][0] >= middle) == (side > 0.0)), key=lambda label: label[1][1]
        )
        places = np.linspace(low + 0.1 * height, high - 0.1 * height, len(own)) if len(own) > 1 else [low]
        x = right + 0.1 * width if side > 0.0 else left - 0.1 * width
        for (text, target), y in zip(own, places, strict=True):
            leader(axes, (x, float(y)), text, target, ha="left" if side > 0.0 else "right")
    axes.set_xlim(left - 0.95 * width, right + 0.95 * width)
    axes.set_ylim(low - 0.08 * height, high + 0.08 * height)


def _dimensions(scene: AbstractBearing) -> Iterator[tuple[str, str]]:
    """Path and text of each number of geometry and cage, and of each load that the view does not show."""
    for table in ("geometry", "cage"):
        part = getattr(scene, table, None)
        for field in () if part is None else dataclasses.fields(part):
            value = getattr(part, field.name)
            if value is None or isinstance(value, str | eqx.Module):
                continue
            name = field.name if table == "geometry" else f"{table}.{field.name}"
            note = " (on the diameter)" if field.name == "guiding_clearance" else ""
            yield f"{table}.{field.name}", f"{name} {_value(value, field.metadata.get('unit', ''))}{note}"
    for freedom, name in LOAD_FIELDS.items():
        if freedom not in ("radial", "lateral") and scene.operation.load(freedom) is not None:
            yield f"operation.{name}", f"operation.{name} {field_text(scene.operation, name)}, on the inner ring"


def _value(value: SupportsFloat, unit: str) -> str:
    """A count, or a number with the unit given in its class, as text."""
    if isinstance(value, int):
        return str(value)
    if unit == "m":
        return length_text(value)
    size = float(value)
    return f"{displayed(size, unit, size):.5g} {display_unit(unit, size)}".rstrip()
