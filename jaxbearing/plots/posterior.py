"""Figure of a posterior: each parameter's distribution, and every pair of them."""

import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import CURVES, FAINT
from .frame import Axis, axis_for, write_below

if TYPE_CHECKING:
    import matplotlib.figure

_SIDE = 2.5
"""Side of a panel, inches."""
_POINTS = 1500
"""Samples that are drawn of a pair."""
_LETTERS = 100
"""Letters of a line of the title."""


def posterior(found: Any, units: Mapping[str, str], title: str = "") -> "matplotlib.figure.Figure":
    """Histograms of the samples on the diagonal, with median and interval, and the samples of each pair below it.

    **Arguments:** `found`: a `fitting.posterior.Posterior`; `units`: SI unit of each parameter; `title`: at the head.
    """
    from ..report.backends.matplotlib.page import Page

    names = list(found.parameters)
    figure = Page(max(_SIDE * len(names), 5.0), _SIDE * len(names) + 0.9)
    write_below(figure, f"{found.in_words()}. Dashed: median and {100.0 * found.level:g} % interval.")
    figure.suptitle("\n".join(textwrap.wrap(title, _LETTERS)), fontsize=10, parse_math=False)
    flat = found.values.reshape(-1, len(names))
    axes = [axis_for(units[name], flat[:, i]) for i, name in enumerate(names)]
    grid = figure.add_gridspec(len(names), len(names))
    for row in range(len(names)):
        for column in range(row + 1):
            panel = figure.add_subplot(grid[row, column])
            if row == column:
                _histogram(panel, found.parameters[names[row]], axes[row], flat[:, row])
            else:
                chosen = np.linspace(0, len(flat) - 1, min(_POINTS, len(flat))).astype(int)
                x, y = axes[column].of(flat[chosen, column]), axes[row].of(flat[chosen, row])
                panel.plot(x, y, ".", color=CURVES[0], ms=1.5, alpha=0.5)
            if row == len(names) - 1:
                panel.set_xlabel(axes[column].named(names[column].rpartition(".")[2]), fontsize=9)
            if column == 0 and row > 0:
                panel.set_ylabel(axes[row].named(names[row].rpartition(".")[2]), fontsize=9)
            grid_lines(panel)
    return figure


def _histogram(panel: Any, one: Any, axis: Axis, values: np.ndarray) -> None:
    panel.hist(axis.of(values), bins=40, color=CURVES[0], alpha=0.6)
    for value in (one.lower, one.median, one.upper):
        panel.axvline(float(axis.of(value)), color=FAINT, linestyle="--", linewidth=0.9)
    panel.set_yticks([])
