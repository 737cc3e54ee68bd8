"""Speed AND error of the steady ball bearing, beside scipy on the same equations in the same run.

    python tests/benchmarks/ball_bearing.py [--quick] [--devices 2]

Three problems: the frictionless core under combined load (the bearing of `turbine_ball`: 20 balls, 42 unknowns), the
same under axial load alone (one ball for all, 3 unknowns), and `turbine_ball` whole (films, inlet heating, traction
with spin over the ellipses to the accuracy its scene names, cage, drag; 6 unknowns). Times are wall times of warm calls
(best of several); errors are the largest relative difference of axial displacement, largest load and (whole model)
total power from a solve to 1e-11. The rival is `scipy.optimize.root(method="hybr")` on all unknowns with nothing
eliminated, residual and Jacobian jitted, with its own finite differences and with our exact Jacobian; it starts (a)
from the formulas our phase 1 begins with, (b) from the minimum of the convex problem, which is our first guess.
"""

import argparse
import os
import sys
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="smaller batches, fewer rivals")
parser.add_argument("--devices", type=int, default=None, help="CPU devices for the batches (default: all cores)")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])
if __name__ == "__main__" and os.environ.get("JAX_PLATFORMS", "cpu") == "cpu":
    count = arguments.devices or os.cpu_count() or 1
    os.environ["XLA_FLAGS"] = f"{os.environ.get('XLA_FLAGS', '')} --xla_force_host_platform_device_count={count}"

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import dataclasses  # noqa: E402

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
import scipy.optimize  # noqa: E402
from benchmark_tools import best_time, error_of, sharded  # noqa: E402

import jaxbearing as jb  # noqa: E402
from jaxbearing.bearings.ball.build import build_core, build_lubricated  # noqa: E402
from jaxbearing.numerics.arrow import ArrowPoint, evaluate  # noqa: E402
from jaxbearing.numerics.precision import as_float  # noqa: E402

RPM = 2.0 * np.pi / 60.0
TIGHT = jb.NewtonOptions(residual_tolerance=1e-11, step_tolerance=1e-11, inner_tolerance=1e-9)


def scenes():
    whole = jb.load_scene("turbine_ball")
    frictionless = {"oil": None, "contact": None, "cage": None, "drag": None, "kinematics.attitude": "outer"}
    core = whole.replace(frictionless)
    return {
        "core, combined load": core.replace({"operation.radial_load": 8e3}),
        "core, axial load": core,
        "turbine_ball, whole": whole,
    }


def operations(scene, n, seed=0):
    """Random points: axial load 0.5-50 kN (whole model: 5-50 kN), radial up to 1.5 times that, 500-20 000 rpm."""
    rng = np.random.default_rng(seed)
    light, slow = (500.0, 500.0) if scene.contact is None else (5e3, 5e3)
    axial = np.exp(rng.uniform(np.log(light), np.log(5e4), n))
    points = {"axial_load": axial, "inner_speed": rng.uniform(slow, 2e4, n) * RPM}
    if not scene.operation.symmetric:
        points["radial_load"] = axial * rng.uniform(0.0, 1.5, n)
    return jax.tree.map(jnp.asarray, points)


def results(solution):
    values = [solution.ring.axial, jnp.max(solution.elements.load_inner)]
    whole = solution.raceway_power is not None
    return jnp.stack([*values, solution.power_loss.total] if whole else values)


def batched(scene, options=None):
    options = options or jb.NewtonOptions()

    def one(operation):
        solution = jb.solve(scene.at_operation(**operation), throw=False, options=options)
        return results(solution), solution.status, solution.iterations

    return sharded(lambda batch: jax.lax.map(one, batch))


def flat(point):
    return jnp.concatenate([point.elements.reshape(-1), point.globals])


