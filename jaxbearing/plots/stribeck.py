"""The Stribeck curve of a bearing: its friction torque against speed, with the part of boundary friction."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..report.backends.matplotlib.legends import clear_legend
from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import INK
from ..report.display import axis_unit
from .style import axis_name, finish, logarithmic, prepare, shown
from .sweeps import swept

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import xarray as xr

    from .._scene import AbstractScene

SPEED = "operation.inner_speed"
SLOWEST, COUNT = 1e-3, 31
"""First of the speeds that are taken if none are given, over that of the scene, and their number."""
_BOUNDARY, _FILM = "#D55E00", "#56B4E9"


def stribeck(
    scene: "AbstractScene | xr.Dataset",
    speeds: Sequence[float] | None = None,
    *,
    axes: "matplotlib.axes.Axes | None" = None,
) -> "matplotlib.figure.Figure":
    """Friction torque of a bearing against the speed of its inner ring: power loss over the speed of the rings against
    each other. Bands: boundary friction of asperities, and all other losses.

        scene = jb.load_scene("tapered_example", {"contact.mixed.roughness": "0.3 um"})
        figure = jb.plots.stribeck(scene)

    A case that failed is a gap.

    **Arguments:**
    - `scene`: a bearing with losses, which is solved at every speed (`jaxbearing.sweep`); or the data set of such a
      sweep over `operation.inner_speed` alone.
    - `speeds`: of the inner ring, rad/s; 31 speeds at equal ratios from a thousandth of the scene's own if not given.
    - `axes`: matplotlib axes to draw into; a new figure if not given.

    **Raises:** `ValueError` for what is no bearing, for a scene without power loss, for a sweep of other fields, and
    for speeds where the rings do not turn against each other.
    """
    import xarray as xr

    data = scene if isinstance(scene, xr.Dataset) else _solved(scene, speeds)
    speed, relative = _speeds(data)
    order = np.argsort(speed)
    good = data["failure"].values == "" if "failure" in data else np.ones(speed.size, bool)
    torque = lambda name: np.where(good, data[name].values / relative, np.nan)[order]
    total = torque("power_loss_total")
    boundary = torque("boundary_power_total") if "boundary_power_total" in data else None

    own, axes = axes is None, prepare(axes)
    values, speed_unit = shown(data["operation_inner_speed"])
    values = values[order]
    unit, factor = axis_unit("N m", float(np.nanmax(np.abs(total), initial=0.0)))
    rubbed = np.zeros_like(total) if boundary is None else boundary
    style = {"edgecolor": "white", "linewidth": 0.5}
    if boundary is not None:
        axes.fill_between(values, 0.0, factor * rubbed, facecolor=_BOUNDARY, label="boundary friction", **style)
    axes.fill_between(values, factor * rubbed, factor * total, facecolor=_FILM, label="films and all else", **style)
    axes.plot(values, factor * total, color=INK, linewidth=1.4, marker="o", markersize=3, label="total")
    axes.set_xlim(values[0], values[-1])
    if np.all(values > 0.0) and values[-1] > 10.0 * values[0]:
        logarithmic(axes, "x")
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(axis_name(data["operation_inner_speed"], speed_unit), fontsize=9)
    axes.set_ylabel(f"friction torque, {unit}", fontsize=9)
    grid_lines(axes)
    figure = finish(axes, _caption(values, speed_unit, total, boundary), own)
    clear_legend(axes)
    return figure


def _solved(scene: "AbstractScene", speeds: Sequence[float] | None) -> "xr.Dataset":
    """The sweep over speed."""
    from ..sweep import sweep

    own = scene.part_at(SPEED)
    if own is None:
        raise ValueError(f"stribeck: found a {type(scene).__name__} without {SPEED}, expected a bearing")
    chosen = np.geomspace(SLOWEST, 1.0, COUNT) * float(own) if speeds is None else speeds
    return sweep(scene, {SPEED: np.asarray(chosen, dtype=float)}, elements=False)


def _speeds(data: "xr.Dataset") -> tuple[np.ndarray, np.ndarray]:
    """Speeds of the inner ring, and of the rings against each other, rad/s."""
    fields = swept(data)
    if fields != ["operation_inner_speed"]:
        raise ValueError(f"stribeck: found the swept fields {', '.join(fields) or 'none'}, expected {SPEED} alone")
    if "power_loss_total" not in data:
        raise ValueError("stribeck: found a scene that models no power loss, expected one with friction")
    inner = np.asarray(data["operation_inner_speed"].values, dtype=float)
    outer = np.asarray(data["operation_outer_speed"].values) if "operation_outer_speed" in data else np.zeros(())
    relative = np.abs(inner - outer)
    if np.any(relative == 0.0):
        raise ValueError("stribeck: found rings that turn alike, expected speeds at which they turn against each other")
    return inner, relative


def _caption(speed: np.ndarray, unit: str, total: np.ndarray, boundary: np.ndarray | None) -> str:
    text = "Friction torque: power loss over the speed of the rings against each other."
    if boundary is None:
        return f"{text} The scene models no mixed friction."
    known = np.isfinite(total)
    if known.any():
        slow = int(np.argmax(known))
        part = 100.0 * boundary[slow] / total[slow]
        text += f" Boundary friction is {part:.3g} % of it at {speed[slow]:.4g} {unit}."
        lowest = _minimum(total)
        if lowest is not None:
            text += f" It has a minimum near {speed[lowest]:.4g} {unit}."
    failed = int((~known).sum())
    return f"{text} Gaps: {failed} of {total.size} cases failed." if failed else text


def _minimum(values: np.ndarray) -> int | None:
    """Index of the lowest of the minima between the ends; `None`: there is none."""
    inside, before, after = values[1:-1], values[:-2], values[2:]
    places = 1 + np.flatnonzero((inside < before) & (inside <= after))
    return int(places[np.argmin(values[places])]) if places.size else None
