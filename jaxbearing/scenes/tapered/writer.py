"""The tables of a scene file from a tapered roller bearing: the way back from `tapered.build`."""

from ...bearings.tapered.scene import TaperedRollerBearing
from ...contacts import MeanPressureTraction
from ..bearing.simulation_writer import simulation
from ..bearing.writer import bearing_tables, cage, flow_law, march_accuracy, profile, raceway_laws
from ..laws import RIB_FILMS
from ..mixed import rib_mixed_rows
from ..part_writer import Rows, law_name, shown, unwritable
from .schema import TaperedCageTable, TaperedRollerTable


def tapered_tables(scene: TaperedRollerBearing) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    return bearing_tables(
        scene,
        TaperedRollerTable,
        profile=profile(scene.profile),
        contact=_laws(scene),
        cage=cage(TaperedCageTable, scene.cage),
        simulation=simulation(scene.simulation),
    )


def _laws(scene: TaperedRollerBearing) -> Rows | None:
    """The table [contact] of raceways and rib. Laws of the rib that it cannot express are noticed on reading it."""
    contact, rib = scene.contact, scene.rib
    if contact is None:
        return None
    if rib is None:
        raise unwritable("rib", "None", "the laws of the rib, which files have wherever they have those of raceways")
    entries = (
        raceway_laws(contact)
        | rib_mixed_rows(contact.mixed, rib.mixed)
        | {"flange_film": law_name(RIB_FILMS, rib.film, "rib.film")}
    )
    if contact.traction is None:
        return entries
    if not isinstance(contact.traction, MeanPressureTraction):
        raise unwritable("contact.traction", shown(contact.traction), "a MeanPressureTraction")
    if rib.traction is None:
        raise unwritable("rib.traction", "None", "a DistributedTraction, with the flow law of contact.traction")
    name = flow_law(contact.traction.viscous, scene.oil, "contact.traction.viscous")
    return entries | {"traction": name, "traction_accuracy": march_accuracy(rib.traction, "rib.traction", spin=True)}
