"""Common parts of all figures: size, caption, units of an axis."""

import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..report.colours import INK
from ..report.display import ZERO_CELSIUS, axis_unit, display_unit, displayed

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

WIDTH, HEIGHT = 7.2, 4.9
"""Width and height of a figure, inches."""
_CAPTION_SIZE, _PER_INCH, _LINE = 8.5, 15.5, 0.165
"""Size of a caption's letters in points, letters in an inch, height of a line in inches."""
_MARGIN = 0.12


class Axis(NamedTuple):
    """Unit on an axis ("" for a number) and what turns SI values into it."""

    unit: str
    of: Callable[[Any], np.ndarray]

    def named(self, text: str) -> str:
        """A label: what is drawn, and its unit."""
        return f"{text}, {self.unit}" if self.unit else text


def axis_for(unit: str, values: object) -> Axis:
    """Engineer's unit of an axis.

    **Arguments:** `unit`: SI, as in the labels; `values`: all that is drawn, in SI, NaN where there is nothing.
    """
    if unit == "K":
        return Axis("°C", lambda kelvin: np.asarray(kelvin) - ZERO_CELSIUS)
    if unit == "percent":
        return Axis("%", np.asarray)
    numbers = np.abs(np.asarray(values, dtype=np.float64))
    largest = float(np.max(numbers[np.isfinite(numbers)], initial=0.0))
    name, factor = axis_unit(unit, largest)
    if name == unit and factor == 1.0:
        name, factor = display_unit(unit), displayed(1.0, unit)
    return Axis(name.replace("um", "µm"), lambda si: factor * np.asarray(si))


def drawing(
    axes: "matplotlib.axes.Axes | None",
    caption: str,
    projection: str | None = None,
    size: tuple[float, float] = (WIDTH, HEIGHT),
) -> "tuple[Any, matplotlib.axes.Axes]":
    """Figure and axes to draw into: the given axes, or new ones with the caption under them.

    **Arguments:** `axes`: matplotlib axes, or `None`; `projection`: that new axes are to have; `size`: inches.

    **Raises:** `ValueError` where the given axes have another projection.
    """
    if axes is not None:
        if axes.name != (projection or "rectilinear"):
            raise ValueError(f"axes: found the projection '{axes.name}', expected '{projection or 'rectilinear'}'")
        return axes.figure, axes
    from ..report.backends.matplotlib.page import Page

    figure = Page(*size)
    write_below(figure, caption)
    return figure, figure.add_subplot(projection=projection)


def write_below(figure: "matplotlib.figure.Figure", caption: str) -> None:
    """The caption under what is drawn."""
    width, height = figure.get_size_inches()
    lines = textwrap.wrap(caption, int(_PER_INCH * (width - 0.3)))
    below = _LINE * len(lines) + 2.0 * _MARGIN
    edge = 0.5 * _MARGIN / width
    place = (edge, below / height, 1.0 - 2.0 * edge, 1.0 - below / height - 0.01)
    figure.set_layout_engine("constrained", rect=place)
    figure.text(
        0.15 / width,
        _MARGIN / height,
        "\n".join(lines),
        fontsize=_CAPTION_SIZE,
        color=INK,
        va="bottom",
        linespacing=1.35,
        in_layout=False,
        parse_math=False,
    )
