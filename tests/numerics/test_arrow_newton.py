"""Block-arrow algebra against dense algebra, and the Newton iteration on a small system with a known answer."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from springs import Springs, dense_jacobian, flat, springs

from jaxbearing.numerics.arrow import (
    evaluate,
    linearize,
    schur_complement,
    solve_arrow,
)
from jaxbearing.numerics.newton import NewtonOptions, newton_solve
from jaxbearing.numerics.small_linear import solve_blocks
from jaxbearing.numerics.status import Status


@pytest.mark.parametrize(("m", "g"), [(0, 1), (0, 5), (1, 2), (2, 1), (2, 5), (3, 2), (4, 1), (6, 5)])
def test_arrow_equals_dense(m, g):
    """Each number of unknowns and of globals; the elements are eliminated before a global is seen."""
    system = springs(m, g)
    residual, right, dense, solution, complement = (np.asarray(part) for part in arrow_algebra(system))
    np.testing.assert_allclose(residual, right, rtol=1e-14)
    expected = np.linalg.solve(dense, right)
    np.testing.assert_allclose(solution, expected, rtol=1e-11, atol=1e-13)
    k = m * 5
    schur = dense[k:, k:] - dense[k:, :k] @ np.linalg.solve(dense[:k, :k], dense[:k, k:])
    np.testing.assert_allclose(complement, schur, rtol=1e-11, atol=1e-13)


@jax.jit
def arrow_algebra(system):
    """Residual twice, dense Jacobian, solution of the linear system and Schur complement, at the first guess."""
    point = system.initial()
    equations, jacobian = linearize(system, point)
    right = evaluate(system, point).residual
    solution, complement = solve_arrow(jacobian, right), schur_complement(jacobian)
    return flat(equations.residual), flat(right), dense_jacobian(system, point), flat(solution), complement


@pytest.mark.parametrize("m", [1, 2, 3, 4, 5, 7])
def test_small_blocks_against_lapack(m):
    rng = np.random.default_rng(m)
    matrix = rng.normal(size=(m, m, 40)) + 3.0 * np.eye(m)[:, :, None]  # natural stiffness on the diagonal
    right = rng.normal(size=(m, 3, 40))
    expected = np.moveaxis(np.linalg.solve(np.moveaxis(matrix, -1, 0), np.moveaxis(right, -1, 0)), 0, -1)
    found = jax.jit(solve_blocks)(jnp.asarray(matrix), jnp.asarray(right))
    np.testing.assert_allclose(found, expected, rtol=1e-8, atol=1e-10)


@pytest.mark.parametrize("m", [1, 3, 5])
def test_singular_block_harms_only_its_own_column(m):
    matrix = np.repeat(np.eye(m)[:, :, None], 3, axis=2)
    matrix[0, 0, 1] = 0.0
    solution = jax.jit(solve_blocks)(jnp.asarray(matrix), jnp.asarray(np.ones((m, 1, 3))))
    np.testing.assert_array_equal(np.isfinite(solution).all(axis=(0, 1)), [True, False, True])


@pytest.mark.parametrize("m", [0, 2, 5])
def test_newton_finds_the_root(m):
    @jax.jit
    def solved(system):
        _, result = newton_solve(system)
        return result, flat(evaluate(system, result.point).residual)

    result, residual = solved(springs(m))
    assert int(result.status) == Status.CONVERGED
    assert int(result.iterations) <= 12
    assert float(result.residual_norm) < 1e-10  # before the last step
    # rounding of residuals of order 10
    np.testing.assert_allclose(residual, 0.0, atol=1e-13)


def test_implicit_gradient_both_modes_and_differences():
    def of_load(load):
        live, result = newton_solve(Springs(springs().stiffness, load))
        return jnp.sum(jnp.sin(result.point.elements)) + result.point.globals[0] ** 2 + live.stiffness[0]

    @jax.jit
    def derivatives(load):
        """Value, slope in both modes, and to any order: the derivative of the derivative."""
        value, reverse = jax.value_and_grad(of_load)(load)
        return value, reverse, jax.jacfwd(of_load)(load), jax.jacfwd(jax.jacrev(of_load))(load)

    load, step = jnp.asarray([1.0, 2.0]), 1e-5
    _, reverse, forward, hessian = derivatives(load)
    np.testing.assert_allclose(forward, reverse, rtol=1e-12)
    for i in range(2):
        up, down = (derivatives(load.at[i].add(way * step)) for way in (1.0, -1.0))
        np.testing.assert_allclose(forward[i], (up[0] - down[0]) / (2 * step), rtol=1e-8)
        np.testing.assert_allclose(hessian[:, i], (up[1] - down[1]) / (2 * step), rtol=1e-7)


FLAWS, SCALES = jnp.asarray([0.0, 1.0, 0.0, 0.0]), jnp.asarray([1.0, 1.0, 1e9, 2.0])


def lane(shared, flaw, scale):
    system = Springs(shared * jnp.linspace(0.5, 1.5, 5), scale * jnp.asarray([1.0, 2.0]), flaw=flaw)
    live, result = newton_solve(system, NewtonOptions(max_steps=25))
    value = jnp.sum(result.point.elements) * live.stiffness[0]
    return jnp.where(result.converged, value, jnp.nan), result.status


alone = jax.jit(jax.value_and_grad(lane, has_aux=True))


@pytest.mark.parametrize("mapped", ["vmap", "map"])
def test_failed_lane_harms_nobody(mapped):
    """One lane NaN, one far too hard for the step limit: neighbours keep values AND gradients of single solves."""

    def masked_sum(shared):
        if mapped == "vmap":
            values, status = jax.vmap(lambda f, s: lane(shared, f, s))(FLAWS, SCALES)
        else:
            values, status = jax.lax.map(lambda fs: lane(shared, *fs), (FLAWS, SCALES))
        return jnp.sum(jnp.where(status == Status.CONVERGED, values, 0.0)), (values, status)

    @jax.jit
    def both_modes(shared):
        reverse, found = jax.grad(masked_sum, has_aux=True)(shared)
        return found, reverse, jax.jvp(lambda s: masked_sum(s)[0], (shared,), (1.0,))[1]

    (values, status), *slopes = both_modes(1.0)
    np.testing.assert_array_equal(status, [Status.CONVERGED, Status.DIVERGED, Status.NOT_CONVERGED, Status.CONVERGED])
    assert np.isnan(values[1])
    assert np.isnan(values[2])
    singles = [alone(1.0, FLAWS[i], SCALES[i]) for i in (0, 3)]
    np.testing.assert_allclose(values[jnp.array([0, 3])], [value for (value, _), _ in singles], rtol=1e-13)
    np.testing.assert_allclose(slopes, sum(slope for _, slope in singles), rtol=1e-12)


def test_failure_names_residual_and_worst_equation():
    _, result = jax.jit(lambda scale: newton_solve(springs(scale=scale), NewtonOptions(max_steps=5)))(1e9)
    assert result.status == Status.NOT_CONVERGED
    assert result.iterations == 5
    assert result.residual_norm > 1.0
    assert springs().equation_names()[int(result.worst_equation)].startswith("g")
    assert jnp.all(jnp.isfinite(flat(result.point)))


def test_unconverged_inner_solve_is_not_hidden():
    class Hiding(Springs):
        def global_residual(self, globals_, totals):
            return super().global_residual(globals_, totals)[0], jnp.asarray(1e-3)

    _, result = jax.jit(newton_solve)(Hiding(jnp.linspace(0.5, 1.5, 5), jnp.asarray([1.0, 2.0])))
    assert result.status == Status.NOT_CONVERGED
