"""A part of the random campaign of `tapered_campaign.py`: all converge, or there provably is no equilibrium."""

import numpy as np
import pytest
from campaign.tapered_campaign import campaign


@pytest.mark.slow
@pytest.mark.parametrize(("free", "cases"), [(False, 100), (True, 30)])
def test_random_tapered_bearings(free, cases):
    found = campaign(cases, free, seed=7)
    assert not np.any(found["other"]), [found["single"](i) for i in np.flatnonzero(found["other"])]
    assert found["contradicted"] == []
    assert np.sum(found["solved"]) > 0.4 * cases
    assert np.all(found["finite"][found["solved"]])
    assert np.all(found["residual"][found["solved"]] <= 1e-10)
