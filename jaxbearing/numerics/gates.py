"""Gates of derivatives: numbers pass unchanged, their derivatives only where a condition holds.

The results of a lane that failed are NaN, and NaN times zero must not reach the gradient of a number that lanes share.
A program that is not differentiated has no operation for a gate.
"""

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool


@jax.custom_jvp
def _gated(number: Array, open_: Bool[Array, ""]) -> Array:
    del open_
    return number


@_gated.defjvp
def _gated_jvp(primals, tangents):
    (number, open_), (number_dot, _) = primals, tangents
    return _gated(number, open_), jnp.where(open_, number_dot, 0.0)


def derivatives_if(condition: Bool[Array, ""], tree: Any) -> Any:
    """The tree, without derivatives with respect to its numbers where the condition does not hold."""
    return jax.tree.map(lambda leaf: _gated(leaf, condition) if eqx.is_inexact_array(leaf) else leaf, tree)
