"""One program for all calibrations of a module."""

import jax.numpy as jnp
import pytest

from jaxbearing.calibration import evaluation

LOAD = "operation.radial_load"


def part_at(part, path):
    for name in path.split("."):
        part = getattr(part, name)
    return part


@pytest.fixture(scope="module")
def fields_of_the_module():
    """Fields that the program of a module has beside the calibrated ones."""
    return ()


@pytest.fixture(scope="module")
def one_program(fields_of_the_module):
    """Each set of conditions and of calibrated fields has a program of its own. Here a load that is no condition and
    fields that are not calibrated are columns of the scene's own numbers: one program answers for all of them."""
    real = evaluation._kept_points

    def answered(base, conditions, fields, active, wanted, options):
        own = lambda path: jnp.full(active.shape, part_at(base, path))
        conditions = {LOAD: own(LOAD)} | conditions
        every = {path: own(path) for path in fields_of_the_module} | fields
        values, slopes, converged = real(base, conditions, every, active, wanted, options)
        order = sorted(every)
        return values, slopes[:, jnp.array([order.index(path) for path in sorted(fields)])], converged

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(evaluation, "_kept_points", answered)
        yield
