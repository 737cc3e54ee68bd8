"""Speed and error of the line contact's field solver, beside a Newton with the Jacobian by `jax.jacfwd`.

    python tests/benchmarks/line_contact.py [--quick]

Steady films of `satellite_contact_1` on meshes of 101 to 801 nodes: time of a solve from cold (nested start), error
against Richardson's extrapolation of 801 and 1601 nodes (spec), time of one Newton step, of one step with a dense
Jacobian by forward mode over all unknowns and LAPACK's LU (the rival), the stop in 10 ms, and 64 contacts at once.
"""

import argparse
import os
import platform
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from benchmark_tools import best_time
from line_contacts import satellite

import jaxbearing as jb
from jaxbearing.ehl import FilmSimulation
from jaxbearing.ehl.equations import film_shape, reynolds_residual
from jaxbearing.ehl.linear import as_point, linearize
from jaxbearing.ehl.mesh import mesh
from jaxbearing.ehl.solution import solve_line_contact
from jaxbearing.ehl.steady import hertz_guess
from jaxbearing.numerics.dense import solve_dense
from jaxbearing.time_laws import LinearRamp

EXACT = (0.0511036e-6, 0.0383105e-6)
"""Central and minimum film of condition 1, m."""


def newton_step(nodes, dense):
    """One step from Hertz's pressure: with our Jacobian and solver, or with `jax.jacfwd` and LAPACK."""
    scene = jax.tree.map(jnp.asarray, satellite(1, nodes))
    grid, scales = mesh(scene.steady_mesh), scene.scales()
    problem = scene.steady(scales, 1.0)
    equations, point = problem.equations(nodes), hertz_guess(problem.start, grid)

    def ours(equations, point):
        found = linearize(equations, point, grid)
        return solve_dense(found.matrix, found.rows)

    def rows(values, equations, cavitated):
        at = as_point(values)
        residual = reynolds_residual(equations, at.pressure, film_shape(at, grid), grid)
        load = jnp.sum(jnp.asarray(grid.weight) * values[:-1]) - 0.5 * jnp.pi
        return jnp.concatenate([jnp.where(cavitated, values[:-1], -residual), load[None]])

    def rival(equations, point):
        values = jnp.concatenate([point.pressure[1:-1], point.offset[None]])
        cavitated = jnp.asarray(np.abs(grid.x[1:-1]) > 1.3)
        matrix = jax.jacfwd(rows)(values, equations, cavitated)
        return jnp.linalg.solve(matrix, rows(values, equations, cavitated))

    run = eqx.filter_jit(rival if dense else ours)
    return lambda: run(equations, point)


def steady_rows(sizes, repeats):
    """nodes -> seconds to compile, seconds a solve, Newton steps, errors, seconds a step (ours, rival)."""
    rows = {}
    for nodes in sizes:
        scene = jax.tree.map(jnp.asarray, satellite(1, nodes))
        run = eqx.filter_jit(solve_line_contact)
        start = time.perf_counter()
        solution = jax.block_until_ready(run(scene))
        first = time.perf_counter() - start
        found = (float(solution.film.central), float(solution.film.minimum))
        steps = []
        for dense in (False, True):
            step = newton_step(nodes, dense)
            jax.block_until_ready(step())
            steps.append(best_time(step, repeats))
        rows[nodes] = {
            "compile": first,
            "seconds": best_time(lambda run=run, scene=scene: run(scene), repeats),
            "iterations": int(solution.iterations),
            "error": [value / exact - 1.0 for value, exact in zip(found, EXACT, strict=True)],
            "step": steps,
        }
    return rows


def stop_rows(sizes, repeats):
    """(nodes, law) -> seconds, steps, rejected, Newton steps, balance of mass."""
    rows = {}
    laws = {"at once": LinearRamp(1.0, 0.0, 0.0), "8 ms ramp": LinearRamp(1.0, 0.0, 8e-3)}
    for nodes in sizes:
        for name, law in laws.items():
            scene, chosen = satellite(1, nodes), FilmSimulation(speed=law)
            jb.simulate(scene, 10e-3, simulation=chosen)
            seconds = np.inf
            for _ in range(repeats):
                start = time.perf_counter()
                history = jb.simulate(scene, 10e-3, simulation=chosen)
                seconds = min(seconds, time.perf_counter() - start)
            counts = (int(history.accepted), int(history.rejected), int(history.newton_steps))
            rows[nodes, name] = {"seconds": seconds, "counts": counts, "balance": float(history.mass_balance)}
    return rows


def batch_rows(nodes, size, repeats):
    """Seconds for so many contacts at speeds from 2 to 200 mm/s: by vmap, and one after the other in one program."""
    scene = jax.tree.map(jnp.asarray, satellite(1, nodes))
    speeds = jnp.geomspace(2e-3, 0.2, size)
    one = lambda speed: solve_line_contact(scene.at_operation(entrainment_speed=speed)).film.central
    found = {}
    for name, run in (("vmap", jax.jit(jax.vmap(one))), ("lax.map", jax.jit(lambda u: jax.lax.map(one, u)))):
        films = jax.block_until_ready(run(speeds))
        found[name] = {
            "seconds": best_time(lambda run=run: run(speeds), repeats),
            "failed": int(jnp.sum(~jnp.isfinite(films))),
        }
    return found


def benchmark(quick):
    sizes, repeats = ((101, 201), 3) if quick else ((101, 201, 401, 801), 10)
    return {
        "steady": steady_rows(sizes, repeats),
        "stop": stop_rows((101,) if quick else (201, 401), 1 if quick else 3),
        "batch": batch_rows(101 if quick else 201, 8 if quick else 64, 1 if quick else 3),
    }


def print_table(figures):
    machine = f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"
    print(f"jax {jax.__version__}, {jax.devices()[0].device_kind}, {machine}, float64, {time.strftime('%Y-%m-%d')}")
    print("\nsteady, from cold: error of central and minimum film, time of a Newton step: ours, jacfwd and LAPACK")
    print("nodes | first s | warm ms | steps | error                  | ms a step")
    for nodes, row in figures["steady"].items():
        errors = ", ".join(f"{100 * error:+.3f} %" for error in row["error"])
        steps = ", ".join(f"{1e3 * value:.2f}" for value in row["step"])
        times = f"{row['compile']:7.2f} | {1e3 * row['seconds']:7.2f}"
        print(f"{nodes:5d} | {times} | {row['iterations']:5d} | {errors:>22s} | {steps}")
    print("\nstop, 10 ms\nnodes law       | warm s | steps (more tried), Newton steps | balance of mass")
    for (nodes, name), row in figures["stop"].items():
        a, b, c = row["counts"]
        print(f"{nodes:5d} {name:9s} | {row['seconds']:6.3f} | {a} ({b}), {c} | {row['balance']:.1e}")
    print("\nbatch of contacts | s | failed")
    for name, row in figures["batch"].items():
        print(f"{name:17s} | {row['seconds']:.3f} | {row['failed']}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="smaller, for the tests")
    print_table(benchmark(parser.parse_args().quick))
