"""`fit`: measured curves to parameters, intervals, oil file and picture; refusals, exit codes, what is printed."""

import dataclasses
import json
import os
import sys
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO

import numpy as np
import pytest
from fit_results import MEDIAN, SWEEPS, made_up

import jaxbearing as jb
from fitting.measurements import MeasurementError
from fitting.parameters import NAMES
from fitting.posterior import available
from jaxbearing.cli.main import main

SLOPES = ["shear_modulus_pressure", "shear_modulus_temperature", "stress_pressure", "stress_temperature"]
ETM = ("fit", str(MEDIAN), "--scene", "two_disk_etm")


def command(arguments):
    """Exit code, stdout and stderr of the command in-process, in the working folder."""
    out, err = StringIO(), StringIO()
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
        patch.setattr("sys.argv", ["jaxbearing", *arguments])
        patch.setenv("JAXBEARING_CACHE", "off")
        with pytest.raises(SystemExit) as ended:
            main()
    return ended.value.code or 0, out.getvalue(), err.getvalue()


@pytest.fixture(scope="module")
def etm(tmp_path_factory):
    """The measured median curve, fitted with all that can be written; folder and JSON."""
    folder = tmp_path_factory.mktemp("etm")
    place = os.getcwd()
    os.chdir(folder)
    try:
        code, out, err = command((*ETM, "--starts", "1", "--json", "--out", "oil.toml", "--plot", "fit.png"))
    finally:
        os.chdir(place)
    assert (code, err) == (0, "")
    return folder, json.loads(out)


def test_measured_curve_and_what_it_cannot_tell(etm):
    _, found = etm
    assert found["converged"] is True
    assert found["rms"] <= 0.007
    assert found["unidentifiable"] == SLOPES
    for name in NAMES:
        parameter = found["parameters"][name]
        assert parameter["fixed"] == (name in SLOPES)
        for key in ("standard_error", "lower", "upper"):
            assert (parameter[key] is None) == (name in SLOPES)
        if name not in SLOPES:
            assert 0.0 < parameter["lower"] < parameter["value"] < parameter["upper"]
    assert any(note.startswith("Lack of fit") for note in found["notes"])
    assert any("Column 'count' is ignored" in note for note in found["notes"])
    (curve,) = found["curves"]
    assert curve["pressure"] == pytest.approx(3.6e9, rel=0.01)
    assert curve["points"] == 18


def test_files_of_a_fit(etm):
    folder, found = etm
    assert sorted(os.listdir(folder)) == ["fit.png", "oil.toml"]
    assert (folder / "fit.png").read_bytes().startswith(b"\x89PNG")
    assert found["oil"] == "oil.toml"
    rheology = jb.load_scene("two_disk_etm", {"oil.file": str(folder / "oil.toml")}).oil.rheology
    for name in NAMES:
        assert float(getattr(rheology, name)) == found["parameters"][name]["value"]


def test_the_oil_file_in_a_scene(etm):
    """The scene with the fitted oil gives the curve whose misfit was printed."""
    folder, found = etm
    scene = jb.load_scene("two_disk_etm", {"oil.file": str(folder / "oil.toml")})
    measured = made_up().measurements
    solution = jb.solve(scene.at_operation(slide_to_roll=np.asarray(measured.slide_to_roll)))
    difference = solution.traction_coefficient.ravel() - np.asarray(measured.traction_coefficient)
    assert float(np.sqrt(np.mean(difference**2))) == pytest.approx(found["rms"], rel=1e-9)


@pytest.mark.slow
def test_raw_sweeps_and_a_robust_loss(jaxbearing_command):
    """Sweeps with outliers as they were measured, on the screen."""
    options = ("--loss", "soft_l1", "--starts", "1", "--set", "contact.traction_accuracy=1e-2")
    result = jaxbearing_command("fit", str(SWEEPS), "--scene", "two_disk_etm", *options)
    assert (result.code, result.err) == (0, "")
    assert "205 points in 5 curves" in result.out
    assert "outliers" in result.out
    assert "Lack of fit" in result.out
    assert result.out.count("held: ") == 4


# without a fit


@pytest.fixture
def no_fit(monkeypatch):
    """Fails where a fit is begun: a refusal must not make the user wait for one."""

    def fit(*_):
        raise AssertionError("fitted before the refusal")

    monkeypatch.setattr(sys.modules["fitting.fit"], "fit", fit)


