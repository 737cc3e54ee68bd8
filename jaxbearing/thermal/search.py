r"""The search for the steady temperatures of a network: Broyden's iteration, then Newton's, then the warm-up.

A loss function may hold the solve of a whole bearing, which is dear to compile and to run. So the search is two loops,
each around one evaluation. The first takes Broyden's steps from $B_0 = -K$, the part of the Jacobian that is known
without a derivative of the losses. The second goes on only where the first has failed, or where somebody wants the
Jacobian at the root: Newton's steps with the exact Jacobian, and where they fail as well, implicit Euler steps in time
from the start (pseudo-transient), which end where a real start ends.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from ..numerics.status import Status
from ..numerics.structure import choice, constant, count, switch
from .network import LAST_BITS, HeatFlows, NodeHeat, Slopes

GOING = -1
"""In the place of a status while a search goes on."""
STEP_CAP = 40.0
"""Longest step of one node, K."""
SHORT_STEP = 1e-6
"""A step below this, K, is taken whatever the balances do: rounding may keep them from falling."""
HALVINGS = 8
"""Times that a step is halved before the iteration has failed."""
SMALLEST_LOSS = 1e-6
"""The balances are compared with the total loss, or with this part of the heat that leaves if that is more: for a
network without losses."""
FIRST_TIME_STEP = 1.0
"""Of the pseudo-transient, s."""
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


class ThermalOptions(eqx.Module):
    """Tolerance and limits of the search; they shape the program.

    **Arguments:**
    - `tolerance`: largest balance of a node in a steady state as a part of the total loss (a number).
    - `jacobian`: `when_needed`: Newton's iteration with the exact Jacobian follows where Broyden's has failed, and the
      program holds the derivative of the losses. `never`: it does not, and is compiled in about half the time; the
      pseudo-transient then updates its matrix from differences.
    - `stability`: whether the slopes at the root are wanted; not with `never`.
    - `quasi_newton_solves`, `newton_steps`, `time_steps`: most evaluations of the losses by Broyden's iteration, by
      Newton's, and by the pseudo-transient (a number each).

    **Raises:** `ValueError` for an option that is none of these.
    """

    tolerance: float = constant("tolerance", 1e-11, bound="> 0")
    jacobian: str = choice("jacobian", ("when_needed", "never"), "when_needed")
    stability: bool = switch("stability", False)
    quasi_newton_solves: int = count("quasi_newton_solves", 15, least=1)
    newton_steps: int = count("newton_steps", 30, least=1)
    time_steps: int = count("time_steps", 1500, least=1)

    def __check_init__(self):
        if self.stability and self.jacobian == "never":
            raise ValueError("stability = True needs the Jacobian: only with jacobian = 'when_needed'")


class Problem(NamedTuple):
    """All that a search depends on; a pytree whose leaves are the parameters.

    `losses(temperatures)`, `flows(temperatures, heat)`: the losses, and the flows of the network with the conductances
    that they add; they close over nothing. `start`: temperatures, K; `capacity`: heat capacities, J/K, or `None`;
    `limit`: temperature that no node may pass, K.
    """

    losses: Callable[[Array], NodeHeat]
    flows: Callable[[Array, NodeHeat], HeatFlows]
    start: Float[Array, " node"]
    capacity: Float[Array, " node"] | None
    limit: Float[Array, ""]

    def losses_at(self, temperatures: Array) -> NodeHeat:
        """The losses, all of them arrays: what is constant leaves a traced function as a plain number."""
        return jax.tree.map(lambda one: jnp.asarray(one, dtype=jnp.result_type(one)), self.losses(temperatures))


class Point(NamedTuple):
    """Evaluation at temperatures: losses, and balances R, W. In units of the total loss: `norm`, the largest balance of
    a node, and `whole`, that of the network; both less what rounding explains."""

    losses: NodeHeat
    residual: Float[Array, " node"]
    norm: Float[Array, ""]
    whole: Float[Array, ""]

    def balanced(self, tolerance: float) -> Bool[Array, ""]:
        """True in a steady state."""
        return jnp.maximum(self.norm, self.whole) <= tolerance

    @property
    def broken(self) -> Bool[Array, ""]:
        """True if the losses could not be computed here."""
        return (self.losses.status != Status.CONVERGED) | ~jnp.isfinite(self.norm)


def point_at(losses: NodeHeat, flows: HeatFlows) -> Point:
    """Losses, balances and their norms."""
    residual = flows.into_nodes + losses.heat
    total, leaving = jnp.sum(losses.heat), jnp.abs(flows.to_oil) + jnp.abs(flows.to_ambient)
    scale = jnp.maximum(total, SMALLEST_LOSS * leaving)
    scale = jnp.where(scale == 0.0, 1.0, scale)
    # conductances far above the others make the balance of a node a matter of last bits; the sum knows none of them
    whole = jnp.abs(total - flows.to_oil - flows.to_ambient) - LAST_BITS * jnp.abs(total) - flows.rounding_out
    norm = jnp.max(jnp.maximum(jnp.abs(residual) - flows.rounding, 0.0))
    return Point(losses, residual, norm / scale, jnp.maximum(whole, 0.0) / scale)


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
    went = later.count > 0
    choose = lambda new, old: jax.tree.map(lambda a, b: jnp.where(went, a, b), new, old)
    place, point = choose((later.base, later.point), (quasi.base, quasi.point))
    status = jnp.where(went, later.status, quasi.status)
    too_hot = (status == Status.CONVERGED) & jnp.any(place > problem.limit)
    status = jnp.where(too_hot, int(Status.THERMAL_RUNAWAY), status)
    derivatives = later.count if options.jacobian == "when_needed" else jnp.zeros_like(later.count)
    return Ended(place, point, later.slopes, status, quasi.count + later.count, derivatives)


class _Line(NamedTuple):
    """A step from a base: the trial stands at the base plus a part of the step, 2^-halvings."""

    base: Float[Array, " node"]
    step: Float[Array, " node"]
    halvings: Int[Array, ""]
    trial: Float[Array, " node"]

    @classmethod
    def at(cls, start: Float[Array, " node"]) -> "_Line":
        return cls(start, jnp.zeros_like(start), jnp.asarray(0), start)

    def goes_on(self, accepted: Bool[Array, ""], step: Float[Array, " node"]) -> "_Line":
        """The next trial: along a new step where this one was accepted, else half as far along the old one."""
        base = jnp.where(accepted, self.trial, self.base)
        # the direction is kept: steps of which single nodes were cut took up to 25 solves instead of 15
        capped = step / jnp.maximum(jnp.max(jnp.abs(step)) / STEP_CAP, 1.0)
        step = jnp.where(accepted, capped, self.step)
        halvings = jnp.where(accepted, 0, self.halvings + 1)
        return _Line(base, step, halvings, base + jnp.exp2(-halvings.astype(float)) * step)

    def accepts(self, point: Point, before: Float[Array, ""], first: Bool[Array, ""]) -> Bool[Array, ""]:
        """True if a trial is taken. **Arguments:** `before`: norm at the base; `first`: there is no base yet."""
        short = jnp.max(jnp.abs(self.trial - self.base)) < SHORT_STEP
        return ~point.broken & (first | short | (point.norm <= before))


class _QuasiNewton(NamedTuple):
    """State of Broyden's iteration. `point`: at the base; `matrix`: in the place of the Jacobian; `conduction`: K at
    the start, without the derivatives of conductances that the losses add."""

    line: _Line
    point: Point
    matrix: Float[Array, "node node"]
    conduction: Float[Array, "node node"]
    count: Int[Array, ""]
    status: Int[Array, ""]

    @property
    def base(self) -> Float[Array, " node"]:
        return self.line.base


def rank_one(matrix: Array, step: Array, change: Array) -> Array:
    """Broyden's update: the matrix nearest to the last one that maps the step to the change of the balances."""
    square = jnp.sum(jnp.square(step))
    direction = step / jnp.where(square > 0.0, square, 1.0)
    return matrix + (change - matrix @ step)[:, None] * direction[None, :]


