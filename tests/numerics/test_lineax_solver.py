"""Our equations under optimistix, our elimination under lineax."""

import jax
import jax.numpy as jnp
import lineax as lx
import numpy as np
import optimistix as optx
import pytest
from springs import dense_jacobian, flat, springs

from jaxbearing.numerics.arrow import ArrowPoint
from jaxbearing.numerics.lineax_solver import BlockArrow, arrow_residual
from jaxbearing.numerics.newton import newton_solve

SIZES = [(2, 2, 5), (1, 3, 4), (3, 1, 2)]


def root_by_optimistix(system):
    solver = optx.Newton(rtol=1e-12, atol=1e-12, linear_solver=BlockArrow())
    adjoint = optx.ImplicitAdjoint(linear_solver=BlockArrow())
    return optx.root_find(arrow_residual, solver, system.initial(), args=system, adjoint=adjoint).value


@pytest.mark.parametrize("transposed", [False, True])
@pytest.mark.parametrize(("m", "g", "n"), SIZES)
def test_solve_equals_dense_algebra(m, g, n, transposed):
    system = springs(m, g, n)
    rng = np.random.default_rng(1)
    point = ArrowPoint(jnp.asarray(rng.normal(size=(m, n))), jnp.asarray(rng.normal(size=g)))
    right = ArrowPoint(jnp.asarray(rng.normal(size=(m, n))), jnp.asarray(rng.normal(size=g)))

    @jax.jit
    def solved(system, point, right):
        operator = lx.JacobianLinearOperator(arrow_residual, point, system)
        dense = dense_jacobian(system, point)
        if transposed:
            operator, dense = operator.transpose(), dense.T
        return flat(lx.linear_solve(operator, right, BlockArrow()).value), dense, flat(right)

    solution, dense, right = solved(system, point, right)
    np.testing.assert_allclose(solution, np.linalg.solve(dense, right), rtol=1e-10, atol=1e-12)


def test_transpose_of_the_state_is_the_state_of_the_transpose():
    @jax.jit
    def states(system):
        operator = lx.JacobianLinearOperator(arrow_residual, system.initial(), system)
        solver = BlockArrow()
        turned, _ = solver.transpose(solver.init(operator, {}), {})
        return turned, solver.init(operator.transpose(), {})

    for a, b in zip(*states(springs(2, 3, 4)), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-13, atol=1e-14)


def test_optimistix_finds_the_root_of_newton_solve():
    system = springs()
    np.testing.assert_allclose(
        flat(root_by_optimistix(system)), flat(newton_solve(system)[1].point), rtol=1e-10, atol=1e-13
    )


def test_gradient_through_optimistix_equals_ours():
    theirs = jax.jit(jax.grad(lambda system: jnp.sum(flat(root_by_optimistix(system)) ** 2)))(springs())
    ours = jax.jit(jax.grad(lambda system: jnp.sum(flat(newton_solve(system)[1].point) ** 2)))(springs())
    np.testing.assert_allclose(theirs.load, ours.load, rtol=1e-9)
    np.testing.assert_allclose(theirs.stiffness, ours.stiffness, rtol=1e-9)
