"""Gates of derivatives: numbers pass unchanged, their derivatives only where a condition holds.

The results of a lane that failed are NaN, and NaN times zero must not reach the gradient of a number that lanes share.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool

from .._types import Tree


def derivatives_if(condition: Bool[Array, ""], tree: Tree) -> Tree:
    """The tree, without derivatives with respect to its numbers where the condition does not hold."""
    # not a `custom_jvp` without an operation: under vmap JAX takes its number for unbatched and its slope for batched
    passed = lambda leaf: jnp.where(condition, leaf, jax.lax.stop_gradient(leaf)) if eqx.is_array(leaf) else leaf
    return jax.tree.map(passed, tree)
