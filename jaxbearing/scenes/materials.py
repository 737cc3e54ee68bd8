"""Materials of a scene file: a name of the catalogue, or a table."""

from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import BeforeValidator, Discriminator, Tag

from ..materials import CATALOGUE, Material
from . import units
from .errors import nearest, one_of
from .table_of import table_of


class MaterialTable(table_of(Material)):
    """See `materials.Material`."""

    tag: ClassVar[str] = "<table>"


def catalogue_table(name: str) -> dict[str, str]:
    """A material of the catalogue as the fields of a table."""
    one = CATALOGUE[name]
    return {
        "youngs_modulus": f"{float(one.youngs_modulus) * 1e-9:.6g} GPa",
        "poisson_ratio": f"{float(one.poisson_ratio):.6g}",
        "density": f"{float(one.density):.6g} kg/m^3",
    }


def _material_name(value: Any) -> str:
    # --set materials.rings=52100 arrives as a number
    name = str(value) if isinstance(value, int) and not isinstance(value, bool) else value
    if not isinstance(name, str) or name not in CATALOGUE:
        # "AISI M-50": the standard's name in front hides the material's
        near = (nearest(name, CATALOGUE) or nearest(name.split(" ")[-1], CATALOGUE)) if isinstance(name, str) else ""
        fields = ", ".join(MaterialTable.model_fields)
        expected = f"a material of the catalogue ({one_of(CATALOGUE)}) or a table with {fields}"
        raise units.refusal(expected, units.describe(value), near)
    return name


MaterialField = Annotated[
    Annotated[str, BeforeValidator(_material_name), Tag("<name>")] | Annotated[MaterialTable, Tag("<table>")],
    Discriminator(lambda value: "<table>" if isinstance(value, dict) else "<name>"),
]
"""A name of the catalogue, or a table."""


def material(given: str | MaterialTable) -> Material:
    """The material that a valid field means."""
    if isinstance(given, str):
        return CATALOGUE[given]
    return Material(**{name: np.float64(value) for name, value in given.model_dump().items()})
