"""What a solve does not use is not imported: a warm command spends most of its time there."""

import subprocess
import sys

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
