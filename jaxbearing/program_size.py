"""Size and compile time of the program of a solve, and options to compile other programs as quickly."""

import time
from typing import Any, NamedTuple

import jax
import numpy as np
from jax.extend.core import Jaxpr

from .numerics.compiling import quick_options
from .numerics.precision import as_float, require_x64
from .solve import require_solvable, solve


class CompileReport(NamedTuple):
    """Size and compile time of the program of `jb.solve` for a scene. Counts are the same on every machine; times are
    processor times.

    **Arguments:**
    - `equations`: number of traced equations; each inner function and loop body counts once.
    - `lines`: number of lines of the program in StableHLO, a measure of the compiler's work.
    - `tracing`: time to trace and lower the program, s.
    - `optimised`: time to compile it with all optimisations, as `jit_solver` does, s; `None`: not asked for.
    - `quick`: time to compile it quickly, as a first `jb.solve` does, s; `None`: not asked for.
    """

    equations: int
    lines: int
    tracing: float
    optimised: float | None
    quick: float | None


def compile_report(scene: object, compile: bool = True) -> CompileReport:
    """Traces, lowers and compiles the solve of a scene anew, even if a compiled program is cached.

    **Arguments:** `compile`: False to leave out compiling, which takes seconds.

    **Raises:** `TypeError` for a kind of scene that cannot be solved.
    """
    require_x64()
    require_solvable(scene)
    leaves, structure = jax.tree.flatten(jax.tree.map(as_float, scene))

    def program(numbers: list[Any]) -> list[Any]:
        solution = solve(jax.tree.unflatten(structure, numbers), throw=False)
        return [leaf for leaf in jax.tree.leaves(solution) if isinstance(leaf, jax.Array | np.ndarray)]

    begin = time.process_time()
    traced = jax.jit(program).trace(leaves)
    lowered = traced.lower()
    tracing, seconds = time.process_time() - begin, []
    for options in (None, quick_options()) if compile else ():
        begin = time.process_time()
        lowered.compile(options)
        seconds.append(time.process_time() - begin)
    optimised, quick = seconds or (None, None)
    return CompileReport(
        _equations(traced.jaxpr.jaxpr, set()), len(lowered.as_text().splitlines()), tracing, optimised, quick
    )


def quick_compile_options() -> dict[str, Any]:
    """Options with which `jax.jit(f, compiler_options=...)` compiles as quickly as a first `jb.solve`.

    On a CPU a derivative of a solve then compiles in about a fifth of the time, and runs 2 to 5 times slower. On other
    devices the options are empty. JAX uses those of the outermost `jax.jit` only.
    """
    return quick_options() if jax.default_backend() == "cpu" else {}


def _equations(jaxpr: Jaxpr, seen: set[int]) -> int:
    """Number of equations of a program, including its inner functions; a function that is called twice counts once."""
    if id(jaxpr) in seen:
        return 0
    seen.add(id(jaxpr))
    total = len(jaxpr.eqns)
    for equation in jaxpr.eqns:
        parts = jax.tree.leaves(list(equation.params.values()), is_leaf=lambda part: hasattr(part, "eqns"))
        total += sum(_equations(getattr(part, "jaxpr", part), seen) for part in parts if hasattr(part, "eqns"))
    return total
