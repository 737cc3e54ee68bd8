r"""Block-arrow systems whose equations are the gradient of one convex potential: a start that cannot miss the minimum.

Newton's direction on the potential, damped until the potential falls (Levenberg). Contacts that open have no stiffness:
the systems add a spring to each block *from where it is* (`anchored`), which stabilises the step and vanishes from the
equations, so that nothing of it is left in a balance.
"""

import abc
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    assembled,
    element_tangents,
    eliminated,
    evaluate,
    shared_by_elements,
    solve_arrow,
)
from .small_linear import solve_blocks, solve_dense

FLIGHT = 256.0
"""Most caps that an element goes at once while all others wait."""
QUICK_STEPS, SETTLED_STEPS, ELEMENT_STEPS = 60, 60, 300
OUTSIDE = 1e-3
"""Largest residual of the other equations, over the force that pushes a global over its bound."""
FAST = 0.9
ROUNDING = 1e-11
LEAST, HARDER, SOFTER = 1e-5, 8.0, 0.125
SHORTEST = 4e-16


class AbstractConvexArrow(AbstractArrowSystem):
    """A system whose residuals are, row by row and up to positive factors, the gradient of `potential`."""

    @abc.abstractmethod
    def acting(
        self, unknowns: Float[Array, "m element"], shared: Float[Array, "g element"]
    ) -> tuple[Float[Array, "m element"], Float[Array, "k element"], Float[Array, " element"]]:
        """Local residuals and contributions to the totals as those of `element`, and the energy of each element and its
        contacts."""

    @abc.abstractmethod
    def work(self, globals_: Float[Array, " g"]) -> Float[Array, ""]:
        """Work of the loads on the globals."""

    def element(self, unknowns, shared):
        local, contributions, _ = self.acting(unknowns, shared)
        return local, contributions, jnp.zeros(())

    @property
    def flight(self) -> float:
        """Step caps that a step may go at most."""
        return FLIGHT

    def near(self, point: ArrowPoint) -> ArrowPoint:
        """The point with its elements nearer to their minima, where there is a formula for these."""
        return point


def anchored(value: Array, stiffness: float) -> Array:
    """0, with the derivative of stiffness times `value`: a spring from where it is."""
    return stiffness * (value - jax.lax.stop_gradient(value))


class _View(NamedTuple):
    energy: Array
    size: Array
    blocks: Any


class _Walk(NamedTuple):
    trial: Any
    point: Any
    view: _View
    damping: Array
    going: Array
    trials: Array
    steps: Array


def _walk(
    look: Callable[[Any], tuple[Any, _View]],
    step: Callable[[_View, Array], tuple[Any, Array]],
    start: Any,
    *,
    tolerance: float,
    most: int,
) -> _Walk:
    def advance(state: _Walk) -> _Walk:
        point, view = look(state.trial)
        old = state.view
        lower = view.energy < old.energy
        near = (view.size <= FAST * old.size) & (view.energy <= old.energy + ROUNDING * jnp.abs(old.energy))
        accept = (lower | near) & state.going
        pick = lambda new, last: jax.lax.select(jnp.broadcast_to(accept, new.shape), new, last)
        point, view = jax.tree.map(pick, (point, view), (state.point, old))
        damping = pick(_softer(state.damping), _harder(state.damping))
        move, length = step(view, damping)
        going = state.going & (view.size > tolerance) & (length > SHORTEST)
        trial = jax.tree.map(lambda at, by: at - by / jnp.maximum(length, 1.0), point, move)
        return _Walk(trial, point, view, damping, going, state.trials + 1, state.steps + jnp.any(accept))

    blank = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), jax.eval_shape(look, start)[1])
    nowhere = blank.energy + jnp.inf
    view = blank._replace(energy=nowhere, size=nowhere)
    begin = _Walk(start, start, view, blank.energy, nowhere > 0.0, jnp.asarray(0), jnp.asarray(-1))
    return jax.lax.while_loop(lambda s: jnp.any(s.going) & (s.trials < most), advance, begin)


class Descent(NamedTuple):
    point: ArrowPoint
    residual: Float[Array, ""]
    steps: Int[Array, ""]


class Minimum(NamedTuple):
    """End of the search for the minimum, its steps, and whether it is proved to lie outside the bounds."""

    point: ArrowPoint
    steps: Int[Array, ""]
    outside: Bool[Array, ""]


