"""Figure of a posterior: each parameter's distribution, and every pair of them."""

import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import CURVES, FAINT
from .frame import Axis, axis_for, write_below

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_SIDE = 2.5
"""Side of a panel, inches."""
_POINTS = 1500
"""Samples that are drawn of a pair."""
_LETTERS = 100
"""Letters of a line of the title."""


def posterior(
    found: Any, units: Mapping[str, str], title: str = "", predictive: Any = None
) -> "matplotlib.figure.Figure":
    """Histograms of the samples on the diagonal, with median and interval, the samples of each pair below it, and at
    the foot the measured values beside what the samples predict to be measured again.

    **Arguments:** `found`: a `fitting.posterior.Posterior`; `units`: SI unit of each parameter; `title`: at the head;
    `predictive`: a `fitting.predictive.Predictive`; `None`: no row at the foot.
    """
    from ..report.backends.matplotlib.page import Page

    names = list(found.parameters)
    rows = len(names) + (0 if predictive is None else 1)
    figure = Page(max(_SIDE * len(names), 6.5), _SIDE * rows + 0.9)
    write_below(figure, _caption(found, predictive))
    figure.suptitle("\n".join(textwrap.wrap(title, _LETTERS)), fontsize=10, parse_math=False)
    flat = found.values.reshape(-1, len(names))
    axes = [axis_for(units[name], flat[:, i]) for i, name in enumerate(names)]
    grid = figure.add_gridspec(rows, len(names))
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
    if predictive is not None:
        _measured_again(figure.add_subplot(grid[len(names), :]), predictive)
    return figure


def _caption(result: Any, predictive: Any) -> str:
    text = f"{result.in_words()}. Dashed: median and {100.0 * result.level:g} % interval."
    if predictive is None:
        return text
    return (
        f"{text} At the foot: measured values, less the median that {predictive.samples} samples predict, in standard "
        f"deviations of a measurement; bars: {100.0 * predictive.level:g} % of new measurements."
    )


def _measured_again(panel: Any, predictive: Any) -> None:
    """Draws each measured value from its predicted median, with the interval of a new measurement."""
    place = np.arange(1, len(predictive.measured) + 1)
    of = lambda values: (values - predictive.median) / predictive.deviation
    panel.vlines(place, of(predictive.lower), of(predictive.upper), color=CURVES[0], alpha=0.3, linewidth=4.0)
    inside = (predictive.lower <= predictive.measured) & (predictive.measured <= predictive.upper)
    panel.plot(place[inside], of(predictive.measured)[inside], "o", color=CURVES[0], ms=3.5)
    panel.plot(place[~inside], of(predictive.measured)[~inside], "x", color=CURVES[1], ms=6.0)
    panel.axhline(0.0, color=FAINT, linewidth=0.9, zorder=0)
    panel.xaxis.get_major_locator().set_params(integer=True)
    panel.set_xlabel("number of the measured value", fontsize=9)
    panel.set_ylabel("from the median, deviations", fontsize=9)
    grid_lines(panel)


def _histogram(panel: "matplotlib.axes.Axes", parameter: Any, axis: Axis, values: np.ndarray) -> None:
    panel.hist(axis.of(values), bins=40, color=CURVES[0], alpha=0.6)
    for value in (parameter.lower, parameter.median, parameter.upper):
        panel.axvline(float(axis.of(value)), color=FAINT, linestyle="--", linewidth=0.9)
    panel.set_yticks([])
