"""Where people write "1,5" and programs are told so: numbers keep their point, and files are read alike."""

import locale
import os
import shutil
import subprocess

import numpy as np
import pytest
import xarray as xr
from command_process import DRY, run
from fit_results import MEDIAN

from fitting.io import read_curves
from jaxbearing.scenes.time_tables import read_time_table
from jaxbearing.sweeps.case_lists import list_of
from jaxbearing.sweeps.fields import SceneSource

NAME = "de_DE.UTF-8"
ADOPT = "import locale; assert locale.setlocale(locale.LC_ALL, ''); assert locale.localeconv()['decimal_point'] == ','"
CASES = "operation.radial_load [kN],drag.coefficient\n5.5,0.25\n1e1,.5\n"


@pytest.fixture(scope="module")
def locales(tmp_path_factory):
    """A folder with a locale of decimal commas, made for these tests."""
    if shutil.which("localedef") is None:
        pytest.skip("no localedef")
    folder = tmp_path_factory.mktemp("locales")
    made = subprocess.run(
        ["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / NAME)], capture_output=True, check=False
    )
    if not (folder / NAME).is_dir():
        pytest.skip(f"no locale: {made.stderr.decode(errors='replace')}")
    return folder


@pytest.fixture
def decimal_comma(locales, monkeypatch):
    """In this process, down to the C library."""
    monkeypatch.setenv("LOCPATH", str(locales))
    before = locale.setlocale(locale.LC_ALL)
    locale.setlocale(locale.LC_ALL, NAME)
    assert locale.str(1.5) == "1,5"
    yield
    locale.setlocale(locale.LC_ALL, before)


@pytest.mark.usefixtures("decimal_comma")
def test_tables_are_read_alike(tmp_path):
    file = tmp_path / "table.csv"
    file.write_text("time [ms],speed [rpm]\n0,7000.5\n2.5,1.4e4\n", encoding="utf-8")
    table = read_time_table(str(file), "speed", "simulation.speed_table.file")
    np.testing.assert_allclose(table.times, [0.0, 2.5e-3], rtol=1e-15)
    np.testing.assert_allclose(table.values * 30.0 / np.pi, [7000.5, 14000.0], rtol=1e-15)
    file.write_text(CASES, encoding="utf-8")
    _, cases = list_of(file, SceneSource.of("reference_roller"))
    np.testing.assert_array_equal(cases.values, [[5500.0, 10000.0], [0.25, 0.5]])
    assert read_curves(MEDIAN).traction_coefficient[0] == 0.0039


@pytest.mark.slow
def test_results_are_written_alike(locales, tmp_path):
    found = []
    for name, variables in (("plain", {}), ("comma", {"before": ADOPT, "LC_ALL": NAME, "LOCPATH": str(locales)})):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "cases.csv").write_text(CASES, encoding="utf-8")
        screen = run(folder, "solve", "reference_roller", *DRY, "--plot", "a.svg", **variables)
        assert screen[0] == 0, screen[2]
        assert run(folder, "report", "reference_roller", *DRY, "--out", "a.html", **variables)[0] == 0
        assert (
            run(folder, "sweep", "reference_roller", *DRY, "--list", "cases.csv", "--out", "a.nc", **variables)[0] == 0
        )
        page = (folder / "a.html").read_text(encoding="utf-8")
        # the page says when it was made
        page = "\n".join(line for line in page.splitlines() if "UTC" not in line)
        with xr.open_dataset(folder / "a.nc") as dataset:
            radial = dataset["ring_radial"].values.tolist()
        found.append((screen[1], page, radial))
    plain, comma = found
    assert comma == plain
    assert os.path.getsize(tmp_path / "comma" / "a.svg") == pytest.approx(
        os.path.getsize(tmp_path / "plain" / "a.svg"), rel=0.01
    )
