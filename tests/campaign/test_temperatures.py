"""The bounded part of the campaign on bearings with a thermal network."""

import numpy as np
import pytest
from campaign import temperatures

from jaxbearing.numerics.status import Status

pytestmark = pytest.mark.slow
CASES = 12


@pytest.mark.parametrize("structure", temperatures.STRUCTURES, ids=lambda structure: structure.name)
def test_random_bearings_balance(structure):
    """Every case is answered with a state whose energy closes, or with an honest status, in few solves."""
    found = temperatures.outcomes(structure, CASES)
    states = [one for one in found if one.status == Status.CONVERGED]
    assert all(one.status in (Status.CONVERGED, *temperatures.HONEST) for one in found), found
    assert all(abs(one.balance) <= temperatures.BALANCE for one in states)
    assert len(states) >= CASES // 2
    assert np.median([one.solves for one in states]) <= structure.median
