"""The figures of the power-loss study on one page: totals as curves, losses by location stacked."""

import math
import textwrap
from collections.abc import Collection
from typing import TYPE_CHECKING, Any

from ..plots import power_loss_against
from ..plots.sweeps import OPERATING_POINT, beside
from ..report.backends.matplotlib.sheet import head, title_of
from ..report.colours import INK
from .panels import own
from .power_loss import PowerLossStudy

if TYPE_CHECKING:
    import matplotlib.artist
    import matplotlib.figure
    import xarray as xr

_MOST_COLUMNS = 4
_HEAD, _FOOT, _GROUP, _ROW = 0.85, 0.45, 0.4, 2.75
"""Heights of head and foot of the page, of the heading of a group of panels, and of a row of panels, inches."""
_LEFT, _TOP, _BELOW, _TITLE = 0.75, 0.75, 1.05, 0.4
"""Margins of a group, and the gap below its panels with the part of the titles in it, inches."""
_STRIP = 0.35
"""Height of a legend below the panels, inches."""
_BESIDE = {1: (0.7, 0.2), 2: (1.85, 1.2)}
"""Gap between panels, and the right margin, inches: those of two fields have a legend each."""
_LETTERS = 13.0
"""Letters of a panel's title in an inch."""
_GROUPS = {1: "Power loss by location", 2: "Total power loss"}
"""Heading of the panels of one field and of two fields."""


def study_page(study: PowerLossStudy, title: str) -> "matplotlib.figure.Figure":
    """Page with the panels of a study; cases that failed are gaps. No cell of it is empty: the legend stands in the one
    that the panels leave, or below them."""
    from ..report.backends.matplotlib.page import WIDTH, Page

    groups = {count: _panels_over(study, count) for count in sorted(_GROUPS, reverse=True)}
    groups = {count: panels for count, panels in groups.items() if panels}
    shapes = {count: _shape(len(panels), legend=count == 1) for count, panels in groups.items()}
    strips = {count: _strip(len(panels), shapes[count], count == 1) for count, panels in groups.items()}
    heights = [_GROUP + _ROW * rows + strips[count] for count, (rows, _) in shapes.items()]
    page = Page(WIDTH, _HEAD + sum(heights) + _FOOT)
    cells = page.subfigures(len(heights) + 2, 1, squeeze=False, height_ratios=[_HEAD, *heights, _FOOT])
    upper, *parts, lower = cells[:, 0]
    gaps = f", {study.failed} of them without a result (gaps)" if study.failed else ""
    head(upper, f"Power loss: {title}", f"{study.cases} cases{gaps}")
    for part, (count, panels) in zip(parts, groups.items(), strict=True):
        part.suptitle(_GROUPS[count], x=0.03, ha="left", fontsize=11.5, fontweight="bold", color=INK)
        _draw(part, panels, shapes[count], strips[count], study)
    text = f"The panels in their order have the fields of the source's Figures {', '.join(study.panels)}."
    lower.text(0.03, 0.4, text, fontsize=8, color=INK, va="center")
    return page


def _panels_over(study: PowerLossStudy, count: int) -> "dict[str, xr.Dataset]":
    """Panels over so many fields."""
    return {name: panel for name, panel in study.panels.items() if len(_fields(panel)) == count}


def _fields(panel: "xr.Dataset") -> list[str]:
    return str(panel.attrs["sweep_fields"]).split()


def _shape(panels: int, legend: bool) -> tuple[int, int]:
    """Rows and columns of the cells: with one more cell for a `legend` if that fills the grid, otherwise without."""
    for cells in (panels + legend, panels):
        rows = math.ceil(cells / _MOST_COLUMNS)
        if cells % rows == 0:
            return rows, cells // rows
    cells = panels + legend
    return math.ceil(cells / _MOST_COLUMNS), _MOST_COLUMNS


def _strip(panels: int, shape: tuple[int, int], legend: bool) -> float:
    """Height below the panels, inches, for a legend that no cell is left for."""
    return _STRIP if legend and panels == math.prod(shape) else 0.0


def _draw(
    part: Any,
    panels: "dict[str, xr.Dataset]",
    shape: tuple[int, int],
    strip: float,
    study: PowerLossStudy,
) -> None:
    """Draws the panels of a group; the cell that they leave, or the strip below them, holds the legend of what is
    stacked in all of them. **Arguments:** `strip`: its height, inches."""
    rows, columns = shape
    width, height = part.bbox.width / part.figure.dpi, part.bbox.height / part.figure.dpi
    gap, right = _BESIDE[len(_fields(next(iter(panels.values()))))]
    places = {"left": _LEFT / width, "right": 1.0 - right / width, "top": 1.0 - _TOP / height}
    across, along = (width - _LEFT - right - (columns - 1) * gap) / columns, _ROW - _BELOW
    space = {"bottom": (_BELOW - _TITLE + strip) / height, "wspace": gap / across, "hspace": _BELOW / along}
    grid = part.add_gridspec(rows, columns, **places, **space)
    stacked: dict[str, matplotlib.artist.Artist] = {}
    for number, panel in enumerate(panels.values()):
        axes = part.add_subplot(grid[divmod(number, columns)])
        fields = _fields(panel)
        point = {field: value for field in fields if (value := own(study.scene, field)) is not None}
        power_loss_against(panel, fields[0], axes=axes, legend=False, operating_point=point)
        if axes.get_xscale() == "linear":
            axes.locator_params(axis="x", nbins=5)
        title_of(axes, "\n".join(textwrap.wrap(_title(panel), int(_LETTERS * across))), size=9.5)
        entries = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
        if len(fields) == 1:
            stacked |= entries
        else:
            # the line of the operating point is named in the other legend
            entries.pop(OPERATING_POINT, None)
            name = str(panel[fields[1].replace(".", "_")].attrs["long_name"])
            beside(axes, list(entries.values()), list(entries), title=name)
    if stacked:
        names = _legend_order(stacked, panels)
        cells = grid[rows - 1, len(panels) - columns * (rows - 1) :].get_position(part) if not strip else None
        middle = (0.5, 0.5 * strip / height) if cells is None else (cells.p0 + cells.p1) / 2.0
        style = {"loc": "center", "bbox_to_anchor": middle, "fontsize": 9, "frameon": False}
        part.legend([stacked[name] for name in names], names, ncols=len(names) if strip else 1, **style)


def _title(panel: "xr.Dataset") -> str:
    """Title of a panel, without what the heading of its group says."""
    words = str(panel.attrs["title"])
    for prefix in ("Power loss ", "by location ", "total "):
        words = words.removeprefix(prefix)
    return words[:1].upper() + words[1:]


def _legend_order(stacked: Collection[str], panels: "dict[str, xr.Dataset]") -> list[str]:
    """Names of the legend in the order of a stack, from above; the lines come first."""
    drawn = next(iter(panels.values())).data_vars
    locations = [str(name).removeprefix("power_loss_").replace("_", " ") for name in drawn][::-1]
    first = [OPERATING_POINT, "total"]
    rest = [name for name in stacked if name not in (*first, *locations)]
    return [name for name in dict.fromkeys([*first, *rest, *locations]) if name in stacked]
