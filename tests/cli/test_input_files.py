"""Every file that a verb reads is a regular one of sane size, or refused at once, by name: devices without end, pipes
that nobody writes to, folders, files of gigabytes. A pipe that the shell opened for the command is read."""

import os
import socket
import subprocess
import sys

import pytest
from command_process import environment
from fit_results import MEDIAN

import jaxbearing as jb
from jaxbearing.scenes import input_files
from jaxbearing.scenes.data_files import builtin_text

SCENE = ("solve", "{}")
READERS = {
    "scene": SCENE,
    "oil": ("solve", "reference_roller", "--set", "oil.name=none", "--set", "oil.file={}"),
    "speed table": ("simulate", "turbine_roller_dynamic", "--set", "simulation.speed_table.file={}"),
    "load table": ("simulate", "turbine_roller_dynamic", "--set", "simulation.load_table.file={}"),
    "list of cases": ("sweep", "reference_roller", "--list", "{}"),
    "curves": ("fit", "{}", "--scene", "two_disk_etm"),
    "scene of a fit": ("fit", str(MEDIAN), "--scene", "{}"),
    "restart": ("simulate", "turbine_roller_dynamic", "--duration", "1 ms", "--restart", "{}"),
    "report": ("report", "{}"),
    "stiffness": ("stiffness", "{}", "--speeds", "1 rpm:2 rpm:2"),
    "study": ("study", "{}"),
}


def a_socket(path):
    place = socket.socket(socket.AF_UNIX)
    place.bind(str(path))
    place.close()


def a_large_file(path):
    with path.open("wb") as file:
        # takes no room on the disk
        file.truncate(40 * 2**30)


KINDS = {
    "a pipe": os.mkfifo,
    "a folder": os.mkdir,
    "a socket": a_socket,
    "a file of": a_large_file,
    "a device": lambda path: path.symlink_to("/dev/zero"),
}


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_file_to_read_is_refused(kind, reader, jaxbearing_command, folder):
    if reader == "restart" and kind == "a file of":
        pytest.skip("what is read of it has the size of one instant")
    KINDS[kind](folder / "given")
    before = os.listdir(folder)
    result = jaxbearing_command(*(word.format("given") for word in READERS[reader]))
    assert (result.code, result.out, result.err.count("\n")) == (2, "", 1)
    assert "given" in result.err
    assert f" {kind}" in result.err
    assert os.listdir(folder) == before


def test_units_beside_curves(jaxbearing_command, folder):
    (folder / "curves.csv").write_text("slide_to_roll,traction_coefficient\n0.1,0.05\n", encoding="utf-8")
    os.mkfifo(folder / "curves.units.toml")
    result = jaxbearing_command("fit", "curves.csv", "--scene", "two_disk_etm")
    assert result.code == 2
    assert "curves.units.toml: found a pipe" in result.err


@pytest.mark.parametrize("option", ["--out", "--plot"])
def test_outputs_that_are_no_ordinary_file_are_refused_before_the_work(option, jaxbearing_command, folder, monkeypatch):
    monkeypatch.setattr("jaxbearing.solve.solve_once", None, raising=False)
    name = {"--out": "a.nc", "--plot": "a.png"}[option]
    os.mkfifo(folder / name)
    result = jaxbearing_command("solve", "reference_roller", option, name)
    assert (result.code, result.out) == (1, "")
    assert result.err == f"error: the output cannot be written: {name}: Not an ordinary file\n"


def test_a_sweep_does_not_wait_for_a_pipe(jaxbearing_command, folder):
    os.mkfifo(folder / "a.nc")
    over = ("--over", "operation.radial_load=5 kN:9 kN:2", "--out", "a.nc")
    result = jaxbearing_command("sweep", "reference_roller", "--set", "contact=none", *over)
    assert result.code == 2
    assert "no ordinary file" in result.err


@pytest.mark.skipif(not os.path.exists("/dev/fd"), reason="the shell's pipes have no names")
@pytest.mark.parametrize("words", ["report <(cat a.toml)", pytest.param("report /dev/stdin", marks=pytest.mark.slow)])
def test_pipes_of_the_shell_are_read(words, tmp_path):
    """Also by a verb that looks at the scene twice."""
    (tmp_path / "a.toml").write_text(builtin_text("reference_roller"), encoding="utf-8")
    line = f"cat a.toml | '{sys.executable}' -m jaxbearing {words} --set contact=none --out a.html"
    done = subprocess.run(["bash", "-c", line], cwd=tmp_path, env=environment(), capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "a.html").stat().st_size > 10_000


def test_pipes_without_end_are_not(tmp_path):
    line = f"yes | '{sys.executable}' -m jaxbearing solve /dev/stdin"
    done = subprocess.run(["bash", "-c", line], cwd=tmp_path, env=environment(), capture_output=True, check=False)
    assert (done.returncode, done.stdout) == (2, b"")
    assert done.stderr.startswith(b"error: /dev/stdin: found more than 4 MiB;")


def test_a_file_that_does_not_tell_its_size(tmp_path):
    """As those of /proc: it is no longer read than allowed."""
    (tmp_path / "a").write_bytes(bytes(11))
    assert len(input_files.read_bytes(tmp_path / "a", 11)) == 11
    with pytest.raises(input_files.UnfitFileError, match="more than"):
        input_files.read_bytes(tmp_path / "a", 10)
    if os.path.exists("/proc/self/status"):
        assert os.stat("/proc/self/status").st_size == 0
        assert b"Name" in input_files.read_bytes("/proc/self/status")


@pytest.mark.parametrize("path", ["geometry.n_rollers", "rating.n_laminae"])
def test_counts_that_would_fill_the_memory_are_refused(path):
    with pytest.raises(jb.SceneError, match="<= 1000000"):
        jb.load_scene("turbine_roller", {path: "1000000001"})
