"""Where the command runs: other locales, names and folders, a damaged cache, several runs at once."""

import itertools
import json
import os
import re
import warnings

import numpy as np
import pytest
import xarray as xr
from command_process import DRY, run, start
from fit_results import MEDIAN
from full_places import small_folder

from jaxbearing.cli.cache import _in_words
from jaxbearing.cli.options import labelled


def test_a_name_that_the_locale_cannot_read_can_be_printed():
    typed = "Wälzlager.toml".encode().decode("ascii", "surrogateescape")
    assert labelled(typed, ["oil.name=ü"]) == "Wälzlager.toml --set oil.name=ü"
    assert labelled(b"\xff.toml".decode("ascii", "surrogateescape"), None) == "\N{REPLACEMENT CHARACTER}.toml"


def test_damaged_entries_of_the_cache_go(tmp_path):
    for name in ("jit_solve-a1-cache", "jit_solve-b2-cache", "jit_solve_any-c3-cache"):
        (tmp_path / name).write_bytes(b"cut")
    shown = []
    show = _in_words(tmp_path, lambda message, *where: shown.append(str(message)))
    error = "Error reading persistent compilation cache entry for 'jit_solve': error: Error -5"
    show(UserWarning(error), UserWarning, "compiler.py", 1)
    show(UserWarning("something else"), UserWarning, "compiler.py", 2)
    assert shown == ["something else"]
    assert os.listdir(tmp_path) == ["jit_solve_any-c3-cache"]


@pytest.mark.slow
def test_names_of_files(tmp_path):
    """Also where the locale is ASCII."""
    name = "Wälzlager 漢字 zwei.toml"
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
def test_a_file_where_the_cache_should_be(tmp_path):
    """As where nothing can be written at home; tests may be run by who may write everywhere."""
    blocked = tmp_path / "blocked"
    blocked.write_text("", encoding="utf-8")
    places = {"HOME": str(blocked), "XDG_CACHE_HOME": str(blocked), "XDG_CONFIG_HOME": str(blocked / "no")}
    places |= {"JAXBEARING_CACHE": None, "MPLCONFIGDIR": None}
    folder = tmp_path / "work"
    folder.mkdir()
    code, out, err = run(folder, "solve", "reference_roller", *DRY, "--json", "--plot", "a.png", **places)
    assert (code, err) == (0, "")
    assert json.loads(out)["converged"]
    assert os.listdir(folder) == ["a.png"]
    assert blocked.read_text(encoding="utf-8") == ""


# verb: (its arguments, option of the file, name)
WRITING = {
    "scenes": (("scenes", "--copy", "reference_roller"), "--to", "é.toml"),
    "sweep": (("sweep", "reference_roller", *DRY, "--over", "operation.radial_load=5 kN:9 kN:3"), "--out", "ä.nc"),
    "simulate": (
        ("simulate", "turbine_roller_dynamic", "--set", "contact.thermal=none", "--duration", "0.1 ms"),
        "--out",
        "漢字.nc",
    ),
    "stiffness": (("stiffness", "deep_groove_6205", "--speeds", "2000 rpm:3000 rpm:2"), "--ross", "ß.toml"),
    "fit": (("fit", str(MEDIAN), "--scene", "two_disk_etm", "--starts", "1"), "--out", "öl.toml"),
}


@pytest.mark.slow
@pytest.mark.parametrize("verb", WRITING)
def test_names_of_what_verbs_write(verb, tmp_path):
    """Where the locale is ASCII."""
    variables = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    arguments, option, name = WRITING[verb]
    folder = tmp_path / "Prüfstand 7"
    folder.mkdir()
    code, _, err = run(folder, *arguments, option, name, **variables)
    assert (code, "Traceback" in err) == (0, False), err
    assert os.listdir(folder) == [name]


