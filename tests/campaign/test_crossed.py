"""The bounded campaign of friction: little oil, rough surfaces, hysteresis and laws of rolling resistance."""

import numpy as np
import pytest
from campaign import judge
from campaign.structures import STRUCTURES

pytestmark = pytest.mark.slow

CROSSED = [structure for structure in STRUCTURES if "supply" in structure.ranges]
BOUNDED = {
    "roller: rolling alone, full range, layer, hysteresis": 48,
    "ball: films, Biboulet-Houpert, layer, hysteresis": 48,
    "roller: skidding, rough, full range, gap": 24,
}
"""Structures whose programs are cheap -> scenes."""


def test_every_friction_law_is_crossed():
    """Each way to give a supply, each load share and each present law of rolling resistance is in the long run."""
    scenes = [structure.scene for structure in CROSSED]
    given = {field for scene in scenes for field in ("layer", "from_flow") if getattr(scene.contact.supply, field)}
    assert len(scenes) >= 10
    assert given


@pytest.mark.parametrize("name", BOUNDED)
def test_random_friction(name):
    """Every scene converges and keeps the invariants; derivatives are finite."""
    structure = next(one for one in CROSSED if one.name == name)
    numbers = structure.at(np.random.default_rng(35).random((BOUNDED[name], structure.size)))
    _, results = judge.solve_batch(structure, numbers, BOUNDED[name])
    found = judge.refused_scenes(structure, numbers) + judge.judge_numbers(structure, numbers, results)
    found += judge.judge_balances(structure, numbers, results)[0]
    found += judge.judge_status(structure, numbers, results)[0]
    assert not found, found
