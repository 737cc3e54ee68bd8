"""From a valid scene table to the scene of the library. Only Python and numpy numbers enter
the constructors: nothing runs on JAX."""

import numpy as np

from ..bearings.cylindrical_roller import CylindricalRollerBearing, RollerCage, RollerFlange, RollerGeometry
from ..bearings.parts import ContactLaws, Drag, Materials, Operation
from ..contacts import AbstractLineFilm, DowsonHigginson, Gupta, MartinBlend, MaxwellEyring, Moes, NoThermalReduction
from ..gaps import AbstractTurbulence, BlendedTurbulence, FullTurbulence, Laminar
from ..materials import CATALOGUE, Material
from .oils import lubricant
from .schema import CageTable, ContactTable, CylindricalRollerTable, MaterialTable, OperationTable

TURBULENCE: dict[str, type[AbstractTurbulence]] = {
    "laminar": Laminar,
    "blend": BlendedTurbulence,
    "pure": FullTurbulence,
}


def cylindrical_roller_bearing(table: CylindricalRollerTable) -> CylindricalRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    return CylindricalRollerBearing(
        geometry=RollerGeometry(**table.geometry.model_dump()),
        materials=Materials(rings=_material(table.materials.rings), rollers=_material(table.materials.rollers)),
        operation=_operation(table.operation),
        oil=None if table.oil is None else lubricant(table.oil),
        contact=None if table.contact is None else _contact(table.contact),
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


def _contact(table: ContactTable) -> ContactLaws:
    return ContactLaws(
        film=_film(table.film),
        thermal=NoThermalReduction() if table.thermal is None else Gupta(),
        traction=None if table.traction is None else MaxwellEyring(),
        entrainment_offset=table.entrainment_offset,
    )


def _film(name: str) -> AbstractLineFilm:
    # an elastohydrodynamic formula alone has a finite film at no load, where an unloaded roller needs Martin's
    return MartinBlend(DowsonHigginson()) if name == "dowson_higginson" else Moes()


def _cage(table: CageTable) -> RollerCage:
    return RollerCage(**{**table.model_dump(), "turbulence": TURBULENCE[table.turbulence]()})
