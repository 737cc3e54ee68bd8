r"""Temperatures of a network in time, $C_k\,dT_k/dt = R_k(T, t)$: warm-up, changes of speed and load, overheating.

At each instant the bearing is in its steady state for the temperatures of this instant: its own motion is faster by
five orders of magnitude. The equations are stiff (time constants of seconds to hours) and are integrated by an ESDIRK
method with the dense Jacobian of the few temperatures.

A stable steady state need not be reached: with a cold housing the inner ring may run away at speeds at which the warm
bearing would be safe. Neither the thermal margin nor the rate shows this; only this run does.
"""

import dataclasses
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import optimistix as optx
from equinox.internal import nondifferentiable
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from ..numerics.checks import label
from ..numerics.integrate import diffrax_solver
from ..numerics.integrator import IntegratorOptions
from ..numerics.status import Status
from .network import HeatFlows, Network, NodeHeat
from .solve import LIMIT

LossesInTime: TypeAlias = Callable[[Array, Array], NodeHeat]
"""Function of the node temperatures, K, shape (node,), and the time, s, that returns the heat into the nodes."""
NetworkInTime: TypeAlias = Callable[[Array], Network]
"""Function of the time, s, that returns the network, for an oil inlet, a flow or an ambient that changes."""

INTEGRALS = 3
"""Number of energies that are integrated with the temperatures: of the losses, to the oil, to the ambient."""
ENERGY = 1e3
"""Unit of these energies, J, with which one tolerance suits temperatures and energies."""
EVENT_TOLERANCE = 1e-6
"""Tolerance of the time at which a node passes the limit: relative, and absolute in s."""
SHORTEST_STEP = 1e-6
"""Default step below which a run has failed, s: no time constant of a bearing is as short."""
DIFFERENCE = 1e-3
"""Temperature difference for derivatives by finite differences, K."""
STAGE_NOISE = 1e-3
"""Change of the stages below which they count as solved, in units of the tolerance. The noise of the losses is
smaller."""
AHEAD = 1e3
"""Time beyond the end of a failed run at which the losses are evaluated, in units of the shortest step."""


class WarmUp(eqx.Module):
    """Temperatures and heat flows of a transient run. Values at instants that it has not reached are NaN."""

    nodes: tuple[str, ...] = eqx.field(static=True)
    status: Int[Array, ""] = eqx.field(metadata=label("1", "status of the run, index of the list of statuses"))
    times: Float[Array, " time"] = eqx.field(metadata=label("s", "instants"))
    temperatures: Float[Array, "time node"] = eqx.field(metadata=label("K", "temperature of each node"))
    total: Float[Array, " time"] = eqx.field(metadata=label("W", "total loss"))
    heat_to_oil: Float[Array, " time"] = eqx.field(metadata=label("W", "heat that leaves with the oil"))
    heat_to_ambient: Float[Array, " time"] = eqx.field(metadata=label("W", "heat that leaves to the ambient"))
    end: Float[Array, ""] = eqx.field(metadata=label("s", "time that the run has reached"))
    last: Float[Array, " node"] = eqx.field(metadata=label("K", "temperature of each node there"))
    losses_energy: Float[Array, ""] = eqx.field(metadata=label("J", "energy of all losses up to there"))
    oil_energy: Float[Array, ""] = eqx.field(metadata=label("J", "energy that left with the oil"))
    ambient_energy: Float[Array, ""] = eqx.field(metadata=label("J", "energy that left to the ambient"))
    energy_error: Float[Array, ""] = eqx.field(
        metadata=label("1", "energy of the losses less what left and what the nodes stored, relative to the first")
    )
    accepted: Int[Array, ""] = eqx.field(metadata=label("1", "count of accepted steps"))
    rejected: Int[Array, ""] = eqx.field(metadata=label("1", "count of rejected steps"))


def warm_up(
    network: Network | NetworkInTime,
    losses: LossesInTime,
    capacity: Float[Array, " node"],
    times: Float[Array, " time"],
    *,
    start: Float[Array, " node"] | None = None,
    limit: Scalar = LIMIT,
    options: IntegratorOptions | None = None,
    jumps: Float[Array, " jump"] | None = None,
    adjoint: dfx.AbstractAdjoint | None = None,
) -> WarmUp:
    """Temperatures from time 0 on; never raises for a run that fails.

    A node that exceeds `limit` ends the run at that instant, with the status `THERMAL_RUNAWAY`. If the losses cannot be
    computed, steps are shortened. A run that cannot go on has the status of the losses just beyond its end, or
    `DIVERGED` if they can be computed there.

    **Arguments:**
    - `network`: the network, or a function of the time, s, that returns it, always with the same nodes.
    - `losses(temperatures, time)`: heat into the nodes; speed or load may be looked up in tables at the time, s.
    - `capacity`: heat capacity of each node, J/K, > 0.
    - `times`: instants of the results, s, increasing, > 0; the last one ends the run.
    - `start`: temperatures at time 0, K; if not given, that of the ambient.
    - `limit`: temperature that no node may exceed, K.
    - `options`: solver by name, tolerance relative and in units of 1 K and 1 kJ; if not given, `kvaerno5` and 1e-5.
    - `jumps`: times at which a table has a jump or a kink, s: a step ends there.
    - `adjoint`: adjoint of diffrax: by default one for reverse mode; `diffrax.ForwardMode()` for forward mode.
    """
    chosen = usual_options() if options is None else options
    at_time: NetworkInTime = (lambda time: network) if isinstance(network, Network) else network
    first = at_time(jnp.zeros(()))
    begin = jnp.full(len(first.nodes), first.ambient) if start is None else jnp.asarray(start, dtype=float)
    balance = Balance(at_time, losses, capacity)
    reached = integrate(balance, begin, times, limit, chosen, jumps=jumps, adjoint=adjoint)
    ahead = AHEAD * chosen.shortest_step
    beyond = reached.last + ahead * balance.rates(reached.end, reached.last, None)
    status = run_status(reached, losses(beyond[: begin.size], reached.end + ahead).status)
    return _history(first.nodes, begin, capacity, times, balance.flows_at, reached, status)


