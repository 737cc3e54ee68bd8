"""`solve` and `simulate` of a line contact: screen, JSON, files, refusals, exit codes."""

import json
import os

import jax
import numpy as np
import pytest
import xarray as xr

import jaxbearing as jb
from jaxbearing.bearings.ball.line_contact_bridge import line_contact_of

NAME = "satellite_contact_1"
SOLVE = ("solve", NAME, "--set", "contact.nodes=101")
SIMULATE = ("simulate", NAME, "--set", "contact.nodes=101", "--duration", "2 ms")


def test_scenes_are_listed(jaxbearing_command):
    listed = jaxbearing_command("scenes").out
    assert NAME in listed
    assert "satellite_contact_2" in listed


def test_screen(jaxbearing_command):
    result = jaxbearing_command(*SOLVE)
    assert (result.code, result.err) == (0, "")
    for word in ("CONVERGED", "0.0458 mm", "1.060 GPa", "central, Moes", "incompressible", "+0.95"):
        assert word in result.out
    assert max(map(len, result.out.splitlines())) <= 100


def test_json_and_files(jaxbearing_command, folder):
    result = jaxbearing_command(*SOLVE, "--json", "--plot", "a.svg", "--out", "a.nc")
    assert (result.code, result.err) == (0, "")
    assert result.out.count("\n") == 1
    assert sorted(os.listdir(folder)) == ["a.nc", "a.svg"]
    solution = json.loads(result.out)
    assert (solution["converged"], solution["status"], solution["unknowns"]) == (True, "converged", 100)
    assert set(solution["film"]) >= {"central", "minimum"}
    assert set(solution["hertz"]) == {"half_width", "pressure"}
    assert set(solution["profile"]) == {"x", "pressure", "film"}
    assert len(solution["profile"]["x"]) == 101
    np.testing.assert_allclose(solution["film"]["central"], 0.0511e-6, rtol=0.03)
    with xr.open_dataset(folder / "a.nc", engine="h5netcdf") as dataset:
        assert all(variable.attrs["units"] for variable in dataset.variables.values())
        np.testing.assert_array_equal(dataset["profile_film"].values, solution["profile"]["film"])
        assert dataset["profile_film"].dims == ("x",)


def test_run(jaxbearing_command, folder):
    result = jaxbearing_command(*SIMULATE, "--json", "--plot", "a.svg", "--out", "a.nc")
    assert (result.code, result.err) == (0, "")
    found = json.loads(result.out)
    assert (found["completed"], found["status"], found["energy_error"]) == (True, "converged", None)
    np.testing.assert_allclose([found["time"]["start"], found["time"]["stop"]], [0.0, 2e-3], rtol=1e-12)
    assert found["steps"]["accepted"] > 10
    assert found["summary"]["mass_balance_error"] < 1e-8
    assert found["summary"]["minimum"]["end"] < found["summary"]["minimum"]["start"]
    with xr.open_dataset(folder / "a.nc", engine="h5netcdf") as dataset:
        assert dataset["film_minimum"].dims == ("time",)
        assert dataset["profile_film"].dims == ("time", "x")
        assert all("units" in dataset[name].attrs for name in dataset.variables)
    screen = jaxbearing_command(*SIMULATE)
    assert (screen.code, screen.err) == (0, "")
    for word in ("COMPLETED", "smallest film", "Balance of mass"):
        assert word in screen.out


def test_restart_and_animation(jaxbearing_command, folder, monkeypatch):
    """2 ms and 1 ms more; 4 of 120 pictures."""
    monkeypatch.setattr("jaxbearing.report.backends.matplotlib.animations.PICTURES", 4)
    first = jaxbearing_command(*SIMULATE, "--json", "--out", "a.nc")
    assert (first.code, first.err) == (0, "")
    more = ("--duration", "1 ms", "--restart", "a.nc", "--json", "--animation", "b.gif", "--out", "b.nc")
    second = jaxbearing_command(*SIMULATE, *more)
    assert (second.code, second.err) == (0, "")
    before, after = json.loads(first.out), json.loads(second.out)
    np.testing.assert_allclose([after["time"]["start"], after["time"]["stop"]], [2e-3, 3e-3], rtol=1e-12)
    for name in ("minimum", "central"):
        start, end = after["summary"][name]["start"], before["summary"][name]["end"]
        np.testing.assert_allclose(start, end, rtol=1e-9)
    assert 10_000 < os.path.getsize("b.gif") < 400_000
    # what --out wrote of the second part can be gone on from too
    third = jaxbearing_command(*SIMULATE, "--duration", "1 ms", "--restart", "b.nc")
    assert third.code == 0
    assert "goes on from 3 ms" in third.out
    assert "4 ms in" in third.out


