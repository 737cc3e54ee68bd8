"""Cost AND error of the operating state: what seats and temperatures add to a solve.

    python tests/benchmarks/operating_state.py [--quick] [--only seats,temperatures,derivative] [--scenes TEXT]

`seats`: a bearing on its seats, cold, beside the bearing that runs, whose dimensions are given (`running_scene`): the
same equations with the same numbers; and the seats alone, without the solve. The error is the largest relative
difference of ring displacement and contact loads. `temperatures`: a bearing with a thermal network beside the same one
at the temperatures of its oil inlet; the error is the balance of heat that the state leaves open. `derivative`: the
first derivative of a bearing with a network, outside of `jax.jit`, with nothing kept from earlier processes; the error
is that against central differences.

Times are processor times of warm calls of `jit_solver` but for `derivative`. Both programs run in turn, in blocks of
calls, and the least of each counts: the ratio holds on a busy machine. A lane is one of many equal ones in
`jit(lax.map(solve))`, where arguments and results cost little; of a call each result costs about 1 us.
"""

import argparse
import dataclasses
import os
import sys
import tempfile
import time
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

import jax
import jax.numpy as jnp
import numpy as np
from warm_cases import warm

import jaxbearing as jb
from jaxbearing.bearings.mounted import running_scene

ROLLER_SEATS = {
    "geometry.bore": "118 mm",
    "geometry.outside_diameter": "166 mm",
    "fits.shaft_interference": "45 um",
    "fits.housing_interference": "5 um",
    "fits.shaft_bore": "95 mm",
    "fits.housing_outside": "190 mm",
}
SEATED = {
    "deep_groove_6205_fitted": {"temperatures": "none"},
    "deep_groove_6205_fitted, numbers": {
        "temperatures": "none",
        **dict.fromkeys(("fits.shaft_tolerance", "fits.housing_tolerance"), "none"),
        "fits.shaft_interference": "10 um",
        "fits.housing_interference": "4 um",
    },
    "reference_roller, seated": ROLLER_SEATS | {"contact": "none"},
    "turbine_ball_mounted": {"temperatures": "none"},
    "turbine_roller, seated": ROLLER_SEATS,
}
"""Scene, and after a comma what was changed in it -> changes."""
QUICK = ("deep_groove_6205_fitted",)
WARM = {
    "turbine_ball, four nodes": ("sliding ball", 4, {"fits": "none", "operation__oil_temperature": "100 degC"}),
    "turbine_ball_mounted, four nodes": ("sliding ball", 4, {"operation__oil_temperature": "100 degC"}),
    "turbine_roller, four nodes": (
        "sliding roller",
        4,
        {"operation__oil_temperature": "100 degC"},
    ),
    "turbine_roller, four nodes, oil of 60 degC, rolling resistance": ("sliding roller", 4, {}),
}
"""Name -> arguments of `warm_cases.warm`."""
RPM = 2.0 * np.pi / 60.0
BLOCK = 0.1
"""Processor time of a block of calls, s."""
BLOCKS = 15
LANES = 256


class Seats(NamedTuple):
    """Processor times of a call and of a lane of a batch, s, of the seated bearing and of the one that runs, and of a
    lane of the seats alone; lines of both programs; error."""

    seated: float
    running: float
    seated_lane: float
    running_lane: float
    alone_lane: float
    lines: tuple[int, int]
    error: float


class Warmed(NamedTuple):
    """Processor times of a coupled and of an isothermal solve, s; solves of the bearing in the first; its balance."""

    coupled: float
    isothermal: float
    solves: int
    balance: float


def in_turn(functions: list[Any], blocks: int = BLOCKS) -> list[float]:
    """Least processor time of a call of each function, s; all run in turn."""
    counts, best = [], [np.inf] * len(functions)
    for function in functions:
        jax.block_until_ready(function())
        begin = time.process_time()
        jax.block_until_ready(function())
        counts.append(max(1, round(BLOCK / max(time.process_time() - begin, 1e-6))))
    for _ in range(blocks):
        for place, (function, count) in enumerate(zip(functions, counts, strict=True)):
            begin = time.process_time()
            for _ in range(count):
                found = function()
            jax.block_until_ready(found)
            best[place] = min(best[place], (time.process_time() - begin) / count)
    return best


def solved(lane: Any) -> Any:
    """Results of a scene."""
    solution = jb.solve(lane, throw=False)
    return solution.ring, solution.elements.load_inner, solution.fit, solution.status


def on_seats(lane: Any) -> Any:
    """The dimensions of a bearing on its seats, without a solve."""
    running, fit, _ = running_scene(lane)
    return running.geometry, fit


def a_batch(scene: Any, lanes: int, one: Any = solved) -> Any:
    """A function that computes `one` of so many equal lanes. Every number of the scene is one of the lane, so that
    nothing is computed once for all."""
    many = jax.tree.map(lambda leaf: jnp.broadcast_to(jnp.asarray(leaf, float), (lanes,)), scene)
    numbers = lambda lane: jax.tree.map(jnp.asarray, one(lane))
    batch = jax.jit(lambda many: jax.lax.map(numbers, many))
    return lambda: batch(many)


