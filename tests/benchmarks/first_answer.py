"""What a first answer costs: size of the programs, processor time of tracing and of compiling, quick and optimised, and
whole processes without and with kept programs.

    python tests/benchmarks/first_answer.py [--quick] [--against FOLDER] [--only programs|processes]

Lines of the lowered program and processor seconds hold on a busy machine as well, as far as anything does; wall seconds
stand beside them. With `--against`, the folder of another checkout of the project, each figure is measured of both, in
turn, and printed as "there -> here": `git worktree add FOLDER COMMIT` makes one.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]
SCENES = ("turbine_roller", "turbine_ball", "tapered_example", "reference_roller", "deep_groove_6205", "two_disk_etm")
PROGRAM = """
import gc, json, sys, time
gc.set_threshold(100_000, 20, 10)
import jax, numpy as np, jaxbearing as jb

name, repeats = sys.argv[1], int(sys.argv[2])
QUICK = {
    "xla_cpu_use_fusion_emitters": False,
    "xla_backend_optimization_level": 0,
    "xla_llvm_disable_expensive_passes": True,
    "xla_cpu_parallel_codegen_split_count": 4,
    "xla_disable_hlo_passes": "reshape-mover,simplify-while-loops,tree_reduction_rewriter,"
    "while-loop-constant-sinking,while-loop-invariant-code-motion",
}
is_number = lambda leaf: isinstance(leaf, (float, np.ndarray, np.generic, jax.Array))
leaves, structure = jax.tree.flatten(jb.load_scene(name))
places = [i for i, leaf in enumerate(leaves) if is_number(leaf)]
numbers = [np.asarray(leaves[i], dtype=float) for i in places]

def solve(numbers):
    given = list(leaves)
    for i, number in zip(places, numbers):
        given[i] = number
    solution = jb.solve(jax.tree.unflatten(structure, given), throw=False)
    found = jax.tree_util.tree_leaves_with_path(solution)
    # residuals are rounding
    is_result = lambda path, leaf: getattr(leaf, "dtype", None) == np.float64 and "residual" not in str(path)
    return [leaf for path, leaf in found if is_result(path, leaf)]

def run(compiled):
    begin = time.perf_counter()
    jax.block_until_ready(compiled(numbers))
    return time.perf_counter() - begin

def known(options):
    try:
        jax.jit(lambda: None).lower().compile(options)
    except Exception:
        return False
    return True

QUICK = {option: value for option, value in QUICK.items() if known({option: value})}
begin = time.process_time()
lowered = jax.jit(solve).lower(numbers)
traced, compiled, seconds, runs = time.process_time() - begin, [], [], []
for options in (None, QUICK):
    begin = time.process_time()
    compiled.append(lowered.compile(options))
    seconds.append(time.process_time() - begin)
    runs.append(min(run(compiled[-1]) for _ in range(repeats)))
difference = 0.0
for one, other in zip(*(map(np.asarray, program(numbers)) for program in compiled)):
    # what is 0 by symmetry is rounding, alone or in a matrix
    scale = np.nanmax(np.maximum(np.abs(one), np.abs(other)), initial=0.0)
    if scale > 1e-12:
        difference = max(difference, float(np.nanmax(np.abs(one - other), initial=0.0) / scale))
lines = len(lowered.as_text().splitlines())
print(json.dumps([lines, traced, *seconds, *runs, difference]))
"""
"""Of public names only: it measures other versions too."""
IN_PYTHON = "import sys, jaxbearing as jb\nprint(jb.solve(jb.load_scene(sys.argv[1])).status)"
GRADIENT = """
import sys, jax, jaxbearing as jb
scene = jb.load_scene(sys.argv[1])
slope = jax.grad(lambda d: jb.solve(scene.replace_geometry(pitch_diameter=d)).ring.radial)
ways = {
    "jit": lambda: jax.jit(slope),
    "quick": lambda: jax.jit(slope, compiler_options=jb.quick_compile_options()),
    "alone": lambda: slope,
}
print(ways[sys.argv[2]]()(0.05))
"""
CURVE = """\
slide_to_roll [%], traction_coefficient, pressure [GPa], temperature [degC]
0.1, 0.0083, 1.5, 40
0.2, 0.0107, 1.5, 40
0.5, 0.0142, 1.5, 40
1.0, 0.0161, 1.5, 40
2.0, 0.0185, 1.5, 40
5.0, 0.0207, 1.5, 40
"""


class Program(NamedTuple):
    """Of one solve: lines lowered; processor seconds of tracing and lowering, and of compiling in both ways; run, s;
    largest difference of a result of the two programs, over its largest entry."""

    lines: int
    traced: float
    optimised: float
    quick: float
    run_optimised: float
    run_quick: float
    difference: float


class Process(NamedTuple):
    """Wall and processor seconds of a process, its largest memory, GB; whether it ended well."""

    wall: float
    processor: float
    memory: float
    well: bool


def program(name: str, repeats: int = 5, root: Path = ROOT) -> Program:
    """Measures the program of a scene of a checkout, in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, name, str(repeats)],
        env=_variables("off", root),
        cwd=root,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"{name}: {done.stderr}")
    return Program(*json.loads(done.stdout.splitlines()[-1]))