def scipy_rows(scene, n):
    """(method, start) -> (median seconds an attempt, solved, attempts, largest error of the axial displacement)."""
    lubricated = scene.contact is not None

    def prepared(numbers, from_minimum):
        core = build_core(numbers)
        core = core.started()[0] if from_minimum else dataclasses.replace(core, guess=core.initial())
        system = build_lubricated(numbers, core) if lubricated else core
        return system, flat(system.initial())

    prepare = {flag: eqx.filter_jit(lambda s, flag=flag: prepared(s, flag)) for flag in (False, True)}
    system = prepare[True](jax.tree.map(as_float, scene))[0]
    shape = jax.eval_shape(lambda s: s.initial().elements, system).shape
    apart = lambda x: ArrowPoint(x[: shape[0] * shape[1]].reshape(shape), x[shape[0] * shape[1] :])
    residual = eqx.filter_jit(lambda s, x: flat(evaluate(s, apart(x)).residual))
    jacobian = eqx.filter_jit(lambda s, x: jax.jacfwd(lambda y: flat(evaluate(s, apart(y)).residual))(x))
    points, table = operations(scene, n, seed=1), {}
    for index in range(n):
        operation = {key: value[index] for key, value in points.items()}
        numbers = jax.tree.map(as_float, scene.at_operation(**operation))
        exact = jb.solve(numbers, options=TIGHT).ring.axial
        for start, from_minimum in (("formulas", False), ("convex minimum", True)):
            posed, first = prepare[from_minimum](numbers)
            call = lambda x, posed=posed: np.asarray(residual(posed, jnp.asarray(x)))
            slopes = lambda x, posed=posed: np.asarray(jacobian(posed, jnp.asarray(x)))
            call(first), slopes(first)  # compile
            for method, options in (("finite differences", {}), ("exact Jacobian", {"jac": slopes})):
                begin = time.perf_counter()
                found = scipy.optimize.root(call, np.asarray(first), method="hybr", tol=1e-10, **options)
                seconds = time.perf_counter() - begin
                solved = bool(np.max(np.abs(found.fun)) < 1e-8)
                axial = 1e-5 * found.x[shape[0] * shape[1]]
                error = abs(axial / float(exact) - 1.0) if solved else np.nan
                table.setdefault((method, start), []).append((seconds, solved, error))
    columns = {key: list(zip(*rows, strict=True)) for key, rows in table.items()}
    return {
        key: (float(np.median(seconds)), sum(solved), n, max(errors))
        for key, (seconds, solved, errors) in columns.items()
    }


def benchmark(quick):
    """Every figure of the table, by problem."""
    figures = {}
    for name, scene in scenes().items():
        if quick and scene.contact is not None:
            continue
        sizes = (100,) if quick else (1, 100, 10_000 if scene.contact is None else 1000)
        start = time.perf_counter()
        solution = jb.solve(scene)
        jax.block_until_ready(solution.stiffness)
        cold = time.perf_counter() - start
        fast = jb.jit_solver(scene)
        load = float(scene.operation.axial_load)
        warm = best_time(lambda fast=fast: fast().stiffness, 100)
        other = best_time(lambda fast=fast, load=load: fast(axial_load=1.1 * load).stiffness, 100)
        rows = {"cold": cold, "warm": warm, "other": other, "unknowns": solution.unknowns, "batch": {}}
        rows["error"] = error_of(results(solution), results(jb.solve(scene, options=TIGHT)))
        for size in sizes:
            batch = operations(scene, size)
            run = batched(scene).lower(batch).compile()
            seconds = best_time(lambda run=run, batch=batch: run(batch), 3 if size > 100 else 10)
            values, status, iterations = run(batch)
            few = {key: value[: min(size, 100)] for key, value in batch.items()}
            rows["batch"][size] = {
                "seconds": seconds / size,
                "failed": int(np.sum(np.asarray(status) != 0)),
                "error": error_of(values[: min(size, 100)], batched(scene, TIGHT)(few)[0]),
                "steps": (float(np.median(iterations)), int(np.max(iterations))),
            }
        rows["scipy"] = scipy_rows(scene, 3 if quick else 20)
        figures[name] = rows
    return figures


def print_table(figures):
    devices = f"{len(jax.devices())} x {jax.devices()[0].device_kind}"
    print(f"jax {jax.__version__}, {devices}, {os.cpu_count()} cores, float64, {time.strftime('%Y-%m-%d')}")
    for name, rows in figures.items():
        print(f"\n{name}: {rows['unknowns']} unknowns")
        print(
            f"  single solve: cold {rows['cold']:.1f} s (trace and compile), warm {1e3 * rows['warm']:.3f} ms "
            f"({1e3 * rows['other']:.3f} ms with another load), error {rows['error']:.1e}"
        )
        print("  batch    | us a solve | solves/s | error   | failed | steps median, max")
        for size, row in rows["batch"].items():
            print(
                f"  {size:8d} | {1e6 * row['seconds']:10.1f} | {1.0 / row['seconds']:8.0f} | {row['error']:.1e} | "
                f"{row['failed']:6d} | {row['steps'][0]:6.0f}, {row['steps'][1]:3d}"
            )
        ours = rows["batch"][max(rows["batch"])]["seconds"]
        print("  scipy hybr, all unknowns                | ms an attempt | solved | error   | ratio: batch, single")
        for (method, start), (seconds, solved, attempts, error) in rows["scipy"].items():
            label = f"{method}, from {start}"
            print(
                f"  {label:39s} | {1e3 * seconds:13.2f} | {solved:3d}/{attempts:<3d}| {error:.1e} | "
                f"{seconds / ours:8.0f}, {seconds / rows['warm']:6.1f}"
            )


if __name__ == "__main__":
    print_table(benchmark(arguments.quick))
