"""Animation of pressure and film of a line contact."""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ...._scene import AbstractScene
from ....ehl import LineContactHistory
from ...backends.matplotlib.animations import instants, moving, moving_head
from ...backends.matplotlib.sheet import grid_lines, title_of
from ...colours import FAINT, INNER, LOSS, OUTER
from ...display import axis_unit

if TYPE_CHECKING:
    import matplotlib.animation
    import matplotlib.artist
    import matplotlib.figure

_SHOWN = 1.5
"""Range drawn on each side of the centre, in Hertz half widths."""
_MICRO = 1e6


def animate(history: LineContactHistory, scene: AbstractScene, title: str) -> "matplotlib.animation.FuncAnimation":
    """Animation of evenly spaced times of a run, interpolated between its steps."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.4, 8.0), facecolor="white")
    times = instants(float(history.time[0]), float(history.time[-1]))
    return moving(figure, _draw(figure, history, times, title), times.size)


def _draw(
    figure: "matplotlib.figure.Figure", history: LineContactHistory, times: np.ndarray, title: str
) -> Callable[[int], "list[matplotlib.artist.Artist]"]:
    """Draws everything that stands still, and returns the function that updates the rest."""
    time, speed = np.asarray(history.time), np.asarray(history.entrainment_speed)
    central, minimum = np.asarray(history.film.central), np.asarray(history.film.minimum)
    pressure, film = np.asarray(history.profile.pressure), np.asarray(history.profile.film)
    width, hertz = float(history.hertz.half_width), float(history.hertz.pressure)
    x = np.asarray(history.profile.x) / width
    shown = np.abs(x) <= _SHOWN
    p_unit, p_factor = axis_unit("Pa", hertz)
    u_unit, u_factor = axis_unit("m/s", float(np.abs(speed).max()))

    grid = figure.add_gridspec(
        3, 1, left=0.09, right=0.97, top=0.83, bottom=0.065, hspace=0.62, height_ratios=(3, 3, 2)
    )
    upper, middle, lower = (figure.add_subplot(grid[i]) for i in range(3))
    inside = np.linspace(-1.0, 1.0, 201)
    dry = p_factor * hertz * np.sqrt(1.0 - inside**2)
    upper.plot(inside, dry, color=FAINT, linewidth=1.0, linestyle="--", label="Hertz")
    (curve,) = upper.plot([], [], color=INNER, linewidth=1.6, label="solution")
    upper.set_ylim(0.0, 1.1 * p_factor * float(pressure.max()))
    title_of(upper, f"Pressure, {p_unit}")
    (gap,) = middle.plot([], [], color=OUTER, linewidth=1.6)
    (lowest,) = middle.plot([], [], "o", color=OUTER, markersize=5)
    middle.set_ylim(0.0, 2.0 * _MICRO * float(central.max()))
    middle.set_xlabel("place along rolling over the Hertz half width", fontsize=9)
    title_of(middle, "Film thickness, µm")
    for axes in (upper, middle):
        axes.set_xlim(-_SHOWN, _SHOWN)
    lower.plot(1e3 * time, _MICRO * central, color=INNER, linewidth=1.4, label="central")
    lower.plot(1e3 * time, _MICRO * minimum, color=OUTER, linewidth=1.4, label="smallest")
    now = lower.axvline(0.0, color=LOSS, linewidth=1.2)
    lower.set_ylim(bottom=0.0)
    lower.set_xlim(1e3 * time[0], 1e3 * time[-1])
    lower.set_xlabel("time, ms", fontsize=9)
    title_of(lower, "Film thickness over time, µm")
    for axes in (upper, middle, lower):
        grid_lines(axes)
    upper.legend(fontsize=8, frameon=False, loc="upper right")
    lower.legend(fontsize=8, frameon=False, loc="lower left", ncols=2)
    # a speed that passes through 0 is written with fixed decimals, not with powers of ten
    fastest = u_factor * float(np.abs(speed).max())
    decimals = 0 if fastest == 0.0 else max(0, 2 - int(np.floor(np.log10(fastest))))
    words = f"Hertz half width {1e3 * width:.4g} mm, pressure {p_factor * hertz:.4g} {p_unit}"
    clock = moving_head(figure, title, words)

    def update(number: int) -> "list[matplotlib.artist.Artist]":
        at = times[number]
        row = int(np.clip(np.searchsorted(time, at), 1, time.size - 1)) if time.size > 1 else 0
        before = max(row - 1, 0)
        part = 0.0 if row == before else (at - time[before]) / (time[row] - time[before])
        between = lambda values: (1.0 - part) * values[before] + part * values[row]
        h = _MICRO * between(film)
        curve.set_data(x[shown], p_factor * between(pressure)[shown])
        gap.set_data(x[shown], h[shown])
        least = int(np.argmin(h))
        lowest.set_data([x[least]], [h[least]])
        now.set_xdata([1e3 * at, 1e3 * at])
        films = f"film {_MICRO * between(central):.4f} µm at the centre, {h[least]:.4f} µm at least"
        clock.set_text(f"{1e3 * at:8.3f} ms     {u_factor * between(speed):.{decimals}f} {u_unit}     {films}")
        return [curve, gap, lowest, now, clock]

    return update
