"""Programs that are kept: the same bits from the next process, whatever happens to the files; none that is stale."""

import functools
import importlib.util
import os
import shutil
import subprocess
import sys

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from command_process import environment

import jaxbearing as jb
from jaxbearing._checks import Information
from jaxbearing.programs import KeptProgram, files, kept
from jaxbearing.programs.describe import NotKept, static_description
from jaxbearing.programs.files import SUFFIX

FACTOR = {"now": 2.0}


def doubled(x, y):
    """The factor stands for code: where a program is loaded, another one changes nothing."""
    return {"sum": FACTOR["now"] * jnp.linalg.solve(x, y), "words": "kept"}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("JAXBEARING_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr("jaxbearing.programs.describe._KNOWN", ("programs", "test_kept", "builtins", "jaxbearing"))
    monkeypatch.setitem(FACTOR, "now", 2.0)
    return lambda: sorted((tmp_path / "cache").rglob(f"*{SUFFIX}"))


def ask(right=(1.0, 2.0), quick=True):
    """The answer of a process that begins, as far as one process can."""
    answer = KeptProgram(doubled, quick)(jnp.eye(2), jnp.asarray(right))
    assert answer["words"] == "kept"
    return list(np.asarray(answer["sum"]))


def test_a_program_is_made_once(folder):
    assert ask() == [2.0, 4.0]
    (file,) = folder()
    assert file.stat().st_mode & 0o777 == 0o600
    FACTOR["now"] = 3.0
    assert ask() == [2.0, 4.0]
    assert ask((5.0, 1.0)) == [10.0, 2.0]
    assert len(folder()) == 1


def test_what_a_program_depends_on(folder, monkeypatch):
    """Shapes, types, options of the compiler, versions, files of the package, variables: each has its own program."""
    ask()
    changes = [
        lambda: KeptProgram(doubled, True)(jnp.eye(3), jnp.ones(3)),
        lambda: KeptProgram(doubled, True)(jnp.eye(2), jnp.ones((2, 1))),
        lambda: ask(quick=False),
        lambda: (monkeypatch.setattr(kept, "_versions", lambda: ["next"]), ask()),
        lambda: (monkeypatch.setattr(kept, "_files", lambda: "changed"), ask()),
        lambda: (monkeypatch.setenv("EQX_ON_ERROR", "off"), ask()),
    ]
    for count, change in enumerate(changes, start=2):
        change()
        assert len(folder()) == count


def test_a_changed_file_of_the_package_is_seen(tmp_path, monkeypatch):
    """By its content: sizes and times may be those of before."""
    code = tmp_path / "jaxbearing" / "laws.py"
    code.parent.mkdir()
    monkeypatch.setattr(kept, "ROOT", tmp_path)
    found = {}
    for words in ("x = 1.0", "x = 2.0", "x = 1.0"):
        code.write_text(words)
        os.utime(code, ns=(10**18, 10**18))
        monkeypatch.setattr(kept, "_TIMES", kept._times())
        found.setdefault(words, set()).add(kept._files.__wrapped__())
    assert len(found["x = 1.0"]) == 1
    assert not found["x = 1.0"] & found["x = 2.0"]
    # an editor's marks of a file that is open are not looked at
    (code.parent / ".#laws.py").symlink_to("someone@somewhere")
    assert {kept._files.__wrapped__()} == found["x = 1.0"]


def test_code_that_was_changed_after_it_was_imported_is_not_kept(folder, tmp_path, monkeypatch):
    """What runs is older than what the files say."""
    monkeypatch.setattr(kept, "_files", kept._files.__wrapped__)
    monkeypatch.setattr(kept, "_TIMES", "of another day")
    assert ask() == [2.0, 4.0]
    # in an archive there are no files
    monkeypatch.setattr(kept, "ROOT", tmp_path)
    monkeypatch.setattr(kept, "_TIMES", kept._times())
    assert ask() == [2.0, 4.0]
    assert folder() == []


def test_names_are_not_taken_on_trust(tmp_path, monkeypatch):
    """A module of the user's own that hides a package of this project, and what bears the name of something else."""
    assert static_description(files.read) == "jaxbearing.programs.files.read"
    assert static_description(Information("a law")) == "jaxbearing._checks.Information:'a law'"
    file = tmp_path / "fitting.py"
    file.write_text("def law(x):\n    return x\n")
    spec = importlib.util.spec_from_file_location("fitting", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setitem(sys.modules, "fitting", module)
    for foreign in (module.law, functools.wraps(files.read)(lambda path: None)):
        with pytest.raises(NotKept):
            static_description(foreign)


def test_settings_for_debugging_are_obeyed_at_once(folder):
    program = KeptProgram(doubled, True)
    program(jnp.eye(2), jnp.ones(2))
    FACTOR["now"] = 3.0
    with jax.disable_jit():
        assert float(program(jnp.eye(2), jnp.ones(2))["sum"][0]) == 3.0
    assert float(program(jnp.eye(2), jnp.ones(2))["sum"][0]) == 2.0


def test_settings_of_jax_are_as_before(folder):
    """Those that change while a program is compiled, also where that fails."""

    def settings():
        return {name: getattr(jax.config, name) for name in dir(jax.config) if name.startswith("jax_")}

    def fails():
        with kept._compiled_for_keeps():
            assert jax.config.jax_traceback_in_locations_limit == 0
            assert not jax.config.jax_enable_compilation_cache
            raise ZeroDivisionError

    limit = "jax_traceback_in_locations_limit"
    before = settings()
    jax.config.update(limit, 7)
    try:
        ask()
        with pytest.raises(ZeroDivisionError):
            fails()
        assert settings() == before | {limit: 7}
    finally:
        jax.config.update(limit, before[limit])


def test_a_folder_that_others_may_write_is_closed(folder, tmp_path):
    (tmp_path / "cache").mkdir()
    ask()
    (file,) = folder()
    file.parent.chmod(0o777)
    assert files.own_folder(file.parent)
    assert file.parent.stat().st_mode & 0o777 == 0o700


ACCIDENTS = {
    "empty": lambda file: file.write_bytes(b""),
    "cut short": lambda file: file.write_bytes(file.read_bytes()[:-100]),
    "a flipped bit": lambda file: file.write_bytes(file.read_bytes()[:-9] + b"\x00" + file.read_bytes()[-8:]),
    "something else": lambda file: file.write_bytes(b"#!/bin/sh\nexit 1\n"),
    "writable for others": lambda file: file.chmod(0o666),
    "a link": lambda file: file.symlink_to(file.rename(file.with_suffix(".moved"))),
}


@pytest.mark.parametrize("accident", ACCIDENTS)
def test_a_file_that_is_no_good_is_made_anew(accident, folder):
    ask()
    (file,) = folder()
    ACCIDENTS[accident](file)
    FACTOR["now"] = 3.0
    assert ask() == [3.0, 6.0]
    FACTOR["now"] = 4.0
    assert ask() == [3.0, 6.0]
    assert len(folder()) == 1


def test_a_program_under_another_name_is_not_read(folder):
    ask()
    (file,) = folder()
    FACTOR["now"] = 3.0
    assert ask(quick=False) == [3.0, 6.0]
    other = next(path for path in folder() if path != file)
    other.write_bytes(file.read_bytes())
    assert ask(quick=False) == [3.0, 6.0]


def test_a_program_that_does_not_run_is_made_anew(folder, monkeypatch):
    ask()

    def broken(self, arrays, real=kept._Ready._run):
        if self.compiled is not FACTOR.get("made"):
            raise jax.errors.JaxRuntimeError("NOT_FOUND: Function iota.1_kernel not found")
        return real(self, arrays)

    def made(self, *args, real=KeptProgram._made):
        found = real(self, *args)
        FACTOR["made"] = found.compiled
        return found

    monkeypatch.setattr(kept._Ready, "_run", broken)
    monkeypatch.setattr(KeptProgram, "_made", made)
    FACTOR["now"] = 3.0
    assert ask() == [3.0, 6.0]


def test_off(folder, monkeypatch):
    monkeypatch.setenv("JAXBEARING_CACHE", "off")
    assert ask() == [2.0, 4.0]
    assert folder() == []


def test_a_folder_that_cannot_be_written(folder, monkeypatch):
    monkeypatch.setenv("JAXBEARING_CACHE", "/proc/none")
    assert ask() == [2.0, 4.0]


def test_a_disk_that_is_full(folder, monkeypatch):
    def full(*_):
        raise OSError("No space left on device")

    monkeypatch.setattr("os.replace", full)
    assert ask() == [2.0, 4.0]
    assert folder() == []


def test_the_oldest_go(folder, monkeypatch):
    ask()
    (first,) = folder()
    os.utime(first, (1.0, 1.0))
    monkeypatch.setattr(files, "MOST_BYTES", first.stat().st_size + 100)
    ask(quick=False)
    assert len(folder()) == 1
    assert not first.exists()


def test_what_a_killed_process_left_goes(folder):
    ask()
    (first,) = folder()
    old, young = first.with_name("a.part"), first.with_name("b.part")
    for file in (old, young):
        file.write_bytes(b"half")
    os.utime(old, (1.0, 1.0))
    ask(quick=False)
    assert (old.exists(), young.exists()) == (False, True)


def test_programs_that_call_python_are_not_kept(folder):
    assert float(KeptProgram(called, True)(jnp.asarray(3.0))) == 6.0
    assert folder() == []


def called(x):
    return jax.lax.cond(x > 0, lambda: jax.pure_callback(lambda y: 2.0 * y, x, x), lambda: x)


def test_code_from_elsewhere_is_not_kept(folder, monkeypatch):
    """A law of the user's own may change without anything that is known here."""
    monkeypatch.setattr("jaxbearing.programs.describe._KNOWN", ("jaxbearing", "builtins", "equinox"))
    scene = jb.load_scene("reference_roller", {"contact": "none"})
    program = KeptProgram(radius, True)
    monkeypatch.setattr("jaxbearing.programs.describe._KNOWN", ("jaxbearing", "builtins", "equinox", "test_kept"))
    program(scene)
    assert len(folder()) == 1

    class OwnGeometry(type(scene.geometry)):
        pass

    own = scene.replace({"geometry": OwnGeometry(**vars(scene.geometry))})
    assert float(program(own)) == float(scene.geometry.roller_diameter)
    assert len(folder()) == 1


def radius(scene):
    return jnp.asarray(scene.geometry.roller_diameter) * 1.0


WARM = """
import sys
import jaxbearing as jb
from jaxbearing.programs.kept import KeptProgram
if "warm" in sys.argv:
    def made(*_):
        raise AssertionError("traced and compiled again")
    KeptProgram._made = KeptProgram._plain = made
scene = jb.load_scene("deep_groove_6205", {"operation.moment": "none"})
for solution in (jb.solve(scene), jb.jit_solver(scene)(), jb.solve(scene, optimised=True)):
    print(solution.ring.radial.tobytes().hex(), solution.status, sorted(solution.warnings), solution.not_modelled)
"""


@pytest.mark.slow
def test_the_next_process_answers_without_tracing(tmp_path):
    """Also where JAX was loaded first and says what it thinks of loaded programs; with factors by LAPACK."""
    variables = environment(JAXBEARING_CACHE=str(tmp_path), JAX_DISABLE_MOST_OPTIMIZATIONS=None, XLA_FLAGS=None)
    run = lambda *words, before="": subprocess.run(
        [sys.executable, "-c", before + WARM, *words], env=variables, capture_output=True, text=True, check=True
    )
    cold = run()
    assert cold.stdout.count("\n") == 3
    for before in ("", "import jax\n"):
        warm = run("warm", before=before)
        assert (warm.stdout, warm.stderr) == (cold.stdout, "")


@pytest.mark.slow
@pytest.mark.skipif(os.geteuid() != 0 or shutil.which("setpriv") is None, reason="rights are laid down by setpriv")
def test_an_ordinary_user_with_a_cache_of_another_user(tmp_path):
    """The folder may only be read, and its programs belong to somebody else: they are not run, nothing is written, and
    the answer is the same without a word. The user may read everywhere, as the interpreter may belong to root."""
    run = lambda *before: subprocess.run(
        [*before, sys.executable, "-c", ONE], env=variables, capture_output=True, text=True, check=True
    )
    variables = environment(JAXBEARING_CACHE=str(tmp_path), PYTHONDONTWRITEBYTECODE="1")
    expected = run()
    kept_files = {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")}
    assert any(path.suffix == SUFFIX for path in kept_files)
    tmp_path.chmod(0o755)
    rights = "+dac_read_search"
    user = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")
    found = run(*user, f"--inh-caps={rights}", f"--ambient-caps={rights}")
    assert (found.stdout, found.stderr) == (expected.stdout, "")
    assert {path: path.stat().st_mtime_ns for path in tmp_path.rglob("*")} == kept_files


ONE = """
import jaxbearing as jb

print(float(jb.solve(jb.load_scene("planet_roller")).ring.radial).hex())
"""
