"""One step of the damped Newton iteration, in parts: what it proposes, how a trial is judged, how far a step goes."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    Equations,
    linearize,
    solve_arrow,
    uphill_step,
)
from .structure import constant, count, switch

BACKTRACK = (1.0, 0.3, 0.05)
"""Fractions of the Newton step that are tried, in this order; the last is taken in any case."""
LAST_ATTEMPT = len(BACKTRACK) - 1
GROWTH = 4.0
"""A trial of the first try may let the residual grow by this factor: to ask for a decrease breaks steps that lead over
a rise (measured on random roller bearings with both rings turning: with 1.5, three times as many solves of more than
20 steps). The stages of a continuation, begun nearer to their root, ask for a decrease: a residual that saturates never
grows by that factor."""
LEAST_FALL = 0.1
"""Least decrease of the residual over the one that its linearization predicts, for a step of a continuation."""
TURNING_BACK = 0.5
"""A step that takes back the one before it goes at most this part of its length: as in bisection, what two steps that
oppose each other enclose is halved. Newton's iteration in a kink goes back and forth for ever."""
ROUNDED_STEP = 1e-12
"""A root that Newton's step locates to this (scaled) is found although rounding keeps the residual above its tolerance:
by no more than the system's `rounding`, or than the last bits of the unknowns make of each equation."""
LAST_BITS = 10.0 * 2.0**-52
"""Relative change of every unknown, or of its scale where it is smaller, that a residual of rounding stands for."""
MOST_ROUNDED = 1e-5
"""No larger scaled residual counts as rounding, however steep the equation is there."""


class NewtonOptions(eqx.Module):
    """Tolerances and limits of the Newton iteration; plain numbers, none of them differentiated.

    **Arguments:**
    - `residual_tolerance`: largest scaled residual of a converged solve. Where the Newton step is below 1e-12 and only
      rounding is left of the residual, times the system's `rounding`, or what the last bits of the unknowns make, up to
      1e-5.
    - `step_tolerance`: largest scaled Newton step of a converged solve. Convergence asks for both: a small
      residual alone says nothing where the Jacobian is nearly singular.
    - `inner_tolerance`: largest scaled residual of solves nested in the equations.
    - `max_steps`: Newton steps of the first try, rejected trials counted; continuations together may take four times as
      many for each homotopy of the system.
    - `continuation`: whether a solve that fails at once is tried again by continuation along the system's homotopies.
      Where all lanes of a batch are solved at once (on a GPU, and systems that say `lanes_together`), a batch waits for
      its slowest lane: for `max_steps` at most without continuation.
    """

    residual_tolerance: float = constant("residual_tolerance", 1e-10, bound="> 0")
    step_tolerance: float = constant("step_tolerance", 1e-7, bound="> 0")
    inner_tolerance: float = constant("inner_tolerance", 1e-8, bound="> 0")
    max_steps: int = count("max_steps", 200, least=1)
    continuation: bool = switch("continuation", True)


class Search(NamedTuple):
    """State of the iteration: a `trial` at a fraction of a `step` from `base`."""

    trial: ArrowPoint
    base: ArrowPoint
    step: ArrowPoint
    base_norm: Float[Array, ""]
    share: Float[Array, ""]
    """Share of the Newton step left after caps and pacing; the expected decrease of the residual scales with it."""
    attempt: Int[Array, ""]

    @classmethod
    def at(cls, start: ArrowPoint) -> "Search":
        nowhere = jax.tree.map(jnp.zeros_like, start)
        return cls(start, start, nowhere, jnp.asarray(jnp.inf), jnp.asarray(1.0), jnp.asarray(0))

    def begun_anew(self, where: Bool[Array, ""], start: ArrowPoint) -> "Search":
        """The search, or where it is told to begin anew, that from another start."""
        nowhere = jax.tree.map(jnp.zeros_like, start)
        return self._replace(
            trial=choose(where, start, self.trial),
            base=choose(where, start, self.base),
            step=choose(where, nowhere, self.step),
            base_norm=jnp.where(where, jnp.inf, self.base_norm),
            attempt=jnp.where(where, 0, self.attempt),
        )