@pytest.mark.slow
def test_one_core(tmp_path):
    """The same results as on all of them."""
    one = "import os; os.sched_setaffinity(0, [min(os.sched_getaffinity(0))])"
    found = [run(tmp_path, "solve", "turbine_roller", "--json", before=before) for before in (None, one)]
    assert [code for code, *_ in found] == [0, 0]
    all_of_them, alone = (json.loads(out) for _, out, _ in found)
    assert alone["iterations"] == all_of_them["iterations"]
    for name, value in all_of_them["power_loss"].items():
        np.testing.assert_allclose(alone["power_loss"][name], value, rtol=1e-12)
    for name, values in all_of_them["elements"].items():
        np.testing.assert_allclose(alone["elements"][name], values, rtol=1e-12, atol=1e-12 * np.max(np.abs(values)))


@pytest.mark.slow
def test_two_runs_write_in_one_folder(tmp_path):
    """The same file: one of the two, whole. The same sweep: one computes it, the other says so or finds it."""
    commands = [("report", "reference_roller", *DRY, "--out", "page.html")] * 2
    commands += [("solve", "reference_roller", *DRY, "--out", "state.nc", "--plot", "state.svg")] * 2
    commands += [("sweep", "reference_roller", *DRY, "--over", "operation.radial_load=5 kN:9 kN:5", "--json")] * 2
    runs = [start(tmp_path, *command) for command in commands]
    said = [process.communicate(timeout=300) for process in runs]
    codes = [process.returncode for process in runs]
    assert codes[:4] == [0] * 4, said
    assert sorted(codes[4:]) in ([0, 0], [0, 2]), said
    for code, (_, err) in zip(codes[4:], said[4:], strict=True):
        assert (code == 2) == ("another process is computing this sweep" in err)
    assert sorted(os.listdir(tmp_path)) == ["page.html", "reference_roller_sweep.nc", "state.nc", "state.svg"]
    assert (tmp_path / "page.html").read_text(encoding="utf-8").rstrip().endswith("</html>")
    assert (tmp_path / "state.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>")
    with (
        xr.open_dataset(tmp_path / "state.nc") as state,
        xr.open_dataset(tmp_path / "reference_roller_sweep.nc") as cases,
    ):
        assert float(state["ring_radial"]) > 0.0
        assert cases["ring_radial"].shape == (5,)


@pytest.mark.slow
def test_runs_at_once_and_a_cache_that_a_kill_damaged(tmp_path):
    cache = tmp_path / "cache"
    command = ("solve", "reference_roller", "--set", "contact.traction=none", "--set", "cage=none", "--json")
    runs = [start(tmp_path, *command, JAXBEARING_CACHE=str(cache)) for _ in range(3)]
    said = [process.communicate(timeout=300) for process in runs]
    assert [process.returncode for process in runs] == [0, 0, 0]
    assert len({out for out, _ in said}) == 1
    # of JAX's own cache, and of the programs that are kept
    entries = {kind: list(cache.rglob(kind)) for kind in ("*-cache", "*.program")}
    assert all(entries.values())
    for path in itertools.chain(*entries.values()):
        path.write_bytes(path.read_bytes()[:100])
    assert run(tmp_path, *command, JAXBEARING_CACHE=str(cache)) == (0, *said[0])
    # written anew
    for kind, paths in entries.items():
        assert set(cache.rglob(kind)) >= set(paths)
        assert all(path.stat().st_size > 100 for path in cache.rglob(kind))


def test_warnings_are_python_s_own_again():
    """The command changes how warnings are shown in its own process only: tests run in one."""
    assert warnings.showwarning.__module__ in ("warnings", "_pytest.recwarn", "_pytest.warnings")


def test_a_full_cache_is_said_in_one_line(tmp_path):
    """The cache is a convenience: the results are the same."""
    with small_folder(tmp_path / "cache") as place:
        (place / "filler").write_bytes(bytes(12_288))
        code, out, err = run(tmp_path, "solve", "reference_roller", *DRY, JAXBEARING_CACHE=str(place))
    assert code == 0
    assert "CONVERGED" in out
    assert re.fullmatch(r"warning: compiled programs are not kept in .*No space left on device.*\n", err)
