"""From a valid table of a line contact to the scene of the library."""

import numpy as np

from ..ehl import ContactBodies, ContactGeometry, ContactOperation, EHLLineContact, FilmModel, FilmSimulation
from ..ehl.mesh import INLET
from ..time_laws import AbstractTimeFactor, LinearRamp, Ramp, Sinusoidal, Steady, Tabulated
from .bearing_build import built
from .line_contact_schema import ACCURACIES, FilmModelTable, FilmSimulationTable, LineContactTable, SpeedRampTable
from .materials import material
from .oils import lubricant

DEFAULT_ACCURACY = 2e-3
LONG_INLETS = ((8.0, 16.0), (25.0, 8.0))
"""Moes load numbers M, and the inlet in half widths that a lighter load than that needs: its film reaches further out
than its Hertz width."""


def line_contact(table: LineContactTable) -> EHLLineContact:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    scene = built(
        EHLLineContact,
        geometry=lambda: ContactGeometry(**table.geometry.model_dump()),
        materials=lambda: ContactBodies(material(table.materials.body_1), material(table.materials.body_2)),
        oil=lambda: lubricant(table.oil),
        contact=lambda: _model(table.contact, INLET),
        operation=lambda: ContactOperation(**table.operation.model_dump()),
        simulation=lambda: None if table.simulation is None else _simulation(table.simulation),
    )
    if table.contact.inlet is not None:
        return scene
    return scene.replace({"contact": _model(table.contact, _inlet(scene))})


def _model(table: FilmModelTable, inlet: float) -> FilmModel:
    nodes = table.nodes if table.nodes is not None else ACCURACIES[table.accuracy or DEFAULT_ACCURACY]
    inlet = inlet if table.inlet is None else table.inlet
    return FilmModel(compressible=table.compressible, nodes=nodes, inlet=inlet, film_limit=table.film_limit)


def _inlet(scene: EHLLineContact) -> float:
    load = float(scene.scales().moes_load)
    return next((inlet for limit, inlet in LONG_INLETS if load < limit), INLET)


def _simulation(table: FilmSimulationTable) -> FilmSimulation:
    return FilmSimulation(duration=table.duration, speed=_speed(table), tolerance=table.tolerance)


def _speed(table: FilmSimulationTable) -> AbstractTimeFactor:
    if table.speed_table is not None:
        return Tabulated(np.asarray(table.speed_table.times), np.asarray(table.speed_table.factors))
    if table.speed_perturbation is not None:
        return Sinusoidal(**table.speed_perturbation.model_dump())
    return Steady() if table.speed_ramp is None else _ramp(table.speed_ramp)


def _ramp(table: SpeedRampTable) -> AbstractTimeFactor:
    numbers = table.model_dump(exclude={"shape"})
    return Ramp(**numbers) if table.shape == "smooth" else LinearRamp(**numbers)
