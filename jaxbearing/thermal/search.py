r"""The search for the steady temperatures of a network: Broyden's iteration, then Newton's, then steps in time.

A loss function may contain the solve of a whole bearing, which takes long to compile and to run. The search is
therefore two loops around one evaluation each. The first loop is Broyden's iteration from $B_0 = -K$, the part of the
Jacobian that is known without a derivative of the losses. The second loop runs only if the first has failed, or if the
Jacobian at the root is wanted. It takes Newton's steps with the exact Jacobian. If they fail too, it takes implicit
Euler steps in time from the start (pseudo-transient run), which end where a real start ends.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ..numerics import lapack
from ..numerics.status import Status
from .network import Slopes
from .point import (
    GOING,
    RISE,
    SHORT_STEP,
    Line,
    Point,
    Problem,
    ThermalOptions,
    evaluate,
    linearised,
    no_point,
    point_at,
    rank_one,
    square,
)

FIRST_TIME_STEP = 1.0
"""First time step of the pseudo-transient run, s."""
SHORTEST_TIME_STEP = 1e-9
"""Time step below which the pseudo-transient run has failed, s."""
LONGEST_TIME_STEP = 1e12
"""Largest time step, s; implicit Euler steps of this length are Newton's steps."""
INNER_STEPS = 12
"""Number of Newton steps in a time step after which the time step is shortened."""
INNER_STEP = 1e-9
"""Length of a Newton step below which the time step has succeeded, K."""
UNKNOWN_TIME = 100.0
"""Time constant of every node if the heat capacities are not known, s."""


class Ended(NamedTuple):
    """The end of a search.

    - `temperatures`: temperatures where it ended, finite; they are a root only if `status` is `CONVERGED`.
    - `point`: evaluation there.
    - `slopes`: slopes at the root; `None` if they are not wanted.
    - `solves`, `derivatives`: number of evaluations of the losses, and of those with the derivative.
    """

    temperatures: Float[Array, " node"]
    point: Point
    slopes: Slopes | None
    status: Int[Array, ""]
    solves: Int[Array, ""]
    derivatives: Int[Array, ""]


def search(problem: Problem, options: ThermalOptions) -> Ended:
    """Runs both loops one after the other. The result is not differentiated; `solve` adds the derivatives."""
    quasi = _quasi_newton(problem, options)
    again = (quasi.status == GOING) | (options.stability & (quasi.status == Status.CONVERGED))
    later = _second_loop(problem, options, quasi, again)
    went = later.passes > 0
    choose = lambda new, old: jax.tree.map(lambda a, b: jnp.where(went, a, b), new, old)
    place, point = choose((later.base, later.point), (quasi.base, quasi.point))
    status = jnp.where(went, later.status, quasi.status)
    too_hot = (status == Status.CONVERGED) & jnp.any(place > problem.limit)
    status = jnp.where(too_hot, int(Status.THERMAL_RUNAWAY), status)
    derivatives = later.passes if options.jacobian == "when_needed" else jnp.zeros_like(later.passes)
    return Ended(place, point, later.slopes, status, quasi.passes + later.passes, derivatives)


class _QuasiNewton(NamedTuple):
    """State of Broyden's iteration.

    - `point`: evaluation at the base.
    - `matrix`: approximate Jacobian.
    - `conduction`: K at the start, without the derivatives of the conductances that the losses add.
    - `spent`: True if the iteration has no steps left; without a root, the second loop then takes over.
    """

    line: Line
    point: Point
    matrix: Float[Array, "node node"]
    conduction: Float[Array, "node node"]
    passes: Int[Array, ""]
    spent: Bool[Array, ""]
    status: Int[Array, ""]

    @property
    def base(self) -> Float[Array, " node"]:
        return self.line.base