def _quasi_newton(problem: Problem, options: ThermalOptions) -> _QuasiNewton:
    def advance(state: _QuasiNewton) -> _QuasiNewton:
        line, first = state.line, state.count == 0
        losses = problem.losses_at(line.trial)
        point = point_at(losses, problem.flows(line.trial, losses))
        conduction = -jax.jacfwd(lambda trial: problem.flows(trial, losses).into_nodes)(line.trial)
        conduction = jnp.where(first, conduction, state.conduction)
        accepted = line.accepts(point, state.point.norm, first)
        updated = rank_one(state.matrix, line.trial - line.base, point.residual - state.point.residual)
        matrix = jnp.where(first, -conduction, jnp.where(accepted, updated, state.matrix))
        following = line.goes_on(accepted, -jnp.linalg.solve(matrix, point.residual))
        found = accepted & point.balanced(options.tolerance)
        stuck = ~jnp.all(jnp.isfinite(following.trial)) | (following.halvings > HALVINGS)
        ended = stuck | (state.count + 1 >= options.quasi_newton_solves)
        # without losses at the start there is nothing to search from
        lost = jnp.where(losses.status == Status.CONVERGED, int(Status.DIVERGED), losses.status)
        status = jnp.where(first & point.broken, lost, jnp.where(found, int(Status.CONVERGED), GOING))
        # GOING with `count` at its limit: the iteration has failed, and the second loop goes on
        spent = jnp.where(ended, options.quasi_newton_solves, 0)
        kept = jax.tree.map(lambda new, old: jnp.where(accepted | first, new, old), point, state.point)
        return _QuasiNewton(following, kept, matrix, conduction, state.count + 1, status), spent

    def go_on(carried: tuple[_QuasiNewton, Array]) -> Array:
        state, spent = carried
        return (state.status == GOING) & (spent == 0)

    first = _QuasiNewton(
        line=_Line.at(problem.start),
        point=_no_point(problem),
        matrix=_square(problem),
        conduction=_square(problem),
        count=jnp.asarray(0),
        status=jnp.asarray(GOING),
    )
    return jax.lax.while_loop(go_on, lambda carried: advance(carried[0]), (first, jnp.asarray(0)))[0]


