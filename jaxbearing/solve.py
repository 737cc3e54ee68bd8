"""`solve` and `jit_solver`: from a scene to its steady state.

A scene is the complete description of a problem: an object of the package, loaded from a file or built in Python.
Four programs compute the same solution. Which one runs depends on where `solve` is called:

- `_solve_quickly`: outside of `jax.jit`. It is compiled quickly, and cached on the disk.
- `_solve_optimised`: the same with `optimised=True`, and in `jit_solver`. It is compiled with all optimisations, and
  cached.
- `_solve_differentiated`: outside of `jax.jit`, for numbers that are differentiated or batched. It solves first, and
  then evaluates the solution once more at the roots that were found. The roots are the unknowns of all iterations of a
  solve, so the second evaluation needs no iteration, and its derivatives are those of the implicit function theorem.
- `_solve`: inside of `jax.jit`, as a part of the user's program; and with `optimised=True` for numbers that are
  differentiated or batched.
"""

from collections.abc import Callable
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any, overload

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from ._scene import AbstractScene, AbstractSolution, with_checked_inputs
from .bearings.bearing_life import with_life
from .numerics.compiling import inside_a_program, is_tracing
from .numerics.garbage import rare_garbage_collection
from .numerics.newton import NewtonOptions
from .numerics.precision import as_float, require_x64
from .numerics.quiet import compiling_quietly, quiet_first_time
from .programs import KeptProgram
from .programs.differentiated import at_roots, differentiable, solved, with_roots

if TYPE_CHECKING:
    from .bearings.ball.scene import BallBearing
    from .bearings.ball.solution import BallSolution
    from .bearings.cylindrical.scene import CylindricalRollerBearing
    from .bearings.cylindrical.solution import RollerSolution
    from .bearings.tapered.scene import TaperedRollerBearing
    from .bearings.tapered.solution import TaperedSolution
    from .ehl import EHLLineContact, LineContactSolution
    from .machines import TwoDisk, TwoDiskSolution
    from .shafts import ShaftSolution, ShaftSystem


def require_solvable(scene: object) -> None:
    """**Raises:** `TypeError` if `scene` is not a scene, or if its kind has no steady state."""
    if not isinstance(scene, AbstractScene) or type(scene).steady_solution is AbstractScene.steady_solution:
        kinds = "a ball, cylindrical or tapered roller bearing, a shaft, a two-disk machine or a line contact"
        raise TypeError(f"cannot solve a {type(scene).__name__}; solve takes: {kinds}")


@rare_garbage_collection()  # the function body runs only while it is traced
def _solve_any(scene: AbstractScene, options: NewtonOptions) -> AbstractSolution:
    """All computations from a scene to its solution."""
    return with_checked_inputs(scene, lambda lane: with_life(lane, lane.steady_solution(options)))


_solve = eqx.filter_jit(_solve_any)
_solve_optimised = KeptProgram(_solve_any, quick=False)


def _solve_quickly(scene: AbstractScene, options: NewtonOptions) -> AbstractSolution:
    return solve_with_roots(scene, options)[0]


def _solve_differentiated(scene: AbstractScene, options: NewtonOptions) -> AbstractSolution:
    """A solve outside of `jax.jit`, for a scene with numbers that are differentiated or batched."""
    return differentiable(_solve_any, _solve, scene, options)


def solve_with_roots(scene: AbstractScene, options: NewtonOptions) -> tuple[Any, tuple[Any, ...]]:
    """The solution, and the roots that `solution_at` takes. If JAX traces no number of the scene, the cached program of
    `solve` runs."""
    return (with_roots if inside_a_program(scene) else solved)(_solve_any, scene, options)


def solution_at(
    roots: tuple[Any, ...], scene: AbstractScene, options: NewtonOptions, *, stiffness: bool = False
) -> Any:
    """The solution, computed from its roots without iteration, for differentiation. If `stiffness` is False, the
    derivatives of the stiffness in the solution are NaN. True needs a larger program, which takes longer to compile."""
    return at_roots(_solve_any, roots, scene, options, stiffness=stiffness)


