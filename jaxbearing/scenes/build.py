"""From a valid scene table to the scene of the library. Only Python and numpy numbers enter
the constructors: nothing runs on JAX."""

import numpy as np

from ..bearings.cylindrical_roller import CylindricalRollerBearing, RollerCage, RollerFlange, RollerGeometry
from ..bearings.parts import Drag, Materials, Operation
from ..gaps import AbstractTurbulence, BlendedTurbulence, FullTurbulence, Laminar
from ..materials import CATALOGUE, Material
from .contact_laws import contact_laws
from .oils import lubricant
from .schema import CageTable, CylindricalRollerTable, MaterialTable, OperationTable

TURBULENCE: dict[str, type[AbstractTurbulence]] = {
    "laminar": Laminar,
    "blend": BlendedTurbulence,
    "pure": FullTurbulence,
}


def cylindrical_roller_bearing(table: CylindricalRollerTable) -> CylindricalRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = None if table.oil is None else lubricant(table.oil)
    return CylindricalRollerBearing(
        geometry=RollerGeometry(**table.geometry.model_dump()),
        materials=Materials(rings=_material(table.materials.rings), rollers=_material(table.materials.rollers)),
        operation=_operation(table.operation),
        oil=oil,
        contact=None if table.contact is None else contact_laws(table.contact, oil),
        cage=None if table.cage is None else _cage(table.cage),
        flange=None if table.flange is None else RollerFlange(**table.flange.model_dump()),
        drag=None if table.drag is None else Drag(**table.drag.model_dump()),
    )


def _operation(table: OperationTable) -> Operation:
    return Operation(**table.model_dump(exclude_none=True))


def _material(given: str | MaterialTable) -> Material:
    if isinstance(given, str):
        return CATALOGUE[given]
    return Material(**{name: np.float64(value) for name, value in given.model_dump().items()})


def _cage(table: CageTable) -> RollerCage:
    return RollerCage(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
