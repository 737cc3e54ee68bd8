"""Content of the report page of a line contact."""

from typing import Any

import numpy as np

from ...ehl import LineContactSolution
from ...numerics.status import Status
from ..bearing.plots import INNER, OUTER
from ..charts import Chart, curve, figure_of
from ..display import digits, with_unit
from ..page_content import Content
from ..result_tables import result_rows
from ..sheet import FAINT, axis_unit, pretty
from .plots import SHOWN, inlet_side
from .summary import operating_text

_SOLVER = ("status", "iterations", "residual_norm", "last_step")


def line_contact_content(solution: LineContactSolution) -> Content:
    """See `report.html_report.html_report`."""
    return Content(
        kind="lubricated line contact",
        operation=pretty(operating_text(solution)),
        headlines=[
            ("central film", with_unit(float(solution.film.central), "m")),
            ("minimum film", with_unit(float(solution.film.minimum), "m")),
            ("Hertz pressure", with_unit(float(solution.hertz.pressure), "Pa")),
        ],
        charts=_charts(solution),
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


def _charts(solution: LineContactSolution) -> list[Chart]:
    x = np.asarray(solution.profile.x) / float(solution.hertz.half_width)
    xaxis = {"title": "place over the Hertz half width", "range": [-SHOWN, SHOWN]}
    inside = np.linspace(-1.0, 1.0, 201)
    hertz = float(solution.hertz.pressure)
    unit, factor = axis_unit("Pa", hertz)
    dry: dict[str, Any] = {"line": {"dash": "dash", "width": 1.4}}
    pressure = figure_of(
        curve(inside, factor * hertz * np.sqrt(1.0 - inside**2), "Hertz", FAINT, **dry),
        curve(x, factor * np.asarray(solution.profile.pressure), "solution", INNER),
        xaxis=xaxis,
        yaxis={"title": unit},
    )
    central = float(solution.film.central)
    film_unit, film_factor = axis_unit("m", 3.0 * central)
    film = figure_of(
        curve(x, film_factor * np.asarray(solution.profile.film), "film", OUTER),
        xaxis=xaxis,
        yaxis={"title": film_unit, "range": [0.0, 3.0 * film_factor * central]},
    )
    said = f"Oil enters {inlet_side(solution)}."
    smallest = f"{digits(film_factor * float(solution.film.minimum))} {film_unit}"
    return [
        Chart("pressure", f"Pressure, {unit}", said, pressure),
        Chart("film", f"Film thickness, {film_unit}", f"{said} Smallest: {smallest}.", film),
    ]
