"""What a first answer costs: size of the programs, processor time of tracing and of compiling, quick and optimised, and
whole processes without and with kept programs.

    python tests/benchmarks/first_answer.py [--quick]

Lines of the lowered program and processor seconds hold on a busy machine as well, as far as anything does; wall seconds
stand beside them.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

import equinox as eqx
import jax
import numpy as np

import jaxbearing as jb
from jaxbearing.numerics.compiling import quick_options
from jaxbearing.numerics.garbage import collecting_rarely
from jaxbearing.numerics.newton import NewtonOptions
from jaxbearing.numerics.precision import as_float

ROOT = Path(__file__).parents[2]
SCENES = ("turbine_roller", "turbine_ball", "tapered_example", "reference_roller", "deep_groove_6205", "two_disk_etm")
SOLVED = sys.modules["jaxbearing.solve"]
SENSITIVE = ("turbine_ball",)
IN_PYTHON = "import sys, jaxbearing as jb\nprint(jb.solve(jb.load_scene(sys.argv[1])).status)"
GRADIENT = """
import sys, jax, jaxbearing as jb
scene = jb.load_scene(sys.argv[1])
print(jax.jit(jax.grad(lambda d: jb.solve(scene.replace_geometry(pitch_diameter=d)).ring.radial))(0.05))
"""


class Program(NamedTuple):
    """Of one solve: lines lowered; processor seconds of tracing and lowering, and of compiling in both ways; run, s;
    largest relative difference of a number of the two programs."""

    lines: int
    traced: float
    optimised: float
    quick: float
    run_optimised: float
    run_quick: float
    difference: float


def program(name: str, repeats: int = 5) -> Program:
    numbers, structure = jax.tree.flatten(jax.tree.map(as_float, jb.load_scene(name)))

    def solve(given):
        solution = SOLVED._solve_any(jax.tree.unflatten(structure, given), NewtonOptions())
        return [leaf for leaf in jax.tree.leaves(solution) if eqx.is_inexact_array(leaf)]

    with collecting_rarely():
        begin = time.process_time()
        lowered = jax.jit(solve).lower(numbers)
        traced = time.process_time() - begin
        compiled, seconds, runs = [], [], []
        for options in (None, quick_options()):
            begin = time.process_time()
            compiled.append(lowered.compile(options))
            seconds.append(time.process_time() - begin)
            runs.append(min(_run(compiled[-1], numbers) for _ in range(repeats)))
    one, other = (np.concatenate([np.ravel(leaf) for leaf in solved(numbers)]) for solved in compiled)
    scale = np.maximum(np.abs(one), np.abs(other))
    difference = np.abs(one - other)[scale > 1e-12] / scale[scale > 1e-12]
    lines = len(lowered.as_text().splitlines())
    return Program(lines, traced, *seconds, *runs, float(np.nanmax(difference, initial=0.0)))


def _run(compiled, numbers) -> float:
    begin = time.perf_counter()
    jax.block_until_ready(compiled(numbers))
    return time.perf_counter() - begin


class Process(NamedTuple):
    """Wall and processor seconds of a process; whether it ended well."""

    wall: float
    processor: float
    well: bool


def process(arguments: list[str], cache: str) -> Process:
    variables = os.environ | {"JAXBEARING_CACHE": cache, "PYTHONPATH": str(ROOT), "JAX_PLATFORMS": "cpu"}
    for name in ("JAX_DISABLE_MOST_OPTIMIZATIONS", "XLA_FLAGS", "JAX_COMPILATION_CACHE_DIR"):
        variables.pop(name, None)
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, *arguments], env=variables, capture_output=True, cwd=folder, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Process(time.perf_counter() - begin, spent, done.returncode == 0)


def processes(quick: bool = False) -> dict[str, list[str]]:
    """Arguments of Python by what is asked."""
    solved = ("deep_groove_6205",) if quick else ("turbine_roller", "turbine_ball", "deep_groove_6205")
    found = {f"jaxbearing solve {name}": ["-m", "jaxbearing", "solve", name, "--json"] for name in solved}
    found |= {f"first jb.solve, {name}": ["-c", IN_PYTHON, name] for name in solved}
    if quick:
        return found
    sensitive = ["-m", "jaxbearing", "solve", "turbine_ball", "--sensitivities", "--json"]
    run = ["-m", "jaxbearing", "simulate", "turbine_roller_dynamic", "--duration", "1 ms", "--json"]
    sweep = ["-m", "jaxbearing", "sweep", "tapered_example", "--out", "a.nc"]
    return found | {
        "first jit(grad), deep_groove_6205": ["-c", GRADIENT, "deep_groove_6205"],
        "--sensitivities, turbine_ball": sensitive,
        "simulate, 1 ms": run,
        "sweep, 10 tapered cases": [*sweep, "--over", "operation.radial_load=4 kN:5 kN:10"],
    }


def cold_and_warm(arguments: list[str]) -> tuple[Process, Process]:
    with tempfile.TemporaryDirectory() as cache:
        return process(arguments, cache), process(arguments, cache)


def main() -> None:
    quick = "--quick" in sys.argv
    print("scene: lines lowered; CPU s: trace + lower, compile, compile quickly; run ms, quick run ms; difference")
    for name in SCENES[-1:] if quick else SCENES:
        found = program(name)
        print(
            f"{name}: {found.lines}; {found.traced:.1f}, {found.optimised:.1f}, {found.quick:.1f}; "
            f"{1e3 * found.run_optimised:.2f}, {1e3 * found.run_quick:.2f}; {found.difference:.0e}"
        )
    print("process: CPU s without kept programs, with them; wall s, the same two")
    for name, arguments in processes(quick).items():
        cold, warm = cold_and_warm(arguments)
        failed = "" if cold.well and warm.well else " FAILED"
        print(f"{name}: {cold.processor:.1f}, {warm.processor:.1f}; {cold.wall:.1f}, {warm.wall:.1f}{failed}")


if __name__ == "__main__":
    main()
