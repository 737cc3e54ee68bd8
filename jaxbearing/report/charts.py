"""Interactive charts of a page: plotly figures in one style, and what a page needs to show them without a network."""

import functools
import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from .sheet import INK

_GRID, _FRAME = "#E4E4E4", "#9A9A9A"


@dataclass(frozen=True)
class Chart:
    """A figure with its heading, a caption, and what is to be said of it to who cannot see it."""

    name: str
    title: str
    caption: str
    figure: Any
    height: int = 340

    def data(self) -> dict[str, Any]:
        """The figure as JSON has it; what is not finite is null."""
        return json.loads(self.figure.to_json(engine="json"))


def figure_of(*traces: Any, **layout: Any) -> Any:
    """A plotly figure in the style of the page."""
    import plotly.graph_objects as go

    axis = {"gridcolor": _GRID, "linecolor": _FRAME, "zeroline": False, "automargin": True, "ticks": "outside"}
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


def curve(x: Any, y: Any, name: str, colour: str, **style: Any) -> Any:
    """Points on a line; what is not finite is a gap."""
    import plotly.graph_objects as go

    values = [float(v) if np.isfinite(v) else None for v in np.asarray(y)]
    line = {"color": colour, "width": 1.8} | style.pop("line", {})
    return go.Scatter(x=np.asarray(x).tolist(), y=values, name=name, line=line, **({"mode": "lines"} | style))


@functools.cache
def library() -> str:
    """The code that draws the charts in a browser."""
    from plotly.offline import get_plotlyjs

    return get_plotlyjs()
