"""Property laws as the source draws them. Its curves are pictures that nobody can read off: the numbers here are the
package's own, from the source's tables and equations."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
import numpy as np

from ..contacts import DistributedTraction, NijenbanningVennerMoes, PointContact, Resolution, Sliding, contact_patch
from ..lubricants import Lubricant
from ..report.display import ZERO_CELSIUS
from ..report.sheet import grid_lines
from ..scenes.oils import load_oil
from .style import COLOURS, finish, prepare

if TYPE_CHECKING:
    import matplotlib.figure

ONLY_OURS = " The source's curves are pictures: not compared."
STEEL_MODULUS = 225.275e9
"""Reduced modulus of steel on steel, Pa, of the reference curves."""


def viscosity_against_pressure(
    oil: str = "mobil_jet_ii", temperatures: Sequence[float] = (40.0, 82.0, 124.0, 164.0), *, axes: Any = None
) -> "matplotlib.figure.Figure":
    """Viscosity over pressure at some temperatures (source Figures 25 and 31 to 33).

    **Arguments:** `oil`: a name of the catalogue; `temperatures`: degC; `axes`: to draw into.
    """
    own, axes, law = axes is None, prepare(axes), load_oil(oil).viscosity
    pressure = jnp.linspace(0.0, 1e9, 101)
    for number, celsius in enumerate(temperatures):
        values = jnp.exp(law.log_viscosity(pressure, celsius + ZERO_CELSIUS))
        colour = COLOURS[number % len(COLOURS)]
        axes.semilogy(1e-6 * np.asarray(pressure), np.asarray(values), color=colour, label=f"{celsius:g} °C")
    _name(axes, "pressure, MPa", "dynamic viscosity, Pa s")
    return finish(axes, f"Viscosity of {oil}, law of the catalogue (source Figures 25, 31-33)." + ONLY_OURS, own)


def pressure_viscosity(
    oils: Sequence[str] = ("mobil_jet_ii", "pennzane_x2000", "nye_186a", "fomblin_z25"), *, axes: Any = None
) -> "matplotlib.figure.Figure":
    """Inverse isoviscous asymptotic pressure alpha* over temperature (source Figures 27 and 34).

    **Arguments:** `oils`: names of the catalogue; `axes`: to draw into.
    """
    own, axes = axes is None, prepare(axes)
    celsius = np.linspace(20.0, 150.0, 66)
    for number, oil in enumerate(oils):
        values = load_oil(oil).pressure_viscosity.coefficient(jnp.asarray(celsius + ZERO_CELSIUS))
        axes.plot(celsius, 1e9 * np.asarray(values), color=COLOURS[number % len(COLOURS)], label=oil)
    _name(axes, "temperature, °C", "alpha*, 1/GPa")
    return finish(axes, "Coefficient of film formulas, alpha* (source Figures 27, 34)." + ONLY_OURS, own)


def film_against_temperature(oil: str = "mobil_jet_ii", *, axes: Any = None) -> "matplotlib.figure.Figure":
    """Central film of Nijenbanning, Venner and Moes over temperature at 1.05 GPa, R = 20 mm, both surfaces at 40 m/s
    (source Figure 28), isothermal. **Arguments:** `oil`: a name of the catalogue; `axes`: to draw into."""
    own, axes, lubricant = axes is None, prepare(axes), load_oil(oil)
    celsius = np.linspace(20.0, 150.0, 66)
    axes.plot(celsius, 1e6 * film_at(lubricant, jnp.asarray(celsius + ZERO_CELSIUS)), color=COLOURS[0], label=oil)
    _name(axes, "temperature, °C", "central film, µm")
    return finish(axes, "Central film, 1.05 GPa, R = 20 mm, 40 m/s (source Figure 28)." + ONLY_OURS, own)


def film_at(oil: Lubricant, temperature: Any) -> np.ndarray:
    """Film of Figure 28, m. **Arguments:** `temperature`: K."""
    contact, load = _ball_on_disk()
    inlet = oil.at(temperature)
    law = NijenbanningVennerMoes()
    return np.exp(np.asarray(law.log_thickness(contact, load, 40.0, inlet.viscosity, inlet.pressure_viscosity)))


def traction_against_rheology(
    parameter: str = "shear_modulus",
    factors: Sequence[float] = (0.1, 0.3, 1.0, 3.0, 10.0),
    *,
    axes: Any = None,
) -> "matplotlib.figure.Figure":
    """Traction of Mobil Jet II at 24 degC with G or tau0 times some factors (source Figures 22 and 23): 1.05 GPa,
    R = 20 mm, mean speed 21.175 m/s, film 0.4 µm held, isothermal.

    **Arguments:** `parameter`: "shear_modulus" or "stress"; `factors`: multiples of the oil's; `axes`: to draw into.

    **Raises:** `ValueError` for another parameter.
    """
    import equinox as eqx

    if parameter not in ("shear_modulus", "stress"):
        raise ValueError(f"parameter: found {parameter!r}, expected 'shear_modulus' or 'stress'")
    own, axes, oil = axes is None, prepare(axes), load_oil("mobil_jet_ii")
    contact, load = _ball_on_disk()
    patch, slide = contact_patch(contact, load), jnp.linspace(0.0, 0.1, 41)
    law = DistributedTraction(resolution=Resolution(32, 8))
    of = lambda lubricant: law.traction(patch, 4e-7, 21.175, Sliding(21.175 * slide), 297.15, lubricant).rolling / load
    compiled = eqx.filter_jit(of)
    for number, factor in enumerate(factors):
        where = lambda o: getattr(o.rheology, parameter)
        changed = eqx.tree_at(where, oil, jnp.asarray(factor * where(oil), dtype=float))
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(100.0 * np.asarray(slide), np.asarray(compiled(changed)), color=colour, label=f"x {factor:g}")
    _name(axes, "slide-to-roll ratio, %", "traction coefficient")
    name, figure = ("shear modulus G", 22) if parameter == "shear_modulus" else ("stress tau0", 23)
    return finish(axes, f"Traction with multiples of the {name} (source Figure {figure})." + ONLY_OURS, own)


def _ball_on_disk() -> tuple[PointContact, Any]:
    contact = PointContact(0.02, 0.02, STEEL_MODULUS)
    return contact, contact.load_at_pressure(1.05e9)


def _name(axes: Any, x: str, y: str) -> None:
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.legend(fontsize=8, frameon=False)
    grid_lines(axes)
