"""`solve` of two-disk machines: screen, JSON, files, refusals, exit codes."""

import json
import os

import numpy as np
import pytest
import xarray as xr

NAME = "two_disk_mobil_jet_ii"
SOLVE = (
    *("solve", NAME, "--set", "operation.slide_to_roll=['1 %', '20 %']"),
    *("--set", "operation.temperature=['297 K', '100 degC']"),
    *("--set", "operation.entrainment_speed=21.175 m/s"),
    *("--set", "contact.traction_accuracy=1e-2"),
)


def test_scenes_are_listed(jaxbearing_command):
    listed = jaxbearing_command("scenes").out
    for name in (NAME, "two_disk_pennzane", "two_disk_etm"):
        assert name in listed


def test_screen(jaxbearing_command):
    result = jaxbearing_command(*SOLVE)
    assert (result.code, result.err) == (0, "")
    for word in ("CONVERGED", "4 curves of 2 points", "1.500", "20 %", "23.85"):
        assert word in result.out
    assert max(map(len, result.out.splitlines())) <= 100


def test_json_and_files(jaxbearing_command, folder):
    result = jaxbearing_command(*SOLVE, "--json", "--plot", "a.svg", "--out", "a.nc")
    assert (result.code, result.err) == (0, "")
    assert result.out.count("\n") == 1
    assert sorted(os.listdir(folder)) == ["a.nc", "a.svg"]
    solution = json.loads(result.out)
    assert (solution["converged"], solution["status"], solution["warnings"]) == (True, "converged", [])
    curves = solution["curves"]
    found = [(round(curve["temperature"], 9), round(curve["pressure"], -3)) for curve in curves]
    assert found == [(297.0, 1.05e9), (297.0, 1.5e9), (373.15, 1.05e9), (373.15, 1.5e9)]
    assert all(curve["slide_to_roll"] == [0.01, 0.2] for curve in curves)
    with xr.open_dataset(folder / "a.nc") as dataset:
        assert all(variable.attrs["units"] for variable in dataset.variables.values())
        friction = dataset["traction_coefficient"].values.reshape(4, 2)
        np.testing.assert_array_equal(friction, [curve["traction_coefficient"] for curve in curves])


def test_warnings_are_no_failure(jaxbearing_command):
    result = jaxbearing_command(*SOLVE, "--set", "operation.pressure=['2.8 GPa', '3 GPa']", "--json")
    assert result.code == 0
    (text,) = json.loads(result.out)["warnings"]
    assert text == "mean contact pressure beyond 1.8 GPa: the traction rheology is extrapolated"


def test_not_converged(jaxbearing_command, folder):
    """A pressure that overflows, beside one that does not."""
    arguments = (*SOLVE, "--set", "operation.pressure=['1 GPa', '1e60 Pa']")
    as_json = jaxbearing_command(*arguments, "--json", "--out", "a.nc")
    assert as_json.code == 3
    assert "not written: a.nc" in as_json.err
    assert "4 of 8 points" in as_json.err
    solution = json.loads(as_json.out)
    assert (solution["converged"], solution["status"]) == (False, "not_converged")
    assert solution["curves"][1]["traction_coefficient"] == [None, None]
    screen = jaxbearing_command(*arguments)
    assert screen.code == 3
    assert "NOT CONVERGED" in screen.out
    assert "4 of 8 points" in screen.out
    assert os.listdir(folder) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--sensitivities",), ["--sensitivities", "8 points", "expected one point"]),
        (("--set", "operation.pressure=none"), ["operation.pressure", "neither"]),
        (("--set", "contact.film=moes"), ["contact.film", "point contact"]),
        (("--set", "operation.temperature=[297]"), ["operation.temperature", "bare number 297"]),
        (("--plot", "a.jpg"), ["--plot", "'.png'"]),
    ],
    ids=str,
)
def test_refused(arguments, words, jaxbearing_command, folder):
    result = jaxbearing_command("solve", NAME, *arguments)
    assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)
    for word in ("found", "expected", *words):
        assert word in result.err
    assert os.listdir(folder) == []


@pytest.mark.parametrize("name", [NAME, "two_disk_pennzane", "two_disk_etm"])
@pytest.mark.slow
def test_built_in_scenes_converge(name, jaxbearing_command):
    result = jaxbearing_command("solve", name, "--json")
    assert (result.code, result.err) == (0, "")
    solution = json.loads(result.out)
    assert solution["converged"] is True
    friction = np.asarray([curve["traction_coefficient"] for curve in solution["curves"]])
    assert np.all(np.abs(friction) < 0.1)
