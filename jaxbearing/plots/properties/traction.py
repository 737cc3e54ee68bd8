"""Traction curves of a two-disk contact and what G and tau0 do to them: the source's Figures 21 to 23."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from ...contacts.distributed import DistributedTraction
from ...contacts.patch import ContactPatch, contact_patch
from ...contacts.point import PointContact
from ...contacts.point_film import NijenbanningVennerMoes
from ...contacts.resolution import Resolution
from ...contacts.shear import Sliding
from ...lubricants import Lubricant
from ...report.colours import CURVES
from ..frame import drawing
from .curves import DISK_RADIUS, STEEL_MODULUS, finish, oil_named

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

TEMPERATURE, SPEED, PRESSURE = 297.0, 21.175, 1.5e9
"""Conditions of the source's cold tests (Figure 29): temperature, K; mean speed, m/s (U1 + U2 = 42.35 m/s); Hertz
pressure, Pa."""
FINE = Resolution(128, 24)
_WHERE = (
    "Mobil Jet II at 297 K, 1.5 GPa Hertz pressure, U1 + U2 = 42.35 m/s, R = 20 mm, isothermal Maxwell-Eyring model"
)
_LOST = "of the source states no operating point and its curves are not in the text: not comparable"


def traction_models(axes: "matplotlib.axes.Axes | None" = None) -> "matplotlib.figure.Figure":
    """Traction by line-contact and point-contact models of several meshes (Figure 21).

    **Arguments:** `axes`: matplotlib axes to draw into.
    """
    caption = (
        f"Traction of one oil film by a one-dimensional (line) and a two-dimensional (point) contact: {_WHERE}, film "
        "and peak pressure the same. The line contact has the higher mean pressure, π/4 instead of 2/3 of the peak, "
        f"and therefore more traction. The coarse mesh is 16 % too low at 10 % sliding. Figure 21 {_LOST}."
    )
    figure, axes = drawing(axes, caption)
    models = {
        "line contact (1D), 128 steps": (True, FINE, "-"),
        "point contact (2D), 8 steps, 4 strips": (False, Resolution(8, 4), "--"),
        "point contact (2D), 128 steps, 24 strips": (False, FINE, "-"),
    }
    for colour, (label, (line, resolution, style)) in zip(CURVES, models.items(), strict=False):
        _draw(axes, oil_named("mobil_jet_ii")[0], label, colour, style, line, resolution)
    _finish(axes, "Traction by contact model and mesh")
    return figure


def traction_shear_modulus(
    factors: Sequence[float] = (0.25, 0.5, 1.0, 2.0, 4.0), axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Traction with the oil's shear modulus multiplied by factors (Figure 22).

    **Arguments:** `factors`: > 0; `axes`: matplotlib axes to draw into.
    """
    caption = (
        f"Traction with the shear modulus G of the oil multiplied by the factor shown: {_WHERE}. G sets the slope at "
        f"the origin, as the source says, "
        f"while a quarter of it lowers the traction at 10 % sliding by less than 3 %. Figure 22 {_LOST}."
    )
    return _varied("shear_modulus", "G", factors, caption, axes)


def traction_stress(
    factors: Sequence[float] = (0.25, 0.5, 1.0, 2.0, 4.0), axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Traction with the oil's characteristic (Eyring) stress multiplied by factors (Figure 23).

    **Arguments:** `factors`: > 0; `axes`: matplotlib axes to draw into.
    """
    caption = (
        f"Traction with the characteristic stress τ0 of the oil multiplied by the factor shown: {_WHERE}. τ0 sets the "
        f"traction at high sliding, as the source says "
        f"(it speaks of the maximum; this model has none). Figure 23 {_LOST}."
    )
    return _varied("stress", "τ0", factors, caption, axes)


def _varied(
    field: str, symbol: str, factors: Sequence[float], caption: str, axes: "matplotlib.axes.Axes | None"
) -> "matplotlib.figure.Figure":
    figure, axes = drawing(axes, caption)
    for colour, factor in zip(CURVES, factors, strict=False):
        _draw(axes, scaled(oil_named("mobil_jet_ii")[0], field, factor), f"{factor:g} {symbol}", colour)
    _finish(axes, f"Traction against {symbol}")
    return figure


def scaled(lubricant: Lubricant, field: str, factor: float) -> Lubricant:
    """The oil with one number of its rheology multiplied."""
    rheology: Any = lubricant.rheology
    return replace(lubricant, rheology=replace(rheology, **{field: factor * getattr(rheology, field)}))


def _draw(
    axes: "matplotlib.axes.Axes",
    lubricant: Lubricant,
    label: str,
    colour: str,
    style: str = "-",
    line: bool = False,
    resolution: Resolution = FINE,
) -> None:
    percent = np.concatenate([[0.0], np.geomspace(0.02, 10.0, 90)])
    axes.plot(
        percent,
        traction_at(lubricant, percent, line, resolution),
        color=colour,
        linestyle=style,
        label=label,
    )


def _finish(axes: "matplotlib.axes.Axes", title: str) -> None:
    axes.set_xlim(0.0, 10.0)
    axes.set_ylim(bottom=0.0)
    finish(axes, title, "slide-to-roll ratio (difference over mean speed), %", "traction coefficient")


def traction_at(lubricant: Lubricant, percent: object, line: bool = False, resolution: Resolution = FINE) -> np.ndarray:
    """Traction coefficient at slide-to-roll ratios in %. **Arguments:** `line`: as a line contact of the same peak
    pressure, half-width and film."""
    contact, inlet = PointContact(DISK_RADIUS, DISK_RADIUS, STEEL_MODULUS), lubricant.at(TEMPERATURE)
    load = contact.load_at_pressure(PRESSURE)
    film = jnp.exp(
        NijenbanningVennerMoes().log_thickness(contact, load, SPEED, inlet.viscosity, inlet.pressure_viscosity)
    )
    patch = contact_patch(contact, load)
    if line:
        patch = ContactPatch(patch.pressure, patch.half_width, patch.half_length, line=True)
    sliding = Sliding(jnp.asarray(percent, dtype=float) / 100.0 * SPEED)
    traction = DistributedTraction(resolution=resolution).traction(patch, film, SPEED, sliding, TEMPERATURE, lubricant)
    return np.asarray(traction.rolling / patch.load)
