"""Viscosity against pressure and temperature: the source's Figures 25, 26 and 30 to 33."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import jax.numpy as jnp
import numpy as np

from ...lubricants import Lubricant
from ...report.colours import CURVES
from ...report.display import ZERO_CELSIUS
from ..frame import drawing
from .curves import MATCHED, NAMES, finish, kelvin, matched_barus, matched_roelands, oil_named

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

MEASURED = {0.0: 0.157, 50.0: 0.017, 100.0: 0.0047, 150.0: 0.0021, 200.0: 0.0012}
"""Mobil Jet II at ambient pressure as printed in the source: °C -> Pa s."""
_PRESSURE, _VISCOSITY = "pressure, MPa", "dynamic viscosity, Pa s"


def viscosity_pressure(
    oil: str | Lubricant,
    temperatures: Sequence[float],
    highest_pressure: float = 0.7e9,
    beside: str | Lubricant | None = None,
    axes: "matplotlib.axes.Axes | None" = None,
) -> "matplotlib.figure.Figure":
    """Viscosity of an oil against pressure, one curve for each temperature (Figures 25, 31, 32, 33).

    **Arguments:** `oil`: name in the catalogue, or a lubricant; `temperatures`: °C; `highest_pressure`: Pa;
    `beside`: another oil, drawn dashed in the same colours; `axes`: matplotlib axes to draw into.
    """
    lubricant, name = oil_named(oil)
    other, other_name = (None, "") if beside is None else oil_named(beside)
    caption = f"Low-shear viscosity of {name} against pressure, by its law in the library." + (
        f" Dashed: {other_name}." if other else ""
    )
    caption += (
        " For the source's oils that is the modified WLF law with the source's parameters. The points measured in the "
        "source are in its pictures only: they are neither shown nor compared."
    )
    figure, axes = drawing(axes, caption)
    pressure = jnp.linspace(0.0, highest_pressure, 141)
    for number, celsius in enumerate(temperatures):
        colour = CURVES[number % len(CURVES)]
        values = lubricant.viscosity.viscosity(pressure, kelvin(celsius))
        axes.semilogy(1e-6 * np.asarray(pressure), values, color=colour, label=f"{celsius:g} °C")
        if other is not None:
            values = other.viscosity.viscosity(pressure, kelvin(celsius))
            axes.semilogy(1e-6 * np.asarray(pressure), values, color=colour, linestyle="--")
    axes.set_xlim(0.0, 1e-6 * highest_pressure)
    finish(axes, f"Viscosity of {name}", _PRESSURE, _VISCOSITY)
    return figure


def viscosity_models(
    oil: str | Lubricant = "mobil_jet_ii", axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """An oil's viscosity law against those of Barus and Roelands, at 40 and 164 °C up to 1 GPa (Figure 26).

    **Arguments:** `oil`: name in the catalogue, or a lubricant; `axes`: matplotlib axes to draw into.
    """
    lubricant, name = oil_named(oil)
    own = lubricant.viscosity
    laws = {"own law": own, "Barus": matched_barus(own), "Roelands": matched_roelands(own)}
    apart = {
        label: float(law.viscosity(1e9, MATCHED[0]) / own.viscosity(1e9, MATCHED[0])) for label, law in laws.items()
    }
    caption = (
        f"Viscosity of {name} at 40 °C (solid) and 164 °C (dashed) by its own law and by those of Barus and Roelands, "
        "which are matched to it in three points: 40 °C at 0 and 50 MPa, 164 °C at 0. At 1 GPa and 40 °C Barus is "
        f"{apart['Barus']:.3g} and Roelands {apart['Roelands']:.3g} times the own law. In Figure 26 of the source "
        "(Mobil Jet II) they have parameters of other authors, which the text does not give, and there is a power law "
        "too, which the library lacks: values cannot be compared."
    )
    figure, axes = drawing(axes, caption)
    pressure = jnp.linspace(0.0, 1e9, 161)
    for colour, (label, law) in zip(CURVES, laws.items(), strict=False):
        for temperature, line in zip(MATCHED, ("-", "--"), strict=True):
            shown = f"{label}, {temperature - ZERO_CELSIUS:.0f} °C"
            values = law.viscosity(pressure, temperature)
            axes.semilogy(1e-6 * np.asarray(pressure), values, color=colour, linestyle=line, label=shown)
    axes.set_xlim(0.0, 1000.0)
    finish(axes, f"Viscosity laws compared: {name}", _PRESSURE, _VISCOSITY)
    return figure


def viscosity_temperature(
    oils: Sequence[str] = tuple(NAMES),
    range_celsius: tuple[float, float] = (-20.0, 200.0),
    axes: "matplotlib.axes.Axes | None" = None,
) -> "matplotlib.figure.Figure":
    """Viscosity of oils at ambient pressure against temperature (Figure 30, with Mobil Jet II).

    **Arguments:** `oils`: names in the catalogue; `range_celsius`: °C; `axes`: matplotlib axes to draw into.
    """
    caption = (
        "Low-shear viscosity at ambient pressure by the modified WLF law with the source's parameters. "
        "Points: the values that the source prints for Mobil Jet II, which the law meets within 6 % at 0 °C and 4 % "
        "from 50 to 200 °C. Figure 30 of the source shows the other three oils; its points are not in the text."
    )
    figure, axes = drawing(axes, caption)
    celsius = np.linspace(*range_celsius, 181)
    for colour, oil in zip(CURVES, oils, strict=False):
        lubricant, name = oil_named(oil)
        axes.semilogy(celsius, lubricant.viscosity.viscosity(0.0, kelvin(celsius)), color=colour, label=name)
        if oil == "mobil_jet_ii":
            axes.semilogy([*MEASURED], [*MEASURED.values()], "o", color=colour, label=f"{name}, measured")
    axes.set_xlim(*range_celsius)
    finish(axes, "Viscosity at ambient pressure", "temperature, °C", _VISCOSITY)
    return figure
