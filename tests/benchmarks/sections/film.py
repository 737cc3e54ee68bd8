"""Film of a line contact: error over nodes, Newton's step beside a dense one, stops, batches."""

import numpy as np
from benchmark_report import HERE, load
from section_shape import Section, Table


def section(quick=False):
    script = load(HERE / "line_contact.py")
    sizes = (51, 101) if quick else (51, 101, 201, 401)
    steady, stop = script.steady_rows(sizes, 3), script.stop_rows(sizes[-2:-1], 1)
    batch = script.batch_rows(101, 8 if quick else 64, 1)
    rows = tuple(
        (
            nodes,
            *(abs(error) for error in row["error"]),
            row["compile"],
            1e3 * row["seconds"],
            *(1e3 * seconds for seconds in row["step"]),
            row["step"][1] / row["step"][0],
        )
        for nodes, row in steady.items()
    )
    return Section(
        "Film of a line contact",
        "The source's contact 1, steady from cold, against the converged film; a Newton step beside `jax.jacfwd` and "
        "LAPACK on the same equations; the contact stopped within 10 ms.",
        (
            Table(
                "Steady:",
                (
                    "nodes",
                    "error, central",
                    "error, minimum",
                    "first, s",
                    "warm, ms",
                    "a step, ms",
                    "dense step, ms",
                    "times",
                ),
                rows,
            ),
            Table(
                "Stops:",
                ("nodes", "law", "seconds", "steps", "mass balance"),
                tuple((n, law, row["seconds"], row["counts"][0], row["balance"]) for (n, law), row in stop.items()),
            ),
            Table(
                "Batches, 101 nodes:",
                ("by", "seconds", "failed"),
                tuple((name, row["seconds"], row["failed"]) for name, row in batch.items()),
            ),
        ),
        {
            "order of the error": order(steady),
            "mass balance": float(np.max([row["balance"] for row in stop.values()])),
            "failed": float(sum(row["failed"] for row in batch.values())),
            "times dense at the largest": rows[-1][-1],
        },
    )


def order(steady):
    """From the two finest meshes."""
    coarse, fine = list(steady)[-2:]
    errors = [abs(steady[n]["error"][0]) for n in (coarse, fine)]
    return float(np.log(errors[0] / errors[1]) / np.log((fine - 1) / (coarse - 1)))
