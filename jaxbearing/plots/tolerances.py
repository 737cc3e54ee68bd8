"""Figure of tolerances: how results scatter, and which fields make them do so."""

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from ..report.backends.matplotlib.sheet import grid_lines
from ..report.colours import CURVES, FAINT, INK
from .frame import Axis, axis_for, write_below
from .style import COLOURS

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

_WIDTH, _ROW = 9.6, 2.35
"""Width of the figure and height of a result, inches."""
_MOST_FIELDS = 6
"""Fields of a tornado; the others are added up."""
_LETTERS = 110
"""Letters of a line of the title."""
_SPAN = 4.2
"""Standard deviations of the curve on either side."""


def tolerances(found: Any, results: "list[str] | None" = None, title: str = "") -> "matplotlib.figure.Figure":
    """Distribution of each result and the share of each field in it: on the left the normal curve of the delta method,
    its limits and, with samples, their histogram; on the right the fields in the order of their shares.

    **Arguments:**
    - `found`: from `jaxbearing.tolerances`.
    - `results`: names of the results that are drawn; all that scatter if not given.
    - `title`: at the head of the figure.

    **Raises:** `ValueError` for a name that is not among the results, and where nothing scatters.
    """
    from ..report.backends.matplotlib.page import Page

    names = (
        [name for name, own in found.results.items() if own.moves and own.deviation > 0.0]
        if results is None
        else list(results)
    )
    unknown = [name for name in names if name not in found.results]
    if unknown or not names:
        raise ValueError(f"results: found {unknown or 'none that scatters'}; expected some of {list(found.results)}")
    figure = Page(_WIDTH, _ROW * len(names) + 0.9)
    write_below(figure, _caption(found))
    figure.suptitle("\n".join(textwrap.wrap(title, _LETTERS)), fontsize=10, parse_math=False)
    grid = figure.add_gridspec(len(names), 2, width_ratios=(1.15, 1.0))
    for row, name in enumerate(names):
        spread = found.results[name]
        _distribution(figure.add_subplot(grid[row, 0]), name, spread, row == 0)
        _tornado(figure.add_subplot(grid[row, 1]), spread)
    return figure


def _caption(result: Any) -> str:
    text = "Curve: normal distribution of the delta method, with its limits at three standard deviations (dashed). "
    if result.samples is not None:
        text += f"Histogram: {result.samples.converged} random samples (seed {result.samples.seed}). "
        failed = result.samples.count - result.samples.converged
        text += f"{failed} samples failed and are left out. " if failed else ""
    return text + "Bars: standard deviation of the result that each field alone makes, and its share in the variance."


def _distribution(axes: "matplotlib.axes.Axes", name: str, spread: Any, legend: bool) -> None:
    x = np.linspace(spread.mean - _SPAN * spread.deviation, spread.mean + _SPAN * spread.deviation, 241)
    sampled = spread.sampled
    axis = axis_for(spread.unit, x if sampled is None else np.concatenate([x, sampled.values]))
    if sampled is not None and sampled.values.size > 1:
        axes.hist(axis.of(sampled.values), bins="auto", density=True, color="#BBD3E6", label="Monte Carlo")
    z = (x - spread.mean) / spread.deviation
    width = _scale(axis) * spread.deviation
    axes.plot(axis.of(x), np.exp(-0.5 * z * z) / (np.sqrt(2.0 * np.pi) * width), color=CURVES[1], label="delta method")
    for limit in (spread.low, spread.high):
        axes.axvline(float(axis.of(limit)), color=FAINT, linestyle="--", linewidth=0.9)
    axes.set_xlabel(axis.named(name.removeprefix("elements.")), fontsize=9)
    axes.set_yticks([])
    axes.set_ylim(bottom=0.0)
    grid_lines(axes)
    if legend:
        axes.legend(fontsize=8, frameon=False, loc="upper left")


def _scale(axis: Axis) -> float:
    """Factor from SI to the unit of an axis."""
    return float(axis.of(1.0)) - float(axis.of(0.0))


def _tornado(axes: "matplotlib.axes.Axes", spread: Any) -> None:
    shares = sorted(spread.contributions.items(), key=lambda item: -item[1])
    named, rest = shares[:_MOST_FIELDS], shares[_MOST_FIELDS:]
    if rest:
        named.append((f"{len(rest)} others", sum(share for _, share in rest)))
    axis = axis_for(spread.unit, [spread.deviation])
    # the share of a field of a posterior may be negative: its number says so, and it has no bar
    widths = [_scale(axis) * spread.deviation * np.sqrt(max(share, 0.0)) for _, share in named]
    places = np.arange(len(named))[::-1]
    axes.barh(places, 2.0 * np.asarray(widths), left=-np.asarray(widths), color=COLOURS[0], height=0.62)
    axes.axvline(0.0, color=INK, linewidth=0.8)
    reach = 1.12 * max(widths)
    for place, width, (_, share) in zip(places, widths, named, strict=True):
        axes.text(width + 0.03 * reach, place, f"{100.0 * share:.1f} %", fontsize=8, color=INK, va="center")
    axes.set_xlim(-reach, 1.25 * reach)
    axes.locator_params(axis="x", nbins=5)
    axes.set_yticks(places, [path for path, _ in named], fontsize=8)
    # a difference of temperatures has another unit than a temperature
    unit = "K" if spread.unit == "K" else axis.unit
    axes.set_xlabel(Axis(unit, axis.of).named("± standard deviation by each field"), fontsize=9)
    grid_lines(axes)