def usual_options() -> IntegratorOptions:
    """Default options of a run."""
    return IntegratorOptions(solver="kvaerno5", max_steps=4096, shortest_step=SHORTEST_STEP)


class Balance(NamedTuple):
    """The equations of a run. Its state is the temperatures, K, followed by the energies in units of `ENERGY`."""

    network: NetworkInTime
    losses: LossesInTime
    capacity: Float[Array, " node"]

    def flows_at(self, time: Array, temperatures: Array) -> tuple[NodeHeat, HeatFlows]:
        heat = self.losses(temperatures, time)
        return heat, self.network(time).flows(temperatures, heat)

    def rates(self, time: Array, state: Array, args: None) -> Array:
        """Rates of the state, 1/s; NaN where the losses cannot be computed, so that the step is shortened."""
        del args
        heat, flows = self.flows_at(time, state[:-INTEGRALS])
        energies = jnp.stack([jnp.sum(heat.heat), flows.to_oil, flows.to_ambient]) / ENERGY
        rate = jnp.concatenate([(flows.into_nodes + heat.heat) / self.capacity, energies])
        return jnp.where(heat.status == Status.CONVERGED, rate, jnp.nan)


class Reached(NamedTuple):
    """The course of a run.

    - `states`: states at the instants, not finite beyond the end; `last`, `end`: last state, and its time, s.
    - `finished`, `hot`, `out_of_steps`: True if the run reached its last instant, if a node exceeded the limit, or if
      the number of steps was used up.
    - `accepted`, `rejected`: number of accepted and rejected steps.
    - `step_times`, `step_states`: ends of all steps, s, and the states there, not finite beyond the last one; `None` if
      they are not asked for.
    """

    states: Float[Array, "time component"]
    last: Float[Array, " component"]
    end: Float[Array, ""]
    finished: Bool[Array, ""]
    hot: Bool[Array, ""]
    out_of_steps: Bool[Array, ""]
    accepted: Int[Array, ""]
    rejected: Int[Array, ""]
    step_times: Float[Array, " step"] | None = None
    step_states: Float[Array, "step component"] | None = None


def integrate(
    balance: Balance,
    begin: Float[Array, " node"],
    times: Float[Array, " time"],
    limit: Scalar,
    options: IntegratorOptions,
    *,
    jumps: Float[Array, " jump"] | None = None,
    adjoint: dfx.AbstractAdjoint | None = None,
    first_step: Scalar | None = None,
    differences: bool = False,
    steps: bool = False,
) -> Reached:
    """Integrates from time 0 and energies of 0 to the last of the times.

    **Arguments:** `first_step`: length of the first step, s; if not given, it is guessed; `differences`: True for a
    matrix of the stages by finite differences: the program is then smaller, takes the same steps, and cannot be
    differentiated; `steps`: True to keep the ends of the steps; the others as for `warm_up`.
    """
    size = begin.size
    kept = (dfx.SubSaveAt(ts=times), dfx.SubSaveAt(t1=True), *((dfx.SubSaveAt(steps=True),) if steps else ()))

    def too_hot(t: object, y: Array, args: object, **kwargs: Any) -> Array:
        del t, args, kwargs
        return jnp.max(y[:size]) - limit

    # diffrax calls the field in many places: so it is traced once
    field: Any = eqx.filter_jit(_with_differences(balance.rates, begin) if differences else balance.rates)
    solution = dfx.diffeqsolve(
        dfx.ODETerm(field),
        # the elimination that has derivatives of the energies
        diffrax_solver(dataclasses.replace(options, elimination="dense"), noise=STAGE_NOISE),
        jnp.zeros(()),
        times[-1],
        first_step,
        jnp.concatenate([begin, jnp.zeros(INTEGRALS)]),
        saveat=dfx.SaveAt(subs=kept),
        stepsize_controller=_control(options, jumps),
        max_steps=options.max_steps,
        event=dfx.Event(too_hot, optx.Newton(EVENT_TOLERANCE, EVENT_TOLERANCE)),
        throw=False,
        adjoint=dfx.RecursiveCheckpointAdjoint() if adjoint is None else adjoint,
    )
    saved: Any = solution.ys
    ends: Any = solution.ts
    result: Any = solution.result
    last = saved[1][0]
    finite = jnp.all(jnp.isfinite(last))
    return Reached(
        states=saved[0],
        last=last,
        end=ends[1][0],
        finished=finite & (result == dfx.RESULTS.successful),
        hot=finite & (result == dfx.RESULTS.event_occurred),
        out_of_steps=result == dfx.RESULTS.max_steps_reached,
        accepted=solution.stats["num_accepted_steps"],
        rejected=solution.stats["num_rejected_steps"],
        step_times=ends[2] if steps else None,
        step_states=saved[2] if steps else None,
    )


