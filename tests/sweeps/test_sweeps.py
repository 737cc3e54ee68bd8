"""Sweeps: the same numbers as single solves, failed cases, files that survive kills and damage, what is refused."""

import io
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from filled_results import MadeUpProgram
from rich.console import Console
from roller_cases import dry_roller

import jaxbearing as jb
from jaxbearing.report.sweep_summary import print_sweep
from jaxbearing.sweeps import latin_hypercube, listed
from jaxbearing.sweeps.chunks import chunk_path, read_chunk
from jaxbearing.sweeps.engine import SweepError, Watcher, chunk_folder, run
from jaxbearing.sweeps.verb import plan_in_scene

OVER = {
    "operation.radial_load": np.linspace(2e3, 40e3, 5),
    "geometry.diametral_clearance": np.asarray([1e-5, 3e-5, 5e-5]),
}


class StoppedError(Exception):
    pass


@pytest.fixture(scope="module", autouse=True)
def kept_programs(tmp_path_factory):
    """Sweeps of one structure share their program, as those of a user."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("JAXBEARING_CACHE", str(tmp_path_factory.mktemp("programs")))
        yield


@pytest.fixture(scope="module")
def scene():
    return dry_roller()


@pytest.fixture(scope="module")
def whole(scene):
    """The sweep in one go, in memory."""
    return jb.sweep(scene, OVER, chunk=4)


def assert_same_data(one, other):
    """To the bit, NaN included."""
    assert set(one.variables) == set(other.variables)
    for name, variable in one.variables.items():
        again = other[name]
        assert variable.dims == again.dims
        if variable.dtype.kind in "fiub":
            assert variable.values.tobytes() == again.values.tobytes(), name
        else:
            assert variable.values.astype(object).tolist() == again.values.astype(object).tolist(), name


def plan_of(scene, over=OVER, **more):
    return plan_in_scene(scene, over, **({"chunk": 4} | more))


def stopped_after(plan, target, chunks):
    """A run that ends in the middle."""
    from jaxbearing.sweeps.engine import in_process

    def runner(folder, plan, missing, progress):
        for number, done in enumerate(in_process()(folder, plan, missing, progress)):
            yield done
            if number + 1 == chunks:
                raise StoppedError

    with pytest.raises(StoppedError):
        run(plan, target, runner=runner)
    assert not target.exists()


def finished(plan, target, **more):
    """The data set, the notes and how many cases were computed in this run."""
    notes, counts = [], []
    outcome = run(plan, target, watcher=Watcher(cases=counts.append, note=notes.append), **more)
    assert not chunk_folder(target).exists()
    assert sum(counts) == outcome.cases
    return xr.load_dataset(target), notes, outcome.cases - outcome.kept


def test_every_case_is_a_single_solve_and_labelled(whole, scene):
    load, clearance = (f"{path.replace('.', '_')}" for path in OVER)
    assert whole["ring_radial"].dims == (load, clearance)
    assert whole["load_inner"].dims == (load, clearance, "element")
    assert whole["azimuth"].dims == ("element",)
    for q, j in ((1, 2), (4, 0)):
        values = {path: float(axis[i]) for (path, axis), i in zip(OVER.items(), (q, j), strict=True)}
        one = jb.solve(scene.replace(values))
        found = whole.isel({load: q, clearance: j})
        np.testing.assert_allclose(found["ring_radial"], one.ring.radial, rtol=1e-12)
        np.testing.assert_allclose(found["load_inner"], one.elements.load_inner, rtol=1e-9, atol=1e-9)
    for name, variable in whole.variables.items():
        assert variable.attrs["units"], name
        assert variable.attrs["long_name"], name
    assert whole[load].attrs["units"] == "N"
    assert whole[clearance].attrs == {
        "units": "m",
        "long_name": "diametral clearance",
        "path": "geometry.diametral_clearance",
    }
    assert whole["operation_outer_speed"].shape == ()
    assert whole.attrs["sweep_fields"].split() == list(OVER)
    assert set(whole["failure"].values.ravel().tolist()) == {""}
    table = whole["ring_radial"].to_dataframe()
    assert len(table) == 15


def test_lanes_do_not_depend_on_their_chunk_nor_on_their_neighbours(scene, whole):
    rows = np.meshgrid(*OVER.values(), indexing="ij")
    cases = listed({path: row.ravel()[2:9] for path, row in zip(OVER, rows, strict=True)})
    part = jb.sweep(scene, cases, chunk=4)
    for name in ("ring_radial", "load_outer"):
        values = whole[name].values.reshape(15, -1)[2:9]
        assert values.tobytes() == part[name].values.tobytes()


def test_failed_cases_are_flagged_and_say_why(scene, tmp_path):
    """One that the scene refuses, and one that the solver cannot solve; their neighbour is what it would be alone."""
    cases = listed({"geometry.roller_diameter": [0.012, 0.0151, 0.012], "operation.radial_load": [2e4, 2e4, 2.5e4]})
    found = jb.sweep(scene, cases, chunk=4, elements=False, out=tmp_path / "failed.nc")
    assert found["status"].values.tolist() == [0, 4, 0]
    assert "do not fit on a pitch circle" in str(found["failure"].values[1])
    assert found["failure"].values[[0, 2]].tolist() == ["", ""]
    assert np.isnan(found["ring_radial"].values).tolist() == [False, True, False]
    assert np.isfinite(found["geometry_roller_diameter"].values).all()
    assert "load_inner" not in found
    steps = jb.NewtonOptions(max_steps=1, continuation=False)
    failed = jb.sweep(scene, {"operation.radial_load": [1e3, 2e4]}, options=steps, chunk=4)
    assert set(failed["status"].values.tolist()) == {1}
    assert all("not_converged after" in text for text in failed["failure"].values.tolist())


def test_cases_without_a_scene_may_stand_anywhere(scene):
    """Rollers of 50 mm, and of less than nothing, do not fit: the order of the cases has no say, and the one program is
    made from a case that has a scene, be it none of the corners."""
    path = "geometry.roller_diameter"
    orders = ([50e-3, 13e-3, 6e-3], [6e-3, 13e-3, 50e-3], [50e-3, 6e-3, -1e-3], [-1e-3, 50e-3, 6e-3, 40e-3])
    for values in orders:
        for over in ({path: values}, listed({path: values})):
            plan = plan_of(scene, over)
            assert plan.recipe.example((path,))[path] in (6e-3, 13e-3)
            reasons = plan.recipe.inputs(plan.cases.part(0, len(values)))[1]
            assert [bool(reason) for reason in reasons] == [value not in (6e-3, 13e-3) for value in values]
            plan.program()
    with pytest.raises(ValueError, match="do not fit on a pitch circle"):
        plan_of(scene, {path: [50e-3, 60e-3, 55e-3]})


def test_a_run_that_ends_in_the_middle_goes_on(scene, whole, tmp_path):
    target = tmp_path / "sweep.nc"
    stopped_after(plan_of(scene), target, 2)
    again, notes, computed = finished(plan_of(scene), target)
    assert_same_data(again, whole)
    assert computed == 15 - 8
    assert notes == ["8 of 15 cases are there from an earlier run"]
    # once more: nothing is left to do
    same, notes, computed = finished(plan_of(scene), target)
    assert computed == 0
    assert "has this sweep already" in notes[0]
    assert_same_data(same, whole)


def test_damaged_chunks_are_computed_again(scene, whole, tmp_path):
    target = tmp_path / "sweep.nc"
    folder = chunk_folder(target)
    stopped_after(plan_of(scene), target, 3)
    cut, flipped = chunk_path(folder, 0), chunk_path(folder, 1)
    cut.write_bytes(cut.read_bytes()[:-100])
    data = bytearray(flipped.read_bytes())
    with zipfile.ZipFile(flipped) as members:  # within the numbers: some bytes of a zip file mean nothing
        largest = max(members.infolist(), key=lambda member: member.compress_size)
    data[largest.header_offset + largest.compress_size // 2] ^= 1
    flipped.write_bytes(data)
    (folder / ".chunk-000003.npz.1.part").write_bytes(b"half a chunk")
    again, notes, computed = finished(plan_of(scene), target)
    assert_same_data(again, whole)
    assert computed == 15 - 4
    assert sum("damaged chunk" in note for note in notes) == 2


def test_chunks_of_another_sweep_are_not_mixed_in_nor_dropped(scene, tmp_path):
    target = tmp_path / "sweep.nc"
    stopped_after(plan_of(scene), target, 2)
    before = {path.name: path.read_bytes() for path in chunk_folder(target).iterdir()}
    other = plan_of(scene.replace_geometry(roller_length=0.015))
    for different in (other, plan_of(scene, chunk=5), plan_of(scene, elements=False)):
        with pytest.raises(SweepError, match="chunks of another sweep"):
            run(different, target)
        assert {path.name: path.read_bytes() for path in chunk_folder(target).iterdir()} == before
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("jaxbearing.sweeps.plan._source", lambda: "another version of the package")
        with pytest.raises(SweepError, match="another version"):
            run(plan_of(scene), target)
    assert {path.name: path.read_bytes() for path in chunk_folder(target).iterdir()} == before
    found, _, computed = finished(other, target, overwrite=True)
    assert computed == 15
    assert found.attrs["sweep_key"] == other.key


def test_a_file_that_is_there_is_kept(scene, tmp_path):
    target = tmp_path / "mine.nc"
    target.write_text("mine", encoding="utf-8")
    with pytest.raises(ValueError, match="there already"):
        jb.sweep(scene, OVER, out=target, chunk=4)
    assert target.read_text(encoding="utf-8") == "mine"
    assert os.listdir(tmp_path) == ["mine.nc"]
    assert jb.sweep(scene, OVER, out=target, chunk=4, overwrite=True)["status"].shape == (5, 3)
    with pytest.raises(ValueError, match="another sweep"):
        jb.sweep(scene, {"operation.radial_load": [1e3]}, out=target, chunk=4)


def test_no_space_left(scene, whole, tmp_path, monkeypatch):
    """For a chunk, and for the whole: what was computed stays, and the run goes on when there is space."""
    target = tmp_path / "sweep.nc"
    save, calls = np.savez, []

    def full(*args, **kwargs):
        calls.append(None)
        if len(calls) == 4:  # the plan, and two chunks
            raise OSError(28, "No space left on device")
        return save(*args, **kwargs)

    monkeypatch.setattr(np, "savez", full)
    with pytest.raises(OSError, match="No space left"):
        run(plan_of(scene), target)
    files = sorted(path.name for path in chunk_folder(target).iterdir() if path.suffix == ".npz")
    assert files == ["chunk-000000.npz", "chunk-000001.npz"]
    usage = type("Usage", (), {"free": 1000})
    monkeypatch.setattr("jaxbearing.sweeps.gather.shutil.disk_usage", lambda path: usage)
    with pytest.raises(OSError, match="the whole sweep needs"):
        run(plan_of(scene), target)
    monkeypatch.undo()
    again, _, computed = finished(plan_of(scene), target)
    assert computed == 0
    assert_same_data(again, whole)


def test_one_process_at_a_time(scene, tmp_path):
    import fcntl

    target = tmp_path / "sweep.nc"
    chunk_folder(target).mkdir()
    with (chunk_folder(target) / "lock").open("a") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        with pytest.raises(SweepError, match="another process"):
            run(plan_of(scene), target)


def test_another_process_that_finishes_at_this_moment(scene, tmp_path, monkeypatch):
    """It removes the folder with the lock while this one is at the door: what it wrote is found."""
    import fcntl

    plan, elsewhere, target = plan_of(scene), tmp_path / "elsewhere.nc", tmp_path / "sweep.nc"
    run(plan, elsewhere)
    lock, notes = fcntl.flock, []

    def late(file, how):
        if not target.exists():
            shutil.rmtree(chunk_folder(target))
            elsewhere.rename(target)
        return lock(file, how)

    monkeypatch.setattr(fcntl, "flock", late)
    outcome = run(plan, target, watcher=Watcher(note=notes.append))
    assert (outcome.cases, outcome.converged, outcome.kept) == (15, 15, 15)
    assert any("has this sweep already" in note for note in notes)
    assert os.listdir(tmp_path) == ["sweep.nc"]


_RUN = """
import sys, time
sys.path[:0] = {paths!r}
import jax
jax.config.update("jax_disable_most_optimizations", True)
import jaxbearing as jb
from roller_cases import dry_roller
from test_sweeps_over import OVER
jb.sweep(dry_roller(), OVER, out={out!r}, chunk=4, progress=lambda cases: time.sleep(0.5))
"""


@pytest.mark.slow
def test_kill_9_at_any_moment(scene, tmp_path):
    """The process is killed while it works, twice; the file is that of a run that was left alone."""
    out = tmp_path / "sweep.nc"
    (tmp_path / "test_sweeps_over.py").write_text(
        "import numpy as np\nOVER = {'operation.radial_load': np.linspace(2e3, 40e3, 24)}\n", encoding="utf-8"
    )
    folder, over = chunk_folder(out), {"operation.radial_load": np.linspace(2e3, 40e3, 24)}
    program = _RUN.format(paths=[str(tmp_path), *sys.path], out=str(out))
    for wanted in (1, 3):
        process = subprocess.Popen([sys.executable, "-c", program], stderr=subprocess.PIPE)
        end = time.monotonic() + 120
        while len(list(folder.glob("chunk-*.npz"))) < wanted:
            assert process.poll() is None, process.stderr and process.stderr.read().decode()
            assert time.monotonic() < end
            time.sleep(0.02)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        assert not out.exists()
    left = len(list(folder.glob("chunk-*.npz")))
    assert 3 <= left < 6
    again, _, computed = finished(plan_of(scene, over), out)
    assert computed == 24 - 4 * left
    assert_same_data(again, jb.sweep(scene, over, chunk=4))


def test_zarr(scene, whole, tmp_path):
    pytest.importorskip("zarr")
    found = jb.sweep(scene, OVER, out=tmp_path / "sweep.zarr", chunk=4).load()
    assert_same_data(found, whole)
    assert found.attrs == whole.attrs


@pytest.mark.parametrize(
    ("path", "values", "error", "words"),
    [
        ("geometry.n_rollers", [10, 12], ValueError, "geometry.n_rollers: found a field that shapes the equations"),
        ("cage.guidance", [1.0], (ValueError, AttributeError), "cage"),
        ("operation.radial_lod", [1.0], AttributeError, "radial_lod"),
        ("operation.radial_load", [-1.0, 5.0], ValueError, "radial_load must be > 0"),
        ("materials.rings", [1.0], ValueError, "materials.rings: found a field that shapes"),
    ],
)
def test_what_cannot_be_swept(scene, path, values, error, words, tmp_path):
    with pytest.raises(error, match=words):
        jb.sweep(scene, {path: values}, out=tmp_path / "no.nc")
    assert os.listdir(tmp_path) == []


def test_damage_is_seen_by_the_checksum_of_what_is_read(scene, tmp_path):
    target = tmp_path / "sweep.nc"
    plan = plan_of(scene)
    stopped_after(plan, target, 1)
    found = read_chunk(chunk_folder(target), 0, plan.key, ["ring_radial"])
    assert found["ring_radial"].shape == (4,)
    with pytest.raises(OSError, match="another sweep"):
        read_chunk(chunk_folder(target), 0, "0" * 32)


def test_samples_have_the_dimension_case(scene):
    load, clearance = OVER
    cases = latin_hypercube({load: (1e3, 4e4, "log"), clearance: (3e-5, 3.001e-5)}, 6, seed=1)
    found = jb.sweep(scene, cases, chunk=4)
    assert found["ring_radial"].dims == ("case",)
    assert found["operation_radial_load"].values.tobytes() == cases.values[0].tobytes()
    order = np.argsort(found["operation_radial_load"].values)
    assert np.all(np.diff(found["ring_radial"].values[order]) > 0)


def test_the_page_of_the_docs_runs(capsys, monkeypatch):
    """With made up results."""
    monkeypatch.setattr("jaxbearing.sweeps.plan.LaneProgram", MadeUpProgram)
    page = (Path(__file__).parents[2] / "docs" / "sweeps.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", page, flags=re.DOTALL)
    exec(compile(block, "sweeps.md", "exec"), {})
    assert capsys.readouterr().out.startswith("[")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "path", "values", "variable", "result"),
    [
        ("deep_groove_6205", "operation.radial_load", [1e3, 3e3], "ring_radial", lambda s: s.ring.radial),
        ("angular_contact_218", "geometry.conformity_inner", [0.515, 0.53], "ring_axial", lambda s: s.ring.axial),
        ("tapered_example", "operation.radial_load", [2e3, 4e3], "load_outer", lambda s: s.elements.load_outer),
        ("satellite_contact_1", "operation.entrainment_speed", [0.1, 0.2], "profile_film", lambda s: s.profile.film),
        ("two_disk_etm", "geometry.reduced_radius_rolling", [5e-3, 1e-2], "film", lambda s: s.film),
    ],
)
def test_every_kind_of_scene(name, path, values, variable, result, tmp_path):
    scene = jb.load_scene(name, {"contact.accuracy": "1e-2"} if name.startswith("satellite") else {})
    found = jb.sweep(scene, {path: values}, chunk=2, out=tmp_path / "sweep.nc").load()
    assert found["failure"].values.tolist() == ["", ""]
    for lane, value in enumerate(values):
        one = np.asarray(result(jb.solve(scene.replace({path: value}))))
        np.testing.assert_allclose(found[variable].values[lane], one, rtol=1e-8, atol=1e-9 * np.max(np.abs(one)))
    for key, quantity in found.variables.items():
        assert quantity.attrs["units"], key


@pytest.mark.slow
def test_no_equilibrium_is_said_of_its_case_only(tmp_path):
    found = jb.sweep(jb.load_scene("tapered_example"), {"operation.axial_load": [10.0, 8e3]}, chunk=2)
    assert found["status"].values.tolist() == [3, 0]
    assert "no_equilibrium" in str(found["failure"].values[0])
    assert np.isnan(found["ring_axial"].values).tolist() == [True, False]


def test_the_place_of_the_first_element_can_be_swept(scene, tmp_path):
    """Azimuths differ from case to case then; loads that a given displacement needs are shown."""
    held = {"operation.radial_load": None, "operation.displacement.radial": 30e-6}
    scene = scene.replace({"geometry.first_element_angle": 0.0, **held})
    found = jb.sweep(scene, {"geometry.first_element_angle": [0.0, 0.1]})
    np.testing.assert_allclose(found["azimuth"].values[:, 0], [0.0, 0.1])
    store = tmp_path / "s.nc"
    found.to_netcdf(store, engine="h5netcdf")
    console = Console(file=io.StringIO(), width=120, record=True)
    print_sweep(store, "s", 0, 1.0, console)
    assert "force, radial_load" in console.export_text()
