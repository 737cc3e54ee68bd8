r"""Implicit Runge-Kutta methods of diffrax that keep one Jacobian over stages and steps.

diffrax builds and factors a Jacobian in each step (twice: the first one belongs to the explicit first stage), and the
block-arrow elimination was repeated in each iteration. Here the tableau is diffrax's, and the stages are solved by
$k \leftarrow k + (I - h\gamma J)^{-1}(f(t_i, y_i + h\gamma k) - k)$ with

- a Jacobian J that stays until the iterations converge slowly, or fail: then the step is tried again with a new one;
- an inverse of $I - h\gamma J$, block by block, that stays until $h$ has changed by `STEP_CHANGE`;
- a first k that is extrapolated from the stages of this step and of the one before;
- a stop when the estimate $\theta/(1 - \theta)\,|h\gamma\,\delta k|$ of what is left is `STAGE_ERROR` of the tolerance,
  with the ratio $\theta$ of two corrections. The ratio of the stage before allows a single iteration.

**Reference:** Hairer and Wanner (1996), Solving Ordinary Differential Equations II, section IV.8.
"""

from collections.abc import Callable
from typing import Any, ClassVar, NamedTuple, TypeAlias

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from .arrow import ArrowJacobian, ArrowPoint, eliminated
from .implicit_interpolation import ImplicitInterpolation, chosen_bends, stage_bends, two_step_bends
from .small_linear import solve_blocks
from .stage_predictors import stage_places, stage_predictors

STAGE_ERROR = 0.1
"""Largest error of the stage equations, in units of the tolerance."""
SMALL = 1e-2
"""Correction over `STAGE_ERROR` below which the iteration ends at any ratio: it may be noise of the rates."""
LEAST_RATIO = 0.05
"""Smallest ratio of two corrections that is assumed after a single iteration."""
MOST_ITERATIONS = 8
"""Largest number of iterations of one stage."""
SLOW = 0.3
"""Ratio of two corrections above which the next step gets a new Jacobian."""
STEP_CHANGE = 0.2
"""Relative change of the step above which a new inverse is computed."""
Jacobian: TypeAlias = ArrowJacobian | Float[Array, "n n"]
"""Jacobian of the rates: an arrow, or a full matrix."""
Rates = Callable[[Scalar, ArrowPoint, Any, Any], tuple[ArrowPoint, Any]]


class Counts(NamedTuple):
    """Numbers of Jacobians, inverses, evaluations of the rates and failed attempts, in the accepted steps."""

    jacobians: Int[Array, ""]
    inverses: Int[Array, ""]
    evaluations: Int[Array, ""]
    failures: Int[Array, ""]


class ArrowInverse(NamedTuple):
    """Inverse of a block arrow: of each block, and of the Schur complement; `coupled` is $A^{-1}B$."""

    local: Float[Array, "m m element"]
    coupled: Float[Array, "m g element"]
    contributions: Float[Array, "g m element"]
    schur: Float[Array, "g g"]

    def times(self, right: ArrowPoint) -> ArrowPoint:
        own = jnp.sum(self.local * right.elements[None], axis=1)
        carried = jnp.sum(self.contributions * own[None], axis=(1, 2))
        globals_ = self.schur @ (right.globals - carried)
        return ArrowPoint(own - jnp.sum(self.coupled * globals_[None, :, None], axis=1), globals_)


Inverse: TypeAlias = ArrowInverse | Float[Array, "n n"]
"""Inverse of $I - sJ$ with a `Jacobian` J and a scaled step s."""


