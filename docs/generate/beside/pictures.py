"""Picture of the page, from the kept numbers: how far each comparison lies from its data."""

from collections.abc import Mapping

import numpy as np

from jaxbearing.report.backends.matplotlib.page import Page
from jaxbearing.report.backends.matplotlib.sheet import grid_lines
from jaxbearing.report.colours import CURVES, INK
from jaxbearing.report.plots import save_plot

from .common import DOCS, Comparison, Found

OVERVIEW = DOCS / "pictures" / "measurements_overview.png"
TICKS = (0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75)


def draw(comparisons: Mapping[str, Comparison], kept: Mapping[str, Found]) -> None:
    """Writes it."""
    shown = {one.quantity: (one, kept[name]) for name, one in comparisons.items() if name in kept}
    save_plot(overview(shown), OVERVIEW)


def overview(found: Mapping[str, tuple[Comparison, Found]]) -> Page:
    """Model over data of all comparisons with deviations: each value, and the band of the verdict."""
    shown = {name: pair for name, pair in found.items() if pair[1].deviations}
    figure = Page(9.6, 0.36 * len(shown) + 1.1)
    axes = figure.add_axes((0.42, 0.72 / (0.36 * len(shown) + 1.1), 0.55, 1.0 - 1.05 / (0.36 * len(shown) + 1.1)))
    for row, (one, result) in enumerate(shown.values()):
        values = 1.0 + np.array(list(result.deviations.values()))
        band = 0.01 * (one.believe or 0.0)
        # a verdict on the high or low side has half a band
        low, high = (0.0 if np.all(sign * (values - 1.0) < 0.0) else band for sign in (-1.0, 1.0))
        axes.barh(row, low + high, left=1.0 - low, height=0.62, color=CURVES[0], alpha=0.18, linewidth=0.0)
        axes.plot(values, np.full(len(values), row), "o", color=CURVES[0], ms=4.0, alpha=0.75)
    axes.axvline(1.0, color=INK, linewidth=0.9)
    axes.set_xscale("log")
    axes.set_xlim(0.45, 1.9)
    axes.set_xticks(TICKS, [f"{one:g}" for one in TICKS])
    axes.minorticks_off()
    axes.set_yticks(range(len(shown)), list(shown), fontsize=9)
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("model over measurement or print; band: within the per cent of the verdict", fontsize=9)
    grid_lines(axes)
    return figure
