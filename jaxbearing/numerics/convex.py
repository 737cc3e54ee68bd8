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

from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    evaluate,
    linearize,
    schur_complement,
    solve_arrow,
)
from .small_linear import solve_blocks, solve_dense

TOGETHER = (1024.0, 22)
"""First fraction of the capped step that is tried, and how many, each half of the one before: all at once."""
SPLIT = (4.0, 8)
"""The same for the step with each block capped alone: longer where an element flies freely, but not surely downhill."""
STIFFENED = (16.0, 12)
"""The same for the step with all diagonals stiffened: surely downhill, and no element flies."""
STIFFENING = 1e-3
"""Added to diagonals there, over the largest of them."""
DAMPING, SETTLING = np.array([0.0, 1e-6, 1e-3, 1.0]), 0.25 ** np.arange(14)
"""Added to the diagonals of each element alone, over the largest of them, and the fractions of each such step, after it
was shortened to `FLIGHT` times its cap: an element that nothing touches has a direction, but no length to go."""
FLIGHT = 256.0
TRIED = np.array([256.0, 16.0, 1.0, 0.125, 0.01])
"""Fractions of the capped step of the globals, all elements at their minima."""
HARDENING = np.array([1e-10, 1e-5, 1e-1])
"""Added to the diagonal of the globals' stiffness, relative to itself: rows of unequal scale keep theirs."""
QUICK_STEPS, SETTLED_STEPS = 60, 60
"""Most steps of the descent of all unknowns together, and of the globals with the elements at their minima."""
OUTSIDE = 1e-3
"""Largest residual of the other equations, over the force that pushes a global over its bound."""
FAST = 0.5
"""A whole Newton step that lowers the potential, and the residual to this part, is taken without a search."""


