"""The tables of a scene file from a two-disk machine: the way back from `two_disk.build`."""

import equinox as eqx
import numpy as np

from ...contacts import GivenCompliance
from ...machines import DiskOperation, TwoDisk, TwoDiskLaws
from ..bearing.writer import flow_law, march_accuracy, thermal_law
from ..laws import ANY_FILMS, LINE_THERMAL, VISCOUS
from ..oil.writer import scene_oil
from ..part_writer import Rows, given, law_name, material, number, rows, same, shown, unwritable, written
from .schema import HALF_SPACE, DiskGeometryTable, DiskOperationTable

_SPACINGS = {"linear": np.linspace, "log": np.geomspace}


def two_disk_tables(scene: TwoDisk) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    bodies = scene.materials
    return {
        "kind": scene.kind,
        "geometry": rows(DiskGeometryTable, scene.geometry),
        "materials": {"body_1": material(bodies.body_1), "body_2": material(bodies.body_2)},
        "oil": scene_oil(scene.oil),
        "contact": _laws(scene),
        "operation": {"slide_to_roll": _slides(scene.operation)} | rows(DiskOperationTable, scene.operation),
    }


def _laws(scene: TwoDisk) -> Rows:
    contact: TwoDiskLaws = scene.contact
    traction = contact.traction
    return given(
        {
            "film": law_name(ANY_FILMS, contact.film, "contact.film"),
            "thermal": thermal_law(LINE_THERMAL, contact.thermal),
            "traction": flow_law(traction.viscous, scene.oil, "contact.traction.viscous", VISCOUS),
            "traction_accuracy": march_accuracy(traction, "contact.traction", spin=False),
            "compliance": HALF_SPACE if contact.half_space_compliance else _compliance(traction.compliance),
            "film_heating": traction.heating is not None,
            "inlet": "warm" if contact.warm_inlet else "cold",
            "elastic": traction.elastic,
        }
    )


def _compliance(law: eqx.Module | None) -> float | str | None:
    if law is not None and not isinstance(law, GivenCompliance):
        expected = "None or a GivenCompliance (files have that of half-spaces as contact.half_space_compliance)"
        raise unwritable("contact.traction.compliance", shown(law), expected)
    return None if law is None else number(law.value, "m/Pa")


def _slides(operation: DiskOperation) -> object:
    """A range where the ratios are evenly spaced, otherwise a number or a list of them."""
    ratios = np.asarray(operation.slide_to_roll)
    if ratios.ndim == 1 and ratios.size > 2:
        for spacing, space in _SPACINGS.items():
            start, stop, count = float(ratios[0]), float(ratios[-1]), ratios.size
            if (spacing == "linear" or start * stop > 0.0) and same(space(start, stop, count), ratios):
                return {"start": start, "stop": stop, "count": count, "spacing": spacing}
    return written(operation, "slide_to_roll")
