"""Which inputs decide the results of a scene: logarithmic sensitivities, all from one solve."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ._scene import AbstractScene, AbstractSolution
from .bearings.solution import Solution
from .ehl import LineContactSolution
from .machines import TwoDiskSolution
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .programs import KeptProgram
from .solve import _solve_any, require_solvable

_Slopes = dict[str, Float[Array, ""]]


class NoSensitivities(ValueError):
    """The scene models none of the results that have sensitivities."""


class Sensitivities(eqx.Module):
    """Sensitivities to every number of a scene, by dotted path, dimensionless. Of a result that the scene does not
    have, `None`.

    - `power_loss`: d ln(total power loss) / d ln(input): per cent of power for one per cent of the input.
    - `slip`: d(cage slip) / d ln(input).
    - `life`, `modified_life`: d ln(L10r) / d ln(input) and d ln(Lnmr) / d ln(input), of a bearing with a rating.
    - `film`: d ln(central film) / d ln(input), of a line contact.
    - `traction`: d ln(traction coefficient) / d ln(input), of a two-disk machine at one operating point.

    Temperatures count in kelvin. An input that is 0 has 0 here, whatever its derivative. An input with several values
    counts as one: all of them change by the same factor.
    """

    power_loss: _Slopes | None = None
    slip: _Slopes | None = None
    life: _Slopes | None = None
    modified_life: _Slopes | None = None
    film: _Slopes | None = None
    traction: _Slopes | None = None

    def modelled(self) -> dict[str, _Slopes]:
        """The sensitivities that the scene has, by field name."""
        fields = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {name: slopes for name, slopes in fields.items() if slopes is not None}


def sensitivities(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None
) -> tuple[Any, Sensitivities]:
    """Solve a scene and differentiate its main results with respect to every number in it.

    The results are those of `Sensitivities` that the scene models. One solve and one reverse pass through the implicit
    function theorem: the cost does not grow with the number of inputs. May be called inside `jax.jit` and `jax.vmap`.

    Returns the solution, that of `solve`, and the sensitivities; those of a solve that failed are NaN.

    **Raises:** `ValueError` for a scene with none of these results; as `solve` otherwise.
    """
    return _run(scene, throw, NewtonOptions() if options is None else options, _ordinary)


def sensitivities_once(scene: AbstractScene) -> tuple[AbstractSolution, Sensitivities]:
    """Result of `sensitivities(scene, throw=False)`, for a process that asks once and ends."""
    return _run(scene, False, NewtonOptions(), _once)


@rare_garbage_collection()
def _run(
    scene: AbstractScene, throw: bool, options: NewtonOptions, function: Callable[..., Any]
) -> tuple[Any, Sensitivities]:
    require_x64()
    require_solvable(scene)
    solution, slopes = function(jax.tree.map(as_float, scene), options)
    if throw:
        solution.raise_if_failed()
    return solution, Sensitivities(**{name: _by_path(tree) for name, tree in slopes.items()})


def _results(solution: AbstractSolution) -> dict[str, Array]:
    """The results of a solution that have sensitivities, by field of `Sensitivities`. **Raises:** `NoSensitivities`."""
    if isinstance(solution, Solution):
        power, cage, life = solution.power_loss, solution.cage, solution.life
        # a total of no part at all is no result
        parts = [name for name, value in vars(power).items() if value is not None and name != "total"] if power else []
        found = {
            "power_loss": power.total if parts else None,
            "slip": None if cage is None else cage.slip,
            "life": None if life is None else life.L10r,
            "modified_life": None if life is None else life.Lnmr,
        }
        found = {name: value for name, value in found.items() if value is not None}
        if not found:
            raise NoSensitivities(
                "found a bearing that models neither power loss nor cage slip nor life; expected one with losses (an "
                "oil, and contact.traction or contact.rolling_resistance) or with a rating"
            )
        return found
    if isinstance(solution, LineContactSolution):
        return {"film": solution.film.central}
    if isinstance(solution, TwoDiskSolution):
        points = solution.traction_coefficient.size
        if points != 1:
            raise NoSensitivities(
                f"found traction curves of {points} points; expected one point: one value each of "
                "operation.slide_to_roll, entrainment_speed, temperature and load or pressure"
            )
        return {"traction": solution.traction_coefficient.reshape(())}
    raise NoSensitivities(f"found a {type(solution).__name__}, which has no sensitivities; expected a bearing")


def _differentiated(scene: AbstractScene, options: NewtonOptions) -> tuple[Any, dict[str, Any]]:
    numbers, rest = eqx.partition(scene, eqx.is_inexact_array)

    def outputs(numbers_: Any) -> tuple[dict[str, Array], Any]:
        solution = _solve_any(eqx.combine(numbers_, rest), options)
        return _results(solution), solution

    values, pull_back, solution = jax.vjp(outputs, numbers, has_aux=True)
    unit = jnp.eye(len(values))
    (rows,) = jax.vmap(pull_back)({name: unit[:, i] for i, name in enumerate(values)})

    def scaled(i: int, name: str) -> Any:
        scale = 1.0 if name == "slip" else values[name]
        slope = lambda x, rows_: jnp.where(solution.converged, jnp.sum(x * rows_[i]) / scale, jnp.nan)
        return jax.tree.map(slope, numbers, rows)

    return solution, {name: scaled(i, name) for i, name in enumerate(values)}


_ordinary = eqx.filter_jit(_differentiated)
_once = KeptProgram(_differentiated, quick=True)


def _by_path(tree: Any) -> dict[str, Float[Array, ""]]:
    leaves, _ = jax.tree_util.tree_flatten_with_path(tree)
    return {jax.tree_util.keystr(path, simple=True, separator="."): leaf for path, leaf in leaves}


def largest(values: Mapping[str, Array], count: int, leave_out: tuple[str, ...] = ()) -> list[str]:
    """Paths of the largest entries by modulus, the largest first, without zeros, NaN and paths below `leave_out`."""
    sizes = {path: abs(float(value)) for path, value in values.items() if not path.startswith(leave_out)}
    return sorted((path for path in sizes if sizes[path] > 0.0), key=lambda path: sizes[path], reverse=True)[:count]
