"""Names of the types of arguments and results of numeric functions. They state shapes, not units.

A law is a formula that maps numbers to a number. Its arguments may be arrays that broadcast against each other;
`jax.vmap` makes batches too.
"""

from typing import TYPE_CHECKING, Any, TypeVar

from jaxtyping import Array, ArrayLike, Float

Tree = TypeVar("Tree")
"""A pytree; where a function takes and returns it, the result has the same structure."""

if TYPE_CHECKING:  # static checkers know neither shapes nor that a Python float has jax's operators
    Scalar = Values = Any
    Batch = Array
else:
    Scalar = Float[ArrayLike, ""]
    """One number: a Python float, a numpy scalar or a jax scalar."""

    Values = Float[ArrayLike, "*#batch"]
    """A number or an array of numbers that broadcasts against its companions."""

    Batch = Float[Array, "*batch"]
    """An array that a law returns. It has the shape to which the arguments broadcast."""
