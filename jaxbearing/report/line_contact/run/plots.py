"""A page of plots of a transient run of a line contact: films, speed, profiles."""

from typing import TYPE_CHECKING

import numpy as np

from ....ehl import LineContactHistory
from ...backends.matplotlib.legends import clear_legend
from ...backends.matplotlib.sheet import foot, grid_lines, head, title_of
from ...colours import INNER, LOSS, OUTER
from ...display import axis_unit

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

PROFILES = 6
"""Number of profiles drawn for a run."""


def plot(history: LineContactHistory, title: str) -> "matplotlib.figure.Figure":
    """See `report.histories.plot_history`: the page shows central and minimum film and speed over time, and profiles at
    some times."""
    from ...backends.matplotlib.page import Page

    figure = Page()
    reached = f"{1e3 * float(history.time[-1]):.6g} ms, {int(history.accepted)} steps"
    head(figure, title, reached)
    bottom = 0.08 + 0.019 * foot(figure, history.warnings if history.completed else [history.failure()])
    grid = figure.add_gridspec(2, 2, left=0.06, right=0.98, top=0.86, bottom=bottom, wspace=0.18, hspace=0.36)
    time = 1e3 * np.asarray(history.time)
    _films(figure.add_subplot(grid[0, 0]), time, history)
    _speed(figure.add_subplot(grid[1, 0]), time, history)
    _profiles(figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1]), time, history)
    return figure


def _films(axes: "matplotlib.axes.Axes", time: np.ndarray, history: LineContactHistory) -> None:
    unit, factor = axis_unit("m", float(np.max(np.asarray(history.film.central))))
    axes.plot(time, factor * np.asarray(history.film.central), color=INNER, linewidth=1.6, label="central")
    axes.plot(time, factor * np.asarray(history.film.minimum), color=OUTER, linewidth=1.6, label="minimum")
    axes.set_ylim(bottom=0.0)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, f"Film thickness, {unit}")
    grid_lines(axes)
    clear_legend(axes)


def _speed(axes: "matplotlib.axes.Axes", time: np.ndarray, history: LineContactHistory) -> None:
    speed = np.asarray(history.entrainment_speed)
    unit, factor = axis_unit("m/s", float(np.abs(speed).max()))
    axes.plot(time, factor * speed, color=LOSS, linewidth=1.4)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, f"Entrainment speed, {unit}")
    grid_lines(axes)


def _profiles(
    upper: "matplotlib.axes.Axes", lower: "matplotlib.axes.Axes", time: np.ndarray, history: LineContactHistory
) -> None:
    from matplotlib import colormaps

    width = float(history.hertz.half_width)
    x = np.asarray(history.profile.x) / width
    wanted = np.linspace(time[0], time[-1], PROFILES)
    rows = sorted({int(np.argmin(np.abs(time - moment))) for moment in wanted})
    p_unit, p_factor = axis_unit("Pa", float(history.hertz.pressure))
    h_unit, h_factor = axis_unit("m", float(np.max(np.asarray(history.film.central))))
    for i, row in enumerate(rows):
        colour = colormaps["viridis"](0.9 * i / max(len(rows) - 1, 1))
        upper.plot(x, p_factor * np.asarray(history.profile.pressure[row]), color=colour, linewidth=1.2)
        lower.plot(
            x,
            h_factor * np.asarray(history.profile.film[row]),
            color=colour,
            linewidth=1.2,
            label=f"{time[row]:.3g} ms",
        )
    lower.set_ylim(0.0, 2.0 * h_factor * float(np.max(np.asarray(history.film.central))))
    for axes in (upper, lower):
        axes.set_xlim(-1.5, 1.5)
        grid_lines(axes)
    lower.legend(fontsize=8, frameon=False, ncols=3, loc="upper center")
    lower.set_xlabel("place along rolling over the Hertz half width", fontsize=9)
    title_of(upper, f"Pressure, {p_unit}")
    title_of(lower, f"Film thickness, {h_unit}")
