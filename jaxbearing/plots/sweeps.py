"""Figures of a sweep: stacked power loss against a field, a result against a field, maps over two fields."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.backends.matplotlib.legends import clear_legend
from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import INK
from ..report.display import axis_unit, tick
from ..report.panels import log_ticks
from ..report.sweep_table import without_lives_that_yield
from .style import COLOURS, LINES, axis_name, finish, logarithmic, prepare, scale_of, shown

if TYPE_CHECKING:
    import matplotlib.artist
    import matplotlib.axes
    import matplotlib.cm
    import matplotlib.contour
    import matplotlib.figure
    import matplotlib.patheffects
    import xarray as xr

OPERATING_POINT = "operating point"
"""Name of the mark of an operating point."""
_LOSS = "power_loss_"
_LOG_FROM = 50.0
"""Largest over smallest value from which on the levels of a map, and the axis of a result, are those of a logarithm."""
_ROOM = 1.15
"""Factor between the ends of a logarithmic axis and its values."""
_SHORT = 30.0
"""Half the length of a contour, points, below which it is not labelled: the corner of a map would cut the label."""
_LINES_AT_MOST = 8
"""Values of a second field that are drawn as lines of their own."""
_LOCATIONS = {
    "drag": ("#CC79A7", None),
    "cage_pilot": ("#56B4E9", None),
    "pocket": ("#D55E00", None),
    "flange": ("#E69F00", None),
    "element_ends": ("#009E73", None),
    "outer_raceway": ("#0072B2", None),
    "inner_raceway": ("#F0E442", None),
    "rolling_resistance": ("#999999", None),
}
"""Colour and hatch of each location, the same in every figure."""
_MORE = (("#CC79A7", "///"), ("#56B4E9", "///"), ("#D55E00", "///"), ("#E69F00", "///"))
_REST = ("#DDDDDD", "...")


def power_loss_against(
    sweep: "xr.Dataset",
    field: str | None = None,
    *,
    axes: "matplotlib.axes.Axes | None" = None,
    legend: bool = True,
    operating_point: Mapping[str, float] | None = None,
) -> "matplotlib.figure.Figure":
    """Power loss by location, stacked, against a swept field; the black line is the total. The form of the source's
    Figures 36 to 40.

    A case that failed is a gap. Where a second field is swept too, one line of the total for each of its values.

    **Arguments:**
    - `sweep`: data set of a grid, from `jaxbearing.sweep` or read from its file.
    - `field`: dotted path of the field on the horizontal axis, "operation.inner_speed"; may be left out if only one
      field is swept.
    - `axes`: matplotlib axes to draw into; a new figure if not given.
    - `legend`: of the locations or lines; without it the caller's. Colours belong to locations, in every figure the
      same.
    - `operating_point`: dotted path -> SI value of fields; a dashed line marks that of the horizontal axis.

    **Raises:** `ValueError` for a sweep that is no grid, a field that was not swept, more than two fields, or a scene
    without power loss.
    """
    own, axes = axes is None, prepare(axes)
    fields = swept(sweep)
    x_name = _field(sweep, field, fields)
    others = [name for name in fields if name != x_name]
    _require(sweep, f"{_LOSS}total")
    if len(others) > 1:
        left = ", ".join(others[1:])
        raise ValueError(f"sweep: found {len(fields)} swept fields, expected at most 2; select a value of {left} first")
    x, x_unit = shown(sweep[x_name])
    order = np.argsort(x)
    if others:
        _family(axes, sweep, f"{_LOSS}total", x_name, others[0])
        caption = "Total power loss, one line for each value of the second field."
    else:
        caption = "Power loss by location, stacked; black line: the total."
        _stack(axes, sweep, x[order], order)
    axes.set_xlabel(axis_name(sweep[x_name], x_unit), fontsize=9)
    axes.set_xlim(x.min(), x.max() if x.max() > x.min() else None)
    _scale(axes, "x", x[order])
    caption += _mark(axes, sweep, operating_point, x_name)
    if legend:
        beside(axes, *_entries(axes, reverse=not others), title=_title(sweep, others))
    grid_lines(axes)
    return finish(axes, caption + failed_note(sweep, "Gaps"), own)


def result_against(
    sweep: "xr.Dataset",
    result: str,
    field: str | None = None,
    *,
    axes: "matplotlib.axes.Axes | None" = None,
    operating_point: Mapping[str, float] | None = None,
) -> "matplotlib.figure.Figure":
    """One result of a sweep, "cage_slip", against a swept field; a second field gives a family of lines, a failed case
    a gap. The axis of the result is logarithmic where the largest value is more than 50 times the smallest. Arguments
    and errors as for `power_loss_against`; `result` is a name of the data set."""
    own, axes = axes is None, prepare(axes)
    fields = swept(sweep)
    x_name = _field(sweep, field, fields)
    others = [name for name in fields if name != x_name]
    _require(sweep, result)
    if len(others) > 1:
        raise ValueError(f"sweep: found {len(fields)} swept fields, expected at most 2")
    if others:
        _family(axes, sweep, result, x_name, others[0])
    else:
        x, _ = shown(sweep[x_name])
        values, unit = shown(_results(sweep, result))
        order = np.argsort(x)
        axes.plot(x[order], values[order], color=COLOURS[0], marker="o", markersize=3.5, clip_on=False)
        axes.set_ylabel(name_of(sweep, result, unit), fontsize=9)
    _scale_of_results(axes)
    values, unit = shown(sweep[x_name])
    axes.set_xlabel(axis_name(sweep[x_name], unit), fontsize=9)
    axes.set_xlim(values.min(), values.max() if values.max() > values.min() else None)
    _scale(axes, "x", np.sort(values))
    note = _mark(axes, sweep, operating_point, x_name)
    if others:
        beside(axes, *_entries(axes), title=_title(sweep, others))
    elif note:
        clear_legend(axes)
    grid_lines(axes)
    text = name_of(sweep, result)
    return finish(axes, f"{text[:1].upper()}{text[1:]}.{note}{failed_note(sweep, 'Gaps')}", own)


def map_of(
    sweep: "xr.Dataset",
    result: str,
    x: str | None = None,
    y: str | None = None,
    *,
    axes: "matplotlib.axes.Axes | None" = None,
    operating_point: Mapping[str, float] | None = None,
) -> "matplotlib.figure.Figure":
    """Filled contours of one result over two swept fields; cases that failed are hatched, not interpolated. The levels
    are those of a logarithm where the largest value is more than 50 times the smallest.

    **Arguments:** `sweep`: data set of a grid; `result`: a name of the data set with one value a case
    ("power_loss_total", "cage_slip", "life_film_parameter"); `x`, `y`: dotted paths of the fields, the two that are
    swept if left out; `axes`: to draw into; `operating_point`: dotted path -> SI value of the two fields, marked by a
    ring.

    **Raises:** `ValueError` for another number of swept fields, for one with fewer than two values, or an unknown
    name.
    """
    own, axes = axes is None, prepare(axes)
    fields = swept(sweep)
    if len(fields) != 2:
        raise ValueError(f"sweep: found {len(fields)} swept fields, expected 2: {', '.join(fields) or 'none'}")
    x_name = fields[0] if x is None and y is None else next(f for f in fields if y is None or f != _named(y, fields))
    x_name = x_name if x is None else _named(x, fields)
    y_name = next(name for name in fields if name != x_name)
    if y is not None and _named(y, fields) != y_name:
        raise ValueError(f"y: found {y!r}, expected another field than x")
    _require(sweep, result)
    data = _results(sweep, result).transpose(y_name, x_name)
    if min(data.shape) < 2:
        raise ValueError(f"sweep: found {' x '.join(map(str, data.shape))} cases, expected at least 2 x 2 for a map")
    values, unit = shown(data)
    (xs, x_unit), (ys, y_unit) = shown(sweep[x_name]), shown(sweep[y_name])
    rows, columns = np.argsort(ys), np.argsort(xs)
    xs, ys, values = xs[columns], ys[rows], np.ma.masked_invalid(values[rows][:, columns])
    # hatched below; only failed cases let it be seen
    axes.set_facecolor("#F2F2F2")
    axes.fill_between([xs[0], xs[-1]], ys[0], ys[-1], facecolor="none", edgecolor="#9A9A9A", hatch="////", linewidth=0)
    axes.set_xlabel(axis_name(sweep[x_name], x_unit), fontsize=9)
    axes.set_ylabel(axis_name(sweep[y_name], y_unit), fontsize=9)
    axes.set(xlim=(xs[0], xs[-1]), ylim=(ys[0], ys[-1]))
    _scale(axes, "x", xs)
    _scale(axes, "y", ys)
    axes.tick_params(labelsize=8.5)
    filled, levels = _contours(axes, xs, ys, values)
    bar = axes.figure.colorbar(filled, ax=axes, format=lambda value, _: tick(value))
    bar.minorticks_off()
    bar.set_label(name_of(sweep, result, unit), fontsize=9)
    bar.ax.tick_params(labelsize=8.5)
    if len(levels):
        _label_contours(axes, axes.contour(xs, ys, values, levels=levels, colors="white", linewidths=0.8))
    text = name_of(sweep, result)
    note = _mark(axes, sweep, operating_point, x_name, y_name) + failed_note(sweep, "Hatched")
    return finish(axes, f"{text[:1].upper()}{text[1:]} over two swept fields.{note}", own)


def raceway_control_map(
    sweep: "xr.Dataset", *, element: int = 0, axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Raceway control of one ball (100 % outer, 0 % inner control) over two swept fields, or against one.

    **Arguments:** `sweep`: data set of a grid of a ball bearing, with `elements`; `element`: which ball, 0 stands on
    the load line; `axes`: to draw into.

    **Raises:** `ValueError` where the sweep has no raceway control, or as `map_of`.
    """
    _there(sweep, "raceway_control")
    control = sweep["raceway_control"]
    control = control.isel(element=element) if "element" in control.dims else control.copy()
    control.attrs = {"long_name": f"outer-race control of ball {element}", "units": "%"}
    data = sweep.drop_vars("raceway_control").assign(raceway_control=control)
    draw = map_of if len(swept(sweep)) == 2 else result_against
    return draw(data, "raceway_control", axes=axes)


