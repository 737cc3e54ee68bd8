"""Scalar roots of monotone functions, elementwise over arrays, with the implicit derivative."""

from collections.abc import Callable
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, PyTree

from .._types import Values


class Root(NamedTuple):
    """A root and how well it was found.

    `residual` is |f(value)| in the unit of f at the *iterated* root. A nested solve hands it to
    the outer solve's status, so that an inner failure is never hidden by an outer success.
    """

    value: Float[Array, "*batch"]
    residual: Float[Array, "*batch"]


def monotone_root(
    function: Callable[[Array, PyTree], Array],
    args: PyTree,
    lower: Values,
    upper: Values,
    guess: Values,
    *,
    tolerance: float = 1e-14,
    max_steps: int = 60,
) -> Root:
    r"""Root of a function that is strictly increasing in x on [lower, upper], elementwise.

    Safeguarded Newton: a Newton step that would leave the bracket (or is not finite) is replaced
    by bisection, and the bracket shrinks at every step. It stops when every element's step is
    below `tolerance * max(1, |x|)`. A root outside the bracket ends at the nearer bracket end, and
    its residual says so.

    The derivative is that of the implicit function, $dx = -(\partial f/\partial a)\,da /
    (\partial f/\partial x)$, in both modes: the iteration runs on `stop_gradient` values and one
    differentiable Newton step follows. First derivatives only.

    **Arguments:**
    - `function(x, args)`: elementwise in x, increasing; shape of x in, shape of x out.
    - `args`: pytree of everything that `function` depends on (never closed over, or its
      derivative is lost).
    - `lower`, `upper`, `guess`: broadcast to the shape of the root.
    """
    frozen = jax.lax.stop_gradient(args)
    lower, upper, guess = jnp.broadcast_arrays(
        *(jax.lax.stop_gradient(jnp.asarray(v, dtype=float)) for v in (lower, upper, guess))
    )

    def value_and_slope(x, a):
        return jax.jvp(lambda x_: function(x_, a), (x,), (jnp.ones_like(x),))

    def keep_going(state):
        _, _, _, step_size, count = state
        return (count < max_steps) & jnp.any(step_size > tolerance)

    def advance(state):
        x, low, high, _, count = state
        value, slope = value_and_slope(x, frozen)
        low = jnp.where(value < 0, x, low)
        high = jnp.where(value > 0, x, high)
        newton = x - value / slope
        inside = (newton >= low) & (newton <= high)  # False for NaN
        new = jnp.where(inside, newton, 0.5 * (low + high))
        new = jnp.where(value == 0, x, new)
        return new, low, high, jnp.abs(new - x) / jnp.maximum(1.0, jnp.abs(new)), count + 1

    start = (guess, lower, upper, jnp.full(guess.shape, jnp.inf), jnp.asarray(0))
    x = jax.lax.while_loop(keep_going, advance, start)[0]

    value, slope = value_and_slope(x, frozen)
    residual = jnp.abs(value)
    # No root inside: the bracket end that is nearer to one. Flat or not finite: where the search ended. Both with
    # derivative 0 instead of NaN.
    polished = x - value / jnp.where(slope > 0, slope, 1.0)
    usable = jnp.isfinite(slope) & (slope > 0) & (polished > lower) & (polished < upper)
    stuck = jnp.where(polished <= lower, lower, jnp.where(polished >= upper, upper, x))
    correction = function(x, args) / jnp.where(usable, slope, 1.0)
    return Root(jnp.where(usable, x - correction, stuck), residual)
