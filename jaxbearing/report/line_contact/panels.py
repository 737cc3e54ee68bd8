"""Charts of a line contact: pressure and film along rolling."""

import numpy as np

from ...ehl import LineContactSolution
from ..colours import FAINT, INNER, OUTER
from ..display import axis_unit, digits
from ..panels import Axis, Curves, Mark, Series
from .operation import inlet_side

SHOWN = 2.0
"""Range drawn on each side of the centre, in Hertz half widths."""
_PLACE = Axis("place over the Hertz half width", (-SHOWN, SHOWN))


def line_contact_panels(solution: LineContactSolution) -> list[Curves]:
    """Charts of pressure and film thickness."""
    x = np.asarray(solution.profile.x) / float(solution.hertz.half_width)
    caption = f"Oil enters {inlet_side(solution)}."
    return [_pressure(solution, x, caption), _film(solution, x, caption)]


def hertz_series(pressure: float) -> Series:
    """Hertz pressure of the dry contact with this peak pressure, over position divided by the half width."""
    inside = np.linspace(-1.0, 1.0, 201)
    return Series("Hertz", inside, pressure * np.sqrt(1.0 - inside**2), FAINT, dash="dash", faint=True)


def _pressure(solution: LineContactSolution, x: np.ndarray, caption: str) -> Curves:
    hertz = float(solution.hertz.pressure)
    unit, factor = axis_unit("Pa", hertz)
    curve = Series("solution", x, factor * np.asarray(solution.profile.pressure), INNER)
    return Curves("pressure", "Pressure", caption, [hertz_series(factor * hertz), curve], unit, _PLACE)


def _film(solution: LineContactSolution, x: np.ndarray, caption: str) -> Curves:
    film, formulas = solution.film, solution.formulas
    unit, factor = axis_unit("m", 3.0 * float(film.central))
    shown = lambda value: factor * float(value)
    level = lambda name, value, dash: Series(name, (), shown(value), FAINT, dash=dash)
    mark = lambda name, x, value: Mark(x, shown(value), f"{name} {shown(value):.4g} {unit}")
    return Curves(
        name="film",
        title="Film thickness",
        caption=f"{caption} Smallest: {digits(shown(film.minimum))} {unit}.",
        series=[Series("film", x, factor * np.asarray(solution.profile.film), OUTER)],
        unit=unit,
        x=_PLACE,
        y=Axis(limits=(0.0, 3.0 * shown(film.central))),
        levels=[
            level("Moes (central)", formulas.moes_central, "dash"),
            level("Dowson-Higginson (minimum)", formulas.dowson_higginson_minimum, "dot"),
        ],
        marks=[
            mark("central", 0.0, film.central),
            mark("minimum", float(film.minimum_position) / float(solution.hertz.half_width), film.minimum),
        ],
    )
