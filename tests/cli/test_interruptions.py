"""A command that is killed or interrupted while it writes: at the place asked for is what was there before, or the
whole file."""

import os
import signal

import pytest
from command_process import DRY, run
from fit_results import MEDIAN

MOVING = ("simulate", "turbine_roller_dynamic", "--set", "contact.thermal=none", "--duration", "0.1 ms")
VERBS = {
    "scenes": (("scenes", "--force", "--copy", "turbine_ball", "--to"), "ball.toml"),
    "solve": (("solve", "reference_roller", *DRY, "--out"), "state.nc"),
    "plot": (("solve", "reference_roller", *DRY, "--plot"), "state.png"),
    "report": (("report", "reference_roller", *DRY, "--out"), "page.html"),
    "stiffness": (
        ("stiffness", "deep_groove_6205", "--force", "--speeds", "2000 rpm:3000 rpm:2", "--ross"),
        "bearing.toml",
    ),
    "sweep": (
        ("sweep", "reference_roller", *DRY, "--overwrite", "--over", "operation.radial_load=5 kN:9 kN:5", "--out"),
        "cases.nc",
    ),
    "simulate": ((*MOVING, "--out"), "run.nc"),
    "animation": ((*MOVING, "--animation"), "run.gif"),
    "fit": (("fit", str(MEDIAN), "--scene", "two_disk_etm", "--starts", "1", "--force", "--out"), "oil.toml"),
}
# The signal comes when the file has been written beside its place and is about to take it.
STOP = """
import os, signal, time
signal.signal(signal.SIGINT, signal.default_int_handler)
replace = os.replace
def stop(source, to, **options):
    if os.path.basename(to) == {name!r}:
        with open({mark!r}, "x"):
            os.kill(os.getpid(), {number})
            time.sleep(2)
    replace(source, to, **options)
os.replace = stop
"""


AT_ONCE = ("animation", "sweep")
"""Ctrl-C does not wait for a picture, which can be drawn again, and a sweep goes on where it was."""
SIGNALS = {"kill": signal.SIGKILL, "ctrl-c": signal.SIGINT}
# one function puts most files in their places: both signals where a run is long, one elsewhere
ONE = {"scenes": "kill", "plot": "kill", "stiffness": "kill", "animation": "ctrl-c"}
CASES = [(verb, name) for verb in VERBS for name in SIGNALS if ONE.get(verb, name) == name]


@pytest.mark.slow
@pytest.mark.parametrize(("verb", "number"), [(verb, SIGNALS[name]) for verb, name in CASES], ids=map("-".join, CASES))
def test_stopped_while_it_writes(verb, number, tmp_path):
    arguments, name = VERBS[verb]
    folder = tmp_path / "work"
    folder.mkdir()
    target, mark = folder / name, tmp_path / "reached"
    target.write_text("what was there", encoding="utf-8")
    program = STOP.format(name=name, mark=str(mark), number=int(number))
    code, _, err = run(folder, *arguments, str(target), before=program)
    assert mark.exists(), err
    assert code == (-9 if number == signal.SIGKILL else 130), err
    assert "Traceback" not in err
    assert os.listdir(folder) == [name] or number == signal.SIGKILL or verb == "sweep"
    if number == signal.SIGINT and verb not in AT_ONCE:
        # one file that is all but there is finished
        assert len(target.read_bytes()) > 1000
    else:
        assert target.read_text(encoding="utf-8") == "what was there"