def _quasi_newton(problem: Problem, options: ThermalOptions) -> _QuasiNewton:
    def advance(state: _QuasiNewton) -> _QuasiNewton:
        line, first = state.line, state.passes == 0
        losses = problem.losses_at(line.trial)
        point = point_at(losses, problem.flows(line.trial, losses))
        conduction = -jax.jacfwd(lambda trial: problem.flows(trial, losses).into_nodes)(line.trial)
        conduction = jnp.where(first, conduction, state.conduction)
        accepted = line.accepts(point, state.point.norm, first, RISE)
        updated = rank_one(state.matrix, line.trial - line.base, point.residual - state.point.residual)
        matrix = jnp.where(first, -conduction, jnp.where(accepted, updated, state.matrix))
        following = line.goes_on(accepted, -lapack.solve_vector(matrix, point.residual))
        converged = accepted & point.balanced(options.tolerance)
        spent = following.stuck | (state.passes + 1 >= options.quasi_newton_solves)
        # if the losses cannot be computed at the start, the search cannot begin
        lost = first & point.broken
        status = jnp.where(lost, point.failure, jnp.where(converged, int(Status.CONVERGED), GOING))
        kept = jax.tree.map(lambda new, old: jnp.where(accepted | first, new, old), point, state.point)
        return _QuasiNewton(following, kept, matrix, conduction, state.passes + 1, spent, status)

    first = _QuasiNewton(
        line=Line.at(problem.start),
        point=no_point(problem),
        matrix=square(problem),
        conduction=square(problem),
        passes=jnp.asarray(0),
        spent=jnp.asarray(False),
        status=jnp.asarray(GOING),
    )
    return jax.lax.while_loop(lambda state: (state.status == GOING) & ~state.spent, advance, first)


class _Second(NamedTuple):
    """State of the second loop: Newton's iteration, then steps in time.

    - `line`: line search of Newton's iteration. During the steps in time `line.base` holds the temperatures after the
      last time step, and `line.trial` the iterate of the current one.
    - `point`: evaluation at the base (Newton) or at the last iterate (in time).
    - `matrix`: last Jacobian, or its approximation.
    - `marching`: True during the steps in time.
    - `time_step`: s; `inner`: number of iterates of the current time step.
    """

    line: Line
    point: Point
    matrix: Float[Array, "node node"]
    slopes: Slopes | None
    marching: Bool[Array, ""]
    time_step: Float[Array, ""]
    inner: Int[Array, ""]
    newton: Int[Array, ""]
    passes: Int[Array, ""]
    status: Int[Array, ""]

    @property
    def base(self) -> Float[Array, " node"]:
        return self.line.base


def _second_loop(problem: Problem, options: ThermalOptions, quasi: _QuasiNewton, begins: Array) -> _Second:
    """Newton's iteration and the pseudo-transient run in one loop, which takes no pass if `begins` is False."""
    exact = options.jacobian == "when_needed"
    capacity = problem.capacity
    if capacity is None:
        capacity = UNKNOWN_TIME * jnp.diagonal(quasi.conduction)

    def advance(state: _Second) -> _Second:
        if exact:
            point, slopes = linearised(problem, state.line.trial)
            matrix = slopes.jacobian
        else:
            *_, losses, flows = evaluate(problem, state.line.trial)
            point, slopes, matrix = point_at(losses, flows), None, state.matrix
        newton = _newton_pass(state, point, matrix, options) if exact else state
        in_time = _time_pass(state, point, matrix, problem, capacity, -quasi.conduction, options)
        pick = lambda a, b: jax.tree.map(lambda x, y: jnp.where(state.marching, x, y), a, b)
        following = pick(in_time, newton) if exact else in_time
        converged = following.status == Status.CONVERGED
        # Newton's iteration has failed: steps in time begin from the start
        turns = ~converged & ~following.marching & (following.newton >= options.newton_steps)
        line = jax.tree.map(lambda x, y: jnp.where(turns, x, y), Line.at(problem.start), following.line)
        wanted = slopes if options.stability else None
        return following._replace(
            line=line, marching=following.marching | turns, slopes=wanted, passes=state.passes + 1
        )

    nothing = Slopes(square(problem), square(problem)) if options.stability else None
    first = _Second(
        line=Line.at(quasi.base) if exact else Line.at(problem.start),
        point=no_point(problem),
        matrix=-quasi.conduction,
        slopes=nothing,
        marching=jnp.asarray(not exact),
        time_step=jnp.asarray(FIRST_TIME_STEP),
        inner=jnp.asarray(0),
        newton=jnp.asarray(0),
        passes=jnp.asarray(0),
        status=jnp.where(begins, GOING, quasi.status),
    )
    return jax.lax.while_loop(lambda state: state.status == GOING, advance, first)


