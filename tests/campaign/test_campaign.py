"""Tries to break the package with random scenes: `python -m pytest tests/campaign --campaign 20000`."""

import pytest
from campaign import report
from campaign.judge import Verdict, campaign
from campaign.structures import STRUCTURES, shares

LEAST_CONVERGED = 0.995
"""Part of the scenes that have an equilibrium, of all structures together."""
LEAST_OF_ONE = 0.97
"""The same of one structure, of some of which there are 200 scenes only."""


@pytest.fixture(scope="module")
def verdicts(request):
    """Those of the structures so far; the table and the file when all are done."""
    if request.config.getoption("--campaign") and hasattr(request.config, "workerinput"):
        pytest.fail("the long run makes one table and one file: leave out -n")
    found: list[Verdict] = []
    yield found
    file = request.config.getoption("--campaign-file")
    report.write(found, file)
    with request.config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
        print(f"\n{report.table(found)}\n{report.totals(found)}\nbreaches: {file}")


@pytest.mark.slow
@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_random_scenes(structure, verdicts, request):
    cases = request.config.getoption("--campaign")
    if not cases:
        pytest.skip("the long run: give --campaign CASES")
    seed = request.config.getoption("--campaign-seed")
    found = campaign(structure, shares(cases)[structure.name], seed)
    verdicts.append(found)
    unexpected = [breach for breach in found.breaches if breach.rule != "converges"]
    assert not unexpected, unexpected[:3]
    assert found.failed <= (1.0 - LEAST_OF_ONE) * (found.converged + found.failed)


@pytest.mark.slow
def test_nearly_all_converge(verdicts, request):
    """After all structures, in one process."""
    if not request.config.getoption("--campaign") or len(verdicts) < len(STRUCTURES):
        pytest.skip("the whole long run: give --campaign CASES")
    failed, converged = (sum(getattr(v, name) for v in verdicts) for name in ("failed", "converged"))
    assert failed <= (1.0 - LEAST_CONVERGED) * (converged + failed)
