"""Animation of the temperatures of a bearing: a bar for each node, and the curves with a mark at the time shown."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...._scene import AbstractScene
from ....bearings.warming.history import WarmUpHistory
from ...backends.matplotlib.animations import instants, moving, moving_head
from ...backends.matplotlib.sheet import grid_lines, title_of
from ...colours import CURVES, LOSS
from ...display import ZERO_CELSIUS, with_unit
from .clock import clock, clock_unit
from .plots import draw_temperatures

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.artist
    import matplotlib.figure


def animate(history: WarmUpHistory, scene: AbstractScene, title: str) -> "matplotlib.animation.FuncAnimation":
    """Animation of evenly spaced times of a run, interpolated between its instants."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.4, 6.6), facecolor="white")
    times = instants(float(history.time[0]), float(history.time[-1]))
    return moving(figure, _draw(figure, history, times, title), times.size)


def _draw(
    figure: "matplotlib.figure.Figure", history: WarmUpHistory, times: np.ndarray, title: str
) -> Callable[[int], "list[matplotlib.artist.Artist]"]:
    """Draws everything that stands still, and returns the function that updates the rest."""
    time = np.asarray(history.time)
    nodes = np.asarray(history.node_temperatures()) - ZERO_CELSIUS
    total = np.asarray(history.instants.power_loss.total)
    grid = figure.add_gridspec(2, 1, left=0.09, right=0.97, top=0.82, bottom=0.08, hspace=0.42)
    upper, lower = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    names = [name.replace("_", " ") for name in history.nodes]
    bars = upper.bar(names, nodes[0], color=CURVES[: len(names)], width=0.6)
    upper.set_ylim(min(0.0, float(nodes.min())), 1.1 * max(float(nodes.max()), 1.0))
    title_of(upper, "Temperatures, °C")
    grid_lines(upper)
    draw_temperatures(lower, history)
    now = lower.axvline(0.0, color=LOSS, linewidth=1.2)
    length = clock_unit(float(time[-1]))[1]
    words = f"to the oil {with_unit(float(history.instants.heat_to_oil[-1]), 'W')} at the end"
    text = moving_head(figure, title, words)

    def update(number: int) -> "list[matplotlib.artist.Artist]":
        at = float(times[number])
        for bar, values in zip(bars, nodes.T, strict=True):
            bar.set_height(float(np.interp(at, time, values)))
        now.set_xdata([at / length, at / length])
        text.set_text(f"{clock(at)}     power loss {with_unit(float(np.interp(at, time, total)), 'W')}")
        return [*bars, now, text]

    return update
