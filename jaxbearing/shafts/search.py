"""Finds the equilibrium of a shaft. The first stage finds the minimum of a convex potential. The second stage is
Newton's iteration with the solutions of the bearings.

The first stage neglects friction and uses the centrifugal forces at the contact angles of unloaded bearings. A shaft
on bearings then has one convex potential (`balance`). It includes clearances, unloaded bearings, more than two
bearings, flanges and springs. A Newton step is accepted if the potential decreases enough (Armijo). A factor on the
diagonal grows when a step has to be shortened (Levenberg). Newton's iteration of the second stage starts at the
minimum. It uses the full solution of each bearing under a held ring (a ring with given displacements) and the exact
stiffness. The solution includes what the scene of the bearing contains: centrifugal forces of each ball, films,
friction, cage, seats and temperatures. Derivatives follow from the implicit function theorem at that root.

`Balance` holds the linear part of the problem: the shaft, its supports and its loads. Its matrix `attach` gives the
displacement of each bearing from the unknowns. Some sets of bearings are preloaded by a force, an offset or a spring,
which adds an unknown and its equation.
"""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ..bearings.row import AbstractRow, RowState
from ..numerics.newton import NewtonOptions
from ..numerics.once import once
from ..numerics.status import Status
from .balance import Balance
from .batches import AbstractBatch, LinearBatch, RollingBatch, solutions, spread

START_TOLERANCE = 1e-5
"""Tolerance of the first stage for the residual, relative to the size of the loads."""
TRIALS = 400
"""Largest number of trials of the first stage. A shaft that must move 10 mm before soft supports (1e3 N/m) carry it
needs 60."""
LONGEST_STEP = 2e-4
"""Largest displacement in one step of the first stage, m; tilts are multiplied by the span."""
FARTHEST, MOST_TILT = 1e-2, 0.1
"""Largest displacement, m, and tilt, rad, of an inner ring relative to its outer ring; beyond them the search reports
that there is no equilibrium."""
FAR_START = 0.1
"""Fraction of these bounds. The first guess is a shaft that is clamped at x = 0 and free elsewhere. If one of its
displacements exceeds this fraction, the search starts instead from a shaft on linear springs. A load that bends a
slender cantilever by more than `FARTHEST` is harmless between bearings."""
NOMINAL, ARM = 1e8, 5e-3
"""Stiffness of the linear springs, N/m, in place of the bearings in that start, and their lever arm against tilt, m."""
SOFTEST, LEAST_STIFFNESS = 1e2, 1e5
"""Two stiffnesses, N/m. The first is added to every freedom of a bearing in the steps of the first stage. The second is
the lower limit of the diagonal stiffness that is multiplied by the Levenberg factor."""
FACTOR, LEAST_FACTOR, TENFOLD = 1e-9, 1e-12, 10.0
"""First and smallest Levenberg factor, and the ratio by which it grows after a shortened step and falls after a full
step."""
ARMIJO, SHORTER, SHORTEST = 1e-4, 0.3, 1e-6
"""Fraction of the predicted decrease that a step must achieve; factor by which a rejected step is shortened; fraction
below which a step is accepted in any case, because its decrease is lost in round-off."""
ANCHOR = 0.1
"""Stiffness, N/m, that is added to every freedom of a bearing in the steps of the second stage and in derivatives. It
gives a unique position to a shaft that floats in its clearance without load. It exerts no force, and is 1e-9 of the
stiffness of a loaded bearing."""
NEWTON_TRIALS = 60
"""Largest number of trials of the second stage."""
ROUNDED_STEP = 1e-16
"""Displacement, m, below which a Newton step counts as round-off."""
MOST_ROUNDED = 1e-7
"""Largest scaled residual that is accepted if the Newton step is round-off."""


class Problem(eqx.Module):
    """Everything that the equilibrium depends on.

    **Arguments:** `expansion`: expansion of the inner raceway's radius less that of the outer one, m, of each bearing.
    """

    balance: Balance
    batches: tuple[AbstractBatch, ...]
    expansion: Float[Array, " bearing"]


