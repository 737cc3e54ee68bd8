"""`jaxbearing simulate`: JSON, NetCDF, picture, exit codes."""

import json

import numpy as np
import pytest
import xarray as xr
from typer.testing import CliRunner
from warm_cases import ROLLERS

from jaxbearing.cli.main import app

BASE = ("simulate", "reference_roller")
"""The simplest laws: the same program as that of `moving_roller.table_16`."""

MOVING = ("--set", "simulation.duration=1 ms")
"""Such a scene needs no steady state."""
FILES = (("--out", "run.nc"), ("--plot", "run.png"), ("--animation", "run.gif"))


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """One short run with everything that can be written."""
    folder = tmp_path_factory.mktemp("simulate")
    files = [part for option, name in FILES for part in (option, str(folder / name))]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jaxbearing.report.backends.matplotlib.animations.PICTURES", 6)
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
    assert 10_000 < (folder / "run.gif").stat().st_size < 5_000_000
    with xr.open_dataset(folder / "run.nc", engine="h5netcdf") as dataset:
        assert dataset["pocket_load_front"].dims == ("time", "element")
        assert dataset["cage_speed"].attrs["units"] == "rad s-1"
        assert all("units" in dataset[name].attrs for name in dataset.variables)
        np.testing.assert_allclose(dataset["time"][-1], 0.5e-3)


def test_restart_goes_on(run):
    """By the duration, from the time at which the file ends; the earlier run is not overwritten."""
    _, folder = run
    arguments = [*BASE, "--duration", "0.5 ms", "--restart", str(folder / "run.nc")]
    refused = CliRunner().invoke(app, [*arguments, "--out", str(folder / "run.nc")])
    assert refused.exit_code == 2
    assert "which this command reads" in refused.stderr
    result = CliRunner().invoke(app, [*arguments, "--json"])
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    np.testing.assert_allclose([found["time"][name] for name in ("start", "stop", "wanted")], [0.5e-3, 1e-3, 1e-3])
    again = json.loads(run[0].stdout)["summary"]["cage"]["speed"]["end"]
    assert abs(found["summary"]["cage"]["speed"]["max"] / again - 1.0) < 0.01
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 0
    assert "goes on from 0.5 ms" in result.stdout


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        (("--set", "geometry.n_rollers=28"), "30 rollers, for a scene with 28"),
        (("--set", "cage=none", *MOVING), "a state with a cage"),
        (
            ("--set", "geometry.diametral_clearance=31 um"),
            "geometry.diametral_clearance is 3e-05 there and 3.1e-05 here",
        ),
        (("--set", "geometry.roller_diameter=12.1 mm"), "geometry.roller_diameter is 0.012 there and 0.0121 here"),
        (("--set", "flange=none"), "flange is RollerFlange there and none here"),
        (("--restart", "run.png"), "not a NetCDF file"),
        (("--restart", "gone.nc"), "cannot be read"),
        (("--restart", "."), "cannot be read"),
    ],
)
def test_restart_from_something_else_is_refused(run, changes, reason, monkeypatch):
    _, folder = run
    monkeypatch.chdir(folder)
    result = CliRunner().invoke(app, [*BASE, "--duration", "1 ms", "--restart", "run.nc", *changes])
    assert result.exit_code == 2
    assert reason in result.stderr
    assert result.stderr.startswith("error: --restart")
    assert result.stderr.count("\n") == 1
    assert result.stdout == ""


