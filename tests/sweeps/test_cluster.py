"""Workers of a Dask cluster: the same data, also where one of them is killed in the middle."""

import os
import signal
import threading

import numpy as np
import pytest
import xarray as xr
from roller_cases import dry_roller

import jaxbearing as jb
from jaxbearing.sweeps.chunks import chunk_path
from jaxbearing.sweeps.cluster import on_workers
from jaxbearing.sweeps.engine import SweepError, Watcher, chunk_folder, run
from jaxbearing.sweeps.verb import plan_in_scene

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("default")]
pytest.importorskip("distributed")
OVER = {"operation.radial_load": np.linspace(2e3, 40e3, 60), "operation.inner_speed": np.linspace(100.0, 900.0, 40)}


def _kill_one(folder, stop):
    """Kills the first worker that is there once three chunks are."""
    import psutil

    while not stop.wait(0.02):
        workers = [one for one in psutil.Process().children(recursive=True) if "spawn_main" in " ".join(one.cmdline())]
        if workers and chunk_path(folder, 2).exists():
            os.kill(workers[0].pid, signal.SIGKILL)
            return


def test_a_worker_is_killed(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, [os.getcwd(), os.environ.get("PYTHONPATH")])))
    scene, target = dry_roller(), tmp_path / "sweep.nc"
    plan = plan_in_scene(scene, OVER, chunk=50)
    stop, notes = threading.Event(), []
    killer = threading.Thread(target=_kill_one, args=(chunk_folder(target), stop))
    killer.start()
    outcome = run(plan, target, runner=on_workers(2), watcher=Watcher(note=notes.append))
    stop.set()
    killer.join()
    assert (outcome.cases, outcome.converged) == (2400, 2400)
    found, whole = xr.load_dataset(target), jb.sweep(scene, OVER, chunk=50)
    for name, variable in whole.variables.items():
        if variable.dtype.kind == "f":
            # the programs of the tests are compiled in another way than those of the workers
            np.testing.assert_allclose(found[name], variable, rtol=1e-9, atol=1e-6)


def test_no_scheduler_answers(tmp_path, monkeypatch):
    monkeypatch.setattr("jaxbearing.sweeps.cluster.CONNECT", 1)
    plan = plan_in_scene(dry_roller(), {"operation.radial_load": [1e3]})
    with pytest.raises(SweepError, match="does not answer"):
        run(plan, tmp_path / "a.nc", runner=on_workers(scheduler="tcp://127.0.0.1:9"))
