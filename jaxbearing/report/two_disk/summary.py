"""Summary of traction curves on the screen: a row for each curve, with its traction coefficient at some slide-to-roll
ratios. Narrow terminals show fewer ratios; if that is not enough, the table is split."""

import numpy as np
from rich.console import Console
from rich.padding import Padding
from rich.text import Text

from ...machines import TwoDiskSolution
from ...numerics.status import Status
from ..backends.screen import (
    column,
    counted,
    headline,
    print_failure,
    print_line,
    print_rule,
    print_table,
    print_warnings,
    shown_pieces,
    width,
)
from ..display import ZERO_CELSIUS, axis_unit, digits
from ..tables import derived_facts
from .curves import Curve, curves_of

ROWS = 60
"""Largest number of curves that are shown; the others are only counted."""
_SLIDES = 6
"""Largest number of slide-to-roll ratios that are shown."""
_FEWEST = 2
_SMALLEST_SHOWN = 1e-3
"""Smallest slide-to-roll ratio that is shown; below it, curves hardly differ."""


def print_summary(solution: TwoDiskSolution, scene_label: str, console: Console, full: bool = False) -> None:
    """Prints traction curves; see `report.summary.print_summary`. **Arguments:** `full`: all columns, assumptions."""
    if not bool(solution.converged):
        status = Status(int(np.max(np.asarray(solution.status)))).text
        print_failure(scene_label, status, solution.failure(), console)
        return
    curves = list(curves_of(solution))
    slide = np.asarray(solution.operation.slide_to_roll)
    state = f"{counted(len(curves), 'curve')} of {counted(slide.size, 'point')}, largest residual of nested solves "
    residual = float(np.max(np.asarray(solution.inner_residual)))
    headline(scene_label, "CONVERGED", "bold green", f"{state}{residual:.1e}", console)
    print_line("Slide-to-roll", f"{_percent(slide.min())} to {_percent(slide.max())} of the mean speed", console)
    name, values, unit = ("Load", solution.load, "N")
    if solution.operation.pressure is None:
        name, values, unit = ("Hertz pressure", solution.pressure, "Pa")
    print_line(name, _listed(np.asarray(values), unit), console)
    print_rule("Traction curves", console)
    _print_curves(solution, curves[:ROWS], console, full)
    if len(curves) > ROWS:
        print_line("", f"and {counted(len(curves) - ROWS, 'curve')} more: see --json or --out", console)
    for name, text in derived_facts(solution):
        print_line(name, text, console)
    print_warnings(solution.warnings, console, full)


def _print_curves(solution: TwoDiskSolution, curves: list[Curve], console: Console, full: bool) -> None:
    speeds = [curve.entrainment_speed for curve in curves]
    speed_unit, factor = axis_unit("m/s", max(speeds))
    first = {
        "T\ndegC": [f"{curve.temperature - ZERO_CELSIUS:.6g}" for curve in curves],
        f"u\n{speed_unit}": [f"{factor * speed:.5g}" for speed in speeds],
        "p0\nGPa": column(np.asarray([curve.pressure for curve in curves]), "Pa"),
    }
    state = _state(solution, curves)
    slides = _slides(np.asarray(solution.operation.slide_to_roll), _SLIDES)
    while len(slides) > _FEWEST and width(first | state | _friction(solution, curves, slides)) > console.width:
        slides = _slides(np.asarray(solution.operation.slide_to_roll), len(slides) - 1)
    columns = state | _friction(solution, curves, slides)
    for piece in shown_pieces(first, columns, console, full):
        print_table(piece, [0.0] * len(curves), 0, "", console)
    smallest = _percent(float(np.asarray(solution.operation.slide_to_roll)[curves[0].slowest]))
    shown = ["film h", "Deborah number D", *(["inlet rise"] if "inlet\nrise K" in state else [])]
    largest = "; film rise: the largest" if "film\nrise K" in state else ""
    text = f"Traction coefficient at the slide-to-roll ratios above; {', '.join(shown)} at {smallest}{largest}."
    console.print(Padding(Text(text, style="dim"), (0, 2)))


def _state(solution: TwoDiskSolution, curves: list[Curve]) -> dict[str, list[str]]:
    at_rest = lambda values: [float(curve.of(values)[curve.slowest]) for curve in curves]
    columns = {
        "h\num": column(np.asarray(at_rest(solution.film)), "m"),
        "D\n": [digits(value, 3) for value in at_rest(solution.deborah_number)],
    }
    fed = np.asarray([curve.temperature for curve in curves])
    rise = np.asarray(at_rest(solution.inlet_temperature)) - fed
    if np.any(rise != 0.0):
        columns["inlet\nrise K"] = [f"{value:.1f}" for value in rise]
    if solution.film_rise is not None:
        columns["film\nrise K"] = [f"{np.max(curve.of(solution.film_rise)):.1f}" for curve in curves]
    return columns


def _friction(solution: TwoDiskSolution, curves: list[Curve], slides: list[int]) -> dict[str, list[str]]:
    slide = np.asarray(solution.operation.slide_to_roll)
    return {
        f"at\n{_percent(slide[i])}": [f"{curve.of(solution.traction_coefficient)[i]:.4f}" for curve in curves]
        for i in slides
    }


def _slides(slide: np.ndarray, count: int) -> list[int]:
    """Indices of at most `count` slide-to-roll ratios, about evenly spaced in the logarithm from 0.1 % to the largest.

    Negative ratios are taken only if there are no positive ones.
    """
    candidates = np.flatnonzero(slide > 0.0)
    if candidates.size == 0:
        candidates = np.flatnonzero(slide < 0.0)
    if candidates.size == 0:
        return [0]
    size = np.log(np.abs(slide[candidates]))
    lowest = min(max(size.min(), np.log(_SMALLEST_SHOWN)), size.max())
    wanted = np.linspace(lowest, size.max(), count) if count > 1 else [size.max()]
    nearest = {int(candidates[np.argmin(np.abs(size - target))]) for target in wanted}
    return sorted(nearest, key=lambda i: abs(slide[i]))


def _percent(slide: float) -> str:
    return f"{100.0 * slide:.3g} %"


def _listed(values: np.ndarray, unit: str) -> str:
    name, factor = axis_unit(unit, float(values.max()))
    return f"{', '.join(digits(factor * float(value)) for value in values)} {name}"