def test_restart_from_something_else_is_refused(jaxbearing_command, folder):
    jaxbearing_command(*SIMULATE, "--duration", "0.1 ms", "--out", "a.nc", "--json")
    (folder / "half.nc").write_bytes((folder / "a.nc").read_bytes()[:5000])
    fields = {"state_elements": (3, 30), "state_cage": (6,), "azimuth": (30,)}
    fields |= dict.fromkeys(("frame_angle", "frame_speed", "reference_speed"), ())
    variables = {
        name: (("time", *(f"{name}_{i}" for i in range(len(shape)))), np.zeros((1, *shape)))
        for name, shape in fields.items()
    }
    xr.Dataset(variables | {"time": ("time", np.zeros(1))}).to_netcdf("bearing.nc", engine="h5netcdf")
    jaxbearing_command(*SOLVE, "--out", "steady.nc", "--json")
    cases = [
        (SIMULATE, "bearing.nc", "a state of a bearing, for a scene of a line contact"),
        (("simulate", "turbine_roller_dynamic", "--duration", "1 ms"), "a.nc", "a state of a line contact"),
        ((*SIMULATE, "--set", "contact.nodes=201"), "a.nc", "contact.nodes is 101 there and 201 here"),
        ((*SIMULATE, "--set", "operation.load_per_length=80 N/mm"), "a.nc", "Hertz half width"),
        ((*SIMULATE, "--set", "contact.compressible=true"), "a.nc", "contact.compressible"),
        ((*SIMULATE, "--set", "materials.body_2.density=8 g/cm^3"), "a.nc", "materials.body_2.density is 7850 there"),
        (SIMULATE, "half.nc", "not a NetCDF file that can be read"),
        (SIMULATE, "gone.nc", "cannot be read"),
        (SIMULATE, "steady.nc", "not a transient run"),
    ]
    for arguments, path, reason in cases:
        result = jaxbearing_command(*arguments, "--restart", path)
        assert (result.code, result.out, result.err.count("\n")) == (2, "", 1), result.err
        assert result.err.startswith(f"error: --restart: found '{path}'")
        assert reason in result.err
        assert "expected a NetCDF file" in result.err


def test_light_loads(jaxbearing_command, folder):
    """M = 2.05: no film is shown, neither steady nor in time."""
    light = ("--set", "operation.load_per_length=5 N/mm")
    result = jaxbearing_command(*SOLVE, *light, "--json", "--out", "a.nc")
    assert result.code == 3
    assert "below 3" in result.err
    assert "rigid" in result.err
    solution = json.loads(result.out)
    assert (solution["converged"], solution["status"]) == (False, "outside_validity")
    assert solution["film"]["central"] is None
    run = jaxbearing_command(*SIMULATE, *light, "--json", "--out", "a.nc")
    assert run.code == 3
    assert "below 3" in run.err
    begun = json.loads(run.out)
    assert (begun["completed"], begun["status"]) == (False, "outside_validity")
    assert os.listdir(folder) == []


LEFT_OUT = ("contact.traction", "contact.thermal", "contact.rolling_resistance", "cage", "drag", "kinematics")
BALL = ("solve", "turbine_ball", *(part for name in LEFT_OUT for part in ("--set", f"{name}=none")))


