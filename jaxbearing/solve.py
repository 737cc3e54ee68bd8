"""The steady verb: a scene in, a solution out."""

import dataclasses
from collections.abc import Callable
from contextlib import nullcontext
from typing import Any, overload

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax.core import Tracer

from ._checks import Checks
from ._scene import AbstractScene
from .bearings.ball.scene import BallBearing
from .bearings.ball.steady import solve_ball
from .bearings.cylindrical.scene import CylindricalRollerBearing
from .bearings.cylindrical.steady import solve_steady
from .bearings.cylindrical.tilting_steady import solve_tilting
from .bearings.ring import InnerRing
from .bearings.solution import Solution
from .bearings.tapered.scene import TaperedRollerBearing
from .bearings.tapered.steady import solve_tapered
from .ehl import EHLLineContact, LineContactSolution, solve_line_contact
from .life.bearing_life import with_life
from .machines import TwoDisk, TwoDiskSolution, solve_two_disk
from .numerics.checks import check_inputs, gate, void
from .numerics.compiling import inside_a_program
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.quiet import compiling_quietly, quiet_first_time
from .numerics.status import Status
from .programs import KeptProgram


def _solve_cylindrical(scene: CylindricalRollerBearing, options: NewtonOptions) -> Solution:
    # dry rollers that carry evenly leave a held ring without unknowns; those that may tilt have the same loads
    held = scene.contact is None and not scene.unknown_freedoms
    return solve_tilting(scene, options) if scene.tilts or held else solve_steady(scene, options)


_STEADY: dict[type, Callable[..., Any]] = {
    CylindricalRollerBearing: _solve_cylindrical,
    BallBearing: solve_ball,
    TaperedRollerBearing: solve_tapered,
    TwoDisk: solve_two_disk,
    EHLLineContact: solve_line_contact,
}


def steady_function(scene: AbstractScene) -> Callable[..., Any]:
    """Solver of this kind of scene. **Raises:** `TypeError` for an unknown kind."""
    try:
        return _STEADY[type(scene)]
    except KeyError:
        known = ", ".join(kind.__name__ for kind in _STEADY)
        raise TypeError(f"cannot solve a {type(scene).__name__}; solve takes: {known}") from None


@rare_garbage_collection()  # its body runs where it is traced
def _solve_any(scene: AbstractScene, options: NewtonOptions) -> Any:
    """The whole way from a scene to its solution."""
    return with_checked_inputs(scene, lambda lane: with_life(lane, steady_function(scene)(lane, options)))


def with_checked_inputs(scene: AbstractScene, compute: Callable[[Any], Any]) -> Any:
    """Result of `compute` for a scene, with the checks of its inputs. Where one is invalid it ends at once, in NaN."""
    inputs = check_inputs(scene)
    given: Any = gate(scene, inputs.valid)
    solution = compute(dataclasses.replace(given, operation=void(given.operation, inputs.valid)))
    return dataclasses.replace(
        solution,
        status=jnp.where(inputs.valid, solution.status, int(Status.INVALID_INPUT)),
        operation=given.operation,
        checks=Checks(dict(solution.checks), inputs.broken, inputs.rules),
    )


def solve_held(
    scene: BallBearing | CylindricalRollerBearing | TaperedRollerBearing,
    options: NewtonOptions,
    ring: InnerRing,
    exact_tilt: bool | None,
) -> Solution:
    """The steady state of a bearing whose inner ring is held where `ring` says; cylindrical rollers may tilt, but for
    those that slide.

    **Arguments:** `exact_tilt`: whether the grooves of a ball bearing move with the exact rotation of the ring; `None`:
    as the scene's own solve has it.
    """
    if isinstance(scene, BallBearing):
        return solve_ball(scene, options, ring, exact_tilt)
    if isinstance(scene, TaperedRollerBearing):
        return solve_tapered(scene, options, ring)
    return solve_steady(scene, options, ring) if scene.slips else solve_tilting(scene, options, ring)


_solve = eqx.filter_jit(_solve_any)
_solve_optimised = KeptProgram(_solve_any, quick=False)
_solve_quickly = KeptProgram(_solve_any, quick=True)


