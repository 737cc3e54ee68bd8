"""A command ends at once, but not before what was registered for its end, and not before its threads."""

import os
import sys

import command_process
import pytest

AT_THE_END = """
import atexit, threading, time
def late():
    while threading.main_thread().is_alive():
        time.sleep(0.01)
    print("a thread has ended")
"""
REGISTERED = "atexit.register(lambda: print('registered for the end'))"
THREAD = "threading.Timer(0.0, late).start()"


@pytest.mark.parametrize(
    ("code", "last"),
    [
        pytest.param(REGISTERED, "registered for the end", id="at exit"),
        pytest.param(THREAD, "a thread has ended", id="thread"),
    ],
)
def test_what_is_to_be_done_at_the_end_is_done(tmp_path, code, last):
    (tmp_path / "sitecustomize.py").write_text(AT_THE_END + code)
    path = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    code, out, _ = command_process.run(tmp_path, "--help", PYTHONPATH=path)
    assert code == 0
    assert "Usage" in out
    assert out.rstrip().endswith(last)


def test_exit_codes(tmp_path):
    code, out, err = command_process.run(tmp_path, "solve", "no_such_scene")
    assert (code, out) == (2, "")
    assert "no_such_scene" in err