def swept(sweep: "xr.Dataset") -> list[str]:
    """Names of the dimensions of a grid, those that have one value left out.

    **Raises:** `ValueError` for a sweep that is no grid.
    """
    if sweep.attrs.get("sweep_kind", "grid") != "grid":
        raise ValueError(f"sweep: found the cases of a {sweep.attrs['sweep_kind']} sweep, expected a grid of fields")
    names = [path.replace(".", "_") for path in sweep.attrs.get("sweep_fields", "").split()]
    return [name for name in names if name in sweep.dims]


def _named(field: str, fields: list[str]) -> str:
    name = field.replace(".", "_")
    if name not in fields:
        raise ValueError(f"field: found {field!r}, expected a swept field: {', '.join(fields) or 'there is none'}")
    return name


def _field(sweep: "xr.Dataset", field: str | None, fields: list[str]) -> str:
    if field is not None:
        return _named(field, fields)
    if not fields:
        raise ValueError("sweep: found no swept field, expected a grid of which one field is left at least")
    if len(fields) != 1:
        raise ValueError(f"field: found none, expected one of the swept fields: {', '.join(fields) or 'there is none'}")
    return fields[0]


def _there(sweep: "xr.Dataset", result: str) -> None:
    if result not in sweep:
        kind = "the scene models no power loss" if result.startswith(_LOSS) else "expected a name of the data set"
        raise ValueError(f"sweep: found no {result!r}: {kind}")


