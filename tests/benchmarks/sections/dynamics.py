"""Cage dynamics of the roller bearing: solvers and batches beside scipy's on the same vector field."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from benchmark_report import HERE, load
from benchmark_tools import best_time, scipy_run, times_as_fast
from section_shape import Section, Table

SOLVERS = {
    "tsit5": (1e-3, 1e-4, 1e-5, 1e-6),
    "dopri8": (1e-3, 1e-4, 1e-5, 1e-6),
    "kvaerno5": (1e-3, 1e-4, 1e-5, 1e-6),
    "auto": (1e-4, 1e-5),
}
RIVALS = {"DOP853": (1e-3, 1e-4, 1e-5, 1e-6, 1e-7), "LSODA": (1e-3, 1e-4), "Radau": (1e-3,)}
LOADS = (0.9, 1.0, 1.1)
"""Of the nominal one: errors of one run alone are a matter of luck, ours and scipy's."""


class Lane(NamedTuple):
    """A run at one load: its start, compiled functions for scipy, and exact states."""

    start: object
    functions: tuple
    exact: np.ndarray


class Measured(NamedTuple):
    """Geometric means of the errors, um and m/s, means of the steps or calls and of the seconds."""

    steps: int
    q: float
    v: float
    seconds: float


def section(quick=False):
    script = load(HERE / "cage_dynamics.py")
    rows, batches, facts = [], [], {}
    for name, (drag, turns) in list(script.RUNS.items())[: 1 if quick else None]:
        nominal = script.start_of(drag)
        turn = 2.0 * np.pi / float(nominal.dynamics.reference_speed)
        times = np.linspace(0.0, (0.1 if quick else turns) * turn, script.SAMPLES + 1)[1:]
        functions = script.field_of(nominal.dynamics)
        lanes = [lane_at(script, nominal, functions, share, times) for share in (LOADS[1:2] if quick else LOADS)]
        if drag < 1.0:
            # behind hard shocks two exact solutions part
            facts[f"{name}: reference off scipy's DOP853, um"] = off_dop853(script, lanes[len(lanes) // 2], times)
        rival = {}
        for method, tolerances in list(RIVALS.items())[: 1 if quick else None]:
            for tolerance in tolerances[:2] if quick else tolerances:
                found = mean([theirs(script, lane, times, method, tolerance) for lane in lanes])
                rival.setdefault(method, []).append((found.q, found.seconds))
                rows.append((name, f"scipy {method}", tolerance, *found, None))

        errors = {}
        for solver, tolerances in SOLVERS.items():
            if solver in ("kvaerno5", "auto") and quick:
                continue
            for tolerance in tolerances[:2] if quick else tolerances:
                found = mean([ours(script, lane, times, solver, tolerance) for lane in lanes])
                rows.append((name, solver, tolerance, *found, times_as_fast(found.q, found.seconds, rival)))
                errors[solver, tolerance] = found.q
                facts[f"{name}: error of q of {solver} at {tolerance:g}, um"] = found.q
        asked = SOLVERS["tsit5"][:1] if quick else SOLVERS["tsit5"]
        for tolerance, each, failed in script.batches(nominal, jnp.asarray(times), asked, 4 if quick else 64):
            batches.append((name, tolerance, each, failed, times_as_fast(errors["tsit5", tolerance], each, rival)))
    facts["failed"] = float(sum(row[3] for row in batches))
    return Section(
        "Cage dynamics",
        "The bearing of Table 16 with the reference laws, 30 rollers, errors against dopri8 at 1e-11: each the "
        "geometric mean over runs at 90, 100 and 110 % of the load, the seconds their mean. The rivals get our jitted "
        "vector field (and Jacobian) without the integrals of the works. 'Times' is the time of scipy's fastest run of "
        "no larger error, interpolated between its tolerances, over ours. Behind shocks the motion is chaotic: errors "
        "of several um are a matter of luck, ours and scipy's.",
        (
            Table(
                "One run:",
                ("run", "solver", "tolerance", "steps or calls", "error of q, um", "of v, m/s", "seconds", "times"),
                tuple(rows),
            ),
            Table(
                "64 runs at once (`vmap`, shared out among all devices), loads from 90 to 110 %:",
                ("run", "tolerance", "seconds a run", "failed", "times"),
                tuple(batches),
            ),
        ),
        facts,
    )


def lane_at(script, nominal, functions, share, times):
    """The run at a share of the load, from the nominal start as in the batch; `functions`: of `field_of`."""
    load = share * nominal.dynamics.system.ring.load
    start = nominal._replace(dynamics=eqx.tree_at(lambda d: d.system.ring.load, nominal.dynamics, load))
    tight = script.IntegratorOptions(solver="dopri8", tolerance=script.REFERENCE)
    exact = script.ours(start, jnp.asarray(times), tight)
    assert int(exact.status) == script.Status.CONVERGED
    functions = script.loaded(functions, load)
    for function in functions:
        jax.block_until_ready(function(np.float64(0.0), first_of(script, start), 1e-3))
    return Lane(start, functions, script.flat(exact.states))


def first_of(script, start):
    """The first state as scipy wants it."""
    return script.flat(jax.tree.map(lambda leaf: leaf[None], start.state))[0]


def errors_of(script, lane, states):
    return script.errors(states, lane.exact, lane.start.state.elements.shape[1])


def mean(found):
    """Of the lanes."""
    steps, q, v, seconds = (np.asarray(values, dtype=float) for values in zip(*found, strict=True))
    return Measured(round(steps.mean()), *(float(np.exp(np.mean(np.log(e)))) for e in (q, v)), float(seconds.mean()))


def ours(script, lane, times, solver, tolerance):
    options = script.IntegratorOptions(solver=solver, tolerance=tolerance)
    run = lambda: script.ours(lane.start, jnp.asarray(times), options)
    found = run()
    assert int(found.status) == script.Status.CONVERGED
    steps = int(found.accepted) + int(found.rejected)
    return Measured(steps, *errors_of(script, lane, script.flat(found.states)), best_time(run, 1))


def theirs(script, lane, times, method, tolerance):
    first = first_of(script, lane.start)
    states, calls, seconds = scipy_run(lane.functions, first, times, method, tolerance)
    assert states is not None, method
    return Measured(calls, *errors_of(script, lane, states), seconds)


def off_dop853(script, lane, times):
    """Error of q of a rival at 1e-10, which has to agree with what errors are counted from."""
    states, *_ = scipy_run(lane.functions, first_of(script, lane.start), times, "DOP853", 1e-10)
    return errors_of(script, lane, states)[0]
