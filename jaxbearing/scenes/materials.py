"""Materials of a scene file: a name of the catalogue, or a table."""

from typing import Annotated, ClassVar

import numpy as np
from pydantic import BeforeValidator, Discriminator, Tag

from ..materials import CATALOGUE, THERMAL_FIELDS, Material, catalogue_material, material_named
from . import units
from .errors import nearest, one_of
from .table import Table
from .table_of import table_of
from .words import describe


class MaterialTable(table_of(Material)):
    """See `materials.Material`."""

    tag: ClassVar[str] = "<table>"


def catalogue_table(name: str) -> dict[str, str]:
    """A material of the catalogue as the fields of a table."""
    entry = catalogue_material(name, thermal=True)
    return {
        "youngs_modulus": f"{float(entry.youngs_modulus) * 1e-9:.6g} GPa",
        "poisson_ratio": f"{float(entry.poisson_ratio):.6g}",
        "density": f"{float(entry.density):.6g} kg/m^3",
        "thermal_expansion": f"{entry.thermal_expansion:.6g} 1/K",
        "conductivity": f"{entry.conductivity:.6g} W/(m*K)",
        "heat_capacity": f"{entry.heat_capacity:.6g} J/(kg*K)",
    }


def _material_name(value: object) -> str:
    # --set materials.rings=52100 arrives as a number
    name = str(value) if isinstance(value, int) and not isinstance(value, bool) else value
    known = material_named(name) if isinstance(name, str) else None
    if known is None:
        # "AISI M-50": the name of the standard in front hides that of the material
        near = (nearest(name, CATALOGUE) or nearest(name.split(" ")[-1], CATALOGUE)) if isinstance(name, str) else ""
        fields = ", ".join(MaterialTable.model_fields)
        expected = f"a material of the catalogue ({one_of(CATALOGUE)}) or a table with {fields}"
        raise units.refusal(expected, describe(value), near)
    return known


MaterialField = Annotated[
    Annotated[str, BeforeValidator(_material_name), Tag("<name>")] | Annotated[MaterialTable, Tag("<table>")],
    Discriminator(lambda value: "<table>" if isinstance(value, dict) else "<name>"),
]
"""A name of the catalogue, or a table."""


def material(field: str | MaterialTable, *, thermal: bool = False) -> Material:
    """The material that a valid field describes. **Arguments:** `thermal`: True to include thermal properties, which
    are left out if nothing in the scene depends on temperatures."""
    if isinstance(field, str):
        return catalogue_material(field, thermal=thermal)
    named = field.model_dump(exclude_none=True, exclude=set() if thermal else THERMAL_FIELDS)
    return Material(**{name: np.float64(value) for name, value in named.items()})


class RingMaterialsTable(Table):
    """Materials of the rings of a bearing.

    - `rings`: material of both rings, or of the outer ring alone if `inner_ring` is given
    - `inner_ring`: material of the inner ring; not given: that of `rings`
    """

    rings: MaterialField
    inner_ring: MaterialField | None = None
