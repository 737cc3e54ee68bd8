"""The table [simulation] of a scene file from the settings of a run: the way back from `bearing.simulation`."""

from ...bearings.motion.settings import Simulation
from ...bearings.warming.settings import WarmUpSimulation
from ...time_laws import AbstractTimeFactor, LinearRamp, Ramp, Sinusoidal, Steady, Tabulated
from ..part_writer import Rows, all_rows, rows, shown, table_rows, unwritable
from .simulation import SimulationTable, WarmUpTable


def simulation(
    part: Simulation | WarmUpSimulation | None, table: type[SimulationTable] = SimulationTable
) -> Rows | None:
    """The table of a run; `None` if the scene has none.

    **Arguments:** `table`: schema of [simulation] for the kind of bearing.

    **Raises:** `SceneError` for what a file cannot hold.
    """
    if part is None:
        return None
    if isinstance(part, Simulation):
        entries, laws = rows(table, part), {"speed": part.speed, "load": part.load}
    else:
        entries = rows(WarmUpTable, part)
        names = ("speed", "load", "oil_inlet", "oil_flow")
        laws = {name: getattr(part, name) for name in names}
    for name, law in laws.items():
        entries |= _factor(law, name)
    return entries


def _factor(law: AbstractTimeFactor, name: str) -> Rows:
    match law:
        case Steady():
            return {}
        case Sinusoidal():
            return {f"{name}_perturbation": all_rows(law)}
        case Ramp():
            return {f"{name}_ramp": all_rows(law)}
        case LinearRamp():
            return {f"{name}_ramp": all_rows(law) | {"shape": "linear"}}
        case Tabulated():
            return {f"{name}_table": table_rows(law)}
    raise unwritable(f"simulation.{name}", shown(law), "Steady, Sinusoidal, Ramp, LinearRamp or Tabulated")
