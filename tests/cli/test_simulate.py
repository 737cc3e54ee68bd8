"""`jaxbearing simulate`: JSON, NetCDF, picture, exit codes."""

import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner

from jaxbearing.cli.main import app

BASE = ("simulate", "turbine_roller_dynamic", "--set", "contact.thermal=none")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """One short run with everything that can be written."""
    folder = tmp_path_factory.mktemp("simulate")
    files = ("--out", str(folder / "run.nc"), "--plot", str(folder / "run.png"))
    result = CliRunner().invoke(app, [*BASE, "--duration", "0.5 ms", "--json", *files])
    return result, folder


def test_json_has_the_agreed_keys(run):
    result, _ = run
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["completed"] is True
    assert found["status"] == "converged"
    assert found["time"]["start"] == 0.0
    np.testing.assert_allclose(found["time"]["stop"], 0.5e-3)
    assert found["steps"]["accepted"] > 0
    assert found["steps"]["rejected"] >= 0
    assert abs(found["energy_error"]) < 1e-4
    assert found["summary"]["pocket_load"]["front"]["max"] > 0.0


def test_files(run):
    _, folder = run
    assert (folder / "run.png").stat().st_size > 10_000
    with xr.open_dataset(folder / "run.nc", engine="h5netcdf") as dataset:
        assert dataset["pocket_load_front"].dims == ("time", "element")
        assert dataset["cage_speed"].attrs["units"] == "rad s-1"
        assert all("units" in dataset[name].attrs for name in dataset.variables)
        np.testing.assert_allclose(dataset["time"][-1], 0.5e-3)


REFUSED = {
    "without a duration": (BASE, "--duration"),
    "a bare number": ((*BASE, "--duration", "50"), "unit"),
    "no traction": ((*BASE, "--duration", "1 ms", "--set", "contact.traction=none"), "contact.traction"),
    "a steady kind": (("simulate", "turbine_ball", "--duration", "1 ms"), "cylindrical"),
    "an unknown solver": ((*BASE, "--duration", "1 ms", "--set", "simulation.solver=euler"), "tsit5"),
    "a ramp from rest": (
        (
            *BASE,
            "--duration",
            "1 ms",
            "--set",
            "simulation.speed_ramp.start=0",
            "--set",
            "simulation.speed_ramp.duration=1 ms",
        ),
        "films vanish",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused(name):
    arguments, hint = REFUSED[name]
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code == 2
    assert hint in result.stderr
    assert result.stdout == ""
