"""Dense linear systems in blocks, so that a threaded BLAS cannot get in its own way.

LAPACK's LU factorizes matrices of about 200 rows or more with several threads, which wait for each other by spinning.
Where the cores are shared with anything else (XLA's own threads, another process, a container), one solve of 200
unknowns was measured to take 120 ms instead of 0.4 ms. Here LAPACK sees small blocks only, below its threading
thresholds, and the products between them are XLA's.
"""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .batching import in_turn

UNBLOCKED = 190
"""Number of unknowns up to which LAPACK's LU uses one thread (OpenBLAS: fewer than 40 000 entries)."""
COLUMNS = 7
"""Number of right sides up to which a triangular solve uses one thread (OpenBLAS: fewer than 8)."""


def solve_dense(matrix: Float[Array, "n n"], right_side: Float[Array, " n"]) -> Float[Array, " n"]:
    """The x of `matrix` x = `right_side`; differentiable in both modes.

    Up to 190 unknowns an LU with partial pivoting; beyond, block elimination that pivots inside the diagonal blocks
    only: for matrices whose leading blocks are regular (a boundary-value problem numbered along its axis).
    """
    return jax.lax.custom_linear_solve(
        lambda x: matrix @ x,
        right_side,
        lambda _, b: in_turn(_eliminated, (jax.lax.stop_gradient(matrix), b)),
        lambda _, b: in_turn(_eliminated, (jax.lax.stop_gradient(matrix).T, b)),
    )


def _width(n: int) -> int:
    """Width of the blocks for n unknowns: measured to be fast, with few enough blocks to compile."""
    target = 50 if n <= 300 else 68 if n <= 600 else 100
    return -(-n // -(-n // target))


def _eliminated(system: tuple[Array, Array]) -> Array:
    """Solves (matrix, right side) by LU, or by blocks above `UNBLOCKED`; called for the lanes of a batch in turn: many
    calls at once would block LAPACK (`lapack`)."""
    matrix, right_side = system
    n = right_side.size
    if n <= UNBLOCKED:
        return jnp.linalg.solve(matrix, right_side)
    width = _width(n)
    rest = jnp.concatenate([matrix, right_side[:, None]], axis=1)
    done = []
    while rest.shape[0] > width:
        top = _inverse(rest[:width, :width]) @ rest[:width, width:]
        done.append(top)
        rest = rest[width:, width:] - rest[width:, :width] @ top
    x = jnp.linalg.solve(rest[:, :-1], rest[:, -1])
    for top in reversed(done):
        x = jnp.concatenate([top[:, -1] - top[:, :-1] @ x, x])
    return x


def _inverse(block: Array) -> Array:
    """Inverse of a small matrix, a few columns at a time."""
    width = block.shape[0]
    lu, _, order = jax.lax.linalg.lu(block)
    groups = -(-width // COLUMNS)
    identity = jnp.pad(jnp.eye(width)[order], ((0, 0), (0, COLUMNS * groups - width)))
    columns = identity.reshape(width, groups, COLUMNS).transpose(1, 0, 2)
    factors = jnp.broadcast_to(lu, (groups, width, width))
    half = jax.lax.linalg.triangular_solve(factors, columns, left_side=True, lower=True, unit_diagonal=True)
    whole = jax.lax.linalg.triangular_solve(factors, half, left_side=True, lower=False)
    return whole.transpose(1, 0, 2).reshape(width, COLUMNS * groups)[:, :width]
