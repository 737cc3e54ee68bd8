"""`jax.vmap` of a solve beside `jax.lax.map`: time a lane, error against single solves, failed lanes, derivatives.

    python tests/benchmarks/batches.py [--lanes 100,1000] [--scenes turbine_ball,tapered_example] [--repeats 3]

Lanes are random operating points: loads of 0.2 to 2 times and speeds of 0.3 to 1.5 times those of the scene; every
fiftieth lane has a load that is not a number, and fails. Both programs run in turn, in one process: the ratio holds on
a busy machine. The derivative is that of the ring's displacement by a common factor of the loads, in reverse and in
forward mode.
"""

import argparse
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

import jaxbearing as jb

SCENES = ("deep_groove_6205", "turbine_ball", "turbine_roller", "reference_roller", "tapered_example")
LOADS, SPEED = ("axial_load", "radial_load", "moment"), "inner_speed"
EVERY = 50
"""Of so many lanes one fails."""
SINGLE = 10
"""Lanes that are solved alone as well."""
STEP = 1e-4
"""Of the central differences."""


class Batch(NamedTuple):
    """Time a lane of both programs, s; Newton steps, mean and most; lanes that failed, of either program alike;
    largest relative difference from single solves; the same times with derivatives, and the largest difference of these
    in both modes from each other and from central differences."""

    mapped: float
    batched: float
    steps: tuple[float, int]
    failed: int
    error: float
    mapped_slope: float
    batched_slope: float
    modes: float
    differences: float


def operating_points(scene: Any, lanes: int, seed: int = 0) -> dict[str, np.ndarray]:
    """Factors of loads and speed."""
    rng = np.random.default_rng(seed)
    factors = {"load": 10.0 ** rng.uniform(np.log10(0.2), np.log10(2.0), lanes), "speed": rng.uniform(0.3, 1.5, lanes)}
    factors["load"][EVERY - 1 :: EVERY] = np.nan
    return factors


def measured(name: str, lanes: int, repeats: int = 3) -> Batch:
    scene = jb.load_scene(name)
    given = {key: getattr(scene.operation, key, None) for key in LOADS}
    loads = {key: value for key, value in given.items() if value is not None}

    def solved(point: dict[str, Any]) -> Any:
        changes = {key: value * point["load"] for key, value in loads.items()}
        speed = {SPEED: scene.operation.inner_speed * point["speed"]}
        return jb.solve(scene.at_operation(**changes, **speed), throw=False)

    def results(point: dict[str, Any]) -> dict[str, Any]:
        solution = solved(point)
        ring = solution.ring
        return {
            "moved": jnp.stack([ring.axial, ring.radial, ring.tilt]),
            "load": solution.elements.load_inner,
            "status": solution.status,
            "steps": solution.iterations,
        }

    def moved(point: dict[str, Any]) -> Any:
        ring = solved(point).ring
        return ring.axial + ring.radial

    def slope(point: dict[str, Any]) -> Any:
        return jax.grad(lambda load: moved(point | {"load": load}))(point["load"])

    def push(point: dict[str, Any]) -> Any:
        return jax.jvp(lambda load: moved(point | {"load": load}), (point["load"],), (jnp.ones(()),))[1]

    points = {key: jnp.asarray(value) for key, value in operating_points(scene, lanes).items()}
    mapped, batched = (jax.jit(lambda p, over=over: over(results, p)) for over in (_mapped, _batched))
    both = [jax.tree.map(np.asarray, run(points)) for run in (mapped, batched)]
    for name in ("moved", "load", "status"):  # rounding may take a lane one step more or less
        np.testing.assert_allclose(both[0][name], both[1][name], rtol=1e-8, atol=1e-12)
    found, good = both[1], both[1]["status"] == 0
    alone = np.flatnonzero(good)[:SINGLE]
    error = max(_error(scene_results, found, i) for i, scene_results in _alone(results, points, alone))
    slopes = [jax.jit(lambda p, over=over: over(slope, p)) for over in (_mapped, _batched)]
    reverse = np.asarray(slopes[1](points))
    forward = np.asarray(jax.jit(lambda p: _batched(push, p))(points))
    ring = lambda factor: np.sum(batched(points | {"load": points["load"] * factor})["moved"][:, :2], axis=1)
    central = (ring(1.0 + STEP) - ring(1.0 - STEP)) / (2.0 * STEP * np.asarray(points["load"]))
    scale = np.maximum(np.abs(reverse), 1e-3 * np.nanmedian(np.abs(reverse)))
    times = _times([mapped, batched, *slopes], points, repeats)
    return Batch(
        times[0] / lanes,
        times[1] / lanes,
        (float(found["steps"][good].mean()), int(found["steps"][good].max())),
        int((~good).sum()),
        error,
        times[2] / lanes,
        times[3] / lanes,
        float(np.nanmax(np.abs(forward - reverse) / scale)),
        float(np.nanmax((np.abs(central - reverse) / scale)[good])),
    )


def _mapped(function: Callable, points: Any) -> Any:
    return jax.lax.map(function, points)


def _batched(function: Callable, points: Any) -> Any:
    return jax.vmap(function)(points)


def _alone(function: Callable, points: dict[str, Any], lanes: np.ndarray) -> list[tuple[int, Any]]:
    single = jax.jit(function)
    return [(i, jax.tree.map(np.asarray, single({key: value[i] for key, value in points.items()}))) for i in lanes]


def _error(single: Any, batch: Any, lane: int) -> float:
    largest = lambda name: np.max(np.abs(single[name] - batch[name][lane])) / np.max(np.abs(single[name]))
    return float(max(largest("moved"), largest("load")))


def _times(runs: list[Callable], points: Any, repeats: int) -> list[float]:
    """The best of several each, in turn; compiled before."""
    best = [np.inf] * len(runs)
    for turn in range(repeats + 1):
        for i, run in enumerate(runs):
            begin = time.perf_counter()
            jax.block_until_ready(run(points))
            best[i] = min(best[i], time.perf_counter() - begin) if turn else best[i]
    return best


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lanes", default="100,1000")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--scenes", default=",".join(SCENES))
    given = parser.parse_args()
    print("| scene, lanes | steps mean, most | failed | lax.map, ms | vmap, ms | ratio | error | ", end="")
    print("grad: lax.map, ms | vmap, ms | ratio | modes | differences |")
    print("|---" * 12 + "|")
    for name in given.scenes.split(","):
        for lanes in map(int, given.lanes.split(",")):
            b = measured(name, lanes, given.repeats)
            print(
                f"| {name}, {lanes} | {b.steps[0]:.1f}, {b.steps[1]} | {b.failed} | {1e3 * b.mapped:.3g} | "
                f"{1e3 * b.batched:.3g} | {b.batched / b.mapped:.2f} | {b.error:.0e} | {1e3 * b.mapped_slope:.3g} | "
                f"{1e3 * b.batched_slope:.3g} | {b.batched_slope / b.mapped_slope:.2f} | {b.modes:.0e} | "
                f"{b.differences:.0e} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
