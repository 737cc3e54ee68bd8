"""Pages of plots of a line contact: profiles, and films over time."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ...ehl import LineContactHistory, LineContactSolution
from ..bearing.plots import INNER, LOSS, OUTER
from ..sheet import FAINT, axis_unit, foot, grid_lines, head, pretty, title_of
from .summary import operating_text

if TYPE_CHECKING:
    import matplotlib.figure

PROFILES = 6
"""Profiles that are drawn of a run."""
SHOWN = 2.0
"""Half widths to each side that are drawn."""


def plot_line_contact(solution: LineContactSolution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`."""
    if np.ndim(solution.status) != 0:
        raise ValueError("plot_solution draws one solution, got a batch: take one lane of it")
    if not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    from ..page import Page

    figure = Page()
    head(figure, title, pretty(operating_text(solution)))
    bottom = 0.085 + 0.019 * foot(figure, solution.warnings)
    grid = figure.add_gridspec(2, 1, left=0.075, right=0.975, top=0.86, bottom=bottom, hspace=0.3)
    width = float(solution.hertz.half_width)
    x = np.asarray(solution.profile.x) / width
    pressure, film = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    _pressure(pressure, x, solution.profile.pressure, solution.hertz, INNER, "solution")
    pressure.legend(fontsize=9, frameon=False)
    unit, factor = axis_unit("m", 3.0 * float(solution.film.central))
    film.plot(x, factor * np.asarray(solution.profile.film), color=OUTER, linewidth=1.5)
    place = float(solution.film.minimum_position) / width
    for name, value, where in (("central", solution.film.central, 0.0), ("minimum", solution.film.minimum, place)):
        film.plot(where, factor * float(value), "o", color=OUTER, markersize=5)
        text = f"{name} {factor * float(value):.4g} {unit}"
        film.annotate(
            text, (where, factor * float(value)), (0, -16), textcoords="offset points", fontsize=9, ha="center"
        )
    for name, value in (
        ("Moes (central)", solution.formulas.moes_central),
        ("Dowson-Higginson (minimum)", solution.formulas.dowson_higginson_minimum),
    ):
        film.axhline(
            factor * float(value), color=FAINT, linewidth=0.9, linestyle="--" if "Moes" in name else ":", label=name
        )
    film.set_ylim(0.0, 3.0 * factor * float(solution.film.central))
    film.legend(fontsize=9, frameon=False, loc="upper center")
    title_of(film, f"Film thickness, {unit}")
    for axes in (pressure, film):
        axes.set_xlim(-SHOWN, min(SHOWN, float(np.abs(x).max())))
        grid_lines(axes)
    film.set_xlabel("place along rolling over the Hertz half width; oil enters " + inlet_side(solution), fontsize=9)
    return figure


def inlet_side(solution: LineContactSolution) -> str:
    """Side of the inlet, in words."""
    return "from the left" if float(solution.operation.entrainment_speed) > 0 else "from the right"


def _pressure(axes: Any, x: np.ndarray, pressure: Any, hertz: Any, colour: str, name: str) -> None:
    unit, factor = axis_unit("Pa", float(hertz.pressure))
    inside = np.linspace(-1.0, 1.0, 201)
    dry = np.sqrt(1.0 - inside**2)
    axes.plot(inside, factor * float(hertz.pressure) * dry, color=FAINT, linewidth=1.0, linestyle="--", label="Hertz")
    axes.plot(x, factor * np.asarray(pressure), color=colour, linewidth=1.5, label=name)
    title_of(axes, f"Pressure, {unit}")


def plot_film_history(history: LineContactHistory, title: str) -> "matplotlib.figure.Figure":
    """See `report.histories.plot_history`: central and minimum film over time, the speed, profiles at some times."""
    from ..page import Page

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


def _films(axes: Any, time: np.ndarray, history: LineContactHistory) -> None:
    unit, factor = axis_unit("m", float(np.max(np.asarray(history.film.central))))
    axes.plot(time, factor * np.asarray(history.film.central), color=INNER, linewidth=1.6, label="central")
    axes.plot(time, factor * np.asarray(history.film.minimum), color=OUTER, linewidth=1.6, label="minimum")
    axes.set_ylim(bottom=0.0)
    axes.set_xlim(time[0], time[-1])
    axes.legend(fontsize=9, frameon=False)
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, f"Film thickness, {unit}")
    grid_lines(axes)


def _speed(axes: Any, time: np.ndarray, history: LineContactHistory) -> None:
    speed = np.asarray(history.entrainment_speed)
    unit, factor = axis_unit("m/s", float(np.abs(speed).max()))
    axes.plot(time, factor * speed, color=LOSS, linewidth=1.4)
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel("time, ms", fontsize=9)
    title_of(axes, f"Entrainment speed, {unit}")
    grid_lines(axes)


def _profiles(upper: Any, lower: Any, time: np.ndarray, history: LineContactHistory) -> None:
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
