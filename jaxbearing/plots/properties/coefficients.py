"""Pressure-viscosity coefficient and the film that follows from it: the source's Figures 27, 28 and 34."""

# the coefficient is called by its Greek letter on axes and in captions
# ruff: noqa: RUF001

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...contacts.point import PointContact
from ...contacts.point_film import NijenbanningVennerMoes
from ...lubricants import AbstractViscosity, IntegratedPressureViscosity
from ...report.colours import CURVES
from ..frame import drawing
from .curves import (
    DISK_RADIUS,
    STEEL_MODULUS,
    finish,
    kelvin,
    matched_barus,
    matched_roelands,
    oil_named,
)

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

PRINTED = {0.0: 20.2, 40.0: 14.8, 82.0: 11.5, 124.0: 9.15, 164.0: 7.60}
"""alpha* of Mobil Jet II in the source's table 6: °C -> 1/GPa."""
_MATCHED = "Barus and Roelands are matched to the modified WLF law at 40 °C (0 and 50 MPa) and at 164 °C (0)"
_TEMPERATURE, _ALPHA = "temperature, °C", "pressure-viscosity coefficient α*, 1/GPa"


def alpha_of_models(axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Coefficient alpha* of Mobil Jet II by three viscosity laws, and as the source prints it (Figure 27).

    **Arguments:** `axes`: matplotlib axes to draw into.
    """
    caption = (
        "Reciprocal isoviscous pressure α* of Mobil Jet II, integrated over pressure for three viscosity laws; points: "
        "table 6 of the source, which the modified WLF law meets within 0.9 %. "
        f"{_MATCHED}. In Figure 27 of the source these two have parameters of other authors that the text does not "
        "give: not comparable."
    )
    figure, axes = drawing(axes, caption)
    celsius = np.linspace(0.0, 200.0, 101)
    for colour, (label, law) in zip(CURVES, mobil_laws().items(), strict=False):
        axes.plot(celsius, alpha_at(law, celsius), color=colour, label=label)
    axes.plot([*PRINTED], [*PRINTED.values()], "o", color=CURVES[-1], label="source, table 6")
    axes.set_ylim(bottom=0.0)
    axes.set_xlim(-2.0, 200.0)
    finish(axes, "α* of Mobil Jet II by viscosity law", _TEMPERATURE, _ALPHA)
    return figure


def alpha_of_oils(
    oils: Sequence[str] = ("pennzane_x2000", "nye_186a", "fomblin_z25"),
    range_celsius: tuple[float, float] = (-30.0, 120.0),
    axes: "matplotlib.axes.Axes | None" = None,
) -> "matplotlib.figure.Figure":
    """Coefficient alpha* of oils against temperature, integrated and by their closed forms (Figure 34).

    **Arguments:** `oils`: names in the catalogue; `range_celsius`: °C; `axes`: matplotlib axes to draw into.
    """
    caption = (
        "Reciprocal isoviscous pressure α*. Lines: integral of the viscosity law over pressure; circles: the closed "
        "form that films use, with the coefficients of table 11 of the source. The two differ by at most 0.04 % "
        "(Pennzane), 0.03 % (Nye) and 0.23 % (Fomblin); the source claims less than 0.1 %. The measured points of "
        "Figure 34 are not in the text."
    )
    figure, axes = drawing(axes, caption)
    celsius = np.linspace(*range_celsius, 101)
    for colour, oil in zip(CURVES, oils, strict=False):
        lubricant, name = oil_named(oil)
        axes.plot(celsius, alpha_at(lubricant.viscosity, celsius), color=colour, label=name)
        fitted = 1e9 * np.asarray(lubricant.pressure_viscosity.coefficient(kelvin(celsius[::10])))
        axes.plot(celsius[::10], fitted, "o", color=colour, markerfacecolor="white", markersize=4.5)
    axes.set_ylim(bottom=0.0)
    finish(axes, "Pressure-viscosity coefficient of three oils", _TEMPERATURE, _ALPHA)
    return figure


def film_of_models(pressure: float = 1.05e9, axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Central film of a 20 mm sphere at 40 m/s in Mobil Jet II by three viscosity laws (Figure 28).

    **Arguments:** `pressure`: Hertz (peak), Pa, > 0; `axes`: matplotlib axes to draw into.
    """
    caption = (
        "Isothermal central film by Nijenbanning, Venner and Moes for Rx = Ry = 20 mm, U1 = U2 = 40 m/s and "
        f"{pressure / 1e9:g} GPa Hertz pressure, with ambient viscosity and α* of Mobil Jet II by three laws. "
        f"{_MATCHED}. Modified WLF at 100 °C and 1.05 GPa: 0.624 µm, "
        "Roelands 5 % and Barus 50 % more. In Figure 28 of the source the decade of the axis "
        "is lost, its pressure is 1.05 GPa in the caption and 1.5 GPa in the text, and the other laws' parameters are "
        "not given: its 20 % spread cannot be compared."
    )
    figure, axes = drawing(axes, caption)
    celsius = np.linspace(50.0, 200.0, 101)
    for colour, (label, law) in zip(CURVES, mobil_laws().items(), strict=False):
        axes.semilogy(celsius, film_at(law, celsius, pressure), color=colour, label=label)
    axes.set_xlim(50.0, 200.0)
    axes.minorticks_off()
    ticks = [0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.0]
    low, high = axes.get_ylim()
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_ylim(low, high)
    finish(axes, "Film by viscosity law, Mobil Jet II", _TEMPERATURE, "central film, µm")
    return figure


def mobil_laws() -> dict[str, AbstractViscosity]:
    """The viscosity laws that are compared."""
    own = oil_named("mobil_jet_ii")[0].viscosity
    return {"modified WLF": own, "Barus": matched_barus(own), "Roelands": matched_roelands(own)}


def alpha_at(law: AbstractViscosity, celsius: Any) -> np.ndarray:
    """Integrated coefficient, 1/GPa."""
    return 1e9 * np.asarray(IntegratedPressureViscosity(law).coefficient(kelvin(celsius)))


def film_at(law: AbstractViscosity, celsius: Any, pressure: float) -> np.ndarray:
    """Central film of the contact of Figure 28, µm."""
    contact, temperature = PointContact(DISK_RADIUS, DISK_RADIUS, STEEL_MODULUS), kelvin(celsius)
    alpha = IntegratedPressureViscosity(law).coefficient(temperature)
    load, viscosity = contact.load_at_pressure(pressure), law.viscosity(0.0, temperature)
    return 1e6 * np.exp(np.asarray(NijenbanningVennerMoes().log_thickness(contact, load, 40.0, viscosity, alpha)))
