"""Shape-annotated aliases, defined once.

A law is written for one point: its arguments broadcast against each other, and batches come
from broadcasting or from `jax.vmap` outside.
"""

from typing import TYPE_CHECKING, Any

from jaxtyping import Array, ArrayLike, Float

if TYPE_CHECKING:  # static checkers know neither shapes nor that a Python float has jax's operators
    Scalar = Values = Any
    Batch = Array
else:
    Scalar = Float[ArrayLike, ""]
    """One number: a Python float, a numpy scalar or a jax scalar."""

    Values = Float[ArrayLike, "*#batch"]
    """A number or an array of numbers that broadcasts against its companions."""

    Batch = Float[Array, "*batch"]
    """What a law returns: the broadcast shape of its arguments."""
