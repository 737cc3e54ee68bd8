"""The figures of the power-loss study on one page: totals as lines, losses by location stacked."""

import math
from typing import TYPE_CHECKING, Any

from ..plots import power_loss_against
from ..report.colours import INK
from .power_loss import PowerLossStudy

if TYPE_CHECKING:
    import matplotlib.figure

_COLUMNS = 3


def study_page(study: PowerLossStudy, title: str) -> "matplotlib.figure.Figure":
    """Page with the panels of a study; cases that failed are gaps."""
    from matplotlib.figure import Figure

    rows = math.ceil(len(study.panels) / _COLUMNS)
    figure = Figure(figsize=(16.0, 4.0 * rows), facecolor="white", layout="constrained")
    locations: dict[str, Any] = {}
    shown = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for axes, (name, panel) in zip(shown, study.panels.items(), strict=False):
        fields = str(panel.attrs["sweep_fields"]).split()
        power_loss_against(panel, fields[0], axes=axes, legend=False)
        if len(fields) == 1:
            handles, labels = axes.get_legend_handles_labels()
            locations |= dict(zip(labels, handles, strict=True))
        axes.set_title(f"{name}: {str(panel.attrs['title']).removeprefix('Power loss ')}", fontsize=9)
    for axes in shown[len(study.panels) :]:
        axes.set_axis_off()
    figure.legend(list(locations.values()), list(locations), loc="outside lower center", ncols=9, frameon=False)
    gaps = f" - {study.failed} of {study.cases} cases did not converge (gaps)" if study.failed else ""
    figure.suptitle(f"Power loss: {title}{gaps}", color=INK, parse_math=False)
    return figure
