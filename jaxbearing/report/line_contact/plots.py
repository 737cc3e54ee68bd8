"""A page of plots of a line contact: pressure and film."""

from typing import TYPE_CHECKING

import numpy as np

from ...ehl import LineContactSolution
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..display import pretty
from .operation import inlet_side, operating_text
from .panels import SHOWN, line_contact_panels

if TYPE_CHECKING:
    import matplotlib.figure


def plot(solution: LineContactSolution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`."""
    from ..backends.matplotlib.page import Page

    figure = Page()
    head(figure, title, pretty(operating_text(solution)))
    bottom = 0.085 + 0.019 * foot(figure, solution.warnings)
    grid = figure.add_gridspec(2, 1, left=0.075, right=0.975, top=0.86, bottom=bottom, hspace=0.3)
    pressure, film = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    farthest = float(np.abs(np.asarray(solution.profile.x)).max()) / float(solution.hertz.half_width)
    for axes, panel in zip((pressure, film), line_contact_panels(solution), strict=True):
        draw(axes, panel)
        axes.set_xlim(-SHOWN, min(SHOWN, farthest))
        axes.set_xlabel("")
    pressure.legend(fontsize=9, frameon=False)
    # the title already names the curve
    handles, names = film.get_legend_handles_labels()
    film.legend(handles[1:], names[1:], fontsize=9, frameon=False, loc="upper center")
    where = f"place along rolling over the Hertz half width; oil enters {inlet_side(solution)}"
    film.set_xlabel(where, fontsize=9)
    return figure
