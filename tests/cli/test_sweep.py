"""`sweep`: grids, lists and samples from the command line, exit codes, what is refused before the work."""

import csv
import json
import os
import re
import subprocess
import sys

import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from filled_results import MadeUpProgram

from jaxbearing.report import plots

DRY = ("reference_roller", "--set", "contact=none")
SPEED = "operation.inner_speed=5000 rpm:15000 rpm:3"
LOAD = "operation.radial_load=5 kN:20 kN:3:log"


@pytest.fixture
def made_up(monkeypatch):
    """Results without a solve."""
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)


def test_grid_json(jaxbearing_command, folder):
    result = jaxbearing_command("sweep", *DRY, "--over", SPEED, "--over", LOAD, "--json", "--chunk", "4")
    assert result.code == 0, result.err
    found = json.loads(result.out)
    seconds = found.pop("seconds")
    assert found == {"cases": 9, "converged": 9, "failed": 0, "file": "reference_roller_sweep.nc"}
    assert seconds > 0
    assert os.listdir(folder) == ["reference_roller_sweep.nc"]
    with xr.open_dataset(found["file"]) as dataset:
        rpm = dataset["operation_inner_speed"] * 60 / (2 * np.pi)
        np.testing.assert_allclose(rpm, [5000, 10000, 15000], rtol=1e-14)
        np.testing.assert_allclose(dataset["operation_radial_load"], [5e3, 1e4, 2e4], rtol=1e-14)
        assert dataset["operation_inner_speed"].attrs["units"] == "rad s-1"
        assert dataset["ring_radial"].shape == (3, 3)
        assert "--set contact=none" in dataset.attrs["title"]
    # again: it is there, and the table has the cases of the grid in the order of the fields
    again = jaxbearing_command("sweep", *DRY, "--over", SPEED, "--over", LOAD, "--chunk", "4")
    assert again.code == 0
    cases = [line.split()[:2] for line in again.out.splitlines() if re.match(r" +\d+ +\d+ ", line)]
    assert cases == [[speed, load] for speed in ("5000", "10000", "15000") for load in ("5000", "10000", "20000")]
    assert "ALL CONVERGED" in again.out
    assert "nothing is computed" in again.err
    assert max(len(line) for line in again.out.splitlines()) <= 100
    # another one is not written over it
    other = jaxbearing_command("sweep", *DRY, "--over", SPEED, "--json")
    assert other.code == 2
    assert "reference_roller_sweep.nc" in other.err
    assert "--overwrite" in other.err
    assert other.out == ""


def test_list_with_units_and_a_case_that_fails(jaxbearing_command, folder):
    (folder / "cases.csv").write_text(
        "# from the drawing office\n"
        "operation.radial_load [kN]; geometry.roller_diameter [mm]; operation.oil_temperature [degC]\n"
        "10; 12; 80\n20; 15; 80\n30; 11.5; 120\n",
        encoding="utf-8",
    )
    arguments = ("--list", "cases.csv", "--out", "l.nc", "--chunk", "4", "--table", "t.csv")
    result = jaxbearing_command("sweep", *DRY, *arguments)
    assert result.code == 0, result.err
    assert "1 FAILED" in result.out
    assert "wrote t.csv: one case a row" in result.out
    # on the screen: each case with its fields and main results
    (failed,) = (line.split() for line in result.out.splitlines() if line.split()[4:] == ["-"])
    assert failed == ["20000", "15.00", "353.1", "failed", "-"]
    rows = list(csv.reader((folder / "t.csv").read_text(encoding="utf-8").splitlines()))
    heads = ["operation.radial_load [N]", "geometry.roller_diameter [mm]", "operation.oil_temperature [K]"]
    assert rows[0][:3] == heads
    assert [row[-1] == "converged" for row in rows[1:]] == [True, False, True]
    assert "do not fit on a pitch circle" in rows[2][-1]
    place = rows[0].index("ring_radial [um]")
    assert rows[2][place] == ""
    fields = ("operation_radial_load", "geometry_roller_diameter", "operation_oil_temperature")
    with xr.open_dataset("l.nc") as dataset:
        for case, row in enumerate(rows[1:]):
            given = [factor * float(dataset[name][case]) for name, factor in zip(fields, (1.0, 1e3, 1.0), strict=True)]
            assert [float(cell) for cell in row[:3]] == pytest.approx(given, rel=1e-9)
            if row[place]:
                assert float(row[place]) == pytest.approx(1e6 * float(dataset["ring_radial"][case]), rel=1e-9)
    assert "do not fit on a pitch circle" in " ".join(result.out.split())
    with xr.open_dataset("l.nc") as dataset:
        assert dataset["operation_radial_load"].values.tolist() == [1e4, 2e4, 3e4]
        np.testing.assert_allclose(dataset["operation_oil_temperature"], [353.15, 353.15, 393.15], rtol=1e-15)
        assert dataset["status"].values.tolist() == [0, 4, 0]
        assert dataset["status"].attrs["flag_meanings"].split()[1] == "not_converged"


