"""A tapered bearing whose rib angle and end sphere are estimated."""

import jax
import numpy as np
import pytest
from tapered_cases import G1

import jaxbearing as jb
from jaxbearing.bearings.tapered.geometry import TaperedGeometry
from jaxbearing.catalogue.tapered import tapered_shape

UNKNOWN = {"geometry.flange_angle": "none", "geometry.end_radius": "none"}
DRY = {"contact": "none", "drag": "none"}


def without(*names):
    return TaperedGeometry(**{name: value for name, value in G1.items() if name not in names})


def test_what_is_given_stands():
    whole = TaperedGeometry(**G1)
    assert whole.rib_angle == G1["flange_angle"]
    assert whole.sphere_radius == G1["end_radius"]
    assert whole.assumptions() == []


def test_estimates_are_those_of_the_catalogue():
    estimated = without("flange_angle", "end_radius")
    sizes = (estimated.mean_roller_diameter, estimated.pitch_diameter, estimated.roller_length)
    shape = tapered_shape(*map(float, sizes), G1["contact_angle"])
    np.testing.assert_allclose(estimated.sphere_radius, shape.end_radius, rtol=1e-9)
    np.testing.assert_allclose(estimated.rib_angle, shape.flange_angle, rtol=1e-9)
    # 0.95 of the cone; the contact lies 0.8 of the big end's radius below the axis
    np.testing.assert_allclose(estimated.sphere_radius, 0.95 * estimated.apex_distance, rtol=1e-12)
    below = estimated.sphere_radius * np.sin(estimated.flange_tilt)
    np.testing.assert_allclose(below, 0.8 * 0.5 * G1["roller_diameter"], rtol=1e-12)


def test_the_angle_goes_with_a_given_sphere():
    angle = without("flange_angle")
    assert angle.sphere_radius == 108e-3
    below = 108e-3 * np.sin(angle.flange_tilt)
    np.testing.assert_allclose(below, 0.8 * 0.5 * G1["roller_diameter"], rtol=1e-12)
    assert [note.split(" ")[0] for note in angle.assumptions()] == ["geometry.flange_angle"]


def test_a_sphere_that_is_too_small_is_refused_all_the_same():
    with pytest.raises(ValueError, match=r"geometry\.end_radius must be above"):
        TaperedGeometry(**(G1 | {"flange_angle": None, "end_radius": 1e-3}))


def test_estimates_are_marked_and_follow_the_geometry(tmp_path):
    scene = jb.load_scene("tapered_example", {**UNKNOWN, **DRY})
    notes = [note for note in scene.assumptions() if note.startswith("geometry.")]
    assert len(notes) == 2
    assert all("estimated" in note for note in notes)
    slope = jax.grad(lambda size: scene.replace_geometry(roller_diameter=size).geometry.rib_angle)(7.95e-3)
    assert slope == pytest.approx(0.0, abs=1e-12)  # a larger roller of the same cone has the same angles
    jb.save_scene(scene, tmp_path / "a.toml")
    assert "flange_angle" not in (tmp_path / "a.toml").read_text(encoding="utf-8")
    assert jb.load_scene(tmp_path / "a.toml") == scene


@pytest.mark.slow
def test_a_bearing_with_estimates_is_that_with_these_numbers():
    scene = jb.load_scene("tapered_example", {**UNKNOWN, **DRY})
    solution = jb.solve(scene)
    assert set(scene.assumptions()) <= set(solution.notes)
    known = scene.replace_geometry(
        flange_angle=float(scene.geometry.rib_angle), end_radius=float(scene.geometry.sphere_radius)
    )
    np.testing.assert_allclose(jb.solve(known).elements.load_flange, solution.elements.load_flange, rtol=1e-12)


def test_the_drawing_names_what_is_known():
    labels = jb.load_scene("tapered_example", UNKNOWN).outline().labels
    assert set(labels) == {"roller_diameter", "roller_length", "contact_angle", "roller_half_angle"}
