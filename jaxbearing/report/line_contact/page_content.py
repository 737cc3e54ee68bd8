"""Content of the report page of a line contact."""

from ..._scene import AbstractScene
from ...ehl import LineContactSolution
from ...numerics.status import Status
from ..display import pretty, with_unit
from ..page_content import Content
from ..tables import result_rows
from .operation import operating_text
from .panels import line_contact_panels

_SOLVER = ("status", "iterations", "residual_norm", "last_step")


def page_content(scene: AbstractScene, solution: LineContactSolution) -> Content:
    """See `report.html_report.html_report`."""
    return Content(
        kind="lubricated line contact",
        operation=pretty(operating_text(solution)),
        headlines=[
            ("central film", with_unit(float(solution.film.central), "m")),
            ("minimum film", with_unit(float(solution.film.minimum), "m")),
            ("Hertz pressure", with_unit(float(solution.hertz.pressure), "Pa")),
        ],
        charts=line_contact_panels(solution),
        convergence=[
            ("status", Status(int(solution.status)).text.replace("_", " ")),
            ("Newton steps on all meshes", str(int(solution.iterations))),
            ("unknowns", str(solution.unknowns)),
            ("last step", f"{float(solution.last_step):.1e}"),
            ("residual before it", f"{float(solution.residual_norm):.1e}"),
        ],
        checks=[(text, bool(broken)) for text, broken in solution.range_checks.items()],
        notes=solution.notes,
        results=[row for row in result_rows(solution, _SOLVER) if not row.path.startswith("operation.")],
    )
