"""Which inputs decide the power loss and the slip: logarithmic sensitivities, all from one solve."""

from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .bearings.parts import AbstractScene
from .bearings.solution import Solution
from .numerics.compiling import collecting_rarely, quickly_compiled
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .solve import steady_function


class Sensitivities(eqx.Module):
    """Sensitivities to every number of a scene, by dotted path; dimensionless.

    - `power_loss`: d ln(total power loss) / d ln(input): per cent of power for one per cent of the input.
    - `slip`: d(cage slip) / d ln(input).

    Temperatures count in kelvin. An input that is 0 has 0 here, whatever its derivative.
    """

    power_loss: dict[str, Float[Array, ""]]
    slip: dict[str, Float[Array, ""]]


def sensitivities(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None
) -> tuple[Solution, Sensitivities]:
    """Solve a scene and differentiate its power loss and cage slip with respect to every number in it.

    One solve and one reverse pass through the implicit function theorem: the cost does not grow with the number of
    inputs. May be called inside `jax.jit` and `jax.vmap`.

    **Raises:** `ValueError` for a scene without power loss (dry, or rolling without slip); as `solve` otherwise.
    """
    return _run(scene, throw, NewtonOptions() if options is None else options, _ordinary)


def sensitivities_once(scene: AbstractScene) -> tuple[Solution, Sensitivities]:
    """What `sensitivities(scene, throw=False)` returns, for a process that asks once and ends."""
    return _run(scene, False, NewtonOptions(), _once)


@collecting_rarely()
def _run(scene: AbstractScene, throw: bool, options: NewtonOptions, function: Any) -> tuple[Solution, Sensitivities]:
    require_x64()
    steady_function(scene)
    solution, power_loss, slip = function(jax.tree.map(as_float, scene), options)
    if throw:
        solution.raise_if_failed()
    return solution, Sensitivities(_by_path(power_loss), _by_path(slip))


def _differentiated(scene: AbstractScene, options: NewtonOptions) -> tuple[Solution, Any, Any]:
    numbers, rest = eqx.partition(scene, eqx.is_inexact_array)

    def outputs(numbers_: Any) -> tuple[Array, Solution]:
        solution = steady_function(scene)(eqx.combine(numbers_, rest), options)
        if solution.cage is None:
            raise ValueError("sensitivities need a scene with power loss: one with contact.traction and a cage")
        return jnp.stack([solution.power_loss.total, solution.cage.slip]), solution

    values, pull_back, solution = jax.vjp(outputs, numbers, has_aux=True)
    (rows,) = jax.vmap(pull_back)(jnp.eye(2))
    power, slip = (jax.tree.map(lambda leaf, i=i: leaf[i], rows) for i in (0, 1))
    scaled = lambda slopes, scale: jax.tree.map(lambda x, slope: x * slope / scale, numbers, slopes)
    mask = lambda tree: jax.tree.map(lambda leaf: jnp.where(solution.converged, leaf, jnp.nan), tree)
    return solution, mask(scaled(power, values[0])), mask(scaled(slip, 1.0))


_ordinary = eqx.filter_jit(_differentiated)
_once = quickly_compiled(_differentiated)


def _by_path(tree: Any) -> dict[str, Float[Array, ""]]:
    leaves, _ = jax.tree_util.tree_flatten_with_path(tree)
    return {jax.tree_util.keystr(path, simple=True, separator="."): leaf for path, leaf in leaves}


def largest(values: Mapping[str, Array], count: int, leave_out: tuple[str, ...] = ()) -> list[str]:
    """Paths of the largest entries by modulus, the largest first, without zeros, NaN and paths below `leave_out`."""
    sizes = {path: abs(float(value)) for path, value in values.items() if not path.startswith(leave_out)}
    return sorted((path for path in sizes if sizes[path] > 0.0), key=lambda path: sizes[path], reverse=True)[:count]
