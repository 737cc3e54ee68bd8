"""Pictures of the page, from the kept numbers: how far each comparison lies from its data, two of them over the speed,
and the predicted loss of `turbine_roller`."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from jaxbearing.report.backends.matplotlib.page import Page
from jaxbearing.report.backends.matplotlib.sheet import grid_lines
from jaxbearing.report.colours import CURVES, FAINT, INK
from jaxbearing.report.plots import save_plot

from .common import DOCS, Comparison, Found

OVERVIEW, PREDICTION = (DOCS / "pictures" / f"measurements_{name}.png" for name in ("overview", "prediction"))
TICKS = (0.5, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 1.75)


def draw(comparisons: Mapping[str, Comparison], kept: Mapping[str, Found]) -> None:
    """Writes both pictures."""
    save_plot(
        overview({one.quantity: (one, kept[name]) for name, one in comparisons.items() if name in kept}), OVERVIEW
    )
    if "turbine_roller" in kept:
        save_plot(prediction(kept["turbine_roller"]), PREDICTION)


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


def prediction(found: Found) -> Page:
    """Total loss of `turbine_roller` with its intervals of 90 %."""
    labels = [f"{row[0]}:\n{row[1]}" for row in found.rows]
    value, low, high = (np.array([float(row[place]) for row in found.rows]) for place in (4, 5, 6))
    figure = Page(9.6, 0.55 * len(labels) + 1.0)
    axes: Any = figure.add_axes((0.36, 0.62 / (0.55 * len(labels) + 1.0), 0.6, 1.0 - 0.85 / (0.55 * len(labels) + 1.0)))
    place = np.arange(len(labels))
    axes.errorbar(value, place, xerr=[value - low, high - value], fmt="o", color=CURVES[0], capsize=4, lw=1.6)
    for row, (middle, end) in enumerate(zip(value, high, strict=True)):
        axes.annotate(
            f"{middle:.0f} W", (end, row), xytext=(6, 0), textcoords="offset points", va="center", fontsize=8.5
        )
    axes.set_yticks(place, labels, fontsize=9)
    axes.set_ylim(len(labels) - 0.5, -0.5)
    axes.set_xlim(0.0, 1.15 * float(np.max(high)))
    axes.set_xlabel("total loss of turbine_roller, W; interval of 90 % from drag and supply alone", fontsize=9)
    axes.axvline(value[0], color=FAINT, linewidth=0.9, zorder=0)
    grid_lines(axes)
    return figure
