"""The port verb: displacements of the inner ring in, what must act on it to hold it there out.

A bearing inside a set, or on a shaft, is known by its port ([arrangements, sections 1 and 2]): five displacements of
the inner ring against the outer one, five conjugate loads, and the derivatives of these by those.
"""

import dataclasses
from collections.abc import Sequence
from typing import Any, Literal

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.core import Tracer
from jaxtyping import Array, Float

from ._types import Scalar
from .bearings.ball_bearing import BallBearing
from .bearings.ball_steady import solve_ball
from .bearings.cylindrical_roller import CylindricalRollerBearing
from .bearings.ring import held_ring, shift_matrix
from .bearings.solution import RING_FREEDOMS, RingDisplacement, Solution
from .bearings.tapered_roller import TaperedRollerBearing
from .bearings.tapered_steady import solve_tapered
from .bearings.tilting_steady import solve_tilting
from .numerics.arguments import require_choice
from .numerics.compiling import inside_a_program
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.quiet import quiet_first_time
from .programs import KeptProgram
from .solve import chosen_options, with_checked_inputs

Bearing = BallBearing | CylindricalRollerBearing | TaperedRollerBearing
_POINTS, _TILTS = ("port", "ring"), ("exact", "linear")


def reaction(
    scene: Bearing,
    displacement: RingDisplacement | Sequence[Any] | Array,
    *,
    at: Literal["port", "ring"] = "port",
    tilt: Literal["exact", "linear"] | None = None,
    closure: Scalar = 0.0,
    expansion: Scalar = 0.0,
    throw: bool = True,
    options: NewtonOptions | None = None,
) -> Solution:
    r"""What must act on the inner ring of a bearing to hold it at given displacements.

    The solution is that of the displaced bearing: `force` (axial, radial, lateral in N, about both tilts in N m), its
    derivatives `stiffness`, shape (5, 5), and the losses, torques and results of the rolling elements that `solve` has.
    The loads of the scene's operating point are not looked at; its speeds, oil and temperature are. May be called
    inside `jax.jit`, `jax.vmap` and `jax.grad`. Nothing in the stiffness is made symmetric: with each ball's own
    centrifugal force, with couples or with friction it is not.

    A cylindrical roller bearing has no axial freedom, its rollers tilt, and they are dry or roll without sliding.

    **Arguments:**
    - `scene`: a ball, cylindrical or tapered roller bearing.
    - `displacement`: axial, radial and lateral displacement, m, tilt and lateral tilt, rad, of the inner ring against
      the outer one; shape (5,), or a `RingDisplacement` such as `solution.ring`.
    - `at`: the point of the ring that is displaced. "port": on the axis in the plane of the unloaded balls, or in the
      middle of the rollers; "ring": where `solution.ring` of a solve counts (the plane of the inner groove centres, the
      reference point of a tapered bearing).
    - `tilt`: how the inner grooves of a ball bearing move: with the "exact" rotation of the ring, or "linear", to first
      order, as in the standards. The latter is 1e-4 to 1e-2 of the force off at 0.2 mrad, and 2 % at 4 mrad. Left out:
      as a solve of the scene has it, exact where its operating point names a moment or a misalignment.
    - `closure`: added to the axial displacement, m: of a bearing that is adjusted against another one.
    - `expansion`: growth of the inner raceway's radius less that of the outer one, m.
    - `throw`, `options`: of `solve`.

    **Raises:** `SolveError` where the solve fails; `TypeError` for another kind of scene; `ValueError` for a
    displacement of another shape, or a cylindrical roller bearing with sliding friction.
    """
    require_x64()
    require_choice("at", at, _POINTS)
    if tilt is not None:
        require_choice("tilt", tilt, _TILTS)
    if not isinstance(scene, Bearing):
        raise TypeError(f"reaction takes a bearing, got a {type(scene).__name__}")
    if isinstance(scene, CylindricalRollerBearing) and scene.slips:
        raise ValueError(
            "contact.traction: the reaction of a cylindrical roller bearing is that of rollers that may tilt, which "
            "are not modelled with sliding friction; leave it out"
        )
    numbers: Any = (jax.tree.map(as_float, scene), _as_array(displacement), as_float(closure), as_float(expansion))
    inside = inside_a_program(numbers)
    function = _react if inside else _react_quickly
    with quiet_first_time((reaction, jax.tree.structure(scene), at, tilt)):
        solution = function(*numbers, chosen_options(options), at, tilt)
        if throw:
            solution.raise_if_failed()
    return solution


def _as_array(displacement: Any) -> Array | np.ndarray:
    """**Raises:** `ValueError` for what are not five numbers."""
    if isinstance(displacement, RingDisplacement):
        displacement = [getattr(displacement, name) for name in RING_FREEDOMS]
    leaves = jax.tree.leaves(displacement)
    found: Any = displacement
    if not isinstance(displacement, jax.Array):
        found = jnp.stack(leaves) if any(isinstance(leaf, Tracer) for leaf in leaves) else np.asarray(leaves, float)
        if len(leaves) == 1:
            found = found[0]
    if found.shape != (5,):
        raise ValueError(f"displacement must have five numbers, {', '.join(RING_FREEDOMS)}; got shape {found.shape}")
    return as_float(found)


def _react_any(
    scene: Bearing,
    displacement: Float[Array, "5"],
    closure: Float[Array, ""],
    expansion: Float[Array, ""],
    options: NewtonOptions,
    at: str,
    tilt: str | None,
) -> Solution:
    def react(lane: Bearing) -> Solution:
        shift = shift_matrix(lane.port_distance if at == "port" else jnp.zeros(()))
        moved = (shift @ displacement).at[0].add(closure)
        ring = held_ring(moved, lane.ring_lever, expansion)
        if isinstance(lane, BallBearing):
            solution = solve_ball(lane, options, ring, lane.operation.tilts if tilt is None else tilt == "exact")
        elif isinstance(lane, TaperedRollerBearing):
            solution = solve_tapered(lane, options, ring)
        else:
            solution = solve_tilting(lane, options, ring)
        return dataclasses.replace(
            solution,
            ring=RingDisplacement(**dict(zip(RING_FREEDOMS, displacement, strict=True))),
            force=shift.T @ solution.force,
            stiffness=shift.T @ solution.stiffness @ shift,
        )

    return with_checked_inputs(scene, react)


_react = eqx.filter_jit(_react_any)
_react_quickly = KeptProgram(_react_any, quick=True)
