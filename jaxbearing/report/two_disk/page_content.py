"""Content of the report page of a two-disk machine: its traction curves."""

import numpy as np

from ...machines import TwoDiskSolution
from ..charts import Chart, curve, figure_of
from ..display import ZERO_CELSIUS, digits
from ..page_content import Content
from ..sheet import axis_unit
from .curves import Curve, curves_of
from .plots import COLOURS, curve_name

_DASHES = ("solid", "dash", "dot", "dashdot")


def two_disk_content(solution: TwoDiskSolution) -> Content:
    """See `report.html_report.html_report`."""
    curves = list(curves_of(solution))
    places = dict.fromkeys(one.place[:2] for one in curves)
    panels = [[one for one in curves if one.place[:2] == place] for place in places]
    slide = np.asarray(solution.operation.slide_to_roll)
    return Content(
        kind="two-disk machine",
        operation=f"slide-to-roll ratio {100 * slide.min():.4g} to {100 * slide.max():.4g} %",
        facts=[(_operating_point(solution, one), _largest(solution, one)) for one in curves],
        facts_title="Largest traction of each curve",
        charts=[_panel(solution, panel, i) for i, panel in enumerate(panels)],
        convergence=[
            ("status", "converged"),
            ("points", str(np.asarray(solution.status).size)),
            ("largest residual of nested solves", f"{float(np.max(np.asarray(solution.inner_residual))):.1e}"),
        ],
        checks=[(text, bool(broken)) for text, broken in solution.range_checks.items()],
        notes=solution.notes,
    )


def _panel(solution: TwoDiskSolution, curves: list[Curve], number: int) -> Chart:
    """All pressures at one temperature and speed."""
    slide = np.asarray(solution.operation.slide_to_roll)
    order = np.argsort(slide, kind="stable")
    traces = [
        curve(
            100.0 * slide[order],
            one.of(solution.traction_coefficient)[order],
            curve_name(solution, one),
            COLOURS[i % len(COLOURS)],
            line={"dash": _DASHES[i // len(COLOURS) % len(_DASHES)]},
        )
        for i, one in enumerate(curves)
    ]
    axes = {"xaxis": {"title": "slide-to-roll ratio, %"}, "yaxis": {"title": "traction coefficient"}}
    where = _operating_point(solution, curves[0]).rpartition(", ")[0]
    return Chart(f"traction-{number}", where, "One curve for each pressure.", figure_of(*traces, **axes))


def _operating_point(solution: TwoDiskSolution, one: Curve) -> str:
    unit, factor = axis_unit("m/s", one.entrainment_speed)
    speed = f"{factor * one.entrainment_speed:.5g} {unit}"
    return f"{one.temperature - ZERO_CELSIUS:.5g} °C, {speed}, {curve_name(solution, one)}"


def _largest(solution: TwoDiskSolution, one: Curve) -> str:
    traction = one.of(solution.traction_coefficient)
    j = int(np.argmax(np.abs(traction)))
    return f"{digits(float(traction[j]))} at {100.0 * float(np.asarray(solution.operation.slide_to_roll)[j]):.4g} %"