class SecondYields(MadeUpProgram):
    """The life by the formulas is there all the same."""

    def __call__(self, inputs, active, progress=lambda lanes: None):
        solution = super().__call__(inputs, active, progress)
        object.__setattr__(solution.life, "static_load", solution.life.static_capacity * jnp.asarray([0.25, 2.5]))
        return solution


def test_a_bearing_that_yields_has_no_life(jaxbearing_command, folder, monkeypatch):
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", SecondYields)
    over = ("--over", "operation.radial_load=2 kN:20 kN:2", "--set", "rating.static_capacity=8 kN")
    result = jaxbearing_command("sweep", *DRY, *over, "--out", "y.nc", "--table", "y.csv")
    assert result.code == 0, result.err
    (marked,) = (line for line in result.out.splitlines() if line.split()[1:2] == ["yields"])
    assert marked.split()[0] == "20000"
    assert "in 1 case elements and races yield (static safety below 1): these have no life" in result.out
    good, bad = csv.DictReader((folder / "y.csv").read_text(encoding="utf-8").splitlines())
    assert (good["status"], bad["status"]) == ("converged", "yields")
    assert float(good["life_L10h [h]"]) > 0.0
    assert all(bad[name] == "" for name in bad if name.startswith("life_L"))
    assert float(bad["life_static_safety"]) < 1.0


def test_no_case_converges(jaxbearing_command):
    sizes = "geometry.roller_diameter=15 mm:16 mm:2"
    result = jaxbearing_command("sweep", *DRY, "--over", sizes, "--json")
    assert result.code == 2  # none of them is a scene
    assert "do not fit" in result.err


@pytest.mark.usefixtures("made_up")
def test_samples(jaxbearing_command):
    ranges = ("--over", "operation.radial_load=5 kN:20 kN:log", "--over", "geometry.diametral_clearance=0 um:50 um")
    result = jaxbearing_command("sweep", *DRY, *ranges, "--latin-hypercube", "5", "--json", "--chunk", "4")
    assert json.loads(result.out)["converged"] == 5
    with xr.open_dataset("reference_roller_sweep.nc") as dataset:
        parts = np.sort(dataset["geometry_diametral_clearance"].values) / 1e-5
        assert np.floor(parts).tolist() == [0, 1, 2, 3, 4]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "--over: found nothing"),
        (("--over", "operation.inner_sped=1 rpm:2 rpm:3"), "Did you mean 'inner_speed'"),
        (("--over", "operation.inner_speed=1:2:3"), "a number without a unit"),
        (("--over", "operation.inner_speed=1 rpm:2 rpm"), "expected NAME=START:STOP:COUNT"),
        (("--over", "operation.inner_speed=1 rpm:2 rpm:0"), "a whole number of values"),
        (("--over", "operation.inner_speed=1 rpm:1 rpm:3"), "a stop that differs"),
        (("--over", "operation.inner_speed=0 rpm:1 rpm:3:log"), "logarithmic spacing needs"),
        (("--over", "operation.radial_load=-1 N:1 N:3"), "a force > 0"),
        (("--over", SPEED, "--over", SPEED), "this field twice"),
        (("--over", "geometry.n_rollers=10:20:11"), "geometry.n_rollers: found a whole number"),
        (("--over", "cage.guidance=1:2:3"), "a choice of words"),
        (("--over", "cage=1:2:3"), "a table"),
        (("--over", "rating.edge_factor=1:2:3"), "a switch"),
        (("--over", SPEED, "--random", "5"), "expected NAME=START:STOP or"),
        (("--over", SPEED, "--set", "operation.inner_speed=3 rpm"), "a field that --set gives too"),
        (("--over", "operation.inner_speed=1 rpm:2 rpm", "--random", "0"), "found 0 cases"),
        (("--over", "operation.inner_speed=1 rpm:9 rpm:9999999", "--over", LOAD), "cases are too many"),
        (("--over", SPEED, "--out", "a.txt"), "ends in .nc or .zarr"),
        (("--over", SPEED, "--out", "no/a.nc"), "an existing folder"),
        (("--over", SPEED, "--table", "a.xlsx"), "ends in '.csv'"),
        (("--over", SPEED, "--list", "a.csv"), "one way to choose"),
        (("--list", "a.csv"), "no such file"),
        (("--over", SPEED, "--workers", "2", "--scheduler", "tcp://a:1"), "one of the two"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else None,
)
def test_refused_before_the_work(jaxbearing_command, folder, arguments, words):
    result = jaxbearing_command("sweep", *DRY, *arguments, "--json")
    assert result.code == 2
    assert words in result.err
    assert result.out == ""
    assert os.listdir(folder) == []


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("operation.inner_speed\n1000\n", "a number without a unit"),
        ("operation.inner_speed [mm]\n1000\n", "of another kind"),
        (
            "operation.inner_speed [rpm]\n1000\nx\n",
            "line 3: operation.inner_speed: found the text 'x'; expected a number",
        ),
        ("operation.inner_speed [rpm], operation.radial_load [N]\n1000\n", "line 2: found 1 cell; expected 2"),
        ("operation.radial_load [N]\n1000\n-5\n", "line 3: operation.radial_load: found the text '-5 N'"),
        ("speed [rpm]\n1000\n", "unknown name 'speed'"),
        ("drag.coefficient [N]\n1\n", "a number without a unit"),
        ("operation.inner_speed [rpm]\n", "no rows"),
        ("", "expected a CSV file"),
    ],
)
def test_lists_that_are_refused(jaxbearing_command, folder, text, words):
    (folder / "cases.csv").write_text(text, encoding="utf-8")
    result = jaxbearing_command("sweep", "reference_roller", "--list", "cases.csv")
    assert result.code == 2
    assert words in result.err
    assert os.listdir(folder) == ["cases.csv"]


