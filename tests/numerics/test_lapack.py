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
    matrix, right = some(5, 5), some(5, 2, seed=1)
    np.testing.assert_allclose(lapack.solve(matrix, right), np.linalg.solve(matrix, right), rtol=1e-12)
    np.testing.assert_allclose(
        lapack.solve_vector(matrix, right[:, 0]), np.linalg.solve(matrix, right[:, 0]), rtol=1e-12
    )
    np.testing.assert_allclose(lapack.inverse(matrix), np.linalg.inv(matrix), rtol=1e-12)
    blocks, sides = some(7, 6, 6), some(7, 6, 3, seed=2)
    np.testing.assert_allclose(lapack.solve(blocks, sides), np.linalg.solve(blocks, sides), rtol=1e-11)


def test_rows_are_exchanged():
    """A matrix whose first pivot is 0, and the order of the rows is no exchange of two."""
    matrix = jnp.asarray([[0.0, 2.0, 1.0], [0.0, 0.0, 3.0], [4.0, 1.0, 0.0]])
    right = jnp.asarray([[1.0], [2.0], [3.0]])
    np.testing.assert_allclose(lapack.solve(matrix, right), np.linalg.solve(matrix, right), rtol=1e-14)
    slope = jax.grad(lambda side: lapack.solve(matrix, side)[0, 0])(right)
    np.testing.assert_allclose(slope[:, 0], np.linalg.inv(matrix)[0], rtol=1e-14)


@pytest.mark.parametrize("batched", [(0, 0), (0, None), (None, 0)])
def test_lanes_and_their_derivatives(batched):
    """Each lane is the single solve, and both modes are those of numpy's inverse."""
    matrices = some(4, 5, 5) if batched[0] == 0 else some(5, 5)
    rights = some(4, 5, 2, seed=1) if batched[1] == 0 else some(5, 2, seed=1)
    found = jax.jit(jax.vmap(lapack.solve, batched))(matrices, rights)
    np.testing.assert_allclose(found, np.linalg.solve(matrices, rights), rtol=1e-11)

    def one(matrix, right):
        return jnp.sum(lapack.solve(matrix, right) ** 2)

    backward = jax.vmap(jax.grad(one, argnums=(0, 1)), batched)(matrices, rights)
    forward = jax.vmap(jax.jacfwd(one, argnums=(0, 1)), batched)(matrices, rights)
    for lane in range(4):
        matrix = matrices[lane] if batched[0] == 0 else matrices
        x = np.asarray(found[lane])
        by_right = np.linalg.solve(np.asarray(matrix).T, 2.0 * x)
        for slopes in (backward, forward):
            np.testing.assert_allclose(slopes[1][lane], by_right, rtol=1e-10)
            np.testing.assert_allclose(slopes[0][lane], -by_right @ x.T, rtol=1e-10, atol=1e-12)


def test_lowest_eigenvalue():
    matrices = some(4, 5, 5)
    found = jax.jit(jax.vmap(lapack.lowest_eigenvalue))(matrices)
    np.testing.assert_allclose(found, np.linalg.eigvalsh(0.5 * (matrices + matrices.mT))[:, 0], rtol=1e-12)
    assert not np.any(jax.grad(lapack.lowest_eigenvalue)(matrices[0]))


def test_a_singular_lane_spoils_no_other():
    matrices = some(3, 5, 5).at[1].set(0.0)
    found = jax.jit(jax.vmap(lapack.solve))(matrices, some(3, 5, 1, seed=1))
    assert not np.any(np.isfinite(found[1]))
    assert np.all(np.isfinite(found[::2]))


@pytest.mark.parametrize(
    "solve", ["lapack.solve(m, r)", "lapack.lowest_eigenvalue(m)", "dense.solve_dense(m, r[:, 0])"]
)
def test_many_lanes_of_two_solves_end(solve):
    """In jaxlib 0.10 two batched calls of LAPACK at once on two threads wait for ever. The time limit, 100 times what
    the process needs, ends one that hangs."""
    program = f"""
        import jax, jax.numpy as jnp, numpy as np
        from jaxbearing.numerics import dense, lapack
        jax.config.update("jax_enable_x64", True)
        drawn = np.random.default_rng(0).standard_normal((3, 20000, 5, 5)) + 5.0 * np.eye(5)
        run = jax.jit(lambda all: [jax.vmap(lambda m, r: {solve})(one, one) for one in all])
        for _ in range(10):
            jax.block_until_ready(run(list(jnp.asarray(drawn))))
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], timeout=300, check=False)
    assert done.returncode == 0


def test_dense_lanes():
    matrices, rights = some(3, 5, 5), some(3, 5, 1, seed=1)[..., 0]
    found = jax.vmap(solve_dense)(matrices, rights)
    np.testing.assert_allclose(found, np.linalg.solve(matrices, rights[..., None])[..., 0], rtol=1e-11)
