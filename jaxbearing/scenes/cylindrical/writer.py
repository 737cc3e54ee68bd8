"""The tables of a scene file from a cylindrical roller bearing: the way back from `cylindrical.build`."""

from ...bearings.cylindrical.scene import CylindricalRollerBearing
from ...contacts import AbstractTraction, DistributedTraction, MeanPressureTraction
from ...lubricants import Lubricant
from ..bearing.simulation_writer import simulation
from ..bearing.writer import bearing_tables, cage, flow_law, march_accuracy, profile, raceway_laws
from ..mixed import mixed_rows
from ..part_writer import Rows, shown, unwritable
from .schema import CageTable, CylindricalRollerTable


def roller_tables(scene: CylindricalRollerBearing) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    contact = scene.contact
    laws = None
    if contact is not None:
        laws = raceway_laws(contact) | _traction(contact.traction, scene.oil) | mixed_rows(contact.mixed)
    return bearing_tables(
        scene,
        CylindricalRollerTable,
        profile=profile(scene.profile),
        contact=laws,
        cage=cage(CageTable, scene.cage),
        simulation=simulation(scene.simulation),
    )


def _traction(traction: AbstractTraction | None, oil: Lubricant | None) -> Rows:
    if traction is None:
        return {}
    if not isinstance(traction, MeanPressureTraction | DistributedTraction):
        raise unwritable("contact.traction", shown(traction), "a MeanPressureTraction or a DistributedTraction")
    entries: Rows = {"traction": flow_law(traction.viscous, oil, "contact.traction.viscous")}
    if isinstance(traction, MeanPressureTraction):
        return entries | {"traction_model": "mean_pressure"}
    accuracy = march_accuracy(traction, "contact.traction", spin=False)
    return entries | {"traction_model": "distributed", "traction_accuracy": accuracy}
