"""Results of random scenes of every structure, in a file that another checkout can be compared with.

python -m campaign.outcomes CASES FILE      # with `tests` and the package to be measured on PYTHONPATH
"""

import sys

import jax
import numpy as np
from campaign.judge import solve_batch
from campaign.structures import STRUCTURES


def main(cases: int, file: str, chunk: int = 32) -> None:
    """Writes "STRUCTURE|PATH" -> values of all cases, the draws of seed 0."""
    outcomes = {}
    for structure in STRUCTURES:
        units = np.random.default_rng(0).random((cases, structure.size))
        _, results = solve_batch(structure, structure.at(units), min(chunk, cases))
        outcomes |= {f"{structure.name}|{path}": values for path, values in results.items()}
        jax.clear_caches()
    np.savez(file, **outcomes)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