class State(NamedTuple):
    """The state that a step leaves for the next one.

    - `rate`: at the start of the next step; `found`: what was solved for inside the last rates.
    - `jacobian`; `inverse` of I - `scale` J; `renew`: True if the next step needs a new Jacobian.
    - `ratio`: theta/(1 - theta), at most 1, with the ratio theta of two corrections in the last iteration.
    - `past`, `length`: stages of the last step, and its length, s (0: there was none).
    """

    rate: Float[Array, " n"]
    found: Any
    jacobian: Jacobian
    inverse: Inverse
    scale: Float[Array, ""]
    renew: Bool[Array, ""]
    ratio: Float[Array, ""]
    past: Float[Array, "stage n"]
    length: Float[Array, ""]
    counts: Counts


class _Stages(NamedTuple):
    """State of the stage iteration: `stage`, `iteration`, iterate `k`, all stages, sizes and ratios of corrections."""

    stage: Int[Array, ""]
    iteration: Int[Array, ""]
    k: Float[Array, " n"]
    ks: Float[Array, "stage n"]
    found: Any
    size: Float[Array, ""]
    ratio: Float[Array, ""]
    worst: Float[Array, ""]
    failed: Bool[Array, ""]
    evaluations: Int[Array, ""]


class _Attempt(NamedTuple):
    """A step with one Jacobian; `again`: True if it is to be tried with a new one."""

    again: Bool[Array, ""]
    renew: Bool[Array, ""]
    jacobian: Jacobian
    inverse: Inverse
    scale: Float[Array, ""]
    stages: _Stages
    counts: Counts


