"""A page that shows a fit: measured and fitted curves, and their differences."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from jaxbearing.report.backends.matplotlib.sheet import foot, grid_lines, head, title_of
from jaxbearing.report.colours import FAINT, INK
from jaxbearing.report.display import ZERO_CELSIUS, axis_unit, digits

from ..result import CurveFit, FitResult
from .smooth import smooth_curves
from .words import SYMBOL, parameter_text, percent

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import matplotlib.typing

NAMED = 12
"""Largest number of curves that each have their own colour and name."""
DRAWN = 48
"""Largest number of fitted curves that are drawn; of more curves, this many are selected evenly."""
LOGARITHMIC = 6.0
"""Largest over median slide-to-roll ratio above which the axis is logarithmic."""
# Okabe and Ito's colours, which all kinds of colour vision tell apart
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
_MARKERS = "osD^v"
_LINES = ("-", "--", ":", "-.")
_OUTLIER, _OUTLIERS = "#B00020", "outlier (beyond 4 sigma)"
"""Colour and name of outliers."""
_LEVELS = 6
"""Number of colours that the legend names where there are many curves."""


class _Look(NamedTuple):
    """Style of a drawn curve; `label` is empty if the legend does not name it."""

    colour: "matplotlib.typing.ColorType"
    marker: str
    label: str
    line: Any = "-"


def plot_fit(result: FitResult, data: str, scene: str, notes: Sequence[str] = ()) -> "matplotlib.figure.Figure":
    """A page with the curves and with the residuals over the slide-to-roll ratio.

    **Arguments:**
    - `data`, `scene`: names of the file and of the scene.
    - `notes`: of the file and the scene; those of the fit stand before them at the foot of the page.

    **Raises:** `ValueError` for a fit that did not converge.
    """
    if not (result.converged or result.undetermined):
        raise ValueError(f"a fit that failed has no results: {result.failure()}")
    from jaxbearing.report.backends.matplotlib.page import Page

    figure = Page()
    head(figure, data, f"{scene}   ·   {result.model}   ·   rms of the differences {digits(result.rms, 3)}")
    # notes on undetermined parameters come last: the list of parameters already marks these as held
    fit_notes = sorted(result.notes, key=lambda note: "cannot be determined" in note)
    bottom = 0.095 + 0.019 * foot(figure, [*fit_notes, *notes])
    places = {"left": 0.075, "right": 0.72, "top": 0.86, "bottom": bottom}
    grid = figure.add_gridspec(2, 1, **places, height_ratios=(2.3, 1.0), hspace=0.2)
    upper = figure.add_subplot(grid[0])
    lower = figure.add_subplot(grid[1], sharex=upper)
    looks = _looks(result)
    logarithmic = _axis(result, upper)
    _draw_curves(result, looks, logarithmic, upper)
    _draw_residuals(result, looks, lower)
    upper.tick_params(labelbottom=False)
    _draw_legend(figure, upper, result, looks)
    _write_parameters(figure, result, bottom)
    return figure


def _axis(result: FitResult, axes: "matplotlib.axes.Axes") -> bool:
    """Chooses the axis of the slide-to-roll ratio, in per cent; returns whether it is logarithmic."""
    slide = 100.0 * np.asarray(result.measurements.slide_to_roll)
    size = np.abs(slide[slide != 0.0])
    logarithmic = bool(size.size) and float(size.max()) > LOGARITHMIC * float(np.median(size))
    if not logarithmic:
        low, high = min(0.0, float(slide.min())), max(0.0, float(slide.max()))
        margin = 0.03 * (high - low)
        axes.set_xlim(low - (margin if low < 0.0 else 0.3 * margin), high + (margin if high > 0.0 else 0.3 * margin))
        return False
    if slide.min() > 0.0:
        axes.set_xscale("log")
        axes.set_xlim(size.min() / 1.3, size.max() * 1.3)
    else:
        least = 10.0 ** np.floor(np.log10(np.percentile(size, 5.0)))
        axes.set_xscale("symlog", linthresh=least, linscale=0.3)
        ends = (float(slide.min()), float(slide.max()))
        axes.set_xlim(1.3 * ends[0] if ends[0] < 0.0 else -0.3 * least, 1.3 * ends[1] if ends[1] > 0 else 0.3 * least)
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    return True


def _draw_curves(result: FitResult, looks: list[_Look], logarithmic: bool, axes: "matplotlib.axes.Axes") -> None:
    measured = result.measurements
    slide, coefficient = 100.0 * np.asarray(measured.slide_to_roll), np.asarray(measured.traction_coefficient)
    axes.axhline(0.0, color=INK, linewidth=0.6)
    size, faded = _size(len(coefficient))
    for number, look in enumerate(looks):
        points = measured.in_curve(number)
        style = {"color": look.colour, "markersize": size, "alpha": faded, "linestyle": "none"}
        axes.plot(slide[points], coefficient[points], marker=look.marker, label=look.label, **style)
    _mark_outliers(result, slide, coefficient, axes)
    shown = np.unique(np.linspace(0, len(looks) - 1, min(len(looks), DRAWN)).round().astype(int)).tolist()
    for number, curve in zip(shown, smooth_curves(result, shown, logarithmic), strict=True):
        look = looks[number]
        style = {"color": look.colour, "linestyle": look.line, "linewidth": 1.4 if len(shown) <= NAMED else 0.8}
        axes.plot(100.0 * curve.slide_to_roll, curve.traction_coefficient, **style)
    axes.set_ylabel("traction coefficient", fontsize=9)
    title_of(axes, "Measured points and fitted curves")
    grid_lines(axes)


def _draw_residuals(result: FitResult, looks: list[_Look], axes: "matplotlib.axes.Axes") -> None:
    measured = result.measurements
    slide = 100.0 * np.asarray(measured.slide_to_roll)
    difference = result.predicted - np.asarray(measured.traction_coefficient)
    axes.axhline(0.0, color=INK, linewidth=0.6)
    size, faded = _size(len(difference))
    for number, look in enumerate(looks):
        points = measured.in_curve(number)
        style = {"color": look.colour, "markersize": size, "alpha": faded, "linestyle": "none"}
        axes.plot(slide[points], difference[points], marker=look.marker, **style)
    _mark_outliers(result, slide, difference, axes)
    axes.set_xlabel("slide-to-roll ratio, %", fontsize=9)
    axes.set_ylabel("fitted - measured", fontsize=9)
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 3), useMathText=True)
    axes.yaxis.get_offset_text().set_fontsize(8.5)
    title_of(axes, "Differences")
    grid_lines(axes)


def _mark_outliers(result: FitResult, slide: np.ndarray, values: np.ndarray, axes: "matplotlib.axes.Axes") -> None:
    if not np.any(result.outlier):
        return
    style = {"marker": "x", "color": _OUTLIER, "linestyle": "none", "markersize": 7, "markeredgewidth": 1.3}
    axes.plot(slide[result.outlier], values[result.outlier], label=_OUTLIERS, **style)


def _size(points: int) -> tuple[float, float]:
    """Size and opacity of the markers of this number of points."""
    return (4.5, 0.9) if points <= 200 else (3.0, 0.6) if points <= 1000 else (2.0, 0.35)


def _looks(result: FitResult) -> list[_Look]:
    curves = result.curves
    varied = [condition for condition in _CONDITIONS if _varies(curves, condition)]
    if len(curves) <= NAMED:
        names = [", ".join(c.text(curve) for c in varied) for curve in curves]
        if len(set(names)) < len(names):
            # the conditions do not tell them apart
            pairs = zip(curves, names, strict=True)
            names = [f"{curve.name}, {name}" if name else f"curve {curve.name}" for curve, name in pairs]
        if len(curves) == 1:
            names = ["the curve"]
        colours = [_COLOURS[n % len(_COLOURS)] for n in range(len(curves))]
        return [_Look(colours[n], _MARKERS[n % len(_MARKERS)], name) for n, name in enumerate(names)]
    if not varied:
        return [_Look(_COLOURS[0], "o", f"{len(curves)} curves" if n == 0 else "") for n in range(len(curves))]
    return _by_colour(curves, varied[0], varied[1] if len(varied) > 1 else None)


def _by_colour(curves: Sequence[CurveFit], condition: "_Condition", second: "_Condition | None") -> list[_Look]:
    """Styles of many curves: a colour scale over the first condition, some of whose colours the legend names; and, if
    the second condition has few values, a marker and a line for each of them, all named."""
    from matplotlib import colormaps

    values = np.asarray([condition.value(curve) for curve in curves])
    part = (values - values.min()) / (values.max() - values.min())
    wanted = np.linspace(0.0, 1.0, _LEVELS)
    named = {int(np.argmin(np.abs(part - target))) for target in wanted}
    # the ends of the map are too light on white
    colour = lambda p: colormaps["viridis"](0.88 * float(p))
    texts = ["" if second is None else second.text(curve) for curve in curves]
    levels = list(dict.fromkeys(texts))
    levels = levels if len(levels) <= len(_LINES) else []
    looks = []
    for n, (p, curve) in enumerate(zip(part, curves, strict=True)):
        level = levels.index(texts[n]) if levels else 0
        label = condition.text(curve) if n in named else ""
        looks.append(_Look(colour(p), _MARKERS[level], label, _LINES[level]))
    return looks


class _Condition(NamedTuple):
    """A test condition: its field in `CurveFit`, the unit of display, factor and zero of the conversion to it, and the
    span `same` up to which the condition counts as constant."""

    field: str
    unit: str
    factor: float
    zero: float
    same: float
    """Relative span, or for temperatures a span in K."""

    def value(self, curve: CurveFit) -> float:
        return self.factor * getattr(curve, self.field) - self.zero

    def text(self, curve: CurveFit) -> str:
        value = self.value(curve)
        if self.unit == "m/s":
            unit, factor = axis_unit("m/s", value)
            return f"{digits(factor * value, 3)} {unit}"
        return f"{digits(value, 3)} {self.unit}"


_CONDITIONS = (
    _Condition("temperature", "°C", 1.0, ZERO_CELSIUS, 1.5),
    _Condition("pressure", "GPa", 1e-9, 0.0, 0.015),
    _Condition("entrainment_speed", "m/s", 1.0, 0.0, 0.015),
)


def _varies(curves: Sequence[CurveFit], condition: _Condition) -> bool:
    values = [condition.value(curve) for curve in curves]
    limit = condition.same * (1.0 if condition.zero else max(abs(value) for value in values))
    return max(values) - min(values) > limit


def _draw_legend(figure: Any, axes: "matplotlib.axes.Axes", result: FitResult, looks: list[_Look]) -> None:
    """Draws the legend beside the diagrams: how points and lines differ, what all curves have in common, and the curves
    with their points and lines."""
    from matplotlib.lines import Line2D

    varied = [condition for condition in _CONDITIONS if _varies(result.curves, condition)]
    common = [condition.text(result.curves[0]) for condition in _CONDITIONS if condition not in varied]
    # a marker is a measured point, and a line the fitted curve
    entries = {look.label: Line2D([], [], color=look.colour, marker=look.marker, linestyle=look.line) for look in looks}
    entries.pop("", None)
    if len({look.line for look in looks}) > 1:
        for look, curve in zip(looks, result.curves, strict=True):
            name = varied[1].text(curve)
            entries.setdefault(name, Line2D([], [], color=FAINT, marker=look.marker, linestyle=look.line))
    entries |= {name: line for line, name in zip(*axes.get_legend_handles_labels(), strict=True) if name == _OUTLIERS}
    figure.text(0.74, 0.845, "Points: measured. Lines: fitted.", fontsize=9.5, fontweight="bold", color=INK)
    legend = figure.legend(
        list(entries.values()),
        list(entries),
        loc="upper left",
        bbox_to_anchor=(0.73, 0.84),
        fontsize=9,
        frameon=False,
        title=", ".join(common),
        title_fontsize=9,
        alignment="left",
        handlelength=2.6,
    )
    for handle in legend.legend_handles:
        handle.set_alpha(1.0)
        handle.set_markersize(5.0)


def _write_parameters(figure: "matplotlib.figure.Figure", result: FitResult, bottom: float) -> None:
    """The fitted parameters beside the diagrams."""
    figure.text(0.74, bottom + 0.25, f"Rheology, {percent(result.level)} intervals", fontsize=9.5, fontweight="bold")
    for row, (name, parameter) in enumerate(result.parameters.items()):
        text = parameter_text(name, parameter)
        y = bottom + 0.222 - 0.038 * row
        figure.text(0.74, y, SYMBOL[name], fontsize=9, color=INK)
        figure.text(0.81, y, f"{text.value} {text.unit}", fontsize=9, color=INK if text.interval else FAINT)
        small = text.interval or ("held" if parameter.fixed else "no interval")
        figure.text(0.81, y - 0.0165, small, fontsize=8, color=INK)
