"""`tolerances`: screen, JSON, files, refusals, exit codes; what other verbs say of a distribution."""

import json
import os
import sys

import numpy as np
import pytest
import xarray as xr
from filled_results import MadeUpProgram, slopes_of, solution_of

import jaxbearing as jb
from jaxbearing.joint import JointDistribution
from jaxbearing.numerics.status import SolveError, Status
from jaxbearing.report.joint_file import write_joint

SCENE = "deep_groove_6205_fitted"
CLEARANCE = 'geometry.diametral_clearance={low="13 um", high="28 um"}'
SET = ("--set", CLEARANCE)


@pytest.fixture
def made_up(monkeypatch):
    """Results without a solve."""
    monkeypatch.setattr("jaxbearing.tolerance.verb.slopes_at", slopes_of)
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)


@pytest.mark.usefixtures("made_up")
def test_screen_and_files(jaxbearing_command, folder):
    command = ("tolerances", SCENE, *SET, "--samples", "30", "--out", "a.nc")
    result = jaxbearing_command(*command, "--plot", "a.png")
    assert (result.code, result.err) == (0, "")
    for word in (
        "CONVERGED",
        "fit.clearance",
        "Monte Carlo",
        "30 samples",
        "seed 0",
        "k5 and",
        "preload",
    ):
        assert word in result.out, word
    assert "wrote a_samples.nc" in result.out
    assert max(map(len, result.out.splitlines())) <= 100
    assert sorted(os.listdir(folder)) == ["a.nc", "a.png", "a_samples.nc"]
    with xr.open_dataset("a.nc") as found, xr.open_dataset("a_samples.nc") as samples:
        assert found.attrs["samples_count"] == samples.sizes["case"] == 30
        assert list(found.field.values) == [
            "geometry.diametral_clearance",
            "fits.shaft_interference",
            "fits.housing_interference",
        ]
        assert samples["fits_shaft_interference"].dims == ("case",)
    # the samples are there; others are not mixed in
    command = (*command, "--results", "fit.clearance,elements.contact_angle_inner[0]")
    again = jaxbearing_command(*command)
    assert again.code == 0
    assert "nothing is computed" in again.err
    other = jaxbearing_command(*command, "--seed", "1")
    assert other.code == 2
    assert "a_samples.nc" in other.err
    assert jaxbearing_command(*command, "--seed", "1", "--overwrite").code == 0


@pytest.mark.usefixtures("made_up")
def test_json(jaxbearing_command, folder):
    result = jaxbearing_command("tolerances", SCENE, *SET, "--json", "--results", "fit.clearance,ring_axial")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert found["converged"] is True
    assert list(found["tolerances"]) == ["fit.clearance", "ring.axial"]
    clearance = found["tolerances"]["fit.clearance"]
    assert {"mean", "deviation", "contributions", "low", "high", "worst_low", "derivatives"} <= set(clearance)
    assert clearance["monte_carlo"] is None
    assert found["samples"] is None
    np.testing.assert_allclose(sum(clearance["contributions"].values()), 1.0)
    assert not os.listdir(folder)


@pytest.mark.usefixtures("made_up")
@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((SCENE, "--results", "fit.clearence"), "--results: found 'fit.clearence', which this scene does not have"),
        ((SCENE, "--results", ","), "--results: found ','"),
        ((SCENE, "--samples", "1"), "--samples: found 1"),
        ((SCENE, "--out", "a.csv"), "--out: found 'a.csv'"),
        ((SCENE, "--plot", "a.bmp"), "--plot: found 'a.bmp'"),
        (("deep_groove_6205",), "deep_groove_6205: found no field that scatters"),
        (
            (SCENE, "--set", 'geometry.diametral_clearance={mean="1 um", deviation="-1 um"}'),
            "clearance.deviation: found",
        ),
        (
            ("turbine_ball", "--set", "contact.traction_accuracy={low=1e-4, high=1e-3}"),
            "contact.traction_accuracy: found",
        ),
        ((SCENE, "--samples", "9", "--workers", "1", "--scheduler", "tcp://a:1"), "--scheduler: found --workers"),
    ],
)
def test_bad_input(jaxbearing_command, folder, arguments, said):
    result = jaxbearing_command("tolerances", *arguments)
    assert result.code == 2
    assert result.out == ""
    assert result.err.startswith("error: ")
    assert said in result.err
    assert result.err.count("\n") == 1
    assert not os.listdir(folder)


def test_not_converged(jaxbearing_command, folder, monkeypatch):
    def fails(self, results=None):
        raise SolveError("diverged after 3 Newton steps", Status.DIVERGED)

    monkeypatch.setattr("jaxbearing.tolerance.verb.Analysis.tolerances", fails)
    screen = jaxbearing_command("tolerances", SCENE, "--out", "a.nc")
    assert screen.code == 3
    assert "NOT CONVERGED" in screen.out
    as_json = jaxbearing_command("tolerances", SCENE, "--json")
    assert as_json.code == 3
    assert json.loads(as_json.out) == {
        "converged": False,
        "status": "diverged",
        "failure": "diverged after 3 Newton steps",
    }
    assert not os.listdir(folder)


def test_other_verbs_take_the_mean_and_say_so(jaxbearing_command, folder, monkeypatch):
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)
    said = "geometry.diametral_clearance is given as a distribution: its mean, 20.50 um, is used"
    solved = jaxbearing_command("solve", SCENE, *SET, "--json")
    assert (solved.code, solved.err) == (0, "")
    assert any(said in text for text in json.loads(solved.out)["warnings"])
    shown = jaxbearing_command("solve", SCENE, *SET)
    assert "given as a distribution" in shown.out
    copied = jaxbearing_command("scenes", "--copy", SCENE, *SET)
    assert copied.code == 0
    assert said in copied.err
    (file,) = os.listdir(folder)
    assert float(jb.load_scene(file).geometry.diametral_clearance) == pytest.approx(20.5e-6, rel=1e-15)


def test_posterior_of_a_file(jaxbearing_command, folder):
    """A file of another kind is refused before the solve; one of a calibration scatters together."""
    (folder / "other.nc").write_text("x", encoding="utf-8")
    refused = jaxbearing_command("tolerances", "deep_groove_6205", "--posterior", "other.nc")
    assert (refused.code, refused.out) == (2, "")
    assert "--posterior: other.nc: " in refused.err
    fields = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
    positive, centre = np.array([False, True]), np.array([14e-6, 190e9])
    covariance = np.array([[1e-14, 0.9e-9], [0.9e-9, 1e-4]])
    joint = JointDistribution(fields, centre, positive, covariance)
    write_joint(joint, dict(zip(fields, ("m", "Pa"), strict=True)), folder / "fields.nc", "x")
    found = jaxbearing_command("tolerances", "deep_groove_6205", "--posterior", "fields.nc", "--json")
    assert found.code == 0, found.err
    said = json.loads(found.out)
    assert {said["fields"][path]["origin"] for path in fields} == {"posterior"}
    ring = said["tolerances"]["ring.radial"]
    slopes = np.array([ring["derivatives"][path] for path in fields])
    np.testing.assert_allclose(ring["deviation"] ** 2, slopes @ joint.of_values @ slopes, rtol=1e-9)
