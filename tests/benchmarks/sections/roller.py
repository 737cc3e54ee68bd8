"""Steady cylindrical roller bearing: accuracy of the traction and of Newton, batches, scipy on the same equations."""

from concurrent.futures import ThreadPoolExecutor

import march_accuracy
import numpy as np
from benchmark_report import HERE, load
from benchmark_tools import best_time, error_of
from section_shape import Section, Table

import jaxbearing as jb


def section(quick=False):
    script = load(HERE / "roller_bearing.py")
    by_accuracy = march_accuracy.rows("turbine_roller", script.results, *([(1e-2, 1e-3)] if quick else []))
    figures = script.benchmark(True)["reference_roller"]
    newton = newton_rows(script, 20 if quick else 200)
    ours = figures["batch"][100]["seconds"]
    scipy = tuple(
        (method, start, 1e3 * seconds, f"{solved}/{attempts}", error, seconds / figures["warm"], seconds / ours)
        for (method, start), (seconds, solved, attempts, error) in figures["scipy"].items()
    )
    return Section(
        "Steady cylindrical roller bearing",
        "Errors are the largest relative ones of power loss, cage speed and largest load.",
        (
            Table(
                "`turbine_roller`, by the accuracy of its traction (against 2400 steps, extrapolated):",
                ("accuracy asked", "error", "first solve, s", "warm, ms"),
                by_accuracy,
            ),
            Table(
                "`reference_roller`, random points over Table 14, by Newton's tolerance:",
                ("tolerance", "error", "ms a solve, batch", "failed"),
                newton,
            ),
            Table(
                "scipy `root` (hybr) on the 94 equations of `reference_roller` with nothing eliminated:",
                ("derivatives", "start", "ms an attempt", "solved", "error", "times one solve", "times a batch of 100"),
                scipy,
            ),
        ),
        {
            "power closure": figures["closure"],
            "failed": float(sum(row["failed"] for row in figures["batch"].values()) + sum(row[3] for row in newton)),
            "error of Newton": newton[-1][1],
            "times scipy, exact Jacobian, batch": min(row[-1] for row in scipy if row[0] == "exact Jacobian"),
            "times scipy, finite differences, batch": min(row[-1] for row in scipy if row[0] != "exact Jacobian"),
            **{f"error at accuracy {row[0]:g}": row[1] for row in by_accuracy},
        },
    )


def newton_rows(script, count):
    scene, points = script.reference_roller(), script.operations(count)
    chosen = {
        tolerance: jb.NewtonOptions(residual_tolerance=tolerance, step_tolerance=tolerance, inner_tolerance=1e-6)
        for tolerance in (1e-2, 1e-4, 1e-6, 1e-10)
    }
    programs = [script.batched(scene, options) for options in (script.TIGHT, *chosen.values())]
    with ThreadPoolExecutor(2) as pool:  # two are compiled at a time
        (exact, *_), *found = pool.map(lambda run: run(points), programs)
    rows = []
    for tolerance, run, (values, status, _) in zip(chosen, programs[1:], found, strict=True):
        seconds = best_time(lambda run=run: run(points), 3) / count
        rows.append((tolerance, error_of(values, exact), 1e3 * seconds, int(np.sum(np.asarray(status) != 0))))
    return tuple(rows)