class _Ports(NamedTuple):
    """Energies, forces and stiffnesses of all bearings under held rings, each in the frame of its bearing. `states`: of
    the rows, with which the next trial starts."""

    energy: Float[Array, " bearing"]
    force: Float[Array, "bearing 5"]
    stiffness: Float[Array, "bearing 5 5"]
    states: list[RowState]


@once
def _held(
    problem: Problem, rows: list[AbstractRow | None], displacement: Float[Array, "bearing 5"], states: list[RowState]
) -> _Ports:
    held = [
        batch.hold(row, displacement[batch.index], own)
        for batch, row, own in zip(problem.batches, rows, states, strict=True)
    ]
    of = lambda name: spread(problem.batches, [getattr(part, name) for part in held], problem.balance.count)
    return _Ports(of("energy"), of("force"), of("stiffness"), [part.state for part in held])


def ports(
    problem: Problem, displacement: Float[Array, "bearing 5"], options: NewtonOptions
) -> tuple[Float[Array, "bearing 5"], Float[Array, "bearing 5 5"], Bool[Array, ""]]:
    """Forces and stiffness of all bearings from their full solutions, and whether all solutions converged."""
    forces, stiffness, good = [], [], jnp.asarray(True)
    for batch in problem.batches:
        own = displacement[batch.index]
        if isinstance(batch, RollingBatch):
            held = solutions(batch.scene, own, problem.expansion[batch.index], options)
            forces.append(held.force)
            stiffness.append(held.stiffness)
            good &= jnp.all(held.converged)
        else:
            assert isinstance(batch, LinearBatch)
            forces.append(batch.force_at(None, own, None))
            stiffness.append(batch.stiffness)
    of = lambda parts: spread(problem.batches, parts, problem.balance.count)
    return of(forces), of(stiffness), good


class Start(NamedTuple):
    """End of the first stage.

    - `unknowns`, `residual`, `steps`: the unknowns, the scaled residual and the number of steps.
    - `lost`: True if a ring left its range (`FARTHEST`, `MOST_TILT`).
    - `softest`: index of the freedom that moved farthest relative to its range: 5 times bearing plus freedom.
    - `scale`: force by which the residual is divided, N.
    """

    unknowns: Float[Array, " unknown"]
    residual: Float[Array, ""]
    steps: Int[Array, ""]
    lost: Bool[Array, ""]
    softest: Int[Array, ""]
    scale: Float[Array, ""]


class _Descent(NamedTuple):
    unknowns: Array
    states: list[RowState]
    step: Array
    energy: Array
    slope: Array
    fraction: Array
    factor: Array
    residual: Array
    scale: Array
    far: Array
    done: Bool[Array, ""]
    trials: Int[Array, ""]
    steps: Int[Array, ""]


def _first_place(balance: Balance, most: Array) -> Array:
    """Unknowns with which the search begins. They are 0, unless a bearing is then far from contact (`FAR_START`). In
    that case they are the equilibrium with linear springs (`NOMINAL`) in place of the bearings.

    **Arguments:** `most`: bounds of the displacements, m and rad.
    """
    zero = jnp.zeros_like(balance.load)
    displacement = balance.offset.reshape(balance.count, 5)
    nominal = jnp.asarray(NOMINAL * np.diag([1.0, 1.0, 1.0, ARM**2, ARM**2]))
    residual = balance.left @ (displacement @ nominal).ravel() - balance.load
    on_springs = -balance.inverse(jnp.broadcast_to(nominal, (balance.count, 5, 5))) @ residual
    return jnp.where(jnp.max(jnp.abs(displacement) / most[None]) > FAR_START, on_springs, zero)


