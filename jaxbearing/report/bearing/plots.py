"""One page of plots of a bearing's steady solve; what the scene does not model is not on it."""

from typing import TYPE_CHECKING, Any

from ...bearings.solution import Solution
from ..backends.matplotlib.diagrams import draw_diagram
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..display import pretty
from ..panels import Polar
from .operation import operating_point
from .panels import SIDES, bearing_diagrams, contact_panels, loss_panel

if TYPE_CHECKING:
    import matplotlib.figure

_DIAGRAM = 5.2
"""Height of a diagram on the page, inches."""


def plot(solution: Solution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`: a page with the power loss by location and, round the bearing, loads, films,
    pressures and sliding speeds. A thermal network stands below, and makes the page longer."""
    from ..backends.matplotlib.page import HEIGHT, Page

    diagrams = bearing_diagrams(solution)
    if not diagrams:
        whole = Page()
        _charts(whole, solution, title)
        return whole
    whole = Page(height=HEIGHT + _DIAGRAM * len(diagrams))
    heights = HEIGHT, *([_DIAGRAM] * len(diagrams))
    upper, *lower = whole.subfigures(len(heights), 1, squeeze=False, height_ratios=heights)[:, 0]
    _charts(upper, solution, title, noted=False)
    notes = foot(lower[-1], solution.warnings)
    for part, diagram in zip(lower, diagrams, strict=True):
        bottom = 0.03 + (0.035 * notes if part is lower[-1] else 0.0)
        draw_diagram(part.add_axes((0.03, bottom, 0.94, 0.92 - bottom)), diagram)
    return whole


def _charts(figure: Any, solution: Solution, title: str, noted: bool = True) -> None:
    """All but the diagrams, on a page of paper A4 or a part of one of this size. `noted`: with notes at its foot."""
    losses, (first, *others) = loss_panel(solution), contact_panels(solution)
    head(figure, title, pretty(operating_point(solution)))
    bottom = 0.075 + (0.019 * foot(figure, solution.warnings) if noted else 0.0)
    if losses is not None:
        between = 0.47 if others else bottom
        left = figure.add_gridspec(1, 1, left=0.125, right=0.575, top=0.843, bottom=between)[0]
        right = figure.add_gridspec(1, 1, left=0.67, right=0.93, top=0.818, bottom=between)[0]
        draw(figure.add_subplot(left), losses)
        style = {"left": 0.05, "right": 0.985, "top": 0.355, "bottom": bottom, "wspace": 0.22}
        places = [*figure.add_gridspec(1, len(others), **style)] if others else []
    else:
        style = {"left": 0.05, "right": 0.98, "top": 0.79, "bottom": bottom + 0.03, "wspace": 0.18, "hspace": 0.42}
        grid = figure.add_gridspec(max(1, len(others)), 2 if others else 1, **style)
        right, places = grid[:, 0], [grid[i, 1] for i in range(len(others))]
    for panel, place in zip((first, *others), (right, *places), strict=True):
        draw(figure.add_subplot(place, projection="polar" if isinstance(panel, Polar) else None), panel)
    handles, names = _legend(figure)
    if handles:
        style = {"loc": "center right", "bbox_to_anchor": (0.99, 0.92), "fontsize": 9.5, "frameon": False}
        figure.legend(handles, names, ncols=len(names), **style)


def _legend(figure: Any) -> tuple[list[Any], list[str]]:
    """One entry for each of the raceways and the rib that is drawn anywhere."""
    drawn: dict[str, Any] = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        drawn |= dict(zip(names, handles, strict=True))
    names = [label for *_, label in SIDES if label in drawn]
    return [drawn[name] for name in names], names
