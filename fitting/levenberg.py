r"""Levenberg and Marquardt's method as a trust region: each step $p$ minimises $|r + Jp|^2$ with $|Dp|\le\Delta$.

$p(\lambda) = -(J^TJ + \lambda D^2)^{-1}J^Tr$, with the $\lambda$ at which $|Dp| = \Delta$; $D$ holds the largest norm
so far of each column of $J$, so the method does not depend on the units of the unknowns. The parts of an iteration are
functions of arrays: `minimised` runs them inside a compiled program; `minimised_outside` calls them one by one
(`begun`, `trial`, `judged`) for a model that is a program of its own.

**Reference:** More (1978), *The Levenberg-Marquardt algorithm: implementation and theory*, Lecture Notes in
Mathematics 630; the measure of convergence is that of Bates and Watts (1981), Technometrics 23, 179.
"""

from collections.abc import Callable
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from jaxbearing._types import Scalar
from jaxbearing.numerics.batching import in_turn
from jaxbearing.programs import KeptProgram

OFFSET = 1e-7
"""Norm of the residual's projection on the tangent plane, over that of the residual, up to which a minimum is reached:
the next step would lower the sum of squares by the square of this, a part of 1e-14."""
SMALL_STEP = 1e-9
"""Scaled length $|Dp|$ of the Gauss-Newton step up to which a minimum is reached, in units of a residual."""
FLAT = 1e-14
"""Eigenvalue of the scaled normal matrix, relative to the largest, up to which its direction is left out of a step."""
SMALLEST_RADIUS = 1e-12
"""Radius of the region, relative to the first one, at which the search ends without success."""
GOOD, BAD = 0.75, 0.25
"""Actual over expected decrease of the loss, above which the region grows, and below which it shrinks."""
GROWTH, SHRINKAGE = 3.0, 0.25
FURTHEST = 1.0
"""Largest change of an unknown in the first region: a parameter that is searched by its logarithm changes at most by a
factor e. A longer step from a point with large residuals could end where the data no longer show a parameter."""
SECULAR_STEPS = 8
"""Newton steps for lambda; the radius is met to 1 % after two or three."""


class State(NamedTuple):
    """State of one search: unknowns `u`; `loss`, half the sum of squares, with its normal matrix and gradient; scales
    `size` of the unknowns (D); radius of the region now and at first; number of evaluations, `steps`; and whether the
    search has ended (`done`) and converged."""

    u: Float[Array, " parameter"]
    loss: Float[Array, ""]
    normal: Float[Array, "parameter parameter"]
    gradient: Float[Array, " parameter"]
    size: Float[Array, " parameter"]
    radius: Float[Array, ""]
    first_radius: Float[Array, ""]
    steps: Int[Array, ""]
    done: Bool[Array, ""]
    converged: Bool[Array, ""]


class Step(NamedTuple):
    """A step: unknowns to try, expected decrease of the loss, length of the step, and whether the region limits it."""

    u: Float[Array, " parameter"]
    decrease: Float[Array, ""]
    length: Float[Array, ""]
    limited: Bool[Array, ""]


def begun(
    u: Float[Array, " parameter"],
    residual: Float[Array, " point"],
    jacobian: Float[Array, "point parameter"],
    offset: Scalar = OFFSET,
) -> State:
    """The state at the first unknowns, with a first region that is large enough for the Gauss-Newton step of a linear
    model, within `FURTHEST`."""
    columns = jnp.linalg.norm(jacobian, axis=0)
    loss = 0.5 * jnp.sum(jnp.square(residual))
    radius = jnp.maximum(jnp.sqrt(2.0 * loss), 1.0)
    least = jnp.where(jnp.isfinite(radius), radius, 1.0) / FURTHEST
    size = jnp.maximum(jnp.where(jnp.isfinite(columns), columns, 1.0), least)
    state = State(
        u,
        loss,
        jacobian.T @ jacobian,
        jacobian.T @ residual,
        size,
        radius,
        radius,
        jnp.asarray(1),
        jnp.asarray(False),
        jnp.asarray(False),
    )
    lost = ~jnp.isfinite(loss) | ~jnp.all(jnp.isfinite(state.normal))
    converged = _at_minimum(state, offset) & ~lost
    return state._replace(done=converged | lost, converged=converged)


