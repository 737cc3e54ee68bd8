"""Speed AND error of sweeps: cases a second by kind of bearing, devices and lanes a call, beside single solves.

    python tests/benchmarks/sweep.py [--quick] [--devices 2] [--cases 2000]

Prints one table. Wall times are of warm programs (the better of two), beside the processor time of all threads; "with
files" is the whole of `jaxbearing.sweep` but for its compilation, chunks and NetCDF file included. "single" is a warm
call of `jit_solver`, the mean over the first cases; the efficiency is single / (devices x time a case). The error is
the largest relative difference of the main result from those single solves; the last line of a scene says whether one
device and all give the same bits.
"""

import argparse
import os
import platform
import sys
import tempfile
import time
from pathlib import Path

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--quick", action="store_true", help="two dry bearings, 60 cases")
parser.add_argument("--devices", type=int, default=None, help="CPU devices (default: all cores)")
parser.add_argument("--cases", type=int, default=2000, help="cases of the quickest scene; fewer of the others")
arguments = parser.parse_args() if __name__ == "__main__" else parser.parse_args(["--quick"])
if __name__ == "__main__" and os.environ.get("JAX_PLATFORMS", "cpu") == "cpu":
    count = arguments.devices or os.cpu_count() or 1
    os.environ["XLA_FLAGS"] = f"{os.environ.get('XLA_FLAGS', '')} --xla_force_host_platform_device_count={count}"

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import jax  # noqa: E402
import numpy as np  # noqa: E402
from benchmark_tools import best_time, error_of  # noqa: E402

import jaxbearing as jb  # noqa: E402
from jaxbearing.lanes import LaneProgram  # noqa: E402
from jaxbearing.sweeps import latin_hypercube  # noqa: E402
from jaxbearing.sweeps.chunks import run_chunk  # noqa: E402
from jaxbearing.sweeps.engine import run  # noqa: E402
from jaxbearing.sweeps.plan import write_plan  # noqa: E402
from jaxbearing.sweeps.verb import plan_in_scene  # noqa: E402

RPM = 2 * np.pi / 60
POWER, SHIFT = (lambda s: s.power_loss.total), (lambda s: s.ring.radial)
CASES = {
    "reference_roller": (1.0, {"inner_speed": (1e3 * RPM, 2e4 * RPM), "radial_load": (1e3, 5e4)}, POWER),
    "turbine_roller": (0.1, {"inner_speed": (1e3 * RPM, 2e4 * RPM), "radial_load": (1e3, 5e4)}, POWER),
    "turbine_ball": (0.1, {"inner_speed": (5e3 * RPM, 1.5e4 * RPM), "axial_load": (5e3, 2e4)}, POWER),
    "tapered_example": (1.0, {"radial_load": (2e3, 8e3), "axial_load": (5e3, 1e4)}, SHIFT),
    "two_disk_etm": (0.02, {}, lambda s: s.traction_coefficient),
    "satellite_contact_1": (0.02, {"entrainment_speed": (0.05, 0.2)}, lambda s: s.film.central),
}
"""Scene -> part of the cases, ranges of its operation, main result."""
QUICK = {"reference_roller": CASES["reference_roller"][1], "deep_groove_6205": {"radial_load": (1e3, 5e3)}}


def ranges_of(name, ranges):
    """Dotted paths; a two-disk machine, whose operation is a family of curves, varies its radius."""
    if name.startswith("two_disk"):
        return {"geometry.reduced_radius_rolling": (5e-3, 2e-2)}
    return {f"operation.{field}": bounds for field, bounds in ranges.items()}