def _require(sweep: "xr.Dataset", result: str) -> None:
    """One number a case."""
    _there(sweep, result)
    dims = [str(name) for name in sweep[result].dims if name not in swept(sweep)]
    if dims or not np.issubdtype(sweep[result].dtype, np.number):
        content = f"a value for each {', '.join(dims)}" if dims else "text"
        raise ValueError(f"{result}: found {content}, expected one number a case (select one first)")


def name_of(sweep: "xr.Dataset", result: str, unit: str = "") -> str:
    """A result's name and unit; that of the total loss, labelled as a row of its table, in full."""
    if result == f"{_LOSS}total":
        return f"total power loss, {unit}" if unit else "total power loss"
    return axis_name(sweep[result], unit)


def _spread(values: np.ndarray) -> str:
    """The scale of an axis: logarithmic where values stand at equal ratios over more than a decade."""
    if values.size < 4 or values.min() <= 0.0 or values.max() < 10.0 * values.min():
        return "linear"
    steps = np.diff(np.log(values))
    return "log" if np.ptp(steps) < 0.05 * steps.mean() else "linear"


def _scale(axes: "matplotlib.axes.Axes", which: str, values: np.ndarray) -> None:
    """Logarithmic where the values, which are sorted, ask for it; ticks are then written as numbers."""
    if _spread(values) == "log":
        logarithmic(axes, which)