def trial(state: State) -> Step:
    """The step from a state: the Gauss-Newton step if it lies in the region, else the one to its border."""
    eigenvalues, vectors, along, seen = _spectrum(state)
    squares = jnp.square(along)
    safe = jnp.where(seen, eigenvalues, 1.0)
    length_at = lambda shift: jnp.sqrt(jnp.sum(jnp.where(seen, squares / jnp.square(safe + shift), 0.0)))
    newton_length = length_at(0.0)
    limited = newton_length > state.radius
    upper = jnp.linalg.norm(along) / state.radius

    def better(_, bracket):
        shift, low, high = bracket
        shift = jnp.where((shift < low) | (shift > high), jnp.maximum(1e-3 * high, jnp.sqrt(low * high)), shift)
        length = length_at(shift)
        slope = -jnp.sum(jnp.where(seen, squares / (safe + shift) ** 3, 0.0)) / length
        excess = length - state.radius
        high = jnp.where(excess < 0.0, shift, high)
        low = jnp.maximum(low, shift - excess / slope)
        return shift - (excess + state.radius) * excess / slope / state.radius, low, high

    zero = jnp.zeros_like(upper)
    # a state at its minimum has no step to search for, and its bracket is empty
    start = (jnp.where(limited, 1e-3 * upper, 0.0), zero, jnp.where(limited, upper, 1.0))
    root, *_ = jax.lax.fori_loop(0, SECULAR_STEPS, better, start)
    shift = jnp.where(limited, jnp.maximum(root, 0.0), 0.0)
    inner = -jnp.where(seen, along / (safe + shift), 0.0)
    length = jnp.linalg.norm(inner)
    shorter = jnp.where(limited, state.radius / jnp.where(length > 0, length, 1.0), 1.0)
    inner = inner * shorter
    decrease = -(jnp.sum(inner * along) + 0.5 * jnp.sum(jnp.where(seen, eigenvalues, 0.0) * jnp.square(inner)))
    return Step(state.u + (vectors @ inner) / state.size, decrease, jnp.linalg.norm(inner), limited)


def judged(
    state: State,
    step: Step,
    residual: Float[Array, " point"],
    jacobian: Float[Array, "point parameter"],
    offset: Scalar = OFFSET,
) -> State:
    """The state after a trial step, from the residual and Jacobian at its end; the step is rejected if it does not
    lower the loss or if the model has no finite value there."""
    loss = 0.5 * jnp.sum(jnp.square(residual))
    usable = jnp.isfinite(loss) & jnp.all(jnp.isfinite(jacobian))
    ratio = jnp.where(usable, (state.loss - loss) / jnp.where(step.decrease > 0, step.decrease, 1.0), -1.0)
    taken = usable & (loss < state.loss)
    radius = jnp.where(ratio < BAD, SHRINKAGE * step.length, state.radius)
    radius = jnp.where((ratio > GOOD) & step.limited, GROWTH * state.radius, radius)
    jacobian = jnp.where(usable, jacobian, 0.0)
    residual = jnp.where(usable, residual, 0.0)
    choose = lambda new, old: jnp.where(taken, new, old)
    new = State(
        choose(step.u, state.u),
        choose(loss, state.loss),
        choose(jacobian.T @ jacobian, state.normal),
        choose(jacobian.T @ residual, state.gradient),
        choose(jnp.maximum(state.size, jnp.linalg.norm(jacobian, axis=0)), state.size),
        radius,
        state.first_radius,
        state.steps + 1,
        state.done,
        state.converged,
    )
    converged = _at_minimum(new, offset)
    lost = radius <= SMALLEST_RADIUS * state.first_radius
    new = new._replace(done=converged | lost, converged=converged)
    return jax.tree.map(lambda old, updated: jnp.where(state.done, old, updated), state, new)


