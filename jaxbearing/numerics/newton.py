"""Damped Newton on a block-arrow system: status per lane, implicit derivatives, no lane harms another."""

from collections.abc import Callable
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .arrow import (
    AbstractArrowSystem,
    ArrowJacobian,
    ArrowPoint,
    Equations,
    System,
    empty_jacobian,
    evaluate,
    linearize,
    solve_arrow,
    uphill_step,
)
from .batching import in_turn
from .status import Status
from .structure import constant, count, switch

BACKTRACK = (1.0, 0.3, 0.05)
"""Fractions of the Newton step that are tried, in this order; the last is taken in any case."""
GROWTH = 4.0
"""A trial of the first try may let the residual grow by this factor: to ask for a decrease breaks steps that lead over
a rise (measured on random roller bearings with both rings turning: with 1.5, three times as many solves of more than
20 steps). The further tries, begun nearer to their root, ask for a decrease: a residual that saturates never grows by
that factor."""
LEAST_FALL = 0.1
"""Least decrease of the residual over the one that its linearization predicts, for a step of a further try."""
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
LONGEST_STAGE = 0.25
"""First length of a stage, in ease."""
SHORTEST_STAGE = 0.02
"""A try in which stages would have to be shorter than this has failed."""
NOTHING_SOLVED = 2.0
"""In the place of the ease of the last stage solved."""
STAGES_PER_TRY = 3
"""A stage starts near its end, and gets this part of the Newton steps of a first try."""
MOST_STEPS = 4
"""Newton steps of all further tries together, in units of `max_steps` a path."""


class NewtonOptions(eqx.Module):
    """Tolerances and limits of the Newton iteration; plain numbers, none of them differentiated.

    **Arguments:**
    - `residual_tolerance`: largest scaled residual of a converged solve. Where the Newton step is below 1e-12 and only
      rounding is left of the residual, times the system's `rounding`, or what the last bits of the unknowns make, up to
      1e-5.
    - `step_tolerance`: largest scaled Newton step of a converged solve. Convergence asks for both: a small
      residual alone says nothing where the Jacobian is nearly singular.
    - `inner_tolerance`: largest scaled residual of solves nested in the equations.
    - `max_steps`: Newton steps of the first try, rejected trials counted; the others together may take four times as
      many for each path of the system.
    - `further_tries`: whether a solve that fails at once is tried again. Where all lanes of a batch are solved at once
      (on a GPU, and systems that say `side_by_side`), a batch waits for its slowest lane: for `max_steps` at most
      without further tries.
    """

    residual_tolerance: float = constant("residual_tolerance", 1e-10, bound="> 0")
    step_tolerance: float = constant("step_tolerance", 1e-7, bound="> 0")
    inner_tolerance: float = constant("inner_tolerance", 1e-8, bound="> 0")
    max_steps: int = count("max_steps", 200, least=1)
    further_tries: bool = switch("further_tries", True)


class NewtonResult(NamedTuple):
    """End of the iteration. On a lane that failed, `point` is a finite point and not a solution.

    `jacobian` holds the blocks, residual norm, worst equation and worst element are measured at the last iterate on the
    system asked for (not an eased one); of a lane that converged, `point` is one Newton step (below the step tolerance)
    further.
    """

    point: ArrowPoint
    jacobian: ArrowJacobian
    status: Int[Array, ""]
    iterations: Int[Array, ""]
    residual_norm: Float[Array, ""]
    inner_residual: Float[Array, ""]
    worst_equation: Int[Array, ""]
    worst_element: Int[Array, ""]

    @property
    def converged(self) -> Bool[Array, ""]:
        return self.status == Status.CONVERGED


class _Path(NamedTuple):
    """State of the further tries: each walks from ease 1 to ease 0, every stage from where the last one ended."""

    ease: Float[Array, ""]
    """Ease of the stage being solved; 0 in the first try."""
    solved_ease: Float[Array, ""]
    """Ease of the last stage solved; above 1: none."""
    solved: ArrowPoint
    length: Float[Array, ""]
    """Length of this stage."""
    steps: Int[Array, ""]
    """Newton steps of this stage."""
    tries: Int[Array, ""]
    """Begun; 1: at the system itself."""


