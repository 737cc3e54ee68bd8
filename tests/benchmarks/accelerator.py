"""A batch of solves on a GPU beside one core of the same machine's CPU: compile time, time a lane, error, failed lanes.

    python tests/benchmarks/accelerator.py [--lanes 100,1000,10000] [--scenes deep_groove_6205,reference_roller]

Each row has two processes: one with JAX's default device, one with the CPU alone, where the package solves the lanes of
a batch in turn. Lanes are the random operating points of `batches.py`, every fiftieth of which fails. The error is the
largest relative difference between both in displacements and loads of the rolling elements, of lanes that converged.
Without a GPU both columns are the CPU, and the table says so.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from batches import LOADS, SPEED, operating_points

import jaxbearing as jb

SCENES = ("deep_groove_6205", "reference_roller", "turbine_roller")
REPEATS = 3


def child(name: str, lanes: int, differentiate: bool, out: Path) -> None:
    """Measures one scene on the default device; writes numbers and results."""
    scene = jb.load_scene(name)
    given = {key: getattr(scene.operation, key, None) for key in LOADS}
    loads = {key: value for key, value in given.items() if value is not None}

    def results(point: dict[str, Any]) -> dict[str, Any]:
        changes = {key: value * point["load"] for key, value in loads.items()}
        changes[SPEED] = scene.operation.inner_speed * point["speed"]
        solution = jb.solve(scene.at_operation(**changes), throw=False)
        ring = solution.ring
        moved = jnp.stack([ring.axial, ring.radial, ring.tilt])
        return {"moved": moved, "load": solution.elements.load_inner, "status": solution.status}

    def slope(point: dict[str, Any]) -> dict[str, Any]:
        def total(load: Any) -> tuple[Any, Any]:
            found = results(point | {"load": load})
            return jnp.sum(found["moved"][:2]), found["status"]

        slope, status = jax.grad(total, has_aux=True)(point["load"])
        return {"slope": slope, "status": status}

    points = {key: jnp.asarray(value) for key, value in operating_points(scene, lanes).items()}
    begin = time.perf_counter()
    run = jax.jit(jax.vmap(slope if differentiate else results)).lower(points).compile()
    compiled = time.perf_counter() - begin
    times = []
    for _ in range(REPEATS + 1):
        begin = time.perf_counter()
        found = jax.block_until_ready(run(points))
        times.append(time.perf_counter() - begin)
    device = jax.devices()[0]
    np.savez(out, **jax.tree.map(np.asarray, found))
    print(json.dumps({"device": device.device_kind, "compile": compiled, "lane": min(times[1:]) / lanes}))


def measured(name: str, lanes: int, differentiate: bool, platform: str | None) -> tuple[dict[str, Any], Any]:
    """Figures and results of a process of its own. **Arguments:** `platform`: of JAX; its own choice if not given."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "found.npz"
        surroundings = {key: value for key, value in os.environ.items() if key != "JAX_PLATFORMS"}
        if platform:
            surroundings["JAX_PLATFORMS"] = platform
        command = [sys.executable, __file__, "--child", name, "--lanes", str(lanes), "--out", str(out)]
        command += ["--differentiate"] * differentiate
        done = subprocess.run(command, env=surroundings, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{name} on {platform or 'the default device'} failed:\n{done.stderr[-4000:]}")
        with np.load(out) as found:
            return json.loads(done.stdout.splitlines()[-1]), dict(found)


def error(ours: dict[str, np.ndarray], theirs: dict[str, np.ndarray]) -> float:
    """Largest difference over the largest number of the same kind in its lane."""
    worst = 0.0
    for key in set(ours) - {"status"}:
        one, other = (np.atleast_2d(found[key].reshape(len(found[key]), -1)) for found in (ours, theirs))
        good = theirs["status"] == 0
        scale = np.abs(other[good]).max(axis=1)
        worst = max(worst, float((np.abs(one[good] - other[good]).max(axis=1) / scale).max()))
    return worst


def row(name: str, lanes: int, differentiate: bool) -> str:
    (ours, found), (cpu, expected) = (measured(name, lanes, differentiate, on) for on in (None, "cpu"))
    failed = ", ".join(str((one["status"] != 0).sum()) for one in (found, expected))
    return (
        f"| {name}{', derivative' * differentiate}, {lanes} | {ours['device']} | {ours['compile']:.0f}, "
        f"{cpu['compile']:.0f} | {1e3 * ours['lane']:.3g} | {1e3 * cpu['lane']:.3g} | "
        f"{cpu['lane'] / ours['lane']:.1f} | {failed} | {error(found, expected):.0e} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lanes", default="1000,10000")
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--derivatives", action="store_true", help="rows with the derivative by a factor of the loads")
    parser.add_argument("--child", help=argparse.SUPPRESS)
    parser.add_argument("--out", type=Path, help=argparse.SUPPRESS)
    parser.add_argument("--differentiate", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.child:
        child(given.child, int(given.lanes), given.differentiate, given.out)
        return
    print("| scene, lanes | device | compile, s: it, CPU | it, ms a lane | one CPU core, ms a lane | ratio | ", end="")
    print("failed: it, CPU | error |")
    print("|---" * 8 + "|")
    for name in given.scenes.split(","):
        for lanes in map(int, given.lanes.split(",")):
            for differentiate in (False, True)[: 1 + given.derivatives]:
                print(row(name, lanes, differentiate), flush=True)


if __name__ == "__main__":
    main()
