"""Predictions of a calibrated scene: intervals with the covariance of the fields, before and after the measurements."""

import numpy as np
import pytest

import jaxbearing as jb
from fitting.posterior import Marginal, Posterior, Sampling
from jaxbearing.calibration import Options, distributions_of, joint_of, predict, predictive

CLEARANCE, MODULUS = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
LOADS = np.linspace(5e3, 40e3, 8)
pytestmark = pytest.mark.usefixtures("one_program")


def displacement(scene):
    return float(jb.solve(scene).ring.radial)


@pytest.fixture(scope="module")
def bearing():
    """Dry cylindrical rollers: the smallest program."""
    return jb.load_scene("reference_roller", {"contact": "none"}).replace({CLEARANCE: 12e-6})


@pytest.fixture(scope="module")
def found(bearing):
    true = bearing.replace({CLEARANCE: 14e-6, MODULUS: 190e9})
    noise = 1.0 + 0.003 * np.random.default_rng(5).normal(size=len(LOADS))
    values = np.array([displacement(true.at_operation(radial_load=load)) for load in LOADS]) * noise
    data = {"conditions": {"operation.radial_load": LOADS}, "measured": {"ring.radial": values}}
    priors = {CLEARANCE: jb.Distribution(12e-6, 3e-6), MODULUS: jb.Distribution.lognormal(200e9, 0.1)}
    return jb.calibrate(bearing, data, [CLEARANCE, MODULUS], priors=priors, options=Options())


def test_the_interval_is_that_of_the_covariance(bearing, found):
    """Against central differences of solves, with numpy alone; and it is far below the one before."""
    result = predict(found, bearing.at_operation(radial_load=30e3), ["ring.radial"])["ring.radial"]

    def at(clearance, modulus):
        changed = bearing.replace({CLEARANCE: clearance, MODULUS: modulus, "operation.radial_load": 30e3})
        return displacement(changed)

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


@pytest.fixture(scope="module")
def normal_posterior(found):
    """Samples from the normal distribution of least squares in coordinates, instead of those of the sampler."""
    rng = np.random.default_rng(2)
    centre = np.array([field.coordinate(found[field.path].value) for field in found.fields])
    drawn = rng.multivariate_normal(centre, found.covariance, size=(2, 500))
    values = np.stack([field.value(drawn[..., i]) for i, field in enumerate(found.fields)], axis=-1)
    marginal = Marginal(0.0, 0.0, 1.0, -2.0, 2.0, 1.0, 1000.0)
    scale = np.full((2, 500), found.scale)
    return Posterior(dict.fromkeys(found.fitted, marginal), drawn, values, scale, 0, 3.0, 0.95, Sampling())


def test_samples_predict_as_least_squares_does(bearing, found, normal_posterior):
    """The displacement is nearly linear in the fields: 200 normal samples have the deviation of the delta method."""
    scene = bearing.at_operation(radial_load=30e3)
    plain = predict(found, scene, ["ring.radial"])["ring.radial"]
    drawn = predict(found, scene, ["ring.radial"], posterior=normal_posterior)["ring.radial"]
    assert drawn.samples == 200
    assert plain.samples == 0
    # four standard errors of a deviation and of a median of 200 samples
    np.testing.assert_allclose(drawn.deviation, plain.deviation, rtol=4.0 / np.sqrt(400.0))
    assert abs(drawn.value - plain.value) < 4.0 * 1.2533 * plain.deviation / np.sqrt(200.0)
    assert drawn.lower < drawn.value < drawn.upper
    np.testing.assert_allclose(drawn.before.deviation, plain.before.deviation, rtol=1e-12)


def test_the_measured_values_are_predicted_again(found, normal_posterior):
    """Errors and fields scatter: the half-width is 1.96 deviations of both, as the slopes of the search have it."""
    again = predictive(found, normal_posterior)
    assert again.names == ("ring.radial",) * len(LOADS)
    assert again.samples == 200
    _, slopes = found.search.at(found.settled.problem, found.settled.u)
    fields = np.sqrt(np.einsum("vf,fg,vg->v", slopes, found.covariance, slopes)) * found.deviation
    half = 1.96 * np.hypot(fields, found.scale * found.deviation)
    # two quantiles of 200 samples each: four standard errors of their difference are 0.6 of the half-width
    np.testing.assert_allclose(0.5 * (again.upper - again.lower), half, rtol=0.4)
    assert 0.75 <= again.inside <= 1.0
    np.testing.assert_allclose(again.measured, found.measured, rtol=0.0)


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
    scene = bearing.at_operation(radial_load=30e3)
    expected = predict(found, scene, ["ring.radial"])["ring.radial"].deviation
    together = jb.tolerances(scene, results=["ring.radial"], posterior=joint_of(found))["ring.radial"]
    np.testing.assert_allclose(together.deviation, expected, rtol=2e-3)
    apart = jb.tolerances(scene, distributions_of(found), results=["ring.radial"])["ring.radial"]
    assert apart.deviation > 1.5 * together.deviation
    np.testing.assert_allclose(sum(together.contributions.values()), 1.0, rtol=1e-12)


def test_another_scene_must_have_a_field(found):
    with pytest.raises(ValueError, match="found none of the calibrated fields"):
        predict(found, jb.load_scene("satellite_contact_1"), ["film.central"])
