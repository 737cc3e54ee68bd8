"""How time grows with the number of rolling elements and with the size of a batch, and what a chunk costs."""

import time

import jax
import jax.numpy as jnp
import numpy as np
from benchmark_report import HERE, load
from benchmark_tools import best_time
from section_shape import Section, Table

import jaxbearing as jb
from jaxbearing.lanes import LaneProgram
from jaxbearing.numerics.precision import as_float
from jaxbearing.sweeps.plan import LANES as DEFAULT_LANES

ELEMENTS = (10, 30, 60, 100, 300)
BATCHES = (1, 10, 100, 1000, 10_000, 100_000)
CHUNKS = (8, 32, 125, 500, 2000)
POINTS = 8
"""Solves, at loads around the scene's, over which a time is averaged."""


def section(quick=False):
    elements = ELEMENTS[1:3] if quick else ELEMENTS
    tables, facts = [], {}
    for kind, scene in kinds().items():
        rows = [(n, *timed(scaled(scene, kind, n))) for n in elements]
        exponent = exponent_from(30, rows)
        facts[f"exponent over elements, {kind}"] = exponent
        tables.append(
            Table(
                f"{kind}, exponent {exponent:.2f} from 30 elements on:",
                ("elements", "ms a solve", "Newton steps, mean", "compile, s", "failed"),
                tuple(rows),
            )
        )
    rows, failed = batch_rows(BATCHES[:3] if quick else BATCHES)
    tables.append(
        Table(
            "Batches of `reference_roller` (exponent: from the row above):",
            ("cases", "seconds", "ms a case", "exponent"),
            rows,
        )
    )
    chunks = chunk_rows(200 if quick else 2000, CHUNKS[:3] if quick else CHUNKS)
    best = min(row[1] for row in chunks)
    facts["cost a lane over the best chunk"] = next(row[1] for row in chunks if row[0] == DEFAULT_LANES) / best
    if not quick:
        facts["exponent over batches"] = exponent_from(100, rows)
    facts["failed"] = float(failed + sum(row[-1] for table in tables[:-1] for row in table.rows))
    tables.append(
        Table(
            f"Chunks of a sweep, one device (jaxbearing's own choice is {DEFAULT_LANES}):",
            ("lanes in a call", "ms a case", "over the best"),
            tuple((lanes, ms, ms / best) for lanes, ms in chunks),
        )
    )
    return Section(
        "Scaling", "Loads grow with the number of elements, so that each carries the same.", tuple(tables), facts
    )


def exponent_from(least, rows):
    """Fitted to (size, time, ...) of sizes not below the least."""
    size, taken = np.log([row[:2] for row in rows if row[0] >= least]).T
    return float(np.polyfit(size, taken, 1)[0])


def kinds():
    script = load(HERE / "roller_bearing.py")
    ball = jb.load_scene("turbine_ball").replace(
        {"oil": None, "contact": None, "cage": None, "drag": None, "kinematics.attitude": "outer"}
    )
    return {
        "lubricated roller bearing": script.reference_roller(),
        "core of a ball bearing": ball.replace({"operation.radial_load": 0.4 * float(ball.operation.axial_load)}),
    }


def scaled(scene, kind, n):
    """As many elements of the same size on a pitch circle that has room for them, each with the same load."""
    name = "n_balls" if kind.startswith("core") else "n_rollers"
    share = n / getattr(scene.geometry, name)
    size = {f"geometry.{name}": n, "geometry.pitch_diameter": scene.geometry.pitch_diameter * share}
    loads = {"radial_load": scene.operation.radial_load * share}
    if name == "n_balls":
        loads["axial_load"] = scene.operation.axial_load * share
    else:
        wider = scene.geometry.pitch_diameter * (share - 1.0)
        for at in ("inner_diameter", "outer_diameter"):
            size[f"cage.{at}"] = getattr(scene.cage, at) + wider
    # the same surface speeds
    loads["inner_speed"] = scene.operation.inner_speed / share
    return scene.replace(size | {f"operation.{field}": value for field, value in loads.items()})


def timed(scene):
    """ms a solve, mean Newton steps, seconds to compile, failed; over several loads."""
    scene = jax.tree.map(as_float, scene)
    factors = jnp.linspace(0.8, 1.2, POINTS)

    def one(factor):
        solution = jb.solve(scene.at_operation(radial_load=scene.operation.radial_load * factor), throw=False)
        return solution.status, solution.iterations

    begin = time.perf_counter()
    run = jax.jit(lambda f: jax.lax.map(one, f)).lower(factors).compile()
    compiled = time.perf_counter() - begin
    status, steps = run(factors)
    seconds = best_time(lambda: run(factors), 5) / POINTS
    return 1e3 * seconds, float(jnp.mean(steps)), compiled, int(jnp.sum(status != 0))


def batch_rows(sizes):
    script = load(HERE / "roller_bearing.py")
    scene, rows, failed = jax.tree.map(as_float, script.reference_roller()), [], 0
    for size in sizes:
        points = script.operations(size)
        run = script.batched(scene).lower(points).compile()
        found = []
        solved = lambda run=run, points=points, found=found: found.append(run(points)) or found[-1]
        seconds = best_time(solved, 1 if size > 1000 else 5)
        failed += int(np.sum(np.asarray(found[-1][1]) != 0))
        before = rows[-1] if rows else None
        exponent = None if before is None else float(np.log(seconds / before[1]) / np.log(size / before[0]))
        rows.append((size, seconds, 1e3 * seconds / size, exponent))
    return tuple(rows), failed


def chunk_rows(count, chunks):
    """(lanes, ms a case) of the sweep's engine on one device, our own choice among them; timed in turn, so that a spell
    in which the machine is busy is none of a single number of lanes."""
    script = load(HERE / "roller_bearing.py")
    scene, points = jb.load_scene("reference_roller"), script.operations(count)
    inputs = {f"operation.{name}": np.asarray(values) for name, values in points.items()}
    example, active = {path: values[0] for path, values in inputs.items()}, np.ones(count, dtype=bool)
    programs = {
        lanes: LaneProgram(lambda base, v: base.replace(v), scene, example, lanes=lanes, devices=1)
        for lanes in sorted({*chunks, DEFAULT_LANES})
    }
    for program in programs.values():
        program(inputs, active)
    times = dict.fromkeys(programs, np.inf)
    for _ in range(5):
        for lanes, program in programs.items():
            times[lanes] = min(times[lanes], best_time(lambda program=program: program(inputs, active), 1))
    return [(lanes, 1e3 * seconds / count) for lanes, seconds in times.items()]