DRY = {
    "no cage": ("cage=none",),
    "no drag": ("drag=none",),
    "no flange and no ends": ("flange=none", "cage.pocket_axial_clearance=none"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", DRY)
def test_parts_that_are_left_out_are_not_modelled(name):
    changes = [part for change in DRY[name] for part in ("--set", change)]
    result = CliRunner().invoke(app, [*BASE, *changes, "--duration", "0.5 ms", "--json"])
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert abs(found["energy_error"]) < 1e-4
    assert ("cage" in found["summary"]) == ("pocket_load" in found["summary"]) == (name != "no cage")
    assert ("drag" in found["summary"]["power_loss"]) == (name != "no drag")
    assert ("flange" in found["summary"]["power_loss"]) == (not name.startswith("no flange"))


BENT = ("inner_ring.thickness=3 mm", "inner_ring.width=15 mm", "inner_ring.shaft_stiffness=1e9 N/m^2")
REFUSED = {
    "without a duration": (BASE, "--duration"),
    "a bare number": ((*BASE, "--duration", "50"), "unit"),
    "no traction": ((*BASE, "--duration", "1 ms", "--set", "contact.traction=none"), "contact.traction"),
    "no contact": ((*BASE[:2], "--duration", "1 ms", "--set", "contact=none"), "contact.traction"),
    "no pocket": ((*BASE, "--duration", "1 ms", "--set", "cage.pocket_clearance=none"), "cage.pocket_clearance"),
    "no table": ((*BASE, "--duration", "1 ms", "--set", "simulation.speed_table.file=gone.csv"), "gone.csv"),
    "an animation of another kind": ((*BASE, "--duration", "1 ms", "--animation", "run.avi"), ".gif"),
    "a steady kind": (("simulate", "tapered_example", "--duration", "1 ms"), "cylindrical"),
    "a shaft, with all that can": (("simulate", "spindle_pair", "--duration", "1 ms"), "a ball or cylindrical roller"),
    "an unknown solver": ((*BASE, "--duration", "1 ms", "--set", "simulation.solver=euler"), "tsit5"),
    "too many results": ((*BASE, "--duration", "1e9 s"), "--interval"),
    "a load from zero": (
        (
            *BASE,
            "--duration",
            "1 ms",
            "--set",
            "simulation.load_ramp.start=0",
            "--set",
            "simulation.load_ramp.duration=1 ms",
        ),
        "loaded bearing",
    ),
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
    "balls without the mass of the ring": (("simulate", "turbine_ball", "--duration", "1 ms"), "simulation.ring_mass"),
    "a flexible ring": (
        ("simulate", "reference_roller", "--duration", "1 ms", *(part for ring in BENT for part in ("--set", ring))),
        "inner_ring: a transient run has rigid rings",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_bad_input_is_refused(name):
    arguments, hint = REFUSED[name]
    result = CliRunner().invoke(app, list(arguments))
    assert result.exit_code == 2
    assert hint in result.stderr
    assert result.stdout == ""


def of_temperatures(*more):
    """A run of the temperatures of the cheapest bearing."""
    changes = [f"{path}={value}" for path, value in (ROLLERS | {"thermal.nodes": "4"}).items()]
    scene = ["simulate", "turbine_roller", *(part for change in changes for part in ("--set", change))]
    return CliRunner().invoke(app, [*scene, *more])


@pytest.mark.slow
def test_temperatures_in_time(tmp_path):
    files = ["--out", str(tmp_path / "run.nc"), "--plot", str(tmp_path / "run.png")]
    result = of_temperatures("--duration", "1 h", "--json", *files)
    assert result.exit_code == 0
    found = json.loads(result.stdout)
    assert found["completed"] is True
    np.testing.assert_allclose(found["time"]["stop"], 3600.0)
    assert abs(found["energy_error"]) < 1e-4
    assert found["summary"]["temperatures"]["oil"]["start"] == 293.15
    assert (tmp_path / "run.png").stat().st_size > 10_000
    again = of_temperatures("--duration", "1 min", "--json", "--restart", str(tmp_path / "run.nc"))
    assert again.exit_code == 0
    assert json.loads(again.stdout)["time"] == {"start": 3600.0, "stop": 3660.0, "wanted": 3660.0}
    hot = of_temperatures("--duration", "1 h", "--set", "thermal.limit=130 degC")
    assert hot.exit_code == 3
    assert "a node passed thermal.limit" in hot.output


def test_temperatures_need_heat_capacities():
    found = of_temperatures("--duration", "1 h", "--set", "thermal.nodes=6")
    assert found.exit_code == 2
    assert "thermal.capacity.shaft, thermal.capacity.housing: found nothing, expected a number" in found.output
