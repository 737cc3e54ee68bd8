r"""Explicit Runge-Kutta methods for vector fields with a solve inside: what the last step found is the next one's guess.

The state that diffrax integrates is one flat vector: the state proper and, behind it, the integral of what the inner
solve finds. That integral is of no use, but its rates, which a Runge-Kutta method keeps anyway, are what was found at
every stage: the last one begins the next step, and with the first one it gives the slope for an extrapolation over that
step's stages. Nothing is computed twice, and a refused step forgets what it found.
"""

from typing import Any, NamedTuple

import diffrax as dfx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar


class Memory(NamedTuple):
    """What was found at a time, and its slope, 1/s."""

    time: Scalar
    value: Float[Array, " found"]
    slope: Float[Array, " found"]

    def at(self, time: Scalar) -> Float[Array, " found"]:
        """Extrapolated."""
        return self.value + self.slope * (time - self.time)


class Remembering(dfx.AbstractAdaptiveSolver, dfx.AbstractWrappedSolver):
    """A Runge-Kutta method of diffrax whose vector field gets `(args, Memory)` instead of `args`.

    **Arguments:** `solver`, explicit; the state ends with as many components as `Memory` has, whose rates are what was
    found.
    """

    solver: Any

    @property
    def term_structure(self):
        return self.solver.term_structure

    @property
    def interpolation_cls(self):  # pyright: ignore[reportIncompatibleVariableOverride]
        return self.solver.interpolation_cls

    @property
    def term_compatible_contr_kwargs(self):
        return self.solver.term_compatible_contr_kwargs

    def order(self, terms: Any) -> int | None:
        return self.solver.order(terms)

    def error_order(self, terms: Any) -> Any:
        return self.solver.error_order(terms)

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> Any:
        return self.solver.init(terms, t0, t1, y0, args), args[1]

    def func(self, terms: Any, t0: Any, y0: Any, args: Any) -> Any:
        return self.solver.func(terms, t0, y0, args)

    def step(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: Any, made_jump: Any) -> Any:
        inner, memory = solver_state
        found = self.solver.step(terms, t0, t1, y0, (args[0], memory), inner, made_jump)
        y1, error, dense, inner, result = found
        # rates times the step, of the stages at its begin and its end
        length, stages = t1 - t0, dense["k"][:, -memory.value.shape[0] :]
        last = stages[-1] / length
        memory = Memory(t1, last, (last - stages[0] / length) / length)
        return y1, error, dense, (inner, memory), result
