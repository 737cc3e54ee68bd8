"""Ctrl-C, to any verb at any moment: exit code 130 at once, one line, no crash of the ending process; what was computed
is kept."""

import contextlib
import os
import pty
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr
from command_process import environment
from fit_results import MEDIAN

import jaxbearing as jb
from fitting.posterior import available

DRY = ("reference_roller", "--set", "contact=none")
BALL = ("deep_groove_6205", "--set", "contact=none")
LINE = ("satellite_contact_1", "--set", "contact.nodes=51")
SWEEP = ("sweep", *DRY, "--over", "operation.radial_load=5 kN:9 kN:4", "--chunk", "2", "--out", "a.nc")
SWINGING = ("--set", "simulation.speed_ramp=none", "--set", "simulation.speed_perturbation.frequency=1 kHz")
SWINGING = (*SWINGING, "--set", "simulation.speed_perturbation.amplitude=0.5")
BEARING = ("turbine_roller_dynamic", "--set", "contact.thermal=none")
_HOOK = """
import atexit, os, signal, sys, threading, time
# tests started in the background of a shell may ignore Ctrl-C, and so would what they start
signal.signal(signal.SIGINT, signal.default_int_handler)
reached = []
def press():
    with open("pressed", "w") as file:
        file.write(repr(time.time()))
    os.kill(os.getpid(), signal.SIGINT)
def reach():
    if not reached:
        reached.append(True)
        threading.Timer({delay}, press).start() if {delay} else press()
listening = []
def lowered(event, seconds, **more):
    if event.endswith("jaxpr_to_mlir_module_duration") and seconds > 0.1:
        reach()
def hook(event, arguments):
    if event == "os.rename" and os.path.basename(arguments[1]) == {at!r}:
        reach()
        time.sleep(60)
    if event != "import":
        return
    if arguments[0] == {at!r}:
        reach()
    monitoring = sys.modules.get("jax._src.monitoring")
    if {at!r} == COMPILER and not listening and hasattr(monitoring, "register_event_duration_secs_listener"):
        listening.append(True)
        monitoring.register_event_duration_secs_listener(lowered)
if {at!r} == END:
    atexit.register(reach)
sys.addaudithook(hook)
"""
"""Python runs it before anything else: Ctrl-C comes when a module is imported, when a file is about to take its place,
when a large program goes to the compiler, at the end of the process, or so many seconds later."""
COMPILER, END = "a large program for the compiler", "the end of the process"
MOMENTS = {
    "the first import": (("scenes",), "jax", 0),
    "an extension that is being loaded": (("solve", *DRY), "jaxlib._jax", 0),
    "the scene that is being read": (("solve", *DRY), "jaxbearing.scenes.drafts", 0),
    "the program that is being traced": (("solve", *BALL), "jaxbearing.solve", 0.2),
    "the end of the process": (("solve", *DRY), END, 0),
    "a run that begins": (
        ("simulate", *LINE, "--duration", "2 ms", "--json", "--out", "a.nc"),
        COMPILER,
        0,
    ),
    "a sweep without a case": (SWEEP, "plan.data", 0),
    "a sweep with cases": (SWEEP, "chunk-000001.npz", 0),
    "a picture that is being drawn": (("solve", *DRY, "--out", "a.nc", "--plot", "a.png"), "matplotlib.figure", 0),
}
DEAR = {
    "a fit": (("fit", str(MEDIAN), "--scene", "two_disk_etm", "--out", "a.toml"), COMPILER, 0.3),
    "a study": (("study", "reference_roller", "--out", "a.nc"), COMPILER, 0.3),
    "stiffness": (("stiffness", *BALL, "--speeds", "1 rpm:9 rpm:20", "--ross", "a.toml"), COMPILER, 0.3),
    "a report": (("report", "turbine_ball", "--out", "a.html"), COMPILER, 0.3),
    "sensitivities": (("solve", "turbine_roller", "--sensitivities"), COMPILER, 0.3),
    "compilation of a run": (("simulate", *BEARING, "--duration", "5 ms", "--out", "a.nc"), COMPILER, 0.3),
}
PROMPT = 20.0
"""Longest time from Ctrl-C to the end, s: on a machine that is busy with other tests. Alone it takes 0.1 s."""


@pytest.fixture(scope="module")
def programs(tmp_path_factory):
    """Folder of the programs that these commands share."""
    return tmp_path_factory.mktemp("programs")


def pressed(folder, arguments, at, delay, programs="off"):
    """Exit code, stdout, stderr and seconds after Ctrl-C of a command."""
    (folder / "hook").mkdir()
    (folder / "hook" / "sitecustomize.py").write_text(_program(at, delay), encoding="utf-8")
    place = folder / "work"
    place.mkdir()
    kept = {"JAX_COMPILATION_CACHE_DIR": None} if at == COMPILER else {"JAXBEARING_CACHE": str(programs)}
    variables = environment(**kept)
    variables["PYTHONPATH"] = f"{folder / 'hook'}{os.pathsep}{variables['PYTHONPATH']}"
    command = [sys.executable, "-m", "jaxbearing", *arguments]
    done = subprocess.run(command, cwd=place, env=variables, capture_output=True, text=True, timeout=300, check=False)
    end = time.time()
    mark = place / "pressed"
    assert mark.exists(), f"Ctrl-C never came: {done.stderr}"
    seconds = end - float(mark.read_text(encoding="utf-8"))
    mark.unlink()
    return done, seconds, place


