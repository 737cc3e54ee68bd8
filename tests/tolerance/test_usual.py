"""Usual tolerances of the inputs of a scene, and the ranking by them."""

import dataclasses
import fnmatch
import math

import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.bearings.priors import DRAG
from jaxbearing.catalogue.dimensions import clearance_limits
from jaxbearing.mounting import iso286
from jaxbearing.sensitivity import Sensitivities, UsualTolerance, effects
from jaxbearing.tolerance.usual import ASSUMED, usual_tolerances


def test_tolerances_of_standards():
    scene = jb.load_scene("deep_groove_6205_fitted")
    found = usual_tolerances(scene)
    assert found["geometry.bore"].size == pytest.approx(-0.5 * float(iso286.bore_limits(25e-3).lower))
    low, high = clearance_limits("deep_groove", "CN", 25.0)
    assert found["geometry.diametral_clearance"].size == pytest.approx(0.5e-6 * (high - low))
    assert "ISO 5753-1" in found["geometry.diametral_clearance"].reason
    pitch = iso286.shaft_limits("h6", 38.5e-3)
    assert found["geometry.pitch_diameter"].size == pytest.approx(0.5 * float(pitch.upper - pitch.lower))


def test_assumed_tolerances():
    scene = jb.load_scene("turbine_roller")
    found = usual_tolerances(scene)
    assert found["operation.oil_temperature"].size == 5.0
    assert found["operation.radial_load"].size == pytest.approx(2500.0)
    assert found["materials.rings.youngs_modulus"].size == pytest.approx(2.03e9)
    # nobody knows the drag: its tolerance is that of the assumed distribution
    assert found["drag.coefficient"].size == pytest.approx(0.3 * DRAG["roller"].log_deviation)
    assert all(one.size > 0.0 and one.reason for one in found.values())
    # constants of laws have none
    assert "oil.viscosity.c1" not in found


def test_distributions_of_the_scene_prevail():
    scene = jb.load_scene("deep_groove_6205")
    given = {"geometry.diametral_clearance": jb.Distribution.between(10e-6, 14e-6)}
    assert usual_tolerances(scene, given)["geometry.diametral_clearance"] == UsualTolerance(
        pytest.approx(2e-6), "as the scene says"
    )


def test_a_clearance_beyond_the_table():
    scene = jb.load_scene("deep_groove_6205").replace_geometry(bore=3.0, pitch_diameter=3.5)
    one = usual_tolerances(scene)["geometry.diametral_clearance"]
    assert one.size == pytest.approx(0.3 * 12e-6)
    assert "assumed" in one.reason


@pytest.mark.parametrize("name", jb.builtin_names())
def test_every_scene_has_some(name):
    found = usual_tolerances(jb.load_scene(name))
    assert found
    assert all(math.isfinite(one.size) for one in found.values())


def test_each_row_is_about_some_field():
    """No rule names a field that no class has."""
    fields = {"contact", "rib", "geometry", "materials", "operation", "oil", "cage", "flange", "drag", "rating"}
    fields |= {"temperatures", "thermal", "profile", "*"}
    for one in ASSUMED:
        assert (one.part > 0.0) != (one.size > 0.0)
        for path in one.paths:
            assert path.split(".")[0] in fields, path
    assert any(fnmatch.fnmatchcase("operation.axial_load", path) for one in ASSUMED for path in one.paths)


def test_effects_are_slopes_times_relative_tolerances():
    scene = jb.load_scene("deep_groove_6205")
    slopes = Sensitivities(
        life={"operation.radial_load": jnp.asarray(-3.0), "geometry.ball_diameter": jnp.asarray(2.0)},
        temperature={"operation.radial_load": jnp.asarray(40.0)},
    )
    tolerances = {
        "operation.radial_load": UsualTolerance(150.0, "assumed"),
        "operation.moment": UsualTolerance(1.0, "assumed"),
    }
    found = effects(scene, slopes, tolerances)
    # an input of 0 has no relative tolerance
    assert set(found["life"]) == {"operation.radial_load"}
    np.testing.assert_allclose(found["life"]["operation.radial_load"], -0.3, rtol=1e-12)
    np.testing.assert_allclose(found["temperature"]["operation.radial_load"], 4.0, rtol=1e-12)
    assert {field.name for field in dataclasses.fields(slopes)} >= set(found)