@overload
def solve(
    scene: TwoDisk, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> TwoDiskSolution: ...
@overload
def solve(
    scene: EHLLineContact, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> LineContactSolution: ...
@overload
def solve(
    scene: CylindricalRollerBearing | BallBearing | TaperedRollerBearing,
    *,
    throw: bool = True,
    options: NewtonOptions | None = None,
    optimised: bool = False,
) -> Solution: ...
@overload
def solve(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> Any: ...
def solve(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> Any:
    """Steady state of a scene: of a bearing, the traction curves of a two-disk machine, the film of a line contact.

    Compiled once per structure (kind, parts, number of rolling elements); new numbers never recompile. May be called
    inside `jax.jit`, `jax.vmap`, `jax.grad` and `jax.lax.map`; derivatives, in both modes and with respect to every
    number of the scene, go through the solution by the implicit function theorem.

    On a CPU the program is compiled quickly, in about a fifth of the time, and runs 2 to 5 times slower, milliseconds:
    one answer comes first that way. Where a scene is solved thousands of times, `optimised` or `jit_solver` pays.
    Inside a program, or where something is differentiated or batched, JAX compiles as it is told to.

    **Arguments:**
    - `scene`: from `load_scene`, or built from parts.
    - `throw`: raise where the solve fails. Inside `jit` or `vmap` nothing can be raised for one lane alone: look at
      `solution.status`; the results of a failed lane are NaN and those of the others are not touched.
    - `options`: tolerances of the Newton iteration; two-disk machines and line contacts have none.
    - `optimised`: compile with all of XLA's optimisations.

    **Raises:** `SolveError` with status, residual and worst equation; `TypeError` for 32-bit numbers or an unknown
    kind of scene; `RuntimeError` where 64-bit floats are switched off.
    """
    require_x64()
    steady_function(scene)
    inside = inside_a_program(scene)
    function = _solve if inside else _solve_optimised if optimised else _solve_quickly
    # small programs beside the large one are compiled too
    with nullcontext() if inside else quiet_first_time((solve, optimised, jax.tree.structure(scene))):
        solution = function(jax.tree.map(as_float, scene), chosen_options(options))
        if throw:
            solution.raise_if_failed()
    return solution


def chosen_options(options: NewtonOptions | None) -> NewtonOptions:
    """The given options or the usual ones. **Raises:** `TypeError` for something else."""
    if not isinstance(options, NewtonOptions | None):
        raise TypeError(f"options must be NewtonOptions, got {options!r}")
    return NewtonOptions() if options is None else options


def solve_once(scene: AbstractScene) -> Any:
    """Solves a scene as the commands do: a solve that fails does not raise."""
    return solve(scene, throw=False)


def jit_solver(scene: AbstractScene, *, options: NewtonOptions | None = None) -> Callable[..., Any]:
    """A compiled solver for scenes of this structure.

    Returns a function of a scene (left out: the one given here) and of keywords that change its operating point,
    `fast(inner_speed=1100.0)`. It never raises for a failed solve (look at `status`) and never recompiles when only
    numbers change.
    """
    chosen = chosen_options(options)
    require_x64()
    steady_function(scene)
    own_numbers = jax.tree.map(as_float, scene)
    given, structure = jax.tree.flatten(own_numbers)
    arguments = jax.tree.structure((own_numbers, chosen))
    # on the device once, and flat: less to do at each call
    numbers = [value if isinstance(value, Tracer) else jax.device_put(value) for value in given]

    @jax.jit
    def compiled(numbers: list[Any]) -> Any:
        return _solve_any(jax.tree.unflatten(structure, numbers), chosen)

    shapes, kept = [np.shape(number) for number in numbers], []

    def answer(numbers: list[Any]) -> Any:
        """Asks the kept program, or JAX's own where a number is traced or batched and where programs are not kept."""
        if any(isinstance(number, Tracer) for number in numbers) or [np.shape(one) for one in numbers] != shapes:
            return compiled(numbers)
        if kept:
            return kept[0](numbers)
        with compiling_quietly():
            kept.append(_solve_optimised.ready(arguments, numbers) or compiled)
            return kept[0](numbers)

    # of leaves that a changed copy has in common with it
    own = jax.tree.unflatten(structure, given)

    def fast(other: AbstractScene | None = None, /, **operation: Any) -> Any:
        if other is None and not operation:
            return answer(numbers)
        if not isinstance(other, AbstractScene | None):
            raise TypeError(f"expected a scene, or keywords of the operating point, got {type(other).__name__}")
        changed = own if other is None else other
        # outside of the program, which is the same for whatever is changed
        changed = changed.at_operation(**operation) if operation else changed
        others, kind = jax.tree.flatten(changed)
        if kind == structure:
            leaves = zip(others, given, numbers, strict=True)
            return answer([kept if new is old else as_float(new) for new, old, kept in leaves])
        return _solve(jax.tree.map(as_float, changed), chosen)

    return fast
