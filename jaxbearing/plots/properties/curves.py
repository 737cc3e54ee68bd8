"""Common parts of the property figures: colours, oils of the source, the simpler viscosity laws matched to an oil."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from ...lubricants import AbstractViscosity, Barus, Lubricant, Roelands
from ...report.backends.matplotlib.legends import clear_legend
from ...report.backends.matplotlib.sheet import grid_lines, title_of
from ...report.display import ZERO_CELSIUS
from ...scenes.oil.catalogue import load_oil

if TYPE_CHECKING:
    import jax
    import matplotlib.axes

NAMES = {
    "mobil_jet_ii": "Mobil Jet II",
    "pennzane_x2000": "Pennzane SHF X2000",
    "nye_186a": "Nye 186A",
    "fomblin_z25": "Fomblin Z25",
}
DISK_RADIUS = 0.02
"""Reduced radius of the source's two-disk contact in both planes, m."""
STEEL_MODULUS = 225.275e9
"""Reduced modulus of steel on steel, Pa."""
MATCHED = (ZERO_CELSIUS + 40.0, ZERO_CELSIUS + 164.0)
"""Temperatures at which the laws of Barus and Roelands are matched, K: the two of Figure 26."""
MATCHED_PRESSURE = 50e6
"""Pressure at which they are matched at the first temperature, Pa: that of the source's coefficient alpha50."""


def kelvin(celsius: Any) -> "jax.Array":
    """K from °C."""
    return jnp.asarray(celsius, dtype=float) + ZERO_CELSIUS


def oil_named(oil: str | Lubricant) -> tuple[Lubricant, str]:
    """An oil of the catalogue, or one that is given, and its name on a figure.

    **Raises:** `SceneError` for a name that the catalogue does not have.
    """
    if isinstance(oil, Lubricant):
        return oil, "the oil"
    return load_oil(oil), NAMES.get(oil, oil)


def matched_barus(viscosity: AbstractViscosity) -> Barus:
    """Barus' law through three viscosities of another law: 40 °C at 0 and 50 MPa, 164 °C at 0."""
    base, pressure_rise, temperature_fall = _three_points(viscosity)
    inverse = 1.0 / MATCHED[1] - 1.0 / MATCHED[0]
    return Barus(np.exp(base), MATCHED[0], pressure_rise / MATCHED_PRESSURE, temperature_fall / inverse)


def matched_roelands(viscosity: AbstractViscosity) -> Roelands:
    """Roelands' law through the same three viscosities as `matched_barus`.

    Its exponents follow from ln mu + 9.67 = (ln mu_0 + 9.67)(1 + 5.1e-9 p)^Z [(T - 138)/(T_0 - 138)]^-S0.
    """
    base, pressure_rise, temperature_fall = _three_points(viscosity)
    height = base + 9.67
    exponent = np.log1p(pressure_rise / height) / np.log1p(5.1e-9 * MATCHED_PRESSURE)
    slope = -np.log1p(temperature_fall / height) / np.log((MATCHED[1] - 138.0) / (MATCHED[0] - 138.0))
    return Roelands(np.exp(base), MATCHED[0], exponent, slope)


def _three_points(viscosity: AbstractViscosity) -> tuple[np.float64, np.float64, np.float64]:
    """ln of the first viscosity, its rise to the second, its change to the third."""
    pressures, temperatures = jnp.array([0.0, MATCHED_PRESSURE, 0.0]), jnp.array([*MATCHED[:1], *MATCHED])
    base, squeezed, warm = np.asarray(viscosity.log_viscosity(pressures, temperatures))
    return base, squeezed - base, warm - base


def finish(
    axes: "matplotlib.axes.Axes", title: str, across: str, up: str, legend: str | None = None, columns: int = 1
) -> None:
    """Title, axis labels, grid and legend of one figure."""
    title_of(axes, title)
    axes.set_xlabel(across, fontsize=9)
    axes.set_ylabel(up, fontsize=9)
    grid_lines(axes)
    clear_legend(axes, title=legend, ncols=columns)
