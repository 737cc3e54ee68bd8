"""A page of traction curves: one diagram for each temperature and speed, one curve for each pressure."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ...machines import TwoDiskSolution
from ..display import ZERO_CELSIUS
from ..sheet import INK, axis_unit, foot, grid_lines, head, title_of
from .curves import Curve, curves_of

if TYPE_CHECKING:
    import matplotlib.figure

PANELS = 12
"""Diagrams on the page; more are counted at its foot."""
# Okabe and Ito's colours, which all kinds of colour vision tell apart
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#222222")
_MARKERS = "os^Dv<>"
_MARKED = 40
"""Points of a curve up to which each is marked."""


def plot_two_disk(solution: TwoDiskSolution, title: str) -> "matplotlib.figure.Figure":
    """See `report.plots.plot_solution`."""
    curves = list(curves_of(solution))
    if not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    from ..page import Page

    places = list(dict.fromkeys(curve.place[:2] for curve in curves))
    left_out = [] if len(places) <= PANELS else [f"{PANELS} of {len(places)} pairs of temperature and speed are shown"]
    places = places[:PANELS]
    rows, columns = _layout(places)
    figure = Page()
    operation = type(solution.operation).__dataclass_fields__
    varied = operation["load" if solution.operation.pressure is None else "pressure"].metadata["description"]
    text = f"Traction coefficient over slide-to-roll ratio (difference over mean speed), one curve for each {varied}"
    head(figure, title, text)
    bottom = 0.085 + 0.019 * foot(figure, [*left_out, *solution.warnings])
    grid = figure.add_gridspec(
        rows, columns, left=0.065, right=0.985, top=0.815, bottom=bottom, wspace=0.14, hspace=0.42 if rows > 2 else 0.3
    )
    first: Any = None
    for number, place in enumerate(places):
        axes = figure.add_subplot(grid[divmod(number, columns)], sharex=first, sharey=first)
        first = axes if first is None else first
        draw_panel(axes, solution, [curve for curve in curves if curve.place[:2] == place])
        if number % columns == 0:
            axes.set_ylabel("traction coefficient", fontsize=9)
        if number >= len(places) - columns:
            axes.set_xlabel("slide-to-roll ratio, %", fontsize=9)
    handles, names = first.get_legend_handles_labels()
    figure.legend(
        handles,
        names,
        loc="upper left",
        bbox_to_anchor=(0.022, 0.908),
        ncols=7,
        fontsize=9.5,
        frameon=False,
    )
    return figure


def _layout(places: list[tuple[int, ...]]) -> tuple[int, int]:
    """Rows and columns: temperatures and speeds where both vary."""
    temperatures, speeds = (len(dict.fromkeys(place[i] for place in places)) for i in (0, 1))
    if temperatures > 1 and 1 < speeds <= 4 and temperatures * speeds == len(places):
        return temperatures, speeds
    columns = math.ceil(math.sqrt(len(places)))
    return math.ceil(len(places) / columns), columns


def draw_panel(axes: Any, solution: TwoDiskSolution, curves: list[Curve]) -> None:
    slide = np.asarray(solution.operation.slide_to_roll)
    order = np.argsort(slide, kind="stable")
    axes.axhline(0.0, color=INK, linewidth=0.6)
    if slide.min() < 0.0 < slide.max():
        axes.axvline(0.0, color=INK, linewidth=0.6)
    elif slide.min() != slide.max():
        axes.set_xlim(100.0 * min(0.0, slide.min() * 1.02), 100.0 * max(0.0, slide.max() * 1.02))
    for number, curve in enumerate(curves):
        axes.plot(
            100.0 * slide[order],
            curve.of(solution.traction_coefficient)[order],
            color=COLOURS[number % len(COLOURS)],
            linestyle=("-", "--", ":", "-.")[number // len(COLOURS) % 4],
            marker=_MARKERS[number % len(_MARKERS)] if slide.size <= _MARKED else None,
            markersize=3.0,
            linewidth=1.3,
            label=curve_name(solution, curve),
        )
    speed_unit, factor = axis_unit("m/s", curves[0].entrainment_speed)
    temperature = f"{curves[0].temperature - ZERO_CELSIUS:.5g} °C"
    title_of(axes, f"{temperature}, {factor * curves[0].entrainment_speed:.5g} {speed_unit}")
    grid_lines(axes)


def curve_name(solution: TwoDiskSolution, curve: Curve) -> str:
    """Quantity in which the curves of a panel differ: pressure, or load."""
    unit, factor = axis_unit("Pa", curve.pressure)
    if solution.operation.pressure is not None:
        return f"{factor * curve.pressure:.4g} {unit}"
    load_unit, load_factor = axis_unit("N", curve.load)
    return f"{load_factor * curve.load:.4g} {load_unit} ({factor * curve.pressure:.3g} {unit})"
