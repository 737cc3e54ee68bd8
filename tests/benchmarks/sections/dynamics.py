"""Cage dynamics of the roller bearing: solvers and batches beside scipy's on the same vector field."""

import jax.numpy as jnp
import numpy as np
from benchmark_report import HERE, load
from benchmark_tools import best_time
from section_shape import Section, Table

SOLVERS = {"tsit5": (1e-3, 1e-4, 1e-5, 1e-6), "dopri8": (1e-3, 1e-4, 1e-5, 1e-6), "kvaerno3": (1e-2, 1e-3)}
RIVALS = {"DOP853": (1e-3, 1e-4, 1e-5, 1e-6), "LSODA": (1e-3, 1e-4), "Radau": (1e-3,)}


def section(quick=False):
    script = load(HERE / "cage_dynamics.py")
    rows, batches, facts = [], [], {}
    for name, (drag, turns) in list(script.RUNS.items())[: 1 if quick else None]:
        start = script.start_of(drag)
        turn = 2.0 * np.pi / float(start.dynamics.reference_speed)
        times = np.linspace(0.0, (0.1 if quick else turns) * turn, script.SAMPLES + 1)[1:]
        at, rollers = jnp.asarray(times), start.state.elements.shape[1]
        tight = script.IntegratorOptions(solver="dopri8", tolerance=script.REFERENCE)
        exact = script.flat(script.ours(start, at, tight).states)
        functions = script.field_of(start.dynamics)
        rival = rivals(script, functions, start, times, exact, name, rows, quick)
        if drag < 1.0:
            # behind hard shocks two exact solutions part
            facts[f"{name}: reference off scipy's DOP853, um"] = off_dop853(script, functions, start, times, exact)
        least = lambda error, rival=rival: min(
            (t for t in (script.time_at(error, points) for points in rival.values()) if t is not None), default=None
        )
        for solver, tolerances in SOLVERS.items():
            # hard shocks: an implicit run takes several seconds
            if solver == "kvaerno3" and (drag > 1.0 or quick):
                continue
            for tolerance in tolerances[:2] if quick else tolerances:
                options = script.IntegratorOptions(solver=solver, tolerance=tolerance)
                run = lambda options=options, start=start, at=at: script.ours(start, at, options)
                found = run()
                q, v = script.errors(script.flat(found.states), exact, rollers)
                seconds, theirs = best_time(run, 1 if solver == "kvaerno3" else 3), least(q)
                ratio = None if theirs is None else theirs / seconds
                steps = int(found.accepted) + int(found.rejected)
                rows.append((name, solver, tolerance, steps, q, v, seconds, ratio))
                facts[f"{name}: error of q of {solver} at {tolerance:g}, um"] = q
        asked = SOLVERS["tsit5"][:1] if quick else SOLVERS["tsit5"]
        for tolerance, each, failed in script.batches_of(start, at, asked, 4 if quick else 64):
            theirs = least(next(r[4] for r in rows if r[:3] == (name, "tsit5", tolerance)))
            batches.append((name, tolerance, each, failed, None if theirs is None else theirs / each))
    facts["failed"] = float(sum(row[3] for row in batches))
    return Section(
        "Cage dynamics",
        "The bearing of Table 16 with the reference laws, 30 rollers, errors against dopri8 at 1e-11. The rivals get "
        "our jitted vector field (and Jacobian) without the integrals of the works. 'Times' is the time of scipy's "
        "fastest run of no larger error, interpolated between its tolerances, over ours. Behind shocks the motion is "
        "chaotic: an error of several um is a matter of luck, ours and scipy's.",
        (
            Table(
                "One run:",
                ("run", "solver", "tolerance", "steps or calls", "error of q, um", "of v, m/s", "seconds", "times"),
                tuple(rows),
            ),
            Table(
                "64 runs at once (`vmap`, shared by all devices):",
                ("run", "tolerance", "seconds a run", "failed", "times"),
                tuple(batches),
            ),
        ),
        facts,
    )


def off_dop853(script, functions, start, times, exact):
    """Error of q of a rival at 1e-10, which has to agree with what errors are counted from."""
    import jax

    first = script.flat(jax.tree.map(lambda leaf: leaf[None], start.state))[0]
    states, *_ = script.scipy_run(functions, first, times, "DOP853", 1e-10)
    return script.errors(states, exact, start.state.elements.shape[1])[0]


def rivals(script, functions, start, times, exact, name, rows, quick):
    """method -> (error of q, seconds) by tolerance; rows are added to the table."""
    import jax

    first = script.flat(jax.tree.map(lambda leaf: leaf[None], start.state))[0]
    for function in functions:
        jax.block_until_ready(function(np.float64(0.0), first))
    found = {}
    for method, tolerances in list(RIVALS.items())[: 1 if quick else None]:
        points = []
        for tolerance in tolerances[:2] if quick else tolerances:
            states, calls, seconds = script.scipy_run(functions, first, times, method, tolerance)
            q, v = script.errors(states, exact, start.state.elements.shape[1])
            points.append((q, seconds))
            rows.append((name, f"scipy {method}", tolerance, calls, q, v, seconds, None))
        found[method] = points
    return found
