"""The figures of the power-loss study on one page: totals as lines, losses by location stacked."""

import math
from typing import Any

import numpy as np

from ..report.sheet import INK, axis_unit

_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#999999", "#F0E442")
"""Okabe and Ito's colours, which all kinds of colour vision tell apart."""
_MARKS = ("o", "s", "^", "D", "v")
_UNITS = {"rad/s": ("rpm", 30 / math.pi, 0.0), "m3/s": ("l/h", 3.6e6, 0.0), "K": ("°C", 1.0, -273.15)}
_UNITS |= {"rad": ("°", 180 / math.pi, 0.0)}


def study_page(study: Any, title: str) -> Any:
    """A matplotlib figure with all panels of a `PowerLossStudy`; cases that failed are gaps."""
    from matplotlib.figure import Figure

    count = len(study.panels)
    columns = 3
    rows = math.ceil(count / columns)
    figure = Figure(figsize=(14.0, 3.9 * rows), layout="constrained")
    shown = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, (name, panel) in zip(shown, study.panels.items(), strict=False):
        draw_panel(axes, name, panel)
    for axes in shown[count:]:
        axes.set_axis_off()
    gaps = f" - {study.failed} of {study.cases} cases did not converge (gaps)" if study.failed else ""
    figure.suptitle(f"Power loss: {title}{gaps}", color=INK, parse_math=False)
    return figure


def draw_panel(axes: Any, name: str, panel: Any) -> None:
    """One panel: lines of the total over two fields, or the losses by location over one."""
    fields = [path.replace(".", "_") for path in str(panel.attrs["sweep_fields"]).split()]
    x, label = _axis(panel[fields[0]])
    watts, factor = axis_unit("W", float(panel.power_loss_total.max()))
    if len(fields) == 1:
        _stack(axes, panel, x, factor)
    else:
        lines, second = _axis(panel[fields[1]])
        for i, value in enumerate(lines):
            total = factor * panel.power_loss_total.values[:, i]
            axes.plot(x, total, color=_COLOURS[i], marker=_MARKS[i], markersize=4, label=f"{value:.4g}")
        axes.legend(title=second, fontsize=7, title_fontsize=7)
    axes.set_xlabel(label)
    axes.set_ylabel(f"power loss [{watts}]")
    axes.set_ylim(bottom=0.0)
    axes.set_title(f"{name}: {str(panel.attrs['title']).removeprefix('Power loss ')}", fontsize=9)
    axes.grid(alpha=0.3)


def _stack(axes: Any, panel: Any, x: np.ndarray, factor: float) -> None:
    names = [str(n) for n in panel.data_vars if str(n).startswith("power_loss_") and n != "power_loss_total"]
    names = [n for n in names if bool(panel[n].notnull().any())]
    parts = [factor * panel[n].values for n in names]
    labels = [n.removeprefix("power_loss_").replace("_", " ") for n in names]
    axes.stackplot(x, *parts, labels=labels, colors=_COLOURS[: len(names)], alpha=0.85)
    axes.plot(x, factor * panel.power_loss_total.values, color=INK, marker="o", markersize=3, label="total")
    handles, texts = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], texts[::-1], fontsize=6, loc="best")


def _axis(variable: Any) -> tuple[np.ndarray, str]:
    """Values in engineer's units and the label of their axis."""
    values, unit = np.asarray(variable), str(variable.attrs.get("units", ""))
    if unit in _UNITS:
        unit, factor, offset = _UNITS[unit]
    else:
        (unit, factor), offset = axis_unit(unit, float(np.nanmax(np.abs(values)))), 0.0
    words = str(variable.name).split("_", 1)[1].replace("_", " ")
    return factor * values + offset, f"{words} [{unit}]" if unit not in ("", "1") else words
