"""Speed AND error of transient runs, every solver that is offered, beside scipy's on the same vector field.

    python tests/benchmarks/cage_dynamics.py [--quick] [--scenes]

The bearing of Table 16 with the reference laws (25 kN, 14 000 rpm, 30 rollers), from its quasi-static state: 0.7 turns
of the cage with a drag coefficient of 0.6, and one turn with 1.2, where rollers hit the cage hard. An error is the
largest one over all rollers and 64 times, of positions q (um) and speeds v (m/s), against dopri8 at a tolerance of
1e-11, with which scipy's DOP853 at its own tightest tolerance has to agree. scipy gets our jitted vector field, without
the works, and where it asks for one its jitted Jacobian, in the same units and with the same tolerances, also of the
loads inside. "Times" is the time of scipy's fastest run that is at least as exact, interpolated between its tolerances
where it has two on either side, over ours. Times are wall times of warm runs, the best of several. The report
(`sections/dynamics.py`) has means over three loads instead of one.

With `--scenes` instead what the default solver is chosen from: error against processor time of four solvers, with warm,
cold and thin oil, with and without shocks, and in a run-up from 1 % of the speed.
"""

import argparse
import functools
import os
import platform
import sys
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="0.1 turns, two tolerances, batches of 4")
parser.add_argument("--scenes", action="store_true", help="all solvers on other scenes instead")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
from benchmark_tools import batches_of, best_time, said, scipy_run, times_as_fast  # noqa: E402
from moving_roller import start_of, started, table_16  # noqa: E402

from jaxbearing.bearings.cylindrical.motion.energy import WORKS  # noqa: E402
from jaxbearing.bearings.cylindrical.motion.rates import CAGE_UNITS, ROLLER_UNITS  # noqa: E402
from jaxbearing.bearings.motion.run import FIELD  # noqa: E402
from jaxbearing.bearings.motion.settings import Simulation  # noqa: E402
from jaxbearing.numerics.arrow import ArrowPoint  # noqa: E402
from jaxbearing.numerics.integrate import integrate_segment  # noqa: E402
from jaxbearing.numerics.integrator import SOLVERS, IntegratorOptions  # noqa: E402
from jaxbearing.numerics.status import Status  # noqa: E402
from jaxbearing.time_laws import Ramp  # noqa: E402

RUNS = {"0.7 turns, drag 0.6": (0.6, 0.7), "1 turn, drag 1.2": (1.2, 1.0)}
"""Drag coefficient and turns of the cage."""
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6)
SCIPY = ("Radau", "BDF", "LSODA", "DOP853")
SLOWEST = 4.0
"""A run that takes longer is the last one of its method, s."""
SAMPLES = 64
REFERENCE = 1e-11
ATOMS = len(ROLLER_UNITS)


@eqx.filter_jit
def ours(start, times, options):
    """A run in one go: states at the times, and what it took."""
    return integrate_segment(
        FIELD, start.state, jnp.zeros(()), times, start.dynamics, options, jnp.asarray(1e-7), idle=len(WORKS)
    )


def field_of(dynamics):
    """The vector field as scipy wants it, without the works, and its Jacobian, both compiled: functions of the load on
    the ring, and see `loaded`. Loads inside are found as exactly as ours are at the tolerance."""

    def field(ring_load, t, y, tolerance):
        moving = eqx.tree_at(lambda d: d.system.ring.load, dynamics, ring_load)
        n = dynamics.system.azimuth.shape[0]
        cage = jnp.concatenate([y[ATOMS * n :], jnp.zeros(len(WORKS))])
        state = ArrowPoint(y[: ATOMS * n].reshape(ATOMS, n), cage)
        found, _ = moving.nested_rates(t, state, tolerance=tolerance)
        return jnp.concatenate([found.elements.ravel(), found.globals[: len(CAGE_UNITS)]])

    return jax.jit(field), jax.jit(jax.jacfwd(field, argnums=2))


def loaded(functions, ring_load):
    """The functions of `field_of` at a load: of time, state, tolerance."""
    return tuple(functools.partial(function, ring_load) for function in functions)


def flat(state):
    """States, with times in front, as rows for scipy."""
    count = state.globals.shape[0]
    return np.concatenate(
        [np.asarray(state.elements).reshape(count, -1), np.asarray(state.globals)[:, : len(CAGE_UNITS)]], axis=1
    )


