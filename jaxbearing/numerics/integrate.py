r"""Integration of differential equations by diffrax: a solver by its name, one tolerance, a status and no exception.

The state is an `ArrowPoint`, elements and globals, in units in which one tolerance serves for all components: the step
control compares each error with $\epsilon(1 + |y|)$. Implicit solvers (Kvaerno's ESDIRK methods, implicit Euler) solve
their stage equations by Newton's method, with the block-arrow elimination of `lineax_solver`, O(number of elements), or
with a dense one. If algebraic unknowns couple all elements, the arrow lacks a term of low rank: Newton's method then
converges a little more slowly to the same stages, and gradients need the dense elimination.

A run consists of segments (`integrate_segment`). Between two of them the caller can show progress, keep results, and
stop.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import diffrax as dfx
import equinox as eqx
import jax
import jax.numpy as jnp
import lineax as lx
import optimistix as optx
from jax.flatten_util import ravel_pytree
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from .arrow import ArrowPoint
from .integrator import IMPLICIT, Field, IntegratorOptions, NestedField, Segment
from .kept_jacobian import KeptJacobian
from .lineax_solver import BlockArrow
from .remembering import Memory, Remembering
from .status import Status
from .switching import Switching

_CLASSES: dict[str, Callable[..., dfx.AbstractAdaptiveSolver]] = {
    "tsit5": dfx.Tsit5,
    "dopri8": dfx.Dopri8,
    "kvaerno3": dfx.Kvaerno3,
    "kvaerno4": dfx.Kvaerno4,
    "kvaerno5": dfx.Kvaerno5,
    "implicit_euler": dfx.ImplicitEuler,
    "auto": dfx.Kvaerno5,
}

KEPT = ("kvaerno4", "kvaerno5", "auto")
"""Solvers that keep one Jacobian over stages and steps (`kept_jacobian`), with the arrow elimination; "auto" also with
the dense one. Otherwise, and in kvaerno3, diffrax's own iterations solve the stages; they have a reverse mode."""

STAGE_ERROR = 1.0
"""Largest error of the stage equations, in units of the tolerance."""


class NoisyChord(dfx.VeryChord):
    """Iteration of diffrax for the stage equations, for rates that carry the noise of a solve inside them.

    Near a steady state all iterates but the first differ by noise alone. Their differences do not shrink, which the
    test of `VeryChord` takes for divergence, and the step is rejected. Here a difference below `noise` ends the
    iteration with success. At least two iterations are taken, as in `VeryChord`.
    """

    noise: float = 0.0

    def terminate(self, fn: Any, y: Any, args: Any, options: Any, state: Any, tags: Any) -> tuple[Any, Any]:
        ended, result = super().terminate(fn, y, args, options, state, tags)
        solved = state.result == optx.RESULTS.successful
        settled = (state.step >= 2) & (state.diffsize < self.noise) & solved
        return ended | settled, optx.RESULTS.where(settled, optx.RESULTS.successful, result)


def diffrax_solver(options: IntegratorOptions, idle: int = 0, noise: float = 0.0) -> dfx.AbstractAdaptiveSolver:
    """The solver of diffrax for a name of `SOLVERS`.

    **Arguments:** `idle`: see `lineax_solver.BlockArrow`; `noise`: see `NoisyChord`, in units of the tolerance.
    """
    kind = _CLASSES[options.solver]
    if options.solver not in IMPLICIT:
        return kind()
    linear = BlockArrow(idle) if options.elimination == "arrow" else lx.LU()
    # one Jacobian a step. The termination test decides the number of steps: at a hundredth of the tolerance, diffrax's
    # own, iterations fail and steps shrink, to three times as many; optimistix's Chord stops early, with ten times the
    # error
    settings: dict[str, Any] = {"linear_solver": linear, "kappa": STAGE_ERROR}
    if noise > 0.0:
        return kind(root_finder=dfx.with_stepsize_controller_tols(NoisyChord)(noise=noise, **settings))
    return kind(root_finder=dfx.with_stepsize_controller_tols(dfx.VeryChord)(**settings))


class _Problem(NamedTuple):
    """Problem for diffrax: vector field, solver, state, arguments, norm of an error, and `proper`, the function that
    takes the state of the run from that of the solver."""

    field: Callable[[Scalar, Any, Any], Any]
    solver: dfx.AbstractAdaptiveSolver
    state: Any
    args: Any
    norm: Callable[[Any], Array]
    proper: Callable[[Any], ArrowPoint]


def _problem(
    field: Field | NestedField,
    state: ArrowPoint,
    start: Float[Array, ""],
    args: object,
    options: IntegratorOptions,
    idle: int,
) -> _Problem:
    if options.solver in KEPT and (options.elimination == "arrow" or options.solver == "auto"):
        return _kept_problem(field, state, args, options, idle)
    solver, same = diffrax_solver(options, idle), lambda y: y
    if not isinstance(field, NestedField):
        return _Problem(field, solver, state, args, optx.rms_norm, same)
    nested = field
    # diffrax calls the field in many places: with `jit` it is traced only once
    rates = eqx.filter_jit(nested.rates)
    if options.solver in IMPLICIT:
        # the arrow of the stage equations is that of the state alone
        guess = eqx.filter_jit(nested.guess)
        cold = lambda t, y, a: rates(t, y, a[0], guess(t, y, a[0]), a[1])[0]
        return _Problem(cold, solver, state, (args, jnp.asarray(options.tolerance)), optx.rms_norm, same)
    flat, unravel = ravel_pytree(state)
    first, unravel_solution = ravel_pytree(jax.lax.stop_gradient(nested.guess(start, state, args)))
    size = flat.shape[0]

    def remembering(t, y, arguments):
        (own, tolerance), memory = arguments
        rate, solution = rates(t, unravel(y[:size]), own, unravel_solution(memory.at(t)), tolerance)
        return jnp.concatenate([ravel_pytree(rate)[0], jax.lax.stop_gradient(ravel_pytree(solution)[0])])

    return _Problem(
        remembering,
        Remembering(solver),
        jnp.concatenate([flat, jnp.zeros_like(first)]),
        ((args, jnp.asarray(options.tolerance)), Memory(start, first, jnp.zeros_like(first), jnp.zeros_like(first))),
        lambda error: optx.rms_norm(error[:size]),
        lambda y: unravel(y[:size]),
    )


