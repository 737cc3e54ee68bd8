"""LAPACK calls for the lanes of a batch, such that the lanes cannot block each other.

Before jaxlib 0.11, LAPACK's functions distribute the matrices of a large batch over XLA's threads and wait for them on
one of these threads. If there are as many such calls as threads, they wait for ever: seen with jaxlib 0.10 on two cores
and 10 000 matrices of 5 x 5. On a CPU each lane of a batch therefore makes its own call here.
"""

import jax
import jax.numpy as jnp
from jax.lax.linalg import triangular_solve
from jaxtyping import Array, Float, Int

from .batching import in_turn


def solve(matrix: Float[Array, "*block n n"], right: Float[Array, "*block n r"]) -> Float[Array, "*block n r"]:
    """The x of `matrix` x = `right`, by LU with partial pivoting; differentiable in both modes.

    **Arguments:** `matrix`, `right`: the leading axes, of a few matrices only, are solved in one call.
    """
    factors, order = in_turn(_factored, jax.lax.stop_gradient(matrix))
    return jax.lax.custom_linear_solve(
        lambda x: matrix @ x,
        right,
        lambda _, b: in_turn(_substituted, (factors, order, b)),
        lambda _, b: in_turn(_substituted_transposed, (factors, order, b)),
    )


def solve_vector(matrix: Float[Array, "n n"], right: Float[Array, " n"]) -> Float[Array, " n"]:
    """`solve` for one right side."""
    return solve(matrix, right[:, None])[:, 0]


def inverse(matrix: Float[Array, "n n"]) -> Float[Array, "n n"]:
    """The inverse of one matrix, by `solve`."""
    return solve(matrix, jnp.eye(matrix.shape[-1], dtype=matrix.dtype))


def lowest_eigenvalue(matrix: Float[Array, "n n"]) -> Float[Array, ""]:
    """The least eigenvalue of the symmetric part of one matrix; its derivative is 0 here."""
    return in_turn(_lowest, jax.lax.stop_gradient(matrix))


def _lowest(matrix: Float[Array, "n n"]) -> Float[Array, ""]:
    return jnp.linalg.eigvalsh(0.5 * (matrix + matrix.T))[0]


def _factored(matrix: Float[Array, "*block n n"]) -> tuple[Float[Array, "*block n n"], Int[Array, "*block n"]]:
    factors, _, order = jax.lax.linalg.lu(matrix)
    return factors, order


_Given = tuple[Float[Array, "*block n n"], Int[Array, "*block n"], Float[Array, "*block n r"]]
"""Factors of LU, order of the rows after pivoting, right sides."""


def _substituted(factored: _Given) -> Float[Array, "*block n r"]:
    factors, order, right = factored
    right = jnp.take_along_axis(right, order[..., None], axis=-2)
    half = triangular_solve(factors, right, left_side=True, lower=True, unit_diagonal=True)
    return triangular_solve(factors, half, left_side=True, lower=False)


def _substituted_transposed(factored: _Given) -> Float[Array, "*block n r"]:
    factors, order, right = factored
    half = triangular_solve(factors, right, left_side=True, lower=False, transpose_a=True)
    x = triangular_solve(factors, half, left_side=True, lower=True, unit_diagonal=True, transpose_a=True)
    return jnp.take_along_axis(x, jnp.argsort(order, axis=-1)[..., None], axis=-2)
