"""Fields that are given as distributions: the mean in the scene, what is said of it, what is refused."""

import warnings

import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing import Distribution, MeanUsedWarning, SceneError

SCENE = "deep_groove_6205_fitted"
CLEARANCE = "geometry.diametral_clearance"


def read(value, path=CLEARANCE):
    with pytest.warns(MeanUsedWarning) as said:
        scene = jb.load_scene(SCENE, {path: value})
    return scene, jb.load_distributions(SCENE, {path: value})[path], str(said[0].message)


def test_mean_and_deviation():
    scene, found, said = read('{mean = "13 um", deviation = "0.5 um"}')
    assert found == Distribution(13e-6, 0.5e-6, "normal")
    plain = jb.load_scene(SCENE, {CLEARANCE: "13 um"})
    assert float(scene.geometry.diametral_clearance) == float(plain.geometry.diametral_clearance)
    assert said.startswith("geometry.diametral_clearance is given as a distribution: its mean, 13.00 um, is used")
    np.testing.assert_allclose([found.lowest, found.highest], [11.5e-6, 14.5e-6], rtol=1e-14)


def test_limits():
    scene, found, _ = read('{low = "5 um", high = "20 um"}')
    np.testing.assert_allclose([found.mean, found.deviation], [12.5e-6, 2.5e-6], rtol=1e-14)
    np.testing.assert_allclose([found.lowest, found.highest], [5e-6, 20e-6], rtol=1e-14)
    assert float(scene.geometry.diametral_clearance) == found.mean
    _, even, _ = read('{low = "5 um", high = "20 um", shape = "uniform"}')
    np.testing.assert_allclose(even.deviation, 15e-6 / np.sqrt(12.0), rtol=1e-14)
    np.testing.assert_allclose([even.lowest, even.highest], [5e-6, 20e-6], rtol=1e-14)


def test_numbers_without_a_unit_and_temperatures():
    _, found, said = read("{low = 0.51, high = 0.52}", "geometry.conformity_inner")
    np.testing.assert_allclose(found.deviation, 0.01 / 6.0, rtol=1e-12)
    assert "0.515" in said
    _, warm, _ = read('{mean = "80 degC", deviation = "2 K"}', "temperatures.inner_ring")
    assert warm == Distribution(353.15, 2.0)


def test_part_of_a_distribution_and_one_value_by_set():
    overrides = {CLEARANCE: '{mean = "13 um", deviation = "0.5 um"}', f"{CLEARANCE}.deviation": "1 um"}
    assert jb.load_distributions(SCENE, overrides)[CLEARANCE].deviation == 1e-6
    assert not jb.load_distributions(SCENE)


def test_tables_of_a_program():
    tables = {
        "kind": "ball_bearing",
        "geometry": {"n_balls": 9, "ball_diameter": 7.938e-3, "pitch_diameter": 38.5e-3}
        | {"conformity_inner": 0.515, "conformity_outer": 0.525}
        | {"diametral_clearance": {"low": np.float64(5e-6), "high": 20e-6}},
        "materials": {"rings": "52100", "balls": "52100"},
        "kinematics": {"attitude": "outer"},
        "operation": {"inner_speed": 600.0, "radial_load": 1500.0},
    }
    with pytest.warns(MeanUsedWarning, match="12.50 um"):
        scene = jb.scene_from_mapping(tables)
    np.testing.assert_allclose(scene.geometry.diametral_clearance, 12.5e-6, rtol=1e-14)


def test_a_scene_without_distributions_says_nothing():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        jb.load_scene(SCENE)


REFUSED = {
    ("geometry.diametral_clearance", '{mean = "13 um", deviation = "-1 um"}'): (".deviation", ">= 0"),
    ("geometry.diametral_clearance", '{low = "13 um", high = "8 um"}'): (".low", "at most the high limit, '8 um'"),
    ("geometry.diametral_clearance", '{low = "8 um", high = "13 N"}'): (".high", "a length with a unit"),
    ("geometry.diametral_clearance", '{mean = 13e-6, deviation = "1 um"}'): (".mean", "a length with a unit"),
    ("geometry.diametral_clearance", '{mean = "13 um", low = "8 um"}'): ("", "either 'mean' and 'deviation', or"),
    ("geometry.diametral_clearance", '{mean = "13 um"}'): ("", "either 'mean' and 'deviation', or"),
    ("geometry.diametral_clearance", '{shape = "normal"}'): ("", "either 'mean' and 'deviation', or"),
    ("geometry.diametral_clearance", '{mean = "13 um", deviation = "1 um", shape = "flat"}'): (".shape", "'uniform'"),
    ("geometry.diametral_clearance", '{mean = "13 um", deviation = "1 um", sigma = 2}'): (".sigma", "'deviation'"),
    ("geometry.ball_diameter", '{low = "-1 mm", high = "8 mm"}'): (".low", "a length > 0"),
    ("geometry.n_balls", "{low = 8, high = 10}"): ("", "one value"),
    ("fits.at", '{mean = "mean", deviation = "1 um"}'): ("", "one value"),
    ("temperatures.inner_ring", '{mean = "80 degC", deviation = "2 degC"}'): (".deviation", "temperature difference"),
    ("geometry.conformity_inner", '{mean = 0.515, deviation = "1 um"}'): (".deviation", "a number >= 0"),
}


