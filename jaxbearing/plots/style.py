"""What the figures share: the axes to draw into, the caption, colours, and the units of swept fields and results."""

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.display import ZERO_CELSIUS, display_unit, displayed
from ..report.sheet import INK, axis_unit

if TYPE_CHECKING:
    import xarray as xr

# Okabe and Ito's colours, which all kinds of colour vision tell apart
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#E69F00", "#56B4E9", "#CC79A7", "#F0E442", "#222222")
LINES = ("-", "--", ":", "-.")
LABEL_UNITS = {"rad s-1": "rad/s", "m s-1": "m/s", "N m-1": "N/m", "m3 s-1": "m^3/s"}
"""Units of a data set -> those of the library's labels, which know how they are shown."""
_CAPTION_LENGTH = 105
_SIZE = (7.2, 4.6)


def prepare(axes: Any, polar: bool = False) -> Any:
    """The axes given, or those of a new figure, made without pyplot: no window, no state."""
    if axes is not None:
        return axes
    from matplotlib.figure import Figure

    figure = Figure(figsize=_SIZE, dpi=100, facecolor="white", layout="constrained")
    return figure.add_subplot(projection="polar" if polar else None)


def finish(axes: Any, caption: str, own: bool) -> Any:
    """The figure, with its caption as `figure.caption`; printed below the picture if the figure is our `own`."""
    figure = axes.figure
    figure.caption = caption
    if own:
        figure.supxlabel("\n".join(textwrap.wrap(caption, _CAPTION_LENGTH)), fontsize=7.5, color=INK, x=0.02, ha="left")
    return figure


def shown(variable: "xr.DataArray") -> tuple[np.ndarray, str]:
    """Values in engineer's units and the unit: the fields of a scene, or results of a sweep."""
    values = np.asarray(variable.values, dtype=float)
    unit = LABEL_UNITS.get(variable.attrs.get("units", "1"), variable.attrs.get("units", "1"))
    if unit == "K":
        return values - ZERO_CELSIUS, "°C"
    if unit in ("rad/s", "rad", "m^3/s"):
        return displayed(1.0, unit) * values, display_unit(unit)
    name, factor = axis_unit(unit, float(np.nanmax(np.abs(values), initial=0.0)))
    return factor * values, "" if name == "1" else name


def axis_name(variable: "xr.DataArray", unit: str) -> str:
    name = str(variable.attrs.get("long_name", variable.name))
    return f"{name}, {unit}" if unit else name
