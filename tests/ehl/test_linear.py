"""The structured Jacobian is the derivative of the whole residual; the dense solver solves."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from line_contacts import satellite
from numpy.testing import assert_allclose

from jaxbearing.ehl.equations import Equations, Point, film_shape, reynolds_residual
from jaxbearing.ehl.linear import as_point, linearize
from jaxbearing.ehl.mesh import MeshKey, mesh
from jaxbearing.numerics.dense import solve_dense

GRID = mesh(MeshKey(61, 4.0, 2.5, True))


@pytest.mark.parametrize("speed", [1.0, -0.5, 0.0])
@pytest.mark.parametrize("compressible", [True, False])
def test_structured_jacobian_is_the_dense_one(speed, compressible):
    pressure = np.where(np.abs(GRID.x) < 1, np.sqrt(np.maximum(1 - GRID.x**2, 0)) + 0.01, 0.0)
    pressure[[0, -1]] = 0.0
    point = Point(jnp.asarray(pressure), jnp.asarray(-0.4))
    found, dense = both_jacobians(satellite(compressible=compressible), jnp.asarray(speed), point)
    live = np.flatnonzero(~np.asarray(found.cavitated))
    assert 5 < live.size < 59
    ours = np.asarray(found.matrix)[live] / -np.asarray(found.scale)[live, None]
    assert_allclose(ours, np.asarray(dense)[live], rtol=1e-11, atol=1e-11 * np.abs(dense).max())


@eqx.filter_jit
def both_jacobians(scene, speed, point):
    scales = scene.scales()
    past = jnp.asarray(np.linspace(-1.0, 1.0, 61))
    equations = Equations(scene.fluid(scales), scales.wedge, speed, jnp.asarray(3.0), past)

    def residual(values):
        at = as_point(values)
        return reynolds_residual(equations, at.pressure, film_shape(at, GRID), GRID)

    values = jnp.concatenate([point.pressure[1:-1], point.offset[None]])
    return linearize(equations, point, GRID), jax.jacfwd(residual)(values)


@pytest.mark.parametrize("n", [20, 200, 451])
def test_dense_solver(n):
    rng = np.random.default_rng(n)
    matrix = jnp.asarray(rng.normal(size=(n, n)) + 3.0 * np.sqrt(n) * np.eye(n))
    right = jnp.asarray(rng.normal(size=n))
    x = jax.jit(solve_dense)(matrix, right)
    assert_allclose(np.asarray(matrix) @ np.asarray(x), right, atol=1e-11)
    back = jax.jit(jax.grad(lambda b: jnp.sum(solve_dense(matrix, b))))(right)
    assert_allclose(back, np.linalg.solve(np.asarray(matrix).T, np.ones(n)), rtol=1e-9, atol=1e-12)