def _scale_of_results(axes: "matplotlib.axes.Axes") -> None:
    """Makes the upright axis logarithmic where the lines pass through so large a range of values above 0."""
    values = np.ma.masked_invalid(np.concatenate([line.get_ydata() for line in axes.get_lines()]))
    if not values.count() or values.min() <= 0.0 or values.max() <= _LOG_FROM * values.min():
        return
    axes.set_ylim(values.min() / _ROOM, values.max() * _ROOM)
    logarithmic(axes, "y")


def _contours(
    axes: Any, xs: np.ndarray, ys: np.ndarray, values: np.ma.MaskedArray
) -> "tuple[matplotlib.cm.ScalarMappable, Sequence[float]]":
    """Filled contours, and the levels of those that are drawn as lines."""
    if not values.count() or values.min() == values.max():
        return axes.pcolormesh(xs, ys, values, cmap="cividis"), ()
    low, high = float(values.min()), float(values.max())
    if low <= 0.0 or high <= _LOG_FROM * low:
        filled = axes.contourf(xs, ys, values, levels=12, cmap="cividis", corner_mask=False)
        return filled, filled.levels[2:-1:2]
    from matplotlib.colors import LogNorm

    inside = [level for level in log_ticks(low, high) if low < level < high]
    style = {"levels": [low, *inside, high], "norm": LogNorm(low, high)}
    filled = axes.contourf(xs, ys, values, cmap="cividis", corner_mask=False, **style)
    return filled, inside


def _label_contours(axes: "matplotlib.axes.Axes", lines: "matplotlib.contour.QuadContourSet") -> None:
    """Writes the level of each contour on the middle of its longest piece, where no edge cuts it."""
    # angles of the labels are those of the lines on the page
    axes.figure.canvas.figure.draw_without_rendering()
    places = []
    for pieces in filter(None, lines.allsegs):
        drawn = [axes.transData.transform(piece) for piece in pieces]
        along = [np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(piece, axis=0).T))]) for piece in drawn]
        longest = int(np.argmax([length[-1] for length in along]))
        half = 0.5 * along[longest][-1]
        if 72.0 * half < _SHORT * axes.figure.dpi:
            continue
        middle = [np.interp(half, along[longest], values) for values in drawn[longest].T]
        places.append(tuple(axes.transData.inverted().transform(middle)))
    for text in axes.clabel(lines, fontsize=9, colors=INK, fmt=tick, manual=places):
        text.set_path_effects(_halo())


def _mark(
    axes: "matplotlib.axes.Axes",
    sweep: "xr.Dataset",
    point: Mapping[str, float] | None,
    x_name: str,
    y_name: str | None = None,
) -> str:
    """Marks an operating point that lies within the sweep, and returns what the caption says of it."""
    values = {path.replace(".", "_"): value for path, value in (point or {}).items()}
    names = [x_name] if y_name is None else [x_name, y_name]
    if any(name not in values for name in names):
        return ""
    if not all(float(sweep[name].min()) <= values[name] <= float(sweep[name].max()) for name in names):
        return ""
    place = [float(scale_of(sweep[name]).of(values[name])) for name in names]
    if y_name is None:
        axes.axvline(place[0], color=INK, linestyle="--", linewidth=1.1, label=OPERATING_POINT)
        return " Dashed: the operating point."
    style = {"markerfacecolor": "white", "markeredgecolor": INK, "markersize": 9, "markeredgewidth": 2.0}
    axes.plot(*place, marker="o", linestyle="none", clip_on=False, zorder=5, **style)
    _name_ring(axes, place)
    return " Ring: the operating point."


def _name_ring(axes: Any, place: list[float]) -> None:
    """Writes beside the ring what it is, towards the middle of the map."""
    across, up = axes.transAxes.inverted().transform(axes.transData.transform(place))
    text = axes.annotate(
        OPERATING_POINT,
        place,
        xytext=(9 if across < 0.5 else -9, 9 if up < 0.5 else -9),
        textcoords="offset points",
        ha="left" if across < 0.5 else "right",
        va="bottom" if up < 0.5 else "top",
        fontsize=9,
        fontweight="bold",
        color=INK,
    )
    text.set_path_effects(_halo())