@pytest.fixture
def given_fit(monkeypatch):
    """A result made up in place of the fit; keeps the options that it was called with."""
    calls = []

    def fit(measurements, scene, options):
        calls.append(options)
        model = options.model or "ree_eyring"
        converged = fit.converged if isinstance(fit.converged, bool) else model in fit.converged
        found = made_up(scene, model=model, converged=converged, bic={"bair_winer": 60.0}.get(model, 70.0))
        return dataclasses.replace(found, undetermined=fit.undetermined, reason="the points tell nothing")

    fit.converged, fit.undetermined = True, False
    fit.calls = calls
    monkeypatch.setattr(sys.modules["fitting.fit"], "fit", fit)
    monkeypatch.setattr("fitting.io.plots.smooth_curves", lambda *_: [(np.zeros(2),) * 2])
    monkeypatch.setattr("fitting.io.plots._draw_curves", lambda *_: None)
    monkeypatch.setattr("fitting.io.plots._draw_legend", lambda *_: None)
    return fit


def test_options_reach_the_fit(jaxbearing_command, given_fit):
    options = ("--model", "bair_winer", "--fix", "G0", "--fix", "beta_G", "--free", "stress_pressure", "--starts", "5")
    options += ("--bound", "stress=1 MPa:20 MPa", "--loss", "cauchy", "--method", "bfgs", "--level", "99 %")
    options += ("--relative-error", "3 %", "--floor", "0.001", "--slide-error", "1 %")
    assert jaxbearing_command(*ETM, *options).code == 0
    (used,) = given_fit.calls
    assert (used.model, used.method, used.loss, used.starts, used.level) == ("bair_winer", "bfgs", "cauchy", 5, 0.99)
    assert used.fixed == ("shear_modulus", "shear_modulus_temperature")
    assert used.free == ("stress_pressure",)
    assert used.bounds == {"stress": (1e6, 2e7)}
    assert used.errors == (0.03, 0.001, 0.01)
    used.check()


def test_defaults_are_those_of_the_library(jaxbearing_command, given_fit):
    from fitting import FitOptions

    assert jaxbearing_command(*ETM).code == 0
    assert given_fit.calls == [FitOptions()]


def test_screen(jaxbearing_command, given_fit, folder):
    result = jaxbearing_command(*ETM, "--out", "oil.toml", "--plot", "fit.svg")
    assert (result.code, result.err) == (0, "")
    for words in ("CONVERGED", "26.7 to 41.7", "held: one pressure only", "wrote oil.toml", "--set oil.file=oil.toml"):
        assert words in result.out
    assert sorted(os.listdir(folder)) == ["fit.svg", "oil.toml"]
    assert jb.load_scene("turbine_roller", {"oil.file": "oil.toml"}).oil.rheology is not None


def test_curves_that_tell_nothing_have_their_own_status(jaxbearing_command, given_fit, folder):
    """The oil file is there, with what is known, and so is the picture."""
    given_fit.converged, given_fit.undetermined = False, True
    result = jaxbearing_command(*ETM, "--out", "oil.toml", "--plot", "fit.svg")
    assert (result.code, result.err) == (4, "")
    for words in ("UNDETERMINED", "the points tell nothing", "held: one pressure only", "wrote oil.toml"):
        assert words in result.out
    assert "NOT CONVERGED" not in result.out
    assert sorted(os.listdir(folder)) == ["fit.svg", "oil.toml"]
    assert jb.load_scene("turbine_roller", {"oil.file": "oil.toml"}).oil.rheology is not None
    found = json.loads(jaxbearing_command(*ETM, "--json").out)
    assert (found["converged"], found["status"]) == (False, "undetermined")
    assert found["parameters"]["shear_modulus_pressure"]["value"] == 6.11e-9


def test_what_the_fit_refuses_is_one_sentence(jaxbearing_command, monkeypatch):
    def fit(*_):
        raise MeasurementError("inlet temperature: found no solution at 1 of 2 points")

    monkeypatch.setattr(sys.modules["fitting.fit"], "fit", fit)
    result = jaxbearing_command(*ETM)
    assert (result.code, result.out) == (2, "")
    assert result.err == "error: inlet temperature: found no solution at 1 of 2 points\n"


