r"""Block-arrow systems whose equations are the gradient of one convex potential: a start that cannot miss the minimum.

Newton's direction on the potential, with a line search on the potential itself. Contacts that open have no stiffness:
the systems add a spring to each block *from where it is* (`anchored`), which stabilises the step and vanishes from the
equations, so that nothing of it is left in a balance.
"""

import abc
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .arrow import AbstractArrowSystem, ArrowJacobian, ArrowPoint, evaluate, linearize, solve_arrow

TOGETHER = (1024.0, 22)
"""First fraction of the capped step that is tried, and how many, each half of the one before: all at once."""
SPLIT = (4.0, 8)
"""The same for the step with each block capped alone: longer where an element flies freely, but not surely downhill."""
STIFFENED = (16.0, 12)
"""The same for the step with all diagonals stiffened: surely downhill, and no element flies."""
STIFFENING = 1e-3
"""Added to diagonals there, over the largest of them."""
LEAPS = 3
"""Whole Newton steps that are taken although the potential does not fall: with many idle rollers rounding may stop the
descent long before the residual is small."""

FAST = 0.5
"""A whole Newton step that lowers the potential, and the residual to this part, is taken without a search."""


class AbstractConvexArrow(AbstractArrowSystem):
    """A system whose residuals are, row by row and up to positive factors, the gradient of `potential`."""

    @abc.abstractmethod
    def potential(self, point: ArrowPoint) -> Float[Array, ""]:
        """Convex, in any unit; need not be bounded below where there is no equilibrium."""


def anchored(value: Array, stiffness: float) -> Array:
    """0, with the derivative of stiffness times `value`: a spring from where it is."""
    return stiffness * (value - jax.lax.stop_gradient(value))


class Descent(NamedTuple):
    """Where the descent ended, its largest scaled residual, and the Newton steps taken."""

    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


class _State(NamedTuple):
    point: ArrowPoint
    residual: Array
    steps: Array
    going: Bool[Array, ""]
    leaps: Array


def descend(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, max_steps: int) -> Descent:
    """Towards the minimum of the potential, until the scaled residual is below `tolerance`, or until no trial along
    Newton's direction lowers the potential (round-off), which a few whole steps that raise it may overcome. Not
    differentiated: the start of an iteration."""
    system, guess = jax.lax.stop_gradient((system, guess))
    ways = (TOGETHER, SPLIT, STIFFENED)
    fractions = jnp.asarray(np.concatenate([first * 0.5 ** np.arange(count) for first, count in ways]))
    way_of = jnp.asarray(np.repeat(np.arange(len(ways)), [count for _, count in ways]))

    def advance(state: _State) -> _State:
        equations, jacobian = linearize(system, state.point)
        together, split = _capped(system, solve_arrow(jacobian, equations.residual))
        residual, value = _largest(equations.residual), system.potential(state.point)
        whole = jax.tree.map(jnp.subtract, state.point, together)
        gain = _largest(evaluate(system, whole).residual) <= FAST * residual
        fast = gain & (system.potential(whole) < value)

        def search(_):
            stiff, _ = _capped(system, solve_arrow(_stiffened(jacobian), equations.residual))
            steps = jax.tree.map(lambda *leaves: jnp.stack(leaves), together, split, stiff)
            move = lambda t, way: jax.tree.map(lambda y, s: y - t * s[way], state.point, steps)
            values = jax.vmap(lambda t, way: system.potential(move(t, way)))(fractions, way_of)
            values = jnp.where(jnp.isfinite(values), values, jnp.inf)
            best = jnp.argmin(values)
            return move(fractions[best], way_of[best]), values[best] < value

        trial, lower = jax.lax.cond(fast, lambda _: (whole, jnp.asarray(True)), search, None)
        leap = ~lower & (state.leaps < LEAPS)
        trial = jax.tree.map(lambda found, new: jnp.where(leap, new, found), trial, whole)
        go = (lower | leap) & (residual > tolerance)
        point = ArrowPoint(*(jnp.where(go, new, old) for new, old in zip(trial, state.point, strict=True)))
        return _State(point, residual, state.steps + go.astype(int), go, state.leaps + leap.astype(int))

    start = _State(guess, jnp.asarray(jnp.inf), jnp.asarray(0), jnp.asarray(True), jnp.asarray(0))
    end = jax.lax.while_loop(lambda s: s.going & (s.steps < max_steps), advance, start)
    return Descent(end.point, _largest(evaluate(system, end.point).residual), end.steps)


def _stiffened(jacobian: ArrowJacobian) -> ArrowJacobian:
    m, g = jacobian.local.shape[0], jacobian.corner.shape[0]
    local = STIFFENING * jnp.max(jnp.abs(jnp.einsum("mmn->mn", jacobian.local)), initial=0.0)
    corner = STIFFENING * jnp.max(jnp.abs(jnp.diagonal(jacobian.corner)))
    return jacobian._replace(
        local=jacobian.local + local * jnp.eye(m)[:, :, None], corner=jacobian.corner + corner * jnp.eye(g)
    )


def _capped(system: AbstractArrowSystem, step: ArrowPoint) -> tuple[ArrowPoint, ArrowPoint]:
    """The step shortened as a whole, direction kept, to the caps; and each block alone."""
    caps = system.step_caps()
    over = lambda s, c: jnp.maximum(jnp.max(jnp.abs(s) / c, axis=0, initial=0.0, keepdims=True), 1.0)
    each, ring = over(step.elements, caps.elements), over(step.globals, caps.globals)
    whole = jnp.maximum(jnp.max(each, initial=1.0), jnp.max(ring))
    together = ArrowPoint(step.elements / whole, step.globals / whole)
    return together, ArrowPoint(step.elements / each, step.globals / ring)


def _largest(residual: ArrowPoint) -> Array:
    elements = jnp.max(jnp.abs(residual.elements), initial=0.0)
    return jnp.maximum(elements, jnp.max(jnp.abs(residual.globals), initial=0.0))
