"""From a valid table of a cylindrical roller bearing to the scene of the library. Only Python and numpy numbers enter
the constructors: nothing runs on JAX."""

from ..bearings.cylindrical_roller import CylindricalRollerBearing, RollerCage, RollerFlange, RollerGeometry
from ..bearings.parts import Drag, Materials, Operation
from ..bearings.rating import Rating
from .bearing_build import cage, part
from .contact_laws import contact_laws
from .materials import material
from .oils import lubricant
from .profile_schema import roller_profile
from .roller_schema import CylindricalRollerTable
from .simulation_schema import simulation


def cylindrical_roller_bearing(table: CylindricalRollerTable) -> CylindricalRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = None if table.oil is None else lubricant(table.oil)
    speed, load = table.operation.inner_speed, table.operation.radial_load
    return CylindricalRollerBearing(
        geometry=RollerGeometry(**table.geometry.model_dump()),
        materials=Materials(
            rings=material(table.materials.rings),
            rollers=material(table.materials.rollers),
            cage=None if table.materials.cage is None else material(table.materials.cage),
        ),
        operation=Operation(**table.operation.model_dump(exclude_none=True)),
        oil=oil,
        contact=None if table.contact is None else contact_laws(table.contact, oil),
        cage=cage(RollerCage, table.cage),
        flange=part(RollerFlange, table.flange),
        drag=part(Drag, table.drag),
        simulation=None if table.simulation is None else simulation(table.simulation, speed, load),
        rating=part(Rating, table.rating),
        profile=roller_profile(table.profile),
    )
