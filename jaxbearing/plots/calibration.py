"""Figure of a calibration: calculated against measured values, and their differences."""

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import CURVES, FAINT
from .frame import axis_for, write_below

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_WIDTH, _ROW = 9.6, 2.9
"""Width of the figure and height of the row of one quantity, inches."""
_LETTERS = 110
"""Largest number of characters in a line of the title."""


def calibration(found: Any, title: str = "") -> "matplotlib.figure.Figure":
    """Plots, for each quantity, the calculated against the measured values with error bars, and their differences at
    the operating points.

    **Arguments:** `found`: result of `jaxbearing.calibrate`; `title`: title of the figure.
    """
    from ..report.backends.matplotlib.page import Page

    figure = Page(_WIDTH, _ROW * len(found.misfits) + 0.9)
    write_below(figure, _caption(found))
    figure.suptitle("\n".join(textwrap.wrap(title, _LETTERS)), fontsize=10, parse_math=False)
    grid = figure.add_gridspec(len(found.misfits), 2)
    for row, misfit in enumerate(found.misfits):
        mine = (found.rigs == misfit.rig) & (np.asarray(found.names, dtype=object) == misfit.name)
        name = f"{found.data[misfit.rig].origin}: {misfit.name}" if len(found.data) > 1 else misfit.name
        _beside(figure.add_subplot(grid[row, 0]), found, mine, name, misfit.unit)
        _left(figure.add_subplot(grid[row, 1]), found, mine, misfit.unit)
    return figure


def _caption(result: Any) -> str:
    text = "Left: calculated over measured values, with the standard deviation of a measurement. Right: differences in "
    text += "such deviations, in the order of the data."
    if result.held_back is not None:
        text += " Open circles: values that were not fitted."
    return text


def _beside(axes: "matplotlib.axes.Axes", result: Any, mine: np.ndarray, name: str, unit: str) -> None:
    measured, predicted = result.measured[mine], result.predicted[mine]
    axis = axis_for(unit, np.concatenate([measured, predicted]))
    held = result.search.observed.held_back[mine]
    slope = float(axis.of(1.0) - axis.of(0.0))
    error = slope * result.scale * result.deviation[mine]
    for part, face in ((~held, CURVES[0]), (held, "none")):
        if np.any(part):
            x, y = axis.of(measured[part]), axis.of(predicted[part])
            axes.errorbar(x, y, xerr=error[part], fmt="o", mfc=face, color=CURVES[0], ms=4, lw=0.9)
    ends = [float(np.min(axis.of(measured))), float(np.max(axis.of(measured)))]
    axes.plot(ends, ends, color=FAINT, linewidth=0.9, zorder=0)
    axes.set_xlabel(axis.named(f"measured {name}"), fontsize=9)
    axes.set_ylabel(axis.named("calculated"), fontsize=9)
    grid_lines(axes)


def _left(axes: "matplotlib.axes.Axes", result: Any, mine: np.ndarray, unit: str) -> None:
    standard = (result.predicted - result.measured)[mine] / result.deviation[mine] / max(result.scale, 1e-300)
    place, held = result.points[mine] + 1, result.search.observed.held_back[mine]
    axes.plot(place[~held], standard[~held], "o", color=CURVES[0], ms=4)
    axes.plot(place[held], standard[held], "o", mfc="none", color=CURVES[0], ms=4)
    axes.axhline(0.0, color=FAINT, linewidth=0.9, zorder=0)
    axes.set_xlabel("operating point", fontsize=9)
    axes.set_ylabel("difference, deviations", fontsize=9)
    grid_lines(axes)
