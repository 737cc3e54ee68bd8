"""Diagrams on paper: draws the descriptions of `diagrams` on matplotlib axes."""

from typing import TYPE_CHECKING

from ...colours import FAINT, INK
from ...diagrams import TEXT, Diagram
from .sheet import title_of

if TYPE_CHECKING:
    import matplotlib.axes

_HALO = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 0.6}
_POINTS = 72.0
"""Points per inch."""


def draw_diagram(axes: "matplotlib.axes.Axes", diagram: Diagram) -> None:
    """Draws a diagram on axes, shrunk if they are too small for it; shapes and texts have the same scale."""
    from matplotlib.patches import Polygon, Rectangle

    axes.set_axis_off()
    title_of(axes, diagram.title)
    room = axes.get_window_extent()
    dots = axes.figure.dpi / _POINTS
    scale = min(1.0, room.width / dots / diagram.size[0], room.height / dots / diagram.size[1])
    # the diagram is centred in the axes
    for set_limits, low, high, across in (
        (axes.set_xlim, diagram.low[0], diagram.high[0], room.width),
        (axes.set_ylim, diagram.low[1], diagram.high[1], room.height),
    ):
        middle, half = 0.5 * (low + high), 0.5 * across / dots / scale
        set_limits(middle - half, middle + half)
    style = {"fontsize": scale * TEXT, "ha": "center", "va": "center", "color": INK}
    for arrow in diagram.arrows:
        axes.add_patch(Polygon(arrow.outline(), closed=True, facecolor=arrow.colour, edgecolor="none"))
    for box in diagram.boxes:
        corner = box.centre[0] - box.width / 2.0, box.centre[1] - box.height / 2.0
        if box.fill != "none":
            axes.add_patch(Rectangle(corner, box.width, box.height, facecolor=box.fill, edgecolor=FAINT, linewidth=0.8))
        axes.text(*box.centre, box.text, **style)
    for arrow in diagram.arrows:
        if arrow.text:
            axes.text(*arrow.at, arrow.text, bbox=_HALO, **style)
