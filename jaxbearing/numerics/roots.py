"""Scalar roots of monotone functions, elementwise over arrays, with the implicit derivative."""

from collections.abc import Callable
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, PyTree

from .._types import Values

SHORT = 100.0
"""A Newton step shorter than the tolerance times this factor is taken even if it leaves the bracket."""


class Root(NamedTuple):
    """A root and how well it was found.

    `residual` is |f(value)| in the unit of f before the last Newton step. A nested solve hands it to
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
    expansion: Callable[[Array, PyTree], tuple[Array, Array, Array]] | None = None,
) -> Root:
    r"""Root of a function that is strictly increasing in x on [lower, upper], elementwise.

    Safeguarded Newton: a Newton step that would leave the bracket (or is not finite) is replaced
    by bisection, unless it is shorter than `SHORT` tolerances; the bracket shrinks at every step. It stops when every
    element's step is below `tolerance * max(1, |x|)`; that step is taken, so the error is about its square (its
    cube with an `expansion`: the steps are then Halley's, of third order). For a root
    outside the bracket the result is the nearer bracket end, and the residual shows it.

    The derivative is that of the implicit function, $dx = -(\partial f/\partial a)\,da /
    (\partial f/\partial x)$, in both modes and to any order; 0 where there is no root or the function is flat.

    **Arguments:**
    - `function(x, args)`: elementwise in x, increasing; shape of x in, shape of x out.
    - `args`: pytree of everything that `function` depends on (what it closes over must not be differentiated).
    - `lower`, `upper`, `guess`: broadcast to the shape of the root; not differentiated.
    - `expansion(x, args)`: value, slope and curvature of the same function, where they are cheap.
    """
    lower, upper, guess = jnp.broadcast_arrays(
        *(jax.lax.stop_gradient(jnp.asarray(v, dtype=float)) for v in (lower, upper, guess))
    )
    value, residual, _ = _root(
        args,
        function=function,
        expansion=expansion,
        bracket=(lower, upper),
        guess=guess,
        tolerance=tolerance,
        max_steps=max_steps,
    )
    return Root(value, residual)


class _Search(NamedTuple):
    x: Array
    low: Array
    high: Array
    step: Array
    residual: Array
    proper: Array
    end: Array
    steps: Array


def _value_and_slope(function: Callable, x: Array, args: PyTree) -> tuple[Array, Array]:
    return jax.jvp(lambda x_: function(x_, args), (x,), (jnp.ones_like(x),))


@eqx.filter_custom_jvp
def _root(
    args: PyTree,
    *,
    function: Callable[[Array, PyTree], Array],
    expansion: Callable[[Array, PyTree], tuple[Array, Array, Array]] | None,
    bracket: tuple[Array, Array],
    guess: Array,
    tolerance: float,
    max_steps: int,
) -> tuple[Float[Array, "*batch"], Float[Array, "*batch"], Bool[Array, "*batch"]]:
    """Root, residual, and whether it is a proper root (with a derivative)."""
    lower, upper = bracket

    def keep_going(state):
        return (state.steps < max_steps) & jnp.any(state.step > tolerance)

    def advance(state):
        if expansion is None:
            value, slope = _value_and_slope(function, state.x, args)
            step = value / slope
        else:
            value, slope, curvature = expansion(state.x, args)
            step = value / slope
            # Halley's; Newton's far from the root, where the former is longer than twice it
            bend = 0.5 * step * curvature / slope
            step = step / jnp.where(bend < 0.5, 1.0 - bend, 1.0)
        low = jnp.where(value < 0, state.x, state.low)
        high = jnp.where(value > 0, state.x, state.high)
        newton = state.x - step
        # False for NaN; where a function that should rise falls, halving the bracket still finds a root. XLA may
        # compute `value` twice, with other last bits: at the root one copy says on which side of it x lies, the other
        # where Newton's step goes. So the step is held against the bracket of before, and short ones are always taken.
        inside = (newton >= state.low) & (newton <= state.high) & (slope > 0)
        short = (jnp.abs(step) <= SHORT * tolerance * jnp.maximum(1.0, jnp.abs(state.x))) & (slope > 0)
        newton = jnp.where(short, jnp.clip(newton, lower, upper), newton)
        x = jnp.where(value == 0, state.x, jnp.where(inside | short, newton, 0.5 * (low + high)))
        step = jnp.abs(x - state.x) / jnp.maximum(1.0, jnp.abs(x))
        # proper: the Newton step from here stays in the first bracket, so x is a root and not a bracket end
        proper = (newton > lower) & (newton < upper) & (slope > 0)
        end = jnp.where(newton >= upper, upper, jnp.where(newton <= lower, lower, state.x))
        return _Search(x, low, high, step, jnp.abs(value), proper, end, state.steps + 1)

    unknown = jnp.full(guess.shape, jnp.inf)
    never = jnp.zeros(guess.shape, bool)
    start = _Search(guess, lower, upper, unknown, unknown, never, guess, jnp.asarray(0))
    last = jax.lax.while_loop(keep_going, advance, start)
    return jnp.where(last.proper, last.x, last.end), last.residual, last.proper


@_root.def_jvp
def _root_jvp(primals, tangents, *, function, **options):
    (args,), (args_dot,) = primals, tangents
    x, residual, proper = _root(args, function=function, **options)
    # one trace of the function for both directions, along x and along what it depends on
    moved, fixed = eqx.partition(args, jax.tree.map(lambda dot: dot is not None, args_dot, is_leaf=lambda d: d is None))
    push = jax.linearize(lambda x_, moved_: function(x_, eqx.combine(moved_, fixed)), x, moved)[1]
    slope = push(jnp.ones_like(x), jax.tree.map(jnp.zeros_like, args_dot))
    value_dot = push(jnp.zeros_like(x), args_dot)
    x_dot = jnp.where(proper, -value_dot / jnp.where(proper, slope, 1.0), 0.0)
    return (x, residual, proper), (x_dot, jnp.zeros_like(residual), None)
