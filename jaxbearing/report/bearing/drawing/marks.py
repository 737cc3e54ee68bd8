"""Dimension lines, leaders and texts of a drawing."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ...colours import CURVES
from ..azimuth import place_at

if TYPE_CHECKING:
    import matplotlib.axes

DIMENSION, LOAD = CURVES[:2]
_FONT = 8.5


def length_text(value: Any) -> str:
    metres = float(value)
    return f"{1e3 * metres:.6g} mm" if abs(metres) >= 1e-3 else f"{1e6 * metres:.4g} µm"


def dimension(axes: "matplotlib.axes.Axes", start: tuple[float, float], end: tuple[float, float]) -> None:
    style = {"arrowstyle": "<|-|>,head_width=0.18,head_length=0.42", "color": DIMENSION, "linewidth": 1.0}
    axes.annotate("", xy=end, xytext=start, arrowprops=style | {"shrinkA": 0, "shrinkB": 0}, zorder=6)


def extension(axes: "matplotlib.axes.Axes", *points: tuple[float, float]) -> None:
    axes.plot(*zip(*points, strict=True), color=DIMENSION, linewidth=0.6, zorder=5)


def note(axes: "matplotlib.axes.Axes", place: tuple[float, float], text: str, **style: Any) -> None:
    halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.85, "pad": 1.0}
    style = {"ha": "center", "va": "center", "color": DIMENSION, "fontsize": _FONT, "bbox": halo, "zorder": 7} | style
    axes.text(*place, text, linespacing=1.25, **style)


def leader(
    axes: "matplotlib.axes.Axes", place: tuple[float, float], text: str, target: tuple[float, float], **style: Any
) -> None:
    note(axes, place, text, **style)
    arrow = {"arrowstyle": "-|>,head_width=0.16,head_length=0.38", "color": DIMENSION, "linewidth": 0.9, "shrinkB": 0}
    axes.annotate("", xy=target, xytext=place, arrowprops=arrow | {"shrinkA": 3}, zorder=6)


def arc(axes: "matplotlib.axes.Axes", radius: float, start: float, end: float) -> None:
    angles = np.linspace(start, end, 60)
    x, y = place_at(angles, radius)
    axes.plot(x[:-2], y[:-2], color=DIMENSION, linewidth=1.2, zorder=6)
    arrow = {"arrowstyle": "-|>,head_width=0.22,head_length=0.5", "color": DIMENSION, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=(x[-1], y[-1]), xytext=(x[-4], y[-4]), arrowprops=arrow, zorder=6)
