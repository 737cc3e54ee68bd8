"""Nodes and inlet that an accuracy of the films takes, and that the promise holds under a heavy load."""

import dataclasses

import numpy as np
import pytest
from line_contacts import by_moes

import jaxbearing as jb
from jaxbearing.ehl.resolution import NODES, chosen, cut_error, mesh_error
from jaxbearing.ehl.solution import range_checks
from jaxbearing.scenes.line_contact.schema import ACCURACIES


@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_choice_follows_the_load(accuracy):
    """More nodes for a heavier load, a longer inlet for a lighter one, and the sum of both errors within what is asked,
    as far as the finest mesh goes."""
    ratios, fewest = np.geomspace(0.5, 600.0, 60), ACCURACIES[accuracy]
    found = [chosen(accuracy, fewest, x, 10.0, None) for x in ratios]
    nodes, inlets = np.array(found).T
    errors = [mesh_error(n, x, 10.0) + cut_error(i, x) for (n, i), x in zip(found, ratios, strict=True)]
    missed = np.array(errors) > accuracy * (1.0 + 1e-9)
    assert np.all(~missed | (nodes == NODES[-1]) | (inlets == 32.0))  # `test_missed_accuracy_is_said`
    assert np.all(nodes >= fewest)
    assert np.all(np.diff(inlets) <= 0)
    assert np.all(np.diff(nodes[inlets == 4.0]) >= 0)


@pytest.mark.slow
def test_promise_holds_under_a_heavy_load():
    """M = 100, L = 10: 201 nodes, once the mesh for 1e-2, are 1.3 % low (3 % at M = 200). Order 2: four thirds of the
    change with half the step is the error."""
    scene, _ = by_moes(100.0, 10.0)
    scales = scene.scales()
    ratio, material = float(scene.film_ratio(scales)), float(scales.moes_material)
    nodes, inlet = chosen(1e-2, ACCURACIES[1e-2], ratio, material, None)
    films = [film(scene, n, inlet) for n in (201, nodes, 2 * nodes - 1)]
    exact = films[2] + (films[2] - films[1]) / 3.0
    coarse, error = (np.max(np.abs(films[i] / exact - 1.0)) for i in (0, 1))
    assert coarse > 0.011
    assert error < 1e-2
    assert 1.0 < mesh_error(nodes, ratio, material) / error < 2.0


@pytest.mark.parametrize(
    ("times", "inlet", "missed"),
    [(1.0, None, False), (0.1, None, False), (16.0, None, True), (1.0, 4.0, True), (16.0, 4.0, True)],
)
def test_missed_accuracy_is_said(times, inlet, missed):
    """The satellite's contact at 3e-4 (M = 31): the finest mesh leaves more at 16 times its load, an inlet that is
    given leaves more at any."""
    load = jb.load_scene("satellite_contact_1").operation.load_per_length * times
    asked = {"contact.accuracy": 3e-4, "contact.inlet": "none" if inlet is None else inlet}
    found = jb.load_scene("satellite_contact_1", asked | {"operation.load_per_length": f"{load} N/m"})
    scales = found.scales()
    (said,) = (v for text, v in range_checks(found, scales).items() if "contact.accuracy of 0.0003 is missed" in text)
    ratio = found.film_ratio(scales)
    errors = mesh_error(found.contact.nodes, ratio, scales.moes_material), cut_error(found.contact.inlet, ratio)
    assert bool(said) == missed == (max(errors) > 3e-4)


def test_warnings_of_mesh_and_inlet():
    heavy = jb.solve(by_moes(200.0, 10.0, 101)[0])
    assert [text for text in heavy.warnings if "contact.nodes are too few" in text]
    light = jb.solve(by_moes(5.0, 5.0, 101, 16.0)[0])
    assert not [text for text in light.warnings if "contact.inlet" in text or "contact.nodes" in text]


def film(scene, nodes, inlet):
    scene = scene.replace({"contact": dataclasses.replace(scene.contact, nodes=nodes, inlet=inlet)})
    found = jb.solve(scene).film
    return np.array([float(found.central), float(found.minimum)])


def test_given_nodes_beside_an_accuracy():
    """The mesh is as given; the accuracy chooses the inlet, and a warning says where it is missed."""
    changes = {"contact.inlet": "none", "contact.accuracy": "1e-3"}
    scene = jb.load_scene("satellite_contact_1", {**changes, "contact.nodes": "101"})
    assert (scene.contact.nodes, scene.contact.accuracy) == (101, 1e-3)
    assert scene.contact.inlet == jb.load_scene("satellite_contact_1", changes).contact.inlet
    # a `--set` of one alone takes the other out
    assert jb.load_scene("satellite_contact_1", {"contact.nodes": "101"}).contact.accuracy is None
