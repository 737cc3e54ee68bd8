"""Options and results of an integration in time. They are apart from `integrate`, which imports diffrax."""

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, get_args

from jaxtyping import Array, Float, Int

from .._types import Scalar
from .arrow import ArrowPoint
from .checks import Checked, bounded
from .precision import as_float
from .structure import choice, count

Solver = Literal["tsit5", "dopri8", "kvaerno3", "kvaerno4", "kvaerno5", "implicit_euler", "auto"]
SOLVERS: tuple[str, ...] = get_args(Solver)
IMPLICIT = ("kvaerno3", "kvaerno4", "kvaerno5", "implicit_euler")
Field = Callable[[Scalar, ArrowPoint, Any], ArrowPoint]


class NestedField(NamedTuple):
    """A vector field with equations that are solved inside it, from a guess of their solution.

    - `rates(time, state, args, guess, tolerance)`: rates, and the solution of the inner equations; `tolerance`: that of
      the integration.
    - `guess(time, state, args)`: first guess of the solution, for a state that nothing is known about.
    """

    rates: Callable[[Scalar, ArrowPoint, Any, ArrowPoint, Scalar], tuple[ArrowPoint, ArrowPoint]]
    guess: Callable[[Scalar, ArrowPoint, Any], ArrowPoint]


class IntegratorOptions(Checked):
    """Options of the integrator.

    **Arguments:**
    - `solver`: one of `SOLVERS`; "auto" is tsit5 or kvaerno5, by the stiffness that it measures (`switching`).
    - `tolerance`: relative tolerance, and absolute one in the units of the state.
    - `max_steps`: limit of the steps of one segment, rejected ones included.
    - `elimination`: elimination of the stage equations of implicit solvers: "arrow", or "dense" for comparison.
    - `shortest_step`: lower limit of the step, s; a run that would need a shorter one has failed.
    """

    solver: str = choice("solver", SOLVERS, "tsit5")
    tolerance: Scalar = bounded("> 0", converter=as_float, default=1e-5)
    max_steps: int = count("max_steps", 100_000, least=1)
    elimination: str = choice("elimination", ("arrow", "dense"), "arrow")
    shortest_step: Scalar = bounded("> 0", converter=as_float, default=1e-14)


class Segment(NamedTuple):
    """Result of one segment of an integration.

    - `states`: at the given times; infinite after the time at which the segment stopped.
    - `last`, `last_time`: last state that was reached, and its time, s.
    - `status`: how the segment ended; `accepted`, `rejected`: numbers of steps.
    - `step`: mean accepted step, s, with which the next segment may begin.
    """

    states: ArrowPoint
    last: ArrowPoint
    last_time: Float[Array, ""]
    status: Int[Array, ""]
    accepted: Int[Array, ""]
    rejected: Int[Array, ""]
    step: Float[Array, ""]
