"""Charts of a shaft: bending line, internal forces and bending moments along it."""

import numpy as np

from ...shafts.solution import ShaftSolution
from ..colours import CURVES, INK
from ..display import axis_unit
from ..panels import Axis, Curves, Mark, Series
from .bending import PLANES, bending_line, cut_loads

_ALONG = Axis("position along the shaft, mm")


def shaft_panels(solution: ShaftSolution) -> list[Curves]:
    """Charts of the bending line and, for a shaft with sections, of bending moment and internal forces."""
    panels = [deflection_panel(solution)]
    if solution.operation.sections:
        panels += [moment_panel(solution), shear_panel(solution)]
    return panels


def deflection_panel(solution: ShaftSolution) -> Curves:
    line = bending_line(solution)
    size, place = line.largest()
    unit, factor = axis_unit("m", size)
    x = 1e3 * line.position
    series = [Series(f"along {name}", x, factor * line.across[i], CURVES[i]) for i, (name, _, _) in enumerate(PLANES)]
    series.append(Series("size", x, factor * line.size, INK, dash="dash"))
    return Curves(
        name="deflection",
        title="Bending line",
        caption="Displacement of the axis across itself. Dashed: its size.",
        series=series,
        unit=unit,
        x=_ALONG,
        marks=[Mark(1e3 * place, factor * size, "")],
    )


def moment_panel(solution: ShaftSolution) -> Curves:
    """Chart of the bending moments."""
    cut = cut_loads(solution)
    x = 1e3 * cut.position
    series = [Series(f"in the plane X-{name}", x, cut.moment[i], CURVES[i]) for i, (name, _, _) in enumerate(PLANES)]
    series.append(Series("size", x, np.hypot(*cut.moment), INK, dash="dash"))
    caption = "Moment in the cross section; positive where it bends the shaft hollow towards the positive side."
    return Curves("moment", "Bending moment", caption, series, "N m", _ALONG)


def shear_panel(solution: ShaftSolution) -> Curves:
    """Chart of the shear and axial forces."""
    cut = cut_loads(solution)
    x = 1e3 * cut.position
    series = [Series(f"shear along {name}", x, cut.shear[i], CURVES[i]) for i, (name, _, _) in enumerate(PLANES)]
    series.append(Series("axial", x, cut.axial, CURVES[2], dash="dot"))
    caption = "Force of the part on the left of a cross section on that on the right. Axial: tension is positive."
    return Curves("shear", "Cut forces", caption, series, "N", _ALONG)


def panel_of(solution: ShaftSolution, name: str) -> Curves:
    """The chart of a shaft with the given name."""
    return next(panel for panel in shaft_panels(solution) if panel.name == name)
