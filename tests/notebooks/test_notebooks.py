"""The notebooks run from top to bottom as plain Python, without Jupyter; their assertions are part of the test."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from command_process import environment

from jaxbearing.numerics.garbage import RARELY

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
LARGEST = 400_000
"""Bytes of a notebook with its outputs."""
RUN = f"import gc; gc.set_threshold{RARELY}"  # as tests
RUN += """
import json, sys
names = {"__name__": "__main__"}
for i, cell in enumerate(json.load(open(sys.argv[1], encoding="utf-8"))["cells"]):
    if cell["cell_type"] == "code":
        print(f"cell {i}", file=sys.stderr)
        exec(compile("".join(cell["source"]), f"cell {i}", "exec"), names)
"""


def cells(path, kind):
    notebook = json.loads(path.read_text(encoding="utf-8"))
    return [cell for cell in notebook["cells"] if cell["cell_type"] == kind]


def test_there_is_a_notebook():
    assert "getting_started.ipynb" in [path.name for path in NOTEBOOKS]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_stored_as_it_ran(path):
    assert path.stat().st_size < LARGEST
    code = cells(path, "code")
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
    assert not [cell for cell in code for output in cell["outputs"] if output["output_type"] == "error"]


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_runs_from_top_to_bottom(path, tmp_path):
    surroundings = environment(MPLBACKEND="Agg", TMPDIR=str(tmp_path))
    command = [sys.executable, "-c", RUN, str(path)]
    ran = subprocess.run(command, cwd=tmp_path, env=surroundings, capture_output=True, text=True, timeout=900)
    assert ran.returncode == 0, ran.stderr[-3000:]
