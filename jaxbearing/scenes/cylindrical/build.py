"""Builds the scene of a cylindrical roller bearing from its valid table. Only Python and numpy numbers enter the
constructors: nothing runs on JAX."""

from functools import cache

from ...bearings.cylindrical.geometry import RollerCage, RollerFlange, RollerGeometry
from ...bearings.cylindrical.scene import CylindricalRollerBearing
from ...bearings.motion.settings import Simulation
from ...bearings.operation import Operation
from ...bearings.parts import Drag, Materials
from ...bearings.rating import Rating
from ...bearings.warming.settings import WarmUpSimulation
from ..bearing.build import built, cage, part, seats, shapes, solids
from ..bearing.profile import roller_profile
from ..bearing.simulation import simulation, warm_up
from ..contact_laws import contact_laws
from ..oil.catalogue import lubricant
from .schema import CylindricalRollerTable


def cylindrical_roller_bearing(table: CylindricalRollerTable) -> CylindricalRollerBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = cache(lambda: None if table.oil is None else lubricant(table.oil))
    return built(
        CylindricalRollerBearing,
        geometry=lambda: RollerGeometry(**table.geometry.model_dump()),
        materials=lambda: Materials(**solids(table, "rings", "rollers", "cage", "inner_ring")),
        operation=lambda: Operation(**table.operation.model_dump(exclude_none=True)),
        oil=oil,
        contact=lambda: None if table.contact is None else contact_laws(table.contact, oil()),
        cage=lambda: cage(RollerCage, table.cage),
        flange=lambda: part(RollerFlange, table.flange),
        drag=lambda: part(Drag, table.drag),
        simulation=lambda: _run(table),
        rating=lambda: part(Rating, table.rating),
        **seats(table),
        profile=lambda: roller_profile(table.profile),
        **shapes(table),
    )


def _run(table: CylindricalRollerTable) -> Simulation | WarmUpSimulation | None:
    if table.simulation is None:
        return None
    if table.thermal is not None:
        return warm_up(table)
    load = table.operation.radial_load
    return simulation(table.simulation, table.operation.inner_speed, 0.0 if load is None else load)