def minimise(problem: Problem) -> Start:
    """The minimum of the potential to `START_TOLERANCE`."""
    problem = jax.lax.stop_gradient(problem)
    balance = problem.balance
    rows = [batch.rows(problem.expansion) for batch in problem.batches]
    most = jnp.where(jnp.arange(5) < 3, FARTHEST, MOST_TILT)
    first = _first_place(balance, most)
    at_first = balance.displacements(first)
    states = [batch.initial(row, at_first[batch.index]) for batch, row in zip(problem.batches, rows, strict=True)]
    units, lengths = balance.row_units(), balance.lengths()

    def look(state: _Descent) -> _Descent:
        trial = state.unknowns + state.fraction * state.step
        displacement = balance.displacements(trial)
        held = _held(problem, rows, displacement, state.states)
        residual = balance.residual(trial, held.force)
        energy = balance.potential(trial, held.energy)
        enough = energy <= state.energy + ARMIJO * state.fraction * state.slope
        near = jnp.abs(state.slope) <= 1e-12 * jnp.abs(energy) + 1e-18
        accept = enough | near | (state.fraction < SHORTEST)
        shortened = state.fraction < 1.0
        factor = jnp.where(shortened, state.factor * TENFOLD, state.factor / TENFOLD)
        factor = jnp.where(state.trials > 0, jnp.clip(factor, LEAST_FACTOR, 1.0), state.factor)
        diagonal = jnp.abs(jnp.diagonal(held.stiffness, axis1=1, axis2=2))
        least = jnp.square(lengths)
        more = factor * jnp.maximum(diagonal, LEAST_STIFFNESS * least[None]) + SOFTEST * least[None]
        step = -balance.inverse(held.stiffness + more[:, :, None] * jnp.eye(5)[None]) @ residual
        moved = jnp.max(jnp.abs((balance.attach @ step).reshape(-1, 5) * lengths[None]))
        step = step * jnp.minimum(1.0, LONGEST_STEP / jnp.maximum(moved, 1e-30))
        # preload acts even without an external load, so the scale is that of the first trial
        loaded = balance.force_scale + jnp.sum(jnp.abs(held.force / lengths[None]))
        scale = jnp.where(state.trials == 0, loaded, state.scale)
        size = jnp.max(jnp.abs(residual * units)) / scale
        pick = lambda new, old: jax.tree.map(lambda a, b: jnp.where(accept, a, b), new, old)
        hopeless = (state.trials == 0) & ~jnp.isfinite(energy)
        far = jnp.abs(displacement) / most[None]
        done = (accept & ((size <= START_TOLERANCE) | (jnp.max(far) > 1.0))) | hopeless
        return _Descent(
            unknowns=pick(trial, state.unknowns),
            states=pick(held.states, state.states),
            step=pick(step, state.step),
            energy=pick(energy, state.energy),
            slope=pick(balance.slope(step, residual), state.slope),
            fraction=jnp.where(accept, 1.0, SHORTER * state.fraction),
            factor=pick(factor, state.factor),
            residual=pick(size, state.residual),
            scale=scale,
            far=pick(far, state.far),
            done=done,
            trials=state.trials + 1,
            steps=state.steps + (accept & ~done).astype(int),
        )

    one, none = jnp.ones(()), jnp.asarray(0)
    begin = _Descent(
        unknowns=first,
        states=states,
        step=jnp.zeros_like(first),
        energy=jnp.inf * one,
        slope=0.0 * one,
        fraction=one,
        factor=FACTOR * one,
        residual=jnp.inf * one,
        scale=one,
        far=jnp.zeros_like(at_first),
        done=none > 0,
        trials=none,
        steps=none,
    )
    end = jax.lax.while_loop(lambda state: ~state.done & (state.trials < TRIALS), look, begin)
    lost = jnp.max(end.far) > 1.0
    return Start(end.unknowns, end.residual, end.steps, lost, jnp.argmax(end.far), end.scale)


class Root(NamedTuple):
    """The equilibrium.

    - `unknowns`: see `balance`.
    - `inverse`: inverse of the Jacobian of the residual.
    - `solved`: True if the search converged.
    """

    unknowns: Float[Array, " unknown"]
    inverse: Float[Array, "unknown unknown"]
    solved: Bool[Array, ""]
    status: Int[Array, ""]
    start_steps: Int[Array, ""]
    newton_steps: Int[Array, ""]
    residual: Float[Array, ""]
    softest: Int[Array, ""]


def anchored(balance: Balance, stiffness: Float[Array, "bearing 5 5"]) -> Float[Array, "bearing 5 5"]:
    """The stiffness of all bearings with the stiffness `ANCHOR` added to each freedom."""
    return stiffness + ANCHOR * jnp.diag(jnp.square(balance.lengths()))[None]


