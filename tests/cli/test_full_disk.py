"""A disk that fills up while a verb writes: the results are shown all the same, the file is not there, nothing is left
behind, and one sentence says so."""

import contextlib
import json
import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from command_process import environment
from filled_results import MadeUpProgram, history_of, solution_of
from fit_results import MEDIAN, made_up
from full_places import REASONS, left, no_room, small_folder
from matplotlib.figure import Figure

import fitting.fit  # noqa: F401  (by its full name in sys.modules)
import jaxbearing as jb

DRY = ("reference_roller", "--set", "contact=none")
RUN = ("simulate", "satellite_contact_1", "--duration", "2 ms")
FIT = ("fit", str(MEDIAN), "--scene", "two_disk_etm")
CASES = {
    "solve, data": (("solve", *DRY, "--json", "--out"), "a.nc", "json"),
    "solve, data and screen": (("solve", *DRY, "--out"), "a.nc", "CONVERGED"),
    "solve, picture": (("solve", *DRY, "--json", "--plot"), "a.png", "json"),
    "report": (("report", *DRY, "--out"), "a.html", "CONVERGED"),
    "report, object": (("report", *DRY, "--json", "--out"), "a.html", "json"),
    "stiffness": (("stiffness", *DRY, "--speeds", "1 rpm:9 rpm:2", "--json", "--ross"), "a.toml", "json"),
    "run, data": ((*RUN, "--json", "--out"), "a.nc", "json"),
    "run, picture": ((*RUN, "--json", "--plot"), "a.svg", "json"),
    "run, animation": ((*RUN, "--json", "--animation"), "a.gif", "json"),
    "fit, oil": ((*FIT, "--json", "--out"), "a.toml", "json"),
    "fit, picture": ((*FIT, "--plot"), "a.pdf", "CONVERGED"),
    "study, data": (("study", "reference_roller", "--out"), "a.nc", "the study"),
    "study, picture": (("study", "reference_roller", "--plot"), "a.png", "the study"),
    "scenes": (("scenes", "--copy", "turbine_ball", "--to"), "a.toml", ""),
}


@pytest.fixture
def made_up_results(monkeypatch):
    """In place of what takes long."""
    monkeypatch.setattr(jb, "simulate", jb.simulate)  # each command takes the verbs anew
    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", solution_of)
    monkeypatch.setattr(sys.modules["jaxbearing.simulate"], "simulate", lambda scene, *_, **__: history_of(scene))
    monkeypatch.setattr(sys.modules["fitting.fit"], "fit", lambda data, scene, options: made_up(scene))
    monkeypatch.setattr("fitting.io.plots.smooth_curves", lambda *_: [(np.zeros(2),) * 2])
    monkeypatch.setattr("fitting.io.plots._draw_curves", lambda *_: None)
    monkeypatch.setattr("fitting.io.plots._draw_legend", lambda *_: None)
    panel = xr.Dataset({"power_loss_total": ("x", [1.0, 2.0], {"units": "W"})})
    found = SimpleNamespace(cases=2, failed=0, tree=lambda: xr.DataTree.from_dict({"figure_39a": panel}))
    monkeypatch.setattr("jaxbearing.studies.power_loss_study", lambda scene: found)
    monkeypatch.setattr("jaxbearing.studies.claims_of", lambda found: [])
    monkeypatch.setattr("jaxbearing.studies.pictures.study_page", lambda found, label: Figure())
    monkeypatch.setattr("jaxbearing.cli.study_verb._print", lambda *_: print("the study"))


@pytest.mark.usefixtures("made_up_results")
@pytest.mark.parametrize(
    ("case", "kind"), [*((case, "full disk") for case in CASES), ("solve, data", "limit"), ("scenes", "limit")]
)
def test_results_are_shown_and_nothing_is_left_behind(case, kind, jaxbearing_command, tmp_path, monkeypatch):
    arguments, name, shown = CASES[case]
    monkeypatch.setattr("jaxbearing.report.backends.matplotlib.animations.PICTURES", 3)
    place = tmp_path / "place"
    with no_room(kind, place, monkeypatch):
        result = jaxbearing_command(*arguments, str(place / name))
        assert left(place) == []
    assert result.code == 1
    assert result.err.count("\n") == 1
    assert result.err.startswith("error: ")
    assert str(place / name) in result.err
    assert any(reason in result.err for reason in REASONS)
    if shown == "json":
        assert isinstance(json.loads(result.out), dict)
    else:
        assert shown in result.out
    assert "wrote" not in result.out


SWEEP = ("sweep", *DRY, "--over", "operation.radial_load=5 kN:9 kN:4", "--without-elements")


def test_a_sweep_that_has_no_room_for_its_file(jaxbearing_command, tmp_path, monkeypatch):
    """The counts are shown; what was computed stays, and the same command goes on there."""
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)
    with small_folder(tmp_path / "place", 2_100) as place:
        (place / "filler").write_bytes(bytes(2_000_000))
        command = (*SWEEP, "--out", str(place / "a.nc"))
        result = jaxbearing_command(*command, "--json")
        assert (result.code, left(place)) == (1, ["a.nc.chunks"])
        found = json.loads(result.out)
        assert (found["cases"], found["converged"], found["failed"], found["file"]) == (4, 4, 0, None)
        for words in (f"cannot be written: {place / 'a.nc'}: No space left on device", "4 of 4 cases are kept in"):
            assert words in result.err
        result = jaxbearing_command(*command)
        assert result.code == 1
        assert "NOT WRITTEN" in result.out
        assert "4 of 4 cases computed, 4 converged" in result.out
        (place / "filler").unlink()
        result = jaxbearing_command(*command)
        assert (result.code, left(place)) == (0, ["a.nc"]), result.err
        assert "4 of 4 cases are there from an earlier run" in result.err


@pytest.mark.parametrize("suffix", ["nc", "zarr"])
def test_a_sweep_that_has_no_room_at_all(suffix, jaxbearing_command, tmp_path, monkeypatch):
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)
    place = tmp_path / "place"
    with no_room("full disk", place, monkeypatch):
        result = jaxbearing_command(*SWEEP, "--out", str(place / f"a.{suffix}"))
        assert (result.code, left(place)) == (1, [])
        assert result.err.count("\n") == 1


@pytest.mark.usefixtures("made_up_results")
def test_files_are_written_although_nobody_reads_the_screen(jaxbearing_command, folder, monkeypatch):
    """As of `jaxbearing solve ... | head -1`."""
    reader, writer = os.pipe()
    os.close(reader)
    with contextlib.suppress(BrokenPipeError), os.fdopen(writer, "w") as gone:
        monkeypatch.setattr("sys.stdout", gone)
        result = jaxbearing_command("solve", *DRY, "--json", "--out", "a.nc")
    assert result == (1, "", "")
    assert left(folder) == ["a.nc"]


def test_a_process_whose_reader_has_gone_ends_without_a_word(tmp_path):
    """Neither the command nor the interpreter, which flushes at exit, says anything."""
    line = f"'{sys.executable}' -m jaxbearing scenes | true; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", line], cwd=tmp_path, env=environment(), capture_output=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (1, b"", b"")
