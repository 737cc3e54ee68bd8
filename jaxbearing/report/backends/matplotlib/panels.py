"""Panels on paper: draws the descriptions of `panels` on matplotlib axes."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ...colours import FAINT, INK
from ...panels import Axis, Bars, Curves, Numbers, Panel, Polar, headed, round_up
from .sheet import grid_lines, title_of

if TYPE_CHECKING:
    import matplotlib.axes

_LINES = {"solid": "-", "dash": "--", "dot": ":", "dashdot": "-."}
_POINTS = {
    "": None,
    "circle": "o",
    "square": "s",
    "triangle-up": "^",
    "diamond": "D",
    "triangle-down": "v",
    "triangle-left": "<",
    "triangle-right": ">",
}
_ROW, _NAMES = 0.34, 0.46
"""Largest height of a row of numbers, inches, and the fraction of the width of the axes reserved for the row names."""
_LETTER = 0.085
"""Width of a letter of a table of numbers at its usual size of 10 points, inches."""
_FEWEST_BARS = 4
"""Smallest number of bars that the axes leave room for: with fewer bars, the bars do not become thicker."""
_SCALE_AZIMUTH = math.radians(157.5)
"""Azimuth at which the scale of a polar plot is written, rad: away from the load line."""


def draw(axes: "matplotlib.axes.Axes", panel: Panel, marked: bool = True) -> None:
    """Draws a panel on axes, which must be polar for `Polar`. The caller draws the legend.

    **Arguments:** `marked`: False draws the curves without markers.
    """
    match panel:
        case Bars():
            _bars(axes, panel)
        case Polar():
            _polar(axes, panel)
        case Curves():
            _curves(axes, panel, marked)
        case Numbers():
            _numbers(axes, panel)


def _bars(axes: "matplotlib.axes.Axes", panel: Bars) -> None:
    """Draws bars with their values written beside them, so that no axis and no grid are needed."""
    column = list(panel.values)
    bars = axes.barh(list(panel.names), column, color=panel.colour, height=0.68)
    axes.set_ylim(max(len(column), _FEWEST_BARS) - 0.5, -0.5)
    shown = zip(column, panel.shares, strict=True)
    texts = [f"{panel.text(value)} {panel.unit}   {share}" for value, share in shown]
    axes.bar_label(bars, texts, padding=5, fontsize=9, color=INK)
    largest, lowest = max([0.0, *column]), min([0.0, *column])
    axes.set_xlim(1.25 * lowest, 1.35 * largest if largest > 0.0 else 1.0)
    title_of(axes, f"{panel.title}: total {panel.text(panel.total)} {panel.unit}", pad=16)
    axes.tick_params(axis="y", length=0, labelsize=9.5)
    axes.set_xticks([])
    axes.spines[["top", "right", "left", "bottom"]].set_visible(False)


def _numbers(axes: Any, panel: Numbers) -> None:
    """Draws a table without lines, as wide as the axes, with one column for each contact side."""
    axes.set_axis_off()
    title_of(axes, panel.title)
    height = axes.get_window_extent().height / axes.figure.dpi
    step = min(_ROW / height, 0.9 / (len(panel.rows) + 1))
    # texts of neighbouring columns must not meet: smaller ones in narrow axes
    width, names = axes.get_window_extent().width / axes.figure.dpi, [name for name, _ in panel.rows]
    numbers = [text for _, texts in panel.rows for text in texts] + [name for name, _ in panel.columns]
    longest = lambda texts: _LETTER * (1 + max((len(text) for text in texts), default=0))
    column = width * (1.0 - _NAMES) / len(panel.columns)
    size = 10.0 * min(1.0, column / longest(numbers), width * _NAMES / longest(names))
    style = {"transform": axes.transAxes, "fontsize": size, "color": INK, "va": "center"}
    ends = np.linspace(1.0, _NAMES, len(panel.columns), endpoint=False)[::-1]
    for end, (name, colour) in zip(ends, panel.columns, strict=True):
        axes.text(end, 1.0 - step, name, **(style | {"color": colour, "ha": "right", "fontweight": "bold"}))
    for row, (name, texts) in enumerate(panel.rows):
        y = 1.0 - (row + 2) * step
        axes.text(0.0, y, name, **style)
        for end, text in zip(ends, texts, strict=True):
            axes.text(end, y, text, ha="right", **style)


def _polar(axes: Any, panel: Polar) -> None:
    axes.set_theta_zero_location("S")
    for curve in panel.series:
        closed, values = np.append(curve.x, curve.x[0] + 2.0 * math.pi), np.append(curve.y, curve.y[0])
        marker = _POINTS[curve.marker]
        style = {"color": curve.colour, "linestyle": _LINES[curve.dash], "linewidth": 1.2, "label": curve.name}
        axes.plot(closed, values, marker=marker, markersize=3.2, **style)
        if not curve.faint:
            axes.fill(closed, values, color=curve.colour, alpha=0.12, linewidth=0)
    top = round_up(max(float(np.max(series.y)) for series in panel.series))
    axes.set_ylim(0.0, top)
    axes.set_yticks([top / 2.0, top], [])
    halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6}
    for radius, text in ((top / 2.0, f"{top / 2.0:g}"), (top, f"{top:g} {panel.unit}")):
        axes.text(_SCALE_AZIMUTH, radius, text, fontsize=8, color=INK, ha="center", va="center", bbox=halo, zorder=5)
    ticks = np.arange(0, 360, 45)
    axes.set_thetagrids(ticks, [f"{tick}°" for tick in ticks], fontsize=8.5, color=INK)
    axes.tick_params(axis="x", pad=2)
    axes.grid(color="#D8D8D8", linewidth=0.7)
    axes.spines["polar"].set_color(FAINT)
    if panel.arrow is not None:
        _load_arrow(axes, panel.arrow)
    title_of(axes, headed(panel), pad=16)


def _load_arrow(axes: "matplotlib.axes.Axes", angle: float) -> None:
    """Draws the direction of the load beside the plot; azimuth 0 is at the bottom, positive counter-clockwise."""
    arrow = {"arrowstyle": "-|>,head_width=0.35,head_length=0.7", "linewidth": 2.2, "color": INK}
    place, half = np.array([1.05, 0.07]), 0.07 * np.array([math.sin(angle), -math.cos(angle)])
    axes.annotate("", xy=tuple(place + half), xytext=tuple(place - half), xycoords="axes fraction", arrowprops=arrow)
    axes.text(1.05, 0.165, "load", transform=axes.transAxes, fontsize=9, color=INK, ha="center")


def _curves(axes: "matplotlib.axes.Axes", panel: Curves, marked: bool) -> None:
    for curve in panel.series:
        marker = _POINTS[curve.marker] if marked else None
        width = 1.0 if curve.faint else 1.2 if marker else 1.5
        style = {"linestyle": _LINES[curve.dash], "marker": marker, "markersize": 3.2, "linewidth": width}
        axes.plot(curve.x, curve.y, color=curve.colour, label=curve.name, **style)
    for mark in panel.marks:
        axes.plot(mark.x, mark.y, "o", color=panel.series[0].colour, markersize=5)
        place = {"xytext": (0, -16), "textcoords": "offset points"}
        axes.annotate(mark.text, (mark.x, mark.y), fontsize=9, ha="center", **place)
    for level in panel.levels:
        axes.axhline(level.y, color=level.colour, linewidth=0.9, linestyle=_LINES[level.dash], label=level.name)
    if panel.of_elements and not panel.y.logarithmic:
        axes.margins(y=0.1)
        axes.ticklabel_format(axis="y", useOffset=False)
    _scale(axes, "y", panel.y)
    _scale(axes, "x", panel.x)
    title_of(axes, headed(panel))
    grid_lines(axes)


def _scale(axes: "matplotlib.axes.Axes", which: str, axis: Axis) -> None:
    """Sets limits, ticks and title of one axis."""
    if axis.logarithmic:
        axes.set(**{f"{which}scale": "log"})
    if axis.limits is not None:
        axes.set(**{f"{which}lim": axis.limits})
    if axis.from_zero:
        axes.set(**{f"{which}lim": (0.0, None)})
    if axis.ticks:
        # matplotlib would label a logarithmic axis with powers of ten
        texts = [f"{tick:g}" for tick in axis.ticks] if axis.logarithmic else None
        getattr(axes, f"set_{which}ticks")(axis.ticks, texts)
    if axis.logarithmic:
        getattr(axes, f"set_{which}ticks")([], minor=True)
    if axis.title:
        getattr(axes, f"set_{which}label")(axis.title, fontsize=9)
