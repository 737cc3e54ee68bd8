"""The example of docs/theory/four_point.md: losses of a four-point bearing under mainly radial load."""

import importlib.util
import re
from pathlib import Path

import numpy as np
import pytest

DOCS = Path(__file__).parents[3] / "docs"
ROW = r"^\| (\d), 5 \| ([\d.]+) \| (\d) \| ([\d.]+) \| ([\d.]+) \|$"

pytestmark = pytest.mark.slow


def test_page_has_the_numbers_of_the_script():
    """Each row of the table, and what is reported of such bearings: four contacts lose more than two, and the more so
    the more radial the load is."""
    spec = importlib.util.spec_from_file_location("four_point_losses", DOCS / "examples" / "four_point_losses.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    page = (DOCS / "theory" / "four_point.md").read_text(encoding="utf-8")
    rows = re.findall(ROW, page, flags=re.MULTILINE)
    assert [int(found[0]) for found in rows] == list(script.AXIAL)
    scenes, ratios = script.bearings(), []
    for axial, *printed in rows:
        (four, contacts), (two, _) = (script.row(scene, float(axial)) for scene in scenes.values())
        # half of the last of three printed digits
        expected = [float(printed[0]), float(printed[2])]
        np.testing.assert_allclose([four, two], expected, rtol=6e-3)
        assert contacts == int(printed[1])
        ratios.append(four / two)
    assert ratios[0] > 1.0
    assert np.all(np.diff(ratios) > 0.0)