class _Newton(NamedTuple):
    unknowns: Array
    step: Array
    inverse: Array
    size: Array
    fraction: Array
    done: Bool[Array, ""]
    failed: Bool[Array, ""]
    trials: Int[Array, ""]
    steps: Int[Array, ""]


def _search(problem: Problem, options: NewtonOptions) -> Root:
    problem = jax.lax.stop_gradient(problem)
    balance, start = problem.balance, minimise(problem)
    units, lengths = balance.row_units(), balance.lengths()

    def look(state: _Newton) -> _Newton:
        trial = state.unknowns + state.fraction * state.step
        force, stiffness, good = ports(problem, balance.displacements(trial), options)
        residual = balance.residual(trial, force)
        size = jnp.max(jnp.abs(residual * units)) / start.scale
        good &= jnp.isfinite(size)
        inverse = balance.inverse(anchored(balance, stiffness))
        step = -inverse @ residual
        moved = jnp.max(jnp.abs((balance.attach @ step).reshape(-1, 5) * lengths[None]))
        fine = (size <= options.residual_tolerance) | ((moved <= ROUNDED_STEP) & (size <= MOST_ROUNDED))
        accept = good & ((size < state.size) | (state.fraction < 0.02))
        pick = lambda new, old: jnp.where(accept, new, old)
        return _Newton(
            unknowns=pick(trial, state.unknowns),
            step=pick(step, state.step),
            inverse=pick(inverse, state.inverse),
            size=pick(size, state.size),
            fraction=jnp.where(accept, 1.0, SHORTER * state.fraction),
            done=accept & fine,
            failed=~accept & ((state.fraction < SHORTEST) | (state.trials == 0)),
            trials=state.trials + 1,
            steps=state.steps + (accept & ~fine).astype(int),
        )

    none, one = jnp.asarray(0), jnp.ones(())
    reached = ~start.lost & (start.residual <= START_TOLERANCE)
    begin = _Newton(
        unknowns=start.unknowns,
        step=jnp.zeros_like(start.unknowns),
        inverse=jnp.zeros_like(balance.linear),
        size=jnp.inf * one,
        fraction=one,
        done=none > 0,
        failed=~reached,
        trials=none,
        steps=none,
    )
    going = lambda state: ~(state.done | state.failed) & (state.trials < NEWTON_TRIALS)
    end = jax.lax.while_loop(going, look, begin)
    # the step that the test of convergence computed is taken as well
    unknowns = jnp.where(end.done, end.unknowns + end.step, end.unknowns)
    failure = jnp.where(start.lost, int(Status.NO_EQUILIBRIUM), int(Status.NOT_CONVERGED))
    status = jnp.where(end.done, int(Status.CONVERGED), failure)
    unknowns = jnp.where(jnp.isfinite(unknowns), unknowns, 0.0)
    size = jnp.where(reached, end.size, start.residual)
    return Root(unknowns, end.inverse, end.done, status, start.steps, end.steps, size, start.softest)


@eqx.filter_custom_jvp
def equilibrium(problem: Problem, *, options: NewtonOptions) -> Root:
    """The equilibrium of a shaft, with first derivatives; it never raises for a failed search."""
    return _search(problem, options)


@equilibrium.def_jvp
def _equilibrium_jvp(primals, tangents, *, options: NewtonOptions):
    (problem,), (problem_dot,) = primals, tangents
    root = equilibrium(problem, options=options)
    # The tangents of a failed lane are set to 0. Otherwise NaN times 0 would spoil derivatives with respect to numbers
    # that all lanes of a batch share.
    select = lambda t: None if t is None else jnp.where(root.solved, t, 0.0)
    problem_dot = jax.tree.map(select, problem_dot)

    def residual(problem: Problem) -> Array:
        force, _, _ = ports(problem, problem.balance.displacements(root.unknowns), options)
        return problem.balance.residual(root.unknowns, force)

    _, residual_dot = eqx.filter_jvp(residual, (problem,), (problem_dot,))
    dot = select(-root.inverse @ residual_dot)
    nothing = jax.tree.map(lambda _: None, root)
    return root, nothing._replace(unknowns=dot)
