"""A page of traction curves: one diagram for each temperature and speed, one curve for each pressure."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ...machines import TwoDiskSolution
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..colours import INK
from ..panels import Curves
from .curves import curves_of
from .panels import traction_panel

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

PANELS = 12
"""Largest number of diagrams on the page; a note at its foot says how many there are."""
_MARKED = 40
"""Number of points of a curve up to which each point is marked."""


def plot(solution: TwoDiskSolution, title: str) -> "matplotlib.figure.Figure":
    """Figure of traction curves; see `report.plots.plot_solution`."""
    curves = list(curves_of(solution))
    from ..backends.matplotlib.page import Page

    places = list(dict.fromkeys(curve.place[:2] for curve in curves))
    left_out = [] if len(places) <= PANELS else [f"{PANELS} of {len(places)} pairs of temperature and speed are shown"]
    places = places[:PANELS]
    rows, columns = _layout(places)
    figure = Page()
    operation = type(solution.operation).__dataclass_fields__
    varied = operation["load" if solution.operation.pressure is None else "pressure"].metadata["description"]
    text = f"Traction coefficient over slide-to-roll ratio (difference over mean speed), one curve for each {varied}"
    head(figure, title, text)
    bottom = 0.085 + 0.019 * foot(figure, [*left_out, *solution.warnings])
    grid = figure.add_gridspec(
        rows, columns, left=0.065, right=0.985, top=0.815, bottom=bottom, wspace=0.14, hspace=0.42 if rows > 2 else 0.3
    )
    first: Any = None
    for number, place in enumerate(places):
        axes = figure.add_subplot(grid[divmod(number, columns)], sharex=first, sharey=first)
        first = axes if first is None else first
        draw_curves(axes, traction_panel(solution, [curve for curve in curves if curve.place[:2] == place]))
        if number % columns:
            axes.set_ylabel("")
        if number < len(places) - columns:
            axes.set_xlabel("")
    handles, names = first.get_legend_handles_labels()
    figure.legend(
        handles,
        names,
        loc="upper left",
        bbox_to_anchor=(0.022, 0.908),
        ncols=7,
        fontsize=9.5,
        frameon=False,
    )
    return figure


def _layout(places: list[tuple[int, ...]]) -> tuple[int, int]:
    """Numbers of rows and columns; rows are temperatures and columns speeds if both vary."""
    temperatures, speeds = (len(dict.fromkeys(place[i] for place in places)) for i in (0, 1))
    if temperatures > 1 and 1 < speeds <= 4 and temperatures * speeds == len(places):
        return temperatures, speeds
    columns = math.ceil(math.sqrt(len(places)))
    return math.ceil(len(places) / columns), columns


def draw_curves(axes: "matplotlib.axes.Axes", panel: Curves) -> None:
    """Draws a panel with lines at zero traction and zero slide; points are marked up to `_MARKED`."""
    slide = np.asarray(panel.series[0].x)
    axes.axhline(0.0, color=INK, linewidth=0.6)
    if slide[0] < 0.0 < slide[-1]:
        axes.axvline(0.0, color=INK, linewidth=0.6)
    elif slide[0] != slide[-1]:
        axes.set_xlim(min(0.0, slide[0] * 1.02), max(0.0, slide[-1] * 1.02))
    draw(axes, panel, marked=slide.size <= _MARKED)
