"""Where the command runs: other locales, names and folders, a damaged cache, several runs at once."""

import json
import os
import subprocess
import sys
import warnings

import pytest

from jaxbearing.cli.cache import _drop_damaged
from jaxbearing.cli.options import labelled

DRY = ("--set", "contact=none")


def environment(**more):
    """Of a process of its own; None takes a variable out."""
    variables = os.environ | {"JAX_PLATFORMS": "cpu", "JAXBEARING_CACHE": "off"} | more
    return {name: value for name, value in variables.items() if value is not None}


def start(folder, *arguments, **variables):
    command = [sys.executable, "-m", "jaxbearing", *arguments]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "encoding": "utf-8", "errors": "surrogateescape"}
    return subprocess.Popen(command, cwd=folder, env=environment(**variables), **streams)


def run(folder, *arguments, **variables):
    process = start(folder, *arguments, **variables)
    out, err = process.communicate(timeout=300)
    return process.returncode, out, err


def test_a_name_that_the_locale_cannot_read_can_be_printed():
    typed = "Wälzlager.toml".encode().decode("ascii", "surrogateescape")
    assert labelled(typed, ["oil.name=ü"]) == "Wälzlager.toml --set oil.name=ü"
    assert labelled(b"\xff.toml".decode("ascii", "surrogateescape"), None) == "\N{REPLACEMENT CHARACTER}.toml"


def test_damaged_entries_of_the_cache_go(tmp_path):
    for name in ("jit_solve-a1-cache", "jit_solve-b2-cache", "jit_solve_any-c3-cache"):
        (tmp_path / name).write_bytes(b"cut")
    shown = []
    show = _drop_damaged(tmp_path, lambda message, *where: shown.append(str(message)))
    error = "Error reading persistent compilation cache entry for 'jit_solve': error: Error -5"
    show(UserWarning(error), UserWarning, "compiler.py", 1)
    show(UserWarning("something else"), UserWarning, "compiler.py", 2)
    assert shown == ["something else"]
    assert os.listdir(tmp_path) == ["jit_solve_any-c3-cache"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["Wälzlager 漢字.toml", "two words.toml"])
def test_names_of_files(name, tmp_path):
    """Also where the locale is ASCII."""
    folder = tmp_path / "Prüfstand 7"
    folder.mkdir()
    assert run(folder, "scenes", "--copy", "reference_roller")[0] == 0
    (folder / "reference_roller.toml").rename(folder / name)
    for variables in ({"LC_ALL": "C.UTF-8"}, {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}):
        code, _, err = run(folder, "solve", name, *DRY, "--out", "ä.nc", "--plot", "ö.svg", **variables)
        assert (code, "Traceback" in err) == (0, False)
        code, _, err = run(folder, "report", name, *DRY, "--out", "ü.html", **variables)
        assert (code, "Traceback" in err) == (0, False)
        assert sorted(os.listdir(folder)) == sorted([name, "ä.nc", "ö.svg", "ü.html"])
        assert name in (folder / "ü.html").read_text(encoding="utf-8")
        for file in ("ä.nc", "ö.svg", "ü.html"):
            (folder / file).unlink()


@pytest.mark.slow
def test_no_home_folder(tmp_path):
    code, out, err = run(tmp_path, "solve", "reference_roller", *DRY, "--json", HOME="/nowhere", JAXBEARING_CACHE=None)
    assert (code, err) == (0, "")
    assert json.loads(out)["converged"]


@pytest.mark.slow
def test_runs_at_once_and_a_cache_that_a_kill_damaged(tmp_path):
    cache = tmp_path / "cache"
    runs = [start(tmp_path, "solve", "reference_roller", "--json", JAXBEARING_CACHE=str(cache)) for _ in range(3)]
    said = [process.communicate(timeout=300) for process in runs]
    assert [process.returncode for process in runs] == [0, 0, 0]
    assert len({out for out, _ in said}) == 1
    entries = list(cache.rglob("*-cache"))
    assert entries
    for path in entries:
        path.write_bytes(path.read_bytes()[:100])
    assert run(tmp_path, "solve", "reference_roller", "--json", JAXBEARING_CACHE=str(cache)) == (0, *said[0])
    # written anew
    assert all(path.stat().st_size > 100 for path in cache.rglob("*-cache"))


def test_warnings_are_python_s_own_again():
    """The command changes how warnings are shown in its own process only: tests run in one."""
    assert warnings.showwarning.__module__ in ("warnings", "_pytest.recwarn", "_pytest.warnings")
