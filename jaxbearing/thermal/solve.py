r"""Steady temperatures of a network whose losses depend on them.

The losses may come from the solve of a bearing: everything that their function closes over (speed, load, oil, clearance
...) is a parameter p of the root. Derivatives follow from the implicit function theorem, $dT/dp =
-J^{-1}\partial R/\partial p$, in forward and reverse mode and to any order. The Jacobian is computed for them only if a
derivative is asked for.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._checks import Information
from .._types import Scalar
from ..numerics import lapack
from ..numerics.batching import in_turn
from ..numerics.checks import label
from ..numerics.known_roots import at_known_root, known_roots, own_roots, recorded_roots, recording
from ..numerics.status import Status
from .network import Losses, Network, NodeHeat, Slopes, thermal_margin, thermal_rate
from .point import Problem, ThermalOptions, evaluate
from .search import Ended
from .search import search as search_root

LIMIT = 523.15
"""Temperature that no node may exceed, K: above 250 degC no law of an oil is valid."""

UNSTABLE = "unstable: a bearing would leave this state"
"""Warning for a root of the balances that is not stable."""
START_NOTE = Information(
    "a stable steady state need not be reached by a start at speed: only a transient run (simulate) says so"
)
"""Note that accompanies margin and rate."""


class ThermalState(eqx.Module):
    """Steady state of a network. If `status` is not `CONVERGED`, every result except `last` and `ended` is NaN."""

    nodes: tuple[str, ...] = eqx.field(static=True)
    status: Int[Array, ""] = eqx.field(metadata=label("1", "status of the search, index of the list of statuses"))
    temperatures: Float[Array, " node"] = eqx.field(metadata=label("K", "temperature of each node"))
    heat: Float[Array, " node"] = eqx.field(metadata=label("W", "heat of the losses into each node"))
    total: Float[Array, ""] = eqx.field(metadata=label("W", "total loss"))
    heat_to_oil: Float[Array, ""] = eqx.field(metadata=label("W", "heat that leaves with the oil"))
    heat_to_ambient: Float[Array, ""] = eqx.field(metadata=label("W", "heat that leaves to the ambient"))
    balance_error: Float[Array, ""] = eqx.field(
        metadata=label("1", "total loss less the heat that leaves, relative to the total loss")
    )
    oil_out: Float[Array, ""] | None = eqx.field(metadata=label("K", "temperature of the oil that leaves"))
    margin: Float[Array, ""] | None = eqx.field(
        metadata=label("1", "thermal margin: 1 without feedback, 0 at a fold; a ratio")
    )
    rate: Float[Array, ""] | None = eqx.field(
        metadata=label("1/s", "largest growth rate of a disturbance of the temperatures; stable if negative")
    )
    losses: NodeHeat = eqx.field(metadata=label("", "losses at these temperatures, with all that they carry"))
    ended: NodeHeat = eqx.field(
        metadata=label("", "losses where the search ended, of one that failed too; without derivatives")
    )
    last: Float[Array, " node"] = eqx.field(
        metadata=label("K", "temperature of each node where the search ended, of one that failed too")
    )
    solves: Int[Array, ""] = eqx.field(metadata=label("1", "count of evaluations of the losses"))
    derivatives: Int[Array, ""] = eqx.field(metadata=label("1", "count of those with the derivative of the losses"))

    def temperature(self, node: str) -> Float[Array, ""]:
        """Temperature of the node of this name, K."""
        return self.temperatures[self.nodes.index(node)]

    @property
    def hottest(self) -> Int[Array, ""]:
        """Index of the hottest node where the search ended; in a thermal runaway it is the node that ran away."""
        return jnp.argmax(self.last)

    @property
    def unstable(self) -> Bool[Array, ""] | None:
        """True if the state is unstable: `margin` <= 0 or `rate` > 0; `None` if they are not computed."""
        if self.margin is None:
            return None
        beyond = self.margin <= 0.0
        return beyond if self.rate is None else beyond | (self.rate > 0.0)

    def sentence(self) -> str:
        """One sentence on the end of the search. It needs a single state with known numbers."""
        node = int(np.argmax(np.asarray(self.last)))
        status, there = Status(int(self.status)), float(self.last[node])
        place = f"{self.nodes[node].replace('_', ' ')} at {there:.2f} K ({there - 273.15:.2f} degC)"
        if status == Status.CONVERGED:
            warning = "" if self.unstable is None or not bool(self.unstable) else f"; {UNSTABLE}"
            return f"steady temperatures found in {int(self.solves)} solves; hottest: {place}{warning}"
        if status == Status.THERMAL_RUNAWAY:
            return f"thermal_runaway: no steady state below the limit of temperature was found; hottest: {place}"
        return f"{status.text}: the search for steady temperatures ended with the hottest node, the {place}"


def solve_network(
    network: Network,
    losses: Losses,
    *,
    start: Float[Array, " node"] | None = None,
    capacity: Float[Array, " node"] | None = None,
    limit: Scalar = LIMIT,
    options: ThermalOptions | None = None,
) -> ThermalState:
    """The steady temperatures of a network; never raises for a search that fails.

    Under `jax.vmap` each lane has its own status, and a lane that fails changes no other. If there are several steady
    states, the search from a cold start found the coolest one in all cases tried. Only `warm_up` shows if a real start
    runs away although there is a steady state.

    **Arguments:**
    - `losses(temperatures)`: heat into the nodes at node temperatures, K, shape (node,). It may close over traced
      numbers; a bearing solve inside starts from its own guess each time.
    - `start`: temperatures of the first evaluation, K; `Network.start` if not given. It is not differentiated.
    - `capacity`: heat capacity of each node, J/K, > 0: for `rate`, and for the pseudo-transient, which otherwise gives
      each node a time constant of 100 s.
    - `limit`: temperature, K: a node that exceeds it ends the search with `THERMAL_RUNAWAY`.
    - `options`: tolerance, limits, and `stability`, with which `margin` and `rate` are computed. Their values here have
      no derivatives: for these, differentiate `thermal_margin(slopes_at(...))` at the temperatures found.
    """
    options = ThermalOptions() if options is None else options
    begin = network.start() if start is None else jnp.asarray(start, dtype=float)
    if begin.shape != (len(network.nodes),):
        raise ValueError(f"start must have a temperature for each of {len(network.nodes)} nodes, got {begin.shape}")
    held = jax.lax.stop_gradient((begin, capacity, jnp.asarray(limit, dtype=float)))

    def search() -> _Root:
        noted = recording()
        with own_roots():  # those of a bearing inside are parts of this one
            return _root(_closed(network, _with_roots(losses) if noted else losses, *held), options=options)

    def known(root: _Root, stiffness: bool) -> _Root:
        return _at_known_root(network, losses, root, stiffness)

    solution = at_known_root(search, known)
    solved = solution.status == Status.CONVERGED
    flows = network.flows(solution.temperatures, solution.losses)
    masked = lambda value: jnp.where(solved, value, jnp.nan)
    total = jnp.sum(solution.losses.heat)
    leaving = flows.to_oil + flows.to_ambient
    margin, rate = _stability(solution.slopes, solved, held[1])
    oil_out = network.oil_out(solution.temperatures)
    return ThermalState(
        nodes=network.nodes,
        status=solution.status,
        temperatures=masked(solution.temperatures),
        heat=masked(solution.losses.heat),
        total=masked(total),
        heat_to_oil=masked(flows.to_oil),
        heat_to_ambient=masked(flows.to_ambient),
        balance_error=masked((total - leaving) / jnp.where(total == 0.0, 1.0, total)),
        oil_out=None if oil_out is None else masked(oil_out),
        margin=None if margin is None else masked(margin),
        rate=None if rate is None else masked(rate),
        losses=jax.tree.map(lambda leaf: masked(leaf) if eqx.is_inexact_array(leaf) else leaf, solution.losses),
        ended=jax.lax.stop_gradient(solution.losses),
        last=jax.lax.stop_gradient(solution.temperatures),
        solves=jnp.asarray(solution.solves),
        derivatives=jnp.asarray(solution.derivatives),
    )


def _closed(network: Network, losses: Losses, start: Array, capacity: Array | None, limit: Array) -> Problem:
    """The problem with functions that close over nothing: the numbers that they closed over become leaves. Each is
    traced once."""

    def of_arrays(temperatures: Array) -> NodeHeat:
        return jax.tree.map(jnp.asarray, losses(temperatures))

    heat = eqx.filter_closure_convert(of_arrays, start)
    flows = eqx.filter_closure_convert(network.flows, start, jax.eval_shape(heat, start))
    return Problem(heat, flows, start, capacity, limit)


def _stability(slopes: Slopes | None, solved: Array, capacity: Array | None) -> tuple[Array | None, Array | None]:
    """Margin and rate, `None` if the slopes are not known. A lane that failed gets finite numbers without meaning."""
    if slopes is None:
        return None, None
    there = Slopes(*(jnp.where(solved, matrix, jnp.eye(matrix.shape[0])) for matrix in slopes))
    return in_turn(_margin_and_rate, jax.lax.stop_gradient((there, capacity)))


def _margin_and_rate(inputs: tuple[Slopes, Array | None]) -> tuple[Array, Array | None]:
    there, capacity = inputs
    return thermal_margin(there), None if capacity is None else thermal_rate(there, capacity)


class _Root(NamedTuple):
    """Temperatures, which are finite, and the losses there. In a lane that failed they are no root."""

    temperatures: Float[Array, " node"]
    losses: NodeHeat
    slopes: Slopes | None
    status: Int[Array, ""]
    solves: Int[Array, ""]
    derivatives: Int[Array, ""]


@eqx.filter_custom_jvp
def _root(problem: Problem, *, options: ThermalOptions) -> _Root:
    ended: Ended = in_turn(lambda lane: search_root(lane, options), problem)
    return _Root(ended.temperatures, ended.point.losses, ended.slopes, ended.status, ended.solves, ended.derivatives)


@_root.def_jvp
def _root_jvp(primals: tuple[Problem], tangents: tuple[Problem], *, options: ThermalOptions) -> tuple[_Root, _Root]:
    (problem,), (problem_dot,) = primals, tangents
    root = _root(problem, options=options)
    solved = root.status == Status.CONVERGED
    # a lane that failed passes no derivative, in either mode: NaN times zero would spoil what all lanes share
    select = lambda dot: jnp.where(solved, dot, 0.0)
    problem_dot = jax.tree.map(select, problem_dot)
    moved, fixed = eqx.partition(
        problem, jax.tree.map(lambda dot: dot is not None, problem_dot, is_leaf=lambda dot: dot is None)
    )

    def balances(numbers: Problem, temperatures: Array) -> tuple[Array, NodeHeat]:
        into, heat, losses, _ = evaluate(eqx.combine(numbers, fixed), temperatures)
        return into + heat, eqx.filter(losses, eqx.is_inexact_array)

    # one trace of the losses for all directions
    push = jax.linearize(balances, moved, root.temperatures)[1]
    still = jax.tree.map(jnp.zeros_like, problem_dot)
    rest = jnp.zeros_like(root.temperatures)
    jacobian = jax.vmap(lambda seed: push(still, seed)[0], out_axes=-1)(jnp.eye(rest.size))
    jacobian = jnp.where(solved, jacobian, jnp.eye(rest.size))
    temperatures_dot = select(-lapack.solve_vector(jacobian, select(push(problem_dot, rest)[0])))
    losses_dot = jax.tree.map(select, push(problem_dot, temperatures_dot)[1])
    nothing = jax.tree.map(lambda _: None, root)
    return root, nothing._replace(temperatures=temperatures_dot, losses=losses_dot)


def _with_roots(losses: Losses) -> Losses:
    """The same losses, which also return the roots of the searches inside them."""

    def noting(temperatures: Array) -> NodeHeat:
        with recorded_roots() as roots:
            heat = losses(temperatures)
        return dataclasses.replace(heat, roots=tuple(roots))

    return noting


def _at_known_root(network: Network, losses: Losses, root: _Root, stiffness: bool) -> _Root:
    """The root that was found before, with its first derivatives. There is no search, neither here nor inside the
    losses."""

    def balances(temperatures: Array) -> tuple[Array, NodeHeat]:
        with known_roots(root.losses.roots, stiffness):
            heat = losses(temperatures)
        into = network.flows(temperatures, heat).into_nodes
        return into + heat.heat, eqx.filter(dataclasses.replace(heat, roots=()), eqx.is_inexact_array)

    numbers, rest = eqx.partition(dataclasses.replace(root.losses, roots=()), eqx.is_inexact_array)
    place = _Place(root.temperatures, numbers, root.status == Status.CONVERGED)
    temperatures, moved = _known_place(eqx.filter_closure_convert(balances, root.temperatures), place=place)
    return root._replace(temperatures=temperatures, losses=eqx.combine(moved, rest))


class _Place(NamedTuple):
    """Temperatures that were found, the floats of the losses there, and whether they are a root."""

    temperatures: Float[Array, " node"]
    found: NodeHeat
    solved: Bool[Array, ""]


@eqx.filter_custom_jvp
def _known_place(balances: Callable[[Array], tuple[Array, NodeHeat]], *, place: _Place) -> tuple[Array, NodeHeat]:
    """Temperatures and floats of the losses at a known root, with first derivatives.

    **Arguments:** `balances`: function of the temperatures that returns the residual and the floats of the losses; it
    closes over nothing.
    """
    return place.temperatures, place.found


@_known_place.def_jvp
def _known_place_jvp(
    primals: Any, tangents: Any, *, place: _Place
) -> tuple[tuple[Array, NodeHeat], tuple[Array, NodeHeat]]:
    (balances,), (balances_dot,) = primals, tangents
    select = lambda dot: jnp.where(place.solved, dot, 0.0)
    balances_dot = jax.tree.map(select, balances_dot)
    moving = jax.tree.map(lambda dot: dot is not None, balances_dot, is_leaf=lambda dot: dot is None)
    moved, fixed = eqx.partition(balances, moving)
    size = place.temperatures.size

    def along(direction: object, step: Array) -> tuple[Array, NodeHeat]:
        evaluate = lambda numbers, temperatures: eqx.combine(numbers, fixed)(temperatures)
        return jax.jvp(evaluate, (moved, place.temperatures), (direction, step))[1]

    # one batched derivative serves the direction that is asked for and the directions of the temperatures
    first = jax.tree.map(lambda dot: jnp.zeros((1 + size, *dot.shape)).at[0].set(dot), balances_dot)
    residuals, slopes = jax.vmap(along)(first, jnp.eye(1 + size, size, -1))
    jacobian = jnp.where(place.solved, residuals[1:].T, jnp.eye(size))
    step = -lapack.solve_vector(jacobian, select(residuals[0]))
    found_dot = jax.tree.map(lambda slope: select(slope[0] + jnp.tensordot(step, slope[1:], 1)), slopes)
    return (place.temperatures, place.found), (select(step), found_dot)
