"""Speed AND error of the steady cylindrical roller bearing, beside scipy on the same equations in the same run.

    python tests/benchmarks/roller_bearing.py [--quick] [--devices 2]

Prints one table. Times are wall times of warm calls (best of several) unless "cold" is said; errors are the largest
relative difference of total power, cage speed and largest load from a reference solve that is accurate to 1e-13 (see
`TIGHT`). The rival is
`scipy.optimize.root(method="hybr")` on all 3N + 4 equations with nothing eliminated (`full_roller_system`), residual
and Jacobian jitted, once with its own finite differences and once with our exact Jacobian. It starts (a) where our
Newton starts, and (b) from the solution at 10 % less load, which a user would not have.
"""

import argparse
import os
import platform
import sys
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="reference_roller only, one batch of 100, fewer rivals")
parser.add_argument("--devices", type=int, default=None, help="CPU devices for the batches (default: all cores)")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])
if __name__ == "__main__" and os.environ.get("JAX_PLATFORMS", "cpu") == "cpu":
    count = arguments.devices or os.cpu_count() or 1
    os.environ["XLA_FLAGS"] = f"{os.environ.get('XLA_FLAGS', '')} --xla_force_host_platform_device_count={count}"

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx  # noqa: E402
import jax  # noqa: E402
import jax.numpy as jnp  # noqa: E402
import numpy as np  # noqa: E402
import scipy.optimize  # noqa: E402
from benchmark_tools import best_time, error_of, sharded  # noqa: E402
from full_roller_system import extend, scipy_functions  # noqa: E402
from roller_cases import reference_roller, turbine_roller  # noqa: E402

import jaxbearing as jb  # noqa: E402
from jaxbearing.bearings.cylindrical.steady import build_system  # noqa: E402
from jaxbearing.numerics.newton import newton_solve  # noqa: E402
from jaxbearing.numerics.precision import as_float  # noqa: E402

TIGHT = jb.NewtonOptions(residual_tolerance=1e-11, step_tolerance=1e-11, inner_tolerance=1e-9)
"""Reference solve: the last Newton step is below 1e-11 and is taken, so its own error is rounding, below 1e-13."""
SCENES = {"reference_roller": reference_roller, "turbine_roller": turbine_roller}


def operations(n, seed=0):
    """Random points over Table 14 of the source: speed and load logarithmic, flow and temperature uniform."""
    rng = np.random.default_rng(seed)
    log = lambda low, high: np.exp(rng.uniform(np.log(low), np.log(high), n))
    return {
        "inner_speed": jnp.asarray(log(100.0, 20_000.0) * 2 * np.pi / 60),
        "radial_load": jnp.asarray(log(200.0, 50_000.0)),
        "oil_flow": jnp.asarray(rng.uniform(0.0, 300.0, n) * 1e-3 / 3600),
        "oil_temperature": jnp.asarray(rng.uniform(60.0, 200.0, n) + 273.15),
    }


def results(solution):
    return jnp.stack([solution.power_loss.total, solution.cage.speed, jnp.max(solution.elements.load_inner)])


def batched(scene, options=None, vectorized=False):
    """One compiled function over a batch of operating points: `lax.map` or `vmap`, split over all devices."""
    options = options or jb.NewtonOptions()

    def one(operation):
        solution = jb.solve(scene.at_operation(**operation), throw=False, options=options)
        return results(solution), solution.status, solution.iterations

    return sharded(jax.vmap(one) if vectorized else (lambda batch: jax.lax.map(one, batch)))


def scipy_rows(name, make, n):
    """(method, start) -> (median seconds an attempt, solved, attempts, largest error of the solved ones)."""
    points = operations(n, seed=1)
    build = eqx.filter_jit(lambda s: build_system(s))
    solve = eqx.filter_jit(lambda s: newton_solve(s, TIGHT)[1])
    stretch = eqx.filter_jit(lambda s, p: extend(s, p))
    first = eqx.filter_jit(lambda s: s.initial())
    table = {}
    for index in range(n):
        operation = {key: value[index] for key, value in points.items()}
        system = build(jax.tree.map(as_float, make().at_operation(**operation)))
        less = build(
            jax.tree.map(as_float, make().at_operation(**operation | {"radial_load": 0.9 * operation["radial_load"]}))
        )
        exact = np.asarray(stretch(system, solve(system).point))
        starts = {"first guess": stretch(system, first(system)), "90 % load": stretch(less, solve(less).point)}
        residual, jacobian = scipy_functions(system)
        residual(exact)  # compile
        jacobian(exact)
        for method, options in (("finite differences", {}), ("exact Jacobian", {"jac": jacobian})):
            for start, guess in starts.items():
                begin = time.perf_counter()
                found = scipy.optimize.root(residual, np.asarray(guess), method="hybr", tol=1e-10, **options)
                seconds = time.perf_counter() - begin
                solved = bool(np.max(np.abs(found.fun)) < 1e-8)
                speed = 3 * 30 + 1  # the scaled cage speed: 1 + it is the speed itself
                error = abs((found.x[speed] - exact[speed]) / (1.0 + exact[speed])) if solved else np.nan
                table.setdefault((method, start), []).append((seconds, solved, error))
    return {
        key: (
            float(np.median([row[0] for row in rows])),
            sum(row[1] for row in rows),
            len(rows),
            max((row[2] for row in rows if row[1]), default=np.nan),
        )
        for key, rows in table.items()
    }


