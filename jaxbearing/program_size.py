"""The size of the program that a solve compiles, what compiling it costs, and how other programs compile as fast."""

import time
from typing import Any, NamedTuple

import jax
import numpy as np
from jax.extend.core import Jaxpr

from .numerics.compiling import quick_options
from .numerics.precision import as_float, require_x64
from .solve import require_solvable, solve


class CompileReport(NamedTuple):
    """The program of `jb.solve` for a scene. Counts are the same on every machine; seconds are processor seconds.

    **Arguments:**
    - `equations`: traced, inner functions and loop bodies counted once each.
    - `lines`: of the program lowered to StableHLO: what a change of a model adds to the compiler's work.
    - `tracing`: tracing and lowering, s.
    - `optimised`: compiling with all optimisations, as `jit_solver` does, s; `None`: not asked for.
    - `quick`: compiling quickly, as a first `jb.solve` does, s; `None`: not asked for.
    """

    equations: int
    lines: int
    tracing: float
    optimised: float | None
    quick: float | None


def compile_report(scene: object, compile: bool = True) -> CompileReport:
    """Traces, lowers and compiles the solve of a scene anew, whatever is compiled or kept already.

    **Arguments:** `compile`: whether to compile too, which takes seconds; without it only the counts are found.

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
    """Options with which `jax.jit(f, compiler_options=...)` compiles as a first `jb.solve` does.

    On a CPU a derivative of a solve is then compiled in about a fifth of the time, and runs 2 to 5 times slower; on
    other devices there are no options. JAX takes them from the outermost `jax.jit` only.
    """
    return quick_options() if jax.default_backend() == "cpu" else {}


def _equations(jaxpr: Jaxpr, seen: set[int]) -> int:
    """Number of equations of a program with those inside of it; a function that is called twice counts once."""
    if id(jaxpr) in seen:
        return 0
    seen.add(id(jaxpr))
    total = len(jaxpr.eqns)
    for equation in jaxpr.eqns:
        parts = jax.tree.leaves(list(equation.params.values()), is_leaf=lambda part: hasattr(part, "eqns"))
        total += sum(_equations(getattr(part, "jaxpr", part), seen) for part in parts if hasattr(part, "eqns"))
    return total
