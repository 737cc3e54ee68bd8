"""A page of plots of a transient run of bearing temperatures: temperatures, clearance, heat flows, largest load and
film over time."""

from typing import TYPE_CHECKING, Any

import numpy as np
from jaxtyping import Array

from ....bearings.warming.history import WarmUpHistory, play_of
from ...backends.matplotlib.legends import clear_legend
from ...backends.matplotlib.sheet import foot, grid_lines, head, title_of
from ...colours import CURVES, FAINT, INNER, LOSS, OUTER
from ...display import ZERO_CELSIUS, axis_unit
from .clock import clock, clock_unit

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure


def plot(history: WarmUpHistory, title: str) -> "matplotlib.figure.Figure":
    """See `report.histories.plot_history`. Results that the scene does not model are left out."""
    from ...backends.matplotlib.page import Page

    figure = Page()
    head(figure, title, f"{clock(float(history.time[-1]))}, {int(history.accepted)} steps, {history.solver}")
    bottom = 0.08 + 0.019 * foot(figure, history.warnings if history.completed else [history.failure()])
    grid = figure.add_gridspec(2, 2, left=0.06, right=0.98, top=0.86, bottom=bottom, wspace=0.18, hspace=0.4)
    draw_temperatures(figure.add_subplot(grid[0, 0]), history)
    _heat(figure.add_subplot(grid[0, 1]), history)
    places = [grid[1, 0], grid[1, 1]]
    play = play_of(history.instants)
    if play is not None:
        _play(figure.add_subplot(places.pop(0)), history, play)
    _load(figure.add_subplot(places.pop(0)), history)
    if places and history.instants.smallest_film is not None:
        _film(figure.add_subplot(places.pop(0)), history)
    return figure


def times_of(history: WarmUpHistory) -> tuple[np.ndarray, str]:
    """The times in the unit of the time axis, and this unit."""
    time = np.asarray(history.time)
    unit, length = clock_unit(float(time[-1]))
    return time / length, unit


def _root(values: np.ndarray) -> np.ndarray:
    return np.sqrt(np.maximum(values, 0.0))


def _finish(axes: "matplotlib.axes.Axes", history: WarmUpHistory, title: str) -> None:
    time, unit = times_of(history)
    # most changes happen at the start
    axes.set_xscale("function", functions=(_root, np.square))
    axes.set_xlim(time[0], time[-1])
    axes.set_xlabel(f"time, {unit}, on a scale of square roots", fontsize=9)
    title_of(axes, title)
    grid_lines(axes)


def draw_temperatures(axes: "matplotlib.axes.Axes", history: WarmUpHistory) -> None:
    """Draws the temperatures of all nodes and of the oil at the inlet."""
    time, _ = times_of(history)
    for name, colour in zip(history.nodes, CURVES, strict=False):
        values = np.asarray(getattr(history.instants.temperatures, name)) - ZERO_CELSIUS
        axes.plot(time, values, color=colour, linewidth=1.5, label=name.replace("_", " "))
    inlet = np.asarray(history.instants.oil_inlet) - ZERO_CELSIUS
    axes.plot(time, inlet, color=FAINT, linewidth=1.0, linestyle="--", label="oil inlet")
    _finish(axes, history, "Temperatures, °C")
    clear_legend(axes, ncols=2)


def _heat(axes: "matplotlib.axes.Axes", history: WarmUpHistory) -> None:
    time, _ = times_of(history)
    instants = history.instants
    curves = {
        "total loss": (instants.power_loss.total, LOSS),
        "to the oil": (instants.heat_to_oil, INNER),
        "to the ambient": (instants.heat_to_ambient, OUTER),
        "stored": (instants.heat_stored, FAINT),
    }
    largest = max(float(np.abs(np.asarray(values)).max()) for values, _ in curves.values())
    unit, factor = axis_unit("W", largest)
    for name, (values, colour) in curves.items():
        axes.plot(time, factor * np.asarray(values), color=colour, linewidth=1.4, label=name)
    _finish(axes, history, f"Heat, {unit}")
    clear_legend(axes)


def _play(axes: "matplotlib.axes.Axes", history: WarmUpHistory, play: tuple[str, Array | None]) -> None:
    time, _ = times_of(history)
    axes.plot(time, 1e6 * np.asarray(play[1]), color=INNER, linewidth=1.5)
    axes.axhline(0.0, color=FAINT, linewidth=0.8)
    _mark(axes, history, history.peaks.least_play_time, history.peaks.least_play, 1e6, "µm")
    words = {"clearance": "Running clearance, µm", "axial_shift": "Axial place of first contact, µm"}
    _finish(axes, history, words[play[0]])


def _mark(
    axes: "matplotlib.axes.Axes", history: WarmUpHistory, time: Any, value: Any, factor: float, unit: str
) -> None:
    """Marks an extreme with its value and time, unless it lies at the start or the end of the run."""
    at, height = float(time), factor * float(value)
    if not float(history.time[0]) < at < float(history.time[-1]):
        return
    length = clock_unit(float(history.time[-1]))[1]
    axes.plot([at / length], [height], color=LOSS, marker="o", markersize=4, linestyle="none")
    right = at < 0.5 * float(history.time[-1])
    axes.annotate(
        f"{height:.4g} {unit} after {clock(at)}",
        (at / length, height),
        xytext=(6 if right else -6, 6),
        textcoords="offset points",
        ha="left" if right else "right",
        fontsize=8,
    )


def _load(axes: "matplotlib.axes.Axes", history: WarmUpHistory) -> None:
    time, _ = times_of(history)
    load = np.asarray(history.instants.largest_load)
    unit, factor = axis_unit("N", float(load.max()))
    axes.plot(time, factor * load, color=OUTER, linewidth=1.5)
    _mark(axes, history, history.peaks.largest_load_time, history.peaks.largest_load, factor, unit)
    axes.ticklabel_format(axis="y", useOffset=False)
    _finish(axes, history, f"Largest contact load, {unit}")


def _film(axes: "matplotlib.axes.Axes", history: WarmUpHistory) -> None:
    time, _ = times_of(history)
    film = np.asarray(history.instants.smallest_film)
    unit, factor = axis_unit("m", float(np.nanmax(film)))
    axes.plot(time, factor * film, color=INNER, linewidth=1.5)
    axes.set_ylim(bottom=0.0)
    _finish(axes, history, f"Smallest film, {unit}")
