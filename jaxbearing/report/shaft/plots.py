"""Page of plots of a shaft: drawing to scale with forces, bending line, moments and internal forces."""

import textwrap
from typing import TYPE_CHECKING

from ...shafts.scene import ShaftSystem
from ...shafts.solution import ShaftSolution
from ..backends.matplotlib.panels import draw
from ..backends.matplotlib.sheet import foot, head
from ..bearing.life_facts import life_headlines
from ..display import display_unit, displayed
from .drawn import draw_picture
from .facts import overloads, shaft_warnings
from .panels import shaft_panels
from .picture import pictures

if TYPE_CHECKING:
    import matplotlib.figure

_LINE = 190
"""Number of characters in a line of the caption."""


def plot(solution: ShaftSolution, title: str, scene: ShaftSystem | None = None) -> "matplotlib.figure.Figure":
    """Figure of a shaft; see `report.plots.plot_solution`. **Arguments:** `scene`: needed for the drawing to scale."""
    from ..backends.matplotlib.page import Page

    figure = Page()
    head(figure, title, operating_text(solution))
    bottom = 0.075 + 0.019 * foot(figure, shaft_warnings(solution))
    views = [] if scene is None else pictures(scene, solution)
    top = 0.86 if not views else 0.40
    if views:
        grid = figure.add_gridspec(1, len(views), left=0.03, right=0.98, top=0.85, bottom=0.50, wspace=0.05)
        for i, view in enumerate(views):
            axes = figure.add_subplot(grid[0, i])
            draw_picture(axes, view)
            axes.set_title(view.title, fontsize=10.5, fontweight="bold")
        caption = "\n".join(textwrap.wrap(views[0].caption, _LINE))
        figure.text(0.03, 0.49, caption, fontsize=8, va="top")
    panels = shaft_panels(solution)
    grid = figure.add_gridspec(1, len(panels), left=0.06, right=0.985, top=top, bottom=bottom, wspace=0.22)
    for i, panel in enumerate(panels):
        axes = figure.add_subplot(grid[0, i])
        draw(axes, panel)
        axes.legend(fontsize=8, frameon=False)
    return figure


def operating_text(solution: ShaftSolution) -> str:
    """Shaft speed and life of the system as text."""
    speed = displayed(float(solution.operation.speed), "rad/s")
    texts = [f"shaft speed {speed:.6g} {display_unit('rad/s')}"]
    if solution.life is not None and not any(overloads(solution)):
        texts += [f"system {name} {text}" for name, text in life_headlines(solution.life)]
    return "   ·   ".join(texts)
