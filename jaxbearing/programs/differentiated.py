"""A solve outside of programs and its derivatives, each by a program of its own that is compiled quickly and kept.

One program finds the result and the roots behind it. Another differentiates the result at these roots, where nothing is
searched for: it is as small as a residual and what is computed from its root, and forward mode keeps it so. In reverse
mode XLA would copy what several cotangents share into each kernel that uses it: of a ball bearing with films the
program is compiled in three times the time.
"""

from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.core import Tracer
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Float, Int

from ..numerics.compiling import inside_a_program
from ..numerics.known_roots import known_roots, recorded_roots
from .kept import KeptProgram

_FEWEST_ROWS = 8
"""Rows of the smallest program of derivatives; each larger one has eight times as many."""
_MOST_NUMBERS = 512
"""Most numbers that get a pass each: more would take seconds at every call, and JAX has one reverse pass for all."""


def with_roots(compute: Callable[..., Any], *inputs: object) -> tuple[Any, tuple[Any, ...]]:
    """The result of `compute(*inputs)`, and the roots that it found."""
    with recorded_roots() as roots:
        result = compute(*inputs)
    return result, tuple(roots)


def at_roots(compute: Callable[..., Any], roots: tuple[Any, ...], *inputs: object, stiffness: bool = True) -> Any:
    """The result of `compute(*inputs)` from roots that are known.

    **Arguments:** `stiffness`: of `known_roots`.
    """
    with known_roots(roots, stiffness):
        return compute(*inputs)


solved = KeptProgram(with_roots, quick=True)
"""`with_roots` by a kept program; not to be called inside a program."""


def _rows(
    compute: Callable[..., Any],
    roots: tuple[Any, ...],
    result: object,
    which: Int[Array, " row"],
    count: Int[Array, ""],
    *inputs: object,
) -> Any:
    """Derivatives of the result by some of the numbers in `inputs`, in front of every array of floats.

    **Arguments:** `result`: of `compute(*inputs)`; `which`: places of the numbers among all; `count`: how many of the
    rows are wanted.
    """
    numbers, rest = eqx.partition(inputs, eqx.is_inexact_array)
    flat, unflat = ravel_pytree(numbers)

    def floats(flat: Float[Array, " number"]) -> Any:
        output = at_roots(compute, roots, *eqx.combine(unflat(flat), rest))
        return eqx.filter(output, eqx.is_inexact_array)

    def fill_row(row: Int[Array, ""], rows: object) -> Any:
        direction = jnp.zeros_like(flat).at[which[row]].set(1.0)
        _, along = jax.jvp(floats, (flat,), (direction,))
        return jax.tree.map(lambda all_, new: all_.at[row].set(new), rows, along)

    like = eqx.filter(result, eqx.is_inexact_array)
    nothing = jax.tree.map(lambda leaf: jnp.zeros((which.shape[0], *leaf.shape)), like)
    return jax.lax.fori_loop(0, count, fill_row, nothing)


_kept_rows = KeptProgram(_rows, quick=True)


@jax.jit
def _combined(rows: object, dots: list[Array]) -> Any:
    flat = jnp.concatenate([jnp.ravel(dot) for dot in dots])
    return jax.tree.map(lambda leaf: jnp.tensordot(flat, leaf[: flat.size], 1), rows)


def differentiable(compute: Callable[..., Any], program: Callable[..., Any], *inputs: object) -> Any:
    """The result of `compute(*inputs)` outside of programs, where some of the numbers are differentiated or batched.

    The programs of this module answer where numbers are differentiated once, and `program` in batches, for second
    derivatives and for more than `_MOST_NUMBERS` numbers.

    **Arguments:** `compute`: of a module, pure; `program`: the same under `jax.jit`.
    """
    leaves, structure = jax.tree.flatten(inputs)
    traced = [isinstance(leaf, Tracer) for leaf in leaves]

    def filled(numbers: list[Any]) -> Any:
        own = iter(numbers)
        mine = [next(own) if is_traced else leaf for is_traced, leaf in zip(traced, leaves, strict=True)]
        return jax.tree.unflatten(structure, mine)

    numbers = [leaf for is_traced, leaf in zip(traced, leaves, strict=True) if is_traced]
    places = _places(leaves)
    own_places = [place for is_traced, place in zip(traced, places, strict=True) if is_traced]
    return _answer(numbers, compute=compute, program=program, filled=filled, places=own_places)


def _places(leaves: list[Any]) -> list[np.ndarray]:
    """Places of the numbers of each leaf among all numbers."""
    is_array = lambda leaf: isinstance(leaf, jax.Array | np.ndarray | np.generic)
    sizes = [leaf.size if is_array(leaf) and jnp.issubdtype(leaf.dtype, jnp.inexact) else 0 for leaf in leaves]
    ends = np.cumsum(sizes)
    return [np.arange(end - size, end) for size, end in zip(sizes, ends, strict=True)]


@eqx.filter_custom_jvp
def _answer(numbers: list[Array], *, compute: Any, program: Any, filled: Any, places: Any) -> Any:
    return program(*filled(numbers))


@_answer.def_jvp
def _answer_jvp(primals: Any, tangents: Any, *, compute: Any, program: Any, filled: Any, places: Any) -> Any:
    (numbers,), (dots,) = primals, tangents
    inputs = filled(numbers)
    moving = [dot is not None for dot in dots]
    wanted = np.concatenate([place for place, moves in zip(places, moving, strict=True) if moves])
    if inside_a_program(inputs) or wanted.size > _MOST_NUMBERS:
        return eqx.filter_jvp(lambda numbers: program(*filled(numbers)), (numbers,), (dots,))
    result, roots = solved(compute, *inputs)
    size = _FEWEST_ROWS
    while size < wanted.size:
        size *= 8
    which = np.zeros(size, dtype=int)
    which[: wanted.size] = wanted
    rows = _kept_rows(compute, roots, result, which, np.asarray(wanted.size), *inputs)
    # what depends on none of the numbers, as a residual, is no traced number
    rows = jax.tree.map(lambda leaf: leaf if np.any(leaf) else None, jax.device_get(rows))
    return result, _combined(rows, [dot for dot in dots if dot is not None])