class _Iterate(NamedTuple):
    trial: ArrowPoint
    base: ArrowPoint
    step: ArrowPoint
    base_norm: Float[Array, ""]
    share: Float[Array, ""]
    """Share of the Newton step left after caps and pacing; the expected decrease of the residual scales with it."""
    attempt: Int[Array, ""]
    iterations: Int[Array, ""]
    status: Int[Array, ""]
    path: _Path | None
    equations: Equations
    jacobian: ArrowJacobian
    """Equations and Jacobian of the system asked for, where it was last looked at: of a lane that converged, at its
    final `trial`."""


def _norm(point: ArrowPoint) -> Float[Array, ""]:
    return jnp.sqrt(jnp.sum(jnp.square(point.elements)) + jnp.sum(jnp.square(point.globals)))


def _largest(point: ArrowPoint) -> Float[Array, ""]:
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

    def pace(new: Array, old: Array, cap: Array, hurry: Array) -> Array:
        length = size(new, cap)
        ratio = size(old, cap) / jnp.where(length > 0, length, 1.0)
        along = jnp.sum(new * old / jnp.square(cap), axis=0, keepdims=True)
        back = jnp.where(along < 0, jnp.minimum(TURNING_BACK * ratio, 1.0), 1.0)
        return new * jnp.where(hurry & (along > 0), jnp.maximum(ratio, 1.0), back)

    return ArrowPoint(
        pace(step.elements, last.elements, caps.elements, falling[None, :]),
        pace(step.globals, last.globals, caps.globals, jnp.zeros(1, dtype=bool)),
    )


def _of_last_bits(equations: Equations, jacobian: ArrowJacobian, at: ArrowPoint) -> Bool[Array, ""]:
    """True if every residual is within the round-off of a change of the unknowns by their last bits (by those of 1
    where an unknown is smaller: it then stands for a difference of two of that order)."""
    steep = jax.tree.map(jnp.abs, jacobian)
    own, common = (LAST_BITS * jnp.maximum(jnp.abs(part), 1.0) for part in at)
    elements = jnp.einsum("ijn,jn->in", steep.local, own) + jnp.einsum("ign,g->in", steep.to_globals, common)
    carried = jnp.einsum("kjn,jn->k", steep.contributions, own)
    globals_ = steep.corner @ common + steep.chain @ carried
    residual = equations.residual
    return jnp.all(jnp.abs(residual.elements) <= elements) & jnp.all(jnp.abs(residual.globals) <= globals_)


def _choose(condition: Bool[Array, ""], a: ArrowPoint, b: ArrowPoint) -> ArrowPoint:
    return ArrowPoint(*(jnp.where(condition, x, y) for x, y in zip(a, b, strict=True)))


