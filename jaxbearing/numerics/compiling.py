"""Quick compilation of programs that run only a few times, so that compile time matters more than run time."""

import functools
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from .garbage import rare_garbage_collection

Given = ParamSpec("Given")
Result = TypeVar("Result")
IDLE_PASSES = (
    "reshape-mover",
    "simplify-while-loops",
    "tree_reduction_rewriter",
    "while-loop-constant-sinking",
    "while-loop-invariant-code-motion",
)
"""XLA passes that take more time than they save in one run. The algebraic simplifier undoes what the reshape mover
does: on a large program both repeated until XLA's limit of 25 rounds."""
_QUICK = {
    "xla_cpu_use_fusion_emitters": False,
    "xla_backend_optimization_level": 0,
    "xla_llvm_disable_expensive_passes": True,
    "xla_cpu_parallel_codegen_split_count": 4,
    "xla_disable_hlo_passes": ",".join(IDLE_PASSES),
}
"""Compiler options for a CPU: XLA's older loop emitter, and LLVM without its optimizations.

A bearing compiles in 0.65 of the time and 0.4 of the processor time. Its programs run 2 to 3 times slower, which is
milliseconds for one solve. Without the passes above, a first `jaxbearing solve` takes 0.75 to 0.95 of that time in
total. XLA splits LLVM's work into 32 parts, and each part has a cost: on two cores, a large program in four parts takes
0.92 of the processor time. The number is four on every machine, because it changes the last bits of results. The
options are not used on a GPU, where they have another meaning."""


@functools.cache
def quick_options() -> dict[str, Any]:
    """The options for quick compilation that this jaxlib knows; jaxlib 0.12 has no older loop emitter."""
    nothing = jax.jit(lambda: None).lower()

    def known(options: dict[str, Any]) -> bool:
        try:
            nothing.compile(options)
        except jax.errors.JaxRuntimeError as error:
            if "compile option" not in str(error).lower():
                raise
            return False
        return True

    return _QUICK if known(_QUICK) else {name: value for name, value in _QUICK.items() if known({name: value})}


def is_tracing() -> bool:
    """True while JAX traces a program: new arrays are then tracers. The test makes one array and compiles nothing."""
    return isinstance(jax.device_put(np.zeros(())), Tracer)


def inside_a_program(arguments: object) -> bool:
    """True while a program is being traced, or if one of the arguments is differentiated or batched.

    JAX takes compiler options only from the outermost call, which is then not ours."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(arguments)) or is_tracing()


def require_outside(verb: str, instead: str, *values: object) -> None:
    """Refuses the call of a function that cannot be part of a JAX program.

    **Arguments:** `verb`: name of the function; `instead`: what to use there; `values`: its arguments.

    **Raises:** `ValueError` while JAX traces (inside `jax.jit`), and if one of `values` is traced.
    """
    if inside_a_program(values):
        raise ValueError(f"{verb} was called inside of jit, vmap or grad, which it cannot be part of: {instead}")


def compiled_by_hand(function: Callable[Given, Result]) -> Callable[Given, Result]:
    """Compiles a law that has a loop inside, once for each shape of its arguments.

    Without this, JAX would compile the loop at every call from Python. Plain numbers become arrays. Calls inside a
    program are not changed."""
    compiled = eqx.filter_jit(function)

    def number(leaf: object) -> Any:
        return np.float64(leaf) if isinstance(leaf, int | float) and not isinstance(leaf, bool) else leaf

    @functools.wraps(function)
    def call(*args: Given.args, **kwargs: Given.kwargs) -> Result:
        if is_tracing():
            return function(*args, **kwargs)
        args, kwargs = jax.tree.map(number, (args, kwargs))
        return compiled(*args, **kwargs)

    return call


def quickly_compiled(function: Callable[Given, Result]) -> Callable[Given, Result]:
    """`equinox.filter_jit(function)` with the quick options on a CPU. It must not be called `inside_a_program`."""
    ordinary = eqx.filter_jit(function)

    @functools.cache
    def quick() -> Callable[Given, Result]:
        return eqx.filter_jit(function, compiler_options=quick_options())  # pyright: ignore[reportCallIssue]

    @rare_garbage_collection()
    def call(*args: Given.args, **kwargs: Given.kwargs) -> Result:
        chosen = quick() if jax.default_backend() == "cpu" else ordinary
        return chosen(*args, **kwargs)

    return call
