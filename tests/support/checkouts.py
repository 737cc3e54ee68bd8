"""The guard of a refactoring: what two checkouts of the package compute, compared.

    python tests/support/checkouts.py OLD NEW                    # every built-in scene
    python tests/support/checkouts.py OLD NEW --only SCENE ...   # some of them
    python tests/support/checkouts.py OLD NEW --sensitivities    # first derivatives of the results by all inputs
    python tests/support/checkouts.py OLD NEW --runs             # transient runs of the moving bearings
    python tests/support/checkouts.py OLD NEW --random 100       # so many random scenes of each structure

Random scenes are those of the campaign. The package of each checkout computes in processes of its own. Numbers are
compared relative to the largest of their list. Scenes that the old one does not know are left out, and numbers that
only one of them has are counted. Of random scenes the statuses and Newton steps are compared too, case by case. Size
and time of the programs: `tests/benchmarks/first_answer.py --against OLD`.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

TESTS = Path(__file__).resolve().parents[1]
RUNS = {
    "turbine_roller_dynamic": "0.3 ms",
    "turbine_ball_dynamic": "0.1 ms",
    "deep_groove_6205_mounted": "10 min",
    "satellite_contact_1": "0.2 ms",
}
"""Scene -> duration of a transient run of each kind: moving rollers, moving balls, warming up, a line contact."""
NOT_RESULTS = ("seconds", "iterations", "residual", "steps", "last_step", "version")
"""Times, counts of the solver and leftovers of its iteration."""
NOTHING = 1e-15
"""Largest size of numbers, in SI units, that are round-off of 0."""


class Compared(NamedTuple):
    """Numbers that both print, that only the old one prints, that only the new one prints; the largest relative
    difference and where it is; it is infinite where a number has got lost."""

    common: int
    only_old: int
    only_new: int
    worst: float
    where: str


def printed(checkout: Path, verb: str, scene: str, *options: str) -> dict[str, Any]:
    """The JSON of a command of a checkout about a scene. **Raises:** `RuntimeError` if it prints none."""
    command = [sys.executable, "-m", "jaxbearing", verb, scene, "--json", *options]
    done = subprocess.run(
        command, env=_environment(checkout), capture_output=True, text=True, check=False, cwd=checkout.parent
    )
    if not done.stdout.strip().startswith("{"):
        raise RuntimeError(f"{checkout}: {scene}: {done.stderr.strip()[-300:]}")
    return json.loads(done.stdout)


def _environment(checkout: Path, *folders: Path) -> dict[str, str]:
    """Environment of a process that imports the package of a checkout, and modules of other folders."""
    path = os.pathsep.join(map(str, (checkout, *folders)))
    return dict(os.environ, PYTHONPATH=path, JAX_PLATFORMS="cpu", JAXBEARING_CACHE="off")


def drawn(checkout: Path, cases: int, folder: Path) -> Path:
    """A file with the results of random scenes of every structure of this campaign, solved by a checkout."""
    file = folder / "random.npz"
    command = [sys.executable, "-m", "campaign.outcomes", str(cases), str(file)]
    environment = _environment(checkout, TESTS, TESTS / "support")
    subprocess.run(command, env=environment, check=True, cwd=folder)
    return file


def numbers(tree: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """Every number of a JSON with its path."""
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from numbers(value, f"{path}.{key}" if path else key)
    elif isinstance(tree, list):
        for i, value in enumerate(tree):
            yield from numbers(value, f"{path}[{i}]")
    elif isinstance(tree, int | float) and not isinstance(tree, bool):
        yield path, float(tree)


def compared(old: Any, new: Any) -> Compared:
    """Differences of two JSONs. **Arguments:** `old`, `new`: trees of dictionaries, lists and numbers."""
    before, after = dict(numbers(old)), dict(numbers(new))
    lists: dict[str, list[str]] = defaultdict(list)
    for path in before.keys() & after.keys():
        if not any(word in path for word in NOT_RESULTS):
            lists[path.split("[")[0]].append(path)
    worst, where = 0.0, ""
    for paths in lists.values():
        scale = max(abs(before[path]) for path in paths)
        if max(scale, *(abs(after[path]) for path in paths)) < NOTHING:
            continue
        scale = scale or 1.0
        for path in paths:
            difference = abs(after[path] - before[path]) / scale
            if math.isnan(difference):
                difference = math.inf
            if difference > worst:
                worst, where = difference, path
    common = sum(len(paths) for paths in lists.values())
    return Compared(common, len(before.keys() - after.keys()), len(after.keys() - before.keys()), worst, where)


def known(checkout: Path) -> list[str]:
    """Built-in scenes of a checkout."""
    return sorted(path.stem for path in (checkout / "jaxbearing" / "scenes" / "builtin").glob("*.toml"))


def compared_cases(old: dict[str, np.ndarray], new: dict[str, np.ndarray]) -> tuple[int, int, int, int, float, str]:
    """Random scenes of one structure by two checkouts, path in the solution -> values of all cases.

    **Returns:** cases; converged in the old one, in the new one; cases with another number of Newton steps; the largest
    relative difference of a result of cases that converge in both, and its path. A path that only one has is passed
    over."""
    good = [results["status"].reshape(len(results["status"]), -1).max(axis=1) == 0 for results in (old, new)]
    both = good[0] & good[1]
    counts = [np.zeros(len(both)) if "iterations" not in results else results["iterations"] for results in (old, new)]
    steps = np.sum(np.any((counts[0] != counts[1]).reshape(len(both), -1), axis=1) & both)
    worst, where = 0.0, ""
    for path in sorted(old.keys() & new.keys()):
        before, after = old[path][both], new[path][both]
        if any(word in path for word in NOT_RESULTS) or not np.issubdtype(before.dtype, np.floating) or not before.size:
            continue
        before, after = (values.reshape(len(before), -1) for values in (before, after))
        scale = np.nanmax(np.abs(before), axis=1, initial=NOTHING, keepdims=True)
        difference = np.abs(after - before) / scale
        difference[np.isnan(before) & np.isnan(after)] = 0.0
        # a number that one of them has lost differs by infinity, as in `compared`
        largest = float(np.max(np.where(np.isnan(difference), np.inf, difference), initial=0.0))
        if largest > worst:
            worst, where = largest, path
    return len(both), int(good[0].sum()), int(good[1].sum()), int(steps), worst, where


def _structures(file: Path) -> dict[str, dict[str, np.ndarray]]:
    structures: dict[str, dict[str, np.ndarray]] = defaultdict(dict)
    for name, values in np.load(file).items():
        structure, _, path = name.partition("|")
        structures[structure][path] = values
    return structures


def _print_random(roots: list[Path], cases: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        old, new = (_structures(drawn(root, cases, Path(folder))) for root in roots)
    print("| structure | cases | converge in old | in new | other steps | largest difference | where |")
    print("|---" * 7 + "|")
    for name in old:
        *counts, worst, where = compared_cases(old[name], new[name])
        print("|", " | ".join([name, *map(str, counts), f"{worst:.1e}", where]), "|")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkouts", nargs=2, type=Path, metavar=("OLD", "NEW"))
    parser.add_argument("--only", nargs="+", default=[], metavar="SCENE")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--sensitivities", action="store_true")
    what.add_argument("--runs", action="store_true")
    what.add_argument("--random", type=int, default=0, metavar="CASES")
    chosen = parser.parse_args()
    roots = [root.resolve() for root in chosen.checkouts]
    if chosen.random:
        return _print_random(roots, chosen.random)
    verb = "simulate" if chosen.runs else "solve"
    options = {
        scene: ["--duration", RUNS[scene]] if chosen.runs else []
        for scene in (RUNS if chosen.runs else known(roots[0]))
    }
    print("| scene | numbers of both | only old | only new | largest difference | where |\n|---|---|---|---|---|---|")
    for scene in chosen.only or options:
        more = ["--sensitivities"] if chosen.sensitivities else options[scene]
        trees = [printed(root, verb, scene, *more) for root in roots]
        row = compared(*((tree.get("sensitivities", {}) for tree in trees) if chosen.sensitivities else trees))
        print(
            f"| {scene} | {row.common} | {row.only_old} | {row.only_new} | {row.worst:.1e} | {row.where} |", flush=True
        )
    return None


if __name__ == "__main__":
    main()