def test_all_models(jaxbearing_command, given_fit, folder):
    result = jaxbearing_command(*ETM, "--model", "all", "--out", "oil.toml")
    assert (result.code, result.err) == (0, "")
    assert [options.model for options in given_fit.calls] == [
        "ree_eyring",
        "bair_winer",
        "gecim_winer",
        "elsharkawy_hamrock",
    ]
    assert "Models, the lowest BIC first" in result.out
    # the best one is the one that is written
    assert 'viscous_function = "bair_winer"' in (folder / "oil.toml").read_text(encoding="utf-8")
    found = json.loads(jaxbearing_command(*ETM, "--model", "all", "--json").out)
    assert (found["model"], found["comparison"][0]["model"]) == ("bair_winer", "bair_winer")
    assert len(found["comparison"]) == 4


def test_the_best_model_is_one_that_converged(jaxbearing_command, given_fit):
    given_fit.converged = ("gecim_winer",)
    result = jaxbearing_command(*ETM, "--model", "all", "--json")
    assert result.code == 0
    assert json.loads(result.out)["model"] == "gecim_winer"
    given_fit.converged = False
    assert jaxbearing_command(*ETM, "--model", "all", "--json").code == 3


@pytest.mark.parametrize("screen", [(), ("--json",)], ids=["screen", "json"])
def test_not_converged_leaves_no_file(screen, jaxbearing_command, given_fit, folder):
    given_fit.converged = False
    (folder / "old.png").write_text("old", encoding="utf-8")
    result = jaxbearing_command(*ETM, *screen, "--out", "oil.toml", "--plot", "old.png")
    assert result.code == 3
    assert "not written: old.png, oil.toml\n" in result.err
    assert os.listdir(folder) == ["old.png"]
    assert (folder / "old.png").read_text(encoding="utf-8") == "old"
    if screen:
        found = json.loads(result.out)
        assert (found["converged"], found["rms"], found["oil"]) == (False, None, None)
        assert found["parameters"]["stress"]["value"] is None
    else:
        assert "NOT CONVERGED" in result.out
        assert "kPa" not in result.out