class KeptJacobian(dfx.AbstractAdaptiveSolver):
    """A singly diagonal implicit method of diffrax, explicit in its first stage, with a Jacobian that is kept.

    Forward mode differentiates the iterations, to the error of the stages; there is no reverse mode.

    **Arguments:**
    - `method`: `diffrax.Kvaerno3()`, `Kvaerno4()` or `Kvaerno5()`; its root finder is not used.
    - `rates(t, y, args, guess)`: rates, and what is found inside them, the next guess.
    - `guess(t, y, args)`: first guess.
    - `tolerance`: of the integration, relative and absolute.
    - `idle`: number of globals at the end that nothing depends on; they do not count in the test of convergence.
    - `dense`: True if the Jacobian is a full matrix instead of an arrow.
    - `stage_error`: error of the stage equations, in units of the tolerance.
    """

    term_structure: ClassVar[Any] = dfx.AbstractTerm
    interpolation_cls: ClassVar[Any] = ImplicitInterpolation

    method: Any
    rates: Rates
    guess: Callable[[Scalar, ArrowPoint, Any], Any]
    tolerance: Scalar
    idle: int = 0
    dense: bool = False
    stage_error: Scalar = STAGE_ERROR

    def order(self, terms: object) -> int | None:
        return self.method.order(terms)

    def func(self, terms: object, t0: Scalar, y0: ArrowPoint, args: object) -> ArrowPoint:
        return self.rates(t0, y0, args, self.guess(t0, y0, args))[0]

    def init(self, terms: object, t0: Scalar, t1: Scalar, y0: ArrowPoint, args: object) -> State:
        del terms
        rate, solution = self.rates(t0, y0, args, self.guess(t0, y0, args))
        flat = ravel_pytree(rate)[0]
        shapes = jax.eval_shape(lambda: self._jacobian(t0, y0, args, solution))
        jacobian = jax.tree.map(lambda leaf: jnp.zeros(leaf.shape, leaf.dtype), shapes)
        zero = jnp.zeros(())
        return State(
            rate=flat,
            found=solution,
            jacobian=jacobian,
            inverse=self._inverse(jacobian, zero),
            scale=zero,
            renew=jnp.asarray(True),
            ratio=jnp.ones(()),
            past=jnp.zeros((self._stage_count, flat.size)),
            length=zero,
            counts=Counts(*(jnp.asarray(n) for n in (0, 0, 1, 0))),
        )

    def step(
        self,
        terms: object,
        t0: Scalar,
        t1: Scalar,
        y0: ArrowPoint,
        args: object,
        solver_state: State,
        made_jump: object,
    ) -> tuple[ArrowPoint, ArrowPoint, dict[str, ArrowPoint], State, dfx.RESULTS]:
        del terms, made_jump
        state, length = solver_state, t1 - t0
        start, unravel = ravel_pytree(y0)
        scale = length * self._gamma
        predictors = stage_predictors(self.method.tableau, length, state.length)

        def attempt(last: _Attempt) -> _Attempt:
            jacobian = jax.lax.cond(
                last.renew, lambda: self._jacobian(t0, y0, args, state.found), lambda: last.jacobian
            )
            changed = last.renew | (jnp.abs(scale - last.scale) > STEP_CHANGE * last.scale)
            inverse, held = jax.lax.cond(
                changed, lambda: (self._inverse(jacobian, scale), scale), lambda: (last.inverse, last.scale)
            )
            stages = self._solve(t0, length, start, unravel, args, state, inverse, held, predictors, last.renew)
            counts = Counts(
                last.counts.jacobians + _count(last.renew),
                last.counts.inverses + _count(changed),
                last.counts.evaluations + stages.evaluations,
                last.counts.failures + _count(stages.failed),
            )
            again = stages.failed & ~last.renew
            return _Attempt(again, jnp.asarray(True), jacobian, inverse, held, stages, counts)

        idle = self._begin(state, predictors)
        first = _Attempt(jnp.asarray(True), state.renew, state.jacobian, state.inverse, state.scale, idle, state.counts)
        last = jax.lax.while_loop(lambda a: a.again, attempt, first)
        stages = last.stages
        lower = jnp.asarray(self._lower)
        end = start + length * (lower[-1] @ stages.ks) + scale * stages.ks[-1]
        weights = jnp.asarray(np.asarray(self.method.tableau.b_error))
        error = jnp.where(stages.failed, jnp.inf, length * (weights @ stages.ks))
        y1 = unravel(end)
        bends = self._bends(start, end, stages.ks, length, state, jax.lax.stop_gradient(last.jacobian), y0)
        whole = jax.vmap(unravel)
        dense = {"y0": y0, "y1": y1, "k": whole(length * stages.ks), "bends": whole(bends)}
        following = State(
            rate=stages.ks[-1],
            found=stages.found,
            jacobian=last.jacobian,
            inverse=last.inverse,
            scale=last.scale,
            renew=stages.worst > SLOW,
            ratio=stages.ratio,
            past=stages.ks,
            length=length,
            counts=last.counts,
        )
        return y1, unravel(error), dense, following, dfx.RESULTS.successful

    # -- stages ---------------------------------------------------------------------------------------------------

    def _begin(self, state: State, predictors: Array) -> _Stages:
        ks = jnp.zeros_like(state.past).at[0].set(state.rate)
        zero, whole = jnp.zeros(()), jnp.asarray(0)
        k = self._first(predictors[1], state.past, ks)
        return _Stages(whole + 1, whole, k, ks, state.found, zero, state.ratio, zero, jnp.asarray(False), whole)

    def _first(self, weights: Array, past: Array, ks: Array) -> Array:
        return weights[: self._stage_count] @ past + weights[self._stage_count :] @ ks

    def _solve(self, t0, length, start, unravel, args, state, inverse, held, predictors, fresh) -> _Stages:
        """All stages with one inverse, one iteration in each pass of one loop."""
        count, scale = self._stage_count, length * self._gamma
        lower, places = jnp.asarray(self._lower), jnp.asarray(stage_places(self.method.tableau))
        weight = self.weights(start)
        # corrects an inverse that was computed for another step
        correction = 2.0 / (1.0 + scale / held)

        def advance(now: _Stages) -> _Stages:
            base = start + length * (lower[now.stage] @ now.ks)
            time = t0 + places[now.stage] * length
            rate, solution = self.rates(time, unravel(base + scale * now.k), args, now.found)
            open_ = ravel_pytree(rate)[0] - now.k
            step = correction * self._times(inverse, unravel, open_)
            k = now.k + step
            size = jnp.sqrt(jnp.sum(jnp.square(scale * step * weight)))
            later = now.iteration > 0
            theta = jnp.where(later, size / jnp.maximum(now.size, 1e-300), 0.0)
            left = jnp.where(later, theta / jnp.maximum(1.0 - theta, 1e-300), jnp.maximum(now.ratio, LEAST_RATIO))
            good = ((left * size < self.stage_error) & (theta < 1.0)) | (size < SMALL * self.stage_error)
            more = jnp.asarray(MOST_ITERATIONS - 1 - now.iteration, dtype=float)
            ahead = jnp.power(theta, more) * left * size
            hopeless = later & ((theta >= 1.0) | (ahead > self.stage_error))
            bad = ~jnp.isfinite(size) | (~good & (hopeless | (now.iteration + 1 >= MOST_ITERATIONS)))
            good = good & ~bad
            stage = now.stage + _count(good)
            ks = now.ks.at[now.stage].set(k)
            following = self._first(predictors[jnp.minimum(stage, count - 1)], state.past, ks)
            return _Stages(
                stage=stage,
                iteration=jnp.where(good, 0, now.iteration + 1),
                k=jnp.where(good, following, k),
                ks=ks,
                found=solution,
                size=size,
                ratio=jnp.where(later, jnp.minimum(left, 1.0), now.ratio),
                worst=jnp.maximum(now.worst, theta),
                failed=bad,
                evaluations=now.evaluations + 1,
            )

        first = self._begin(state, predictors)
        first = first._replace(ratio=jnp.where(fresh, 1.0, first.ratio))
        return jax.lax.while_loop(lambda now: (now.stage < count) & ~now.failed, advance, first)

    def _bends(self, start, end, ks, length, state, jacobian, y0) -> Float[Array, "4 n"]:
        """Polynomials between the ends of the step, see `implicit_interpolation`."""
        places, matrix = stage_places(self.method.tableau), np.diag([0.0, *self.method.tableau.a_diagonal[1:]])
        matrix = jnp.asarray(matrix + self._lower)
        smooth = two_step_bends(start, end, ks, length, state.past, state.length, places, matrix[-1])
        stiff = stage_bends(start, end, start[None] + length * (matrix @ ks), places)
        return chosen_bends(smooth, stiff, length * self._diagonal(jacobian, y0))

    # -- linear algebra -------------------------------------------------------------------------------------------

    def weights(self, start: Float[Array, " n"]) -> Float[Array, " n"]:
        """Weights of an error in the root of the sum of squares, in units of the tolerance; idle components have 0."""
        active = jnp.arange(start.size) < start.size - self.idle
        weight = jnp.where(active, 1.0 / (self.tolerance * (1.0 + jnp.abs(start))), 0.0)
        return weight / np.sqrt(max(start.size - self.idle, 1))

    def times_jacobian(self, jacobian: Jacobian, vector: Float[Array, " n"], state: ArrowPoint) -> Float[Array, " n"]:
        """Product of a kept Jacobian with a vector. **Arguments:** `state`: any state of the run."""
        if not isinstance(jacobian, ArrowJacobian):
            return jacobian @ vector
        elements, globals_ = ravel_pytree(state)[1](vector)
        local = jnp.sum(jacobian.local * elements[None], axis=1)
        border = jnp.sum(jacobian.right_border * globals_[None, :, None], axis=1)
        rows = jnp.sum(jacobian.contributions * elements[None], axis=(1, 2)) + jacobian.corner @ globals_
        return ravel_pytree(ArrowPoint(local + border, rows))[0]

    def _diagonal(self, jacobian: Jacobian, state: ArrowPoint) -> Float[Array, " n"]:
        if not isinstance(jacobian, ArrowJacobian):
            return jnp.diag(jacobian)
        own = jnp.arange(state.elements.shape[0])
        return ravel_pytree(ArrowPoint(jacobian.local[own, own], jnp.diag(jacobian.corner)))[0]

    def _jacobian(self, time: Scalar, state: ArrowPoint, args: object, solution: object) -> Jacobian:
        fixed = jax.lax.stop_gradient((args, solution))
        state = jax.lax.stop_gradient(state)
        if self.dense:
            flat, unravel = ravel_pytree(state)
            rates = lambda y: ravel_pytree(self.rates(time, unravel(y), *fixed)[0])[0]
            return jax.lax.stop_gradient(jax.jacfwd(rates)(flat))
        return jax.lax.stop_gradient(_arrow(lambda y: self.rates(time, y, *fixed)[0], state, self.idle))

    def _inverse(self, jacobian: Jacobian, scale: Array) -> Inverse:
        scale = jax.lax.stop_gradient(scale)
        if not isinstance(jacobian, ArrowJacobian):
            return jnp.linalg.inv(jnp.eye(jacobian.shape[0]) - scale * jacobian)
        m, n = jacobian.local.shape[1:]
        identity = jnp.broadcast_to(jnp.eye(m)[:, :, None], (m, m, n))
        matrix = ArrowJacobian(
            local=identity - scale * jacobian.local,
            right_border=-scale * jacobian.right_border,
            contributions=-scale * jacobian.contributions,
            corner=jnp.eye(jacobian.corner.shape[0]) - scale * jacobian.corner,
            chain=jacobian.chain,
        )
        coupled, schur = eliminated(matrix)
        return ArrowInverse(solve_blocks(matrix.local, identity), coupled, matrix.contributions, jnp.linalg.inv(schur))

    def _times(self, inverse: Inverse, unravel: Callable[[Array], ArrowPoint], right: Array) -> Array:
        if not isinstance(inverse, ArrowInverse):
            return inverse @ right
        return ravel_pytree(inverse.times(unravel(right)))[0]

    # -- tableau --------------------------------------------------------------------------------------------------

    @property
    def _stage_count(self) -> int:
        return len(self.method.tableau.b_sol)

    @property
    def _gamma(self) -> float:
        return float(self.method.tableau.a_diagonal[-1])

    @property
    def _lower(self) -> np.ndarray:
        """The strictly lower triangle of the tableau."""
        lower = np.zeros((self._stage_count, self._stage_count))
        for i, row in enumerate(self.method.tableau.a_lower):
            lower[i + 1, : i + 1] = row
        return lower