@pytest.mark.parametrize(("path", "value"), REFUSED)
def test_refused(path, value):
    place, expected = REFUSED[path, value]
    with pytest.raises(SceneError) as error:
        jb.load_scene(SCENE, {path: value})
    assert len(error.value.problems) == 1
    assert error.value.path == path + place
    assert expected in error.value.expected
    assert f"--set {path}=" in error.value.file


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((1.0, -1.0), "deviation must be >= 0"),
        ((1.0, float("nan")), "finite"),
        ((1.0, 1.0, "gauss"), "shape must be"),
        ((1.0, 1.0, "normal", 2.0), "low must be at most the mean"),
    ],
)
def test_no_distribution(arguments, said):
    with pytest.raises(ValueError, match=said):
        Distribution(*arguments)
    with pytest.raises(ValueError, match="low must be at most high"):
        Distribution.between(2.0, 1.0)


def test_samples_have_mean_and_deviation():
    random = np.random.default_rng(1)
    normal, uniform = random.standard_normal(400_000), random.random(400_000)
    for shape in ("normal", "uniform"):
        values = Distribution(3.0, 0.5, shape).samples(normal, uniform)
        np.testing.assert_allclose([values.mean(), values.std()], [3.0, 0.5], rtol=3e-3)


# lognormal ones


def test_lognormal_in_a_file():
    changes = {"operation.radial_load": '{median = "1 kN", log_deviation = 0.2, high = "1.5 kN"}'}
    (found,) = jb.load_distributions(SCENE, changes).values()
    assert found == Distribution.lognormal(1000.0, 0.2, high=1500.0)
    with pytest.warns(jb.MeanUsedWarning, match="its median, 1000 N, is used"):
        scene = jb.load_scene(SCENE, changes)
    assert float(scene.operation.radial_load) == 1000.0
    limits = jb.load_distributions(
        SCENE, {"operation.radial_load": '{low = "1 kN", high = "4 kN", shape = "lognormal"}'}
    )
    np.testing.assert_allclose(limits["operation.radial_load"].median, 2000.0, rtol=1e-12)
    moments = {"operation.radial_load": '{mean = "1 kN", deviation = "100 N", shape = "lognormal"}'}
    (found,) = jb.load_distributions(SCENE, moments).values()
    assert (found.mean, found.deviation) == (1000.0, 100.0)
    with pytest.warns(jb.MeanUsedWarning):
        assert float(jb.load_scene(SCENE, moments).operation.radial_load) == found.median < 1000.0


@pytest.mark.parametrize(
    ("value", "place"),
    [
        ('{median = "1 kN"}', ""),
        ('{median = "1 kN", log_deviation = "2"}', ".log_deviation"),
        ('{median = "1 kN", log_deviation = -2}', ".log_deviation"),
        ('{median = "1 kN", log_deviation = 0.2, high = "0.9 kN"}', ""),
        ('{median = "1 kN", log_deviation = 0.2, shape = "normal"}', ""),
        ('{median = "1 m", log_deviation = 0.2}', ".median"),
        ('{low = "0 N", high = "1 kN", shape = "lognormal"}', ".low"),
    ],
)
def test_no_lognormal_distribution(value, place):
    with pytest.raises(SceneError) as error:
        jb.load_scene(SCENE, {"operation.radial_load": value})
    assert error.value.path == "operation.radial_load" + place


@pytest.mark.parametrize("limits", [(None, None), (None, 1.2), (0.1, None), (0.1, 0.5)])
def test_moments_and_quantiles_of_lognormal(limits):
    found = Distribution.lognormal(0.3, 0.9, *limits)
    shares = (np.arange(200_001) + 0.5) / 200_001
    values = found.quantiles(shares)
    np.testing.assert_allclose([values.mean(), values.std()], [found.mean, found.deviation], rtol=3e-3)
    assert np.all(np.diff(values) >= 0.0)
    if limits[0] is not None:
        assert values.min() >= limits[0] == found.lowest
    if limits[1] is not None:
        assert values.max() <= limits[1] == found.highest
    if limits == (None, None):
        np.testing.assert_allclose(found.mean, 0.3 * np.exp(0.5 * 0.81), rtol=1e-12)
        np.testing.assert_allclose(np.median(values), 0.3, rtol=1e-6)


def test_lognormal_without_spread_is_a_number():
    found = Distribution.lognormal(2.0, 0.0)
    assert (found.mean, found.deviation, found.lowest, found.highest) == (2.0, 0.0, 2.0, 2.0)
    assert np.all(found.quantiles(np.array([0.0, 0.5, 1.0])) == 2.0)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Distribution(-1.0, 1.0, "lognormal"), "must be > 0"),
        (lambda: Distribution(1.0, 1.0, "lognormal", median=1.0), "belong together"),
        (lambda: Distribution(1.0, 1.0, median=1.0), "lognormal"),
        (lambda: Distribution.lognormal(0.0, 1.0), "median must be > 0"),
        (lambda: Distribution.lognormal(1.0, -1.0), "log_deviation must be >= 0"),
        (lambda: Distribution.lognormal(1.0, 1.0, high=0.5), "at most the median"),
        (lambda: Distribution.between(0.0, 1.0, "lognormal"), "must be > 0"),
    ],
)
def test_no_lognormal_class(make, said):
    with pytest.raises(ValueError, match=said):
        make()
