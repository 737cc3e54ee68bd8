"""Functions that a compiled program contains once, however often it calls them."""

import functools
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool

Result = TypeVar("Result")


class _Shape(NamedTuple):
    """Structure of a result, with shape and type of each of its arrays."""

    structure: Any
    arrays: tuple[tuple[tuple[int, ...], np.dtype], ...]


def once(function: Callable[..., Result]) -> Callable[..., Result]:
    """The function under a `jax.jit` of its own, whose result is one array.

    JAX leaves out the parts of a result that a call does not use, so that calls using different parts would become
    different functions in the program; one array has no such parts. (Calls inside and outside of loops still make two
    functions, since JAX removes dead code from outer calls only.) All numbers of the result must be exact as 64-bit
    floats. The function returned takes one more argument by its name, `when`: where it is False, every number of the
    result is 0 and nothing is computed.

    **Arguments:** `function`: from pytrees to a pytree of arrays; it closes over no traced value.
    """

    @eqx.filter_jit
    def packed(args: tuple[object, ...]) -> tuple[jax.Array, _Shape]:
        leaves, structure = jax.tree.flatten(function(*args))
        leaves = [jnp.asarray(leaf) for leaf in leaves]
        flat = jnp.concatenate([jnp.ravel(leaf).astype(float) for leaf in leaves])
        return flat, _Shape(structure, tuple((leaf.shape, leaf.dtype) for leaf in leaves))

    @functools.wraps(function)
    def call(*args: object, when: Bool[Array, ""] | None = None) -> Result:
        if when is None:
            flat, shape = packed(args)
        else:
            like, shape = eqx.filter_eval_shape(packed, args)
            flat = jax.lax.cond(when, lambda: packed(args)[0], lambda: jnp.zeros(like.shape))
        sizes = [int(np.prod(dims)) for dims, _ in shape.arrays]
        parts = jnp.split(flat, np.cumsum(sizes)[:-1])
        leaves = [part.reshape(dims).astype(dtype) for part, (dims, dtype) in zip(parts, shape.arrays, strict=True)]
        return jax.tree.unflatten(shape.structure, leaves)

    return call