_LIMITED = """
import resource, runpy, sys
limit = {limit}
if limit:
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
sys.argv = ["jaxbearing", "sweep", *sys.argv[1:]]
runpy.run_module("jaxbearing", run_name="__main__")
"""


def command(folder, *arguments, limit=None):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "JAXBEARING_CACHE": "off"}
    program = [sys.executable, "-c", _LIMITED.format(limit=limit), *arguments]
    return subprocess.run(program, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_a_full_disk(tmp_path):
    """No file may grow beyond a limit: for the chunks first, then for the whole. Nothing that was there is lost."""
    arguments = (*DRY, "--over", "operation.radial_load=5 kN:20 kN:900", "--chunk", "100", "--json")
    chunks = tmp_path / "reference_roller_sweep.nc.chunks"
    none = command(tmp_path, *arguments, limit=100_000)
    assert none.returncode == 1
    assert none.stderr.startswith("error: the output cannot be written: reference_roller_sweep.nc: File too large")
    assert not list(chunks.glob("*.npz"))
    part = command(tmp_path, *arguments, limit=1_000_000)
    assert part.returncode == 1
    assert "cannot be written" in part.stderr
    assert len(list(chunks.glob("*.npz"))) == 9
    assert not (tmp_path / "reference_roller_sweep.nc").exists()
    done = command(tmp_path, *arguments)
    assert "900 of 900 cases are there" in done.stderr
    assert json.loads(done.stdout)["converged"] == 900


@pytest.mark.slow
def test_one_and_two_devices_give_the_same_data(tmp_path):
    found = []
    for devices in ("1", "2"):
        over = ("--over", "operation.radial_load=5 kN:20 kN:600", "--devices", devices, "--out", f"{devices}.nc")
        assert command(tmp_path, *DRY, *over).returncode == 0
        found.append(xr.load_dataset(tmp_path / f"{devices}.nc"))
    for name, variable in found[0].variables.items():
        if variable.dtype.kind == "f":
            assert variable.values.tobytes() == found[1][name].values.tobytes()


@pytest.mark.usefixtures("made_up")
@pytest.mark.parametrize(
    ("over", "panels"), [((SPEED,), 1), ((SPEED, LOAD, "geometry.contact_length=11 mm:12 mm:1"), 2)]
)
def test_picture(over, panels, jaxbearing_command, folder, monkeypatch):
    """Without losses and ratings: the stiffness, as a line or as a map with its colour bar."""
    drawn = []
    saved = plots.save_plot
    monkeypatch.setattr(plots, "save_plot", lambda figure, path: (drawn.append(figure), saved(figure, path)))
    options = [word for one in over for word in ("--over", one)]
    result = jaxbearing_command("sweep", *DRY, *options, "--out", "a.nc", "--plot", "a.png", "--chunk", "4")
    assert (result.code, sorted(os.listdir(folder))) == (0, ["a.nc", "a.png"]), result.err
    (figure,) = drawn
    assert len(figure.axes) == panels
    with xr.open_dataset("a.nc") as dataset:
        if panels == 1:
            stiffness = dataset.stiffness.sel(freedom="radial", freedom_displaced="radial")
            np.testing.assert_allclose(figure.axes[0].lines[0].get_ydata(), 1e-6 * stiffness, rtol=1e-12)
    assert "inner ring speed, rpm" in (figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel())


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--over", SPEED, "--plot", "a.txt"), ["--plot", "'a.txt'"]),
        (("--over", SPEED, "--plot", "no/a.png"), ["--plot", "existing folder"]),
        (
            ("--over", SPEED, "--over", LOAD, "--over", "drag.coefficient=0.1:1:2", "--plot", "a.png"),
            ["--plot", "3 fields"],
        ),
        (("--over", "drag.coefficient=0.1:1", "--random", "4", "--plot", "a.png"), ["--plot", "no grid"]),
    ],
)
def test_no_picture_of_this(arguments, words, jaxbearing_command, folder):
    result = jaxbearing_command("sweep", "reference_roller", *arguments)
    assert (result.code, os.listdir(folder)) == (2, [])
    assert all(word in result.err for word in words)
