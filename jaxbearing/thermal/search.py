r"""The search for the steady temperatures of a network: Broyden's iteration, then Newton's, then the warm-up.

A loss function may hold the solve of a whole bearing, which is dear to compile and to run. So the search is two loops,
each around one evaluation. The first takes Broyden's steps from $B_0 = -K$, the part of the Jacobian that is known
without a derivative of the losses. The second goes on only where the first has failed, or where somebody wants the
Jacobian at the root: Newton's steps with the exact Jacobian, and where they fail as well, implicit Euler steps in time
from the start (pseudo-transient), which end where a real start ends.
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
"""First step of the pseudo-transient, s."""
SHORTEST_TIME_STEP = 1e-9
"""A pseudo-transient whose steps become shorter has failed, s."""
LONGEST_TIME_STEP = 1e12
"""Time steps grow no further, s: they are Newton's steps then."""
INNER_STEPS = 12
"""Newton's steps of one time step, before it is shortened."""
INNER_STEP = 1e-9
"""Largest Newton step of a time step that has succeeded, K."""
UNKNOWN_TIME = 100.0
"""Time constant of every node where its heat capacity is unknown, s."""


class Ended(NamedTuple):
    """The end of a search. `temperatures`: where it ended, finite; a root only if `status` says so; `point`: there;
    `slopes`: at the root, `None` unless wanted; `solves`, `derivatives`: evaluations of the losses, all, and those
    among them with the derivative."""

    temperatures: Float[Array, " node"]
    point: Point
    slopes: Slopes | None
    status: Int[Array, ""]
    solves: Int[Array, ""]
    derivatives: Int[Array, ""]


def search(problem: Problem, options: ThermalOptions) -> Ended:
    """Both loops, one after the other; nothing in here is differentiated from outside."""
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
    """State of Broyden's iteration. `point`: at the base; `matrix`: in the place of the Jacobian; `conduction`: K at
    the start, without the derivatives of conductances that the losses add; `spent`: it has failed, and the second loop
    goes on."""

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
        found = accepted & point.balanced(options.tolerance)
        spent = following.stuck | (state.passes + 1 >= options.quasi_newton_solves)
        # without losses at the start there is nothing to search from
        lost = first & point.broken
        status = jnp.where(lost, point.failure, jnp.where(found, int(Status.CONVERGED), GOING))
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

    `line`: of Newton's iteration; in time, `line.base` is the temperature at the end of the last step and `line.trial`
    the iterate of this one. `point`: at the base (Newton), at the last iterate (in time); `matrix`: the last Jacobian;
    `marching`: in time; `time_step`, s; `inner`: iterates of this step so far.
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
    """Newton's iteration and the pseudo-transient, in a loop that takes no pass where it does not begin."""
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
        found = following.status == Status.CONVERGED
        # Newton gave up: from the start again, in time
        turns = ~found & ~following.marching & (following.newton >= options.newton_steps)
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
    """One step of Newton's iteration, judged as Broyden's are; one that has failed is told by its count."""
    accepted = state.line.accepts(point, state.point.norm, state.newton == 0)
    following = state.line.goes_on(accepted, -lapack.solve_vector(matrix, point.residual))
    found = accepted & point.balanced(options.tolerance)
    stuck = following.stuck | (point.broken & (state.newton == 0))
    # the root is where the point is, not one step further
    line = jax.tree.map(lambda x, y: jnp.where(found, x, y), Line.at(state.line.trial), following)
    return state._replace(
        line=line,
        point=jax.tree.map(lambda new, old: jnp.where(accepted, new, old), point, state.point),
        newton=jnp.where(stuck, options.newton_steps, state.newton + 1),
        status=jnp.where(found, int(Status.CONVERGED), GOING),
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
    """One Newton step of implicit Euler's $C(T - T_n)/h = R(T)$; a step in time that succeeds is followed by one of
    twice its length, one that fails is tried again with a quarter of it."""
    level, trial = state.line.base, state.line.trial
    if options.jacobian == "never":
        # from one iterate to the next, if they differ by more than rounding; before the first there is none
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
        # what differences have spoilt is begun anew
        matrix=jnp.where(again, plain, matrix),
        time_step=time_step,
        inner=jnp.where(done | again, 0, state.inner + 1),
        status=jnp.where(steady, int(Status.CONVERGED), failure),
    )
