"""`scenes`, `solve`, exit codes, the cache."""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tomllib

import equinox as eqx
import jax
import pytest

import jaxbearing as jb
from jaxbearing.cli.cache import enable_compilation_cache
from jaxbearing.cli.quiet import without_false_alarms
from jaxbearing.programs import cache_folder
from jaxbearing.scenes.data_files import builtin_names, builtin_text

DRY = ("reference_roller", "--set", "contact=none")


def test_help_and_version(jaxbearing_command):
    help_ = jaxbearing_command("--help")
    assert help_.code == 0
    assert all(word in help_.out for word in ("solve", "scenes", "Exit codes", "JAXBEARING_CACHE"))
    assert re.search("--version +Print", help_.out)
    version = jaxbearing_command("--version")
    assert version.code == 0
    assert version.out.startswith("jaxbearing")


def test_scenes_lists_all(jaxbearing_command):
    result = jaxbearing_command("scenes")
    assert result.code == 0
    assert all(name in result.out for name in builtin_names())
    assert "Table 13" in result.out
    assert result.out.startswith("turbine_roller")


def test_copy(jaxbearing_command, folder):
    assert jaxbearing_command("scenes", "--copy", "turbine_roller").code == 0
    file = folder / "turbine_roller.toml"
    assert file.read_text(encoding="utf-8") == builtin_text("turbine_roller")
    file.write_text("mine", encoding="utf-8")
    refused = jaxbearing_command("scenes", "--copy", "turbine_roller")
    assert refused.code == 2
    assert "--force" in refused.err
    assert file.read_text(encoding="utf-8") == "mine"
    assert jaxbearing_command("scenes", "--copy", "turbine_roller", "--force").code == 0
    assert tomllib.loads(file.read_text(encoding="utf-8"))["kind"] == "cylindrical_roller_bearing"


def test_copy_to(jaxbearing_command, folder):
    (folder / "sub").mkdir()
    assert jaxbearing_command("scenes", "--copy", "turbine_roller", "--to", "mine.toml").code == 0
    assert jaxbearing_command("scenes", "--copy", "turbine_roller", "--to", "sub").code == 0
    assert sorted(os.listdir(folder)) == ["mine.toml", "sub"]
    assert os.listdir(folder / "sub") == ["turbine_roller.toml"]
    nowhere = jaxbearing_command("scenes", "--copy", "turbine_roller", "--to", "no/such/folder.toml")
    assert nowhere.code == 2
    assert "No such file or directory" in nowhere.err


def test_copy_unknown(jaxbearing_command, folder):
    result = jaxbearing_command("scenes", "--copy", "turbine_rolle")
    assert result.code == 2
    assert "Did you mean 'turbine_roller'" in result.err
    assert jaxbearing_command("scenes", "--to", "a.toml").code == 2
    assert os.listdir(folder) == []


def test_copy_with_changes(jaxbearing_command, folder):
    """Of a built-in scene, then of the file; what is read is the same scene."""
    first = ("--set", "operation.inner_speed=12000 rpm", "--set", "drag=none")
    assert jaxbearing_command("scenes", "--copy", "turbine_roller", *first, "--to", "a.toml").out == "wrote a.toml\n"
    second = ("--set", "operation.radial_load=31 kN")
    assert jaxbearing_command("scenes", "--copy", "a.toml", *second, "--to", "b.toml").code == 0
    changes = {"operation.inner_speed": "12000 rpm", "drag": "none", "operation.radial_load": "31 kN"}
    expected = jb.load_scene("turbine_roller", changes)
    assert eqx.tree_equal(jb.load_scene("b.toml"), expected)
    assert (folder / "b.toml").read_text(encoding="utf-8").startswith("# a.toml --set operation.radial_load=31 kN.\n")
    assert jaxbearing_command("scenes", "--copy", "a.toml", *second).code == 2
    refused = jaxbearing_command("scenes", "--copy", "a.toml", "--set", "operation.radial_load=31 m", "--to", "c.toml")
    assert (refused.code, refused.err.count("\n")) == (2, 1)
    assert "operation.radial_load" in refused.err
    assert jaxbearing_command("scenes", "--set", "drag=none").code == 2
    assert sorted(os.listdir(folder)) == ["a.toml", "b.toml"]


def test_solve_json(jaxbearing_command, folder):
    result = jaxbearing_command("solve", *DRY, "--json")
    assert result.code == 0
    assert result.err == ""
    assert result.out.count("\n") == 1
    solution = json.loads(result.out)
    assert solution["status"] == "converged"
    assert solution["cage"] is None
    assert os.listdir(folder) == []


def test_solve_summary(jaxbearing_command):
    result = jaxbearing_command("solve", *DRY)
    assert result.code == 0
    assert "CONVERGED" in result.out
    assert "11 of 30 rollers" in result.out
    assert max(len(line) for line in result.out.splitlines()) <= 100
    assert "\x1b" not in result.out


@pytest.mark.usefixtures("failing_solve")
def test_not_converged(jaxbearing_command):
    screen = jaxbearing_command("solve", *DRY)
    assert screen.code == 3
    assert "NOT CONVERGED" in screen.out
    assert "diverged" in screen.out
    assert "worst equation" in screen.out
    as_json = jaxbearing_command("solve", *DRY, "--json")
    assert as_json.code == 3
    solution = json.loads(as_json.out)
    assert (solution["converged"], solution["status"]) == (False, "diverged")
    assert "worst equation" in as_json.err