class Proposal(NamedTuple):
    """Equations at a trial, and Newton's step from there: `falling` elements are on a branch where an equation falls
    with its own unknown, and their steps were turned uphill; `turned`: some step was."""

    equations: Equations
    jacobian: ArrowJacobian
    step: ArrowPoint
    falling: Bool[Array, " element"]
    turned: Bool[Array, ""]


class Verdict(NamedTuple):
    """Judgement of a trial by the equations there.

    It is a root (`settled`), of the nested solves too (`converged`); it is taken (`accepted`); there is no usable step
    left (`stuck`). `norm`: of the residual.
    """

    norm: Float[Array, ""]
    settled: Bool[Array, ""]
    converged: Bool[Array, ""]
    accepted: Bool[Array, ""]
    stuck: Bool[Array, ""]


def propose(system: AbstractArrowSystem, trial: ArrowPoint) -> Proposal:
    """Linearises the equations at a trial and solves for Newton's step."""
    equations, jacobian = linearize(system, trial)
    if system.increasing:
        step, falling, globals_turned = uphill_step(jacobian, equations.residual)
        return Proposal(equations, jacobian, step, falling, jnp.any(falling) | globals_turned)
    step = solve_arrow(jacobian, equations.residual)
    falling = jnp.zeros(step.elements.shape[1], dtype=bool)
    return Proposal(equations, jacobian, step, falling, jnp.asarray(False))


def judge(
    proposal: Proposal,
    search: Search,
    options: NewtonOptions,
    rounding: float,
    first_try: Bool[Array, ""] | None,
) -> Verdict:
    """Judges a trial by the residual and the step there.

    **Arguments:** `rounding`: of the system; `first_try`: false in a continuation, whose steps must bring a decrease;
    `None`: there is no continuation.
    """
    residual, jacobian = proposal.equations.residual, proposal.jacobian
    norm = norm_of(residual)
    size, ahead = largest(residual), largest(proposal.step)
    usable = jnp.isfinite(norm) & jnp.isfinite(ahead)
    met = (size <= options.residual_tolerance) & (ahead <= options.step_tolerance)
    last_bits = (size <= MOST_ROUNDED) & _of_last_bits(proposal.equations, jacobian, search.trial)
    small = (size <= rounding * options.residual_tolerance) | last_bits
    settled = usable & (met | (small & (ahead <= ROUNDED_STEP)))
    converged = settled & (proposal.equations.inner <= options.inner_tolerance)
    growth = jnp.asarray(GROWTH)
    if first_try is not None:
        least_fall = LEAST_FALL * search.share * jnp.asarray(BACKTRACK)[search.attempt]
        growth = jnp.where(first_try, growth, 1.0 - least_fall)
    enough = norm <= growth * search.base_norm
    last = search.attempt == LAST_ATTEMPT
    return Verdict(norm, settled, converged, usable & (enough | last), ~usable & last)


def moved_on(system: AbstractArrowSystem, search: Search, proposal: Proposal, verdict: Verdict) -> Search:
    """The next trial: along the new step where the last one was accepted, otherwise less far along the old one."""
    accepted = verdict.accepted
    attempt = jnp.where(accepted, 0, jnp.minimum(search.attempt + 1, LAST_ATTEMPT))
    base = choose(accepted, search.trial, search.base)
    taken = jax.tree.map(jnp.subtract, search.base, search.trial)
    paced = _capped(system, _paced(system, proposal.step, taken, proposal.falling))
    step = choose(accepted, paced, search.step)
    whole = norm_of(proposal.step)
    share = jnp.minimum(norm_of(paced) / jnp.where(whole > 0, whole, 1.0), 1.0)
    # across a hump the residual grows first
    base_norm = jnp.where(proposal.turned, jnp.inf, verdict.norm)
    return Search(
        trial=_move(system, base, step, jnp.asarray(BACKTRACK)[attempt]),
        base=base,
        step=step,
        base_norm=jnp.where(accepted, base_norm, search.base_norm),
        share=jnp.where(accepted, share, search.share),
        attempt=attempt,
    )


