"""Steady ball bearing: accuracy of the traction over the ellipses, frictionless core, scipy on the same equations."""

import march_accuracy
from benchmark_report import HERE, load
from section_shape import Section, Table


def section(quick=False):
    script = load(HERE / "ball_bearing.py")
    figures = script.benchmark(True)
    by_accuracy = () if quick else march_accuracy.rows("turbine_ball", script.results)
    scipy = tuple(
        (name, method, start, 1e3 * seconds, f"{solved}/{attempts}", error, seconds / each["warm"])
        for name, each in figures.items()
        for (method, start), (seconds, solved, attempts, error) in each["scipy"].items()
    )
    cores = tuple(
        (
            name,
            each["unknowns"],
            each["error"],
            each["cold"],
            1e3 * each["warm"],
            size,
            1e6 * row["seconds"],
            row["error"],
        )
        for name, each in figures.items()
        for size, row in each["batch"].items()
    )
    core = figures["core, combined load"]
    return Section(
        "Steady ball bearing",
        "Errors are the largest relative ones of axial displacement, largest load and (whole model) power loss.",
        (
            Table(
                "`turbine_ball` whole, by the accuracy of the traction (extrapolated from 2400 steps, 288 strips):",
                ("accuracy asked", "error", "first solve, s", "warm, ms"),
                by_accuracy,
            ),
            Table(
                "The frictionless core (errors against solves to 1e-11):",
                ("core", "unknowns", "error", "first, s", "warm, ms", "batch", "us a solve", "error in the batch"),
                cores,
            ),
            Table(
                "scipy `root` (hybr) on all unknowns of the core:",
                ("core", "derivatives", "start", "ms an attempt", "solved", "error", "times one solve"),
                scipy,
            ),
        ),
        {
            "error of the core": core["error"],
            **{f"error at accuracy {row[0]:g}": row[1] for row in by_accuracy},
            "failed": float(sum(row["failed"] for each in figures.values() for row in each["batch"].values())),
            "times scipy, exact Jacobian, one solve": min(
                row[-1] for row in scipy if row[0] == "core, combined load" and row[1] == "exact Jacobian"
            ),
        },
    )
