"""Thermal reduction of the film: the source's Figure 20."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from ...contacts.point import PointContact
from ...contacts.thermal import Gupta
from ...report.colours import CURVES
from ..frame import drawing
from .curves import DISK_RADIUS, STEEL_MODULUS, finish, kelvin, oil_named

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure


def thermal_factor(
    slide_ratios: Sequence[float] = (0.0, 0.1, 0.5, 1.0, 2.0),
    pressure: float = 1e9,
    axes: "matplotlib.axes.Axes | None" = None,
) -> "matplotlib.figure.Figure":
    """Gupta's thermal factor of the film against the thermal loading L, one curve for each slide ratio S.

    **Arguments:** `slide_ratios`: 2|u1 - u2|/|u1 + u2|, >= 0; `pressure`: Hertz (peak), Pa, > 0; `axes`: matplotlib
    axes to draw into.
    """
    caption = (
        "Ratio of the film with inlet heating to the isothermal film by Gupta et al. (1992), against the thermal "
        "loading L = -(dµ/dT) u²/k with the mean speed u, for slide ratios S = 2|u1 - u2|/|u1 + u2|; steel, "
        f"{pressure / 1e9:g} GPa Hertz pressure. The factor is 1 at low speed. Figure 20 of the source shows the same "
        "formula; its pressure is not stated and its curves are not in the text, so no value is compared."
    )
    figure, axes = drawing(axes, caption)
    loading = jnp.logspace(-3.0, np.log10(20.0), 120)
    for colour, slide in zip(CURVES, slide_ratios, strict=False):
        axes.semilogx(loading, factor_at(loading, slide, pressure), color=colour, label=f"{slide:g}")
    axes.set_ylim(0.0, 1.02)
    finish(axes, "Thermal reduction of the film", "thermal loading L", "film over isothermal film", "slide ratio S")
    return figure


def factor_at(loading: Any, slide_ratio: float, pressure: float) -> np.ndarray:
    """Gupta's factor at a thermal loading; Mobil Jet II at 100 °C stands for the oil, which only enters through it."""
    contact = PointContact(DISK_RADIUS, DISK_RADIUS, STEEL_MODULUS)
    oil, law = oil_named("mobil_jet_ii")[0].at(kelvin(100.0)), Gupta()
    speed = jnp.sqrt(jnp.asarray(loading) / law.thermal_loading(1.0, oil))
    load = contact.load_at_pressure(pressure)
    return np.exp(np.asarray(law.log_factor(contact, load, speed, slide_ratio * speed, oil)))