def _program(at, delay):
    return f"COMPILER, END = {COMPILER!r}, {END!r}\n" + _HOOK.format(at=at, delay=delay)


def check(done, seconds):
    assert done.returncode == 130, done.stderr
    assert seconds < PROMPT
    assert re.fullmatch(r"interrupted(: .*)?\n", done.stderr)


@pytest.mark.parametrize("moment", MOMENTS)
def test_any_moment(moment, tmp_path, programs):
    done, seconds, place = pressed(tmp_path, *MOMENTS[moment], programs)
    check(done, seconds)
    if moment == "a picture that is being drawn":
        assert "CONVERGED" in done.stdout
        assert done.stderr == "interrupted: not written: a.png\n"
        assert os.listdir(place) == ["a.nc"]
    elif moment == "a sweep without a case":
        assert done.stderr == "interrupted: no case is kept\n"
    elif moment == "a sweep with cases":
        kept = "2 of 4 cases are kept in 'a.nc.chunks': the same command goes on there"
        assert done.stderr == f"interrupted: {kept}\n"
        assert sorted(os.listdir(place / "a.nc.chunks"))[0] == "chunk-000000.npz"
    elif moment == "the end of the process":
        assert "CONVERGED" in done.stdout
        assert done.stderr == "interrupted: all results are there\n"
    else:
        assert (done.stdout, os.listdir(place)) == ("", [])


@pytest.mark.slow
@pytest.mark.parametrize("moment", DEAR)
def test_any_moment_of_long_work(moment, tmp_path):
    done, seconds, place = pressed(tmp_path, *DEAR[moment])
    check(done, seconds)
    assert done.stderr == "interrupted: nothing was computed\n"
    assert (done.stdout, os.listdir(place)) == ("", [])


@pytest.mark.slow
@pytest.mark.skipif(not available(), reason="NumPyro, an extra of the package, is not installed")
def test_a_posterior_that_is_interrupted_leaves_the_fit(tmp_path):
    fit = ("fit", str(MEDIAN), "--scene", "two_disk_etm", "--starts", "1", "--posterior", "--out", "a.toml")
    done, seconds, place = pressed(tmp_path, (*fit, "--plot-posterior", "a.png"), "numpyro.infer", 0.5)
    check(done, seconds)
    assert done.stderr == "interrupted: without the posterior; not written: a.png\n"
    assert "CONVERGED" in done.stdout
    assert os.listdir(place) == ["a.toml"]
    assert jb.load_scene("turbine_roller", {"oil.file": str(place / "a.toml")}).oil.rheology is not None


def test_data_that_are_being_written_are_written(tmp_path, programs):
    """Ctrl-C during a short file lets it be finished and leaves out the next."""
    arguments = ("solve", *DRY, "--out", "a.nc", "--plot", "a.png")
    done, _, place = pressed(tmp_path, arguments, "h5netcdf", 0, programs)
    assert done.returncode == 130
    assert "CONVERGED" in done.stdout
    assert done.stderr == "interrupted: not written: a.png\n"
    assert os.listdir(place) == ["a.nc"]
    with xr.open_dataset(place / "a.nc", engine="h5netcdf") as found:
        assert "ring_radial" in found


def on_a_terminal(command, out):
    """Code, and what was shown, of a run of 10 s with Ctrl-C when its bar shows that it moves."""
    reader, terminal = pty.openpty()
    listening = "import runpy, signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    listening += "runpy.run_module('jaxbearing', run_name='__main__')"
    program = [sys.executable, "-c", listening, *command, "--duration", "10 s", "--out", str(out)]
    with subprocess.Popen(program, stdout=terminal, stderr=subprocess.PIPE, env=environment(TERM="xterm")) as run:
        os.close(terminal)
        shown = b""
        while b"of 1e+04 ms" not in shown:
            shown += os.read(reader, 4096)
        run.send_signal(signal.SIGINT)
        with contextlib.suppress(OSError):  # the end of a terminal
            while part := os.read(reader, 4096):
                shown += part
        assert run.stderr is not None
        assert b"Traceback" not in run.stderr.read()
        code = run.wait()
    os.close(reader)
    return code, shown


@pytest.mark.parametrize(
    "scene", [pytest.param(BEARING, marks=pytest.mark.slow, id="bearing"), pytest.param(LINE, id="line contact")]
)
def test_interrupted_run_keeps_what_it_has(scene, tmp_path):
    """A process on a terminal, and Ctrl-C when its bar shows that it moves."""
    out = tmp_path / "run.nc"
    code, shown = on_a_terminal(("simulate", *scene, *(SWINGING if scene == LINE else ())), out)
    assert code == 130, shown
    assert b"interrupted" in shown
    with xr.open_dataset(out, engine="h5netcdf") as dataset:
        assert dataset.attrs["completed"] == 0
        reached = float(dataset["time"][-1])
        assert 0.0 < reached < 10.0
    last = jb.read_last_state(out)
    assert last.time == reached
    model = jb.load_scene(scene[0], {"contact.thermal": "none"} if scene == BEARING else {"contact.nodes": "51"})
    if scene == BEARING:
        again = jb.simulate(model, 0.5e-3, restart=last)
        np.testing.assert_allclose(float(again.stop), reached + 0.5e-3)
