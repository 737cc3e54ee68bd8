"""Linear solves for many small dense systems, component axes first, batch axis last."""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float

from . import lapack

UNROLLED_LIMIT = 4
"""Largest block eliminated by unrolled scalar arithmetic; above it LAPACK is faster (measured)."""
MOST_PIVOTS_UNROLLED = 8
"""Largest matrix whose pivots are made positive by unrolled arithmetic: the program grows with the third power."""


def solve_blocks(
    matrix: Float[Array, "m m element"], right: Float[Array, "m r element"]
) -> Float[Array, "m r element"]:
    """Solve `matrix[:, :, j] x[:, :, j] = right[:, :, j]` for every element j.

    Up to 4 unknowns: Gaussian elimination WITHOUT pivoting, unrolled, every operation one
    contiguous vector operation (8-75x faster than batched LAPACK on a CPU; an unrolled *pivoted*
    elimination is slower than either). The order of the unknowns must therefore put the natural
    stiffnesses on the diagonal; Newton corrects the last digits that missing pivoting costs.
    Above 4: LAPACK, with pivoting.

    A singular block gives inf or NaN in its own column only and never raises.
    """
    m = matrix.shape[0]
    if m == 0:
        return right
    if m > UNROLLED_LIMIT:
        return jnp.moveaxis(lapack.solve(jnp.moveaxis(matrix, -1, 0), jnp.moveaxis(right, -1, 0)), 0, -1)
    rows = [[matrix[i, j] for j in range(m)] for i in range(m)]
    rhs = [right[i] for i in range(m)]
    for k in range(m):
        inverse = 1.0 / rows[k][k]
        for i in range(k + 1, m):
            factor = rows[i][k] * inverse
            for j in range(k + 1, m):
                rows[i][j] = rows[i][j] - factor * rows[k][j]
            rhs[i] = rhs[i] - factor[None, :] * rhs[k]
    solution: list = [None] * m
    for i in reversed(range(m)):
        total = rhs[i]
        for j in range(i + 1, m):
            total = total - rows[i][j][None, :] * solution[j]
        solution[i] = total / rows[i][i][None, :]
    return jnp.stack(solution)


def solve_dense(matrix: Float[Array, "g g"], right: Float[Array, " g"]) -> Float[Array, " g"]:
    """One small dense system with pivoting, by LAPACK: the Schur complement of the globals."""
    if matrix.shape[0] == 0:
        return right
    if matrix.shape[0] == 1:
        return right / matrix[0]
    return lapack.solve_vector(matrix, right)


def with_positive_pivots(
    matrix: Float[Array, "m m *batch"],
) -> tuple[Float[Array, "m m *batch"], Bool[Array, "*batch"]]:
    """The matrix with additions to its diagonal that make negative pivots of its elimination positive, with the same
    absolute value; and True where something was added."""
    m = matrix.shape[0]
    if m > MOST_PIVOTS_UNROLLED:
        return _positive_pivots_in_a_loop(matrix)
    rows = [[matrix[i, j] for j in range(m)] for i in range(m)]
    changed = jnp.zeros(matrix.shape[2:], dtype=bool)
    added = []
    for k in range(m):
        pivot = rows[k][k]
        changed = changed | (pivot < 0)
        added.append(jnp.where(pivot < 0, -2.0 * pivot, 0.0))
        pivot = jnp.abs(pivot)
        for i in range(k + 1, m):
            factor = rows[i][k] / pivot
            for j in range(k + 1, m):
                rows[i][j] = rows[i][j] - factor * rows[k][j]
    shifted = [[matrix[i, j] + added[i] if i == j else matrix[i, j] for j in range(m)] for i in range(m)]
    return jnp.stack([jnp.stack(row) for row in shifted]) if m else matrix, changed


def _positive_pivots_in_a_loop(
    matrix: Float[Array, "m m *batch"],
) -> tuple[Float[Array, "m m *batch"], Bool[Array, "*batch"]]:
    """`with_positive_pivots` of a large matrix."""
    m = matrix.shape[0]
    place = jnp.arange(m).reshape((m,) + (1,) * (matrix.ndim - 2))

    def eliminate(k: Array, state: tuple[Array, Array]) -> tuple[Array, Array]:
        rows, added = state
        pivot = rows[k, k]
        added = added.at[k].set(jnp.where(pivot < 0, -2.0 * pivot, 0.0))
        factor = jnp.where(place > k, rows[:, k] / jnp.abs(pivot)[None], 0.0)
        return rows - factor[:, None] * rows[k][None], added

    _, added = jax.lax.fori_loop(0, m, eliminate, (matrix, jnp.zeros_like(matrix[0])))
    diagonal = jnp.eye(m).reshape((m, m) + (1,) * (matrix.ndim - 2))
    return matrix + diagonal * added[:, None], jnp.any(added > 0, axis=0)


def cholesky(matrix: Float[Array, "m m"]) -> Float[Array, "m m"]:
    """Lower factor of a symmetric positive definite matrix, unrolled.

    A program without LAPACK starts sooner: a process loads that library, and what belongs to it, in 0.15 s. A matrix
    that is not positive definite gives NaN.
    """
    m = matrix.shape[0]
    rows = [[jnp.zeros_like(matrix[0, 0])] * m for _ in range(m)]
    for j in range(m):
        for i in range(j, m):
            left = matrix[i, j] - sum((rows[i][k] * rows[j][k] for k in range(j)), start=0.0)
            rows[i][j] = jnp.sqrt(left) if i == j else left / rows[j][j]
    return jnp.stack([jnp.stack(row) for row in rows])


def cholesky_solve(factor: Float[Array, "m m"], right: Float[Array, " m"]) -> Float[Array, " m"]:
    """Solution x of $LL^Tx$ = `right`, with the lower factor L of `cholesky`, unrolled."""
    m = factor.shape[0]
    values = [right[i] for i in range(m)]
    for i in range(m):
        values[i] = (values[i] - sum((factor[i, k] * values[k] for k in range(i)), start=0.0)) / factor[i, i]
    for i in reversed(range(m)):
        values[i] = (values[i] - sum((factor[k, i] * values[k] for k in range(i + 1, m)), start=0.0)) / factor[i, i]
    return jnp.stack(values)
