"""Charts of a bearing's steady solve: power loss by location and, over the azimuth, loads, films, pressures, sliding
speeds and contact angles. Results that the scene does not model have no chart."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from ...bearings.solution import Solution
from ..colours import INNER, INNER_SECOND, LOSS, OUTER, OUTER_SECOND, RIB
from ..diagrams import Diagram
from ..display import axis_unit, digits
from ..panels import Axis, Bars, Curves, Numbers, Panel, Polar, Series, constant, log_ticks
from .azimuth import signed_degrees
from .network import network_diagram
from .operation import load_angle
from .ring_panels import ring_panels

SIDES = (
    ("outer", OUTER, "square", "outer race"),
    ("inner", INNER, "circle", "inner race"),
    ("outer_second", OUTER_SECOND, "diamond", "outer, second"),
    ("inner_second", INNER_SECOND, "triangle-down", "inner, second"),
    ("flange", RIB, "triangle-up", "rib"),
)
LOG_FROM = 20.0
"""Ratio of largest to smallest value above which an axis is logarithmic, so that the films of the loaded zone are
readable."""
ROUND = {
    "film": ("Central film", "log", "At the middle of each contact."),
    "pressure": ("Hertz (peak) pressure", "zero", "Peak of the Hertz pressure of each contact."),
    "sliding": ("Sliding speed", "", "Difference of the surface speeds of ring and rolling element."),
    "contact_angle": ("Contact angle", "", "Between the normal force and the plane across the axis."),
}
"""Result at the raceways or the rib -> title, kind of vertical axis ("zero": begins at 0, "log": may be logarithmic)
and caption."""


def bearing_panels(solution: Solution, rigid: Solution | None = None) -> list[Panel]:
    """The charts of a solution, as far as its scene models them: losses, loads, results over the azimuth, flexible
    rings.

    **Arguments:** `rigid`: the solution of the same scene with rigid rings, for comparison.
    """
    losses = loss_panel(solution)
    return [*([losses] if losses is not None else []), *contact_panels(solution), *ring_panels(solution, rigid)]


def contact_panels(solution: Solution) -> list[Panel]:
    """Loads and results over the azimuth. Results that are the same at every rolling element are numbers in one panel,
    which comes first if the loads are among them, otherwise last."""
    panels = [load_panel(solution), *round_panels(solution)]
    same = [panel for panel in panels if constant(panel)]
    changing = [panel for panel in panels if not constant(panel)]
    numbers = [_numbers(same, solution.element_name)] if same else []
    return [*numbers, *changing] if panels[0] in same else [*changing, *numbers]


def _numbers(panels: Sequence[Polar | Curves], element: str) -> Numbers:
    columns = [
        (label, colour) for _, colour, _, label in SIDES if any(_constant_text(panel, label) for panel in panels)
    ]
    rows = [(panel.title, [_constant_text(panel, label) or "-" for label, _ in columns]) for panel in panels]
    return Numbers("same", f"The same at every {element}", "What does not change round the bearing.", columns, rows)


def _constant_text(panel: Polar | Curves, label: str) -> str:
    """Value and unit of a constant curve; "" if the panel has no curve of this name."""
    values = [float(np.mean(curve.y)) for curve in panel.series if curve.name == label]
    return f"{digits(values[0])} {panel.unit}" if values else ""


def bearing_diagrams(solution: Solution) -> list[Diagram]:
    """The diagram of the thermal network, if the scene has one."""
    return [] if solution.thermal is None else [network_diagram(solution.thermal)]


def power_losses(solution: Solution) -> dict[str, float]:
    """Power loss by location, W, largest first, without the total; empty if the scene models no losses."""
    loss = solution.power_loss
    named = {field.name: getattr(loss, field.name) for field in dataclasses.fields(loss) if field.name != "total"}
    watts = {name: float(value) for name, value in named.items() if value is not None}
    return dict(sorted(watts.items(), key=lambda entry: -entry[1]))


def loss_panel(solution: Solution) -> Bars | None:
    """Power loss by location; `None` if the scene models no losses."""
    losses = power_losses(solution)
    if not losses:
        return None
    total = float(solution.power_loss.total)
    unit, factor = axis_unit("W", max(abs(watts) for watts in losses.values()))
    return Bars(
        name="power",
        title="Power loss by location",
        caption="Dissipated at each place; the shares are those of the total.",
        quantity="power loss",
        unit=unit,
        names=[name.replace("_", " ") for name in losses],
        values=[factor * watts for watts in losses.values()],
        shares=[f"{100.0 * watts / total:.1f} %" if total else "-" for watts in losses.values()],
        total=factor * total,
        colour=LOSS,
    )


def load_panel(solution: Solution) -> Polar:
    """Loads of the rolling elements over the azimuth."""
    values = _by_side(solution, "load")
    unit, factor = axis_unit("N", max(float(np.max(load)) for load in values.values()))
    azimuth, name = np.asarray(solution.elements.azimuth), solution.element_name
    first = float(np.degrees(azimuth[0]))
    return Polar(
        name="load",
        title=f"Load on each {name}",
        caption=f"Normal load of each {name} on its contacts; azimuth 0 is below, {name} 0 stands at {first:.4g}°.",
        series=_series(azimuth, {side: factor * load for side, load in values.items()}),
        unit=unit,
        arrow=load_angle(solution.operation),
    )


def round_panels(solution: Solution) -> list[Curves]:
    """Films, pressures, sliding speeds and contact angles over the azimuth, as far as they are modelled."""
    return [panel for panel in (round_panel(solution, name) for name in ROUND) if panel is not None]


def round_panel(solution: Solution, name: str) -> Curves | None:
    """A result of `ROUND` over the azimuth; `None` if the scene does not model it."""
    values = _by_side(solution, name)
    if not values:
        return None
    title, kind, caption = ROUND[name]
    finite = np.concatenate([array[np.isfinite(array)] for array in values.values()])
    smallest, largest = float(finite.min()), float(finite.max())
    labels = {field.name: field.metadata for field in dataclasses.fields(solution.elements)}
    unit, factor = axis_unit(labels[f"{name}_{next(iter(values))}"]["unit"], max(abs(largest), abs(smallest)))
    # these limits keep an almost constant curve off the edge
    across = Axis(limits=(0.0, 1.1 * factor * largest or 1.0)) if kind == "zero" else Axis()
    if kind == "log" and smallest > 0.0 and largest > LOG_FROM * smallest:
        ends = 0.8 * factor * smallest, 1.25 * factor * largest
        across = Axis(limits=ends, ticks=log_ticks(*ends), logarithmic=True)
    degrees = signed_degrees(solution.elements.azimuth)
    order = np.argsort(degrees)
    return Curves(
        name=name,
        title=title,
        caption=caption,
        series=_series(degrees[order], {side: factor * array[order] for side, array in values.items()}),
        unit=unit,
        x=Axis("azimuth from the load line, deg", (-188.0, 188.0), (-180, -90, 0, 90, 180)),
        y=across,
        of_elements=True,
    )


def _series(x: np.ndarray, values: dict[str, np.ndarray]) -> list[Series]:
    return [Series(label, x, values[side], colour, marker) for side, colour, marker, label in SIDES if side in values]


def _by_side(solution: Solution, name: str) -> dict[str, np.ndarray]:
    """Values at the raceways, their second flanks and the rib, as far as they are modelled and not NaN everywhere."""
    values = {side: getattr(solution.elements, f"{name}_{side}", None) for side, *_ in SIDES}
    arrays = {side: np.asarray(value) for side, value in values.items() if value is not None}
    return {side: array for side, array in arrays.items() if np.any(np.isfinite(array))}