def apart(first: Any, second: Any) -> float:
    """Largest difference of displacements and loads of two solutions, relative to the largest of their kind."""
    numbers = lambda solution: (
        np.stack([solution.ring.axial, solution.ring.radial]),
        np.stack([solution.elements.load_inner, solution.elements.load_outer]),
    )
    return max(
        float(np.max(np.abs(a - b)) / np.max(np.abs(b))) for a, b in zip(numbers(first), numbers(second), strict=True)
    )


def seats(name: str, lanes: int = LANES) -> Seats:
    scene = jb.load_scene(name.split(",")[0], SEATED[name])
    running = jax.tree.map(np.asarray, running_scene(scene)[0])
    both = [jb.jit_solver(one) for one in (scene, running)]
    solved = [solver() for solver in both]
    assert all(bool(one.converged) for one in solved), name
    seated, plain = in_turn(both)
    functions = [a_batch(scene, lanes), a_batch(running, lanes), a_batch(scene, lanes, on_seats)]
    batches = [value / lanes for value in in_turn(functions, 5)]
    lines = [jb.compile_report(one, compile=False).lines for one in (scene, running)]
    return Seats(seated, plain, *batches, (lines[0], lines[1]), apart(*solved))


def temperatures(name: str) -> Warmed:
    kind, nodes, changes = WARM[name]
    scene = warm(kind, nodes, **changes)
    cold = dataclasses.replace(scene, thermal=None)
    solvers = [jb.jit_solver(one) for one in (scene, cold)]
    solution = solvers[0]()
    assert bool(solution.converged), name
    coupled, isothermal = in_turn(solvers, 5)
    return Warmed(coupled, isothermal, int(solution.thermal.solves), abs(float(solution.thermal.balance_error)))


def derivative() -> tuple[float, float, float, float]:
    """Processor time of a first solve and of a first derivative after it, s; the derivative of the temperature of the
    inner ring by the speed of the inner ring, mK/rpm, and its relative error."""
    scene = jb.load_scene("deep_groove_6205_mounted")

    def temperature(speed: Any) -> Any:
        return jb.solve(scene.at_operation(inner_speed=speed)).thermal.temperatures.inner_ring

    at = float(scene.operation.inner_speed)
    begin = time.process_time()
    jax.block_until_ready(temperature(at))
    solved = time.process_time()
    slope = float(jax.grad(temperature)(jnp.asarray(at)))
    ended = time.process_time()
    step = 1e-3 * at
    differences = (float(temperature(at + step)) - float(temperature(at - step))) / (2.0 * step)
    return solved - begin, ended - solved, 1e3 * RPM * slope, abs(differences / slope - 1.0)


def _pair(before: float, after: float) -> str:
    return f"{1e3 * before:8.3f} -> {1e3 * after:8.3f} ({100.0 * (after / before - 1.0):+5.1f} %)"


def print_seats(name: str, one: Seats) -> None:
    call, lane = _pair(one.running, one.seated), _pair(one.running_lane, one.seated_lane)
    lines = f"{one.lines[1]} -> {one.lines[0]}"
    alone = f"{1e6 * one.alone_lane:6.1f} ({100.0 * one.alone_lane / one.running_lane:5.2f} %)"
    print(f"{name:33s} | {call} | {lane} | {alone:22s} | {lines:14s} | {one.error:.1e}", flush=True)


def print_temperatures(name: str, one: Warmed) -> None:
    ratio = one.coupled / one.isothermal
    print(
        f"{name:63s} | {1e3 * one.isothermal:8.2f} | {1e3 * one.coupled:8.2f} | {ratio:5.1f} | {one.solves:6d} | "
        f"{one.balance:.1e}",
        flush=True,
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="one dry bearing on its seats")
    parser.add_argument("--only", default="seats,temperatures,derivative", help="parts, with commas")
    parser.add_argument("--scenes", default="", help="only scenes whose name has this text")
    arguments = parser.parse_args()
    parts = ["seats"] if arguments.quick else arguments.only.split(",")
    print(f"jax {jax.__version__}, {os.cpu_count()} cores, float64, {time.strftime('%Y-%m-%d')}")
    if "seats" in parts:
        columns = f"{'ms a call, running -> seated':30s} | {'ms a lane of a batch':30s}"
        columns = f"{columns} | {'us a lane, seats alone':22s} | {'lines':14s} | error"
        print(f"{'seats':33s} | {columns}")
        for name in QUICK if arguments.quick else SEATED:
            if arguments.scenes in name:
                print_seats(name, seats(name))
    if "temperatures" in parts:
        print(f"{'temperatures':63s} | cold, ms | warm, ms | ratio | solves | balance")
        for name in WARM:
            if arguments.scenes in name:
                print_temperatures(name, temperatures(name))
    if "derivative" in parts:
        first, then, slope, error = derivative()
        said = f"first solve {first:.1f} s, first derivative {then:.1f} s of processor time"
        print(f"deep_groove_6205_mounted: {said}; {slope:.4g} mK/rpm, error {error:.1e}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as nothing:
        os.environ["JAXBEARING_CACHE"] = nothing
        main()