def row(scene, name, ranges, result, count, sizes, files=True):
    """All figures of a scene; without `files` none of a whole sweep."""
    cases = latin_hypercube(ranges_of(name, ranges), count, seed=1)
    inputs, active = cases.part(0, count), np.ones(count, dtype=bool)
    example = {path: values[0] for path, values in inputs.items()}
    few = min(count, 20)
    solver = jb.jit_solver(scene)
    scenes = [scene.replace({path: float(values[i]) for path, values in inputs.items()}) for i in range(few)]
    exact = [solver(one) for one in scenes]
    single = best_time(lambda: [result(solver(one)) for one in scenes], 3) / few
    figures, bits = {"single": single, "lanes": {}}, {}
    for devices in sorted({1, len(jax.devices())}):
        for lanes in sizes:
            program = LaneProgram(
                lambda base, values: base.replace(values), scene, example, lanes=lanes, devices=devices
            )
            begin = time.perf_counter()
            found = program(inputs, active)
            first = time.perf_counter() - begin
            busy = time.process_time()
            seconds = best_time(lambda program=program: program(inputs, active), 2) / count
            busy = (time.process_time() - busy) / 2 / count
            converged = np.all(np.asarray(found.status).reshape(count, -1) == 0, axis=1)
            good = [i for i in range(few) if bool(exact[i].converged)]
            values = np.asarray(result(found))[good]
            figures["lanes"][devices, lanes] = {
                "seconds": seconds,
                "first": first,
                "efficiency": single / (devices * seconds),
                "error": error_of(values, np.stack([np.asarray(result(exact[i])) for i in good])),
                "failed": int(np.sum(~converged)),
                "processor": busy,
            }
            bits.setdefault(lanes, set()).add(b"".join(leaf.tobytes() for leaf in jax.tree.leaves(found)))
    figures["same bits"] = all(len(alike) == 1 for alike in bits.values())
    if files:
        figures["files"] = with_files(scene, cases) / count
    return figures


def with_files(scene, cases):
    """Seconds of a whole sweep to a file, its program being compiled."""
    plan = plan_in_scene(scene, cases)
    with tempfile.TemporaryDirectory() as folder:
        inner = Path(folder) / "warm"
        inner.mkdir()
        write_plan(plan, inner)
        run_chunk(inner, 0, plan.key)  # compiles, in JAX's cache of this process
        begin = time.perf_counter()
        run(plan, Path(folder) / "sweep.nc", runner=_again(inner))
        return time.perf_counter() - begin


def _again(warm):
    """A runner whose chunks come from the program that is compiled already, written where they belong."""

    def runner(folder, plan, missing, progress):
        for index in missing:
            yield run_chunk(warm, index, plan.key, None, progress)
            (warm / f"chunk-{index:06d}.npz").replace(folder / f"chunk-{index:06d}.npz")

    return runner


def benchmark(quick, cases=2000):
    figures = {}
    if quick:
        for name, ranges in QUICK.items():
            result = POWER if name == "reference_roller" else SHIFT
            scene = jb.load_scene(name, {"contact": "none"} if name == "reference_roller" else {})
            figures[name] = row(scene, name, ranges, SHIFT if name == "reference_roller" else result, 60, (25,))
        return figures
    for name, (part, ranges, result) in CASES.items():
        sizes = (4,) if part < 0.05 else ((25, 125) if part < 0.5 else (25, 125, 500))
        count = max(16, int(part * cases))
        figures[name] = row(jb.load_scene(name), name, ranges, result, count, sizes)
        print_rows(name, count, figures[name])
    return figures


def print_head():
    devices = f"{len(jax.devices())} x {jax.devices()[0].device_kind}"
    machine = f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores"
    print(f"jax {jax.__version__}, {devices}, {machine}, float64, {time.strftime('%Y-%m-%d')}")
    columns = "scene                | cases | devices | lanes | cases/s | ms a case | processor ms | efficiency | error"
    print(f"{columns}   | failed | first s", flush=True)


def print_rows(name, count, figures):
    for (devices, lanes), one in figures["lanes"].items():
        print(
            f"{name:20s} | {count:5d} | {devices:7d} | {lanes:5d} | {1 / one['seconds']:7.0f} | "
            f"{1e3 * one['seconds']:9.3f} | {1e3 * one['processor']:12.3f} | {one['efficiency']:10.2f} | "
            f"{one['error']:.1e} | {one['failed']:6d} | "
            f"{one['first']:.1f}"
        )
    bits = "the same bits on any number of devices" if figures["same bits"] else "bits that differ"
    single, files = 1e3 * figures["single"], 1e3 * figures["files"]
    print(f"{name:20s} | single {single:.3f} ms, with files {files:.3f} ms a case, {bits}", flush=True)


if __name__ == "__main__":
    print_head()
    found = benchmark(arguments.quick, arguments.cases)
    if arguments.quick:
        for name, one in found.items():
            print_rows(name, 60, one)
