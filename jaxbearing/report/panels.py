"""Descriptions of charts, which each backend draws in its own way: matplotlib on paper, plotly on a page."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .display import digits

DASHES = ("solid", "dash", "dot", "dashdot")
MARKERS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "triangle-left", "triangle-right")
"""Marker shapes (`DASHES`: line styles) that distinguish curves besides their colours."""


@dataclass(frozen=True)
class Series:
    """A curve in the unit of its panel, with gaps where values are not finite.

    - `marker`: one of `MARKERS`, or "" for a line without points.
    - `faint`: True for a reference curve, with which the results are compared.
    """

    name: str
    x: Any
    y: Any
    colour: str
    marker: str = ""
    dash: str = "solid"
    faint: bool = False


@dataclass(frozen=True)
class Axis:
    """Title, limits and ticks of an axis; limits and ticks that are not given follow from the curves."""

    title: str = ""
    limits: tuple[float, float] | None = None
    ticks: Sequence[float] = ()
    from_zero: bool = False
    logarithmic: bool = False


@dataclass(frozen=True)
class Mark:
    """A point of a curve with a text beside it."""

    x: float
    y: float
    text: str


@dataclass(frozen=True)
class Curves:
    """Curves over a common horizontal axis.

    - `unit`: of the vertical axis, after the title; "" for a dimensionless number.
    - `of_elements`: True if each point is a rolling element at its azimuth, deg; every backend then marks the points.
    - `levels`, `marks`: named horizontal lines and points, on paper only; a page shows values at the pointer.
    """

    name: str
    title: str
    caption: str
    series: Sequence[Series]
    unit: str = ""
    x: Axis = Axis()
    y: Axis = Axis()
    of_elements: bool = False
    levels: Sequence[Series] = ()
    marks: Sequence[Mark] = ()


@dataclass(frozen=True)
class Polar:
    """Closed curves round a bearing over the azimuth in rad, which is 0 downwards and grows counter-clockwise.

    `arrow`: azimuth of the load, drawn on paper only; a page shows the load in its drawing.
    """

    name: str
    title: str
    caption: str
    series: Sequence[Series]
    unit: str
    arrow: float | None = None


@dataclass(frozen=True)
class Numbers:
    """Results that are equal at all elements, as a table of numbers instead of flat curves.

    `columns`: name and colour of each column; `rows`: name of a result, and its number with unit for each column.
    """

    name: str
    title: str
    caption: str
    columns: Sequence[tuple[str, str]]
    rows: Sequence[tuple[str, Sequence[str]]]


@dataclass(frozen=True)
class Bars:
    """Horizontal bars, the first one at the top; `shares`: share of each bar in the total, as text."""

    name: str
    title: str
    caption: str
    quantity: str
    unit: str
    names: Sequence[str]
    values: Sequence[float]
    shares: Sequence[str]
    total: float
    colour: str

    def text(self, value: float) -> str:
        """Text of a value or of the total, with decimals for four digits of the largest bar, but at least one."""
        shown = digits(max(self.values, key=abs))
        return digits(value) if "e" in shown else f"{value:.{max(1, len(shown.partition('.')[2]))}f}"

    def fraction(self, value: float) -> float:
        """Length of the bar relative to the longest one; 0 for values that are not positive."""
        largest = max(self.values)
        return max(0.0, value) / largest if largest > 0.0 else 0.0


Panel = Bars | Polar | Curves | Numbers

SAME = 5e-4
"""Relative spread of values up to which a curve counts as constant: in four digits it is hardly visible."""


def constant(panel: Polar | Curves) -> bool:
    """True if the relative spread of each curve of the panel is at most `SAME`."""
    return all(_spread(np.asarray(curve.y, dtype=float)) <= SAME for curve in panel.series)


def _spread(values: np.ndarray) -> float:
    """Largest minus smallest value, relative to the largest modulus; infinite if any value is not finite."""
    if not np.all(np.isfinite(values)):
        return math.inf
    largest = float(np.max(np.abs(values)))
    return float(np.ptp(values)) / largest if largest > 0.0 else 0.0


def headed(panel: Polar | Curves) -> str:
    """Title of the panel with its unit."""
    return f"{panel.title}, {panel.unit}" if panel.unit else panel.title


def round_up(value: float) -> float:
    """The value rounded up to 1, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten; 1 if not positive."""
    if not value > 0.0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(value))
    steps = (1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)
    return next(step * power for step in steps if step * power >= 0.999 * value)


def log_ticks(low: float, high: float) -> list[float]:
    """Ticks of a logarithmic axis between `low` and `high`: 1, 2 and 5 times powers of ten, or powers of ten only over
    many decades."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [step * 10.0**power for power in powers for step in ((1, 2, 5) if len(powers) < 5 else (1,))]
    return [tick for tick in ticks if low <= tick <= high]
