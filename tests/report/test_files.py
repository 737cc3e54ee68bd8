"""Files that appear whole or not at all, whatever ends the process that writes them."""

import os
import signal
import subprocess
import sys

import pytest

from jaxbearing.report import files
from jaxbearing.report.files import atomic_file

_WRITER = f"""
import runpy, signal, sys
# tests started in the background of a shell may ignore Ctrl-C, and so would what they start
signal.signal(signal.SIGINT, signal.default_int_handler)
atomic_file = runpy.run_path({files.__file__!r})["atomic_file"]
with atomic_file(sys.argv[1]) as temporary:
    temporary.write_text("half", encoding="utf-8")
    signal.raise_signal(getattr(signal, sys.argv[2]))
"""


@pytest.mark.parametrize("name", ["page.html", "漢" * 80 + ".html"], ids=["short", "long"])
@pytest.mark.parametrize("signal_name", ["SIGKILL", "SIGTERM", "SIGINT"])
def test_a_process_that_ends_in_the_middle(signal_name, name, tmp_path):
    target = tmp_path / name
    for before in (None, "what was there"):
        if before is not None:
            target.write_text(before, encoding="utf-8")
        process = subprocess.run(
            [sys.executable, "-c", _WRITER, str(target), signal_name], capture_output=True, text=True, check=False
        )
        assert process.returncode == -getattr(signal, signal_name)
        if before is None:
            assert not target.exists()
        else:
            assert target.read_text(encoding="utf-8") == before
    left = [path.name for path in tmp_path.iterdir() if path != target]
    # Ctrl-C is an exception, which cleans up; a kill is not
    assert len(left) == (0 if signal_name == "SIGINT" else 2)
    with atomic_file(target) as temporary:
        temporary.write_text("whole", encoding="utf-8")
    assert target.read_text(encoding="utf-8") == "whole"


def test_what_a_killed_run_left_is_not_in_the_way(tmp_path, monkeypatch):
    """In a container each run may have the same number."""
    monkeypatch.setattr(os, "getpid", lambda: 7)
    for i in range(3):
        context = atomic_file(tmp_path / "page.html")
        context.__enter__().write_text(f"half {i}", encoding="utf-8")
    with atomic_file(tmp_path / "page.html") as temporary:
        temporary.write_text("whole", encoding="utf-8")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == "whole"


def test_two_at_once(tmp_path):
    """Who ends last is read; no mixture."""
    target = tmp_path / "page.html"
    with atomic_file(target) as one:
        one.write_text("one", encoding="utf-8")
        with atomic_file(target) as other:
            other.write_text("the other", encoding="utf-8")
        assert target.read_text(encoding="utf-8") == "the other"
    assert target.read_text(encoding="utf-8") == "one"
    assert os.listdir(tmp_path) == ["page.html"]
