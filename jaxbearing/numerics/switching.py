r"""A solver that chooses between an explicit and an implicit method by the stiffness that it measures.

tsit5 has two stages at the end of its step. The change of the rates over that of the states between them measures the
largest rate $\rho$ of the system: $h\rho = h|k_7 - k_6|/|y_7 - y_6|$. If $h\rho$ stays near the limit of stability,
about 3.3, stability and not accuracy decides the step, and kvaerno5 takes over (`kept_jacobian`). During
implicit steps $\rho$ comes from a power iteration with the kept Jacobian, one product in each step. tsit5 takes over
again where it would cost less: where its steps for stability, $h\rho/3.3$ in place of one implicit step, would need
fewer evaluations (`OVERHEAD`).

**Reference:** Hairer and Wanner (1996), Solving Ordinary Differential Equations II, section IV.2, for the measure.
"""

from typing import Any, ClassVar, NamedTuple

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from .arrow import ArrowPoint
from .implicit_interpolation import ImplicitInterpolation
from .kept_jacobian import KeptJacobian, State

STABLE = 3.3
"""Largest h rho for which tsit5 is stable on the negative axis."""
NEAR = 0.9
"""Fraction of that limit above which stability counts as limiting the step."""
STIFF_STEPS = 10
"""Number of consecutive tsit5 steps limited by stability after which kvaerno5 takes over."""
EASY_STEPS = 3
"""Number of consecutive kvaerno5 steps that would cost less with tsit5, after which tsit5 takes over."""
OVERHEAD = 0.7
"""Ratio of the evaluations of tsit5 to those of kvaerno5 at which both cost the same."""


class Choice(NamedTuple):
    """State of the integration, and of the choice of its method.

    - `stiff`: True if the next step is one of kvaerno5; `streak`: steps in a row that speak for the other method.
    - `direction`: last vector of the power iteration; `explicit`, `switches`: steps of tsit5, changes of the method.
    """

    kept: State
    stiff: Bool[Array, ""]
    streak: Int[Array, ""]
    direction: Float[Array, " n"]
    explicit: Int[Array, ""]
    switches: Int[Array, ""]


class _Either(dfx.AbstractLocalInterpolation):
    """Interpolation within a step: polynomial of tsit5 if tsit5 took it, otherwise that of the implicit method."""

    t0: Any
    t1: Any
    between: ImplicitInterpolation
    own: dfx.AbstractLocalInterpolation
    implicit: Any

    def __init__(self, *, t0, t1, y0, y1, k, bends, implicit):
        self.t0, self.t1, self.implicit = t0, t1, implicit
        self.between = ImplicitInterpolation(t0=t0, t1=t1, y0=y0, y1=y1, k=k, bends=bends)
        self.own = dfx.Tsit5.interpolation_cls(t0=t0, t1=t1, y0=y0, y1=y1, k=k)

    def evaluate(self, t0: Any, t1: Any | None = None, left: bool = True) -> Any:
        both = self.between.evaluate(t0, t1, left), self.own.evaluate(t0, t1, left)
        return jax.tree.map(lambda a, b: jnp.where(self.implicit, a, b), *both)


