"""Damped Newton on a block-arrow system: status per lane, implicit derivatives, no lane harms another."""

from typing import NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import AbstractArrowSystem, ArrowJacobian, ArrowPoint, Equations, evaluate, linearize, solve_arrow
from .status import Status

System = TypeVar("System", bound=AbstractArrowSystem)

BACKTRACK = (1.0, 0.3, 0.05)
"""Fractions of the Newton step that are tried, in this order."""


class NewtonOptions(eqx.Module):
    """Tolerances and limits of the Newton iteration; plain numbers, none of them differentiated.

    **Arguments:**
    - `residual_tolerance`: largest scaled residual of a converged solve.
    - `step_tolerance`: largest scaled Newton step of a converged solve. Convergence asks for both: a small
      residual alone says nothing where the Jacobian is nearly singular.
    - `inner_tolerance`: largest scaled residual of solves nested in the equations.
    - `max_steps`: Newton steps, rejected trials counted.
    """

    residual_tolerance: float = eqx.field(static=True, default=1e-10)
    step_tolerance: float = eqx.field(static=True, default=1e-7)
    inner_tolerance: float = eqx.field(static=True, default=1e-8)
    max_steps: int = eqx.field(static=True, default=60)


class NewtonResult(NamedTuple):
    """Where the iteration ended. On a lane that failed, `point` is a finite point and not a solution.

    `jacobian` holds the blocks at `point`; residual, worst equation and worst element are those at `point` of a lane
    that converged and those of the last trial of a lane that failed.
    """

    point: ArrowPoint
    jacobian: ArrowJacobian
    status: Int[Array, ""]
    iterations: Int[Array, ""]
    residual_norm: Float[Array, ""]
    worst_equation: Int[Array, ""]
    worst_element: Int[Array, ""]

    @property
    def converged(self) -> Bool[Array, ""]:
        return self.status == Status.CONVERGED


class _Iterate(NamedTuple):
    trial: ArrowPoint
    base: ArrowPoint
    step: ArrowPoint
    base_norm: Float[Array, ""]
    attempt: Int[Array, ""]
    iterations: Int[Array, ""]
    status: Int[Array, ""]
    equations: Equations
    jacobian: ArrowJacobian
    """Equations and Jacobian at `trial` of the previous pass: of a finished lane, at its final `trial`."""


def _norm(point: ArrowPoint) -> Float[Array, ""]:
    return jnp.sqrt(jnp.sum(jnp.square(point.elements)) + jnp.sum(jnp.square(point.globals)))


def _largest(point: ArrowPoint) -> Float[Array, ""]:
    elements = jnp.max(jnp.abs(point.elements), initial=0.0)
    return jnp.maximum(elements, jnp.max(jnp.abs(point.globals), initial=0.0))


def _move(system: AbstractArrowSystem, base: ArrowPoint, step: ArrowPoint, fraction: Float[Array, ""]) -> ArrowPoint:
    low, high = system.bounds()
    return ArrowPoint(
        jnp.clip(base.elements - fraction * step.elements, low.elements, high.elements),
        jnp.clip(base.globals - fraction * step.globals, low.globals, high.globals),
    )


def _capped(system: AbstractArrowSystem, step: ArrowPoint) -> ArrowPoint:
    """The step shortened, direction kept, until no unknown moves further than its cap."""
    caps = system.step_caps()
    over = jnp.maximum(
        jnp.max(jnp.abs(step.elements) / caps.elements, initial=0.0),
        jnp.max(jnp.abs(step.globals) / caps.globals, initial=0.0),
    )
    scale = 1.0 / jnp.maximum(over, 1.0)
    return ArrowPoint(step.elements * scale, step.globals * scale)


