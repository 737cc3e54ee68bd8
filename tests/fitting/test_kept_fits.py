"""What a fit compiles has a name by which another process finds it."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from fitting import Measurements
from fitting.estimation import estimate_from, held_out, linearized
from fitting.options import FitOptions
from fitting.search import Search, _compiled_state
from fitting.traction import coefficients, slope_over_slide
from jaxbearing.machines import TwoDisk
from jaxbearing.programs import KeptProgram


def measured():
    same = lambda value: np.full(4, value)
    return Measurements(
        slide_to_roll=np.asarray([0.005, 0.01, 0.02, 0.05]),
        traction_coefficient=same(0.02),
        load=same(100.0),
        entrainment_speed=same(3.0),
        temperature=same(313.15),
        curve=(0, 0, 0, 0),
        curve_names=("a",),
    )


@pytest.fixture(scope="module")
def problem():
    scene = jb.load_scene("two_disk_etm")
    assert isinstance(scene, TwoDisk)
    search = Search(measured(), scene, FitOptions())
    return search.problem(search.free_by_rule()[0], {})


def calls(problem):
    u = jnp.zeros(6)
    column = problem.measured
    return {
        _compiled_state: (problem.scene, column, column, column, column),
        coefficients: (problem.scene, problem.state, problem.rheology, u),
        estimate_from: (problem, u[None], "levenberg_marquardt"),
        held_out: (problem, problem.weight[None], "bfgs"),
        linearized: (problem, u),
        slope_over_slide: (problem, u),
    }


def test_every_program_has_a_name(problem):
    """`NotKept` would be raised for an argument that is known in this process only."""
    names = set()
    for program, given in calls(problem).items():
        assert isinstance(program, KeptProgram)
        leaves, structure = jax.tree.flatten(given)
        names.add(program._name(structure, leaves))
    assert len(names) == 6