class Switching(dfx.AbstractAdaptiveSolver):
    """Either tsit5 or kvaerno5, see the module. **Arguments:** `implicit`: `KeptJacobian` of `diffrax.Kvaerno5()`."""

    term_structure: ClassVar[Any] = dfx.AbstractTerm
    interpolation_cls: ClassVar[Any] = _Either

    implicit: KeptJacobian

    def order(self, terms: object) -> int:
        return 5

    def func(self, terms: object, t0: Scalar, y0: ArrowPoint, args: object) -> ArrowPoint:
        return self.implicit.func(terms, t0, y0, args)

    def init(self, terms: object, t0: Scalar, t1: Scalar, y0: ArrowPoint, args: object) -> Choice:
        kept = self.implicit.init(terms, t0, t1, y0, args)
        zero, size = jnp.asarray(0), kept.rate.size
        # random, so that it has a part along every mode
        direction = jnp.asarray(np.random.default_rng(0).normal(size=size))
        return Choice(kept, jnp.asarray(False), zero, direction, zero, zero)

    def step(
        self,
        terms: object,
        t0: Scalar,
        t1: Scalar,
        y0: ArrowPoint,
        args: object,
        solver_state: Choice,
        made_jump: object,
    ) -> tuple[ArrowPoint, ArrowPoint, dict[str, ArrowPoint | Array], Choice, dfx.RESULTS]:
        state, length = solver_state, t1 - t0

        def implicit():
            before = state.kept.counts.evaluations
            y1, error, dense, kept, _ = self.implicit.step(terms, t0, t1, y0, args, state.kept, made_jump)
            grown = self.implicit.times_jacobian(kept.jacobian, state.direction, y0)
            rate = jnp.linalg.norm(grown)
            direction = jnp.where(rate > 0, grown / jnp.where(rate > 0, rate, 1.0), state.direction)
            taken = jnp.asarray(kept.counts.evaluations - before, dtype=float)
            cheap = (self._stages - 1) * jnp.maximum(length * rate / STABLE, 1.0) < OVERHEAD * taken
            return y1, error, dense, kept, cheap, direction

        def explicit():
            y1, error, dense, kept, stiff = self._explicit(t0, length, y0, args, state.kept)
            return y1, error, dense, kept, stiff, state.direction

        y1, error, dense, kept, other, direction = jax.lax.cond(state.stiff, implicit, explicit)
        streak = jnp.where(other, state.streak + 1, 0)
        change = streak >= jnp.where(state.stiff, EASY_STEPS, STIFF_STEPS)
        following = Choice(
            kept=kept,
            stiff=state.stiff ^ change,
            streak=jnp.where(change, 0, streak),
            direction=direction,
            explicit=state.explicit + jnp.where(state.stiff, 0, 1),
            switches=state.switches + jnp.where(change, 1, 0),
        )
        return y1, error, {**dense, "implicit": state.stiff}, following, dfx.RESULTS.successful

    @property
    def _stages(self) -> int:
        return len(dfx.Tsit5.tableau.b_sol)

    def _explicit(
        self, t0: Scalar, length: Scalar, y0: ArrowPoint, args: object, kept: State
    ) -> tuple[ArrowPoint, ArrowPoint, dict[str, ArrowPoint], State, Bool[Array, ""]]:
        """A step of tsit5, and whether stability limits it."""
        tableau, count = dfx.Tsit5.tableau, self._stages
        lower = np.zeros((count, count))
        for i, row in enumerate(tableau.a_lower):
            lower[i + 1, : i + 1] = row
        lower, places = jnp.asarray(lower), jnp.asarray(np.concatenate([[0.0], tableau.c]))
        start, unravel = ravel_pytree(y0)

        def stage(i, carry):
            ks, solution = carry
            y = start + length * (lower[i] @ ks)
            rate, solution = self.implicit.rates(t0 + places[i] * length, unravel(y), args, solution)
            return ks.at[i].set(ravel_pytree(rate)[0]), solution

        ks = jnp.zeros_like(kept.past).at[0].set(kept.rate)
        ks, solution = jax.lax.fori_loop(1, count, stage, (ks, kept.found))
        end, near = (start + length * (lower[i] @ ks) for i in (count - 1, count - 2))
        weight = self.implicit.weights(start)
        moved, turned = (jnp.sqrt(jnp.sum(jnp.square(d * weight))) for d in (end - near, ks[-1] - ks[-2]))
        stiff = length * turned > NEAR * STABLE * moved
        error = length * (jnp.asarray(np.asarray(tableau.b_error)) @ ks)
        whole = jax.vmap(unravel)
        dense = {"y0": y0, "y1": unravel(end), "k": whole(length * ks), "bends": whole(jnp.zeros((4, start.size)))}
        counts = kept.counts._replace(evaluations=kept.counts.evaluations + (count - 1))
        # the first implicit step begins with a new Jacobian, and without stages before
        kept = kept._replace(
            rate=ks[-1],
            found=solution,
            renew=jnp.asarray(True),
            ratio=jnp.ones(()),
            length=jnp.zeros(()),
            counts=counts,
        )
        return unravel(end), unravel(error), dense, kept, stiff