@pytest.mark.parametrize("option", [("--out", "a.toml"), ("--plot", "a.pdf")], ids=str)
def test_a_disk_that_fills_up(option, jaxbearing_command, given_fit, folder, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("jaxbearing.report.files.os.replace", full)
    result = jaxbearing_command(*ETM, *option)
    assert result.code == 1
    assert "CONVERGED" in result.out
    assert result.err == f"error: the output cannot be written: {option[1]}: No space left on device\n"
    assert os.listdir(folder) == []


HEADER = "slide_to_roll [%],traction_coefficient"
POINTS = "1,0.01\n2,0.02\n5,0.03\n"
BROKEN_CURVES = {
    "missing_column": ("slide_to_roll [%],load [N]\n1,2\n2,3\n", ["traction_coefficient"]),
    "mixed_separators": (f"{HEADER}\n1;0.01\n2,0.02\n", ["line 2"]),
    "nan": (f"{HEADER}\n1,nan\n2,0.02\n", ["line 2", "traction_coefficient", "not finite"]),
    "text": (f"{HEADER}\n1,high\n2,0.02\n", ["line 2", "high"]),
    "one_row": (f"{HEADER}\n1,0.01\n", ["single point"]),
    "duplicated_header": (f"{HEADER},traction_coefficient\n1,2,3\n2,3,4\n", ["traction_coefficient"]),
    "header_again": (f"{HEADER}\n1,0.01\n{HEADER}\n2,0.02\n", ["line 3"]),
    "wrong_unit": (f"{HEADER},load [m]\n1,0.01,3\n2,0.02,3\n", ["load", "force"]),
    "no_unit": (f"{HEADER},load\n1,0.01,3\n2,0.02,3\n", ["load", "no unit"]),
    "empty": ("", ["empty"]),
    "only_a_header": (f"{HEADER}\n", ["without points"]),
    "missing_file": (None, ["curves.csv"]),
}


def check_refused(result, words):
    assert (result.code, result.out) == (2, "")
    assert result.err.startswith("error: ")
    assert result.err.count("\n") == 1
    assert "Traceback" not in result.err
    for word in ("found", "expected", *words):
        assert word in result.err


@pytest.mark.usefixtures("no_fit")
@pytest.mark.parametrize("name", BROKEN_CURVES)
def test_broken_curves(name, jaxbearing_command, folder):
    text, words = BROKEN_CURVES[name]
    if text is not None:
        (folder / "curves.csv").write_text(text, encoding="utf-8")
    before = os.listdir(folder)
    result = jaxbearing_command("fit", "curves.csv", "--scene", "two_disk_etm", "--out", "o.toml", "--plot", "p.png")
    check_refused(result, ["curves.csv", *words])
    assert os.listdir(folder) == before


REFUSED = {
    "no_such_scene": (("--scene", "two_disk_et"), ["two_disk_et", "Did you mean 'two_disk_etm'"]),
    "a_bearing": (("--scene", "turbine_roller"), ["--scene", "turbine_roller", "two_disk"]),
    "override": (("--set", "operation.weight=3 N"), ["operation.weight"]),
    "pressures": (("--scene", "two_disk_mobil_jet_ii"), ["operation.", "2 values", "a column", "curves.csv"]),
    "model": (("--model", "ree_eyrng"), ["--model", "Did you mean 'ree_eyring'", "'all'"]),
    "loss": (("--loss", "l1"), ["--loss", "soft_l1"]),
    "method": (("--method", "newton"), ["--method", "levenberg_marquardt"]),
    "fix": (("--fix", "strss"), ["--fix", "Did you mean 'stress'"]),
    "free": (("--free", "alpha"), ["--free"]),
    "fix_and_free": (("--fix", "tau0", "--free", "stress"), ["--free", "stress", "--fix"]),
    "bound": (("--bound", "stress=1:2"), ["--bound", "stress", "without a unit"]),
    "starts": (("--starts", "0"), ["--starts", ">= 1"]),
    "level": (("--level", "1"), ["--level"]),
    "level_0": (("--level", "0"), ["--level"]),
    "relative_error": (("--relative-error", "-1 %"), ["--relative-error"]),
    "no_error": (("--relative-error", "0"), ["--relative-error", "--floor"]),
    "slide_error": (("--slide-error", "1 m"), ["--slide-error"]),
    "out": (("--out", "oil.json"), ["--out", "'.toml'"]),
    "plot": (("--plot", "fit.jpg"), ["--plot", "'.png'"]),
    "folder": (("--out", "no/oil.toml"), ["--out", "existing folder"]),
    "null_byte": (("--fix", "a\0\x1b"), ["--fix"]),
}


@pytest.mark.usefixtures("no_fit")
@pytest.mark.parametrize("name", REFUSED)
def test_refused_before_the_fit(name, jaxbearing_command, folder):
    options, words = REFUSED[name]
    (folder / "curves.csv").write_text(f"{HEADER}\n{POINTS}", encoding="utf-8")
    scene = () if "--scene" in options else ("--scene", "two_disk_etm")
    check_refused(jaxbearing_command("fit", "curves.csv", *scene, *options), words)
    assert os.listdir(folder) == ["curves.csv"]


def test_the_scene_is_asked_for(jaxbearing_command):
    result = jaxbearing_command("fit", "curves.csv")
    assert (result.code, result.out) == (2, "")
    assert "--scene" in result.err


@pytest.mark.slow
@pytest.mark.skipif(not available(), reason="NumPyro, an extra of the package, is not installed")
def test_the_posterior_of_a_measured_curve(jaxbearing_command, folder):
    """Asked: R-hat < 1.01; the curve is predicted by the samples, and both are drawn."""
    given = ("--starts", "1", "--posterior", "--samples", "600", "--plot-posterior", "posterior.png")
    result = jaxbearing_command(*ETM, *given, "--json")
    assert result.code == 0, result.err
    found = json.loads(result.out)
    assert list(found["posterior"]["parameters"]) == ["shear_modulus", "stress"]
    for name, one in found["posterior"]["parameters"].items():
        assert one["r_hat"] < 1.01
        assert one["effective"] > 400
        # least squares and the samples agree within half a standard error: the curve tells both numbers well
        parameter = found["parameters"][name]
        assert abs(one["median"] - parameter["value"]) < 0.5 * parameter["standard_error"]
    assert len(found["predictive"]["median"]) == 18
    assert found["predictive"]["inside"] >= 0.85
    assert (folder / "posterior.png").read_bytes().startswith(b"\x89PNG")
