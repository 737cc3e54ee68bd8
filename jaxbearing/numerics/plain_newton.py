"""Newton on a block-arrow system from a good guess, cheap enough for the inside of a vector field."""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from .._types import Values
from .arrow import AbstractArrowSystem, ArrowPoint, evaluate, linearize, solve_arrow


class PlainRoot(NamedTuple):
    """A root, its largest scaled residual (or that of nested solves, if larger) before the last step, and the Newton
    steps taken."""

    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


def plain_newton(system: AbstractArrowSystem, guess: ArrowPoint, *, tolerance: Values, max_steps: int) -> PlainRoot:
    r"""Capped Newton steps until the scaled residual is below `tolerance`; one more follows, so the error is about
    the square of it.

    That last step $y - J^{-1}F(y, p)$ carries the derivative: with y and J held it is the implicit function's,
    $-J^{-1}\partial F/\partial p$, in both modes; first derivatives only. No line search, no second try:
    `newton_solve` has them.
    """
    held = jax.lax.stop_gradient(system)
    caps, (low, high) = held.step_caps(), held.bounds()

    def go_on(state):
        _, residual, steps = state
        return (residual > tolerance) & (steps < max_steps)

    def advance(state):
        point, _, steps = state
        equations, jacobian = linearize(held, point)
        step = solve_arrow(jacobian, equations.residual)
        capped = jax.tree.map(
            lambda y, s, c, a, b: jnp.clip(y - jnp.clip(s, -c, c), a, b), point, step, caps, low, high
        )
        return capped, _largest(equations.residual), steps + 1

    start = (jax.lax.stop_gradient(guess), jnp.asarray(jnp.inf), jnp.asarray(0))
    point, _, steps = jax.lax.while_loop(go_on, advance, start)
    _, jacobian = jax.lax.stop_gradient(linearize(held, point))
    equations = evaluate(system, point)
    last = solve_arrow(jacobian, equations.residual)
    root = jax.tree.map(lambda y, s: y - s, point, last)
    residual = jnp.maximum(_largest(equations.residual), equations.inner)
    return PlainRoot(root, jax.lax.stop_gradient(residual), steps)


def _largest(residual: ArrowPoint) -> Array:
    """Largest modulus; NaN, where there is one, ends the search."""
    return jnp.maximum(jnp.max(jnp.abs(residual.elements)), jnp.max(jnp.abs(residual.globals)))
