"""`jaxbearing calibrate`: files and options in, screen, JSON, scene and pictures out, one message for bad input."""

import json
import os
import re
from pathlib import Path

import numpy as np
import pytest

import jaxbearing as jb
from fitting.posterior import Marginal, Posterior, Sampling, available
from jaxbearing.report.joint_file import read_joint

CLEARANCE, MODULUS = "geometry.diametral_clearance", "materials.rings.youngs_modulus"
SCENE = "deep_groove_6205"
FREE = ("--free", CLEARANCE, "--free", MODULUS)


@pytest.fixture(scope="module")
def rows():
    """Radial loads, kN, and displacements, um, of a bearing with other numbers."""
    scene = jb.load_scene(SCENE).replace({CLEARANCE: 14e-6, MODULUS: 190e9})
    loads = np.linspace(0.5, 4.0, 8)
    noise = 1.0 + 0.002 * np.random.default_rng(0).normal(size=8)
    found = [float(jb.solve(scene.at_operation(radial_load=1e3 * q)).ring.radial) for q in loads]
    return [(q, 1e6 * radial * n) for q, radial, n in zip(loads, found, noise, strict=True)]


@pytest.fixture
def folder(tmp_path, monkeypatch, rows):
    lines = ["operation.radial_load [kN],ring.radial [um],held_back,remark"]
    lines += [f"{q:.6f},{r:.9f},{int(i == 3)},x" for i, (q, r) in enumerate(rows)]
    (tmp_path / "data.csv").write_text("\n".join(lines), encoding="utf-8")
    (tmp_path / "next.csv").write_text("operation.radial_load [kN]\n0.1\n8\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def made_up_posterior(found, sampling):
    one = lambda value: Marginal(value, value, 1e-3 * value, 0.99 * value, 1.01 * value, 1.001, 900.0)
    marginals = {path: one(parameter.value) for path, parameter in found.parameters.items()}
    values = np.array([one.value for one in found.parameters.values()])
    drawn = values * (1.0 + 1e-3 * np.random.default_rng(0).normal(size=(2, 60, len(values))))
    coordinate = [np.vectorize(field.coordinate) for field in found.fields]
    coordinates = np.stack([one(drawn[..., i]) for i, one in enumerate(coordinate)], axis=-1)
    return Posterior(marginals, coordinates, drawn, np.full((2, 60), found.scale), 0, 3.0, 0.95, sampling)


def test_json_has_the_keys(jaxbearing_command, folder):
    result = jaxbearing_command("calibrate", SCENE, "data.csv", *FREE, "--next", "next.csv", "--json")
    assert result.code == 0, result.err
    found = json.loads(result.out)
    assert found["converged"] is True
    assert found["status"] == "converged"
    parameter = found["parameters"][CLEARANCE]
    assert parameter["lower"] < 14e-6 < parameter["upper"]
    assert parameter["unit"] == "m"
    assert found["fitted"] == [CLEARANCE, MODULUS]
    assert found["held_back"]["values"] == [3]
    assert found["misfits"][0]["points"] == 7
    assert {one["place"] for one in found["next"]} == {0, 1}
    assert found["warnings"][-1] == "column 'remark' of data.csv is ignored"
    assert found["posterior"] is None


def test_screen_files_and_pictures(jaxbearing_command, folder, monkeypatch):
    monkeypatch.setattr("fitting.posterior.available", lambda: True)
    monkeypatch.setattr("jaxbearing.calibration.posterior.posterior_of", made_up_posterior)
    files = ("--out", "new.toml", "--out", "joint.nc", "--plot", "a.png", "--plot-posterior", "b.png")
    given = ("--next", "next.csv", "--folds", "4", "--posterior", "--predict", f"{SCENE}=ring.radial", *files)
    result = jaxbearing_command("calibrate", SCENE, "data.csv", *FREE, *given)
    assert result.code == 0, result.err
    for said in (
        "CONVERGED",
        "95 % intervals",
        "held back",
        "Posterior",
        "Predictions with",
        "Next operating point",
        "wrote new.toml",
        "wrote a.png\nwrote b.png\n",
        "wrote joint.nc: the fields with what they share; jaxbearing tolerances --posterior joint.nc",
    ):
        assert said in result.out
    assert "8 of 8 measured values lie within" in " ".join(result.out.split())
    again = jb.load_scene("new.toml")
    np.testing.assert_allclose(float(again.geometry.diametral_clearance), 14e-6, rtol=0.03)
    np.testing.assert_allclose(float(again.materials.rings.youngs_modulus), 190e9, rtol=0.03)
    assert {"a.png", "b.png"} <= set(os.listdir(folder))
    joint = read_joint("joint.nc")
    assert joint.fields == (CLEARANCE, MODULUS)
    assert joint.samples.shape == (120, 2)
    assert list(joint.positive) == [False, True]


def test_the_page_prints_what_the_command_does(jaxbearing_command, folder):
    """Both tables of docs/calibration.md, row by row."""
    page = (Path(__file__).parents[2] / "docs" / "calibration.md").read_text(encoding="utf-8")
    (data,) = re.findall(r"```csv\n(.*?)```", page, flags=re.DOTALL)
    (folder / "displacements.csv").write_text(data, encoding="utf-8")
    (folder / "candidates.csv").write_text("operation.radial_load [kN]\n0.1\n1\n8\n", encoding="utf-8")
    result = jaxbearing_command("calibrate", SCENE, "displacements.csv", *FREE, "--next", "candidates.csv")
    assert result.code == 0, result.err
    printed = [" ".join(line.split()) for line in result.out.splitlines()]
    tables = re.findall(r"```text\n(.*?)```", page, flags=re.DOTALL)
    rows = [" ".join(line.split()) for table in tables for line in table.splitlines()]
    assert len(rows) == 7
    assert [row for row in rows if row not in printed] == []


def test_nothing_told_has_its_own_status(jaxbearing_command, folder):
    result = jaxbearing_command(
        "calibrate", SCENE, "data.csv", "--free", "materials.rings.density", "--out", "new.toml", "--json"
    )
    assert result.code == 4
    said = json.loads(result.out)
    assert (said["converged"], said["status"]) == (False, "undetermined")
    assert "not written: new.toml" in result.err
    assert "cannot tell any field" in result.err
    assert "new.toml" not in os.listdir(folder)


def test_a_prior_and_bounds_as_they_are_typed(jaxbearing_command, folder):
    prior = f"{CLEARANCE}={{low = '13 um', high = '14 um'}}"
    given = ("--prior", prior, "--bound", f"{MODULUS}=:180 GPa", "--json", "--known-errors")
    result = jaxbearing_command("calibrate", SCENE, "data.csv", *FREE, *given)
    assert result.code == 0, result.err
    found = json.loads(result.out)["parameters"]
    np.testing.assert_allclose(found[MODULUS]["value"], 180e9, rtol=1e-12)
    assert found[MODULUS]["fixed"] is True
    assert abs(found[CLEARANCE]["value"] - 13.5e-6) < 1e-6


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--free", "geometry.clearance"), "geometry.clearance"),
        (("--free", MODULUS, "--prior", "x"), "--prior"),
        (("--free", MODULUS, "--prior", f"{CLEARANCE}={{low = '1 um', high = '2 um'}}"), "a field that is not free"),
        (("--free", MODULUS, "--prior", f"{MODULUS}=assumed"), "'assumed'"),
        (("--free", MODULUS, "--bound", f"{MODULUS}=1 GPa"), "--bound"),
        (("--free", MODULUS, "--rig", "other"), "--rig: found 'other'"),
        (("--free", MODULUS, "--folds", "1"), "--folds: found 1"),
        (("--free", MODULUS, "--loss", "huber"), "--loss"),
        (("--free", MODULUS, "--plot-posterior", "a.png"), "--plot-posterior: found no --posterior"),
        (("--free", MODULUS, "--predict", "turbine_roller"), "--predict: found 'turbine_roller'"),
        (("--free", MODULUS, "--set", "operation.radial_load=1 kN"), "--set"),
    ],
)
def test_bad_input(jaxbearing_command, folder, arguments, said):
    before = sorted(os.listdir(folder))
    result = jaxbearing_command("calibrate", SCENE, "data.csv", *arguments)
    assert result.code == 2, result.out
    assert result.out == ""
    assert said in result.err
    assert sorted(os.listdir(folder)) == before


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("operation.radial_load [kN],ring.radiel [um]\n1,2\n", "ring.radial"),
        ("operation.radial_load [kN],ring.radial [s]\n1,2\n", "the unit"),
        ("operation.radial_load [kN],ring.radial\n1,2\n", "no unit"),
        ("operation.radial_load [kN],ring.radial [um]\n1,x\n", "line 2"),
        ("operation.radial_load [kN]\n1\n", "no column with a measured result"),
        ("operation.radial_load,ring.radial [um]\n1,2\n", "radial_load"),
        ("operation.radial_load [kN],ring.radial [um],ring.axial.deviation [um]\n1,2,3\n", "ring.axial.deviation"),
        ("operation.radial_load [kN],ring.radial [um],ring.radial.deviation [um]\n1,2,0\n", "expected numbers > 0."),
        ("operation.radial_load [kN],ring.radial [um],ring.radial [um]\n1,2,3\n", "twice"),
        (
            "operation.radial_load [kN],inner_torque [N m]\n1,2\n",
            "inner_torque: found a result that this scene does not",
        ),
        ("operation.radial_load [kN],force [N]\n1,2\n", "expected one of them, 'force[0]'"),
        ("operation.radial_load [kN],status,ring.radial\n1,2,3\n", "no unit"),
        ("ring.radial [um],ring.radial.weight\n1,0\n2,0\n", "ring.radial.weight: found no value with a weight above 0"),
    ],
)
def test_files_that_cannot_be_read(jaxbearing_command, folder, text, said):
    (folder / "data.csv").write_text(text, encoding="utf-8")
    result = jaxbearing_command("calibrate", SCENE, "data.csv", "--free", MODULUS)
    assert result.code == 2, result.out
    assert said in result.err