def test_contact_of_a_ball_as_a_scene(jaxbearing_command, folder):
    """The file holds the contact to the last digit, and can be solved."""
    result = jaxbearing_command(*BALL, "--line-contact", "inner", "a.toml")
    assert (result.code, result.err) == (0, "")
    assert "wrote a.toml" in result.out
    scene = jb.load_scene("turbine_ball", dict.fromkeys(LEFT_OUT, "none"))
    line = line_contact_of(scene, jb.solve(scene))
    read = jb.load_scene(folder / "a.toml")
    for found, expected in zip(jax.tree.leaves(read), jax.tree.leaves(line), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-14)
    solved = jaxbearing_command("solve", "a.toml", "--set", "contact.nodes=101", "--json")
    assert solved.code == 0
    pressure = json.loads(jaxbearing_command(*BALL, "--json").out)["elements"]["pressure_inner"][0]
    np.testing.assert_allclose(json.loads(solved.out)["hertz"]["pressure"], pressure, rtol=1e-9)


def test_at_rest(jaxbearing_command, folder):
    result = jaxbearing_command(*SOLVE, "--set", "operation.entrainment_speed=0 m/s", "--json", "--out", "a.nc")
    assert result.code == 3
    assert "no steady film" in result.err
    solution = json.loads(result.out)
    assert (solution["converged"], solution["status"]) == (False, "no_equilibrium")
    assert solution["film"]["central"] is None
    assert os.listdir(folder) == []
    run = jaxbearing_command(*SIMULATE, "--set", "operation.entrainment_speed=0 m/s", "--json")
    assert run.code == 3
    assert json.loads(run.out)["completed"] is False


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("solve", NAME, "--set", "operation.load_per_length=3"), ["load_per_length", "76.31 N/mm"]),
        (("solve", NAME, "--set", "operation.load_per_length=none"), ["operation.load_per_length", "neither"]),
        (("solve", NAME, "--set", "contact.accuracy=0.05"), ["contact.accuracy", "0.002"]),
        (("solve", NAME, "--set", "contact.nodes=7"), ["contact.nodes", "51"]),
        (("solve", NAME, "--set", "contact.film=moes"), ["contact.film", "film_limit"]),
        ((*SIMULATE, "--interval", "1 us"), ["--interval", "every step"]),
        (("solve", NAME, "--line-contact", "inner", "a.toml"), ["--line-contact", "ball_bearing"]),
        (("solve", "turbine_roller", "--line-contact", "inner", "a.toml"), ["--line-contact", "ball_bearing"]),
        (("solve", "turbine_ball", "--line-contact", "middle", "a.toml"), ["--line-contact", "inner or outer"]),
        (("solve", "turbine_ball", "--line-contact", "inner", "a.txt"), ["--line-contact", ".toml"]),
        (("simulate", NAME, "--set", "simulation.speed_ramp.start=0"), ["simulation.speed_ramp.start", "no film"]),
        (("simulate", NAME, "--set", "simulation.duration=none"), ["--duration"]),
        (("simulate", NAME, "--set", "simulation.speed_table.times=['0 ms']"), ["simulation.speed_table"]),
    ],
    ids=str,
)
def test_refused(arguments, words, jaxbearing_command, folder):
    result = jaxbearing_command(*arguments)
    assert (result.code, result.out) == (2, "")
    # one line for each problem, below a line that counts them where there are several
    lines = result.err.strip().splitlines()
    assert len(lines) == 1 or f"{len(lines) - 1} problems" in lines[0]
    for word in ("found", "expected", *words):
        assert word in result.err
    assert os.listdir(folder) == []


def test_a_load_as_pressure_and_other_laws_of_time(jaxbearing_command):
    changes = ("--set", "operation.pressure=1.06 GPa", "--set", "contact.compressible=true")
    solution = json.loads(jaxbearing_command(*SOLVE, *changes, "--json").out)
    np.testing.assert_allclose(solution["hertz"]["pressure"], 1.06e9, rtol=1e-12)
    law = ("--set", "simulation.speed_perturbation={frequency='50 Hz', amplitude=0.5}")
    assert json.loads(jaxbearing_command(*SIMULATE, *law, "--json").out)["completed"] is True