def errors(rows, exact, rollers):
    """Largest errors of q, um, and of v, m/s."""
    n = rollers
    apart = np.abs(rows - exact)
    return 1e6 * ROLLER_UNITS[0] * float(np.max(apart[:, :n])), ROLLER_UNITS[1] * float(np.max(apart[:, n : 2 * n]))


def loaded_run(start, load, tolerance, times):
    """A run from the start at another load, N."""
    dynamics = eqx.tree_at(lambda d: d.system.ring.load, start.dynamics, load)
    return ours(start._replace(dynamics=dynamics), times, IntegratorOptions(solver="tsit5", tolerance=tolerance))


def batches(start, times, tolerances, size):
    """See `benchmark_tools.batches_of`: loads from 90 % to 110 %."""
    loads = start.dynamics.system.ring.load[None, :] * jnp.linspace(0.9, 1.1, size)[:, None]
    return batches_of(loaded_run, start, loads, times, tolerances)


def benchmark(quick=False):
    """Figures of both runs."""
    figures = {}
    for name, (drag, turns) in RUNS.items():
        start = start_of(drag)
        rollers = start.state.elements.shape[1]
        turn = 2.0 * np.pi / float(start.dynamics.reference_speed)
        times = np.linspace(0.0, (0.1 if quick else turns) * turn, SAMPLES + 1)[1:]
        exact = ours(start, jnp.asarray(times), IntegratorOptions(solver="dopri8", tolerance=REFERENCE))
        assert int(exact.status) == Status.CONVERGED
        exact = flat(exact.states)
        tolerances = TOLERANCES[1:3] if quick else TOLERANCES
        table, rival = [], {}
        functions = loaded(field_of(start.dynamics), start.dynamics.system.ring.load)
        y0 = flat(jax.tree.map(lambda leaf: leaf[None], start.state))[0]
        for function in functions:
            jax.block_until_ready(function(np.float64(0.0), y0, 1e-3))
        for method in SCIPY[-1:] if quick else SCIPY:
            points = []
            for tolerance in (*tolerances, 1e-10) if method == "DOP853" else tolerances:
                rows, calls, seconds = scipy_run(functions, y0, times, method, tolerance)
                if rows is None:
                    continue
                q, v = errors(rows, exact, rollers)
                if tolerance > 1e-10:
                    points.append((q, seconds))
                table.append(said((f"scipy {method}", tolerance, calls, None, q, v, seconds, None)))
                if seconds > SLOWEST:
                    break
            rival[method] = points
        for solver in ("tsit5", "dopri8") if quick else SOLVERS:
            for tolerance in tolerances:
                options = IntegratorOptions(solver=solver, tolerance=tolerance)
                run = lambda options=options, start=start, times=times: ours(start, jnp.asarray(times), options)
                if tolerance == tolerances[0]:
                    run()  # compiles
                begin = time.perf_counter()
                found = jax.block_until_ready(run())
                seconds = time.perf_counter() - begin
                if seconds < 1.0:
                    seconds = min(seconds, best_time(run, 3))
                if int(found.status) != Status.CONVERGED:
                    table.append(said((solver, tolerance, None, None, np.nan, np.nan, np.nan, None)))
                    continue
                q, v = errors(flat(found.states), exact, rollers)
                ratio = times_as_fast(q, seconds, rival)
                steps = int(found.accepted), int(found.rejected)
                table.append(said((solver, tolerance, *steps, q, v, seconds, ratio)))
                if seconds > SLOWEST:
                    break
        size, together = 4 if quick else 64, []
        for tolerance, each, failed in batches(start, jnp.asarray(times), tolerances, size):
            q = next(row[4] for row in table if row[:2] == ("tsit5", tolerance))
            together.append(said((size, tolerance, each, failed, times_as_fast(q, each, rival))))
        figures[name] = {"table": table, "batches": together, "turns": times[-1] / turn}
    return figures


