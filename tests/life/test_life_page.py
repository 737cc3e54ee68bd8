"""docs/life.md is true: its scene file solves, aligned as well, and its Python prints what the page says."""

import re

import numpy as np
import pytest
from life_page import PAGE, optimisation_example

import jaxbearing as jb


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


@pytest.mark.slow
def test_profile_for_the_longest_life():
    names, printed = optimisation_example()
    assert names["lives"][1] > max(names["lives"][0], names["straight"])
    assert printed in PAGE
