"""From a valid table of a cylindrical roller bearing to the scene of the library. Only Python and numpy numbers enter
the constructors: nothing runs on JAX."""

from ..bearings.cylindrical_roller import CylindricalRollerBearing, RollerCage, RollerFlange, RollerGeometry
from ..bearings.parts import Drag, Materials, Operation
from .contact_laws import contact_laws
from .materials import material
from .oils import lubricant
from .roller_schema import CageTable, CylindricalRollerTable, OperationTable
from .turbulence import TURBULENCE


def cylindrical_roller_bearing(table: CylindricalRollerTable) -> CylindricalRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = None if table.oil is None else lubricant(table.oil)
    return CylindricalRollerBearing(
        geometry=RollerGeometry(**table.geometry.model_dump()),
        materials=Materials(rings=material(table.materials.rings), rollers=material(table.materials.rollers)),
        operation=_operation(table.operation),
        oil=oil,
        contact=None if table.contact is None else contact_laws(table.contact, oil),
        cage=None if table.cage is None else _cage(table.cage),
        flange=None if table.flange is None else RollerFlange(**table.flange.model_dump()),
        drag=None if table.drag is None else Drag(**table.drag.model_dump()),
    )


def _operation(table: OperationTable) -> Operation:
    return Operation(**table.model_dump(exclude_none=True))


def _cage(table: CageTable) -> RollerCage:
    return RollerCage(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
