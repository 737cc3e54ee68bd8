"""Programs that run a few times: compile time counts, run time does not."""

import functools
from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import numpy as np
from jax.core import Tracer

from .garbage import rare_garbage_collection

IDLE_PASSES = (
    "reshape-mover",
    "simplify-while-loops",
    "tree_reduction_rewriter",
    "while-loop-constant-sinking",
    "while-loop-invariant-code-motion",
)
"""Passes of XLA that cost more than one run gains. What the reshape mover does the algebraic simplifier undoes: of a
large program all passes ran 25 times, the most that XLA allows."""
_QUICK = {
    "xla_cpu_use_fusion_emitters": False,
    "xla_backend_optimization_level": 0,
    "xla_llvm_disable_expensive_passes": True,
    "xla_cpu_parallel_codegen_split_count": 4,
    "xla_disable_hlo_passes": ",".join(IDLE_PASSES),
}
"""On a CPU, XLA's older way to emit loops, and LLVM without its optimizations: a bearing compiles in 0.65 of the time
and 0.4 of the processor time; its programs run 2 to 3 times slower, milliseconds for one solve. Without the passes
above all of a first `jaxbearing solve` takes 0.75 to 0.95 of that. XLA cuts LLVM's work into 32 parts, each of which
costs something: on two cores a large program in four parts takes 0.92 of the processor time. Four on every machine, as
the number of parts changes last bits. None of it on a GPU, where the options stand for something else."""


@functools.cache
def quick_options() -> dict[str, Any]:
    """Options of XLA for quick compilation, those that this jaxlib knows: jaxlib 0.12 has dropped the older way to emit
    loops."""
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
    """True while JAX traces a program: every new array is traced then. A number that is only moved compiles nothing."""
    return isinstance(jax.device_put(np.zeros(())), Tracer)


def inside_a_program(arguments: Any) -> bool:
    """True while a program is being traced, or where one of the arguments is differentiated or batched: JAX takes
    options of the compiler only from the outermost call, which is then not ours."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(arguments)) or is_tracing()


def compiled_by_hand(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compiles a law with a loop inside once for each shape where it is called by hand: JAX would compile the loop at
    every call. Plain numbers are arrays then. Inside a program nothing changes."""
    compiled = eqx.filter_jit(function)

    def number(leaf: Any) -> Any:
        return np.float64(leaf) if isinstance(leaf, int | float) and not isinstance(leaf, bool) else leaf

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        if is_tracing():
            return function(*args, **kwargs)
        args, kwargs = jax.tree.map(number, (args, kwargs))
        return compiled(*args, **kwargs)

    return call


def quickly_compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """`equinox.filter_jit(function)`, on a CPU compiled fast. Not to be called where `inside_a_program`."""
    ordinary = eqx.filter_jit(function)

    @functools.cache
    def quick() -> Callable[..., Any]:
        return eqx.filter_jit(function, compiler_options=quick_options())  # pyright: ignore[reportCallIssue]

    @rare_garbage_collection()
    def call(*args: Any, **kwargs: Any) -> Any:
        chosen = quick() if jax.default_backend() == "cpu" else ordinary
        return chosen(*args, **kwargs)

    return call
