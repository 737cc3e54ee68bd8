"""Content of the report page of a bearing."""

from collections.abc import Iterator

import numpy as np

from ...bearings.bearing import AbstractBearing
from ...bearings.flanks import on_heavier_flanks
from ...bearings.minimum_films import thinnest_film
from ...bearings.solution import RING_FREEDOMS, Solution, stiffness_units
from ...numerics.status import Status
from ..display import digits, pretty, with_unit
from ..page_content import Content, Sketch
from ..tables import element_columns, result_rows
from .drawing.section import section
from .drawing.sketch import front_view
from .facts import OVERLOAD, facts, not_modelled, overload
from .life_facts import TITLES, life_headlines, repeated_lives
from .operation import operating_point, unused_operation
from .panels import bearing_diagrams, bearing_panels, power_losses
from .ring_panels import rigid_counterpart

_SOLVER = ("status", "iterations", "residual_norm", "inner_residual", "worst_equation", "worst_element", "unknowns")
_ARROWS = (
    "Arrows outside and inside the rings: normal force of each {name} on the outer and on the inner ring, all at one "
    "scale, so that their lengths are proportional to the loads. In the middle: what acts on the inner ring. "
    "Diameters and positions are to scale; clearances and films are not (micrometres beside millimetres: they are "
    "drawn closed), nor are {rings}, which have usual proportions."
)
_SECTION = (
    "Forces of the {name} on the rings, lengths proportional to the loads{angles}. The axis of the bearing lies below. "
    "Size of the {name} and its contacts to scale; clearances are drawn closed, and the rings at usual proportions."
)


def page_content(scene: AbstractBearing, solution: Solution) -> Content:
    """See `report.html_report.html_report`."""
    losses = power_losses(solution)
    total = float(solution.power_loss.total) if losses else 0.0
    unused = {f"operation.{name}" for name in unused_operation(solution)}
    results = [row for row in result_rows(solution, unused | set(_SOLVER)) if not row.path.startswith("operation.")]
    name, repeated = solution.element_name, {f"life.{life}" for life in repeated_lives(solution.life)}
    return Content(
        kind=scene.kind.replace("_", " "),
        operation=pretty(operating_point(solution)),
        headlines=list(_headlines(solution, total if losses else None)),
        sketches=[
            Sketch("Seen along the axis", front_view(scene, solution), _front_caption(scene, name)),
            Sketch(f"The most loaded {name}", section(scene, solution), _section_caption(scene, name)),
        ],
        facts=[fact for fact in facts(solution) if fact[0] not in TITLES],
        life=[row for row in results if row.path.startswith("life.") and row.path not in repeated],
        not_modelled=not_modelled(solution),
        charts=bearing_panels(solution, rigid_counterpart(scene, solution)),
        diagrams=bearing_diagrams(solution),
        convergence=list(_convergence(solution, total if losses else None)),
        checks=[(text, bool(broken)) for text, broken in solution.range_checks.items()],
        notes=solution.notes,
        results=[row for row in results if not row.path.startswith(("life.", "power_loss."))],
        elements=element_columns(solution),
        element_name=name,
        stiffness=_stiffness(solution),
    )


def _stiffness(solution: Solution) -> tuple[list[str], list[list[str]]]:
    """Headings, and rows with the units of the screen; "-" for degrees of freedom that are not modelled."""
    modelled = [name in solution.freedoms_of_stiffness for name in RING_FREEDOMS]
    units = stiffness_units()
    rows = [
        [with_unit(float(value), units[i][j]) if modelled[i] and modelled[j] else "-" for j, value in enumerate(row)]
        for i, row in enumerate(np.asarray(solution.stiffness))
    ]
    return [name.replace("_", " ") for name in RING_FREEDOMS], rows


def _front_caption(scene: AbstractBearing, name: str) -> str:
    shoulders = "" if scene.line_contacts else "the shoulders, "
    rings = f"{shoulders}bore and outside diameter of the rings"
    return _ARROWS.format(name=name, rings=rings)


def _section_caption(scene: AbstractBearing, name: str) -> str:
    angles = ", directions those of the contacts" if scene.outline().own_directions else ""
    return _SECTION.format(name=name, angles=angles)


def _headlines(solution: Solution, total: float | None) -> Iterator[tuple[str, str]]:
    elements, life = on_heavier_flanks(solution.elements), solution.life
    if overload(solution):
        yield OVERLOAD.lower(), f"{solution.element_name}s and races yield: no life"
        life = None
    if total is not None:
        yield "power loss", with_unit(total, "W")
    loads = np.maximum(np.asarray(elements.load_inner), np.asarray(elements.load_outer))
    yield f"largest {solution.element_name} load", with_unit(float(np.max(loads)), "N")
    pressures = np.maximum(np.asarray(elements.pressure_inner), np.asarray(elements.pressure_outer))
    yield "highest pressure", with_unit(float(np.max(pressures)), "Pa")
    films = [getattr(elements, f"{thinnest_film(elements)}_{side}") for side in ("inner", "outer")]
    arrays = [np.asarray(film) for film in films if film is not None and not np.all(np.isnan(np.asarray(film)))]
    if arrays:
        yield "thinnest film", with_unit(min(float(np.nanmin(film)) for film in arrays), "m")
    if solution.cage is not None:
        yield "cage slip", f"{digits(100.0 * float(solution.cage.slip), 3)} %"
    if life is not None:
        yield from life_headlines(life)


def _convergence(solution: Solution, total: float | None) -> Iterator[tuple[str, str]]:
    yield "status", Status(int(solution.status)).text.replace("_", " ")
    yield "Newton steps", str(int(solution.iterations))
    yield "unknowns", str(solution.unknowns)
    yield "largest scaled residual", f"{float(solution.residual_norm):.1e}"
    yield "equation of this residual", solution.equation_names[int(solution.worst_equation)]
    yield "residual of nested solves", f"{float(solution.inner_residual):.1e}"
    if total and solution.drive_power is not None:
        drive = float(solution.drive_power)
        yield "drive power over sum of losses", f"{drive / total - 1.0:+.1e} off 1"
