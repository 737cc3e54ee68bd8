"""Which inputs decide the results of a scene: logarithmic sensitivities, all from one solve."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ._scene import AbstractScene, AbstractSolution
from .bearings.solution import RING_FREEDOMS, Solution
from .ehl import EHLLineContact, LineContactSolution
from .machines import TwoDiskSolution
from .numerics.arguments import require_choice
from .numerics.compiling import inside_a_program
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.safe import largest as largest_value
from .programs import KeptProgram
from .shafts.solution import ShaftSolution
from .solve import require_solvable, solution_at, solve_with_roots
from .thermal.result import ThermalResult

_Slopes = dict[str, Float[Array, ""]]
USUAL = ("power_loss", "slip", "life", "modified_life")
"""Results of a bearing that are differentiated where nothing else is asked for, as far as the scene models them."""
ON_DEMAND = ("stiffness", "axial_stiffness", "temperature")
"""Further results of a bearing."""
ABSOLUTE = ("slip", "temperature")
"""Results whose sensitivities are not relative to the result."""


class NoSensitivities(ValueError):
    """The scene models none of the results that have sensitivities."""


class Sensitivities(eqx.Module):
    """Sensitivities to every number of a scene, by dotted path, dimensionless. Of a result that the scene does not
    have, `None`.

    - `power_loss`: d ln(total power loss) / d ln(input): per cent of power for one per cent of the input.
    - `slip`: d(cage slip) / d ln(input).
    - `life`, `modified_life`: d ln(L10r) / d ln(input) and d ln(Lnmr) / d ln(input), of a bearing with a rating; of a
      shaft the L10r of all bearings together.
    - `film`: d ln(central film) / d ln(input), of a line contact.
    - `traction`: d ln(traction coefficient) / d ln(input), of a two-disk machine at one operating point.
    - `stiffness`, `axial_stiffness`: d ln(K) / d ln(input) of the radial and the axial stiffness of the inner ring,
      where asked for.
    - `temperature`: d(temperature) / d ln(input) of the hottest node of a thermal network, K, where asked for.

    Temperatures count in kelvin. An input that is 0 has 0 here, whatever its derivative. An input with several values
    counts as one: all of them change by the same factor.
    """

    power_loss: _Slopes | None = None
    slip: _Slopes | None = None
    life: _Slopes | None = None
    modified_life: _Slopes | None = None
    film: _Slopes | None = None
    traction: _Slopes | None = None
    stiffness: _Slopes | None = None
    axial_stiffness: _Slopes | None = None
    temperature: _Slopes | None = None

    def modelled(self) -> dict[str, _Slopes]:
        """The sensitivities that the scene has, by field name."""
        fields = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return {name: slopes for name, slopes in fields.items() if slopes is not None}


class _Wanted(eqx.Module):
    """Names of the results that are asked for; `None`: the usual ones that the scene models."""

    names: tuple[str, ...] | None = eqx.field(static=True, default=None)

    @property
    def stiffness(self) -> bool:
        """True if a stiffness is asked for."""
        return any(name.endswith("stiffness") for name in self.names or ())


def sensitivities(
    scene: AbstractScene,
    *,
    of: str | Iterable[str] | None = None,
    throw: bool = True,
    options: NewtonOptions | None = None,
) -> tuple[Any, Sensitivities]:
    """Solve a scene and differentiate its main results with respect to every number in it.

    The results are those of `Sensitivities` that the scene models; of a bearing those in `USUAL`, or those that `of`
    names. One solve, by the program of `solve`, and a second
    program with one pass for every input through the implicit function theorem, each the cost of a residual; of a line
    contact one reverse pass for all. May be called inside `jax.jit` and `jax.vmap`.

    Returns the solution, that of `solve`, and the sensitivities; those of a solve that failed are NaN.

    **Arguments:** `of`: names of results of a bearing, in `USUAL` and `ON_DEMAND`.

    **Raises:** `ValueError` for a scene with none of these results, or without one that is asked for; as `solve`
    otherwise.
    """
    chosen = NewtonOptions() if options is None else options
    wanted = _wanted(of)
    require_x64()
    require_solvable(scene)
    solution, slopes = _answer(jax.tree.map(as_float, scene), throw, chosen, wanted)
    return solution, Sensitivities(**{name: _by_path(tree, scene) for name, tree in slopes.items()})


def _wanted(of: str | Iterable[str] | None) -> _Wanted:
    """**Raises:** `ValueError` for a name that stands for no result."""
    if of is None:
        return _Wanted()
    names = (of,) if isinstance(of, str) else tuple(dict.fromkeys(of))
    for name in names:
        require_choice("of", name, (*USUAL, *ON_DEMAND))
    return _Wanted(names)


@rare_garbage_collection()
def _answer(
    scene: AbstractScene, throw: bool, options: NewtonOptions, wanted: _Wanted
) -> tuple[AbstractSolution, dict[str, AbstractScene]]:
    if inside_a_program(scene):
        solution, slopes = _in_a_program(scene, options, wanted)
        if throw:
            solution.raise_if_failed()
        return solution, slopes
    solution, roots = solve_with_roots(scene, options)
    _results(solution, wanted)  # refused before another program is compiled
    if throw:
        solution.raise_if_failed()
    return solution, _kept_slopes(scene, options, roots, wanted)


def _results(solution: AbstractSolution, wanted: _Wanted) -> dict[str, Array]:
    """The results of a solution that have sensitivities, by field of `Sensitivities`. **Raises:** `NoSensitivities`."""
    if isinstance(solution, Solution):
        return _of_bearing(solution, wanted)
    if isinstance(solution, ShaftSolution):
        return _of_shaft(solution, wanted)
    if wanted.names is not None:
        kind = f"a {type(solution).__name__}"
        raise NoSensitivities(f"found {kind}; expected a bearing, whose results are {', '.join(wanted.names)}")
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


def _of_bearing(solution: Solution, wanted: _Wanted) -> dict[str, Array]:
    """**Raises:** `NoSensitivities`."""
    power, cage, life, thermal = solution.power_loss, solution.cage, solution.life, solution.thermal
    # a total of no part at all is no result
    parts = [name for name, value in vars(power).items() if value is not None and name != "total"] if power else []
    results: dict[str, Array | None] = {
        "power_loss": power.total if parts else None,
        "slip": None if cage is None else cage.slip,
        "life": None if life is None else life.L10r,
        "modified_life": None if life is None else life.Lnmr,
        "stiffness": _stiffness_of(solution, "radial"),
        "axial_stiffness": _stiffness_of(solution, "axial"),
        "temperature": None if thermal is None else _hottest(thermal),
    }
    chosen = {name: results[name] for name in (USUAL if wanted.names is None else wanted.names)}
    there = {name: value for name, value in chosen.items() if value is not None}
    missing = [name for name in chosen if name not in there]
    if wanted.names is not None and missing:
        others = ", ".join(name for name, value in results.items() if value is not None)
        raise NoSensitivities(f"found a bearing that does not model {', '.join(missing)}; expected one of {others}")
    if not there:
        raise NoSensitivities(
            "found a bearing that models neither power loss nor cage slip nor life; expected one with losses (an "
            "oil, and contact.traction or contact.rolling_resistance) or with a rating"
        )
    return there


def _of_shaft(solution: ShaftSolution, wanted: _Wanted) -> dict[str, Array]:
    """**Raises:** `NoSensitivities`."""
    losses = [getattr(bearing.solution, "power_loss", None) for bearing in solution.bearings.values()]
    results: dict[str, Array | None] = {
        "power_loss": solution.torque.power_loss if any(loss and loss.total is not None for loss in losses) else None,
        "life": None if solution.life is None else solution.life.L10r,
    }
    there = {name: value for name, value in results.items() if value is not None}
    if wanted.names is not None:
        missing = [name for name in wanted.names if name not in there]
        if missing:
            known = ", ".join(there) or "none"
            raise NoSensitivities(f"found a shaft, which has no {', '.join(missing)}; expected one of {known}")
        return {name: there[name] for name in wanted.names}
    if not there:
        raise NoSensitivities(
            "found a shaft whose bearings model neither losses nor, all of them, lives; expected [life] in its file"
        )
    return there


def _stiffness_of(solution: Solution, freedom: str) -> Array | None:
    """Stiffness of a freedom of the inner ring, N/m; `None` where it is not modelled."""
    place = RING_FREEDOMS.index(freedom)
    return solution.stiffness[place, place] if freedom in solution.freedoms_of_stiffness else None


def _hottest(thermal: ThermalResult) -> Array:
    """The highest temperature of the nodes, K."""
    return largest_value(jnp.stack([getattr(thermal.temperatures, name) for name in thermal.nodes]))


def _slopes(
    scene: AbstractScene, options: NewtonOptions, roots: tuple[object, ...], wanted: _Wanted
) -> dict[str, AbstractScene]:
    """Sensitivities of each result, a tree like the numbers of the scene; NaN where the solve failed.

    **Arguments:** `roots`: of the scene's solve.
    """
    numbers, rest = eqx.partition(scene, eqx.is_inexact_array)

    def results(numbers: AbstractScene) -> tuple[dict[str, Array], Array]:
        solution = solution_at(roots, eqx.combine(numbers, rest), options, stiffness=wanted.stiffness)
        return _results(solution, wanted), solution.converged

    slopes = _backward if isinstance(scene, EHLLineContact) else _forward
    values, gradients, converged = slopes(results, numbers)

    def scaled(name: str) -> AbstractScene:
        scale = 1.0 if name in ABSOLUTE else values[name]
        return jax.tree.map(lambda slope: jnp.where(converged, slope / scale, jnp.nan), gradients[name])

    return {name: scaled(name) for name in values}


_Found = tuple[dict[str, Array], dict[str, AbstractScene], Array]
"""Results; derivatives of each by ln of every number, a tree like the numbers; the flag."""


def _forward(results: Callable[[AbstractScene], tuple[dict[str, Array], Array]], numbers: AbstractScene) -> _Found:
    """One number after the other in forward mode: the smallest program (see `programs.differentiated`)."""
    leaves, structure = jax.tree.flatten(numbers)

    def along(place: Array) -> tuple[dict[str, Array], dict[str, Array], Array]:
        moved = [jnp.where(place == i, leaf, 0.0) for i, leaf in enumerate(leaves)]
        return jax.jvp(results, (numbers,), (jax.tree.unflatten(structure, moved),), has_aux=True)

    values, slopes, converged = jax.lax.map(along, jnp.arange(len(leaves)))
    of_each = {name: jax.tree.unflatten(structure, list(row)) for name, row in slopes.items()}
    return {name: value[0] for name, value in values.items()}, of_each, converged[0]


def _backward(results: Callable[[AbstractScene], tuple[dict[str, Array], Array]], numbers: AbstractScene) -> _Found:
    """All numbers at once in reverse mode, of a film: its large matrix is then factored once."""
    values, pull_back, converged = jax.vjp(results, numbers, has_aux=True)
    unit = jnp.eye(len(values))
    (rows,) = jax.vmap(pull_back)({name: unit[:, i] for i, name in enumerate(values)})
    slopes = lambda i: jax.tree.map(lambda leaf, row: jnp.sum(leaf * row[i]), numbers, rows)
    return values, {name: slopes(i) for i, name in enumerate(values)}, converged


_kept_slopes = KeptProgram(_slopes, quick=True)


@eqx.filter_jit
def _in_a_program(
    scene: AbstractScene, options: NewtonOptions, wanted: _Wanted
) -> tuple[AbstractSolution, dict[str, AbstractScene]]:
    solution, roots = solve_with_roots(scene, options)
    return solution, _slopes(scene, options, roots, wanted)


def _by_path(tree: AbstractScene, scene: AbstractScene) -> dict[str, Float[Array, ""]]:
    """**Arguments:** `tree`: like that of the numbers of the scene."""
    leaves, _ = jax.tree_util.tree_flatten_with_path(tree)
    path_of = lambda path: scene.path_in_file(jax.tree_util.keystr(path, simple=True, separator="."))
    return {path_of(path): leaf for path, leaf in leaves}


class UsualTolerance(NamedTuple):
    """By how much an input usually differs from its nominal value: half of the range, SI, and the reason in words."""

    size: float
    reason: str


def effects(
    scene: AbstractScene, computed: Sensitivities, tolerances: Mapping[str, UsualTolerance]
) -> dict[str, dict[str, float]]:
    """By how much each result changes if an input changes by its tolerance, to first order: relative to the result, of
    `ABSOLUTE` results absolute (K). Inputs without a tolerance, of 0 or of several values are left out.

    **Arguments:** `tolerances`: by dotted path.
    """
    inputs = {path: float(value) for path, value in _by_path(scene, scene).items() if _is_one_number(value)}
    share = {path: tolerance.size / abs(inputs[path]) for path, tolerance in tolerances.items() if inputs.get(path)}
    return {
        name: {path: float(slopes[path]) * part for path, part in share.items() if path in slopes}
        for name, slopes in computed.modelled().items()
    }


def _is_one_number(leaf: Any) -> bool:
    return eqx.is_array_like(leaf) and not isinstance(leaf, bool) and np.ndim(leaf) == 0


def largest(values: Mapping[str, Array], count: int, leave_out: tuple[str, ...] = ()) -> list[str]:
    """Paths of the largest entries by modulus, the largest first, without zeros, NaN and paths below `leave_out`."""
    sizes = {path: abs(float(value)) for path, value in values.items() if not path.startswith(leave_out)}
    return sorted((path for path in sizes if sizes[path] > 0.0), key=lambda path: sizes[path], reverse=True)[:count]
