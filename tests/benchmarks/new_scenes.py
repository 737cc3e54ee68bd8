"""Time of `jaxbearing new` from the shell for a hundred designations, a process each.

    python tests/benchmarks/new_scenes.py

The estimates are kept ones, so that no process imports JAX. The first processes read the files of the package from the
disk and are left out. On a busy machine the processor seconds hold better than the wall seconds.
"""

import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))

from hundred_designations import hundred

LIMIT = 1.0
"""Seconds that none should take."""


def measured(name: str, folder: str) -> tuple[float, float]:
    """Processor and wall seconds of one command."""
    command = [sys.executable, "-m", "jaxbearing", "new", *name.split(), "--force"]
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    wall, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def main() -> None:
    """Prints medians, the slowest, and who takes longer than the limit."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("6205", "NU 205"):
            measured(name, folder)
        found = {name: measured(name, folder) for name in hundred()}
    for place, what in enumerate(("processor", "wall")):
        seconds = {name: pair[place] for name, pair in found.items()}
        slowest = max(seconds, key=lambda name: seconds[name])
        slow = [name for name, value in seconds.items() if value > LIMIT]
        middle = statistics.median(seconds.values())
        print(f"{what}: median {middle:.2f} s, slowest {seconds[slowest]:.2f} s ({slowest})")
        print(f"  above {LIMIT:g} s: {len(slow)} of {len(found)} {slow[:5]}")


if __name__ == "__main__":
    main()