def choose(condition: Bool[Array, ""], a: ArrowPoint, b: ArrowPoint) -> ArrowPoint:
    return ArrowPoint(*(jnp.where(condition, x, y) for x, y in zip(a, b, strict=True)))


def norm_of(point: ArrowPoint) -> Float[Array, ""]:
    return jnp.sqrt(jnp.sum(jnp.square(point.elements)) + jnp.sum(jnp.square(point.globals)))


def largest(point: ArrowPoint) -> Float[Array, ""]:
    elements = jnp.max(jnp.abs(point.elements), initial=0.0)
    return jnp.maximum(elements, jnp.max(jnp.abs(point.globals), initial=0.0))


def _move(system: AbstractArrowSystem, base: ArrowPoint, step: ArrowPoint, fraction: Float[Array, ""]) -> ArrowPoint:
    low, high = system.bounds()
    return ArrowPoint(
        jnp.clip(base.elements - fraction * step.elements, low.elements, high.elements),
        jnp.clip(base.globals - fraction * step.globals, low.globals, high.globals),
    )


def _capped(system: AbstractArrowSystem, step: ArrowPoint) -> ArrowPoint:
    """The step shortened, direction kept, until no unknown moves further than its cap."""
    caps = system.step_caps()
    over = jnp.maximum(
        jnp.max(jnp.abs(step.elements) / caps.elements, initial=0.0),
        jnp.max(jnp.abs(step.globals) / caps.globals, initial=0.0),
    )
    scale = 1.0 / jnp.maximum(over, 1.0)
    return ArrowPoint(step.elements * scale, step.globals * scale)


def _paced(
    system: AbstractArrowSystem, step: ArrowPoint, last: ArrowPoint, falling: Bool[Array, " element"]
) -> ArrowPoint:
    """The step with each element's part, and that of the globals, measured against the last one taken.

    What turns back is shortened (`TURNING_BACK`): elements meet their kinks one by one, so no common fraction of the
    step suits all of them. An element on a falling branch (`falling`) that goes on is made no slower: towards a cusp
    its slope grows without bound and Newton's steps vanish before they cross it.
    """
    caps = system.step_caps()
    size = lambda part, cap: jnp.max(jnp.abs(part) / cap, axis=0, keepdims=True, initial=0.0)

    def pace(new: Array, old: Array, cap: Array, keep_speed: Array) -> Array:
        length = size(new, cap)
        ratio = size(old, cap) / jnp.where(length > 0, length, 1.0)
        along = jnp.sum(new * old / jnp.square(cap), axis=0, keepdims=True)
        back = jnp.where(along < 0, jnp.minimum(TURNING_BACK * ratio, 1.0), 1.0)
        return new * jnp.where(keep_speed & (along > 0), jnp.maximum(ratio, 1.0), back)

    return ArrowPoint(
        pace(step.elements, last.elements, caps.elements, falling[None, :]),
        pace(step.globals, last.globals, caps.globals, jnp.zeros(1, dtype=bool)),
    )


def _of_last_bits(equations: Equations, jacobian: ArrowJacobian, at: ArrowPoint) -> Bool[Array, ""]:
    """True if every residual is within the round-off of a change of the unknowns by their last bits (by those of 1
    where an unknown is smaller: it then stands for a difference of two of that order)."""
    steep = jax.tree.map(jnp.abs, jacobian)
    own, common = (LAST_BITS * jnp.maximum(jnp.abs(part), 1.0) for part in at)
    elements = jnp.einsum("ijn,jn->in", steep.local, own) + jnp.einsum("ign,g->in", steep.right_border, common)
    carried = jnp.einsum("kjn,jn->k", steep.contributions, own)
    globals_ = steep.corner @ common + steep.chain @ carried
    residual = equations.residual
    return jnp.all(jnp.abs(residual.elements) <= elements) & jnp.all(jnp.abs(residual.globals) <= globals_)