def _iterate(system: AbstractArrowSystem, options: NewtonOptions) -> _Iterate:
    fractions = jnp.asarray(BACKTRACK)
    last_attempt = len(BACKTRACK) - 1
    paths = system.paths if options.further_tries else 0

    def keep_going(state: _Iterate):
        return state.status < 0

    def advance(state: _Iterate) -> _Iterate:
        posed = system if state.path is None else system.eased(state.path.ease, jnp.maximum(state.path.tries - 2, 0))
        equations, jacobian = linearize(posed, state.trial)
        if system.rising:
            step, falling, globals_turned = uphill_step(jacobian, equations.residual)
            turned = jnp.any(falling) | globals_turned
        else:
            step = solve_arrow(jacobian, equations.residual)
            falling, turned = jnp.zeros(step.elements.shape[1], dtype=bool), jnp.asarray(False)
        norm = _norm(equations.residual)
        usable = jnp.isfinite(norm) & jnp.isfinite(_largest(step))
        size, ahead = _largest(equations.residual), _largest(step)
        met = (size <= options.residual_tolerance) & (ahead <= options.step_tolerance)
        last_bits = (size <= MOST_ROUNDED) & _of_last_bits(equations, jacobian, state.trial)
        small = (size <= system.rounding * options.residual_tolerance) | last_bits
        rounded = small & (ahead <= ROUNDED_STEP)
        settled = usable & (met | rounded)
        converged = settled & (equations.inner <= options.inner_tolerance)

        growth = jnp.asarray(GROWTH)
        if state.path is not None:
            least_fall = LEAST_FALL * state.share * fractions[state.attempt]
            growth = jnp.where(state.path.tries <= 1, growth, 1.0 - least_fall)
        enough = norm <= growth * state.base_norm
        accept = usable & (enough | (state.attempt == last_attempt))
        stuck = ~usable & (state.attempt == last_attempt)

        attempt = jnp.where(accept, 0, jnp.minimum(state.attempt + 1, last_attempt))
        base = _choose(accept, state.trial, state.base)
        taken = jax.tree.map(jnp.subtract, state.base, state.trial)
        paced = _capped(system, _paced(system, step, taken, falling))
        next_step = _choose(accept, paced, state.step)
        whole = _norm(step)
        share = jnp.minimum(_norm(paced) / jnp.where(whole > 0, whole, 1.0), 1.0)
        share = jnp.where(accept, share, state.share)
        # across a hump the residual grows first
        base_norm = jnp.where(accept, jnp.where(turned, jnp.inf, norm), state.base_norm)
        iterations = state.iterations + 1
        steps = iterations if state.path is None else state.path.steps + 1
        limit = options.max_steps
        if state.path is not None:
            limit = jnp.where(state.path.solved_ease <= 1.0, max(limit // STAGES_PER_TRY, 1), limit)
        # settled with a nested solve that failed: no other step changes that
        hopeless = settled & ~converged
        failed = (stuck | (steps >= limit) | hopeless) & ~converged
        trial = _move(system, base, next_step, fractions[attempt])
        path, status = state.path, jnp.asarray(-1)
        if path is None:
            status = jnp.where(converged, int(Status.CONVERGED), jnp.where(failed, _failure(stuck), status))
        else:
            asked = path.ease == 0.0
            spent = iterations >= (1 + MOST_STEPS * paths) * options.max_steps
            path, restart, guess, ended = _advance_path(
                path, steps, converged, failed, hopeless & asked, spent, state.trial, easiest, 1 + paths
            )
            won = converged & asked
            status = jnp.where(won, int(Status.CONVERGED), jnp.where(ended, _failure(stuck), status))
            trial = _choose(restart, guess, trial)
            base, next_step = _choose(restart, guess, base), _choose(restart, zeros, next_step)
            base_norm = jnp.where(restart, jnp.inf, base_norm)
            attempt = jnp.where(restart, 0, attempt)
        # what is reported is about the system asked for, not about an eased one
        if state.path is not None:
            own = state.path.ease == 0.0
            last = (state.equations, state.jacobian)
            equations, jacobian = jax.tree.map(lambda new, old: jnp.where(own, new, old), (equations, jacobian), last)
        return _Iterate(
            # a finished lane keeps the point whose residual was judged
            trial=_choose(status == -1, trial, state.trial),
            base=base,
            step=next_step,
            base_norm=base_norm,
            share=share,
            attempt=attempt,
            iterations=iterations,
            status=status,
            path=path,
            equations=equations,
            jacobian=jacobian,
        )

    if not paths:
        start = easiest = system.initial()
    else:
        ease, way = jnp.asarray([0.0] + [1.0] * paths), jnp.asarray([0, *range(paths)])
        guesses = jax.vmap(lambda e, w: system.eased(e, w).initial())(ease, way)
        start, easiest = (jax.tree.map(lambda leaf, i=i: leaf[i], guesses) for i in (0, slice(1, None)))
    zeros = jax.tree.map(jnp.zeros_like, start)
    zero, none_solved, longest = (jnp.asarray(number) for number in (0.0, NOTHING_SOLVED, LONGEST_STAGE))
    path = _Path(zero, none_solved, start, longest, jnp.asarray(0), jnp.asarray(1))
    first = _Iterate(
        trial=start,
        base=start,
        step=zeros,
        base_norm=jnp.asarray(jnp.inf),
        share=jnp.asarray(1.0),
        attempt=jnp.asarray(0),
        iterations=jnp.asarray(0),
        status=jnp.asarray(-1),
        path=path if paths else None,
        equations=Equations(zeros, jnp.zeros(())),
        jacobian=empty_jacobian(system, start),
    )
    return jax.lax.while_loop(keep_going, advance, first)


def _failure(stuck: Bool[Array, ""]) -> Int[Array, ""]:
    return jnp.where(stuck, int(Status.DIVERGED), int(Status.NOT_CONVERGED))


def _advance_path(
    path: _Path,
    steps: Int[Array, ""],
    converged: Bool[Array, ""],
    failed: Bool[Array, ""],
    hopeless: Bool[Array, ""],
    spent: Bool[Array, ""],
    trial: ArrowPoint,
    easiest: ArrowPoint,
    most_tries: int,
) -> tuple[_Path, Bool[Array, ""], ArrowPoint, Bool[Array, ""]]:
    """The path after a Newton step, whether a stage begins anew, from which point, and whether all is lost.

    A stage that fails is tried again half as far from the last one that was solved, and so are those after it.
    `easiest`: first guesses at ease 1, a leading axis over the ways; `hopeless`: this path has come to its end, in a
    place where a nested solve fails: another one may end elsewhere; `spent`: no further stages.
    """
    found = converged & (path.ease > 0.0)
    solved_ease = jnp.where(found, path.ease, path.solved_ease)
    shorter = 0.5 * path.length
    broken = failed & ((path.tries == 1) | (solved_ease > 1.0) | (shorter < SHORTEST_STAGE) | hopeless)
    begin = broken & (path.tries < most_tries) & ~spent
    again = failed & ~broken
    ended = spent | (broken & ~begin)
    restart = begin | again | found
    tries = jnp.where(begin, path.tries + 1, path.tries)
    solved_ease = jnp.where(begin, NOTHING_SOLVED, solved_ease)
    length = jnp.where(begin, LONGEST_STAGE, jnp.where(again, shorter, path.length))
    next_ease = jnp.where(begin, 1.0, jnp.maximum(solved_ease - length, 0.0))
    solved = _choose(found, trial, path.solved)
    first = jax.tree.map(lambda leaf: leaf[jnp.maximum(tries - 2, 0)], easiest)
    new = _Path(
        ease=jnp.where(restart, next_ease, path.ease),
        solved_ease=solved_ease,
        solved=solved,
        length=length,
        steps=jnp.where(restart, 0, steps),
        tries=tries,
    )
    return new, restart, _choose(begin, first, solved), ended


class _End(NamedTuple):
    """The end of an iteration: only this is stacked over the lanes of a batch."""

    trial: ArrowPoint
    equations: Equations
    jacobian: ArrowJacobian
    status: Int[Array, ""]
    iterations: Int[Array, ""]


def _ended(system: AbstractArrowSystem, options: NewtonOptions) -> _End:
    def search(system: AbstractArrowSystem) -> _End:
        end = _iterate(system, options)
        return _End(end.trial, end.equations, end.jacobian, end.status, end.iterations)

    return search(system) if system.side_by_side else in_turn(search, system)


class _Root(NamedTuple):
    point: ArrowPoint
    jacobian: ArrowJacobian
    solved: Bool[Array, ""]
    end: _End


@eqx.filter_custom_jvp
def _root(system: AbstractArrowSystem, *, options: NewtonOptions) -> _Root:
    """The root with the Jacobian there; of a lane that failed, a finite point and where the iteration gave up."""
    end = _ended(system, options)
    solved = end.status == Status.CONVERGED
    # The last Newton step is taken, not only measured: it squares the remaining error.
    step = solve_arrow(end.jacobian, end.equations.residual)
    elements = jnp.where(solved, end.trial.elements - step.elements, _finite(end.trial.elements))
    globals_ = jnp.where(solved, end.trial.globals - step.globals, _finite(end.trial.globals))
    return _Root(ArrowPoint(elements, globals_), end.jacobian, solved, end)


@_root.def_jvp
def _root_jvp(primals, tangents, *, options: NewtonOptions):
    (system,), (system_dot,) = primals, tangents
    root = _root(system, options=options)
    # Selecting on the tangent that comes in, not only on what goes out, keeps NaN times zero of a failed lane from
    # parameters that lanes share, in both modes.
    select = lambda t: jnp.where(root.solved, t, 0.0)
    system_dot = jax.tree.map(select, system_dot)
    residual_dot = _directional(lambda s: evaluate(s, root.point).residual, (system,), (system_dot,))
    step = solve_arrow(root.jacobian, residual_dot)
    point_dot = jax.tree.map(lambda t: select(-t), step)
    jacobian_dot = _directional(lambda s, p: linearize(s, p)[1], (system, root.point), (system_dot, point_dot))
    rest = jax.tree.map(lambda _: None, (root.solved, root.end))
    return root, _Root(point_dot, jax.tree.map(select, jacobian_dot), *rest)


def _directional(function: Callable, primals: tuple, tangents: tuple) -> Any:
    """Directional derivative of a function of pytrees, zeros (not None) where nothing depends on the direction."""
    values, dots = eqx.filter_jvp(function, primals, tangents)
    return jax.tree.map(
        lambda dot, value: jnp.zeros_like(value) if dot is None else dot, dots, values, is_leaf=lambda x: x is None
    )


def _finite(x: Array) -> Array:
    return jnp.where(jnp.isfinite(x), x, 0.0)


def newton_solve(system: System, options: NewtonOptions | None = None) -> tuple[System, NewtonResult]:
    """Solve a block-arrow system from its own first guess.

    Returns the system to evaluate results with, and the result. The derivative of the solution (and of the Jacobian
    at the solution) is that of the implicit function, in both modes and to any order: nothing is differentiated
    through the iteration, and a solve that is not differentiated does not pay for derivatives.

    Newton's step is changed where a pivot of the Jacobian is negative (`arrow.uphill_step`) if the system says that an
    equation must grow with its own unknown at the root (`rising`). Where the iteration fails, and the system says how
    it can be eased, further tries solve an easier system first and walk from there to the one asked for, in stages
    that shorten where one fails. `iterations` counts all steps.

    A lane that fails never raises and never spoils a neighbour under `vmap`: its point is finite and not a solution,
    and the returned system passes no derivative for it, so that NaN times zero cannot reach a parameter that lanes
    share. Whoever computes results from the point masks them by `converged`.

    **Arguments:** `system`: equations and parameters; `options`: tolerances and limits.
    """
    root = _root(system, options=NewtonOptions() if options is None else options)
    live = jax.tree.map(lambda x: jnp.where(root.solved, x, jax.lax.stop_gradient(x)), system)
    # What is reported was measured one Newton step before the returned point.
    end = root.end
    elements, globals_ = jnp.abs(end.equations.residual.elements), jnp.abs(end.equations.residual.globals)
    sizes = jnp.concatenate([jnp.max(elements, axis=1, initial=0.0), globals_])
    worst = jnp.argmax(jnp.where(jnp.isnan(sizes), jnp.inf, sizes))
    m = elements.shape[0]
    worst_element = jnp.argmax(elements[jnp.minimum(worst, m - 1)]) if m else jnp.asarray(0)
    return live, NewtonResult(
        root.point, root.jacobian, end.status, end.iterations, jnp.max(sizes), end.equations.inner, worst, worst_element
    )
