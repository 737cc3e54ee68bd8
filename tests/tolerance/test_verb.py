"""The verb in Python: names of results, what is refused, samples beside derivatives, runs that are stopped."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from filled_results import MadeUpProgram, slopes_of, solution_of

import jaxbearing as jb
from jaxbearing import Distribution, SceneError
from jaxbearing.plots import tolerances as draw
from jaxbearing.tolerance import Spread
from jaxbearing.tolerance.monte_carlo import cases_of, sampled
from jaxbearing.tolerance.results import Label, labels_of, names_in, values_of
from jaxbearing.tolerance.scatter import scatter_of
from jaxbearing.tolerance.tables import tolerances_to_dataset, tolerances_to_dict

UM = 1e-6
CLEARANCE = {"geometry.diametral_clearance": {"low": 13 * UM, "high": 28 * UM}}


@pytest.fixture
def made_up(monkeypatch):
    """Results without a solve."""
    monkeypatch.setattr("jaxbearing.tolerance.verb.slopes_at", slopes_of)
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)


@pytest.fixture(scope="module")
def mounted_scene():
    return jb.load_scene("deep_groove_6205_fitted")


def test_classes_of_seats_become_distributions(mounted_scene):
    found = scatter_of(mounted_scene)
    shaft, housing = found.fields["fits.shaft_interference"], found.fields["fits.housing_interference"]
    np.testing.assert_allclose([shaft.mean / UM, shaft.low / UM, shaft.high / UM], [11.5, 2.0, 21.0], rtol=1e-12)
    np.testing.assert_allclose(
        [housing.mean / UM, housing.low / UM, housing.high / UM], [-9.5, -31.0, 12.0], rtol=1e-12
    )
    # shaft and bore are made apart: a sixth of each tolerance
    np.testing.assert_allclose(shaft.deviation / UM, np.hypot(9.0, 10.0) / 6.0, rtol=1e-12)
    np.testing.assert_allclose(housing.deviation / UM, np.hypot(30.0, 13.0) / 6.0, rtol=1e-12)
    assert found.origins["fits.shaft_interference"] == "k5 and the normal class of the bearing"
    assert found.scene.fits.shaft_tolerance is None


def test_seats_at_a_limit_do_not_scatter(mounted_scene):
    tightest = mounted_scene.replace({"fits.at": "tightest"})
    with pytest.raises(ValueError, match="no field that scatters"):
        scatter_of(tightest)
    found = scatter_of(tightest, CLEARANCE)
    assert list(found.fields) == list(CLEARANCE)
    assert "fits.at = 'tightest'" in found.notes[0]
    assert found.scene.fits.shaft_tolerance == "k5"


@pytest.mark.parametrize(
    ("over", "error", "said"),
    [
        ({"geometry.diametral_clearance": 1.0}, ValueError, "geometry.diametral_clearance: found 1.0"),
        ({"geometry.diametral_clearance": {"mean": 1e-5}}, ValueError, "either mean and deviation, or low and high"),
        ({"geometry.diametral_clearance": {"low": 2.0, "high": 1.0}}, ValueError, "clearance: low must be at most"),
        ({"geometry.n_balls": Distribution(9.0, 1.0)}, ValueError, "geometry.n_balls"),
        ({"geometry.play": Distribution(9.0, 1.0)}, AttributeError, "geometry.play"),
        ([1.0], ValueError, "over must map"),
    ],
)
def test_refused(mounted_scene, over, error, said):
    with pytest.raises(error, match=said):
        scatter_of(mounted_scene, over)


def test_settings_do_not_scatter(tmp_path):
    """A number from which the scene computes others has no place in it."""
    file = tmp_path / "set.toml"
    text = jb.scenes.data_files.builtin_text("turbine_ball")
    file.write_text(text.replace("traction_accuracy  = 1e-3", "traction_accuracy = {low = 1e-4, high = 1e-3}"))
    with pytest.raises(SceneError, match=r"contact\.traction_accuracy"):
        jb.tolerances(file)


def test_names_of_results(mounted_scene):
    solution = solution_of(mounted_scene)
    names = names_in(solution, None)
    assert names[:3] == ("fit.clearance", "fit.contact_angle", "elements.contact_angle_inner[0]")
    assert "ring.axial" in names
    assert "power_loss.total" not in names
    wanted = ["fit_clearance", "contact_angle_inner[2]", "fit.clearance"]
    assert names_in(solution, wanted) == ("fit.clearance", "elements.contact_angle_inner[2]")
    labels = labels_of(solution, ("elements.contact_angle_inner[2]", "force[0]"))
    assert labels["elements.contact_angle_inner[2]"].unit == "rad"
    assert labels["elements.contact_angle_inner[2]"].variable == "contact_angle_inner"
    assert labels["force[0]"].unit == "N"
    value = values_of(solution, ("elements.contact_angle_inner[2]",))["elements.contact_angle_inner[2]"]
    assert float(value) == float(solution.elements.contact_angle_inner[2])
    lossy = solution_of(jb.load_scene("turbine_roller"))
    assert {"power_loss.total", "ring.radial"} <= set(names_in(lossy, None))


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("fit.clearence", "did you mean 'fit.clearance'"),
        ("contact_angle_inner", r"9 numbers; expected one of them, 'contact_angle_inner\[0\]'"),
        ("contact_angle_inner[9]", "a place from 0 to 8"),
        ("fit.clearance[0]", "expected no place"),
        ("iterations", "a count"),
        ("", "does not have"),
    ],
)
def test_refused_results(mounted_scene, name, said):
    with pytest.raises(ValueError, match=said):
        names_in(solution_of(mounted_scene), [name])


def test_samples_are_those_of_the_seed(mounted_scene):
    scatter = scatter_of(mounted_scene, CLEARANCE)
    first, again, other = cases_of(scatter, 500, 7), cases_of(scatter, 2000, 7), cases_of(scatter, 500, 8)
    for path, values, longer, others in zip(first.paths, first.values, again.values, other.values, strict=True):
        np.testing.assert_array_equal(values, longer[:500])
        assert not np.any(values == others)
        one = scatter.fields[path]
        np.testing.assert_allclose(longer.mean(), one.mean, atol=4 * one.deviation / np.sqrt(2000))
        np.testing.assert_allclose(longer.std(), one.deviation, rtol=0.08)
    for count, seed in ((1, 0), (True, 0), (2.5, 0), (10, -1)):
        with pytest.raises(ValueError, match="found"):
            cases_of(scatter, count, seed)


def test_statistics_of_samples_and_their_errors():
    """Errors of mean and deviation, against the spread of many repeats; failed samples are left out and counted."""
    random = np.random.default_rng(3)
    values = random.standard_normal((400, 1000)) ** 2
    repeats = [sampled(_dataset(row), {"loss": Label("W", "loss", "loss", ())})["loss"] for row in values]
    for word in ("mean", "deviation"):
        spread = np.std([getattr(one, word) for one in repeats])
        # the spread of 400 repeats is itself known to 1/sqrt(800) = 3.5 %: four times that
        np.testing.assert_allclose(np.mean([getattr(one, f"{word}_error") for one in repeats]), spread, rtol=0.15)
    row = _dataset(values[0], failed=(3, 5))
    found = sampled(row, {"loss": Label("W", "loss", "loss", ())})["loss"]
    assert found.values.size == 998
    np.testing.assert_allclose(found.mean, np.delete(values[0], [3, 5]).mean(), rtol=1e-14)


def _dataset(values, failed=()):
    failure = np.full(values.size, "", dtype=object)
    failure[list(failed)] = "diverged"
    return xr.Dataset({"loss": ("case", values), "failure": ("case", failure)})


@pytest.mark.usefixtures("made_up")
def test_outputs(mounted_scene, tmp_path):
    found = jb.tolerances(mounted_scene, CLEARANCE, samples=20, out=tmp_path / "samples.nc")
    assert found.samples is not None
    assert (found.samples.count, found.samples.converged, found.samples.failures) == (20, 20, {})
    data = tolerances_to_dataset(found, "6205")
    spread = found["fit.clearance"]
    chosen = data.sel(result="fit.clearance", field="geometry.diametral_clearance")
    assert float(chosen.deviation) == spread.deviation
    assert float(chosen.contributions) == spread.contributions["geometry.diametral_clearance"]
    assert str(chosen.result_units.values) == str(chosen.field_units.values) == "m"
    assert set(data.data_vars) >= {"mean", "worst_low", "derivatives", "monte_carlo_mean_error", "field_deviation"}
    said = tolerances_to_dict(found)
    assert said["tolerances"]["fit.clearance"]["monte_carlo"]["mean"] == spread.sampled.mean
    assert said["samples"]["seed"] == 0
    for one in found.results.values():
        np.testing.assert_allclose(sum(one.contributions.values()), 1.0, rtol=1e-9)
    figure = draw(found, ["fit.clearance", "ring.axial"])
    assert len(figure.axes) == 4
    with pytest.raises(ValueError, match="expected some of"):
        draw(found, ["life"])


@pytest.fixture(scope="module")
def rated():
    """The mounted 6205 with a life, dry: its losses are none."""
    return jb.load_scene("deep_groove_6205_fitted", {"rating.grooves": "scene"})


FIELDS = CLEARANCE | {"operation.radial_load": {"mean": 1500.0, "deviation": 60.0}}


@pytest.mark.slow
def test_samples_agree_with_derivatives(rated, tmp_path):
    """Delta method and samples of the whole solve; a run that is stopped goes on, and gives the same file."""
    calls = []

    def stop(count):
        calls.append(count)
        if len(calls) == 6:
            raise KeyboardInterrupt

    arguments = {"samples": 2000, "seed": 5, "chunk": 500, "devices": 1}
    with pytest.raises(KeyboardInterrupt):
        jb.tolerances(rated, FIELDS, out=tmp_path / "a.nc", progress=stop, **arguments)
    assert list((tmp_path / "a.nc.chunks").glob("chunk-*.npz"))
    kept = []
    found = jb.tolerances(rated, FIELDS, out=tmp_path / "a.nc", progress=kept.append, **arguments)
    assert kept[0] >= 500  # cases of the first run at once
    whole = jb.tolerances(rated, FIELDS, **arguments)
    for name, spread in found.results.items():
        one = spread.sampled
        np.testing.assert_array_equal(one.values, whole[name].sampled.values)
        if name in ("fit.contact_angle", "elements.contact_angle_inner[0]"):
            continue  # not linear: notes say so
        np.testing.assert_allclose(spread.mean, one.mean, atol=5 * one.mean_error, err_msg=name)
        np.testing.assert_allclose(spread.deviation, one.deviation, atol=5 * one.deviation_error, err_msg=name)
    _, slopes = jb.sensitivities(rated)
    by_load = found["life.L10r"].derivatives["operation.radial_load"] * 1500.0 / found["life.L10r"].value
    # the clearance of `rated` is not the mean of the fields: 2 % of a slope
    np.testing.assert_allclose(by_load, slopes.life["operation.radial_load"], rtol=0.05)


@pytest.mark.slow
def test_failed_samples_are_counted():
    """A groove that may be narrower than the ball: such samples have no results, and say why."""
    scene = jb.load_scene("deep_groove_6205", {"contact": "none"})
    fields = {"geometry.conformity_inner": {"mean": 0.502, "deviation": 0.0015}}
    found = jb.tolerances(scene, fields, samples=200, results=["ring.radial"])
    failed = sum(found.samples.failures.values())
    assert found.samples.converged + failed == 200
    # below 0.5 are 9 %
    assert 5 < failed < 40
    assert all("conformity_inner" in text for text in found.samples.failures)
    assert found["ring.radial"].sampled.values.size == found.samples.converged


def test_round_off_is_no_scatter():
    still = Spread(2.0, 2.0, 1e-12, 2.0, 2.0 + 1e-12, "m", "still", {"a": 1.0}, {"a": 1.0})
    assert not still.moves
    assert replace(still, worst_high=2.1).moves
    assert replace(still, deviation=1e-6).moves
