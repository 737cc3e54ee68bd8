"""The port verb: displacements of the inner ring in, what must act on it to hold it there out.

A bearing inside a set, or on a shaft, is known by its port: five displacements of the inner ring against the outer one,
five conjugate loads, and the derivatives of these by those (frame and signs: `bearings.ring`).
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ._scene import only_if, with_checked_inputs
from ._types import Scalar
from .bearings.bearing import AbstractBearing
from .bearings.ring import held_ring
from .bearings.solution import RING_FREEDOMS, RingDisplacement, Solution
from .numerics.arguments import require_choice, require_numbers
from .numerics.compiling import inside_a_program, is_tracing
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.quiet import quiet_first_time
from .numerics.status import Status
from .programs.differentiated import differentiable, solved
from .solve import chosen_options

_POINTS, _TILTS = ("port", "ring"), ("exact", "linear")


def reaction(
    scene: AbstractBearing,
    displacement: RingDisplacement | Mapping[str, object] | Sequence[object] | Array,
    *,
    at: Literal["port", "ring"] = "port",
    tilt: Literal["exact", "linear"] | None = None,
    closure: Scalar = 0.0,
    expansion: Scalar = 0.0,
    throw: bool = True,
    options: NewtonOptions | None = None,
) -> Solution:
    r"""Computes the loads that hold the inner ring of a bearing at given displacements.

    The solution is that of the displaced bearing: `force` (axial, radial, lateral in N, about both tilts in N m), its
    derivatives `stiffness`, shape (5, 5), `ring`, the given displacements, and losses, torques and results of the
    rolling elements as `solve` gives them. The loads of the scene's operating point have no effect, but must be valid;
    nor has its rating (`life` is `None`). May be called inside `jax.jit`, `jax.vmap` and `jax.grad`; where a lane fails
    its results are NaN, and where a traced number is not finite its status is `invalid_input`.

    Nothing in the stiffness is made symmetric: with each ball's own centrifugal force, with couples or with friction it
    is not. As in the loads of `solve`, friction along the raceways is left out of the force (of `turbine_ball` 0.1 %
    of it, across the load), and of balls that slide the turning of the race under them is left out of the derivatives
    by the tilts (3e-6). A cylindrical roller bearing resists an axial displacement by its flanges alone
    (`geometry.flange_stiffness`). Its rollers tilt with the ring.

    **Arguments:**
    - `scene`: a ball, cylindrical or tapered roller bearing.
    - `displacement`: axial, radial and lateral displacement, m, tilt and lateral tilt, rad, of the inner ring against
      the outer one: five numbers in this order, an array of shape (5,), the numbers by their names, or a
      `RingDisplacement` such as `solution.ring`.
    - `at`: the point of the ring that is displaced. "port": on the axis in the plane of the unloaded balls, or in the
      middle of the rollers, of a bearing on seats as on the drawing; "ring": where `solution.ring` of a solve counts
      (the plane of the inner groove centres, the reference point of a tapered bearing).
    - `tilt`: how the inner grooves of a ball bearing move: with the "exact" rotation of the ring, or "linear", to first
      order, with the true lever. The latter is 1e-4 to 1e-2 of the force off at 0.2 mrad, and 2 % at 4 mrad. Left out:
      as a solve of the scene has it, exact where its operating point names a moment or a misalignment, and by the
      standard where `rating.tilt` is "iso".
    - `closure`: added to the axial displacement, m: of a bearing that is adjusted against another one. `ring` does not
      hold it.
    - `expansion`: expansion of the inner raceway's radius less that of the outer one, m.
    - `throw`, `options`: of `solve`.

    **Raises:** `SolveError` where the solve fails; `TypeError` for another kind of scene; `ValueError` for what are not
    five displacements, or no number.
    """
    require_x64()
    require_choice("at", at, _POINTS)
    if tilt is not None:
        require_choice("tilt", tilt, _TILTS)
    if not isinstance(scene, AbstractBearing):
        raise TypeError(f"reaction takes a bearing, got a {type(scene).__name__}")
    five = _five(displacement)
    lengths = [_number(name, value) for name, value in (("closure", closure), ("expansion", expansion))]
    numbers: Any = (jax.tree.map(as_float, scene), five, *lengths)
    inside = inside_a_program(numbers)
    if inside:
        function: Callable[..., Solution] = _react if is_tracing() else _react_differentiated
    else:
        function = _react_quickly
    quiet = nullcontext() if inside else quiet_first_time((reaction, jax.tree.structure(scene), at, tilt))
    with rare_garbage_collection(), quiet:  # derivatives are traced here too
        solution = function(*numbers, chosen_options(options), at, tilt)
        if throw:
            solution.raise_if_failed()
    return solution


def _number(name: str, value: Any) -> Array | np.ndarray:
    """**Raises:** `ValueError` for what is not one number."""
    require_numbers("finite", **{name: value})
    if np.shape(value) != ():
        raise ValueError(f"{name} must be one number, got shape {np.shape(value)}")
    return as_float(value)


def _five(displacement: object) -> Array | np.ndarray:
    """The five displacements as an array. **Raises:** `ValueError` for something else."""
    expected = f"displacement must have five numbers, {', '.join(RING_FREEDOMS)}"
    if isinstance(displacement, RingDisplacement):
        displacement = [getattr(displacement, name) for name in RING_FREEDOMS]
    elif isinstance(displacement, Mapping):
        if set(displacement) != set(RING_FREEDOMS):
            raise ValueError(f"{expected}; got {', '.join(map(str, displacement))}")
        displacement = [displacement[name] for name in RING_FREEDOMS]
    if isinstance(displacement, jax.Array | np.ndarray):
        if displacement.shape != (5,):
            raise ValueError(f"{expected}; got shape {displacement.shape}")
        require_numbers("finite", displacement=displacement)
        return as_float(displacement)
    if not isinstance(displacement, list | tuple) or len(displacement) != 5:
        raise ValueError(f"{expected}; got {displacement!r}")
    numbers = [
        _number(f"displacement, {name},", value) for name, value in zip(RING_FREEDOMS, displacement, strict=True)
    ]
    return jnp.stack(numbers) if any(isinstance(number, jax.Array) for number in numbers) else np.stack(numbers)


@rare_garbage_collection()
def _react_any(
    scene: AbstractBearing,
    displacement: Float[Array, "5"],
    closure: Float[Array, ""],
    expansion: Float[Array, ""],
    options: NewtonOptions,
    at: str,
    tilt: str | None,
) -> Solution:
    if tilt is not None and scene.rating is not None and scene.rating.tilt == "iso":
        scene = scene.replace({"rating.tilt": "exact"})
    numbers = (displacement, closure, expansion)
    finite = jnp.all(jnp.stack([jnp.all(jnp.isfinite(number)) for number in numbers]))

    def react(lane: AbstractBearing) -> Solution:
        displacement, closure, expansion = (jnp.where(finite, number, 0.0) for number in numbers)
        solution = at_displacement(only_if(lane, finite), displacement, closure, expansion)
        return dataclasses.replace(solution, status=jnp.where(finite, solution.status, int(Status.INVALID_INPUT)))

    def at_displacement(lane: AbstractBearing, displacement: Array, closure: Array, expansion: Array) -> Solution:
        def of_running(running: AbstractBearing) -> Solution:
            # the port of a bearing on seats is that of the drawing: a point of the shaft, whatever the rings do
            distance = lane.port_distance if at == "port" else jnp.zeros(())
            ring = held_ring(displacement, running.ring_lever, distance, closure, expansion)
            return running.solve_ring(options, ring, None if tilt is None else tilt == "exact")

        return lane.solved_running(of_running)

    return with_checked_inputs(scene, react)


_react = eqx.filter_jit(_react_any)


def _react_quickly(*arguments: object) -> Solution:
    return solved(_react_any, *arguments)[0]


def _react_differentiated(*arguments: object) -> Solution:
    return differentiable(_react_any, _react, *arguments)
