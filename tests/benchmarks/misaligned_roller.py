"""Laminae of tilting rollers, time AND error; and a profile optimised for life under misalignment.

    python tests/benchmarks/misaligned_roller.py

Table 1: load and moment of a fully touching, tilted contact by n laminae against the integral in closed form. Table 2:
`tapered_example` with straight rollers, closed form against laminae: time of a warm solve, error of the largest load.
Then the drop and the end ratio of a logarithmic profile for the longest reference life of a misaligned cylindrical
roller bearing, by BFGS on exact derivatives through the solve.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx
from benchmark_tools import best_time

import jaxbearing as jb
from jaxbearing.bearings.rating import Rating
from jaxbearing.bearings.roller_profile import RollerProfile
from jaxbearing.contacts import LogarithmicProfile, SlicedLine, StraightLine, palmgren_stiffness

COUNTS = (10, 30, 100)
MISALIGNMENT = 1.5e-3
START = (3e-6, 0.05)


def laminae_errors(f=2e-6, g=1e-3, length=9.6e-3):
    stiffness = palmgren_stiffness(length, 206e9 / 0.91)
    exact = np.array(StraightLine(stiffness, length).load_and_moment(f, g))
    return {
        n: np.abs(np.array(SlicedLine(stiffness, length, count=n).load_and_moment(f, g)) / exact - 1.0) for n in COUNTS
    }


def solve_rows():
    """Laminae (0: closed form) -> seconds a solve, relative error of the largest inner load."""
    scene = jb.load_scene("tapered_example").replace({"contact": None, "oil": None, "rating": None})
    scene = scene.replace({"operation.misalignment": 2e-3})
    rows, exact = {}, None
    for n in (0, *COUNTS):
        fast = jb.jit_solver(scene.replace({"profile": RollerProfile(None, n) if n else None}))
        load = float(jnp.max(fast().elements.load_inner))
        exact = load if exact is None else exact
        rows[n] = best_time(lambda fast=fast: jax.block_until_ready(fast()), 20), abs(load / exact - 1.0)
    return rows


def optimised_profile(misalignment=MISALIGNMENT, start=START):
    """Drop, m, and end ratio of the logarithmic profile with the longest life; lives, 10^6 revolutions, of the straight
    roller without edge factor, of the start and of the optimum; steps."""
    dry = dict.fromkeys(("contact", "oil", "cage", "flange", "drag"))
    rated = {**dry, "rating": Rating(edge_factor=False), "operation.misalignment": misalignment}
    scene = jb.load_scene("turbine_roller").replace({**rated, "profile": RollerProfile(LogarithmicProfile(*start))})

    def log_rate(numbers, _):
        """ln of the damage rate; numbers are ln(drop / 1 um) and the logit of the end ratio."""
        shape = {
            "profile.shape.drop": 1e-6 * jnp.exp(numbers[0]),
            "profile.shape.end_ratio": jax.nn.sigmoid(numbers[1]),
        }
        return jnp.log(jb.solve(scene.replace(shape), throw=False).life.damage_rate)

    first = jnp.asarray([np.log(start[0] / 1e-6), np.log(start[1] / (1.0 - start[1]))])
    found = optx.minimise(log_rate, optx.BFGS(rtol=1e-6, atol=1e-6), first, max_steps=60, throw=False)
    life = lambda numbers: float(jnp.exp(-log_rate(numbers, None)))
    straight = float(jb.solve(scene.replace({"profile": RollerProfile()})).life.L10r)
    drop, ratio = float(1e-6 * jnp.exp(found.value[0])), float(jax.nn.sigmoid(found.value[1]))
    slope = float(jnp.max(jnp.abs(jax.grad(log_rate)(found.value, None))))
    return {
        "drop": drop,
        "end_ratio": ratio,
        "straight": straight,
        "start": life(first),
        "optimum": life(found.value),
        "slope": slope,
        "steps": int(found.stats["num_steps"]),
    }


if __name__ == "__main__":
    print("laminae   error of Q   error of M    (full contact, closed form = 0)")
    for n, error in laminae_errors().items():
        print(f"{n:7d}   {error[0]:10.1e}   {error[1]:10.1e}")
    print("\nlaminae   us a solve   error of the largest load     (tapered_example, dry, 2 mrad)")
    for n, (seconds, error) in solve_rows().items():
        print(f"{n or 'exact':>7}   {1e6 * seconds:10.0f}   {error:10.1e}")
    begin = time.perf_counter()
    best = optimised_profile()
    print(f"\nlogarithmic profile at {1e3 * MISALIGNMENT} mrad, {time.perf_counter() - begin:.1f} s with compilation:")
    for name, value in best.items():
        print(f"  {name}: {value:.6g}")