def _kept_problem(
    field: Field | NestedField, state: ArrowPoint, args: object, options: IntegratorOptions, idle: int
) -> _Problem:
    """Problem for `KeptJacobian`, whose iterations start each nested solve from the solution of the last one."""
    tolerance = jnp.asarray(options.tolerance)
    if isinstance(field, NestedField):
        # the field is called in several places: with `jit` it is traced only once
        nested, first = eqx.filter_jit(field.rates), eqx.filter_jit(field.guess)
        rates = lambda t, y, a, solution: nested(t, y, a[0], solution, a[1])
        guess = lambda t, y, a: first(t, y, a[0])
    else:
        plain = eqx.filter_jit(field)
        rates = lambda t, y, a, solution: (plain(t, y, a[0]), solution)
        guess = lambda t, y, a: ()
    solver = KeptJacobian(
        method=_CLASSES[options.solver](),
        rates=rates,
        guess=guess,
        tolerance=tolerance,
        idle=idle,
        dense=options.elimination == "dense",
    )
    if options.solver == "auto":
        solver = Switching(solver)
    alone = lambda t, y, a: rates(t, y, a, guess(t, y, a))[0]
    return _Problem(alone, solver, state, (args, tolerance), optx.rms_norm, lambda y: y)


def integrate_segment(
    field: Field | NestedField,
    state: ArrowPoint,
    start: Float[Array, ""],
    times: Float[Array, " time"],
    args: object,
    options: IntegratorOptions,
    first_step: Float[Array, ""] | None = None,
    adjoint: dfx.AbstractAdjoint | None = None,
    idle: int = 0,
) -> Segment:
    """Integrates from `start` to the last of `times`; a run that fails has a status and raises no exception.

    **Arguments:**
    - `field(t, y, args)`: rates; after NaN the step is rejected and shortened. In a `NestedField`, explicit solvers
      start the solve inside from its extrapolated last solution.
    - `times`: increasing, after `start`, s.
    - `first_step`: length of the first step, s; left out: diffrax chooses it.
    - `idle`: number of globals at the end that are integrals along the way, on which nothing depends.
    - `adjoint`: an adjoint of diffrax, for gradients; left out: reverse mode with checkpoints.
    """
    tolerance = jnp.asarray(options.tolerance)
    problem = _problem(field, state, start, args, options, idle)
    # the history of the error steers more smoothly through shocks than the last error alone
    control = dfx.PIDController(
        rtol=tolerance,
        atol=tolerance,
        pcoeff=0.3,
        icoeff=0.4,
        dcoeff=0.0,
        dtmin=options.shortest_step,
        force_dtmin=False,
        norm=problem.norm,
    )
    proper = lambda t, y, a: problem.proper(y)
    solution = dfx.diffeqsolve(
        dfx.ODETerm(problem.field),
        problem.solver,
        start,
        times[-1],
        first_step,
        problem.state,
        problem.args,
        saveat=dfx.SaveAt(subs=(dfx.SubSaveAt(ts=times, fn=proper), dfx.SubSaveAt(t1=True, fn=proper))),
        stepsize_controller=control,
        max_steps=options.max_steps,
        throw=False,
        adjoint=dfx.RecursiveCheckpointAdjoint() if adjoint is None else adjoint,
    )
    # diffrax returns all that `saveat` asks for
    saved: Any = solution.ys
    ends: Any = solution.ts
    states, last = saved[0], jax.tree.map(lambda leaf: leaf[0], saved[1])
    accepted, rejected = solution.stats["num_accepted_steps"], solution.stats["num_rejected_steps"]
    reached = ends[1][0]
    return Segment(
        states=states,
        last=last,
        last_time=reached,
        status=_status(solution.result, last, reached >= times[-1]),
        accepted=accepted,
        rejected=rejected,
        step=(reached - start) / jnp.maximum(accepted, 1),
    )


def _status(result: dfx.RESULTS, last: ArrowPoint, done: Bool[Array, ""]) -> Int[Array, ""]:
    """Status of a run: not converged if steps ran out, diverged if they became too short or a state is not finite.

    **Arguments:** `done`: True if the run reached its last time. If round-off leaves a step below the limit up to
    there, diffrax takes that step and calls it too short.
    """
    finite: Bool[Array, ""] = jnp.all(jnp.isfinite(last.elements)) & jnp.all(jnp.isfinite(last.globals))
    good = (done | (result == dfx.RESULTS.successful)) & finite
    ran_out = (result == dfx.RESULTS.max_steps_reached) & finite
    failed = jnp.where(ran_out, int(Status.NOT_CONVERGED), int(Status.DIVERGED))
    return jnp.where(good, int(Status.CONVERGED), failed)