def test_weights_and_empty_cells(folder):
    """A weight of 0 leaves a value out, as an empty cell does; a weight of 4 halves the deviation."""
    from jaxbearing.calibration.table import read_data
    from jaxbearing.sweeps.fields import SceneSource

    rows = "operation.radial_load [kN];ring.radial [um];ring.radial.weight\n1,5;20;1\n2;25;4\n3;30;0\n4;;1\n"
    (folder / "w.csv").write_text(rows, encoding="utf-8")
    source = SceneSource.of(SCENE)
    data, notes = read_data("w.csv", source, jb.load_scene(SCENE))
    assert notes == []
    np.testing.assert_allclose(data.conditions["operation.radial_load"], [1500.0, 2000.0, 3000.0, 4000.0])
    np.testing.assert_allclose(data.measured["ring.radial"], [20e-6, 25e-6, np.nan, np.nan])
    deviation = data.deviations["ring.radial"]
    np.testing.assert_allclose(deviation[0], 2.0 * deviation[1])


def test_the_sampling_is_checked():
    with pytest.raises(ValueError, match="samples: found 3"):
        Sampling(samples=3).check()


@pytest.mark.slow
@pytest.mark.skipif(not available(), reason="NumPyro, an extra of the package, is not installed")
def test_the_command_samples_predicts_and_draws(jaxbearing_command, folder):
    """Asked: R-hat < 1.01. The prediction of another point is made of the samples."""
    given = ("--posterior", "--samples", "400", "--predict", f"{SCENE}=ring.radial")
    result = jaxbearing_command("calibrate", SCENE, "data.csv", *FREE, *given, "--plot-posterior", "b.png", "--json")
    assert result.code == 0, result.err
    said = json.loads(result.out)
    for one in said["posterior"]["parameters"].values():
        assert one["r_hat"] < 1.01
        assert one["effective"] > 400
    assert len(said["predictive"]["median"]) == 8
    assert said["predictive"]["inside"] >= 0.75
    (prediction,) = said["predictions"].values()
    assert prediction["samples"] == 200
    assert prediction["lower"] < prediction["value"] < prediction["upper"]
    assert (folder / "b.png").read_bytes().startswith(b"\x89PNG")