def _square(problem: Problem) -> Float[Array, "node node"]:
    return jnp.zeros((problem.start.size, problem.start.size))


def _no_point(problem: Problem) -> Point:
    """A point of the shape that an evaluation has."""
    shape = jax.eval_shape(problem.losses_at, problem.start)
    losses: Any = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), shape)
    return Point(losses, jnp.zeros_like(problem.start), jnp.asarray(jnp.inf), jnp.asarray(jnp.inf))


def evaluate(problem: Problem, temperatures: Array) -> tuple[Array, Array, NodeHeat, HeatFlows]:
    """Heat that flows into the nodes, heat of the losses, W; and the losses and flows with all that they say."""
    losses = problem.losses_at(temperatures)
    flows = problem.flows(temperatures, losses)
    return flows.into_nodes, losses.heat, losses, flows


def linearised(problem: Problem, temperatures: Array) -> tuple[Point, Slopes]:
    """Point and exact slopes, from one evaluation and a tangent for each node."""

    def both(trial: Array) -> tuple[tuple[Array, Array], tuple[NodeHeat, HeatFlows]]:
        into, heat, losses, flows = evaluate(problem, trial)
        return (into, heat), (losses, flows)

    _, push, (losses, flows) = jax.linearize(both, temperatures, has_aux=True)
    into, heat = jax.vmap(push, out_axes=-1)(jnp.eye(temperatures.size))
    return point_at(losses, flows), Slopes(-into, heat)


