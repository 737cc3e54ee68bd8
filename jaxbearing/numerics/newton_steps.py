"""One step of the damped Newton iteration in three parts: proposal, judgement of a trial, choice of the next one."""

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
"""Fractions of the Newton step that are tried, in this order. The last one is accepted if its residual and
Newton step are finite."""
LAST_ATTEMPT = len(BACKTRACK) - 1
GROWTH = 4.0
"""Largest ratio of the residual after a step to that before it that the first try accepts. A smaller value rejects
useful steps across a maximum of the residual. Random roller bearings with both rings turning show this: with 1.5, three
times as many solves need more than 20 steps. The stages of a continuation start nearer to their root and require a
decrease: far from the root some residuals level off, so that this limit would never stop a wandering iteration."""
LEAST_FALL = 0.1
"""A step of a continuation must achieve at least this fraction of the decrease that the linearisation predicts
(Armijo's condition)."""
TURNING_BACK = 0.5
"""A step that turns back on the previous one may have at most this fraction of its length. As in bisection, two
opposed steps halve the interval between them. Without this limit, Newton's iteration would oscillate for ever at a kink
(a jump of the slope of an equation)."""
ROUNDED_STEP = 1e-12
"""Scaled Newton step below which a root counts as found although round-off keeps the residual above its tolerance. The
residual must then be within the factor `rounding` of the system, or within the round-off of the unknowns."""
LAST_BITS = 10.0 * 2.0**-52
"""Relative change of the unknowns (ten units in the last place) from which the round-off of the residual is
estimated."""
MOST_ROUNDED = 1e-5
"""Largest scaled residual that can count as round-off, however steep the equation is."""


class NewtonOptions(eqx.Module):
    """Tolerances and limits of the Newton iteration; plain numbers, none of them differentiated.

    **Arguments:**
    - `residual_tolerance`: largest scaled residual of a converged solve. If the Newton step is below 1e-12, the
      residual may exceed it by the factor `rounding` of the system, or reach what round-off of the unknowns causes (at
      most 1e-5).
    - `step_tolerance`: largest scaled Newton step of a converged solve. Convergence asks for both: a small
      residual alone says nothing where the Jacobian is nearly singular.
    - `inner_tolerance`: largest scaled residual of solves nested in the equations.
    - `max_steps`: largest number of Newton steps in the first try, including rejected trials. All continuations
      together may take four times this number for each homotopy of the system.
    - `continuation`: True if a solve whose first try fails is tried again by continuation along the system's
      homotopies. If all lanes of a batch are solved at once (on a GPU, or with `lanes_together`), a batch waits for its
      slowest lane; without continuation no lane takes more than `max_steps`.
    """

    residual_tolerance: float = constant("residual_tolerance", 1e-10, bound="> 0")
    step_tolerance: float = constant("step_tolerance", 1e-7, bound="> 0")
    inner_tolerance: float = constant("inner_tolerance", 1e-8, bound="> 0")
    max_steps: int = count("max_steps", 200, least=1)
    continuation: bool = switch("continuation", True)


class Search(NamedTuple):
    """State of the iteration. The `trial` is `base` minus a fraction of `step`, within the bounds; `attempt` is the
    index of that fraction in `BACKTRACK`. `base_norm`: norm of the residual at `base`, or infinity if a trial with any
    norm is accepted."""

    trial: ArrowPoint
    base: ArrowPoint
    step: ArrowPoint
    base_norm: Float[Array, ""]
    share: Float[Array, ""]
    """Ratio of the step, after all its limits, to the full Newton step. The expected decrease of the residual scales
    with it."""
    attempt: Int[Array, ""]

    @classmethod
    def at(cls, start: ArrowPoint) -> "Search":
        nowhere = jax.tree.map(jnp.zeros_like, start)
        return cls(start, start, nowhere, jnp.asarray(jnp.inf), jnp.asarray(1.0), jnp.asarray(0))

    def begun_anew(self, where: Bool[Array, ""], start: ArrowPoint) -> "Search":
        """The search from another start if `where` is True, otherwise this one."""
        nowhere = jax.tree.map(jnp.zeros_like, start)
        return self._replace(
            trial=choose(where, start, self.trial),
            base=choose(where, start, self.base),
            step=choose(where, nowhere, self.step),
            base_norm=jnp.where(where, jnp.inf, self.base_norm),
            attempt=jnp.where(where, 0, self.attempt),
        )


class Proposal(NamedTuple):
    """Equations at a trial, and Newton's step from there.

    - `falling`: True for elements with a negative pivot (as far as they are looked for, see `uphill_step`), where an
      equation decreases as its own unknown grows. `uphill_step` has changed the sign of that pivot.
    - `turned`: True if the sign of any pivot was changed.
    """

    equations: Equations
    jacobian: ArrowJacobian
    step: ArrowPoint
    falling: Bool[Array, " element"]
    turned: Bool[Array, ""]


class Verdict(NamedTuple):
    """Judgement of a trial.

    - `norm`: Euclidean norm of the residual.
    - `settled`: the trial is a root of the equations.
    - `converged`: `settled`, and the solves nested in the equations have converged there too.
    - `accepted`: the iteration goes on from the trial.
    - `stuck`: the residual or the step is not finite even at the shortest fraction.
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
    """Judges a trial by the residual and the Newton step there.

    **Arguments:** `rounding`: the system's factor for round-off; `first_try`: False in a continuation, whose steps must
    decrease the residual; `None` if there is no continuation.
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
    """The next trial: along the new step if the last trial was accepted, otherwise a shorter part of the old one."""
    accepted = verdict.accepted
    attempt = jnp.where(accepted, 0, jnp.minimum(search.attempt + 1, LAST_ATTEMPT))
    base = choose(accepted, search.trial, search.base)
    taken = jax.tree.map(jnp.subtract, search.base, search.trial)
    paced = _capped(system, _paced(system, proposal.step, taken, proposal.falling))
    step = choose(accepted, paced, search.step)
    whole = norm_of(proposal.step)
    share = jnp.minimum(norm_of(paced) / jnp.where(whole > 0, whole, 1.0), 1.0)
    # If the solver changed the sign of a pivot, the step may cross a maximum of the residual. The next trial is
    # then accepted whatever its norm is.
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
    """The step, shortened in its direction so that no unknown moves further than its cap."""
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
    """Adjusts the step of each element, and that of the globals, to the last step taken.

    A step that reverses the last one is shortened (`TURNING_BACK`). Each element has its own factor, because elements
    reach their kinks one by one. If an element with a negative pivot (`falling`) keeps its direction, its step is made
    at least as long as the last one: near a cusp the slope of the equation grows without bound, and Newton's steps
    would vanish before they cross it.
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
    """True if every residual is within the round-off that a change of the unknowns by `LAST_BITS` causes.

    An unknown below 1 counts as 1, because it may be the difference of two numbers of that order."""
    steep = jax.tree.map(jnp.abs, jacobian)
    own, common = (LAST_BITS * jnp.maximum(jnp.abs(part), 1.0) for part in at)
    elements = jnp.einsum("ijn,jn->in", steep.local, own) + jnp.einsum("ign,g->in", steep.right_border, common)
    carried = jnp.einsum("kjn,jn->k", steep.contributions, own)
    globals_ = steep.corner @ common + steep.chain @ carried
    residual = equations.residual
    return jnp.all(jnp.abs(residual.elements) <= elements) & jnp.all(jnp.abs(residual.globals) <= globals_)
