"""Predictions of a calibrated scene: intervals with the covariance of the fields, before and after the measurements."""

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.calibration import Options, distributions_of, joint_of, predict

CLEARANCE, MODULUS = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
LOADS = np.linspace(500.0, 4000.0, 8)


@pytest.fixture(scope="module")
def bearing():
    return jb.load_scene("deep_groove_6205")


@pytest.fixture(scope="module")
def found(bearing):
    fast = jb.jit_solver(bearing.replace({CLEARANCE: 14e-6, MODULUS: 190e9}))
    noise = 1.0 + 0.003 * np.random.default_rng(5).normal(size=len(LOADS))
    values = np.array([float(fast(radial_load=load).ring.radial) for load in LOADS]) * noise
    data = {"conditions": {"operation.radial_load": LOADS}, "measured": {"ring.radial": values}}
    priors = {CLEARANCE: jb.Distribution(12e-6, 3e-6), MODULUS: jb.Distribution.lognormal(200e9, 0.1)}
    return jb.calibrate(bearing, data, [CLEARANCE, MODULUS], priors=priors, options=Options())


def test_the_interval_is_that_of_the_covariance(bearing, found):
    """Against central differences of solves, with numpy alone; and it is far below the one before."""
    fast = jb.jit_solver(bearing)
    result = predict(found, bearing.at_operation(radial_load=3000.0), ["ring.radial"])["ring.radial"]

    def at(clearance, modulus):
        changed = bearing.replace({CLEARANCE: clearance, MODULUS: modulus, "operation.radial_load": 3000.0})
        return float(fast(changed).ring.radial)

    def deviation(clearance, modulus, covariance, unit):
        step = 1e-4
        first = (at(clearance + step * unit, modulus) - at(clearance - step * unit, modulus)) / (2.0 * step)
        second = (at(clearance, modulus * np.exp(step)) - at(clearance, modulus * np.exp(-step))) / (2.0 * step)
        slopes = np.array([first, second])
        return np.sqrt(slopes @ covariance @ slopes)

    values = found[CLEARANCE].value, found[MODULUS].value
    np.testing.assert_allclose(result.value, at(*values), rtol=1e-9)
    np.testing.assert_allclose(result.deviation, deviation(*values, found.covariance, 3e-6), rtol=1e-5)
    prior = deviation(12e-6, 200e9, np.diag([1.0, 0.01]), 3e-6)
    np.testing.assert_allclose(result.before.deviation, prior, rtol=1e-5)
    assert result.deviation < 0.1 * result.before.deviation
    assert result.lower < at(14e-6, 190e9) < result.upper


def test_the_fields_as_distributions(found):
    made = distributions_of(found)
    assert made[MODULUS].shape == "lognormal"
    np.testing.assert_allclose(made[MODULUS].nominal, found[MODULUS].value, rtol=1e-12)
    np.testing.assert_allclose(made[CLEARANCE].deviation, found[CLEARANCE].standard_error, rtol=1e-12)


def test_the_fields_together(found):
    """The covariance in SI units; its marginals are the distributions of the fields alone."""
    joint = joint_of(found)
    assert joint.fields == (CLEARANCE, MODULUS)
    marginals, alone = joint.marginals, distributions_of(found)
    for path in joint.fields:
        np.testing.assert_allclose(marginals[path].nominal, alone[path].nominal, rtol=1e-12)
        np.testing.assert_allclose(marginals[path].deviation, alone[path].deviation, rtol=1e-9)
    size = np.sqrt(np.diag(joint.covariance))
    np.testing.assert_allclose(joint.covariance / np.outer(size, size), found.correlation, rtol=1e-9)


def test_tolerances_count_what_the_fields_share(bearing, found):
    """The scatter of the displacement is the deviation of its prediction; of independent fields it is far wider."""
    scene = bearing.at_operation(radial_load=3000.0)
    expected = predict(found, scene, ["ring.radial"])["ring.radial"].deviation
    together = jb.tolerances(scene, results=["ring.radial"], posterior=joint_of(found))["ring.radial"]
    np.testing.assert_allclose(together.deviation, expected, rtol=2e-3)
    apart = jb.tolerances(scene, distributions_of(found), results=["ring.radial"])["ring.radial"]
    assert apart.deviation > 1.5 * together.deviation
    np.testing.assert_allclose(sum(together.contributions.values()), 1.0, rtol=1e-12)


def test_another_scene_must_have_a_field(found):
    with pytest.raises(ValueError, match="found none of the calibrated fields"):
        predict(found, jb.load_scene("satellite_contact_1"), ["film.central"])
