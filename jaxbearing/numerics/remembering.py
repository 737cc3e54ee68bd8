r"""Explicit Runge-Kutta methods for vector fields with a nested solve, which starts from the last step's solution.

The state that diffrax integrates is one flat vector: the state proper and, behind it, the integral of the nested
solution. That integral is of no use, but its rates, which a Runge-Kutta method keeps anyway, are the nested solutions
at all stages: three of them, including the last one, give a parabola that is extrapolated over the stages of the next
step. Nothing is computed twice, and a rejected step leaves nothing behind.
"""

from typing import Any, NamedTuple

import diffrax as dfx
from jaxtyping import Array, Float

from .._types import Scalar

FULL = 0.95
"""Place in a step, as a fraction of it, from which a stage counts as one at the end."""


class Memory(NamedTuple):
    """Value found at a time, its slope, 1/s, and half its curvature, 1/s^2."""

    time: Scalar
    value: Float[Array, " found"]
    slope: Float[Array, " found"]
    bend: Float[Array, " found"]

    def at(self, time: Scalar) -> Float[Array, " found"]:
        """The value extrapolated to another time."""
        later = time - self.time
        return self.value + later * (self.slope + later * self.bend)


class Remembering(dfx.AbstractAdaptiveSolver, dfx.AbstractWrappedSolver):
    """A Runge-Kutta method of diffrax whose vector field gets `(args, Memory)` instead of `args`.

    **Arguments:** `solver`: an explicit one. The state ends with as many components as `Memory` has (none if there is
    no solve inside); their rates are the solution that was found.
    """

    solver: Any

    @property
    def term_structure(self):  # pyright: ignore[reportIncompatibleVariableOverride]  (the wrapped solver's)
        return self.solver.term_structure

    @property
    def interpolation_cls(self):  # pyright: ignore[reportIncompatibleMethodOverride]
        return self.solver.interpolation_cls

    @property
    def term_compatible_contr_kwargs(self):  # pyright: ignore[reportIncompatibleVariableOverride]
        return self.solver.term_compatible_contr_kwargs

    @property
    def scan_kind(self) -> Any:
        """The `scan_kind` of the wrapped solver, where diffrax's adjoints set it through this name."""
        return self.solver.scan_kind

    def order(self, terms: object) -> int | None:
        return self.solver.order(terms)

    def error_order(self, terms: object) -> Any:
        return self.solver.error_order(terms)

    @property
    def _between(self) -> tuple[int, float]:
        """Number of the last stage before the end of the step (`FULL`), and its place in the step."""
        places = [0.0, *(float(c) for c in self.solver.tableau.c)]
        stage = max(i for i, place in enumerate(places) if place < FULL)
        return stage, places[stage]

    def init(self, terms: object, t0: Scalar, t1: Scalar, y0: object, args: Any) -> Any:
        return self.solver.init(terms, t0, t1, y0, args), args[1]

    def func(self, terms: object, t0: Scalar, y0: object, args: Any) -> Any:
        return self.solver.func(terms, t0, y0, args)

    def step(
        self, terms: object, t0: Scalar, t1: Scalar, y0: object, args: Any, solver_state: Any, made_jump: object
    ) -> Any:
        inner, memory = solver_state
        outcome = self.solver.step(terms, t0, t1, y0, (args[0], memory), inner, made_jump)
        y1, error, dense, inner, result = outcome
        # rates times the step, of the stages at its begin, between, and at its end
        length, rates = t1 - t0, dense["k"]
        stages = rates[:, rates.shape[1] - memory.value.shape[0] :]
        middle, place = self._between
        last = stages[-1] / length
        back = (last - stages[0] / length) / length
        near = (last - stages[middle] / length) / ((1.0 - place) * length)
        bend = (near - back) / (place * length)
        memory = Memory(t1, last, back + bend * length, bend)
        return y1, error, dense, (inner, memory), result
