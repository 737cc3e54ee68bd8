"""Linear solves of batches: values, both derivatives, and that many lanes at once do not block each other."""

import subprocess
import sys
import textwrap

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from jaxbearing.numerics import lapack
from jaxbearing.numerics.dense import solve_dense


def some(*shape, seed=0):
    drawn = np.random.default_rng(seed).standard_normal(shape)
    return jnp.asarray(drawn + (3.0 * np.eye(shape[-1]) if shape[-1] == shape[-2] else 0.0))


def test_solutions_of_one_and_of_a_block():
    @jax.jit
    def solutions(matrix, right, blocks, sides):
        vector, inverse = lapack.solve_vector(matrix, right[:, 0]), lapack.inverse(matrix)
        return lapack.solve(matrix, right), vector, inverse, lapack.solve(blocks, sides)

    matrix, right, blocks, sides = some(5, 5), some(5, 2, seed=1), some(7, 6, 6), some(7, 6, 3, seed=2)
    block, vector, inverse, many = solutions(matrix, right, blocks, sides)
    np.testing.assert_allclose(block, np.linalg.solve(matrix, right), rtol=1e-12)
    np.testing.assert_allclose(vector, np.linalg.solve(matrix, right[:, 0]), rtol=1e-12)
    np.testing.assert_allclose(inverse, np.linalg.inv(matrix), rtol=1e-12)
    np.testing.assert_allclose(many, np.linalg.solve(blocks, sides), rtol=1e-11)


def test_rows_are_exchanged():
    """A matrix whose first pivot is 0, and the order of the rows is no exchange of two."""
    matrix = jnp.asarray([[0.0, 2.0, 1.0], [0.0, 0.0, 3.0], [4.0, 1.0, 0.0]])
    right = jnp.asarray([[1.0], [2.0], [3.0]])
    first = lambda side: (lapack.solve(matrix, side)[0, 0], lapack.solve(matrix, side))
    slope, found = jax.jit(jax.grad(first, has_aux=True))(right)
    np.testing.assert_allclose(found, np.linalg.solve(matrix, right), rtol=1e-14)
    np.testing.assert_allclose(slope[:, 0], np.linalg.inv(matrix)[0], rtol=1e-14)


@pytest.mark.parametrize("batched", [(0, 0), (0, None), (None, 0)])
def test_lanes_and_their_derivatives(batched):
    """Each lane is the single solve, and both modes are those of numpy's inverse."""
    matrices = some(4, 5, 5) if batched[0] == 0 else some(5, 5)
    rights = some(4, 5, 2, seed=1) if batched[1] == 0 else some(5, 2, seed=1)

    def one(matrix, right):
        found = lapack.solve(matrix, right)
        return jnp.sum(found**2), found

    @jax.jit
    def both_modes(matrices, rights):
        backward, found = jax.vmap(jax.grad(one, argnums=(0, 1), has_aux=True), batched)(matrices, rights)
        forward, _ = jax.vmap(jax.jacfwd(one, argnums=(0, 1), has_aux=True), batched)(matrices, rights)
        return found, backward, forward

    found, backward, forward = both_modes(matrices, rights)
    np.testing.assert_allclose(found, np.linalg.solve(matrices, rights), rtol=1e-11)
    for lane in range(4):
        matrix = matrices[lane] if batched[0] == 0 else matrices
        x = np.asarray(found[lane])
        by_right = np.linalg.solve(np.asarray(matrix).T, 2.0 * x)
        for slopes in (backward, forward):
            np.testing.assert_allclose(slopes[1][lane], by_right, rtol=1e-10)
            np.testing.assert_allclose(slopes[0][lane], -by_right @ x.T, rtol=1e-10, atol=1e-12)


def test_lowest_eigenvalue():
    matrices = some(4, 5, 5)
    found, slope = jax.jit(jax.vmap(jax.value_and_grad(lapack.lowest_eigenvalue)))(matrices)
    np.testing.assert_allclose(found, np.linalg.eigvalsh(0.5 * (matrices + matrices.mT))[:, 0], rtol=1e-12)
    assert not np.any(slope)


def test_a_singular_lane_spoils_no_other():
    matrices = some(3, 5, 5).at[1].set(0.0)
    found = jax.jit(jax.vmap(lapack.solve))(matrices, some(3, 5, 1, seed=1))
    assert not np.any(np.isfinite(found[1]))
    assert np.all(np.isfinite(found[::2]))


def test_many_lanes_of_two_solves_end():
    """In jaxlib 0.10 two batched calls of LAPACK at once on two threads wait for ever, most often the first of them (5
    of 6 processes). The time limit, 30 times what the process needs, ends one that hangs."""
    program = """
        import jax, jax.numpy as jnp, numpy as np
        from jaxbearing.numerics import dense, lapack
        jax.config.update("jax_enable_x64", True)
        drawn = jnp.asarray(np.random.default_rng(0).standard_normal((3, 20000, 5, 5)) + 5.0 * np.eye(5))
        solves = (lapack.solve, lambda m, r: lapack.lowest_eigenvalue(m), lambda m, r: dense.solve_dense(m, r[:, 0]))
        for solve in solves:
            run = jax.jit(lambda all: [jax.vmap(solve)(one, one) for one in all])
            for _ in range(10):
                jax.block_until_ready(run(list(drawn)))
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], timeout=300, check=False)
    assert done.returncode == 0


def test_dense_lanes():
    matrices, rights = some(3, 5, 5), some(3, 5, 1, seed=1)[..., 0]
    found = jax.jit(jax.vmap(solve_dense))(matrices, rights)
    np.testing.assert_allclose(found, np.linalg.solve(matrices, rights[..., None])[..., 0], rtol=1e-11)
