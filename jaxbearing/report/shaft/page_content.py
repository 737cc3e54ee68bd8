"""Content of the report page of a shaft: the whole shaft, then each of its bearings."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...numerics.status import Status
from ...shafts.scene import ShaftSystem
from ...shafts.solution import BearingOnShaft, ShaftSolution
from ..bearing.facts import facts as bearing_facts
from ..bearing.life_facts import life_headlines
from ..bearing.ring_panels import bent_rings, shape_panels
from ..colours import LOSS
from ..display import axis_unit, with_unit
from ..labels import labelled
from ..page_content import Content, Listing, Sketch
from ..panels import Bars, Curves, Polar
from ..tables import Row, row_of
from .bending import bending_line
from .drawn import svg
from .facts import (
    bearing_columns,
    left_out,
    life_columns,
    loss_of,
    number,
    overloads,
    set_facts,
    shaft_facts,
    shaft_notes,
    stiffness_rows,
    system_facts,
    with_states,
)
from .panels import shaft_panels
from .picture import pictures
from .plots import operating_text


def page_content(scene: ShaftSystem, solution: ShaftSolution) -> Content:
    """Content of the page of a shaft; see `report.html_report.html_report`."""
    bearings = solution.bearings
    losses = {name: watts for name, bearing in bearings.items() if (watts := loss_of(bearing)) is not None}
    total = sum(losses.values())
    return Content(
        kind="shaft on bearings",
        operation=operating_text(solution),
        not_modelled=left_out(solution),
        headlines=list(_headlines(solution, total if losses else None)),
        sketches=[Sketch(picture.title, svg(picture), picture.caption) for picture in pictures(scene, solution)],
        facts=[*shaft_facts(solution), *((f"set {name}", text) for name, text in set_facts(solution))],
        facts_title="Shaft and sets",
        charts=[*([_losses(losses)] if losses else []), *shaft_panels(solution), *_rings(solution)],
        listings=[*_tables(solution), *(_bearing_listing(bearing) for bearing in bearings.values())],
        convergence=[
            ("status", Status(int(solution.status)).text.replace("_", " ")),
            ("steps of the convex minimisation", str(int(solution.start_steps))),
            ("Newton steps", str(int(solution.newton_steps))),
            ("unknowns of the shaft", str(solution.unknowns)),
            ("largest scaled residual", f"{float(solution.residual_norm):.1e}"),
        ],
        checks=[(with_states(solution, text), bool(broken)) for text, broken in solution.range_checks.items()],
        notes=shaft_notes(solution),
        results=list(_results(solution)),
    )


def _rings(solution: ShaftSolution) -> Iterator[Polar | Curves]:
    """Charts of the deformed flexible rings of the bearings."""
    for name, bearing in solution.bearings.items():
        if bearing.solution is not None:
            for ring in bent_rings(bearing.solution):
                yield from shape_panels(bearing.solution, ring, name, f", {name}", "Y of the shaft")


def _losses(losses: dict[str, float]) -> Bars:
    """Bar chart of the power loss of each bearing."""
    total = sum(losses.values())
    unit, factor = axis_unit("W", max(abs(watts) for watts in losses.values()))
    return Bars(
        name="power",
        title="Power loss by bearing",
        caption="Dissipated in each bearing; the shares are those of the total.",
        quantity="power loss",
        unit=unit,
        names=list(losses),
        values=[factor * watts for watts in losses.values()],
        shares=[f"{100.0 * watts / total:.1f} %" if total else "-" for watts in losses.values()],
        total=factor * total,
        colour=LOSS,
    )


def _headlines(solution: ShaftSolution, total: float | None) -> Iterator[tuple[str, str]]:
    yield from ((name.lower(), text) for name, text in overloads(solution))
    if solution.life is not None and not any(overloads(solution)):
        for name, text in life_headlines(solution.life):
            yield f"system {name}", text
    size, _ = bending_line(solution).largest()
    yield "largest deflection", with_unit(size, "m")
    if total is not None:
        yield "power loss", with_unit(total, "W")
    loads = [number(bearing.largest_load) for bearing in solution.bearings.values()]
    largest = max((load for load in loads if load is not None), default=None)
    if largest is not None:
        yield "largest load of an element", with_unit(largest, "N")


def _tables(solution: ShaftSolution) -> Iterator[Listing]:
    """Tables of the bearings: forces; then lives, safeties, lubrication, clearances, temperatures and losses."""
    yield _table("Bearings", bearing_columns(solution), "Forces of the bearings on the shaft; azimuths from Y.")
    columns = life_columns(solution)
    if columns:
        system = (f"{name}: {text}." for name, text in system_facts(solution))
        yield _table("Life, safety and losses", columns, *system)


def _table(title: str, columns: dict[str, list[str]], *remarks: str) -> Listing:
    headings = [heading.rstrip("\n").replace("\n", ", ") for heading in columns]
    return Listing(title, headings, [list(row) for row in zip(*columns.values(), strict=True)], remarks)


def _bearing_listing(bearing: BearingOnShaft) -> Listing:
    """Table of the stiffness of a bearing, with its other results as remarks."""
    names, rows = stiffness_rows(bearing)
    texts = (
        [f"{name}: {text}" for name, text in bearing_facts(bearing.solution)] if bearing.solution is not None else []
    )
    ring = ", ".join(_texts(bearing.ring))
    remarks = [f"Displacement of the inner ring against the outer one: {ring}.", *texts]
    table = [[name, *row] for name, row in zip(names, rows, strict=True)]
    return Listing(f"Bearing {bearing.name}: stiffness, N/m, N/rad, N m/m, N m/rad", ["", *names], table, remarks)


def _texts(part: Any) -> Iterator[str]:
    for path, value, metadata in labelled(part):
        yield f"{path.replace('_', ' ')} {with_unit(float(value), metadata['unit'])}"


def _results(solution: ShaftSolution) -> Iterator[Row]:
    """Rows of all scalar results of bearings, sets and shaft, under their paths in Python."""
    parts = {f"bearings['{name}'].": bearing for name, bearing in solution.bearings.items()}
    parts |= {f"sets['{name}'].": result for name, result in solution.sets.items()}
    parts |= {"torque.": solution.torque, "life.": solution.life, "thermal.": solution.thermal}
    for above, part in parts.items():
        if part is None:
            continue
        for path, value, metadata in labelled(part):
            if np.ndim(value) == 0 and not path.startswith("solution.operation") and metadata["unit"] != "mixed":
                yield row_of(above + path, np.asarray(value), metadata)