@overload
def solve(
    scene: "BallBearing", *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> "BallSolution": ...
@overload
def solve(
    scene: "CylindricalRollerBearing",
    *,
    throw: bool = True,
    options: NewtonOptions | None = None,
    optimised: bool = False,
) -> "RollerSolution": ...
@overload
def solve(
    scene: "TaperedRollerBearing", *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> "TaperedSolution": ...
@overload
def solve(
    scene: "TwoDisk", *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> "TwoDiskSolution": ...
@overload
def solve(
    scene: "EHLLineContact", *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> "LineContactSolution": ...
@overload
def solve(
    scene: "ShaftSystem", *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> "ShaftSolution": ...
@overload
def solve(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> Any: ...
def solve(
    scene: AbstractScene, *, throw: bool = True, options: NewtonOptions | None = None, optimised: bool = False
) -> AbstractSolution:
    """The steady state of a scene: the equilibrium of a bearing or of a shaft on bearings, the traction curves of a
    two-disk machine, or the film of a line contact.

    The program is compiled once for each structure (kind, parts, number of rolling elements); new numbers never
    recompile it. `solve` may be called inside `jax.jit`, `jax.vmap`, `jax.grad` and `jax.lax.map`. Derivatives with
    respect to every number of the scene, in forward and reverse mode, follow from the implicit function theorem.

    On a CPU the program is compiled with few optimisations (quickly). This takes about a fifth of the usual time, and
    the program then runs 2 to 5 times slower, a difference of milliseconds. This is best for a single solve. For
    thousands of solves use `optimised` or `jit_solver`. First derivatives outside of `jax.jit` come from a second
    program, which is compiled quickly too. It makes one forward pass for each number that is differentiated. Inside
    `jax.jit`, in a batch and for second derivatives, JAX's own compiler options apply; `quick_compile_options` returns
    those of a quick compilation, which `jax.jit` takes.

    **Arguments:**
    - `scene`: from `load_scene`, or built from parts.
    - `throw`: whether a solve that fails raises an error. Inside `jit` or `vmap` none is raised: look at
      `solution.status`. The results of a failed lane are NaN, and other lanes are unaffected.
    - `options`: tolerances of the Newton iteration; two-disk machines and line contacts do not use them.
    - `optimised`: compile with all of XLA's optimisations. Solution and derivatives then come from one program.

    **Raises:** `SolveError` with status, residual and worst equation; `TypeError` for 32-bit numbers or an unknown
    kind of scene; `RuntimeError` where 64-bit floats are switched off.
    """
    require_x64()
    require_solvable(scene)
    inside = inside_a_program(scene)
    if inside:
        function = _solve if optimised or is_tracing() else _solve_differentiated
    else:
        function = _solve_optimised if optimised else _solve_quickly
    # auxiliary programs are compiled too; their messages are not shown to the user
    quiet = nullcontext() if inside else quiet_first_time((solve, optimised, jax.tree.structure(scene)))
    with rare_garbage_collection(), quiet:  # derivatives are traced here too
        solution = function(jax.tree.map(as_float, scene), chosen_options(options))
        if throw:
            solution.raise_if_failed()
    return solution


def chosen_options(options: NewtonOptions | None) -> NewtonOptions:
    """The given options, or the defaults. **Raises:** `TypeError` if they are of another type."""
    if not isinstance(options, NewtonOptions | None):
        raise TypeError(f"options must be NewtonOptions, got {options!r}")
    return NewtonOptions() if options is None else options


def solve_once(scene: AbstractScene) -> Any:
    """Solves a scene; a solve that fails does not raise."""
    return solve(scene, throw=False)


def jit_solver(scene: AbstractScene, *, options: NewtonOptions | None = None) -> Callable[..., Any]:
    """A compiled solver for scenes of this structure.

    Returns a function, here called `fast`. Its argument is a scene, by default the one given here. Its keywords change
    the operating point of the scene, for example `fast(inner_speed=1100.0)`. It never raises for a failed solve; see
    `status` of the solution. It never recompiles if only numbers change.
    """
    chosen = chosen_options(options)
    require_x64()
    require_solvable(scene)
    own_numbers = jax.tree.map(as_float, scene)
    values, structure = jax.tree.flatten(own_numbers)
    arguments = jax.tree.structure((own_numbers, chosen))
    # the leaves go to the device once and are passed as a list, which saves work at each call
    numbers = [value if isinstance(value, Tracer) else jax.device_put(value) for value in values]

    @jax.jit
    def compiled(numbers: list[Any]) -> AbstractSolution:
        return _solve_any(jax.tree.unflatten(structure, numbers), chosen)

    shapes, programs = [np.shape(number) for number in numbers], []

    def answer(numbers: list[Any]) -> AbstractSolution:
        """Calls the cached program. Calls the `jax.jit` function instead if a number is traced or batched, or if
        programs are not cached."""
        if any(isinstance(number, Tracer) for number in numbers) or [np.shape(number) for number in numbers] != shapes:
            return compiled(numbers)
        if programs:
            return programs[0](numbers)
        with compiling_quietly():
            programs.append(_solve_optimised.ready(arguments, numbers) or compiled)
            return programs[0](numbers)

    # a changed copy shares its unchanged leaves with this scene: `is` recognises them
    own = jax.tree.unflatten(structure, values)

    def fast(other: AbstractScene | None = None, /, **operation: Any) -> AbstractSolution:
        if other is None and not operation:
            return answer(numbers)
        if not isinstance(other, AbstractScene | None):
            raise TypeError(f"expected a scene, or keywords of the operating point, got {type(other).__name__}")
        changed = own if other is None else other
        # the operating point is changed outside of the program, so that the same program serves every change
        changed = changed.at_operation(**operation) if operation else changed
        others, kind = jax.tree.flatten(changed)
        if kind == structure:
            leaves = zip(others, values, numbers, strict=True)
            return answer([on_device if new is old else as_float(new) for new, old, on_device in leaves])
        return _solve(jax.tree.map(as_float, changed), chosen)

    return fast
