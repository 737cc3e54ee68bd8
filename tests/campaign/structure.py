"""What a structure of the campaign is: a scene whose parts are fixed and whose numbers are drawn."""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from campaign.draws import Numbers, Range, drawn

import jaxbearing as jb

Results = dict[str, np.ndarray]
"""Path in the solution, "elements.load_inner", -> values of all cases."""


class Twin(NamedTuple):
    """A second scene whose results follow from those of the first.

    - `change`: numbers of the scene -> numbers of the twin
    - `error`: (numbers, results, numbers of the twin, its results) -> how far the results are from what must be
    - `base`: change of the first scene too, where the relation needs it (a bearing at rest)
    """

    name: str
    change: Callable[[Numbers], Numbers]
    error: Callable[[Numbers, Results, Numbers, Results], np.ndarray]
    limit: float
    base: Callable[[Numbers], Numbers] | None = None


@dataclass(frozen=True)
class Structure:
    """One compiled program.

    - `load`: makes the scene
    - `ranges`: what is drawn; `numbers`: from the draws to paths and values of the scene
    - `balances`: what must be 0 in a converged solution, from its printed results alone: name -> (relative error of
      each case, limit)
    - `summary`: one smooth number of a solution, whose gradient is compared with finite differences
    - `certificate`: whether a scene provably has no equilibrium; `None`: every scene has one
    - `outside`: which of the numbers lie beyond the stated envelope, so that the solve must refuse them
    - `may_be_nan`: paths that are NaN where a contact does not touch
    """

    name: str
    kind: str
    load: Callable[[], Any]
    ranges: dict[str, Range]
    numbers: Callable[[Numbers], Numbers]
    balances: Callable[[Numbers, Results], dict[str, tuple[np.ndarray, float]]]
    summary: Callable[[Any], jax.Array]
    twins: tuple[Twin, ...] = ()
    certificate: Callable[[Any], bool] | None = None
    outside: Callable[[Numbers], np.ndarray] | None = None
    may_be_nan: tuple[str, ...] = ()
    dear: bool = False
    """Whether its scenes take so long that it gets a quarter of the share of others."""
    small: bool = False
    """Whether it is one of those of the bounded run."""

    @functools.cached_property
    def scene(self) -> Any:
        return self.load()

    @property
    def size(self) -> int:
        """Coordinates of a case."""
        return len(self.ranges)

    def at(self, units: np.ndarray) -> Numbers:
        """Numbers of the scenes at points of the unit cube, one a row."""
        return {name: np.asarray(values, float) for name, values in self.numbers(drawn(self.ranges, units)).items()}

    def single_scene(self, one: dict[str, Any]) -> Any:
        """A scene with plain numbers, which are validated. **Raises:** `ValueError` for what cannot be built."""
        return self.scene.replace(one)

    @functools.cached_property
    def solver(self) -> Callable[[dict[str, jax.Array]], Any]:
        return jax.jit(lambda batch: jax.lax.map(self.solve_one, batch))

    def solve_one(self, numbers: dict[str, Any]) -> Any:
        return jb.solve(self.scene.replace(numbers), throw=False)

    @functools.cached_property
    def differentiated(self) -> Callable[[dict[str, jax.Array]], Any]:
        """Status, summary and its gradient by every drawn number, in reverse mode."""

        def measured(numbers: dict[str, Any]) -> Any:
            solution = self.solve_one(numbers)
            return self.summary(solution), solution.converged

        def one(numbers: dict[str, Any]) -> Any:
            (value, converged), slope = jax.value_and_grad(measured, has_aux=True)(numbers)
            return converged, value, slope

        return jax.jit(lambda batch: jax.lax.map(one, batch))

    @functools.cached_property
    def summarised(self) -> Callable[[Any], jax.Array]:
        return jax.jit(jax.vmap(self.summary))


def results_of(solution: Any) -> Results:
    """Every number of a batch of solutions by its path."""
    leaves = jax.tree_util.tree_leaves_with_path(solution)
    return {jax.tree_util.keystr(path).lstrip("."): np.asarray(leaf) for path, leaf in leaves}


def in_chunks(function: Callable, numbers: Numbers, chunk: int) -> Any:
    """`function` of all cases, `chunk` at a time, the last chunk filled up: one program does them all."""
    count = len(next(iter(numbers.values())))
    parts = []
    for start in range(0, count, chunk):
        index = np.minimum(np.arange(start, start + chunk), count - 1)
        parts.append(jax.tree.map(np.asarray, function({k: jnp.asarray(v[index]) for k, v in numbers.items()})))
    return jax.tree.map(lambda *leaves: np.concatenate(leaves)[:count], *parts)