def _iterate(system: AbstractArrowSystem, options: NewtonOptions) -> _Iterate:
    fractions = jnp.asarray(BACKTRACK)
    last_attempt = len(BACKTRACK) - 1

    def keep_going(state: _Iterate):
        return state.status < 0

    def advance(state: _Iterate) -> _Iterate:
        equations, jacobian = linearize(system, state.trial)
        step = solve_arrow(jacobian, equations.residual)
        norm = _norm(equations.residual)
        usable = jnp.isfinite(norm) & jnp.isfinite(_largest(step))
        converged = (
            usable
            & (_largest(equations.residual) <= options.residual_tolerance)
            & (_largest(step) <= options.step_tolerance)
            & (equations.inner <= options.inner_tolerance)
        )

        enough = norm <= (1.0 - 0.1 * fractions[state.attempt]) * state.base_norm
        accept = usable & (enough | (state.attempt == last_attempt))
        stuck = ~usable & (state.attempt == last_attempt)

        capped = _capped(system, step)
        choose = lambda a, b: ArrowPoint(*(jnp.where(accept, x, y) for x, y in zip(a, b, strict=True)))
        attempt = jnp.where(accept, 0, jnp.minimum(state.attempt + 1, last_attempt))
        base, next_step = choose(state.trial, state.base), choose(capped, state.step)
        iterations = state.iterations + 1
        status = jnp.where(
            converged,
            int(Status.CONVERGED),
            jnp.where(
                stuck,
                int(Status.DIVERGED),
                jnp.where(iterations >= options.max_steps, int(Status.NOT_CONVERGED), -1),
            ),
        )
        trial = _move(system, base, next_step, fractions[attempt])
        keep = lambda new, old: ArrowPoint(*(jnp.where(status == -1, x, y) for x, y in zip(new, old, strict=True)))
        return _Iterate(
            # a finished lane keeps the point whose residual was judged
            trial=keep(trial, state.trial),
            base=base,
            step=next_step,
            base_norm=jnp.where(accept, norm, state.base_norm),
            attempt=attempt,
            iterations=iterations,
            status=status,
            equations=equations,
            jacobian=jacobian,
        )

    start = system.initial()
    zeros = lambda tree: jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), tree)
    equations, jacobian = zeros(jax.eval_shape(linearize, system, start))
    first = _Iterate(
        trial=start,
        base=start,
        step=zeros(start),
        base_norm=jnp.asarray(jnp.inf),
        attempt=jnp.asarray(0),
        iterations=jnp.asarray(0),
        status=jnp.asarray(-1),
        equations=equations,
        jacobian=jacobian,
    )
    return jax.lax.while_loop(keep_going, advance, first)


def _freeze(tree):
    return jax.tree.map(jax.lax.stop_gradient, tree)


def newton_solve(system: System, options: NewtonOptions | None = None) -> tuple[System, NewtonResult]:
    """Solve a block-arrow system from its own first guess.

    Returns the system to evaluate results with, and the result. The derivative of the solution, in both
    modes, is that of the implicit function: the iteration runs on `stop_gradient` values and one
    differentiable Newton step follows, which also squares the remaining error. First derivatives only.

    A lane that fails never raises and never spoils a neighbour under `vmap`: its point is the (finite) first
    guess, and the returned system passes no derivative for it, so that NaN times zero cannot reach a
    parameter that lanes share. Whoever computes results from the point masks them by `converged`.

    **Arguments:** `system`: equations and parameters; `options`: tolerances and limits.
    """
    options = NewtonOptions() if options is None else options
    frozen = _freeze(system)
    end = _iterate(frozen, options)
    solved = end.status == Status.CONVERGED

    guess = jax.tree.map(lambda x: jnp.where(jnp.isfinite(x), x, 0.0), frozen.initial())
    pick = lambda a, b: jax.tree.map(lambda x, y: jnp.where(solved, x, y), a, b)
    point = pick(end.trial, guess)
    live = pick(system, _freeze(system))
    step = solve_arrow(end.jacobian, evaluate(live, point).residual)
    moved = pick(ArrowPoint(point.elements - step.elements, point.globals - step.globals), point)

    # Judged where the user will look: at the point that is returned (a failed lane: where it gave up).
    equations, jacobian = linearize(live, moved)
    judged = pick(_freeze(equations), end.equations)
    elements, globals_ = jnp.abs(judged.residual.elements), jnp.abs(judged.residual.globals)
    sizes = jnp.concatenate([jnp.max(elements, axis=1, initial=0.0), globals_])
    worst = jnp.argmax(jnp.where(jnp.isnan(sizes), jnp.inf, sizes))
    m = elements.shape[0]
    worst_element = jnp.argmax(elements[jnp.minimum(worst, m - 1)]) if m else jnp.asarray(0)
    norm = jnp.max(sizes)
    good = (norm <= options.residual_tolerance) & (judged.inner <= options.inner_tolerance)
    status = jnp.where(solved & ~good, int(Status.NOT_CONVERGED), end.status)
    return live, NewtonResult(moved, jacobian, status, end.iterations, norm, worst, worst_element)
