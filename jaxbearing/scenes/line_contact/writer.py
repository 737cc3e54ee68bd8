"""The tables of a scene file from a line contact: the way back from `line_contact.build`."""

from collections.abc import Iterable, Mapping

from ...ehl import EHLLineContact, FilmSimulation
from ...ehl.mesh import INLET
from ...time_laws import LinearRamp, Ramp, Sinusoidal, Steady, Tabulated
from ..oil.files import Origin
from ..oil.writer import scene_oil, sourced_laws
from ..part_writer import Rows, all_rows, given, material, rows, shown, table_rows, unwritable
from ..toml_writer import comments, toml_text
from .schema import (
    ACCURACIES,
    DEFAULT_ACCURACY,
    ContactGeometryTable,
    ContactOperationTable,
    FilmModelTable,
    FilmSimulationTable,
)


def line_contact_tables(scene: EHLLineContact) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    bodies = scene.materials
    tables = {
        "kind": scene.kind,
        "geometry": rows(ContactGeometryTable, scene.geometry),
        "materials": {"body_1": material(bodies.body_1), "body_2": material(bodies.body_2)},
        "oil": scene_oil(scene.oil),
        "contact": rows(FilmModelTable, scene.contact),
        "operation": rows(ContactOperationTable, scene.operation),
        "simulation": None if scene.simulation is None else _simulation(scene.simulation),
    }
    return given(tables)


def line_contact_text(scene: EHLLineContact, header: Iterable[str], origins: Mapping[str, Origin] | None = None) -> str:
    """The text of a scene file that gives the sources of the oil data. If the scene has the default mesh, the file has
    `accuracy` in its place, so that the load chooses the mesh.

    **Arguments:** `header`: lines of comment at the top; `origins`: name of a law of the oil -> its origin.

    **Raises:** `ValueError` for a law of the oil that files do not know.
    """
    tables = line_contact_tables(scene) | {"oil": sourced_laws(scene.oil, origins)}
    if (scene.contact.nodes, scene.contact.inlet) == (ACCURACIES[DEFAULT_ACCURACY], INLET):
        left = {name: value for name, value in tables["contact"].items() if name not in ("nodes", "inlet")}
        tables["contact"] = left | {"accuracy": DEFAULT_ACCURACY}
    return comments(header) + "\n" + toml_text(tables)


def _simulation(part: FilmSimulation) -> Rows:
    entries = rows(FilmSimulationTable, part)
    match part.speed:
        case Steady():
            return entries
        case Ramp():
            return entries | {"speed_ramp": all_rows(part.speed) | {"shape": "smooth"}}
        case LinearRamp():
            return entries | {"speed_ramp": all_rows(part.speed) | {"shape": "linear"}}
        case Sinusoidal():
            return entries | {"speed_perturbation": all_rows(part.speed)}
        case Tabulated():
            return entries | {"speed_table": table_rows(part.speed)}
    raise unwritable("simulation.speed", shown(part.speed), "Steady, Ramp, LinearRamp, Sinusoidal or Tabulated")
