"""Common parts of pages of plots: colours, head and foot, units and titles of axes."""

import math
import textwrap
from collections.abc import Iterable
from typing import Any

from .. import __version__

INK, FAINT = "#222222", "#9A9A9A"

_WARNING_LINES = 4
"""Lines of warnings at the foot of the page; more are counted."""
_LINE_LENGTH = 170
_LONG_TITLE = 65

_SCALES = {
    "N": ((1e3, "kN", 1e-3), (0.0, "N", 1.0)),
    "m": ((1e-3, "mm", 1e3), (1e-7, "µm", 1e6), (0.0, "nm", 1e9)),
    "Pa": ((1e8, "GPa", 1e-9), (0.0, "MPa", 1e-6)),
    "m/s": ((0.1, "m/s", 1.0), (0.0, "mm/s", 1e3)),
    "W": ((1e4, "kW", 1e-3), (0.0, "W", 1.0)),
}
"""SI unit -> (from this largest value on, unit on the axis, factor)."""


def axis_unit(unit: str, largest: float) -> tuple[str, float]:
    """The unit on an axis whose largest value is this, in SI, and the factor from SI."""
    for limit, name, factor in _SCALES.get(unit, ((0.0, unit, 1.0),)):
        if largest >= limit:
            return name, factor
    # not a number
    return unit, 1.0


def head(figure: Any, title: str, operation: str) -> None:
    """Title, operating point and version at the top of a page."""
    size = 15 if len(title) <= _LONG_TITLE else 10
    shown = title if len(title) <= 2 * _LONG_TITLE else title[: 2 * _LONG_TITLE] + "..."
    # names of files are not formulas, whatever signs are in them
    figure.text(0.03, 0.955, shown, fontsize=size, fontweight="bold", color=INK, va="center", parse_math=False)
    figure.text(0.03, 0.92, operation, fontsize=9.5, color=INK, va="center")
    figure.text(0.985, 0.955, f"jaxbearing {__version__}", fontsize=8, color=FAINT, va="center", ha="right")


def typeset(text: str) -> str:
    """With the signs of units that a terminal may not have."""
    return text.replace(" degC", " °C").replace(" um", " µm").replace("/um", "/µm")


def pretty(text: str) -> str:
    return typeset(text).replace(", ", "   ·   ")


def foot(figure: Any, warnings: Iterable[str]) -> int:
    """Warnings and notes in small print; returns the number of lines."""
    lines = [line for text in warnings for line in textwrap.wrap(f"- {text}", _LINE_LENGTH)]
    if len(lines) > _WARNING_LINES:
        lines = [*lines[: _WARNING_LINES - 1], "- and more: see the summary"]
    figure.text(0.03, 0.015, "\n".join(lines), fontsize=7, color="#8A4B00", va="bottom", linespacing=1.35)
    return len(lines)


def title_of(axes: Any, text: str, pad: float = 6.0) -> None:
    axes.set_title(text, fontsize=10.5, fontweight="bold", color=INK, pad=pad)


def grid_lines(axes: Any) -> None:
    """A light grid behind the curves, and no frame at the top and the right."""
    axes.tick_params(labelsize=8.5)
    axes.grid(color="#E4E4E4", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)


def round_up(value: float) -> float:
    """The next number of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten."""
    if not value > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    steps = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
    return next(step * power for step in steps if step * power >= 0.999 * value)


def log_ticks(low: float, high: float) -> list[float]:
    """1, 2 and 5 times powers of ten between these limits; of many powers, the powers only."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [step * 10.0**power for power in powers for step in ((1, 2, 5) if len(powers) < 5 else (1,))]
    return [tick for tick in ticks if low <= tick <= high]
