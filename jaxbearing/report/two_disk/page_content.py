"""Content of the report page of a two-disk machine: its traction curves."""

import numpy as np

from ..._scene import AbstractScene
from ...machines import TwoDiskSolution
from ..display import digits
from ..page_content import Content
from ..tables import result_rows
from .curves import Curve, curves_of
from .panels import curve_name, operating_point, two_disk_panels


def page_content(scene: AbstractScene, solution: TwoDiskSolution) -> Content:
    """Content of the page of traction curves; see `report.html_report.html_report`."""
    slide = np.asarray(solution.operation.slide_to_roll)
    return Content(
        kind="two-disk machine",
        operation=f"slide-to-roll ratio {100 * slide.min():.4g} to {100 * slide.max():.4g} %",
        facts=[
            (f"{operating_point(curve)}, {curve_name(solution, curve)}", _largest(solution, curve))
            for curve in curves_of(solution)
        ],
        facts_title="Largest traction of each curve",
        charts=two_disk_panels(solution),
        convergence=[
            ("status", "converged"),
            ("points", str(np.asarray(solution.status).size)),
            ("largest residual of nested solves", f"{float(np.max(np.asarray(solution.inner_residual))):.1e}"),
        ],
        checks=[(text, bool(broken)) for text, broken in solution.range_checks.items()],
        notes=solution.notes,
        results=result_rows(solution),
    )


def _largest(solution: TwoDiskSolution, curve: Curve) -> str:
    traction = curve.of(solution.traction_coefficient)
    j = int(np.argmax(np.abs(traction)))
    return f"{digits(float(traction[j]))} at {100.0 * float(np.asarray(solution.operation.slide_to_roll)[j]):.4g} %"
