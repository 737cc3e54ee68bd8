"""Rigidities of a maker's catalogue: the script of the documentation, what its page prints, and a pair on a shaft."""

import importlib.util
from pathlib import Path

import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb

DOCS = Path(__file__).parents[2] / "docs"
pytestmark = pytest.mark.slow
RMS = {"KH 17": 1.2, "KH 25": 1.8, "SM 17": 0.8}
"""Series with its angle -> rms deviation over all three preloads, %, of another program with the same laws."""


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("gmn_rigidity", DOCS / "examples" / "gmn_rigidity.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_shows_what_the_script_prints(script, capsys):
    script.main()
    lines = capsys.readouterr().out.splitlines()
    page = (DOCS / "worked_examples.md").read_text(encoding="utf-8")
    assert len(lines) == 9
    assert "\n".join(lines) in page
    for line in lines[3:]:
        if line[:5] in RMS:
            assert float(line.split()[7]) == RMS[line[:5]]


def test_derivatives_and_a_pair_on_a_shaft(script):
    """By differences; KH 6010 C as a scene of the kind shaft, with all of its balls."""
    data = script.printed()
    at = np.flatnonzero((data.series == "KH 17") & (data.ball == 6.35e-3) & (data.balls == 25) & (data.pitch == 65e-3))
    given = [jnp.asarray(one[at]) for one in (data.ball, data.pitch, data.angle, data.balls, data.preload)]
    found = lambda conformity: [np.asarray(one) for one in script.rigidities(jnp.full(len(at), conformity), *given)]
    rigidity, slope = found(0.5388)
    difference = (found(0.5389)[0] - found(0.5387)[0]) / 2e-4
    np.testing.assert_allclose(slope, difference, rtol=1e-5)
    pair = jb.solve(jb.load_scene(DOCS / "examples" / "worked" / "spindle_kh_pair.toml"))
    whole = sum(float(one.stiffness[0, 0]) for one in pair.bearings.values())
    np.testing.assert_allclose(rigidity[data.level[at] == "M"], whole, rtol=1e-6)