WHOLE, RUN_UP = Ramp(1.0, 1.0, 15e-3), Ramp(0.01, 1.0, 15e-3)
"""Speeds over time, of one kind, so that each solver is compiled once."""
SCENES = {
    "nominal, 7 ms": ({}, WHOLE, 7e-3),
    "run-up from 1 % of the speed, 6 ms": ({}, RUN_UP, 6e-3),
    "oil at 0 degC, 7 ms": ({"operation.oil_temperature": 273.15}, WHOLE, 7e-3),
    "run-up, oil at 0 degC, 6 ms": ({"operation.oil_temperature": 273.15}, RUN_UP, 6e-3),
    "oil at 200 degC, 7 ms": ({"operation.oil_temperature": 473.15}, WHOLE, 7e-3),
    "drag 1.2, hard shocks, 7 ms": ({"drag.coefficient": 1.2}, WHOLE, 7e-3),
}
"""Changes of the bearing of Table 16 with a drag coefficient of 0.6, speed over time, and duration, s."""
CANDIDATES = ("tsit5", "dopri8", "kvaerno5", "auto")
SCENE_REFERENCE = 1e-9
"""Tolerance of dopri8 whose run is the exact one."""


def processor_time(function, repeats):
    """Least processor time of a call, s."""
    times = []
    for _ in range(repeats):
        begin = time.process_time()
        jax.block_until_ready(function())
        times.append(time.process_time() - begin)
    return min(times)


def scenes_table():
    """What the default solver is chosen from: steps, largest errors of q, um, and v, m/s, over the run, and seconds."""
    found = {}
    for name, (changes, speed, duration) in SCENES.items():
        start = started(table_16(0.6).replace(changes), Simulation(speed=speed))
        times = np.linspace(0.0, duration, SAMPLES + 1)[1:]
        run = lambda options, start=start, times=times: ours(start, jnp.asarray(times), options)
        exact = run(IntegratorOptions(solver="dopri8", tolerance=SCENE_REFERENCE))
        if int(exact.status) != Status.CONVERGED:
            found[name, "dopri8", SCENE_REFERENCE] = None
            continue
        for solver in CANDIDATES:
            for tolerance in TOLERANCES:
                options = IntegratorOptions(solver=solver, tolerance=tolerance)
                result = run(options)
                if int(result.status) != Status.CONVERGED:
                    found[name, solver, tolerance] = None
                    continue
                q, v = errors(flat(result.states), flat(exact.states), start.state.elements.shape[1])
                seconds = processor_time(lambda options=options, run=run: run(options), 5)
                row = int(result.accepted), int(result.rejected), q, v, seconds
                found[name, solver, tolerance] = row
                said((name, solver, tolerance, *row))
    return found


def print_scenes(found):
    print("\nSteps (refused), largest errors of q and v, processor seconds")
    print("| scene | solver | tolerance | steps | q, um | v, m/s | seconds |")
    print("|---|---|---|---|---|---|---|")
    for (name, solver, tolerance), row in found.items():
        if row is None:
            print(f"| {name} | {solver} | {tolerance:.0e} | FAILED | | | |")
            continue
        steps, refused, q, v, seconds = row
        print(f"| {name} | {solver} | {tolerance:.0e} | {steps} ({refused}) | {q:.2g} | {v:.2g} | {seconds:.3f} |")


def print_table(figures):
    print(f"{os.cpu_count()} cores, {platform.machine()}, jax {jax.__version__}, {jax.devices()[0].platform}")
    for name, rows in figures.items():
        print(f"\n{name} (run over {rows['turns']:.2g} turns)")
        print("| solver | tolerance | steps (refused) | error of q, um | of v, m/s | seconds | times |")
        print("|---|---|---|---|---|---|---|")
        for solver, tolerance, steps, refused, q, v, seconds, ratio in rows["table"]:
            taken = f"{steps} calls" if refused is None else f"{steps} ({refused})"
            times = "" if ratio is None else f"{ratio:.1f}"
            print(f"| {solver} | {tolerance:.0e} | {taken} | {q:.2g} | {v:.2g} | {seconds:.3f} | {times} |")
        for size, tolerance, each, failed, ratio in rows["batches"]:
            times = "" if ratio is None else f", {ratio:.1f} times"
            print(f"batch of {size}, tsit5 {tolerance:.0e}: {each:.4f} s a run{times}, {failed} failed")


if __name__ == "__main__":
    if arguments.scenes:
        print_scenes(scenes_table())
    else:
        print_table(benchmark(arguments.quick))
