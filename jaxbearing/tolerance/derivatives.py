"""Results of a scene and their exact derivatives by its numbers: one solve and one reverse pass."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp

from .._scene import AbstractScene
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..programs import KeptProgram
from ..solve import _solve_any
from .results import names_in, values_of

ALWAYS = ("fit.clearance", "fit.interference_inner", "fit.interference_outer")
"""Results that are computed in any case, where a scene has them."""


class Slopes(NamedTuple):
    """Solution, results by name, and their derivatives: of each result by each number."""

    solution: Any
    values: dict[str, Any]
    slopes: dict[str, dict[str, Any]]


@rare_garbage_collection()
def _differentiated(
    scene: AbstractScene, numbers: dict[str, Any], wanted: Sequence[str] | None, options: NewtonOptions
) -> tuple[Any, dict[str, Any], dict[str, dict[str, Any]]]:
    def outputs(numbers_: dict[str, Any]) -> tuple[dict[str, Any], Any]:
        solution = _solve_any(scene.replace(numbers_), options)
        return values_of(solution, computed(solution, wanted)), solution

    values, pull_back, solution = jax.vjp(outputs, numbers, has_aux=True)
    unit = jnp.eye(len(values))
    (rows,) = jax.vmap(pull_back)({name: unit[:, i] for i, name in enumerate(values)})
    slopes = {name: {path: rows[path][i] for path in numbers} for i, name in enumerate(values)}
    return solution, values, slopes


_ordinary = eqx.filter_jit(_differentiated)
_once = KeptProgram(_differentiated, quick=True)


def computed(solution: Any, wanted: Sequence[str] | None) -> tuple[str, ...]:
    """Names of the results that the program gives. **Raises:** as `names_in`."""
    fit = getattr(solution, "fit", None)
    there = (name for name in ALWAYS if fit is not None and getattr(fit, name.partition(".")[2]) is not None)
    return tuple(dict.fromkeys((*names_in(solution, wanted), *there)))


def slopes_at(
    scene: AbstractScene,
    numbers: Mapping[str, float],
    wanted: Sequence[str] | None,
    options: NewtonOptions,
    *,
    once: bool = False,
) -> Slopes:
    """Results of a scene with other numbers, and their derivatives.

    **Arguments:** `numbers`: dotted path -> SI value; `wanted`: names of results, see `names_in`; `once`: for a process
    that asks few times and ends.

    **Raises:** `ValueError` for a name that is no result; a failed solve is a solution with its status.
    """
    given = {path: jnp.asarray(value, jnp.float64) for path, value in numbers.items()}
    program = _once if once else _ordinary
    return Slopes(*program(scene, given, None if wanted is None else tuple(wanted), options))
