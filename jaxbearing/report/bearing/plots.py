"""One page of plots of a bearing's steady solve; what the scene does not model is not on it."""

from typing import TYPE_CHECKING, Any

from ...bearings.solution import Solution
from ..backends.matplotlib.diagrams import draw_diagram
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..display import pretty
from .operation import operating_point
from .panels import SIDES, bearing_diagrams, load_panel, loss_panel, round_panels

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
    losses, rounds = loss_panel(solution), round_panels(solution)
    head(figure, title, pretty(operating_point(solution)))
    bottom = 0.075 + (0.019 * foot(figure, solution.warnings) if noted else 0.0)
    if losses is not None:
        left = figure.add_gridspec(1, 1, left=0.125, right=0.575, top=0.843, bottom=0.47)
        right = figure.add_gridspec(1, 1, left=0.67, right=0.93, top=0.818, bottom=0.47)
        lower = figure.add_gridspec(1, len(rounds), left=0.05, right=0.985, top=0.355, bottom=bottom, wspace=0.17)
        draw(figure.add_subplot(left[0]), losses)
        loads = figure.add_subplot(right[0], projection="polar")
        places = [lower[i] for i in range(len(rounds))]
    else:
        grid = figure.add_gridspec(
            len(rounds), 2, left=0.05, right=0.98, top=0.79, bottom=bottom + 0.03, wspace=0.18, hspace=0.42
        )
        loads = figure.add_subplot(grid[:, 0], projection="polar")
        places = [grid[i, 1] for i in range(len(rounds))]
    draw(loads, load_panel(solution))
    for panel, place in zip(rounds, places, strict=True):
        draw(figure.add_subplot(place), panel)
    handles, names = _legend(figure)
    figure.legend(handles, names, loc="center right", bbox_to_anchor=(0.99, 0.92), ncols=2, fontsize=9.5, frameon=False)


def _legend(figure: Any) -> tuple[list[Any], list[str]]:
    """One entry for each of the raceways and the rib that is drawn anywhere."""
    drawn: dict[str, Any] = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        drawn |= dict(zip(names, handles, strict=True))
    names = [label for *_, label in SIDES if label in drawn]
    return [drawn[name] for name in names], names
