"""Damped Newton on a block-arrow system: status per lane, implicit derivatives, no lane harms another."""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    Equations,
    empty_jacobian,
    evaluate,
    linearize,
    solve_arrow,
)
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

    `jacobian` holds the blocks, residual norm, worst equation and worst element are measured at the last iterate; of a
    lane that converged, `point` is one Newton step (below the step tolerance) further.
    """

    point: ArrowPoint
    jacobian: ArrowJacobian
    status: Int[Array, ""]
    iterations: Int[Array, ""]
    residual_norm: Float[Array, ""]
    inner_residual: Float[Array, ""]
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
    zeros = jax.tree.map(jnp.zeros_like, start)
    first = _Iterate(
        trial=start,
        base=start,
        step=zeros,
        base_norm=jnp.asarray(jnp.inf),
        attempt=jnp.asarray(0),
        iterations=jnp.asarray(0),
        status=jnp.asarray(-1),
        equations=Equations(zeros, jnp.zeros(())),
        jacobian=empty_jacobian(system, start),
    )
    return jax.lax.while_loop(keep_going, advance, first)


class _Root(NamedTuple):
    point: ArrowPoint
    jacobian: ArrowJacobian
    solved: Bool[Array, ""]
    end: _Iterate


@eqx.filter_custom_jvp
def _root(system: AbstractArrowSystem, *, options: NewtonOptions) -> _Root:
    """The root with the Jacobian there; of a lane that failed, a finite point and where the iteration gave up."""
    end = _iterate(system, options)
    solved = end.status == Status.CONVERGED
    # The last Newton step is taken, not only measured: it squares the remaining error.
    step = solve_arrow(end.jacobian, end.equations.residual)
    elements = jnp.where(solved, end.trial.elements - step.elements, _finite(end.trial.elements))
    globals_ = jnp.where(solved, end.trial.globals - step.globals, _finite(end.trial.globals))
    return _Root(ArrowPoint(elements, globals_), end.jacobian, solved, end)


@_root.def_jvp
def _root_jvp(primals, tangents, *, options: NewtonOptions):
    (system,), (system_dot,) = primals, tangents
    root = _root(system, options=options)
    # Selecting on the tangent that comes in, not only on what goes out, keeps NaN times zero of a failed lane from
    # parameters that lanes share, in both modes.
    select = lambda t: jnp.where(root.solved, t, 0.0)
    system_dot = jax.tree.map(select, system_dot)
    residual_dot = _directional(lambda s: evaluate(s, root.point).residual, (system,), (system_dot,))
    step = solve_arrow(root.jacobian, residual_dot)
    point_dot = jax.tree.map(lambda t: select(-t), step)
    jacobian_dot = _directional(lambda s, p: linearize(s, p)[1], (system, root.point), (system_dot, point_dot))
    rest = jax.tree.map(lambda _: None, (root.solved, root.end))
    return root, _Root(point_dot, jax.tree.map(select, jacobian_dot), *rest)


def _directional(function: Callable, primals: tuple, tangents: tuple) -> Any:
    """Directional derivative of a function of pytrees, zeros (not None) where nothing depends on the direction."""
    values, dots = eqx.filter_jvp(function, primals, tangents)
    return jax.tree.map(
        lambda dot, value: jnp.zeros_like(value) if dot is None else dot, dots, values, is_leaf=lambda x: x is None
    )


def _finite(x: Array) -> Array:
    return jnp.where(jnp.isfinite(x), x, 0.0)


def newton_solve(system: System, options: NewtonOptions | None = None) -> tuple[System, NewtonResult]:
    """Solve a block-arrow system from its own first guess.

    Returns the system to evaluate results with, and the result. The derivative of the solution (and of the Jacobian
    at the solution) is that of the implicit function, in both modes and to any order: nothing is differentiated
    through the iteration, and a solve that is not differentiated does not pay for derivatives.

    A lane that fails never raises and never spoils a neighbour under `vmap`: its point is finite and not a solution,
    and the returned system passes no derivative for it, so that NaN times zero cannot reach a parameter that lanes
    share. Whoever computes results from the point masks them by `converged`.

    **Arguments:** `system`: equations and parameters; `options`: tolerances and limits.
    """
    root = _root(system, options=NewtonOptions() if options is None else options)
    live = jax.tree.map(lambda x: jnp.where(root.solved, x, jax.lax.stop_gradient(x)), system)
    # What is reported was measured one Newton step before the returned point.
    end = root.end
    elements, globals_ = jnp.abs(end.equations.residual.elements), jnp.abs(end.equations.residual.globals)
    sizes = jnp.concatenate([jnp.max(elements, axis=1, initial=0.0), globals_])
    worst = jnp.argmax(jnp.where(jnp.isnan(sizes), jnp.inf, sizes))
    m = elements.shape[0]
    worst_element = jnp.argmax(elements[jnp.minimum(worst, m - 1)]) if m else jnp.asarray(0)
    return live, NewtonResult(
        root.point, root.jacobian, end.status, end.iterations, jnp.max(sizes), end.equations.inner, worst, worst_element
    )
