"""Legends that hide no curve: a legend is placed at a corner or side of its axes where nothing is drawn. If there is no
such place, the vertical axis is extended to make room above the curves."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import matplotlib.artist
    import matplotlib.axes
    import matplotlib.legend

_PLACES = (
    "upper right",
    "upper left",
    "lower right",
    "lower left",
    "center right",
    "center left",
    "upper center",
    "lower center",
    "center",
)
_AWAY = 5.0
"""Least distance between a legend and the curves, markers and texts around it, points."""
_STEP = 3.0
"""Distance between neighbouring test points along a curve, pixels."""
_POINTS = 72.0
"""Points per inch."""


def clear_legend(
    axes: "matplotlib.axes.Axes",
    handles: "Sequence[matplotlib.artist.Artist] | None" = None,
    names: Sequence[str] = (),
    **style: Any,
) -> "matplotlib.legend.Legend":
    """Draws the legend on axes that are otherwise finished, and returns it.

    **Arguments:**
    - `handles`, `names`: entries of the legend; by default the labelled curves of the axes.
    - `style`: further arguments of matplotlib's legend.
    """
    artists, called = axes.get_legend_handles_labels() if handles is None else (handles, names)
    wanted = {"fontsize": 8.5, "title_fontsize": 8.5, "frameon": False} | style
    legend = axes.legend(artists, called, **wanted)
    # the whole page is laid out, even if the axes are in a part of it
    axes.figure.canvas.figure.draw_without_rendering()
    drawn = np.concatenate([np.zeros((0, 2)), *_drawn(axes)])
    for place in _PLACES:
        legend.set_loc(place)
        if not _hit(legend, drawn):
            return legend
    return _above(axes, artists, called, wanted)


def covered(axes: "matplotlib.axes.Axes") -> int:
    """Number of test points of curves, markers and texts that the legend of the axes covers."""
    legend = axes.get_legend()
    return 0 if legend is None else _hit(legend, np.concatenate([np.zeros((0, 2)), *_drawn(axes)]), 0.0)


def _hit(legend: "matplotlib.legend.Legend", drawn: np.ndarray, away: float = _AWAY) -> int:
    box = legend.get_window_extent().padded(away * legend.figure.dpi / _POINTS)
    inside = (drawn[:, 0] > box.x0) & (drawn[:, 0] < box.x1) & (drawn[:, 1] > box.y0) & (drawn[:, 1] < box.y1)
    return int(np.count_nonzero(inside))


def _drawn(axes: "matplotlib.axes.Axes") -> Iterator[np.ndarray]:
    """Test points, in pixels of the page, on every curve, marker and text of the axes."""
    for line in axes.lines:
        points = line.get_transform().transform(np.asarray(line.get_xydata(), dtype=float))
        yield _along(points) if line.get_linestyle() not in ("None", "none", "", " ") else points
    for collection in axes.collections:
        for path in collection.get_paths():
            yield _along(collection.get_transform().transform(path.vertices))
    for text in axes.texts:
        box = text.get_window_extent()
        x, y = np.linspace(box.x0, box.x1, 9), np.linspace(box.y0, box.y1, 3)
        yield np.stack([grid.ravel() for grid in np.meshgrid(x, y)], axis=-1)


def _along(corners: np.ndarray) -> np.ndarray:
    """Test points on the straight lines between the corners of a curve; gaps of the curve (NaN) stay empty."""
    start, step = corners[:-1], np.diff(corners, axis=0)
    lengths = np.hypot(*step.T)
    counts = np.minimum(np.where(np.isfinite(lengths), lengths, 0.0) / _STEP, 2000.0).astype(int)
    between = [start[i] + np.linspace(0.0, 1.0, counts[i])[:, None] * step[i] for i in np.nonzero(counts > 1)[0]]
    return np.concatenate([corners[np.all(np.isfinite(corners), axis=1)], *between])


def _above(
    axes: "matplotlib.axes.Axes",
    handles: "Sequence[matplotlib.artist.Artist]",
    names: Sequence[str],
    style: dict[str, Any],
) -> "matplotlib.legend.Legend":
    """Places the legend at the top, in as few lines as fit, and extends the vertical axis to make room for it."""
    room = axes.get_window_extent()
    columns = len(names)
    legend = axes.legend(handles, names, **(style | {"ncols": columns, "loc": "upper left"}))
    while columns > 1 and legend.get_window_extent().width > room.width:
        columns -= 1
        legend = axes.legend(handles, names, **(style | {"ncols": columns, "loc": "upper left"}))
    height = legend.get_window_extent().height + 2.0 * _AWAY * axes.figure.dpi / _POINTS
    transform = axes.yaxis.get_transform()
    low, high = transform.transform(np.asarray(axes.get_ylim()))
    part = min(height / room.height, 0.6)
    axes.set_ylim(top=float(transform.inverted().transform(low + (high - low) / (1.0 - part))))
    return legend
