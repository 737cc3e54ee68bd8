"""Builds the scene of a line contact from its valid table."""

import dataclasses

import jax
import numpy as np

from ...ehl import ContactBodies, ContactGeometry, ContactOperation, EHLLineContact, FilmModel, FilmSimulation
from ...ehl.mesh import INLET
from ...ehl.resolution import chosen
from ...time_laws import AbstractTimeFactor, LinearRamp, Ramp, Sinusoidal, Steady, Tabulated
from ..bearing.build import built
from ..materials import material
from ..oil.catalogue import lubricant
from .schema import (
    ACCURACIES,
    DEFAULT_ACCURACY,
    FilmModelTable,
    FilmSimulationTable,
    LineContactTable,
    SpeedRampTable,
)


def line_contact(table: LineContactTable) -> EHLLineContact:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    scene = built(
        EHLLineContact,
        geometry=lambda: ContactGeometry(**table.geometry.model_dump()),
        materials=lambda: ContactBodies(material(table.materials.body_1), material(table.materials.body_2)),
        oil=lambda: lubricant(table.oil),
        contact=lambda: _model(table.contact),
        operation=lambda: ContactOperation(**table.operation.model_dump()),
        simulation=lambda: None if table.simulation is None else _simulation(table.simulation),
    )
    # inside a traced program, too, the scene is made of known numbers
    with jax.ensure_compile_time_eval():
        return scene.replace({"contact": _fine_enough(scene, table.contact)})


def _model(table: FilmModelTable) -> FilmModel:
    """The settings of the contact before the mesh is adapted to the load (`_fine_enough`)."""
    nodes = table.nodes if table.nodes is not None else ACCURACIES[table.accuracy or DEFAULT_ACCURACY]
    inlet = INLET if table.inlet is None else table.inlet
    accuracy = table.accuracy if table.nodes is not None else table.accuracy or DEFAULT_ACCURACY
    return FilmModel(
        compressible=table.compressible, nodes=nodes, inlet=inlet, film_limit=table.film_limit, accuracy=accuracy
    )


def _fine_enough(scene: EHLLineContact, table: FilmModelTable) -> FilmModel:
    """The settings of the contact, with the nodes and the inlet length that the load needs if the table omits them."""
    scales, model = scene.scales(), scene.contact
    if not bool(scene.solvable(scales, scene.operation.entrainment_speed / scales.reference_speed)):
        return model
    accuracy = table.accuracy or DEFAULT_ACCURACY
    numbers = float(scene.film_ratio(scales)), float(scales.moes_material)
    nodes, inlet = chosen(accuracy, ACCURACIES[accuracy], *numbers, table.inlet)
    return dataclasses.replace(model, nodes=nodes if table.nodes is None else model.nodes, inlet=inlet)


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