def benchmark(quick):
    """Every figure of the table, by scene."""
    sizes = (100,) if quick else (1, 100, 10_000)
    figures = {}
    for name, make in SCENES.items():
        if quick and name != "reference_roller":
            continue
        scene = jax.tree.map(as_float, make())
        start = time.perf_counter()
        cold = jb.solve(scene)
        jax.block_until_ready(cold.drive_power)
        cold_seconds = time.perf_counter() - start
        warm_seconds = best_time(lambda s=scene: jb.solve(s).drive_power, 20)
        rows = {"cold": cold_seconds, "warm": warm_seconds, "unknowns": cold.unknowns, "batch": {}}
        rows["closure"] = abs(float(cold.drive_power / cold.power_loss.total) - 1.0)
        for size in sizes:
            batch = operations(size)
            begin = time.perf_counter()
            run = batched(scene).lower(batch).compile()
            compile_seconds = time.perf_counter() - begin
            seconds = best_time(lambda run=run, batch=batch: run(batch), 3 if size > 1000 else 10)
            values, status, iterations = run(batch)
            few = {key: value[: min(size, 200)] for key, value in batch.items()}
            exact = batched(scene, TIGHT)(few)[0]
            rows["batch"][size] = {
                "seconds": seconds / size,
                "compile": compile_seconds,
                "failed": int(np.sum(np.asarray(status) != 0)),
                "error": error_of(values[: min(size, 200)], exact),
                "median_steps": float(np.median(iterations)),
                "max_steps": int(np.max(iterations)),
            }
        lanes = operations(1000)
        for method, vectorized in () if quick else (("map", False), ("vmap", True)):
            run = batched(scene, vectorized=vectorized).lower(lanes).compile()
            rows[method] = best_time(lambda run=run, lanes=lanes: run(lanes), 3) / 1000
        rows["scipy"] = scipy_rows(name, make, 4 if quick else 20)
        figures[name] = rows
    return figures


def print_table(figures):
    devices = f"{len(jax.devices())} x {jax.devices()[0].device_kind}"
    machine = f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"
    print(f"jax {jax.__version__}, {devices}, {machine}, float64, {time.strftime('%Y-%m-%d')}")
    for name, rows in figures.items():
        print(f"\n{name}: {rows['unknowns']} unknowns, power closure {rows['closure']:.1e}")
        print(f"  single solve: cold {rows['cold']:.2f} s (trace and compile), warm {1e3 * rows['warm']:.2f} ms")
        print("  batch    | ms a solve | error   | failed | steps median, max | compile s")
        for size, row in rows["batch"].items():
            print(
                f"  {size:8d} | {1e3 * row['seconds']:10.3f} | {row['error']:.1e} | {row['failed']:6d} | "
                f"{row['median_steps']:6.0f}, {row['max_steps']:3d}        | {row['compile']:.1f}"
            )
        if "map" in rows:
            print(f"  1000 cases: lax.map {1e3 * rows['map']:.3f}, vmap {1e3 * rows['vmap']:.3f} ms a solve")
        ours = rows["batch"][max(rows["batch"])]["seconds"]
        print("  scipy hybr, 94 unknowns           | ms an attempt | solved | error   | ratio to our largest batch")
        for (method, start), (seconds, solved, attempts, error) in rows["scipy"].items():
            label = f"{method}, from {start}"
            print(
                f"  {label:33s} | {1e3 * seconds:13.1f} | {solved:2d}/{attempts:2d}  | {error:.1e} | "
                f"{seconds / ours:6.0f}"
            )


if __name__ == "__main__":
    print_table(benchmark(arguments.quick))
