"""What a solve does not use is not imported: a warm command spends most of its time there."""

import subprocess
import sys

import pytest
from command_process import environment

from jaxbearing import _forwarding

SOLVED = """
import sys
import jaxbearing as jb
import jaxbearing.cli.main
import jaxbearing.report.json_report
import jaxbearing.report.summary

for name in jb.builtin_names():
    jb.load_scene(name)
print(*{name.split(".")[0] for name in sys.modules})
"""
LARGE = {"dask", "diffrax", "matplotlib", "optimistix", "pandas", "pint", "plotly", "xarray"}


def test_reading_and_showing_a_scene_imports_nothing_large():
    done = subprocess.run(
        [sys.executable, "-c", SOLVED], env=environment(), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    found = set(done.stdout.split())
    assert "jaxbearing" in found
    assert not found & LARGE


NEW = """
import sys

sys.orig_argv = ["python", "-m", "jaxbearing"]
sys.argv = ["jaxbearing", "new", *{words!r}]

from jaxbearing.cli import main

main.leave = lambda code: print(code, *sys.modules)
main.main()
"""
OILED = ("--oil", "ISO VG 68", "--radial-load", "3 kN", "--speed", "1500 rpm", "--oil-flow", "10 l/h")


@pytest.mark.parametrize(
    "words",
    [("6207",), ("7312-B",), ("7014", "C"), ("NU", "311"), ("32310", "B", "--json"), ("6205-2RS", *OILED)],
    ids=" ".join,
)
def test_a_new_scene_needs_neither_jax_nor_a_bearing(words, tmp_path):
    """Nearly all of the time of `jaxbearing new` was that of what it does not need."""
    program = NEW.format(words=(*words, "--output", "new.toml"))
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment(), cwd=tmp_path, capture_output=True, text=True, check=False
    )
    code, *found = done.stdout.splitlines()[-1].split()
    assert code == "0", done.stderr
    assert (tmp_path / "new.toml").is_file()
    large = {"jax", "jaxlib", "equinox", "jaxtyping", "scipy", "pint", *LARGE}
    assert not large & {name.split(".")[0] for name in found}
    assert "numpy" not in found or "--radial-load" in words
    assert "jaxbearing.catalogue.kept" in found
    # the ends of tapered rollers are the bearings' own
    own = ["jaxbearing.bearings", "jaxbearing.bearings.tapered", "jaxbearing.bearings.tapered.usual_ends"]
    moved = {f"jaxbearing.{old}" for old in _forwarding.MODULES}  # stand there by name alone
    assert [name for name in found if name.startswith("jaxbearing.bearings") and name not in moved] in ([], own)


FLOATS = """
import sys

{before}
import jaxbearing

imported = "jax" in sys.modules
import jax

print(imported, jax.config.jax_enable_x64, jax.numpy.asarray(1.0).dtype)
"""
COMMAND = "sys.orig_argv = ['python', '-m', 'jaxbearing']"


@pytest.mark.parametrize(
    ("before", "imported"),
    [("", True), ("import jax", True), (COMMAND, False), (f"{COMMAND}; import jax", True)],
    ids=["library", "jax first", "command", "command, jax first"],
)
@pytest.mark.parametrize("wish", [None, "0"])
def test_floats_have_64_bits(before, imported, wish):
    """The command imports JAX late, and also then with 64-bit floats."""
    program = FLOATS.format(before=before)
    variables = environment(JAX_ENABLE_X64=wish)
    done = subprocess.run([sys.executable, "-c", program], env=variables, capture_output=True, text=True, check=False)
    assert done.stdout.split() == [str(imported), "True", "float64"], done.stderr
