"""Random shafts on several bearings: a bounded run, and the long one.

`python -m pytest tests/campaign/test_shaft_campaign.py --campaign 2000` draws 2000 scenes, as many of each structure.
"""

import math

import numpy as np
import pytest
from campaign import report
from campaign.draws import pick
from campaign.judge import campaign, judge_balances, judge_numbers, judge_status, refused_scenes, solve_batch
from campaign.shafts import STRUCTURES, share_with_an_empty_bearing
from campaign.test_campaign import LEAST_CONVERGED

pytestmark = pytest.mark.slow
CHUNK = 32
FEW = 16
"""Scenes of the bounded run, of each of the structures in `SMALL`."""
SMALL = (0, 4)


@pytest.fixture(scope="module")
def verdicts(request):
    """Those of the structures so far; the table and the file when all are done."""
    found, empty = [], []
    yield found, empty
    if found:
        report.write(found, request.config.getoption("--campaign-file"))
        with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
            print(f"\n{report.table(found)}\n{report.totals(found)}\nwith an empty bearing: {np.mean(empty):.0%}")


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_random_shafts_at_length(structure, verdicts, request):
    cases = math.ceil(request.config.getoption("--campaign") / len(STRUCTURES))
    if not cases:
        pytest.skip("the long run: give --campaign CASES")
    seed = request.config.getoption("--campaign-seed")
    numbers = structure.at(np.random.default_rng(seed).random((cases, structure.size)))
    _, results = solve_batch(structure, pick(numbers, slice(0, 3 * CHUNK)), CHUNK)
    found = campaign(structure, cases, seed, CHUNK)
    verdicts[0].append(found)
    verdicts[1].append(share_with_an_empty_bearing(results))
    unexpected = [breach for breach in found.breaches if breach.rule != "converges"]
    assert not unexpected, unexpected[:3]
    assert found.failed <= max(1.0, (1.0 - LEAST_CONVERGED) * cases)


def test_nearly_all_shafts_converge(verdicts, request):
    if not request.config.getoption("--campaign") or len(verdicts[0]) < len(STRUCTURES):
        pytest.skip("the whole long run: give --campaign CASES")
    failed, converged = (sum(getattr(one, name) for one in verdicts[0]) for name in ("failed", "converged"))
    assert failed <= (1.0 - LEAST_CONVERGED) * (converged + failed)


@pytest.mark.parametrize("place", SMALL)
def test_a_few_random_shafts(place):
    structure = STRUCTURES[place]
    numbers = structure.at(np.random.default_rng(3).random((FEW, structure.size)))
    _, results = solve_batch(structure, numbers, FEW)
    found = refused_scenes(structure, numbers) + judge_numbers(structure, numbers, results)
    found += judge_balances(structure, numbers, results)[0] + judge_status(structure, numbers, results)[0]
    assert not found, found[:3]