def _arrow(rates: Callable[[ArrowPoint], ArrowPoint], state: ArrowPoint, idle: int) -> ArrowJacobian:
    """Blocks of the Jacobian, as `lineax_solver.BlockArrow` has them, with the whole rows of the idle globals."""
    (m, n), (g,) = state.elements.shape, state.globals.shape
    active = g - idle
    push = jax.linearize(rates, state)[1]
    pull = jax.linear_transpose(push, state)
    identity = jnp.broadcast_to(jnp.eye(m)[:, :, None], (m, m, n))
    local = jax.vmap(lambda seed: push(ArrowPoint(seed, jnp.zeros(g))).elements)(identity)
    border = jax.vmap(lambda seed: push(ArrowPoint(jnp.zeros((m, n)), seed)))(jnp.eye(active, g))
    rows = jax.vmap(lambda seed: pull(ArrowPoint(jnp.zeros((m, n)), seed))[0].elements)(jnp.eye(g))
    return ArrowJacobian(
        local=jnp.swapaxes(local, 0, 1),
        right_border=jnp.zeros((m, g, n)).at[:, :active].set(jnp.swapaxes(border.elements, 0, 1)),
        contributions=rows,
        corner=jnp.zeros((g, g)).at[:, :active].set(border.globals.T),
        chain=jnp.eye(g),
    )


def _count(flag: Array) -> Array:
    """1 where the flag is True, else 0."""
    return jnp.where(flag, 1, 0)
