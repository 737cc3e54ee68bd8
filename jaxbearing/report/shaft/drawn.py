"""Drawing of shaft pictures: as SVG for a page, or with matplotlib for paper."""

from typing import TYPE_CHECKING

from ..backends.svg import Drawing
from .picture import Area, Picture, Pointer, Stroke, Words

if TYPE_CHECKING:
    import matplotlib.axes

_WIDTH = 640.0
"""Width of a picture on a page, points."""
_SVG_DASHES = {"solid": "none", "dash": "6 4", "dot": "2 3", "dashdot": "9 3 2 3"}
_DASHES = {"solid": "-", "dash": "--", "dot": ":", "dashdot": "-."}


def svg(picture: Picture) -> str:
    """The picture as one SVG element."""
    xs = [x for item in picture.items if isinstance(item, Area | Stroke) for x, _ in item.points]
    drawing = Drawing(picture.title, _WIDTH / max(max(xs) - min(xs), 0.6 * picture.height))
    for item in picture.items:
        match item:
            case Area():
                drawing.polygon(item.points, fill=item.fill, stroke=item.edge, stroke_width=item.width)
            case Stroke():
                dash = _SVG_DASHES[item.dash]
                drawing.line(item.points, stroke=item.colour, stroke_width=item.width, stroke_dasharray=dash)
            case Pointer():
                drawing.arrow(item.start, item.end, item.colour, width=2.6, data_load=item.value)
            case Words():
                drawing.text(item.place, item.text, size=11.0, anchor=item.anchor, fill=item.colour)
    return drawing.markup()


def draw_picture(axes: "matplotlib.axes.Axes", picture: Picture) -> None:
    """Draws a picture on matplotlib axes, with equal scales in both directions."""
    for item in picture.items:
        match item:
            case Area():
                x, y = zip(*item.points, strict=True)
                axes.fill(x, y, facecolor=item.fill, edgecolor=item.edge, linewidth=0.8 * item.width)
            case Stroke():
                x, y = zip(*item.points, strict=True)
                axes.plot(x, y, _DASHES[item.dash], color=item.colour, linewidth=item.width)
            case Pointer():
                arrow = {"arrowstyle": "-|>,head_width=0.28,head_length=0.55", "linewidth": 1.8, "color": item.colour}
                arrow |= {"shrinkA": 0, "shrinkB": 0}
                axes.annotate("", xy=item.end, xytext=item.start, arrowprops=arrow)
            case Words():
                style = {"fontsize": 8, "color": item.colour, "ha": "center", "va": "center", "parse_math": False}
                halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.5}
                axes.text(*item.place, item.text, bbox=halo, zorder=5, **style)
    # matplotlib does not count annotations and texts for the limits of axes
    beside = [place for item in picture.items if isinstance(item, Pointer) for place in (item.start, item.end)]
    beside += [item.place for item in picture.items if isinstance(item, Words)]
    axes.update_datalim(beside)
    axes.set_aspect("equal")
    axes.margins(0.03, 0.06)
    axes.autoscale_view()
    axes.set_axis_off()
