"""Common parts of pages of plots: head, foot, titles and grids of axes."""

import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...._version import __version__
from ...colours import FAINT, GRID, INK

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import matplotlib.text

_HEAD = (0.37, 0.66)
"""Distances from the top of a page to the middle of its title and to the middle of the line below, inches."""
_WARNING_LINES = 4
"""Largest number of lines of warnings at the foot of a page; further lines are left out."""
_LINE_LENGTH = 170
_LONG_TITLE = 65
"""Number of letters above which a title is set in a smaller size."""
_TITLE_GAP = 0.2
"""Distance between the title and the version to its right, inches."""
_LONG_OPERATION = 95
"""Number of letters above which an operating point is set in a smaller size: a legend may stand to its right."""


def head(figure: "matplotlib.figure.Figure", title: str, operation: str) -> None:
    """Writes title, operating point and version at the top of a page, or of a part of a page, of any height."""
    first, second = (1.0 - inches * figure.dpi / figure.bbox.height for inches in _HEAD)
    size = 15 if len(title) <= _LONG_TITLE else 10
    # file names are not formulas, whichever characters they contain
    shown = figure.text(0.03, first, title, fontsize=size, fontweight="bold", color=INK, va="center", parse_math=False)
    small = 9.5 if len(operation) <= _LONG_OPERATION else 8
    figure.text(0.03, second, operation, fontsize=small, color=INK, va="center")
    version = figure.text(0.985, first, f"jaxbearing {__version__}", fontsize=8, color=FAINT, va="center", ha="right")
    _shorten(shown, version.get_window_extent().x0 - figure.dpi * _TITLE_GAP)


def _shorten(text: "matplotlib.text.Text", end: float) -> None:
    """Shortens a text so that it ends before a horizontal position, in pixels of the figure."""
    whole, kept = text.get_text(), len(text.get_text())
    while kept > 1 and text.get_window_extent().x1 > end:
        box = text.get_window_extent()
        kept = min(kept - 1, max(1, int(kept * (end - box.x0) / box.width)))
        text.set_text(f"{whole[:kept].rstrip()}...")


def foot(figure: "matplotlib.figure.Figure", warnings: Iterable[str]) -> int:
    """Writes warnings and notes in small print at the foot of a page, and returns the number of lines."""
    lines = [line for text in warnings for line in textwrap.wrap(f"- {text}", _LINE_LENGTH)]
    if len(lines) > _WARNING_LINES:
        lines = [*lines[: _WARNING_LINES - 1], "- and more: see the summary"]
    figure.text(
        0.03,
        0.12 * figure.dpi / figure.bbox.height,
        "\n".join(lines),
        fontsize=7,
        color="#8A4B00",
        va="bottom",
        linespacing=1.35,
    )
    return len(lines)


def title_of(axes: "matplotlib.axes.Axes", text: str, pad: float = 6.0, size: float = 10.5) -> None:
    axes.set_title(text, fontsize=size, fontweight="bold", color=INK, pad=pad)


def grid_lines(axes: "matplotlib.axes.Axes") -> None:
    """Draws a light grid behind the curves and removes the frame at the top and the right."""
    axes.tick_params(labelsize=8.5)
    axes.grid(color=GRID, linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
