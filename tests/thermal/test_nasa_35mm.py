"""A 35-mm ball bearing of NASA beside its measured heat: the script of the documentation, and what its page prints."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

DOCS = Path(__file__).parents[2] / "docs"
pytestmark = pytest.mark.slow

SHEET = {
    28_000: (317.0, 290.0, 405.5),
    48_000: (917.0, 752.0, 423.9),
    64_000: (1676.0, 1263.0, 444.3),
    72_000: (2142.0, 1559.0, 456.1),
}
"""Speed, rpm -> heat with all oil at the inlet, W; of one node, W, and its temperature, K. Computed with the same laws
by another program around an earlier version of this one."""


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("nasa_35mm", DOCS / "examples" / "nasa_35mm.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_heat_is_that_of_the_sheet(script):
    for rpm, (isothermal, one_node, temperature) in SHEET.items():
        np.testing.assert_allclose(script.heat(None, rpm)[0], isothermal, atol=0.6)
        total, found = script.heat(1, rpm)
        np.testing.assert_allclose(total, one_node, atol=0.6)
        np.testing.assert_allclose(float(found), temperature, atol=0.6)


def test_the_page_shows_what_the_script_prints(script, capsys):
    script.main()
    lines = [line for line in capsys.readouterr().out.splitlines() if line[2:4].isdigit()]
    page = (DOCS / "thermal.md").read_text(encoding="utf-8")
    assert len(lines) == len(SHEET)
    assert all(line in page for line in lines)