def minimised(
    evaluate: Callable[[Array], tuple[Array, Array]], u: Float[Array, " parameter"], most: int, offset: Scalar = OFFSET
) -> State:
    """The end of a search from `u` inside a program.

    **Arguments:** `evaluate`: function from unknowns to residual and Jacobian; `most`: largest number of evaluations;
    `offset`: see `OFFSET`.
    """
    first = begun(u, *evaluate(u), offset)

    def advanced(state: State) -> State:
        step = trial(state)
        return judged(state, step, *evaluate(step.u), offset)

    return jax.lax.while_loop(lambda state: ~state.done & (state.steps < most), advanced, first)


def _spectrum(state: State) -> tuple[Array, Array, Array, Array]:
    """Eigenvalues and eigenvectors of the scaled normal matrix, components of the scaled gradient along the
    eigenvectors, and a mask of those that are searched."""
    scaled = state.normal / jnp.outer(state.size, state.size)
    eigenvalues, vectors = in_turn(jnp.linalg.eigh, scaled)  # see `numerics.lapack`
    along = vectors.T @ (state.gradient / state.size)
    return eigenvalues, vectors, along, eigenvalues > FLAT * jnp.max(eigenvalues)


def _at_minimum(state: State, offset: Scalar) -> Bool[Array, ""]:
    """True if the next Gauss-Newton step would change the loss or the unknowns negligibly."""
    eigenvalues, _, along, seen = _spectrum(state)
    safe = jnp.where(seen, eigenvalues, 1.0)
    in_plane = jnp.sum(jnp.where(seen, jnp.square(along) / safe, 0.0))
    length = jnp.sqrt(jnp.sum(jnp.where(seen, jnp.square(along / safe), 0.0)))
    return (in_plane <= jnp.square(offset) * 2.0 * state.loss) | (length <= SMALL_STEP)


def _begun_lanes(
    u: Float[Array, "lane parameter"],
    residual: Float[Array, "lane point"],
    jacobian: Float[Array, "lane point parameter"],
    offset: Float[Array, ""],
) -> tuple[State, Step]:
    state = jax.vmap(begun, in_axes=(0, 0, 0, None))(u, residual, jacobian, offset)
    return state, jax.vmap(trial)(state)


def _judged_lanes(
    state: State,
    step: Step,
    residual: Float[Array, "lane point"],
    jacobian: Float[Array, "lane point parameter"],
    offset: Float[Array, ""],
) -> tuple[State, Step]:
    state = jax.vmap(judged, in_axes=(0, 0, 0, 0, None))(state, step, residual, jacobian, offset)
    return state, jax.vmap(trial)(state)


_kept_begun = KeptProgram(_begun_lanes, quick=True)
_kept_judged = KeptProgram(_judged_lanes, quick=True)


def minimised_outside(
    evaluate: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]],
    u: np.ndarray,
    most: int,
    offset: float = OFFSET,
) -> State:
    """The end of several searches ("lanes") side by side, whose model is evaluated outside the compiled program.

    **Arguments:**
    - `evaluate`: function from unknowns, (lane, parameter), and a mask of the lanes to evaluate, to residuals,
      (lane, point), and their Jacobians, (lane, point, parameter); NaN where the model has no value.
    - `u`: first unknowns of each lane; `most`: largest number of evaluations of each; `offset`: see `OFFSET`.
    """
    limit = jnp.asarray(offset)
    everyone = np.ones(len(u), dtype=bool)
    state, step = _kept_begun(jnp.asarray(u), *map(jnp.asarray, evaluate(np.asarray(u), everyone)), limit)
    while not np.all(state.done) and int(np.max(np.where(state.done, 0, state.steps))) < most:
        evaluated = evaluate(np.asarray(step.u), ~np.asarray(state.done))
        state, step = _kept_judged(state, step, *map(jnp.asarray, evaluated), limit)
    return state
