"""Names and labels of the results of a scene, without a solve."""

from collections.abc import Sequence

import jax
from jaxtyping import Array, Bool

from .._scene import AbstractScene
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..solve import solve
from ..tolerance.results import Label, labels_of, names_in, paths_of


def labels_in(
    scene: AbstractScene, names: Sequence[str], newton: NewtonOptions | None = None
) -> dict[str, tuple[str, Label]]:
    """Path and label of results by their names. They are looked up while a solve is traced, which compiles nothing.

    **Raises:** `ValueError` for a name that is no result, and for a result that is not one number.
    """
    found: dict[str, tuple[str, Label]] = {}

    def traced(scene: AbstractScene) -> Bool[Array, ""]:
        solution = solve(scene, throw=False, options=newton)
        for name in names:
            (path,) = names_in(solution, [name])
            found[name] = path, labels_of(solution, [path])[path]
        return solution.converged

    jax.eval_shape(traced, jax.tree.map(as_float, scene))
    return found


def result_names(scene: AbstractScene, newton: NewtonOptions | None = None) -> tuple[str, ...]:
    """Paths of all results of a scene."""
    found: list[str] = []

    def traced(scene: AbstractScene) -> Bool[Array, ""]:
        solution = solve(scene, throw=False, options=newton)
        found.extend(paths_of(solution))
        return solution.converged

    jax.eval_shape(traced, jax.tree.map(as_float, scene))
    return tuple(found)
