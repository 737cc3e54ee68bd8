"""The numbers of the built-in scenes from two checkouts of the package, compared.

    python tests/support/checkouts.py OLD NEW [SCENE ...]

Each scene that both know is solved by the command line of either checkout in a process of its own, and every number of
its JSON that both print is compared, relative to the largest of its list. Scenes that the old one does not know are
left out, and numbers that only one of them prints are counted.
"""

import json
import math
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

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


def printed(checkout: Path, scene: str) -> dict[str, Any]:
    """The JSON of a scene, solved by the package of a checkout. **Raises:** `RuntimeError` if it prints none."""
    environment = dict(os.environ, PYTHONPATH=str(checkout), JAX_PLATFORMS="cpu", JAXBEARING_CACHE="off")
    command = [sys.executable, "-m", "jaxbearing", "solve", scene, "--json"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, cwd=checkout.parent)
    if not done.stdout.strip().startswith("{"):
        raise RuntimeError(f"{checkout}: {scene}: {done.stderr.strip()[-300:]}")
    return json.loads(done.stdout)


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


def main(old: str, new: str, *scenes: str) -> None:
    roots = Path(old).resolve(), Path(new).resolve()
    print("| scene | numbers of both | only old | only new | largest difference | where |\n|---|---|---|---|---|---|")
    for scene in scenes or known(roots[0]):
        row = compared(*(printed(root, scene) for root in roots))
        print(
            f"| {scene} | {row.common} | {row.only_old} | {row.only_new} | {row.worst:.1e} | {row.where} |", flush=True
        )


if __name__ == "__main__":
    main(*sys.argv[1:])
