"""Results of a scene and their exact derivatives by its numbers: one solve, by the program of `solve`, and a second
program with one pass for each number."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array

from .._scene import AbstractScene, AbstractSolution
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float
from ..programs import KeptProgram
from ..programs.differentiated import at_roots
from ..solve import _solve_any, solve_with_roots
from .results import names_in, values_of

ALWAYS = ("fit.clearance", "fit.interference_inner", "fit.interference_outer")
"""Results that are always computed if a scene has them."""


class Slopes(NamedTuple):
    """Solution, results by name, and their derivatives: of each result by each number."""

    solution: Any
    values: dict[str, Any]
    slopes: dict[str, dict[str, Any]]


def _slopes(
    roots: tuple[Any, ...],
    scene: AbstractScene,
    numbers: Mapping[str, object],
    wanted: Sequence[str] | None,
    options: NewtonOptions,
) -> dict[str, dict[str, Any]]:
    """Derivatives of each result by each number, from the roots of the solve: one number after the other in forward
    mode, which makes the smallest program (see `programs.differentiated`)."""

    def results(numbers_: Mapping[str, object]) -> dict[str, Any]:
        solution = at_roots(_solve_any, roots, scene.replace(numbers_), options)
        return values_of(solution, computed(solution, wanted))

    def by_one(place: Array) -> dict[str, object]:
        along = {path: jnp.where(place == i, 1.0, 0.0) for i, path in enumerate(numbers)}
        return jax.jvp(results, (numbers,), (along,))[1]

    rows = jax.lax.map(by_one, jnp.arange(len(numbers)))
    return {name: {path: row[i] for i, path in enumerate(numbers)} for name, row in rows.items()}


_kept_slopes = KeptProgram(_slopes, quick=True)


def computed(solution: AbstractSolution, wanted: Sequence[str] | None) -> tuple[str, ...]:
    """Names of the results to compute: those wanted, and `ALWAYS`. **Raises:** as `names_in`."""
    fit = getattr(solution, "fit", None)
    there = (name for name in ALWAYS if fit is not None and getattr(fit, name.partition(".")[2]) is not None)
    return tuple(dict.fromkeys((*names_in(solution, wanted), *there)))


@rare_garbage_collection()
def slopes_at(
    scene: AbstractScene, numbers: Mapping[str, float], wanted: Sequence[str] | None, options: NewtonOptions
) -> Slopes:
    """Results of a scene with other numbers, and their derivatives.

    **Arguments:** `numbers`: dotted path -> SI value; `wanted`: names of results, see `names_in`.

    **Raises:** `ValueError` for a name that is no result; a failed solve raises nothing, its solution has a status.
    """
    names = None if wanted is None else tuple(wanted)
    arrays = {path: jnp.asarray(value, jnp.float64) for path, value in numbers.items()}
    own = jax.tree.map(as_float, scene)
    solution, roots = solve_with_roots(jax.tree.map(as_float, scene.replace(arrays)), options)
    values = values_of(solution, computed(solution, names))
    return Slopes(solution, values, _kept_slopes(roots, own, arrays, names, options))
