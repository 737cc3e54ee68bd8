"""Interactive charts of a bearing's steady solve: what `plots` draws on paper."""

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from ...bearings.solution import Solution
from ..charts import Chart, curve, figure_of
from ..display import digits, displayed
from ..sheet import axis_unit, log_ticks
from .plots import LOG_FROM, LOSS, ROUND, SIDES, power_losses

_SYMBOLS = {"s": "square", "o": "circle", "^": "triangle-up"}
_CAPTIONS = {
    "film": "At the middle of each contact.",
    "pressure": "Peak of the Hertz pressure of each contact.",
    "sliding": "Difference of the surface speeds of ring and rolling element.",
}


def bearing_charts(solution: Solution) -> list[Chart]:
    """Power loss by location, loads round the bearing, films, pressures and sliding; what the scene models of them."""
    losses = power_losses(solution)
    charts = [_losses(losses, float(solution.power_loss.total))] if losses else []
    charts.append(_loads(solution))
    for name in ROUND:
        values = _by_side(solution, name)
        if values:
            charts.append(_round(solution, name, values))
    return charts


def _losses(losses: dict[str, float], total: float) -> Chart:
    import plotly.graph_objects as go

    unit, factor = axis_unit("W", max(abs(watts) for watts in losses.values()))
    shown = [factor * watts for watts in losses.values()]
    share = [f"{100.0 * watts / total:.1f} %" if total else "-" for watts in losses.values()]
    names = [name.replace("_", " ") for name in losses]
    texts = [f"{digits(value)} {unit} · {part}" for value, part in zip(shown, share, strict=True)]
    bars = go.Bar(
        x=shown,
        y=names,
        orientation="h",
        text=texts,
        textposition="outside",
        cliponaxis=False,
        hovertemplate="%{y}: %{text}<extra></extra>",
        marker={"color": LOSS},
    )
    largest, lowest = max([0.0, *shown]), min([0.0, *shown])
    figure = figure_of(
        bars,
        xaxis={"title": f"power loss, {unit}", "range": [1.3 * lowest, 2.1 * largest if largest > 0.0 else 1.0]},
        yaxis={"autorange": "reversed", "ticks": "", "ticksuffix": " "},
        bargap=0.35,
        showlegend=False,
        margin={"t": 8},
    )
    caption = f"Dissipated at each place; together {digits(total)} W."
    return Chart("power", "Power loss by location", caption, figure, 110 + 38 * len(losses))


def _loads(solution: Solution) -> Chart:
    import plotly.graph_objects as go

    values = _by_side(solution, "load")
    unit, factor = axis_unit("N", max(float(np.max(load)) for load in values.values()))
    degrees = displayed(1.0, "rad") * np.asarray(solution.elements.azimuth)
    closed = np.append(degrees, degrees[0] + 360.0)
    traces = []
    for side, colour, marker, label in SIDES:
        if side not in values:
            continue
        load = factor * np.append(values[side], values[side][0])
        traces.append(
            go.Scatterpolar(
                theta=closed.tolist(),
                r=load.tolist(),
                name=label,
                mode="lines+markers",
                line={"color": colour, "width": 1.6},
                marker={"symbol": _SYMBOLS[marker], "size": 6},
                hovertemplate=f"{label} at %{{theta:.1f}}°: %{{r:.4g}} {unit}<extra></extra>",
            )
        )
    polar = {
        # azimuth 0, the load line, points down as in the drawing
        "angularaxis": {"rotation": 270, "direction": "counterclockwise", "gridcolor": "#DDDDDD", "dtick": 45},
        "radialaxis": {"gridcolor": "#DDDDDD", "angle": 67.5, "tickangle": 67.5, "rangemode": "tozero", "nticks": 5},
        "bgcolor": "#ffffff",
    }
    figure = figure_of(*traces, polar=polar, margin={"l": 46, "r": 46, "t": 54, "b": 30})
    name = solution.element_name
    first = float(np.degrees(np.asarray(solution.elements.azimuth)[0]))
    caption = f"Normal load of each {name} on its contacts; azimuth 0 is below, {name} 0 stands at {first:.4g}°."
    return Chart("load", f"Load on each {name}, {unit}", caption, figure, 400)


def _round(solution: Solution, name: str, values: dict[str, np.ndarray]) -> Chart:
    title, from_zero = ROUND[name]
    largest, smallest = (_extreme(values, pick) for pick in (np.max, np.min))
    metadata = {field.name: field.metadata for field in dataclasses.fields(solution.elements)}
    unit, factor = axis_unit(metadata[f"{name}_{next(iter(values))}"]["unit"], max(abs(largest), abs(smallest)))
    degrees = displayed(1.0, "rad") * np.asarray(solution.elements.azimuth)
    degrees = np.where(degrees > 180.0 + 1e-9, degrees - 360.0, degrees)
    order = np.argsort(degrees)
    traces = [
        curve(
            degrees[order],
            factor * values[side][order],
            label,
            colour,
            mode="lines+markers",
            marker={"symbol": _SYMBOLS[marker], "size": 6},
            hovertemplate=f"{label} at %{{x:.1f}}°: %{{y:.4g}} {unit}<extra></extra>",
        )
        for side, colour, marker, label in SIDES
        if side in values
    ]
    yaxis: dict[str, Any] = {"title": unit}
    if from_zero:
        yaxis["rangemode"] = "tozero"
    elif smallest > 0.0 and largest > LOG_FROM * smallest:
        low, high = 0.8 * factor * smallest, 1.25 * factor * largest
        ticks = log_ticks(low, high)
        yaxis |= {"type": "log", "range": [math.log10(low), math.log10(high)]}
        yaxis |= {"tickvals": ticks, "ticktext": [f"{tick:g}" for tick in ticks]}
    xaxis = {"title": "azimuth from the load line, deg", "tickvals": [-180, -90, 0, 90, 180], "range": [-188, 188]}
    figure = figure_of(*traces, xaxis=xaxis, yaxis=yaxis)
    return Chart(name, f"{title}, {unit}", _CAPTIONS[name], figure)


def _by_side(solution: Solution, name: str) -> dict[str, np.ndarray]:
    """Values of raceways and rib, as far as the scene models them and some contact has results."""
    found = {side: getattr(solution.elements, f"{name}_{side}", None) for side, *_ in SIDES}
    arrays = {side: np.asarray(value) for side, value in found.items() if value is not None}
    return {side: array for side, array in arrays.items() if np.any(np.isfinite(array))}


def _extreme(values: dict[str, np.ndarray], pick: Any) -> float:
    return float(pick(np.concatenate(list(_finite(values)))))


def _finite(values: dict[str, np.ndarray]) -> Iterator[np.ndarray]:
    for array in values.values():
        yield array[np.isfinite(array)]
