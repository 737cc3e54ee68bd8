"""Laminae of tilting rollers, time AND error; and a profile optimised for life under misalignment.

    python tests/benchmarks/misaligned_roller.py

Table 1: load and moment of a fully touching, tilted contact by n laminae against the integral in closed form. Table 2:
`tapered_example` with straight rollers, closed form against laminae: time of a warm solve, error of the largest load.
Then the example of docs/life.md: drop and end ratio of a logarithmic profile for the longest reference life of a
misaligned cylindrical roller bearing, by BFGS on exact derivatives through the solve.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import jax
import jax.numpy as jnp
import numpy as np
from benchmark_tools import best_time
from life_page import optimisation_example

import jaxbearing as jb
from jaxbearing.bearings.profile import RollerProfile
from jaxbearing.contacts import SlicedLine, StraightLine, palmgren_stiffness

COUNTS = (10, 30, 100)


def laminae_errors(f=2e-6, g=1e-3, length=9.6e-3):
    stiffness = palmgren_stiffness(length, 206e9 / 0.91)
    exact = np.array(StraightLine(stiffness, length).load_and_moment(f, g))
    return {
        n: np.abs(np.array(SlicedLine(stiffness, length, count=n).load_and_moment(f, g)) / exact - 1.0) for n in COUNTS
    }


def solve_rows():
    """Laminae (0: closed form) -> seconds a solve, relative error of the largest inner load."""
    scene = jb.load_scene("tapered_example").replace(dict.fromkeys(("contact", "rib", "drag", "oil", "rating")))
    scene = scene.replace({"operation.misalignment": 2e-3})
    rows, exact = {}, None
    for n in (0, *COUNTS):
        fast = jb.jit_solver(scene.replace({"profile": RollerProfile(None, n) if n else None}))
        load = float(jnp.max(fast().elements.load_inner))
        exact = load if exact is None else exact
        rows[n] = best_time(lambda fast=fast: jax.block_until_ready(fast()), 20), abs(load / exact - 1.0)
    return rows


if __name__ == "__main__":
    print("laminae   error of Q   error of M    (full contact, closed form = 0)")
    for n, error in laminae_errors().items():
        print(f"{n:7d}   {error[0]:10.1e}   {error[1]:10.1e}")
    print("\nlaminae   us a solve   error of the largest load     (tapered_example, dry, 2 mrad)")
    for n, (seconds, error) in solve_rows().items():
        print(f"{n or 'exact':>7}   {1e6 * seconds:10.0f}   {error:10.1e}")
    begin = time.perf_counter()
    printed = optimisation_example()[1]
    print(f"\nthe example of docs/life.md, {time.perf_counter() - begin:.1f} s with compilation:\n{printed}")
