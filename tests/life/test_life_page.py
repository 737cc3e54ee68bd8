"""docs/life.md is true: its scene file solves, and so does a misaligned bearing from the command line."""

import re
from pathlib import Path

import numpy as np

import jaxbearing as jb

PAGE = (Path(__file__).parents[2] / "docs" / "life.md").read_text(encoding="utf-8")


def test_scene_of_the_page(tmp_path):
    (text,) = re.findall(r"```toml\n(.*?)```", PAGE, flags=re.DOTALL)
    file = tmp_path / "misaligned.toml"
    file.write_text(text, encoding="utf-8")
    solution = jb.solve(jb.load_scene(str(file)))
    assert solution.ring.tilt == 1.5e-3
    assert np.isfinite(solution.life.Lnmr)
    assert np.nanmin(solution.elements.film_least_inner) < np.nanmin(solution.elements.film_inner)
    aligned = jb.solve(jb.load_scene(str(file), {"operation.misalignment": "0 mrad"}))
    assert aligned.life.L10r > solution.life.L10r
