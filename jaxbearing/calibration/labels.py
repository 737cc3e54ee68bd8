"""Names and labels of the results of a scene, without a solve."""

from collections.abc import Callable, Sequence

import jax

from .._scene import AbstractScene, AbstractSolution
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..solve import solve
from ..tolerance.results import Label, is_result, labels_of, names_in, not_modelled, paths_of


def labels_in(
    scene: AbstractScene, names: Sequence[str], newton: NewtonOptions | None = None
) -> dict[str, tuple[str, Label]]:
    """Path and label of each result, by its name.

    **Raises:** `ValueError` for a name that is no result, and for a result that is not one number.
    """
    labels: dict[str, tuple[str, Label]] = {}

    def look(solution: AbstractSolution) -> None:
        for name in names:
            (path,) = names_in(solution, [name])
            labels[name] = path, labels_of(solution, [path])[path]

    look_at(scene, look, newton)
    return labels


def result_names(scene: AbstractScene, newton: NewtonOptions | None = None) -> tuple[str, ...]:
    """Paths of all results of a scene."""
    paths: list[str] = []
    look_at(scene, lambda solution: paths.extend(paths_of(solution)), newton)
    return tuple(paths)


def results_among(scene: AbstractScene, names: Sequence[str], newton: NewtonOptions | None = None) -> list[str]:
    """The names among these that are results, including results of parts that the scene does not model."""
    results: list[str] = []
    if names:
        look_at(scene, lambda solution: results.extend(name for name in names if is_result(solution, name)), newton)
    return results


def is_left_out(scene: AbstractScene, name: str, newton: NewtonOptions | None = None) -> bool:
    """True for the path of a result that this scene does not model."""
    left_out: list[bool] = []
    look_at(scene, lambda solution: left_out.append(not_modelled(solution, name)), newton)
    return any(left_out)


def look_at(scene: AbstractScene, look: Callable[[AbstractSolution], None], newton: NewtonOptions | None) -> None:
    """Calls `look` with the solution of a traced solve; nothing is compiled."""

    def traced(scene: AbstractScene) -> None:
        look(solve(scene, throw=False, options=newton))

    jax.eval_shape(traced, jax.tree.map(as_float, scene))
