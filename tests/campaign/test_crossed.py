"""The bounded campaign of friction: little oil, rough surfaces, hysteresis and laws of rolling resistance."""

import numpy as np
import pytest
from campaign import judge
from campaign.structures import STRUCTURES

pytestmark = pytest.mark.slow

CROSSED = {structure.name: structure for structure in STRUCTURES if "supply" in structure.ranges}
BOUNDED = {
    "roller: rolling alone, full range, layer, hysteresis": 48,
    "roller: skidding, rough, full range, gap": 24,
    "ball: films, Biboulet-Houpert, layer, hysteresis": 48,
}
"""Structures whose programs are cheap -> scenes."""


def solved(name, cases):
    structure = CROSSED[name]
    numbers = structure.at(np.random.default_rng(35).random((cases, structure.size)))
    return structure, numbers, judge.solve_batch(structure, numbers, cases)[1]


def test_the_long_run_has_every_law():
    """All ways to give a supply, laws of the load share and present laws of rolling resistance."""
    contacts = [structure.scene.contact for structure in CROSSED.values()]
    given = {field for contact in contacts for field, value in vars(contact.supply).items() if value is not None}
    assert {"gap_over_central", "meniscus_gap", "meniscus_distance", "layer", "from_flow"} <= given
    shares = {type(contact.mixed.share).__name__ for contact in contacts if contact.mixed is not None}
    assert shares == {"ZhouHoeprich", "GreenwoodTripp", "GreenwoodTrippPressure"}
    laws = {contact.rolling.name for contact in contacts}
    assert laws == {"full_range", "biboulet_houpert", "rigid_isoviscous", "source_86"}


@pytest.mark.parametrize("name", BOUNDED)
def test_random_friction(name):
    """Every scene converges and keeps the invariants."""
    structure, numbers, results = solved(name, BOUNDED[name])
    found = judge.refused_scenes(structure, numbers) + judge.judge_numbers(structure, numbers, results)
    found += judge.judge_balances(structure, numbers, results)[0]
    found += judge.judge_status(structure, numbers, results)[0]
    assert not found, found


@pytest.mark.parametrize("name", list(BOUNDED)[:2])
def test_gradients_of_friction(name):
    """Finite and equal to finite differences, by every number."""
    structure, numbers, results = solved(name, 8)
    found, worst, _ = judge.judge_gradient(structure, numbers, results, 8, seed=1)
    assert not found, found
    assert 0.0 < worst <= judge.GRADIENT_LIMIT
