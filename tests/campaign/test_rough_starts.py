"""Rough balls whose boundary friction starts within a narrow range of sliding speeds."""

import dataclasses

import numpy as np
import pytest
from campaign.draws import log
from campaign.structure import in_chunks
from campaign.structures import STRUCTURES

from jaxbearing.numerics.status import Status

NARROW = log(1e-6, 2e-4)
"""Slide widths, m/s."""


def rough(words):
    return next(one for one in STRUCTURES if words in one.name)


@pytest.mark.slow
def test_narrow_starts_of_boundary_friction_are_found():
    """Cases 6, 14, 16 and 35 of these were not, before a path that begins with a wide range: 19 of the first 100."""
    structure = rough("sliding, axial, rough, Biboulet-Houpert, gap")
    structure = dataclasses.replace(structure, ranges={**structure.ranges, "start": NARROW})
    numbers = structure.at(np.random.default_rng(2).random((100, structure.size))[:40])
    solution = in_chunks(structure.solver, numbers, 20)
    np.testing.assert_array_equal(solution.status, Status.CONVERGED)
