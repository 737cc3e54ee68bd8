"""Elastic materials of rings, rolling elements and cages."""

import dataclasses
import re
from typing import ClassVar

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ._types import Scalar
from .numerics.arguments import require_choice
from .numerics.checks import Checked, bounded, demand, label, numbers_or_none

BALL_PRESSURE, ROLLER_PRESSURE = 4.2e9, 4.0e9
"""Hertz pressure of the most loaded contact of hardened steel at the static rating, Pa (ISO 76, [M])."""


class Material(Checked):
    """A linear elastic, isotropic, homogeneous solid.

    **Validity:** small strains at room temperature; bearing steel loses about 4 % of its modulus at 150 C,
    which is not modelled.
    """

    part: ClassVar[str] = "material"

    youngs_modulus: Scalar = bounded("> 0", unit="Pa")
    poisson_ratio: Scalar = bounded("between 0 and 0.5", unit="1")
    density: Scalar = bounded("> 0", unit="kg/m^3")
    thermal_expansion: Scalar | None = bounded(">= 0", default=None, metadata=label("1/K", "thermal expansion"))
    conductivity: Scalar | None = bounded("> 0", default=None, metadata=label("W/(m K)", "thermal conductivity"))
    heat_capacity: Scalar | None = bounded("> 0", default=None, metadata=label("J/(kg K)", "specific heat capacity"))


Material.__init__.__doc__ = """**Arguments:**
- `youngs_modulus`: modulus of elasticity, Pa, > 0.
- `poisson_ratio`: Poisson's ratio.
- `density`: mass over volume, kg/m^3, > 0.
- `thermal_expansion`: linear coefficient, 1/K; `conductivity`, W/(m K); `heat_capacity`, J/(kg K): only what depends on
  temperatures needs them.
"""


def reduced_modulus(a: Material, b: Material) -> Float[Array, ""]:
    r"""$E' = 2/[(1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2]$, Pa.

    Two equal bodies give $E/(1-\nu^2)$; a rigid partner doubles it. This is the modulus of the film
    formulas (source, section 3.1) and *twice* the contact modulus E* of Johnson's *Contact Mechanics*.
    """
    compliance_a = (1.0 - a.poisson_ratio * a.poisson_ratio) / a.youngs_modulus
    compliance_b = (1.0 - b.poisson_ratio * b.poisson_ratio) / b.youngs_modulus
    return jnp.asarray(2.0 / (compliance_a + compliance_b), dtype=float)


def _material(youngs_modulus: float, poisson_ratio: float, density: float) -> Material:
    # numpy scalars, not jax arrays: importing the package must not start a device.
    return Material(np.float64(youngs_modulus), np.float64(poisson_ratio), np.float64(density))


CATALOGUE: dict[str, Material] = {
    # Handbook values of the aero-engine steel AISI M50, room temperature.
    "M50": _material(203e9, 0.29, 7870.0),
    # Handbook values of the bearing steel AISI 52100 (100Cr6), hardened, room temperature.
    "52100": _material(208e9, 0.30, 7830.0),
    # Handbook values of hot isostatically pressed silicon nitride for hybrid bearings.
    "Si3N4": _material(310e9, 0.26, 3200.0),
    # The source names bronze for the cage of its roller bearing without numbers: these are decided (tin bronze).
    "bronze": _material(110e9, 0.34, 8800.0),
    # Generic steel, the rounded values under which the roller bearing of the source is computed.
    "steel": _material(210e9, 0.30, 7850.0),
    # Handbook values of wrought aluminium alloys and of grey cast iron, of which housings are made.
    "aluminium": _material(72e9, 0.33, 2750.0),
    "cast_iron": _material(110e9, 0.26, 7200.0),
}
"""Materials by name. A new one is a new line here, or a `Material` built by the user."""

ALIASES: dict[str, str] = {
    **dict.fromkeys(("100cr6", "aisi52100", "sae52100", "suj2", "gcr15", "13505"), "52100"),
    **dict.fromkeys(("aisim50", "80mocrv42", "80mocrv4216", "13551"), "M50"),
    **dict.fromkeys(("ceramic", "siliconnitride"), "Si3N4"),
    **dict.fromkeys(("aluminum", "aluminiumalloy"), "aluminium"),
    **dict.fromkeys(("greycastiron", "graycastiron", "greyiron", "grayiron"), "cast_iron"),
}
"""Further names of materials, in lower case and without spaces, dots, dashes and underscores. Ceramic rolling elements
are of silicon nitride."""

THERMAL_FIELDS = {"thermal_expansion", "conductivity", "heat_capacity"}

_THERMAL: dict[str, tuple[float, float, float]] = {
    "M50": (12.3e-6, 46.0, 460.0),
    "52100": (12.5e-6, 46.0, 460.0),
    "Si3N4": (3.2e-6, 25.0, 700.0),
    "bronze": (18e-6, 60.0, 380.0),
    "steel": (12.5e-6, 46.0, 460.0),
    "aluminium": (23.5e-6, 150.0, 900.0),
    "cast_iron": (10.5e-6, 50.0, 500.0),
}
"""Thermal expansion, 1/K, conductivity, W/(m K), heat capacity, J/(kg K). That of bearing steel comes from a maker's
catalogue, the others are handbook values: expansions to 5 %, conductivities and heat capacities to 20 %."""


def material_named(text: str) -> str | None:
    """The name in `CATALOGUE` of a material that a person may call "100Cr6", "m-50" or "ceramic"; `None` for a name
    that stands for no material of the catalogue."""
    plain = re.sub(r"[\s._-]+", "", text).lower()
    by_lower = {name.replace("_", "").lower(): name for name in CATALOGUE}
    return by_lower.get(plain) or ALIASES.get(plain)


def catalogue_material(name: str, *, thermal: bool = False) -> Material:
    """A material of `CATALOGUE`.

    **Arguments:** `name`: that of the catalogue, or another usual one (`ALIASES`); `thermal`: with its thermal
    properties, which only what depends on temperatures needs.

    **Raises:** `ValueError` for a name that the catalogue does not have.
    """
    name = (material_named(name) if isinstance(name, str) else None) or name
    require_choice("name", name, tuple(CATALOGUE))
    if not thermal:
        return CATALOGUE[name]
    expansion, conductivity, capacity = map(np.float64, _THERMAL[name])
    return dataclasses.replace(
        CATALOGUE[name], thermal_expansion=expansion, conductivity=conductivity, heat_capacity=capacity
    )


LARGEST_STRAIN = 0.01
"""Interference over diameter beyond which nothing stays elastic: hardened steel yields at about 2 GPa of 207 GPa."""


def check_interference(name: str, interference: object, diameter: object) -> None:
    """**Arguments:** lengths, m; one that is not given or that a file has wrong is passed over.

    **Raises:** `ValueError` for an interference that would stretch steel rings beyond their yield strength.
    """
    sizes = numbers_or_none(interference, diameter)
    if sizes is None:
        return
    demand(
        f"{name} must be no interference beyond a hundredth of the diameter",
        sizes[0] <= LARGEST_STRAIN * sizes[1],
        lambda: (
            f"{name}: found an interference of {1e3 * float(sizes[0]):g} mm on a diameter of "
            f"{1e3 * float(sizes[1]):g} mm, expected at most a hundredth of it, where hardened steel yields; check "
            "sign and unit"
        ),
    )
