"""The posterior of a calibrated bearing: the sampler runs through the solves and agrees with least squares where the
results are nearly linear in the fields."""

import numpy as np
import pytest

import jaxbearing as jb
from fitting.posterior import Sampling, available
from jaxbearing.calibration import posterior_of, predict, predictive

pytestmark = [
    pytest.mark.slow,
    # NumPyro is an extra of the package; `.[test]`, which README and CI install, has it, so these tests run there
    pytest.mark.skipif(not available(), reason="NumPyro is not installed"),
]

CLEARANCE, MODULUS = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
SCENE = "deep_groove_6205"
LOADS = np.linspace(500.0, 4000.0, 10)


@pytest.fixture(scope="module")
def found():
    """Displacements with errors of 0.3 %: fields vary by a per cent, within which they are nearly linear."""
    bearing = jb.load_scene(SCENE)
    fast = jb.jit_solver(bearing.replace({CLEARANCE: 14e-6, MODULUS: 190e9}))
    noise = 1.0 + 0.003 * np.random.default_rng(1).normal(size=len(LOADS))
    values = np.array([float(fast(radial_load=load).ring.radial) for load in LOADS]) * noise
    data = {"conditions": {"operation.radial_load": LOADS}, "measured": {"ring.radial": values}}
    return jb.calibrate(bearing, data, [CLEARANCE, MODULUS])


@pytest.fixture(scope="module")
def drawn(found):
    return posterior_of(found, Sampling(samples=1000))


def test_the_chains_agree_with_least_squares(found, drawn):
    """Asked: R-hat < 1.01. Ends of intervals: those of Student's distribution within Monte Carlo errors and 2 %, the
    curvature of the results within their interval."""
    assert drawn.mixed, drawn.warnings
    for path, one in drawn.parameters.items():
        assert one.r_hat < 1.01
        least = found[path]
        width = least.upper - least.lower
        # a mean, and a quantile whose density is 0.35 over the deviation, four standard errors each
        assert abs(one.mean - least.value) < (4.0 / np.sqrt(one.effective) + 0.1) * least.standard_error
        for end, other in ((one.lower, least.lower), (one.upper, least.upper)):
            assert abs(end - other) < (0.6 * 4.0 / np.sqrt(one.effective) + 0.02) * width


def test_predictions_of_samples_and_of_least_squares_agree(found, drawn):
    scene = jb.load_scene(SCENE).at_operation(radial_load=3000.0)
    samples = predict(found, scene, ["ring.radial"], posterior=drawn)["ring.radial"]
    plain = predict(found, scene, ["ring.radial"])["ring.radial"]
    assert abs(samples.value - plain.value) < 0.4 * plain.deviation
    # the deviation of Student's distribution with 8 degrees is 1.15 of the standard error; 200 samples tell 20 %
    np.testing.assert_allclose(samples.deviation, np.sqrt(8.0 / 6.0) * plain.deviation, rtol=0.25)
    again = predictive(found, drawn)
    assert again.inside >= 0.8
