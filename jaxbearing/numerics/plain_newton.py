"""Newton's method on a block-arrow system from a good guess, cheap enough to run inside a vector field."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from .._types import Values
from .arrow import AbstractArrowSystem, ArrowJacobian, ArrowPoint, Equations, evaluate, linearize, solve_arrow


class PlainRoot(NamedTuple):
    """Result of `plain_newton`.

    - `point`: the root.
    - `residual`: largest scaled residual before the last step, or that of nested solves if it is larger.
    - `steps`: Newton steps before the last one.
    """

    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


class _Iterate(NamedTuple):
    point: ArrowPoint
    equations: Equations
    jacobian: ArrowJacobian
    steps: Int[Array, ""]


def plain_newton(system: AbstractArrowSystem, guess: ArrowPoint, *, tolerance: Values, max_steps: int) -> PlainRoot:
    r"""Takes capped Newton steps until the scaled residual is below `tolerance`, and one more, whose error is about the
    square of that.

    The last step $y - J^{-1}F(y, p)$ carries the derivative: for fixed y and J, its derivative
    $-J^{-1}\partial F/\partial p$ is that of the implicit function. It holds in both modes, for first derivatives only.
    There is no line search and no second try; `newton_solve` has both.

    **Arguments:** `guess`: initial guess, scaled; `max_steps`: limit of the Newton steps before the last one.
    """
    held = jax.lax.stop_gradient(system)
    caps, (low, high) = held.step_caps(), held.bounds()

    def go_on(state: _Iterate):
        # NaN ends the search
        return (_largest(state.equations.residual) > tolerance) & (state.steps < max_steps)

    def advance(state: _Iterate):
        step = solve_arrow(state.jacobian, state.equations.residual)
        capped = jax.tree.map(
            lambda y, s, c, a, b: jnp.clip(y - jnp.clip(s, -c, c), a, b), state.point, step, caps, low, high
        )
        return _Iterate(capped, *linearize(held, capped), state.steps + 1)

    guess = jax.lax.stop_gradient(guess)
    iterate = jax.lax.while_loop(go_on, advance, _Iterate(guess, *linearize(held, guess), jnp.asarray(0)))
    iterate = jax.lax.stop_gradient(iterate)
    last = solve_arrow(iterate.jacobian, _known(system, point=iterate.point, residual=iterate.equations.residual))
    root = jax.tree.map(lambda y, s: y - s, iterate.point, last)
    return PlainRoot(root, jnp.maximum(_largest(iterate.equations.residual), iterate.equations.inner), iterate.steps)


@eqx.filter_custom_jvp
def _known(system: AbstractArrowSystem, *, point: ArrowPoint, residual: ArrowPoint) -> ArrowPoint:
    """The known `residual` at a point, with its derivative with respect to the system."""
    return residual


@_known.def_jvp
def _known_jvp(primals, tangents, *, point, residual):
    (system,), (system_dot,) = primals, tangents
    _, residual_dot = eqx.filter_jvp(lambda s: evaluate(s, point).residual, (system,), (system_dot,))
    return residual, residual_dot


def _largest(residual: ArrowPoint) -> Array:
    """Largest absolute value of all residuals."""
    return jnp.maximum(jnp.max(jnp.abs(residual.elements)), jnp.max(jnp.abs(residual.globals)))