class AbstractConvexArrow(AbstractArrowSystem):
    """A system whose residuals are, row by row and up to positive factors, the gradient of `potential`."""

    @abc.abstractmethod
    def energies(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> Float[Array, " element"]:
        """Energy of each element and its contacts; arguments as those of `element`."""

    @abc.abstractmethod
    def work(self, globals_: Float[Array, " g"]) -> Float[Array, ""]:
        """Work of the loads on the globals."""

    def potential(self, point: ArrowPoint) -> Float[Array, ""]:
        """Convex, in any unit; need not be bounded below where there is no equilibrium."""
        return jnp.sum(self.energies(point.elements, _shared(point))) - self.work(point.globals)


def anchored(value: Array, stiffness: float) -> Array:
    """0, with the derivative of stiffness times `value`: a spring from where it is."""
    return stiffness * (value - jax.lax.stop_gradient(value))


class Descent(NamedTuple):
    """The end of a descent.

    `residual` is the largest scaled one that was still to be brought down where it was last looked at (with settled
    elements: of the globals); `steps` counts Newton steps."""

    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


class _State(NamedTuple):
    point: ArrowPoint
    residual: Array
    steps: Array
    going: Bool[Array, ""]


def descend(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, max_steps: int) -> Descent:
    """Towards the minimum of the potential, until the scaled residual is below `tolerance`, or until no trial along
    Newton's direction lowers the potential (round-off). Not differentiated: the start of an iteration."""
    system, guess = jax.lax.stop_gradient((system, guess))
    ways = (TOGETHER, SPLIT, STIFFENED)
    fractions = jnp.asarray(np.concatenate([first * 0.5 ** np.arange(count) for first, count in ways]))
    way_of = jnp.asarray(np.repeat(np.arange(len(ways)), [count for _, count in ways]))

    def advance(state: _State) -> _State:
        equations, jacobian = linearize(system, state.point)
        together, split = _capped(system, solve_arrow(jacobian, equations.residual))
        residual, whole = _largest(equations.residual), jax.tree.map(jnp.subtract, state.point, together)
        value, at_whole = jax.vmap(system.potential)(_stacked(state.point, whole))
        gain = _largest(evaluate(system, whole).residual) <= FAST * residual
        fast = gain & (at_whole < value)

        def search(_):
            stiff, _ = _capped(system, solve_arrow(_stiffened(jacobian), equations.residual))
            steps = _stacked(together, split, stiff)
            move = lambda t, way: jax.tree.map(lambda y, s: y - t * s[way], state.point, steps)
            values = jax.vmap(lambda t, way: system.potential(move(t, way)))(fractions, way_of)
            values = jnp.where(jnp.isfinite(values), values, jnp.inf)
            best = jnp.argmin(values)
            return move(fractions[best], way_of[best]), values[best] < value

        trial, lower = jax.lax.cond(fast, lambda _: (whole, jnp.asarray(True)), search, None)
        go = lower & (residual > tolerance)
        point = ArrowPoint(*(jnp.where(go, new, old) for new, old in zip(trial, state.point, strict=True)))
        return _State(point, residual, state.steps + go.astype(int), go)

    start = _State(guess, jnp.asarray(jnp.inf), jnp.asarray(0), jnp.asarray(True))
    end = jax.lax.while_loop(lambda s: s.going & (s.steps < max_steps), advance, start)
    # that of a descent which was cut short is the one before its last step
    return Descent(end.point, end.residual, end.steps)


class _Settling(NamedTuple):
    elements: Array
    going: Bool[Array, " element"]
    steps: Array


def settle(
    system: AbstractConvexArrow, point: ArrowPoint, *, tolerance: float = 1e-8, max_steps: int = 40
) -> ArrowPoint:
    """Every element at the minimum of its own energy, the globals where they are: the best of several dampings and
    lengths of Newton's step, each element its own."""
    shared = _shared(point)
    m = point.elements.shape[0]
    fractions = jnp.asarray(SETTLING)[None, :, None, None]
    seeds = jnp.broadcast_to(jnp.eye(m)[:, :, None], (m, *point.elements.shape))

    def advance(state: _Settling) -> _Settling:
        residual, push = jax.linearize(lambda u: system.element(u, shared)[0], state.elements)
        local = jnp.swapaxes(jax.vmap(push)(seeds), 0, 1)
        scale = jnp.max(jnp.abs(jnp.einsum("mmn->mn", local)), axis=0)
        identity = scale[None, None, :] * jnp.eye(m)[:, :, None]
        along = lambda damping: solve_blocks(local + damping * identity, residual[:, None, :])
        ways = jax.vmap(along)(jnp.asarray(DAMPING))[:, :, 0]
        longest = FLIGHT * system.step_caps().elements[None]
        ways = ways / jnp.maximum(jnp.max(jnp.abs(ways) / longest, axis=1, keepdims=True), 1.0)
        trials = (state.elements[None, None] - fractions * ways[:, None]).reshape(-1, *state.elements.shape)
        values = jax.vmap(lambda u: system.energies(u, shared))(jnp.append(state.elements[None], trials, 0))
        here, values = values[0], jnp.where(jnp.isfinite(values), values, jnp.inf)[1:]
        best = jnp.argmin(values, axis=0)
        lower = jnp.take_along_axis(values, best[None], axis=0)[0] < here
        going = state.going & lower & (jnp.max(jnp.abs(residual), axis=0) > tolerance)
        moved = jnp.take_along_axis(trials, best[None, None, :], axis=0)[0]
        return _Settling(jnp.where(going, moved, state.elements), going, state.steps + 1)

    start = _Settling(point.elements, jnp.ones(point.elements.shape[1], dtype=bool), jnp.asarray(0))
    end = jax.lax.while_loop(lambda s: jnp.any(s.going) & (s.steps < max_steps), advance, start)
    return ArrowPoint(end.elements, point.globals)


def descend_settled(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, max_steps: int) -> Descent:
    """As `descend`, but of the globals alone, all elements at their minima at every trial: dearer a step, and not held
    up by elements that hardly touch. Globals stay within `bounds`: where one ends at its bound and its equation pushes
    outwards, the minimum is outside, as the potential is convex."""
    system, guess = jax.lax.stop_gradient((system, guess))
    low, high = (bound.globals for bound in system.bounds())
    fractions = jnp.asarray(TRIED)

    def advance(state: _State) -> _State:
        equations, jacobian = linearize(system, state.point)
        ring = state.point.globals
        held = pushed_out(system, state.point, equations.residual)
        free = (~held).astype(float)
        schur = schur_complement(jacobian) * free[:, None] * free[None, :] + jnp.diag(held.astype(float))
        right = equations.residual.globals * free
        # in equilibrium the elements' residuals count no more
        size = jnp.max(jnp.abs(right))
        diagonal = jnp.diag(jnp.diagonal(schur))
        steps = jax.vmap(lambda damping: solve_dense(schur + damping * diagonal, right))(jnp.asarray(HARDENING))
        over = jnp.max(jnp.abs(steps) / system.step_caps().globals[None, :], axis=1, keepdims=True)
        steps = steps / jnp.maximum(over, 1.0)
        steps = (fractions[None, :, None] * steps[:, None, :]).reshape(-1, ring.shape[0])
        coupled = solve_blocks(jacobian.local, jacobian.right_border)

        def moved(step):
            to = jnp.clip(ring - step, low, high)
            follow = jnp.einsum("mgn,g->mn", coupled, to - ring)
            return settle(system, ArrowPoint(state.point.elements - follow, to))

        trials = jax.vmap(moved)(steps)
        points = jax.tree.map(lambda here, there: jnp.append(here[None], there, 0), state.point, trials)
        values = jax.vmap(system.potential)(points)
        here, values = values[0], jnp.where(jnp.isfinite(values), values, jnp.inf)[1:]
        best = jnp.argmin(values)
        go = (values[best] < here) & (size > tolerance)
        point = ArrowPoint(*(jnp.where(go, new[best], old) for new, old in zip(trials, state.point, strict=True)))
        return _State(point, size, state.steps + go.astype(int), go)

    inside = ArrowPoint(guess.elements, jnp.clip(guess.globals, low, high))
    start = _State(settle(system, inside), jnp.asarray(jnp.inf), jnp.asarray(0), jnp.asarray(max_steps > 0))
    end = jax.lax.while_loop(lambda s: s.going & (s.steps < max_steps), advance, start)
    return Descent(end.point, end.residual, end.steps)


class Minimum(NamedTuple):
    """End of the search for the minimum, its steps, and whether it is proved to lie outside the bounds."""

    point: ArrowPoint
    steps: Int[Array, ""]
    outside: Bool[Array, ""]


def find_minimum(system: AbstractConvexArrow, *, tolerance: float, hopeless: Bool[Array, ""] | bool = False) -> Minimum:
    """A start for Newton's iteration that is the minimum of the potential to `tolerance`, where there is one inside the
    bounds: all unknowns descend together, and, where that takes long, the globals alone with every element settled. A
    system without globals is settled.

    The proof that it is outside: at a bound, everything else in equilibrium, the potential still falls outwards. As a
    convex function it then does so all the way to there. `hopeless`: known to have no minimum, not worth the long way.
    """
    system = jax.lax.stop_gradient(system)
    first = system.initial()
    if not first.globals.size:
        return Minimum(settle(system, first), jnp.asarray(0), jnp.asarray(False))
    quick = descend(system, first, tolerance=tolerance, max_steps=QUICK_STEPS)
    slowly = lambda _: descend_settled(system, quick.point, tolerance=tolerance, max_steps=SETTLED_STEPS)
    low, high = (bound.globals for bound in system.bounds())
    inside = jnp.all((quick.point.globals >= low) & (quick.point.globals <= high))
    done = ((quick.residual <= tolerance) & inside) | hopeless
    found = jax.lax.cond(done, lambda _: quick._replace(steps=jnp.zeros_like(quick.steps)), slowly, None)
    residual = evaluate(system, found.point).residual
    held = pushed_out(system, found.point, residual)
    push = jnp.max(jnp.where(held, jnp.abs(residual.globals), 0.0))
    rest = _largest(residual._replace(globals=jnp.where(held, 0.0, residual.globals)))
    finite = ArrowPoint(*(jnp.where(jnp.isfinite(leaf), leaf, 0.0) for leaf in found.point))
    return Minimum(finite, quick.steps + found.steps, jnp.any(held) & (rest <= OUTSIDE * push))


def pushed_out(system: AbstractConvexArrow, point: ArrowPoint, residual: ArrowPoint) -> Bool[Array, " g"]:
    """Which globals are at a bound that their equations push them over."""
    low, high = (bound.globals for bound in system.bounds())
    ring, push = point.globals, residual.globals
    return ((ring >= high) & (push < 0)) | ((ring <= low) & (push > 0))


def _stacked(*points: ArrowPoint) -> ArrowPoint:
    return jax.tree.map(lambda *leaves: jnp.stack(leaves), *points)


def _shared(point: ArrowPoint) -> Array:
    return jnp.broadcast_to(point.globals[:, None], (point.globals.shape[0], point.elements.shape[1]))


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
