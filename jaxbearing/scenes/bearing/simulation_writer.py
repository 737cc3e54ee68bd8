"""The table [simulation] of a scene file from the settings of a run: the way back from `bearing.simulation`."""

from ...bearings.motion.settings import Simulation
from ...time_laws import AbstractTimeFactor, Ramp, Sinusoidal, Steady, Tabulated
from ..part_writer import Rows, all_rows, rows, shown, table_rows, unwritable
from .simulation import SimulationTable


def simulation(part: Simulation | None) -> Rows | None:
    """The table of a run; `None` if the scene has none. **Raises:** `SceneError` for what a file cannot hold."""
    if part is None:
        return None
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
