"""Panels of curves as interactive charts of an HTML page: plotly figures in one style, and the code that shows them
without a network."""

import functools
import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..colours import FAINT, GRID, INK
from ..display import displayed
from ..panels import Axis, Curves, Polar, Series, headed

if TYPE_CHECKING:
    import plotly.graph_objects as go

_POLAR_GRID = "#DDDDDD"


@dataclass(frozen=True)
class Chart:
    """A plotly figure with its name, title, caption and height in pixels. Screen readers read the title and the
    caption."""

    name: str
    title: str
    caption: str
    figure: Any
    height: int = 340

    def data(self) -> dict[str, Any]:
        """The figure as JSON values; numbers that are not finite become null."""
        return json.loads(self.figure.to_json(engine="json"))


def chart_of(panel: Polar | Curves) -> Chart:
    """The panel as a chart."""
    match panel:
        case Polar():
            return Chart(panel.name, headed(panel), panel.caption, _polar(panel), 400)
        case Curves():
            return Chart(panel.name, headed(panel), panel.caption, _curves(panel))


def _figure(*traces: object, **layout: Any) -> "go.Figure":
    """A plotly figure in the style of the page."""
    import plotly.graph_objects as go

    axis = {"gridcolor": GRID, "linecolor": FAINT, "zeroline": False, "automargin": True, "ticks": "outside"}
    style = {
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": INK},
        "paper_bgcolor": "#ffffff",
        "plot_bgcolor": "#ffffff",
        "margin": {"l": 50, "r": 12, "t": 30, "b": 44},
        "legend": {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom"},
        "showlegend": True,
        "hovermode": "closest",
        "xaxis": axis,
        "yaxis": axis,
        "template": "none",
    }
    figure = go.Figure(list(traces), layout=style)
    figure.update_layout(**layout)
    return figure


def _polar(panel: Polar) -> "go.Figure":
    import plotly.graph_objects as go

    traces = []
    for curve in panel.series:
        degrees = displayed(1.0, "rad") * np.asarray(curve.x)
        traces.append(
            go.Scatterpolar(
                theta=np.append(degrees, degrees[0] + 360.0).tolist(),
                r=np.append(curve.y, curve.y[0]).tolist(),
                name=curve.name,
                mode="lines+markers" if curve.marker else "lines",
                line={"color": curve.colour, "width": 1.6} | ({} if curve.dash == "solid" else {"dash": curve.dash}),
                marker={"symbol": curve.marker, "size": 6} if curve.marker else None,
                hovertemplate=f"{curve.name} at %{{theta:.1f}}°: %{{r:.4g}} {panel.unit}<extra></extra>",
            )
        )
    polar = {
        # azimuth 0, the load line, points down as in the drawing
        "angularaxis": {"rotation": 270, "direction": "counterclockwise", "gridcolor": _POLAR_GRID, "dtick": 45},
        "radialaxis": {"gridcolor": _POLAR_GRID, "angle": 67.5, "tickangle": 67.5, "rangemode": "tozero", "nticks": 5},
        "bgcolor": "#ffffff",
    }
    legend = {"y": 1.1}
    return _figure(*traces, polar=polar, legend=legend, margin={"l": 46, "r": 46, "t": 66, "b": 30})


def _curves(panel: Curves) -> "go.Figure":
    traces = [_curve(curve, panel) for curve in panel.series]
    return _figure(*traces, xaxis=_axis(panel.x, ""), yaxis=_axis(panel.y, panel.unit))


def _curve(curve: Series, panel: Curves) -> "go.Scatter":
    import plotly.graph_objects as go

    line = {"color": curve.colour, "width": 1.4 if curve.faint else 1.8}
    if curve.dash != "solid":
        line["dash"] = curve.dash
    style: dict[str, Any] = {"mode": "lines"}
    if panel.of_elements:
        hover = f"{curve.name} at %{{x:.1f}}°: %{{y:.4g}} {panel.unit}<extra></extra>"
        style = {"mode": "lines+markers", "marker": {"symbol": curve.marker, "size": 6}, "hovertemplate": hover}
    values = [float(value) if np.isfinite(value) else None for value in np.asarray(curve.y)]
    return go.Scatter(x=np.asarray(curve.x).tolist(), y=values, name=curve.name, line=line, **style)


def _axis(axis: Axis, unit: str) -> dict[str, Any]:
    layout: dict[str, Any] = {"title": {"text": axis.title or unit, "font": {"size": 13}}}
    if axis.ticks:
        layout["tickvals"] = list(axis.ticks)
    if axis.from_zero:
        layout["rangemode"] = "tozero"
    if axis.logarithmic:
        layout |= {"type": "log", "ticktext": [f"{tick:g}" for tick in axis.ticks]}
    if axis.limits is not None:
        layout["range"] = [math.log10(end) for end in axis.limits] if axis.logarithmic else list(axis.limits)
    return layout


@functools.cache
def library() -> str:
    """The JavaScript library that draws the charts in a browser."""
    from plotly.offline import get_plotlyjs

    return get_plotlyjs()
