"""The eliminations are exact: the reduced solution solves all 3N + 4 equations, nothing eliminated."""

import equinox as eqx
import jax
import numpy as np
import pytest
from full_roller_system import extend, full_residual
from roller_cases import changed, reference_roller, turbine_roller

from jaxbearing.bearings.cylindrical.steady import build_system
from jaxbearing.numerics.newton import newton_solve
from jaxbearing.numerics.precision import as_float

CASES = {
    "nominal": {},
    "light load, large slip": {"operation.radial_load": 250.0},
    "preload": {"geometry.diametral_clearance": -20e-6},
    "cold oil, cage faster than the rollers": {"operation.oil_temperature": 273.15, "operation.oil_flow": 0.0},
}


@eqx.filter_jit
def residual_at_solution(scene):
    system = build_system(scene)
    _, result = newton_solve(system)
    return full_residual(system, extend(system, result.point))


@pytest.mark.parametrize("make", [reference_roller, pytest.param(turbine_roller, marks=pytest.mark.slow)])
@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_reduced_solution_solves_the_full_equations(make, case):
    scene = changed(make(), case)
    residual = np.asarray(residual_at_solution(jax.tree.map(as_float, scene)))
    n = scene.geometry.n_rollers
    # approach, moment, tangential, ring: the same functions, so only the solver's own residual is left
    np.testing.assert_allclose(residual[: 3 * n + 1], 0.0, atol=1e-10)
    # cage: the land in two dimensions equals its static inverse but for the shift of 1e-7 clearances
    np.testing.assert_allclose(residual[3 * n + 1 :], 0.0, atol=1e-6)
