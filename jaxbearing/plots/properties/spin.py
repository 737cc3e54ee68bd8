"""Plot of the spin friction of an elliptical contact (Figure 41 of the source)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from ...contacts.distributed import DistributedTraction
from ...contacts.patch import ContactPatch
from ...contacts.point import PointContact
from ...contacts.point_film import NijenbanningVennerMoes
from ...contacts.resolution import Resolution
from ...contacts.shear import Sliding
from ...report.colours import CURVES
from ..frame import drawing
from .curves import finish, oil_named

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure

# Values from the caption of Figure 41, for the inner contact of the source's ball bearing, and values derived from them
ROLL_RATE = 5337.27
"""Rolling speed ω_roll, rad/s."""
SEMI_MAJOR, AT_PRESSURE, RATIO = 2.605e-3, 1.89e9, 8.1423
"""Semi-axis a across rolling, m; Hertz pressure at which it has this size, Pa; ratio a/c, with c along rolling."""
SPEED_NUMBER, MATERIAL_NUMBER = 4.5473e-10, 2364.49
"""Dimensionless numbers U* (with the sum of the surface speeds) and G*."""
MODULUS, RADIUS, RADIUS_RATIO = 214.4e9, 9.212e-3, 26.03
"""E', Pa, Rx, m, and Ry/Rx, calculated from a, a/c and W*."""
TEMPERATURE = 353.15
"""Assumed oil temperature, K: between 72 °C, which fits U*, and 89 °C, which fits G*."""
RESOLUTION = Resolution(64, 64)
PRESSURES = (1.19e9, 1.50e9, 1.89e9, 2.38e9)


def spin_friction(
    pressures: Sequence[float] = PRESSURES, temperature: float = TEMPERATURE, axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Plots the spin torque, divided by load and mean semi-axis √(ac), over the spin-to-roll ratio (Figure 41).

    **Arguments:** `pressures`: Hertz (peak) pressures, Pa, > 0; `temperature`: of the oil in the contact, K; `axes`:
    matplotlib axes to draw into.
    """
    caption = (
        "Spin torque over normal load and √(ac) of the contact of Figure 41 of the source (Mobil Jet II, a/c = 8.1423, "
        "ω_roll = 5337.27 rad/s, isothermal, film from the printed U* and G*), "
        f"oil in the contact at {temperature - 273.15:.0f} °C. Its third W* is a misprint (1.1814e-4 for 1.8136e-4). "
        "The printed U* belongs to 72 °C and G* to 89 °C, so the temperature is assumed; the sign of the temperature "
        "coefficient of τ0 differs between table and figure of the source, here it is the table's. The axis of the "
        "source ends at 0.20; its curves are not in the text: comparable in kind only."
    )
    figure, axes = drawing(axes, caption)
    ratios = np.concatenate([[0.0], np.geomspace(0.002, 1.0, 60)])
    for colour, pressure in zip(CURVES, pressures, strict=False):
        values = spin_coefficient(ratios, pressure, temperature)
        axes.plot(ratios, values, color=colour, label=f"{pressure / 1e9:.2f} GPa")
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(bottom=0.0)
    finish(axes, "Friction by spinning", "spin-to-roll ratio", "spin torque over load and √(ac)", "Hertz pressure")
    return figure


def film_thickness(pressure: float) -> float:
    """Central film thickness, m, from the printed U* and G*. **Arguments:** `pressure`: Hertz pressure, Pa."""
    contact = PointContact(RADIUS, RADIUS_RATIO * RADIUS, MODULUS)
    speed = ROLL_RATE * RADIUS
    viscosity = SPEED_NUMBER * MODULUS * RADIUS / (2.0 * speed)
    load = patch_at(pressure).load
    law = NijenbanningVennerMoes()
    return float(jnp.exp(law.log_thickness(contact, load, speed, viscosity, MATERIAL_NUMBER / MODULUS)))


def patch_at(pressure: float) -> ContactPatch:
    """Hertz contact ellipse. **Arguments:** `pressure`: Hertz pressure, Pa; the semi-axes are proportional to it."""
    semi_major = SEMI_MAJOR * pressure / AT_PRESSURE
    return ContactPatch(jnp.asarray(pressure), jnp.asarray(semi_major / RATIO), jnp.asarray(semi_major))


def spin_coefficient(
    ratios: Any, pressure: float, temperature: float = TEMPERATURE, elastic: bool = True
) -> np.ndarray:
    """Spin torque divided by load and √(ac), for each spin-to-roll ratio. **Arguments:** `elastic`: True to include the
    shear modulus of the oil."""
    patch, lubricant = patch_at(pressure), oil_named("mobil_jet_ii")[0]
    spin = ROLL_RATE * jnp.asarray(ratios, dtype=float)
    sliding = Sliding(jnp.zeros_like(spin), jnp.zeros_like(spin), spin)
    law = DistributedTraction(resolution=RESOLUTION, elastic=elastic)
    speed = ROLL_RATE * RADIUS
    traction = law.traction(patch, film_thickness(pressure), speed, sliding, temperature, lubricant)
    return np.asarray(traction.moment / (patch.load * jnp.sqrt(patch.half_width * patch.half_length)))