def test_interrupt(jaxbearing_command, monkeypatch):
    def interrupted(scene):
        raise KeyboardInterrupt

    monkeypatch.setattr(sys.modules["jaxbearing.solve"], "solve_once", interrupted)
    result = jaxbearing_command("solve", *DRY)
    assert result.code == 130
    assert result.err == "interrupted: nothing was computed\n"


def test_interrupt_does_not_wait_for_compiled_code(folder):
    program = (
        "import os, signal, threading, time\n"
        "from jaxbearing.cli.interrupt import prompt_interrupt\n"
        "signal.signal(signal.SIGINT, lambda *_: None)\n"
        "with prompt_interrupt():\n"
        "    os.kill(os.getpid(), signal.SIGINT)\n"
        "    time.sleep(60)\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, timeout=50, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, b"", b"interrupted: nothing was computed\n")


def test_cache_folder(monkeypatch, tmp_path):
    for word in ("off", "OFF", "0"):
        monkeypatch.setenv("JAXBEARING_CACHE", word)
        assert cache_folder() is None
        assert enable_compilation_cache() is None
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path / "mine"))
    assert cache_folder().parent == tmp_path / "mine"
    monkeypatch.delenv("JAXBEARING_CACHE")
    assert "jaxbearing" in cache_folder().parts


@pytest.mark.parametrize("word", ["on", "1", "TRUE", "yes", ""])
def test_cache_switched_on_is_the_default_folder(word, monkeypatch):
    monkeypatch.delenv("JAXBEARING_CACHE", raising=False)
    default = cache_folder()
    monkeypatch.setenv("JAXBEARING_CACHE", word)
    assert cache_folder() == default


def test_cache_without_a_home_folder(monkeypatch, capfd):
    monkeypatch.delenv("JAXBEARING_CACHE", raising=False)
    monkeypatch.setattr("platformdirs.user_cache_dir", lambda *_, **__: "~/.cache/jaxbearing")
    assert enable_compilation_cache() is None
    assert capfd.readouterr().err == ""
    monkeypatch.setenv("JAXBEARING_CACHE", "~nosuchuser/x")
    assert enable_compilation_cache() is None
    assert capfd.readouterr().err.startswith("warning: JAXBEARING_CACHE: found '~nosuchuser/x'")


def test_no_place_to_hold_messages_back(monkeypatch, capfd):
    def refuse():
        raise FileNotFoundError(2, "No usable temporary directory")

    monkeypatch.setattr("tempfile.TemporaryFile", refuse)
    with without_false_alarms():
        os.write(2, b"news\n")
    assert capfd.readouterr().err == "news\n"


def shell(redirection, folder, *arguments, **variables):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), **variables}
    command = ["/bin/sh", "-c", f'"$0" -m jaxbearing "$@" {redirection}', sys.executable, *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


# only Linux has a device that is always full; elsewhere there is no way to make a write fail on purpose
@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device of Linux")
@pytest.mark.parametrize(
    ("redirection", "words"), [(">&-", "standard output is closed"), (">/dev/full", "No space left on device")]
)
def test_output_that_cannot_be_written(redirection, words, folder):
    done = shell(redirection, folder, "scenes")
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == f"error: the output cannot be written: {words}\n"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device of Linux")
@pytest.mark.parametrize("more", [(), ("--json",)], ids=["screen", "json"])
def test_results_that_cannot_be_written(more, jaxbearing_command, monkeypatch):
    with contextlib.suppress(OSError), open("/dev/full", "w") as full:  # nor can it be closed
        monkeypatch.setattr("sys.stdout", full)
        result = jaxbearing_command("solve", *DRY, *more)
    assert (result.code, result.out) == (1, "")
    assert result.err == "error: the output cannot be written: No space left on device\n"


def test_terminal_without_unicode(jaxbearing_command, folder, monkeypatch):
    assert jaxbearing_command("scenes", "--copy", "reference_roller", "--to", "Wälzlager.toml").code == 0
    shown = io.BytesIO()
    monkeypatch.setattr("sys.stdout", io.TextIOWrapper(shown, encoding="ascii"))
    result = jaxbearing_command("solve", "Wälzlager.toml", *DRY[1:])
    assert (result.code, result.err) == (0, "")
    assert b"W?lzlager.toml" in shown.getvalue()
    assert b"CONVERGED" in shown.getvalue()


def test_cache_that_cannot_be_written_is_no_failure(monkeypatch, tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path / "file" / "inside"))
    assert enable_compilation_cache() is None


def test_cache_is_switched_on(monkeypatch, tmp_path):
    settings = {}
    monkeypatch.setattr(jax.config, "update", settings.__setitem__)
    monkeypatch.delenv("JAX_COMPILATION_CACHE_DIR", raising=False)
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path))
    folder = enable_compilation_cache()
    assert settings["jax_compilation_cache_dir"] == str(folder)
    assert folder.is_dir()


def test_false_alarms_are_held_back_and_news_are_not(capfd):
    with without_false_alarms():
        os.write(2, b"E1 cpu_aot_loader.cc:195] Target machine feature +prefer-no-gather\nnews\n")
    assert capfd.readouterr().err == "news\n"


def test_news_come_out_of_a_crash(capfd):
    def crash():
        with without_false_alarms():
            os.write(2, b"news\n")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        crash()
    assert capfd.readouterr().err == "news\n"