def descend(system: AbstractConvexArrow, guess: ArrowPoint, *, tolerance: float, max_steps: int) -> Descent:
    """All unknowns together."""
    caps = system.step_caps()

    def look(point: ArrowPoint) -> tuple[ArrowPoint, _View]:
        values, tangents, energies = element_tangents(system.acting, point.elements, shared_by_elements(point))
        equations, jacobian = assembled(system, point, values, tangents, jnp.zeros(()))
        energy = jnp.sum(energies) - system.work(point.globals)
        return point, _View(energy, _largest(equations.residual), (equations.residual, jacobian))

    def step(view: _View, damping: Array) -> tuple[ArrowPoint, Array]:
        residual, jacobian = view.blocks
        move = solve_arrow(_stiffened(jacobian, damping), residual)
        return move, jnp.maximum(*(jnp.max(jnp.abs(s) / (system.flight * c), initial=0.0) for s, c in zip(move, caps, strict=True)))

    end = _walk(look, step, guess, tolerance=tolerance, most=max_steps)
    return Descent(end.point, end.view.size, end.steps)


def settle(system: AbstractConvexArrow, point: ArrowPoint, *, tolerance: float = 1e-8, max_steps: int | None = None) -> ArrowPoint:
    return ArrowPoint(_settled(system, point, tolerance, max_steps).point, point.globals)


def _settled(
    system: AbstractConvexArrow, point: ArrowPoint, tolerance: float = 1e-8, max_steps: int | None = None
) -> _Walk:
    """Every element at the minimum of its own energy, the globals where they are."""
    shared = shared_by_elements(point)
    m = point.elements.shape[0]
    longest = system.flight * system.step_caps().elements

    def look(elements: Array) -> tuple[Array, _View]:
        values, tangents, energies = element_tangents(system.acting, elements, shared)
        blocks = jnp.concatenate([values[:, None], tangents], axis=1)
        return elements, _View(energies, jnp.max(jnp.abs(values[:m]), axis=0), blocks)

    def step(view: _View, damping: Array) -> tuple[Array, Array]:
        residual, local = view.blocks[:m, :1], view.blocks[:m, 1 : 1 + m]
        scale = jnp.max(jnp.abs(jnp.einsum("mmn->mn", local)), axis=0)
        damped = local + (damping * scale) * jnp.eye(m)[:, :, None]
        way = solve_blocks(damped, residual)[:, 0]
        return way, jnp.max(jnp.abs(way) / longest, axis=0)

    return _walk(look, step, point.elements, tolerance=tolerance, most=max_steps or ELEMENT_STEPS)


def descend_settled(
    system: AbstractConvexArrow,
    guess: ArrowPoint,
    *,
    tolerance: float,
    max_steps: int,
    element_tolerance: float = 1e-8,
    element_steps: int | None = None,
) -> Descent:
    """The globals alone, all elements at their minima at every trial."""
    longest = system.flight * system.step_caps().globals
    low, high = (bound.globals for bound in system.bounds())

    def look(point: ArrowPoint) -> tuple[ArrowPoint, _View]:
        inside = ArrowPoint(point.elements, jnp.clip(point.globals, low, high))
        settled = _settled(system, system.near(inside), element_tolerance, element_steps)
        point = ArrowPoint(settled.point, inside.globals)
        equations, jacobian = assembled(system, point, settled.view.blocks[:, 0], settled.view.blocks[:, 1:], jnp.zeros(()))
        residual = equations.residual.globals
        free = (~pushed_out(system, point, equations.residual)).astype(float)
        coupled, schur = eliminated(jacobian)
        matrix = schur * free[:, None] * free[None, :] + jnp.diag(1.0 - free)
        right = residual * free
        # in equilibrium the elements' residuals count no more
        energy = jnp.sum(settled.view.energy) - system.work(point.globals)
        return point, _View(energy, jnp.max(jnp.abs(right)), (right, matrix, coupled))

    def step(view: _View, damping: Array) -> tuple[ArrowPoint, Array]:
        right, matrix, coupled = view.blocks
        way = solve_dense(matrix * (1.0 + damping * jnp.eye(right.size)), right)
        return ArrowPoint(-jnp.einsum("mgn,g->mn", coupled, way), way), jnp.max(jnp.abs(way) / longest)

    end = _walk(look, step, guess, tolerance=tolerance, most=max_steps)
    return Descent(end.point, end.view.size, end.steps)


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


def _stiffened(jacobian: ArrowJacobian, damping: Array) -> ArrowJacobian:
    m, g = jacobian.local.shape[0], jacobian.corner.shape[0]
    local = damping * jnp.max(jnp.abs(jnp.einsum("mmn->mn", jacobian.local)), initial=0.0)
    corner = damping * jnp.max(jnp.abs(jnp.diagonal(jacobian.corner)))
    return jacobian._replace(
        local=jacobian.local + local * jnp.eye(m)[:, :, None], corner=jacobian.corner + corner * jnp.eye(g)
    )


def _largest(residual: ArrowPoint) -> Array:
    elements = jnp.max(jnp.abs(residual.elements), initial=0.0)
    return jnp.maximum(elements, jnp.max(jnp.abs(residual.globals), initial=0.0))


def _softer(damping):
    return SOFTER * damping


def _harder(damping):
    return jnp.maximum(HARDER * damping, LEAST)
