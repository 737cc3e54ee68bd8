"""Friction by spinning of an elliptical contact: the source's Figure 41."""

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

# The caption of Figure 41, and what it decodes to (inner contact of the source's ball bearing)
ROLL_RATE = 5337.27
"""rad/s."""
SEMI_MAJOR, AT_PRESSURE, RATIO = 2.605e-3, 1.89e9, 8.1423
"""Semi-axis across rolling, m, at a Hertz pressure, Pa, and its ratio to the one along rolling."""
SPEED_NUMBER, MATERIAL_NUMBER = 4.5473e-10, 2364.49
"""U* (with the sum of the surface speeds) and G*."""
MODULUS, RADIUS, RADIUS_RATIO = 214.4e9, 9.212e-3, 26.03
"""E', Pa, and Rx, m, and Ry/Rx that follow from a, a/c and W*."""
TEMPERATURE = 353.15
"""K; U* asks for 72 °C and G* for 89 °C: between the two."""
RESOLUTION = Resolution(64, 64)
PRESSURES = (1.19e9, 1.50e9, 1.89e9, 2.38e9)


def spin_friction(
    pressures: Sequence[float] = PRESSURES, temperature: float = TEMPERATURE, axes: "matplotlib.axes.Axes | None" = None
) -> "matplotlib.figure.Figure":
    """Spin torque over load and mean semi-axis against the spin-to-roll ratio (Figure 41).

    **Arguments:** `pressures`: Hertz (peak), Pa, > 0; `temperature`: of the oil in the contact, K; `axes`: matplotlib
    axes to draw into.
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
    """Central film at a Hertz pressure, m, from the printed U* and G*."""
    contact = PointContact(RADIUS, RADIUS_RATIO * RADIUS, MODULUS)
    speed = ROLL_RATE * RADIUS
    viscosity = SPEED_NUMBER * MODULUS * RADIUS / (2.0 * speed)
    load = patch_at(pressure).load
    law = NijenbanningVennerMoes()
    return float(jnp.exp(law.log_thickness(contact, load, speed, viscosity, MATERIAL_NUMBER / MODULUS)))


def patch_at(pressure: float) -> ContactPatch:
    """The Hertz ellipse: its axes grow with the pressure."""
    semi_major = SEMI_MAJOR * pressure / AT_PRESSURE
    return ContactPatch(jnp.asarray(pressure), jnp.asarray(semi_major / RATIO), jnp.asarray(semi_major))


def spin_coefficient(
    ratios: Any, pressure: float, temperature: float = TEMPERATURE, elastic: bool = True
) -> np.ndarray:
    """Spin torque over load and √(ac) at spin-to-roll ratios. **Arguments:** `elastic`: with the oil's shear
    modulus."""
    patch, lubricant = patch_at(pressure), oil_named("mobil_jet_ii")[0]
    spin = ROLL_RATE * jnp.asarray(ratios, dtype=float)
    sliding = Sliding(jnp.zeros_like(spin), jnp.zeros_like(spin), spin)
    law = DistributedTraction(resolution=RESOLUTION, elastic=elastic)
    speed = ROLL_RATE * RADIUS
    found = law.traction(patch, film_thickness(pressure), speed, sliding, temperature, lubricant)
    return np.asarray(found.moment / (patch.load * jnp.sqrt(patch.half_width * patch.half_length)))
