"""A few rows of the table of accuracies (`accuracy.py`) hold."""

import accuracy
import numpy as np
import pytest
from reference_oils import mobil_jet_ii

import jaxbearing as jb
from jaxbearing.contacts import PRESETS, SPIN_PRESETS, ReeEyring, Resolution


def test_presets_of_contacts_that_spin():
    """With 1e-2 asked: 95 % of forces and powers within it, where the preset without spin is twice as far off."""
    presets = (SPIN_PRESETS[1e-2], PRESETS[1e-2])
    errors = accuracy.spin_errors(ReeEyring(), mobil_jet_ii(), presets, 40, Resolution(48, 128, extrapolate=True))
    force, _, power = np.quantile(errors[presets[0]], 0.95, axis=1)
    assert force < 1e-2
    assert power < 1e-2
    assert np.quantile(errors[presets[1]][0], 0.95) > 2.0 * force


@pytest.mark.parametrize(
    ("name", "part", "presets"),
    [
        ("turbine_ball", lambda scene: scene.contact, SPIN_PRESETS),
        ("tapered_example", lambda scene: scene.rib, SPIN_PRESETS),
        ("turbine_roller", lambda scene: scene.contact, PRESETS),
        ("two_disk_mobil_jet_ii", lambda scene: scene.contact, PRESETS),
    ],
)
def test_scenes_take_the_presets_of_their_contacts(name, part, presets):
    for asked in (1e-2, 1e-4):
        changes = {"contact.traction_accuracy": f"{asked:g}"}
        if name == "turbine_roller":
            changes["contact.traction_model"] = "distributed"
        assert part(jb.load_scene(name, changes)).traction.resolution == presets[asked]


def test_laminae_and_quadrature():
    _, *laminae = accuracy.lamina_rows(True)
    whole, part = next((float(row[1]), float(row[2])) for row in laminae if row[0] == "30")
    assert whole < 1e-4
    assert part < 1e-2
    _, *alpha = accuracy.alpha_rows(True)
    assert float(alpha[-1][1]) < 1e-8
