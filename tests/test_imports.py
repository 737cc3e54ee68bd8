"""What a solve does not use is not imported: a warm command spends most of its time there."""

import subprocess
import sys

import pytest
from command_process import environment

from jaxbearing import _forwarding

FLOATS = """
import sys

{before}
import jaxbearing

imported = "jax" in sys.modules
import jax

print(imported, jax.config.jax_enable_x64, jax.numpy.asarray(1.0).dtype)
"""
SOLVED = """
import jaxbearing as jb
import jaxbearing.cli.main
import jaxbearing.report.json_report
import jaxbearing.report.summary

for name in jb.builtin_names():
    jb.load_scene(name)
print(*{name.split(".")[0] for name in sys.modules})
"""
LARGE = {"dask", "diffrax", "matplotlib", "optimistix", "pandas", "pint", "plotly", "xarray"}


def said_by(program, folder=None, **more):
    """Lines of a process."""
    command, variables = [sys.executable, "-c", program], environment(**more)
    done = subprocess.run(command, env=variables, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_reading_and_showing_a_scene_imports_nothing_large():
    """Of a program that imports the package: it has 64-bit floats, whatever JAX is told."""
    floats, modules = said_by(FLOATS.format(before="") + SOLVED, JAX_ENABLE_X64="0")
    assert floats.split() == ["True", "True", "float64"]
    found = set(modules.split())
    assert "jaxbearing" in found
    assert not found & LARGE


COMMAND = "sys.orig_argv = ['python', '-m', 'jaxbearing']"


@pytest.mark.parametrize(
    ("before", "imported"),
    [("import jax", True), (COMMAND, False), (f"{COMMAND}; import jax", True)],
    ids=["jax first", "command", "command, jax first"],
)
def test_floats_have_64_bits(before, imported):
    """The command imports JAX late, and also then with 64-bit floats."""
    (floats,) = said_by(FLOATS.format(before=before), JAX_ENABLE_X64="0")
    assert floats.split() == [str(imported), "True", "float64"]


NEW = """
import sys

sys.orig_argv = ["python", "-m", "jaxbearing"]

from jaxbearing.cli import main

main.leave = lambda code: print(code, *sys.modules)
for words in {wanted!r}:
    sys.argv = ["jaxbearing", "new", *words, "--output", f"{{words[0]}}.toml"]
    main.main()
"""
OILED = ("--oil", "ISO VG 68", "--radial-load", "3 kN", "--speed", "1500 rpm", "--oil-flow", "10 l/h")
BEARINGS = [("6207",), ("7312-B",), ("7014", "C"), ("NU", "311"), ("32310", "B", "--json"), ("6205-2RS", *OILED)]


def test_a_new_scene_needs_neither_jax_nor_a_bearing(tmp_path):
    """Nearly all of the time of `jaxbearing new` was that of what it does not need. One process makes all scenes,
    the one that needs most comes last."""
    seen = [line.split() for line in said_by(NEW.format(wanted=BEARINGS), tmp_path) if "jaxbearing.cli" in line]
    large = {"jax", "jaxlib", "equinox", "jaxtyping", "scipy", "pint", *LARGE}
    # the ends of tapered rollers are the bearings' own
    own = ["jaxbearing.bearings", "jaxbearing.bearings.tapered", "jaxbearing.bearings.tapered.usual_ends"]
    moved = {f"jaxbearing.{old}" for old in _forwarding.MODULES}  # stand there by name alone
    for words, (code, *found) in zip(BEARINGS, seen, strict=True):
        assert code == "0", words
        assert (tmp_path / f"{words[0]}.toml").is_file()
        assert not large & {name.split(".")[0] for name in found}, words
        assert "numpy" not in found or "--radial-load" in words, words
        assert "jaxbearing.catalogue.kept" in found
        of_bearings = [name for name in found if name.startswith("jaxbearing.bearings") and name not in moved]
        assert of_bearings in ([], own), words