def _halo() -> "list[matplotlib.patheffects.AbstractPathEffect]":
    """White round letters, which are readable on all colours of a map."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=2.5, foreground="white")]


def _title(sweep: "xr.Dataset", others: list[str]) -> str | None:
    """Title of the legend of a family of lines."""
    return str(sweep[others[0]].attrs.get("long_name", others[0])) if others else None


def _entries(axes: "matplotlib.axes.Axes", reverse: bool = False) -> "tuple[list[matplotlib.artist.Artist], list[str]]":
    handles, names = axes.get_legend_handles_labels()
    return (handles[::-1], names[::-1]) if reverse else (handles, names)


def _results(sweep: "xr.Dataset", result: str) -> "xr.DataArray":
    """A result, NaN where the case failed, whatever is stored there, and for lives where the bearing yields."""
    if "failure" not in sweep:
        return sweep[result]
    return without_lives_that_yield(sweep)[result].where(sweep["failure"] == "")


def failed_note(sweep: "xr.Dataset", mark: str) -> str:
    """The number of cases that failed, in words after a space; "" if none did. **Arguments:** `mark`: how they are
    drawn."""
    failed = int((sweep["failure"] != "").sum()) if "failure" in sweep else 0
    return f" {mark}: {failed} of {sweep['failure'].size} cases failed." if failed else ""


def _stack(axes: "matplotlib.axes.Axes", sweep: "xr.Dataset", x: np.ndarray, order: np.ndarray) -> None:
    total = _results(sweep, f"{_LOSS}total").values[order]
    unit, factor = axis_unit("W", float(np.nanmax(np.abs(total), initial=0.0)))
    names = [str(n) for n in sweep.data_vars if str(n).startswith(_LOSS) and n != f"{_LOSS}total"]
    parts = {name: factor * _results(sweep, name).values[order] for name in names}
    # a loss that is nowhere a thousandth of the total would be a line of no width with an entry of its own
    largest = float(np.nanmax(np.abs(factor * total), initial=0.0))
    drawn = [name for name in names if np.nanmax(np.abs(parts[name]), initial=0.0) > 1e-3 * largest]
    small = [parts[name] for name in names if name not in drawn]
    others = iter(_MORE * len(drawn))
    bands = []
    for name in drawn:
        location = name.removeprefix(_LOSS)
        bands.append((location.replace("_", " "), _LOCATIONS.get(location) or next(others), parts[name]))
    if small:
        bands.append(("other, each < 0.1 %", _REST, np.sum(small, axis=0)))
    base = np.zeros_like(x)
    for name, (colour, hatch), values in bands:
        style = {"facecolor": colour, "hatch": hatch, "edgecolor": "white", "linewidth": 0.5}
        axes.fill_between(x, base, base + values, label=name, **style)
        base = base + values
    axes.plot(x, factor * total, color=INK, linewidth=1.4, marker="o", markersize=3, label="total")
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel(f"power loss, {unit}", fontsize=9)


def beside(
    axes: "matplotlib.axes.Axes",
    handles: "Sequence[matplotlib.artist.Artist]",
    labels: Sequence[str],
    title: str | None = None,
) -> None:
    """Draws a legend on the right of the axes, where it hides nothing."""
    style = {"fontsize": 8.5, "title_fontsize": 8.5, "frameon": False, "borderaxespad": 0.0, "alignment": "left"}
    axes.legend(handles, labels, title=title, loc="upper left", bbox_to_anchor=(1.02, 1.0), **style)


def _family(axes: "matplotlib.axes.Axes", sweep: "xr.Dataset", result: str, x_name: str, other: str) -> None:
    x, _ = shown(sweep[x_name])
    second, second_unit = shown(sweep[other])
    data = _results(sweep, result).transpose(other, x_name)
    values, unit = shown(data)
    picked = np.unique(np.linspace(0, second.size - 1, min(second.size, _LINES_AT_MOST)).round().astype(int))
    order = np.argsort(x)
    for number, row in enumerate(picked):
        label = f"{second[row]:.5g} {second_unit}".rstrip()
        style: dict[str, Any] = {"color": COLOURS[number % 6], "linestyle": LINES[number // 6]}
        axes.plot(x[order], values[row][order], marker="o", markersize=3, linewidth=1.4, label=label, **style)
    axes.set_ylabel(name_of(sweep, result, unit), fontsize=9)
