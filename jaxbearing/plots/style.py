"""Common parts of the figures of solutions and sweeps: axes, colours, units of swept fields and results."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.display import tick
from ..report.labels import label_unit
from ..report.panels import log_ticks
from .frame import HEIGHT, WIDTH, Axis, axis_for, write_below

if TYPE_CHECKING:
    import matplotlib.axes
    import xarray as xr

# Okabe and Ito's colours, which all kinds of colour vision tell apart
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#E69F00", "#56B4E9", "#CC79A7", "#F0E442", "#222222")
LINES = ("-", "--", ":", "-.")


def prepare(axes: "matplotlib.axes.Axes | None", polar: bool = False) -> "matplotlib.axes.Axes":
    """The axes given, or those of a new figure."""
    if axes is not None:
        return axes
    from ..report.backends.matplotlib.page import Page

    figure = Page(WIDTH, HEIGHT)
    # before anything is drawn: a colour bar is placed by the engine of its figure
    figure.set_layout_engine("constrained")
    return figure.add_subplot(projection="polar" if polar else None)


def finish(axes: Any, caption: str, own: bool) -> Any:
    """The figure; with its caption, which may tell what was found while drawing, if the figure is our `own`."""
    if own:
        write_below(axes.figure, caption)
    return axes.figure


def shown(variable: "xr.DataArray") -> tuple[np.ndarray, str]:
    """Values in engineer's units and the unit ("" for a number): fields of a scene, or results of a sweep."""
    axis = scale_of(variable)
    return axis.of(np.asarray(variable.values, dtype=float)), axis.unit


def scale_of(variable: "xr.DataArray") -> Axis:
    """The axis that fits all values of a variable."""
    axis = axis_for(label_unit(str(variable.attrs.get("units", "1"))), np.asarray(variable.values, dtype=float))
    return axis._replace(unit="" if axis.unit == "1" else axis.unit)


def axis_name(variable: "xr.DataArray", unit: str) -> str:
    name = str(variable.attrs.get("long_name", variable.name))
    return f"{name}, {unit}" if unit else name


def logarithmic(axes: "matplotlib.axes.Axes", which: str) -> None:
    """Makes the axis "x" or "y", whose ends are set, logarithmic with ticks that are written as numbers."""
    axes.set(**{f"{which}scale": "log"})
    ticks = log_ticks(*sorted(getattr(axes, f"get_{which}lim")()))
    getattr(axes, f"set_{which}ticks")(ticks, [*map(tick, ticks)])
    getattr(axes, f"set_{which}ticks")([], minor=True)