def process(arguments: list[str], cache: str, root: Path = ROOT) -> Process:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "curves.csv").write_text(CURVE)
        begin = time.perf_counter()
        running = subprocess.Popen(
            [sys.executable, *arguments],
            env=_variables(cache, root),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=folder,
        )
        _, status, used = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
        wall = time.perf_counter() - begin
    return Process(wall, used.ru_utime + used.ru_stime, used.ru_maxrss / 1e6, running.returncode == 0)


def _variables(cache: str, root: Path) -> dict[str, str]:
    variables = os.environ | {"JAXBEARING_CACHE": cache, "PYTHONPATH": str(root), "JAX_PLATFORMS": "cpu"}
    for name in ("JAX_DISABLE_MOST_OPTIMIZATIONS", "XLA_FLAGS", "JAX_COMPILATION_CACHE_DIR"):
        variables.pop(name, None)
    return variables


def processes(quick: bool = False) -> dict[str, list[str]]:
    """Arguments of Python by what is asked."""
    solved = ("deep_groove_6205",) if quick else ("turbine_roller", "turbine_ball", "deep_groove_6205")
    command = lambda *words: ["-m", "jaxbearing", *words]
    found = {f"jaxbearing solve {name}": command("solve", name, "--json") for name in solved}
    found |= {f"first jb.solve, {name}": ["-c", IN_PYTHON, name] for name in solved}
    if quick:
        return found
    machine = ("--scene", "two_disk_mobil_jet_ii", "--set", "operation.entrainment_speed=20 m/s", "--out", "oil.toml")
    return found | {
        "first jit(grad), deep_groove_6205": ["-c", GRADIENT, "deep_groove_6205", "jit"],
        "the same, quick options": ["-c", GRADIENT, "deep_groove_6205", "quick"],
        "first grad, deep_groove_6205": ["-c", GRADIENT, "deep_groove_6205", "alone"],
        "--sensitivities, turbine_ball": command("solve", "turbine_ball", "--sensitivities", "--json"),
        "simulate, 1 ms": command("simulate", "turbine_roller_dynamic", "--duration", "1 ms", "--json"),
        "sweep, 10 tapered cases": command(
            "sweep", "tapered_example", "--out", "a.nc", "--over", "operation.radial_load=4 kN:5 kN:10"
        ),
        "fit, 6 points": command("fit", "curves.csv", *machine),
    }


def cold_and_warm(arguments: list[str], root: Path = ROOT) -> tuple[Process, Process]:
    with tempfile.TemporaryDirectory() as cache:
        return process(arguments, cache, root), process(arguments, cache, root)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="the smallest programs only")
    parser.add_argument("--against", type=Path, metavar="FOLDER", help="another checkout, measured beside this one")
    parser.add_argument("--only", choices=("programs", "processes"))
    parser.add_argument("--scenes", default=",".join(SCENES), help="of the programs")
    given = parser.parse_args()
    roots = [ROOT] if given.against is None else [given.against.resolve(), ROOT]
    if given.only != "processes":
        _print_programs(SCENES[-1:] if given.quick else given.scenes.split(","), roots)
    if given.only != "programs":
        _print_processes(given.quick, roots)


def _print_programs(names: Sequence[str], roots: list[Path]) -> None:
    print("| scene | lines lowered | CPU s: trace, lower | compile | compile quickly | run, ms | quick | difference |")
    print("|---" * 8 + "|")
    for name in names:
        found = [program(name, root=root) for root in roots]
        figures = [_beside([str(one.lines) for one in found])]
        figures += [_beside([f"{one[i]:.1f}" for one in found]) for i in (1, 2, 3)]
        figures += [_beside([f"{1e3 * one[i]:.2f}" for one in found]) for i in (4, 5)]
        figures += [_beside([f"{one.difference:.0e}" for one in found])]
        print("|", " | ".join([name, *figures]), "|", flush=True)


def _print_processes(quick: bool, roots: list[Path]) -> None:
    print("\n| process | CPU s without kept programs | with them | wall s without | with | GB without |")
    print("|---" * 6 + "|")
    for name, arguments in processes(quick).items():
        both = [cold_and_warm(arguments, root) for root in roots]
        figures = [_beside([f"{one[i].processor:.1f}" for one in both]) for i in (0, 1)]
        figures += [_beside([f"{one[i].wall:.1f}" for one in both]) for i in (0, 1)]
        figures += [_beside([f"{one[0].memory:.1f}" for one in both])]
        failed = "" if all(run.well for one in both for run in one) else " FAILED"
        print("|", " | ".join([name + failed, *figures]), "|", flush=True)


def _beside(figures: list[str]) -> str:
    return " -> ".join(figures)


if __name__ == "__main__":
    main()