def _newton_pass(state: _Second, point: Point, matrix: Array, options: ThermalOptions) -> _Second:
    """One step of Newton's iteration. It is accepted if the norm does not grow. `newton`, the number of steps, is set
    to its limit if the iteration has failed."""
    accepted = state.line.accepts(point, state.point.norm, state.newton == 0)
    following = state.line.goes_on(accepted, -lapack.solve_vector(matrix, point.residual))
    converged = accepted & point.balanced(options.tolerance)
    stuck = following.stuck | (point.broken & (state.newton == 0))
    # the root is the point of the evaluation, not the next trial
    line = jax.tree.map(lambda x, y: jnp.where(converged, x, y), Line.at(state.line.trial), following)
    return state._replace(
        line=line,
        point=jax.tree.map(lambda new, old: jnp.where(accepted, new, old), point, state.point),
        newton=jnp.where(stuck, options.newton_steps, state.newton + 1),
        status=jnp.where(converged, int(Status.CONVERGED), GOING),
    )


def _time_pass(
    state: _Second,
    point: Point,
    matrix: Array,
    problem: Problem,
    capacity: Array,
    plain: Array,
    options: ThermalOptions,
) -> _Second:
    """One Newton step of implicit Euler's equation $C(T - T_n)/h = R(T)$. After a time step that succeeds the next one
    is twice as long; a time step that fails is repeated with a quarter of its length."""
    level, trial = state.line.base, state.line.trial
    if options.jacobian == "never":
        # the update needs two iterates that differ by more than rounding
        step, change = state.line.step, point.residual - state.point.residual
        moved = (state.passes > 0) & ~point.broken & ~state.point.broken & (jnp.max(jnp.abs(step)) > SHORT_STEP)
        matrix = jnp.where(moved, rank_one(matrix, step, change), matrix)
    storing = capacity / state.time_step
    step = -lapack.solve_vector(matrix - jnp.diag(storing), point.residual - storing * (trial - level))
    size = jnp.max(jnp.abs(step))
    steady = (state.inner == 0) & ~point.broken & point.balanced(options.tolerance)
    fails = point.broken | ~(size < jnp.inf) | (state.inner + 1 >= INNER_STEPS)
    done = ~point.broken & (size < INNER_STEP)
    again = fails & ~done
    time_step = state.time_step * jnp.where(done, 2.0, jnp.where(again, 0.25, 1.0))
    time_step = jnp.minimum(time_step, LONGEST_TIME_STEP)
    new_level = jnp.where(done, trial + step, level)
    following = jnp.where(again, level, trial + step)
    hot = done & jnp.any(new_level > problem.limit)
    most = options.newton_steps + options.time_steps
    failure = jnp.where(state.passes + 1 >= most, int(Status.NOT_CONVERGED), GOING)
    failure = jnp.where(time_step < SHORTEST_TIME_STEP, point.failure, failure)
    failure = jnp.where(hot, int(Status.THERMAL_RUNAWAY), failure)
    at_rest = lambda new, old: jnp.where(steady, new, old)
    return state._replace(
        line=Line(at_rest(trial, new_level), following - trial, jnp.asarray(0), at_rest(trial, following)),
        point=point,
        # after a failure the matrix, which may be spoilt by differences, starts from conduction again
        matrix=jnp.where(again, plain, matrix),
        time_step=time_step,
        inner=jnp.where(done | again, 0, state.inner + 1),
        status=jnp.where(steady, int(Status.CONVERGED), failure),
    )
