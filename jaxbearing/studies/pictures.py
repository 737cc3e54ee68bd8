"""The figures of the power-loss study on one page: totals as lines, losses by location stacked."""

import math
from typing import TYPE_CHECKING

from ..plots import power_loss_against
from ..report.sheet import INK
from .power_loss import PowerLossStudy

if TYPE_CHECKING:
    import matplotlib.figure

_COLUMNS = 3


def study_page(study: PowerLossStudy, title: str) -> "matplotlib.figure.Figure":
    """All panels of a study; cases that failed are gaps."""
    from matplotlib.figure import Figure

    rows = math.ceil(len(study.panels) / _COLUMNS)
    figure = Figure(figsize=(15.0, 4.2 * rows), facecolor="white", layout="constrained")
    shown = figure.subplots(rows, _COLUMNS, squeeze=False).ravel()
    for axes, (name, panel) in zip(shown, study.panels.items(), strict=False):
        power_loss_against(panel, str(panel.attrs["sweep_fields"]).split()[0], axes=axes)
        axes.set_title(f"{name}: {str(panel.attrs['title']).removeprefix('Power loss ')}", fontsize=9)
    for axes in shown[len(study.panels) :]:
        axes.set_axis_off()
    gaps = f" - {study.failed} of {study.cases} cases did not converge (gaps)" if study.failed else ""
    figure.suptitle(f"Power loss: {title}{gaps}", color=INK, parse_math=False)
    return figure
