"""One page of plots of a bearing's steady solve; results that are not modelled are left out."""

from typing import TYPE_CHECKING

from ...bearings.solution import Solution
from ..backends.matplotlib.diagrams import draw_diagram
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..display import pretty
from ..panels import Numbers, Polar
from .operation import operating_point
from .panels import SIDES, bearing_diagrams, contact_panels, loss_panel

if TYPE_CHECKING:
    import matplotlib.artist
    import matplotlib.figure

_DIAGRAM = 5.2
"""Height of a diagram on the page, inches."""
_LOW, _WITH_BARS = 3.6, 5.0
"""Height of a page with a table of numbers instead of curves, alone and beside bars, inches."""
_FOOT, _LINE = 0.62, 0.157
"""Height of the foot of a page without notes, and of each line of notes, inches."""


def plot(solution: Solution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`: a page with the power loss by location and, round the bearing, loads, films,
    pressures and sliding speeds. The diagram of a thermal network stands below them and makes the page longer."""
    from ..backends.matplotlib.page import Page

    diagrams = bearing_diagrams(solution)
    height = _height(solution)
    if not diagrams:
        whole = Page(height=height)
        _charts(whole, solution, title)
        return whole
    whole = Page(height=height + _DIAGRAM * len(diagrams))
    heights = height, *([_DIAGRAM] * len(diagrams))
    upper, *lower = whole.subfigures(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
    _charts(upper, solution, title, noted=False)
    notes = foot(lower[-1], solution.warnings)
    for part, diagram in zip(lower, diagrams, strict=True):
        bottom = 0.03 + (0.035 * notes if part is lower[-1] else 0.0)
        draw_diagram(part.add_axes((0.03, bottom, 0.94, 0.92 - bottom)), diagram)
    return whole


def _height(solution: Solution) -> float:
    """Height of the page without the diagrams, inches: that of A4 paper, or less if a table replaces the curves."""
    from ..backends.matplotlib.page import HEIGHT

    if len(contact_panels(solution)) > 1:
        return HEIGHT
    return _LOW if loss_panel(solution) is None else _WITH_BARS


def _charts(figure: "matplotlib.figure.Figure", solution: Solution, title: str, noted: bool = True) -> None:
    """Draws all charts, without the diagrams, on a page or a part of a page. **Arguments:** `noted`: whether the notes
    are written at its foot."""
    losses, (first, *others) = loss_panel(solution), contact_panels(solution)
    head(figure, title, pretty(operating_point(solution)))
    inches = figure.dpi / figure.bbox.height
    bottom = (_FOOT + (_LINE * foot(figure, solution.warnings) if noted else 0.0)) * inches
    table = isinstance(first, Numbers)
    if losses is not None:
        between = 0.47 if others else bottom
        top, ends = (1.3, (0.635, 0.975)) if table else (1.5, (0.67, 0.93))
        left = figure.add_gridspec(1, 1, left=0.125, right=0.575, top=1.0 - 1.3 * inches, bottom=between)[0]
        right = figure.add_gridspec(1, 1, left=ends[0], right=ends[1], top=1.0 - top * inches, bottom=between)[0]
        draw(figure.add_subplot(left), losses)
        style = {"left": 0.05, "right": 0.985, "top": 0.355, "bottom": bottom, "wspace": 0.22}
        places = [*figure.add_gridspec(1, len(others), **style)] if others else []
    else:
        ends = (0.05, 0.98) if others else (0.05, 0.6)
        style = {"left": ends[0], "right": ends[1], "top": 1.0 - (1.74 if others else 1.3) * inches}
        space = {"bottom": bottom + 0.25 * inches, "wspace": 0.18, "hspace": 0.42}
        grid = figure.add_gridspec(max(1, len(others)), 2 if others else 1, **style, **space)
        right, places = grid[:, 0], [grid[i, 1] for i in range(len(others))]
    for panel, place in zip((first, *others), (right, *places), strict=True):
        draw(figure.add_subplot(place, projection="polar" if isinstance(panel, Polar) else None), panel)
    handles, names = _legend(figure)
    if handles:
        style = {
            "loc": "center right",
            "bbox_to_anchor": (0.99, 1.0 - 0.66 * inches),
            "fontsize": 9.5,
            "frameon": False,
        }
        figure.legend(handles, names, ncols=len(names), **style)


def _legend(figure: "matplotlib.figure.Figure") -> "tuple[list[matplotlib.artist.Artist], list[str]]":
    """Handles and names of the legend: one entry for each raceway or rib that appears in any chart."""
    drawn: dict[str, matplotlib.artist.Artist] = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        drawn |= dict(zip(names, handles, strict=True))
    names = [label for *_, label in SIDES if label in drawn]
    return [drawn[name] for name in names], names
