"""One page of plots of a bearing's steady solve; what the scene does not model is not on it."""

import dataclasses
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bearings.solution import Solution
from ..display import digits, displayed
from ..sheet import FAINT, INK, axis_unit, foot, grid_lines, head, log_ticks, pretty, round_up, title_of
from .operation import load_angle, operating_point

if TYPE_CHECKING:
    import matplotlib.figure

# Okabe and Ito's colours, which all kinds of colour vision tell apart
INNER, OUTER, RIB, LOSS = "#0072B2", "#D55E00", "#009E73", "#56789A"
SIDES = (("outer", OUTER, "s", "outer race"), ("inner", INNER, "o", "inner race"), ("flange", RIB, "^", "rib"))

LOG_FROM = 20.0
"""Largest over smallest value from which on an axis is logarithmic: the films of the loaded zone must be readable."""
_SCALE_AZIMUTH = math.radians(157.5)
"""Angle of the numbers of the polar plot: away from the load line."""

ROUND = {
    "film": ("Central film", False),
    "pressure": ("Hertz (peak) pressure", True),
    "sliding": ("Sliding speed", False),
}
"""Results of raceways or rib: title, and whether the axis begins at 0."""


def plot_bearing(solution: Solution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`: a page with the power loss by location and, round the bearing, loads, films,
    pressures and sliding speeds."""
    from ..page import Page

    if np.ndim(solution.status) != 0:
        raise ValueError("plot_solution draws one solution, got a batch: take one lane of it")
    if not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    losses = power_losses(solution)
    at = lambda name, side: getattr(solution.elements, f"{name}_{side}", None)
    rounds = [name for name in ROUND if at(name, "inner") is not None or at(name, "flange") is not None]
    figure = Page()
    head(figure, title, pretty(operating_point(solution)))
    bottom = 0.075 + 0.019 * foot(figure, solution.warnings)
    if losses:
        left = figure.add_gridspec(1, 1, left=0.125, right=0.575, top=0.843, bottom=0.47)
        right = figure.add_gridspec(1, 1, left=0.67, right=0.93, top=0.818, bottom=0.47)
        lower = figure.add_gridspec(1, len(rounds), left=0.05, right=0.985, top=0.355, bottom=bottom, wspace=0.17)
        draw_losses(figure.add_subplot(left[0]), losses, float(solution.power_loss.total))
        loads = figure.add_subplot(right[0], projection="polar")
        places = [lower[i] for i in range(len(rounds))]
    else:
        grid = figure.add_gridspec(
            len(rounds), 2, left=0.05, right=0.98, top=0.79, bottom=bottom + 0.03, wspace=0.18, hspace=0.42
        )
        loads = figure.add_subplot(grid[:, 0], projection="polar")
        places = [grid[i, 1] for i in range(len(rounds))]
    draw_loads(loads, solution)
    for name, place in zip(rounds, places, strict=True):
        draw_round(figure.add_subplot(place), solution, name)
    handles, names = _legend(figure)
    figure.legend(handles, names, loc="center right", bbox_to_anchor=(0.99, 0.92), ncols=2, fontsize=9.5, frameon=False)
    return figure


def _legend(figure: Any) -> tuple[list[Any], list[str]]:
    """One entry for each of the raceways and the rib that is drawn anywhere."""
    drawn: dict[str, Any] = {}
    for axes in figure.axes:
        handles, names = axes.get_legend_handles_labels()
        drawn |= dict(zip(names, handles, strict=True))
    names = [label for *_, label in SIDES if label in drawn]
    return [drawn[name] for name in names], names


def power_losses(solution: Solution) -> dict[str, float]:
    """Dissipation by location, W, largest first, without the total; empty where nothing is dissipated."""
    loss = solution.power_loss
    named = {field.name: getattr(loss, field.name) for field in dataclasses.fields(loss) if field.name != "total"}
    watts = {name: float(value) for name, value in named.items() if value is not None}
    return dict(sorted(watts.items(), key=lambda entry: -entry[1]))


def draw_losses(axes: Any, losses: dict[str, float], total: float) -> None:
    unit, factor = axis_unit("W", max(abs(watts) for watts in losses.values()))
    widths = [watts * factor for watts in losses.values()]
    names = [name.replace("_", " ") for name in losses]
    bars = axes.barh(names, widths, color=LOSS, height=0.68)
    axes.invert_yaxis()
    percent = lambda watts: f"{100.0 * watts / total:.1f} %" if total else "-"
    texts = [f"{_power(factor * watts, widths)} {unit}   {percent(watts)}" for watts in losses.values()]
    axes.bar_label(bars, texts, padding=5, fontsize=9, color=INK)
    largest, lowest = max([0.0, *widths]), min([0.0, *widths])
    axes.set_xlim(1.25 * lowest, 1.3 * largest if largest > 0.0 else 1.0)
    title_of(axes, f"Power loss by location, {unit}: total {_power(total * factor, widths)} {unit}", pad=16)
    axes.tick_params(axis="y", length=0, labelsize=9.5)
    axes.tick_params(axis="x", labelsize=8.5)
    axes.grid(axis="x", color="#E4E4E4", linewidth=0.7)
    axes.set_axisbelow(True)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _power(value: float, column: list[float]) -> str:
    """With as many decimals as the largest of the column needs for four digits."""
    _, _, decimals = digits(max(column, key=abs), 4).partition(".")
    return f"{value:.{len(decimals)}f}" if "e" not in decimals else digits(value)


def draw_loads(axes: Any, solution: Solution) -> None:
    """Loads round the bearing as the bearing stands: azimuth 0, the load line, points down."""
    elements = solution.elements
    azimuth = np.asarray(elements.azimuth)
    inner, outer = np.asarray(elements.load_inner), np.asarray(elements.load_outer)
    unit, factor = axis_unit("N", float(max(inner.max(), outer.max())))
    axes.set_theta_zero_location("S")
    closed = np.append(azimuth, azimuth[0] + 2.0 * math.pi)
    for load, colour, marker, name in ((outer, OUTER, "s", "outer race"), (inner, INNER, "o", "inner race")):
        values = np.append(load, load[0]) * factor
        axes.plot(closed, values, color=colour, marker=marker, markersize=3.2, linewidth=1.2, label=name)
        axes.fill(closed, values, color=colour, alpha=0.12, linewidth=0)
    top = round_up(float(max(inner.max(), outer.max())) * factor)
    axes.set_ylim(0.0, top)
    axes.set_yticks([top / 2.0, top], [])
    halo = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6}
    for radius, text in ((top / 2.0, f"{top / 2.0:g}"), (top, f"{top:g} {unit}")):
        axes.text(_SCALE_AZIMUTH, radius, text, fontsize=8, color=INK, ha="center", va="center", bbox=halo, zorder=5)
    ticks = np.arange(0, 360, 45)
    axes.set_thetagrids(ticks, [f"{tick}°" for tick in ticks], fontsize=8.5, color=INK)
    axes.tick_params(axis="x", pad=2)
    axes.grid(color="#D8D8D8", linewidth=0.7)
    axes.spines["polar"].set_color(FAINT)
    angle = load_angle(solution.operation)
    if angle is not None:
        _load_arrow(axes, angle)
    title_of(axes, f"Load on each rolling element, {unit}", pad=16)


def _load_arrow(axes: Any, angle: float) -> None:
    """Beside the picture; azimuth 0 is below, counter-clockwise."""
    arrow = {"arrowstyle": "-|>,head_width=0.35,head_length=0.7", "linewidth": 2.2, "color": INK}
    place, half = np.array([1.05, 0.07]), 0.07 * np.array([math.sin(angle), -math.cos(angle)])
    axes.annotate("", xy=tuple(place + half), xytext=tuple(place - half), xycoords="axes fraction", arrowprops=arrow)
    axes.text(1.05, 0.165, "load", transform=axes.transAxes, fontsize=9, color=INK, ha="center")


def draw_round(axes: Any, solution: Solution, name: str) -> None:
    title, from_zero = ROUND[name]
    elements = solution.elements
    values = {side: getattr(elements, f"{name}_{side}", None) for side in ("inner", "outer", "flange")}
    values = {side: np.asarray(v) for side, v in values.items() if v is not None}
    labels = {field.name: field.metadata for field in dataclasses.fields(elements)}
    metadata = labels[f"{name}_{next(iter(values))}"]
    # a roller that touches nothing has no film: NaN
    largest = float(max((np.nanmax(np.abs(v)) for v in values.values() if np.any(np.isfinite(v))), default=0.0))
    unit, factor = axis_unit(metadata["unit"], largest)
    azimuth = displayed(1.0, "rad") * np.asarray(elements.azimuth)
    azimuth = np.where(azimuth > 180.0 + 1e-9, azimuth - 360.0, azimuth)
    order = np.argsort(azimuth)
    for side, colour, marker, label in SIDES:
        if side in values:
            shown = factor * values[side][order]
            axes.plot(azimuth[order], shown, color=colour, marker=marker, markersize=3.2, linewidth=1.2, label=label)
    smallest = float(min((np.nanmin(v) for v in values.values() if np.any(np.isfinite(v))), default=0.0))
    if not from_zero and smallest > 0.0 and largest > LOG_FROM * smallest:
        _logarithmic(axes, smallest * factor, largest * factor)
    else:
        axes.margins(y=0.1)
        axes.ticklabel_format(axis="y", useOffset=False)
    axes.set_xlim(-188.0, 188.0)
    axes.set_xticks([-180, -90, 0, 90, 180])
    axes.set_xlabel("azimuth from the load line, deg", fontsize=9)
    if from_zero:
        axes.set_ylim(bottom=0.0)
    title_of(axes, f"{title}, {unit}")
    grid_lines(axes)


def _logarithmic(axes: Any, smallest: float, largest: float) -> None:
    """A logarithmic axis with ticks at 1, 2 and 5 times powers of ten, written out."""
    axes.set_yscale("log")
    axes.set_ylim(0.8 * smallest, 1.25 * largest)
    inside = log_ticks(0.8 * smallest, 1.25 * largest)
    axes.set_yticks(inside, [f"{tick:g}" for tick in inside])
    axes.set_yticks([], minor=True)
