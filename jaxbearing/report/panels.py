"""One description of a chart, which every backend draws in its own way: matplotlib on paper, plotly on a page."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .display import digits

DASHES = ("solid", "dash", "dot", "dashdot")
MARKERS = ("circle", "square", "triangle-up", "diamond", "triangle-down", "triangle-left", "triangle-right")
"""Shapes of points, and styles of lines, by which curves differ besides their colours."""


@dataclass(frozen=True)
class Series:
    """A curve of numbers in the unit of the panel; what is not finite is a gap.

    - `marker`: one of `MARKERS`, or "" for a line without points.
    - `faint`: True for what the results are compared with.
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
    """Title, ends and ticks of an axis; those that are left out follow from the curves."""

    title: str = ""
    limits: tuple[float, float] | None = None
    ticks: Sequence[float] = ()
    from_zero: bool = False
    logarithmic: bool = False


@dataclass(frozen=True)
class Mark:
    """A point of a curve that is written out."""

    x: float
    y: float
    text: str


@dataclass(frozen=True)
class Curves:
    """Curves over one axis.

    - `unit`: of the vertical axis, "" for a number; it stands behind the title.
    - `of_elements`: True if each point is a rolling element at its azimuth, deg; points are then marked everywhere.
    - `levels`, `marks`: horizontal lines and points that are named, on paper only: a page shows numbers at the pointer.
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
    """Curves round a bearing, closed, over the azimuth in rad; azimuth 0 points down, counter-clockwise.

    `arrow`: azimuth along which the load points, on paper only: a page has the load in its drawing.
    """

    name: str
    title: str
    caption: str
    series: Sequence[Series]
    unit: str
    arrow: float | None = None


@dataclass(frozen=True)
class Numbers:
    """Results that are the same everywhere, as numbers in the place of flat curves.

    `columns`: name and colour of each column; `rows`: name of a result and its numbers with units, one a column.
    """

    name: str
    title: str
    caption: str
    columns: Sequence[tuple[str, str]]
    rows: Sequence[tuple[str, Sequence[str]]]


@dataclass(frozen=True)
class Bars:
    """Horizontal bars, the first above. `shares`: parts of the total, in words."""

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
        """A value or the total, with as many decimals as the largest bar needs for four digits and at least one."""
        shown = digits(max(self.values, key=abs))
        return digits(value) if "e" in shown else f"{value:.{max(1, len(shown.partition('.')[2]))}f}"

    def fraction(self, value: float) -> float:
        """Length of a bar over that of the largest one; 0 for a value that is not above 0."""
        largest = max(self.values)
        return max(0.0, value) / largest if largest > 0.0 else 0.0


Panel = Bars | Polar | Curves | Numbers

SAME = 5e-4
"""Largest difference of the values of a curve, over the largest one, that is no news: four digits show no more."""


def constant(panel: Polar | Curves) -> bool:
    """True if no curve of the panel changes by more than `SAME`."""
    return all(_spread(np.asarray(one.y, dtype=float)) <= SAME for one in panel.series)


def _spread(values: np.ndarray) -> float:
    """Largest difference over the largest value by modulus; infinite where some values are not finite."""
    if not np.all(np.isfinite(values)):
        return math.inf
    largest = float(np.max(np.abs(values)))
    return float(np.ptp(values)) / largest if largest > 0.0 else 0.0


def headed(panel: Polar | Curves) -> str:
    """Title and unit."""
    return f"{panel.title}, {panel.unit}" if panel.unit else panel.title


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
