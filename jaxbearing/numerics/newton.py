"""Damped Newton iteration for block-arrow systems: every element has a few unknowns of its own, and elements are
coupled only through a few global unknowns (module `arrow`). Each member of a batch, a lane, has a status of its own;
derivatives follow from the implicit function theorem.

A *trial* is a point at which the equations are evaluated. The *given system* is the one that the caller wants solved.
The module `newton_steps` computes a step, judges a trial and chooses the next one; the module `continuation` chooses
easier systems that lead to the given one if the first try fails.
"""

from collections.abc import Callable
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .._types import Tree
from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    Equations,
    System,
    empty_jacobian,
    evaluate,
    linearize,
    solve_arrow,
)
from .batching import in_turn
from .continuation import MOST_STEPS, Continuation, StageEnd, advance, first_guesses
from .gates import derivatives_if
from .known_roots import at_known_root
from .newton_steps import NewtonOptions as NewtonOptions
from .newton_steps import Search, choose, judge, moved_on, propose
from .status import Status

_GOING = -1
"""Value of the status while the iteration runs."""


class NewtonResult(NamedTuple):
    """Result of the iteration. If the lane failed, `point` is finite and not a solution; it may be a trial of an easier
    system, to which the other values do not belong.

    `jacobian`, `residual_norm` (the largest scaled residual), `inner_residual`, `worst_equation` and `worst_element`
    are values at the last trial of the given system, not at a trial of an easier one. If the lane converged, `point`
    lies one Newton step (shorter than the step tolerance) beyond that trial. `inner_residual` is the largest residual
    of the nested solves, which the system needs to evaluate its equations. `worst_equation` is an index: the equations
    of one element come first, the global ones after them. `worst_element` has a meaning only if the worst equation
    belongs to an element.
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
    """State of the loop. `iterations` counts all steps, also those of easier systems."""

    search: Search
    continuation: Continuation | None
    iterations: Int[Array, ""]
    status: Int[Array, ""]
    equations: Equations
    jacobian: ArrowJacobian
    """`equations` and `jacobian` belong to the last trial of the given system, not of an easier one."""


def _iterate(system: AbstractArrowSystem, options: NewtonOptions) -> _Iterate:
    homotopies = system.homotopies if options.continuation else 0
    if homotopies:
        start, easiest = first_guesses(system)
    else:
        start = easiest = system.initial()

    def newton_step(state: _Iterate) -> _Iterate:
        search, continuation = state.search, state.continuation
        proposal = propose(system if continuation is None else continuation.system_of_stage(system), search.trial)
        first_try = None if continuation is None else continuation.tries <= 1
        verdict = judge(proposal, search, options, system.rounding, first_try)
        following = moved_on(system, search, proposal, verdict)
        iterations = state.iterations + 1
        steps = iterations if continuation is None else continuation.steps + 1
        limit = options.max_steps if continuation is None else continuation.step_limit(options.max_steps)
        # the trial is a root, but a nested solve failed there: further steps do not change that
        hopeless = verdict.settled & ~verdict.converged
        failed = (verdict.stuck | (steps >= limit) | hopeless) & ~verdict.converged
        won, lost = verdict.converged, failed
        equations, jacobian = proposal.equations, proposal.jacobian
        if continuation is not None:
            at_system = continuation.at_system
            spent = iterations >= (1 + MOST_STEPS * homotopies) * options.max_steps
            stage_end = StageEnd(verdict.converged, failed, hopeless & at_system, spent)
            continuation, restart, guess, lost = advance(
                continuation, steps, stage_end, search.trial, easiest, 1 + homotopies
            )
            won = verdict.converged & at_system
            following = following.begun_anew(restart, guess)
            # report values of the given system, not of an easier one
            newest, last = (equations, jacobian), (state.equations, state.jacobian)
            equations, jacobian = jax.tree.map(lambda new, old: jnp.where(at_system, new, old), newest, last)
        failure = jnp.where(verdict.stuck, int(Status.DIVERGED), int(Status.NOT_CONVERGED))
        status = jnp.where(won, int(Status.CONVERGED), jnp.where(lost, failure, _GOING))
        # a finished lane keeps the point whose residual was judged
        following = following._replace(trial=choose(status == _GOING, following.trial, search.trial))
        return _Iterate(following, continuation, iterations, status, equations, jacobian)

    first = _Iterate(
        search=Search.at(start),
        continuation=Continuation.begun(start) if homotopies else None,
        iterations=jnp.asarray(0),
        status=jnp.asarray(_GOING),
        equations=Equations(jax.tree.map(jnp.zeros_like, start), jnp.zeros(())),
        jacobian=empty_jacobian(system, start),
    )
    return jax.lax.while_loop(lambda state: state.status == _GOING, newton_step, first)


class _End(NamedTuple):
    """The part of the last iterate that is needed later; only this part is stacked over the lanes of a batch."""

    trial: ArrowPoint
    equations: Equations
    jacobian: ArrowJacobian
    status: Int[Array, ""]
    iterations: Int[Array, ""]


def _ended(system: AbstractArrowSystem, options: NewtonOptions) -> _End:
    """Runs the iteration to its end. The lanes of a batch run one after the other, unless the system asks for all at
    once (`lanes_together`)."""

    def solve_lane(system: AbstractArrowSystem) -> _End:
        last = _iterate(system, options)
        return _End(last.search.trial, last.equations, last.jacobian, last.status, last.iterations)

    return solve_lane(system) if system.lanes_together else in_turn(solve_lane, system)


class _Root(NamedTuple):
    point: ArrowPoint
    jacobian: ArrowJacobian
    solved: Bool[Array, ""]
    end: _End


@eqx.filter_custom_jvp
def _root(system: AbstractArrowSystem, *, options: NewtonOptions) -> _Root:
    """The root, and the Jacobian at the last trial of the given system, one Newton step before the root. If the lane
    failed, the point is its last trial, perhaps of an easier system, with 0 in place of numbers that are not finite."""
    end = _ended(system, options)
    solved = end.status == Status.CONVERGED
    # One more Newton step is taken from the trial that converged: it squares the remaining error.
    step = solve_arrow(end.jacobian, end.equations.residual)
    elements = jnp.where(solved, end.trial.elements - step.elements, _finite(end.trial.elements))
    globals_ = jnp.where(solved, end.trial.globals - step.globals, _finite(end.trial.globals))
    return _Root(ArrowPoint(elements, globals_), end.jacobian, solved, end)


@_root.def_jvp
def _root_jvp(primals, tangents, *, options: NewtonOptions):
    (system,), (system_dot,) = primals, tangents
    return _implicit(system, system_dot, _root(system, options=options))


@eqx.filter_custom_jvp
def _known_root(system: AbstractArrowSystem, *, root: _Root, stiffness: bool) -> _Root:
    """A root that was found before, with the same implicit derivatives as `_root`.

    **Arguments:** `root`: the known root; `stiffness`: True to differentiate the Jacobian too, which derivatives of the
    bearing's stiffness require; otherwise the derivative of the Jacobian is NaN.
    """
    return root


@_known_root.def_jvp
def _known_root_jvp(primals, tangents, *, root: _Root, stiffness: bool):
    (system,), (system_dot,) = primals, tangents
    # second derivatives of the point need the first derivatives of the Jacobian
    return _implicit(system, system_dot, _known_root(system, root=root, stiffness=True), stiffness)


def _implicit(system: System, system_dot: System, root: _Root, stiffness: bool = True) -> tuple[_Root, _Root]:
    """A root and its directional derivative, by the implicit function theorem. Without `stiffness` the derivative of
    the Jacobian is NaN."""
    # Both the incoming and the outgoing tangent of a failed lane are set to 0. Otherwise NaN times 0 would reach
    # parameters that lanes share, in forward and in reverse mode.
    select = lambda t: jnp.where(root.solved, t, 0.0)
    system_dot = jax.tree.map(select, system_dot)
    residual_dot = _directional(lambda s: evaluate(s, root.point).residual, (system,), (system_dot,))
    step = solve_arrow(root.jacobian, residual_dot)
    point_dot = jax.tree.map(lambda t: select(-t), step)
    if stiffness:
        jacobian_dot = _directional(lambda s, p: linearize(s, p)[1], (system, root.point), (system_dot, point_dot))
    else:
        jacobian_dot = jax.tree.map(lambda block: jnp.full_like(block, jnp.nan), root.jacobian)
    rest = jax.tree.map(lambda _: None, (root.solved, root.end))
    return root, _Root(point_dot, jax.tree.map(select, jacobian_dot), *rest)


def _directional(function: Callable[..., Tree], primals: tuple, tangents: tuple) -> Tree:
    """Directional derivative of a function of pytrees. Outputs that do not depend on inputs with a tangent get
    zeros, not `None`."""
    values, dots = eqx.filter_jvp(function, primals, tangents)
    return jax.tree.map(
        lambda dot, value: jnp.zeros_like(value) if dot is None else dot, dots, values, is_leaf=lambda x: x is None
    )


def _finite(x: Array) -> Array:
    return jnp.where(jnp.isfinite(x), x, 0.0)


def newton_solve(system: System, options: NewtonOptions | None = None) -> tuple[System, NewtonResult]:
    """Solve a block-arrow system from its own first guess.

    Returns a copy of the system and the result of the iteration. Results must be evaluated with the returned copy: it
    has the same values, but passes no derivatives if the solve failed. The derivative of the solution is
    that of the implicit function, in both modes and to any order. It is computed with the Jacobian of the last trial,
    so that its error is of the order of the last step. The Jacobian that is returned has a derivative too. The
    iteration itself is never differentiated, and a solve that is not differentiated does not pay for derivatives. Where
    another program has found the root before (module `known_roots`), it is not searched again. The solution then has
    the same derivatives; those of the Jacobian are NaN unless the caller asked for derivatives of the stiffness.

    If the system states that each equation grows with its own unknown at the root (`increasing`), Newton's step is
    changed wherever a pivot of the Jacobian is negative (`arrow.uphill_step`). If the iteration fails and the system
    has homotopies, the module `continuation` solves a sequence of systems (stages) from an easier one to the given one.
    A stage that fails is replaced by shorter ones. `iterations` counts all steps.

    A lane that fails never raises and never spoils a neighbour under `vmap`: its point is finite and not a solution,
    and the returned system passes no derivative for it, so that NaN times zero cannot reach a parameter that lanes
    share. The caller must mask results that it computes from the point by `converged`.

    **Arguments:** `system`: equations and parameters; `options`: tolerances and limits. `max_steps` limits one try; a
    solve that goes over easier systems may take more.
    """
    chosen = NewtonOptions() if options is None else options
    root = at_known_root(
        lambda: _root(system, options=chosen),
        lambda known, stiffness: _known_root(system, root=known, stiffness=stiffness),
    )
    live = derivatives_if(root.solved, system)
    # The reported residuals are those of the last trial, one Newton step before the returned point.
    end = root.end
    elements, globals_ = jnp.abs(end.equations.residual.elements), jnp.abs(end.equations.residual.globals)
    sizes = jnp.concatenate([jnp.max(elements, axis=1, initial=0.0), globals_])
    # a system without unknowns has no residuals: its residual norm is 0
    sizes = sizes if sizes.size else jnp.zeros(1)
    worst = jnp.argmax(jnp.where(jnp.isnan(sizes), jnp.inf, sizes))
    m = elements.shape[0]
    worst_element = jnp.argmax(elements[jnp.minimum(worst, m - 1)]) if m else jnp.asarray(0)
    return live, NewtonResult(
        root.point, root.jacobian, end.status, end.iterations, jnp.max(sizes), end.equations.inner, worst, worst_element
    )