class _Second(NamedTuple):
    """State of the second loop: Newton's iteration, then steps in time.

    `line`: of Newton's iteration; in time, `line.base` is the temperature at the end of the last step and `line.trial`
    the iterate of this one. `point`: at the base (Newton), at the last iterate (in time); `matrix`: the last Jacobian;
    `marching`: in time; `time_step`, s; `inner`: iterates of this step so far.
    """

    line: _Line
    point: Point
    matrix: Float[Array, "node node"]
    slopes: Slopes | None
    marching: Bool[Array, ""]
    time_step: Float[Array, ""]
    inner: Int[Array, ""]
    newton: Int[Array, ""]
    count: Int[Array, ""]
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
            into, _, losses, flows = evaluate(problem, state.line.trial)
            del into
            point, slopes, matrix = point_at(losses, flows), None, state.matrix
        newton = _newton_pass(state, point, matrix, options) if exact else state
        in_time = _time_pass(state, point, matrix, problem, capacity, -quasi.conduction, options)
        pick = lambda a, b: jax.tree.map(lambda x, y: jnp.where(state.marching, x, y), a, b)
        following = pick(in_time, newton) if exact else in_time
        found = following.status == Status.CONVERGED
        # Newton gave up: from the start again, in time
        turns = ~found & ~following.marching & (following.newton >= options.newton_steps)
        line = jax.tree.map(lambda x, y: jnp.where(turns, x, y), _Line.at(problem.start), following.line)
        wanted = slopes if options.stability else None
        return following._replace(
            line=line, marching=following.marching | turns, slopes=wanted, count=state.count + 1
        )

    nothing = Slopes(_square(problem), _square(problem)) if options.stability else None
    first = _Second(
        line=_Line.at(quasi.base) if exact else _Line.at(problem.start),
        point=_no_point(problem),
        matrix=-quasi.conduction,
        slopes=nothing,
        marching=jnp.asarray(not exact),
        time_step=jnp.asarray(FIRST_TIME_STEP),
        inner=jnp.asarray(0),
        newton=jnp.asarray(0),
        count=jnp.asarray(0),
        status=jnp.where(begins, GOING, quasi.status),
    )
    return jax.lax.while_loop(lambda state: state.status == GOING, advance, first)


def _newton_pass(state: _Second, point: Point, matrix: Array, options: ThermalOptions) -> _Second:
    """One step of Newton's iteration, judged as Broyden's are; one that has failed is told by its count."""
    accepted = state.line.accepts(point, state.point.norm, state.newton == 0)
    following = state.line.goes_on(accepted, -jnp.linalg.solve(matrix, point.residual))
    found = accepted & point.balanced(options.tolerance)
    stuck = ~jnp.all(jnp.isfinite(following.trial)) | (following.halvings > HALVINGS)
    stuck = stuck | (point.broken & (state.newton == 0))
    # the root is where the point is, not one step further
    line = jax.tree.map(lambda x, y: jnp.where(found, x, y), _Line.at(state.line.trial), following)
    return state._replace(
        line=line,
        point=jax.tree.map(lambda new, old: jnp.where(accepted, new, old), point, state.point),
        newton=jnp.where(stuck, options.newton_steps, state.newton + 1),
        status=jnp.where(found, int(Status.CONVERGED), GOING),
    )


def _time_pass(
    state: _Second, point: Point, matrix: Array, problem: Problem, capacity: Array, plain: Array, options: ThermalOptions
) -> _Second:
    """One Newton step of implicit Euler's $C(T - T_n)/h = R(T)$; a step in time that succeeds is followed by one of
    twice its length, one that fails is tried again with a quarter of it."""
    level, trial = state.line.base, state.line.trial
    if options.jacobian == "never":
        # from one iterate to the next, if they differ by more than rounding; before the first there is none
        step, change = state.line.step, point.residual - state.point.residual
        moved = (state.count > 0) & ~point.broken & ~state.point.broken & (jnp.max(jnp.abs(step)) > SHORT_STEP)
        matrix = jnp.where(moved, rank_one(matrix, step, change), matrix)
    storing = capacity / state.time_step
    step = -jnp.linalg.solve(matrix - jnp.diag(storing), point.residual - storing * (trial - level))
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
    broken = jnp.where(point.losses.status == Status.CONVERGED, int(Status.DIVERGED), point.losses.status)
    failure = jnp.where(
        hot,
        int(Status.THERMAL_RUNAWAY),
        jnp.where(
            time_step < SHORTEST_TIME_STEP,
            broken,
            jnp.where(state.count + 1 >= options.newton_steps + options.time_steps, int(Status.NOT_CONVERGED), GOING),
        ),
    )
    at_rest = lambda new, old: jnp.where(steady, new, old)
    return state._replace(
        line=_Line(at_rest(trial, new_level), following - trial, jnp.asarray(0), at_rest(trial, following)),
        point=point,
        # what differences have spoilt is begun anew
        matrix=jnp.where(again, plain, matrix),
        time_step=time_step,
        inner=jnp.where(done | again, 0, state.inner + 1),
        status=jnp.where(steady, int(Status.CONVERGED), failure),
    )
