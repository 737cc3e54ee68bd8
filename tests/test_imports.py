"""What a solve does not use is not imported: a warm command spends most of its time there."""

import subprocess
import sys

import pytest
from command_process import environment

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
sys.argv = ["jaxbearing", "new", *{designation!r}.split()]

from jaxbearing.cli import main

main.leave = lambda code: print(code, *sys.modules)
main.main()
"""


@pytest.mark.parametrize("designation", ["6207", "NU 311"])
def test_a_new_scene_imports_no_bearing_and_no_solver(designation, tmp_path):
    """Half of the time of `jaxbearing new` was that of what it does not need."""
    program = NEW.format(designation=designation)
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment(), cwd=tmp_path, capture_output=True, text=True, check=False
    )
    code, *found = done.stdout.splitlines()[-1].split()
    assert code == "0", done.stderr
    assert (tmp_path / f"{designation.replace(' ', '_')}.toml").is_file()
    needless = ("jaxbearing.bearings", "jaxbearing.solve", "jaxbearing.scenes.reader", "scipy.linalg", "diffrax")
    assert not [name for name in found if name.startswith(needless)]