def _with_differences(
    rates: Callable[[Array, Array, None], Array], begin: Float[Array, " node"]
) -> Callable[[Array, Array, None], Array]:
    """The rates, with derivatives with respect to the temperatures by finite differences. Nothing depends on the
    energies. There is no derivative with respect to time, because the integrator does not ask for it."""
    size, example = begin.size, jnp.concatenate([begin, jnp.zeros(INTEGRALS)])
    closed = eqx.filter_closure_convert(lambda time, state: rates(time, state, None), jnp.zeros(()), example)
    numbers, rest = eqx.partition(closed, eqx.is_array)
    # derivatives with respect to anything else would be wrong and are refused
    numbers = nondifferentiable(numbers)
    # one function of the program, which is called from many places
    evaluate = jax.jit(lambda numbers, time, state: eqx.combine(numbers, rest)(time, state))

    @jax.custom_jvp
    def field(numbers: object, time: Array, state: Array) -> Array:
        return evaluate(numbers, time, state)

    @field.defjvp
    def slope(primals: tuple[Any, Array, Array], tangents: tuple[Any, Array, Array]) -> tuple[Array, Array]:
        (numbers, time, state), along = primals, tangents[2]
        here = field(numbers, time, state)
        steps = DIFFERENCE * jnp.eye(size, state.size)
        columns = jax.lax.map(lambda step: (field(numbers, time, state + step) - here) / DIFFERENCE, steps)
        return here, along[:size] @ columns

    return lambda time, state, args: field(numbers, time, state)


def _control(options: IntegratorOptions, jumps: Array | None) -> dfx.AbstractStepSizeController:
    tolerance = jnp.asarray(options.tolerance)
    control = dfx.PIDController(
        rtol=tolerance,
        atol=tolerance,
        pcoeff=0.3,
        icoeff=0.4,
        dcoeff=0.0,
        dtmin=options.shortest_step,
        force_dtmin=False,
        norm=optx.rms_norm,
    )
    return control if jumps is None else dfx.ClipStepSizeController(control, jump_ts=jnp.asarray(jumps, dtype=float))


def _history(
    nodes: tuple[str, ...],
    begin: Array,
    capacity: Array,
    times: Array,
    flows_at: Callable[[Array, Array], tuple[NodeHeat, HeatFlows]],
    reached: Reached,
    status: Array,
) -> WarmUp:
    """Heat flows at the instants, and energies at the end."""
    size = begin.size
    temperatures, energies = reached.last[:size], ENERGY * reached.last[size:]
    stored = jnp.sum(capacity * (temperatures - begin))
    there = times <= reached.end

    def heats(instant: tuple[Array, Array, Array]) -> tuple[Array, Array, Array, Array]:
        time, state, passed = instant
        trial = jnp.where(passed, state[:size], begin)
        heat, flows = flows_at(time, trial)
        values = (trial, jnp.sum(heat.heat), flows.to_oil, flows.to_ambient)
        return jax.tree.map(lambda value: jnp.where(passed, value, jnp.nan), values)

    shown, total, to_oil, to_ambient = jax.lax.map(heats, (times, reached.states, there))
    return WarmUp(
        nodes=nodes,
        status=status,
        times=times,
        temperatures=shown,
        total=total,
        heat_to_oil=to_oil,
        heat_to_ambient=to_ambient,
        end=reached.end,
        last=temperatures,
        losses_energy=energies[0],
        oil_energy=energies[1],
        ambient_energy=energies[2],
        energy_error=(energies[0] - energies[1] - energies[2] - stored) / jnp.where(energies[0] == 0, 1.0, energies[0]),
        accepted=reached.accepted,
        rejected=reached.rejected,
    )


def run_status(reached: Reached, of_losses: Array) -> Int[Array, ""]:
    """The status with which a run ended. **Arguments:** `of_losses`: status of the losses just beyond the end."""
    failed = jnp.where(reached.out_of_steps, int(Status.NOT_CONVERGED), int(Status.DIVERGED))
    failed = jnp.where(of_losses == Status.CONVERGED, failed, of_losses)
    ended = jnp.where(reached.hot, int(Status.THERMAL_RUNAWAY), failed)
    return jnp.where(reached.finished, int(Status.CONVERGED), ended)
