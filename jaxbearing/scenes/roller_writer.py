"""The tables of a scene file from a cylindrical roller bearing: the way back from `roller_build`."""

from ..bearings.cylindrical.scene import CylindricalRollerBearing
from ..bearings.motion.settings import Simulation
from ..contacts import AbstractTraction, DistributedTraction, MeanPressureTraction
from ..lubricants import Lubricant
from ..time_laws import AbstractTimeFactor, Ramp, Sinusoidal, Steady, Tabulated
from .bearing_writer import bearing_tables, cage, flow_law, march_accuracy, profile, raceway_laws
from .part_writer import Rows, all_rows, rows, shown, table_rows, unwritable
from .roller_schema import CageTable, CylindricalRollerTable
from .simulation_schema import SimulationTable


def roller_tables(scene: CylindricalRollerBearing) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    contact = scene.contact
    laws = None
    if contact is not None:
        laws = raceway_laws(contact) | _traction(contact.traction, scene.oil)
    return bearing_tables(
        scene,
        CylindricalRollerTable,
        profile=profile(scene.profile),
        contact=laws,
        cage=cage(CageTable, scene.cage),
        simulation=None if scene.simulation is None else _simulation(scene.simulation),
    )


def _traction(traction: AbstractTraction | None, oil: Lubricant | None) -> Rows:
    if traction is None:
        return {}
    if not isinstance(traction, MeanPressureTraction | DistributedTraction):
        raise unwritable("contact.traction", shown(traction), "a MeanPressureTraction or a DistributedTraction")
    found: Rows = {"traction": flow_law(traction.viscous, oil, "contact.traction.viscous")}
    if isinstance(traction, MeanPressureTraction):
        return found | {"traction_model": "mean_pressure"}
    accuracy = march_accuracy(traction, "contact.traction", spin=False)
    return found | {"traction_model": "distributed", "traction_accuracy": accuracy}


def _simulation(part: Simulation) -> Rows:
    return rows(SimulationTable, part) | _factor(part.speed, "speed") | _factor(part.load, "load")


def _factor(law: AbstractTimeFactor, name: str) -> Rows:
    match law:
        case Steady():
            return {}
        case Sinusoidal():
            return {f"{name}_perturbation": all_rows(law)}
        case Ramp():
            return {f"{name}_ramp": all_rows(law)}
        case Tabulated():
            return {f"{name}_table": table_rows(law)}
    expected = "Steady, Sinusoidal, Ramp or Tabulated"
    raise unwritable(f"simulation.{name}", shown(law), expected)
