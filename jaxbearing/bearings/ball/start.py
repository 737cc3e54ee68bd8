r"""First guess of the equilibrium of a ball bearing: a convex problem without friction, at given centrifugal forces.

The potential is
$\Pi = \sum_j[\sum\frac25K_o\delta_{o+}^{5/2} + \sum\frac25K_i\delta_{i+}^{5/2} - F_CW] - F\cdot q$, with sums over the
balls j and over the arcs of each ring (`arcs`). It is convex, because each $\delta$ is the norm of an affine map minus
a constant, and the power 5/2 of its positive part is convex and increasing. Two nested damped Newton iterations
minimise it: the inner one finds the equilibrium of each ball for given rings, the outer one that of the rings with
every ball in equilibrium. Both accept a step only if the potential decreases. Only `force_at` is differentiated; the
other functions give the start of an iteration.
"""

import dataclasses
import functools
import operator
from collections.abc import Callable
from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from ...numerics.arrow import condensed
from ...numerics.safe import safe_norm
from ...numerics.small_linear import solve_blocks, solve_dense
from ..ring import LENGTH_UNIT
from .arcs import added
from .springs import CentrifugalProblem, Forces, forces_at, inner_springs, together

RING_TOLERANCE = 2e-2
"""Tolerance of the force balance of the ring, relative to the load; sufficient as first guess of the full equations."""
BENDING_TOLERANCE = 1e-8
"""Tolerance of the balance of flexible rings if the inner ring is held, relative to the load; `hold` takes one more
Newton step."""
BALL_TOLERANCE = 1e-9
"""Tolerance of the force balance of a ball, relative to its load scale."""
RING_STEPS, BALL_STEPS = 40, 60
"""Largest number of trial steps of the iterations on the rings and on the balls."""
SOFTEST = 1e2
"""Stiffness added to that of balls and rings in Newton steps, N/m; a ring that no ball holds has none of its own."""
ARMIJO = 1e-4
"""Least decrease of the potential in a step, over the decrease that its slope predicts (Armijo's rule)."""
SHORTEST = 1e-6
"""Fraction of the Newton step below which a step is accepted without a decrease, which round-off then hides."""


class Start(NamedTuple):
    """First guess: ball centres from the outer groove centre and coordinates of the rings, m, and the number of Newton
    steps on the rings."""

    centre: Float[Array, "2 ball"]
    ring: Float[Array, " coordinate"]
    steps: Int[Array, ""]


def free_centres(
    problem: CentrifugalProblem, groove: Array, blocked: bool | Bool[Array, ""] = True
) -> tuple[Array, Bool[Array, " ball"]]:
    """Estimated ball centres for given inner grooves, m, and which balls do not touch the inner race (exact).

    **Arguments:** `groove`: coordinates of the inner groove at every ball, m; `blocked`: whether the inner race stops a
    ball that the centrifugal force moves towards the bottom of the outer groove. As long as the ring has not followed,
    the contact angles without this stop are nearer to those of the equilibrium.
    """
    compliance = problem.stiffness ** (-2.0 / 3.0)
    arcs = problem.arcs
    every = arcs.inner_centres(groove)
    groove, flank = arcs.facing(groove)
    length = safe_norm(groove[0], groove[1], 1e-30)
    load = together(problem.stiffness) * jnp.maximum(length - jnp.sum(problem.offset), 0.0) ** 1.5
    axial, radial = load * groove[0] / length, load * groove[1] / length + problem.centrifugal
    outer = safe_norm(axial, radial, 1e-30)
    reach = problem.offset[1] + compliance[1] * outer ** (2.0 / 3.0)
    # the ball lies in the outer groove in the direction of the force on it, but does not penetrate the inner race
    angle, side = jnp.arctan2(groove[0], groove[1]), jnp.where(groove[0] < 0, -1.0, 1.0)
    inner = problem.offset[0] + compliance[0] * load ** (2.0 / 3.0)
    swing = (jnp.square(reach) + jnp.square(length) - jnp.square(inner)) / (2.0 * reach * length)
    stopped = side * angle - jnp.arccos(jnp.clip(swing, -1.0, 1.0))
    stopped = jnp.where(blocked, stopped, -jnp.inf)
    if arcs.outer is not None:
        # nor the other arc of the outer ring
        stopped = jnp.maximum(stopped, jnp.arcsin(arcs.outer / problem.offset[1]))
    angle = side * jnp.maximum(side * jnp.arctan2(axial, radial), stopped)
    centre = arcs.moved_out(reach[None] * jnp.stack([jnp.sin(angle), jnp.cos(angle)]), flank)
    alone = _resting(problem, compliance[1])
    lost = functools.reduce(
        operator.and_, [safe_norm(place[0], place[1] - alone) <= problem.offset[0] for place in every]
    )
    resting = jnp.stack([jnp.zeros_like(length), alone])
    return jnp.where(lost[None], resting, centre), lost


def _resting(problem: CentrifugalProblem, compliance: Array) -> Float[Array, " ball"]:
    """Outward distance of a ball that touches the outer ring only from the outer groove centre, m. For an outer ring
    with two arcs it is approximated to first order in the deformation."""
    offset, force, apart = problem.offset[1], problem.centrifugal, problem.arcs.outer
    if apart is None:
        return offset + compliance * force ** (2.0 / 3.0)
    height = jnp.sqrt(jnp.square(offset) - jnp.square(apart))
    cosine = height / offset
    return height + compliance * (force / (2.0 * cosine)) ** (2.0 / 3.0) / cosine


class _Balls(NamedTuple):
    centre: Array
    step: Array
    energy: Array
    slope: Array
    fraction: Array
    done: Bool[Array, " ball"]
    trials: Int[Array, ""]


def _equilibrium(
    problem: CentrifugalProblem, groove: Array, scale: Array, cap: Array, near: Float[Array, "2 ball"] | None = None
) -> Float[Array, "2 ball"]:
    """Ball centres that minimise the potential of each ball for given inner grooves, m.

    **Arguments:** `groove`: coordinates of the inner groove at every ball, m; `scale`: scale of the force balances of
    the balls, N; `cap`: longest step, m; `near`: ball centres for other grooves, m. The search starts from `near` if
    the potential is lower there than at the centres of `free_centres`.
    """
    first, lost = free_centres(problem, groove)
    if near is not None:
        energies = [forces_at(problem, centre, groove).energy for centre in (near, first)]
        first = jnp.where((energies[0] < energies[1]) & ~lost, near, first)

    def propose(centre: Array, forces: Forces):
        matrix = forces.stiffness + SOFTEST * jnp.eye(2)[:, :, None]
        step = -solve_blocks(matrix, forces.balance[:, None, :])[:, 0]
        step = step * jnp.minimum(1.0, cap / safe_norm(step[0], step[1], 1e-30))[None]
        small = jnp.max(jnp.abs(forces.balance), axis=0) <= BALL_TOLERANCE * scale
        return step, jnp.sum(step * forces.balance, axis=0), small | (jnp.max(jnp.abs(step), axis=0) < 1e-15)

    def advance(state: _Balls) -> _Balls:
        trial = state.centre + state.fraction[None] * state.step
        forces = forces_at(problem, trial, groove)
        enough = forces.energy <= state.energy + ARMIJO * state.fraction * state.slope
        # near the minimum the decrease is lost in the round-off of the energy
        near = jnp.abs(state.slope) <= 1e-12 * jnp.abs(forces.energy) + 1e-18
        accept = (enough | near | (state.fraction < SHORTEST)) & ~state.done
        step, slope, small = propose(trial, forces)
        # a ball that starts with NaN stays NaN, and the other balls would wait for it
        hopeless = (state.trials == 0) & jnp.isnan(forces.energy)
        return _Balls(
            centre=jnp.where(accept[None], trial, state.centre),
            step=jnp.where(accept[None], step, state.step),
            energy=jnp.where(accept, forces.energy, state.energy),
            slope=jnp.where(accept, slope, state.slope),
            fraction=jnp.where(accept, 1.0, jnp.where(state.done, state.fraction, 0.3 * state.fraction)),
            done=state.done | (accept & small) | hopeless,
            trials=state.trials + 1,
        )

    # the first trial is the start itself, taken in any case
    zeros = jnp.zeros_like(first[0])
    # between two arcs of the outer ring the guess of a ball at rest is not exact
    done = lost if problem.arcs.outer is None else jnp.zeros_like(lost)
    begin = _Balls(first, jnp.zeros_like(first), zeros + jnp.inf, zeros, zeros + 1.0, done, jnp.asarray(0))
    going = lambda state: (state.trials < BALL_STEPS) & ~jnp.all(state.done)
    return jax.lax.while_loop(going, advance, begin).centre


def _on_ring(problem: CentrifugalProblem, forces: Forces) -> tuple[Float[Array, " coordinate"], Array]:
    """Forces that hold the rings against the balls, N, and their derivatives with every ball in equilibrium, N/m."""
    # stiffness of a ball in equilibrium: springs in series
    series = forces.stiffness + 1e-3 * SOFTEST * jnp.eye(2)[:, :, None]
    reduced = forces.of_groove - jnp.einsum("jin,jkn->ikn", forces.coupling, solve_blocks(series, forces.coupling))
    force = problem.multiplicity * jnp.einsum("fcn,cn->f", problem.directions, forces.inner)
    matrix = problem.multiplicity * jnp.einsum("fan,abn,gbn->fg", problem.directions, reduced, problem.directions)
    return force, matrix


class HeldBalls(NamedTuple):
    """Balls in equilibrium with an inner ring that is held: energy, J, forces on the degrees of freedom of the ring, N,
    their derivatives, N/m, ball centres, m, and amplitudes of flexible rings, m."""

    energy: Float[Array, ""]
    force: Float[Array, " freedom"]
    stiffness: Float[Array, "freedom freedom"]
    centre: Float[Array, "2 ball"]
    amplitudes: Float[Array, " mode"] | None


def hold(
    problem: CentrifugalProblem,
    ring: Float[Array, " freedom"],
    near: Float[Array, "2 ball"],
    guess: Float[Array, " mode"] | None = None,
) -> HeldBalls:
    """Equilibrium of the balls for given displacements of the inner ring, m; not differentiated.

    **Arguments:** `ring`: displacements of the inner ring, as lengths, m; `near`: ball centres for other displacements,
    m; `guess`: first guess of the amplitudes of flexible rings, m. The accuracy of the amplitudes is explained in
    `bearings.row`.
    """
    problem, ring = jax.lax.stop_gradient((problem, ring))
    cap, outer = 0.5 * problem.centre_distance, problem.outer
    if guess is None:
        groove = problem.groove_at(ring)
        centre = _equilibrium(problem, groove, _pressed_scale(problem, groove), cap, near)
        forces = forces_at(problem, centre, groove)
        force, matrix = _on_ring(problem, forces)
        return HeldBalls(problem.multiplicity * jnp.sum(forces.energy), force, matrix, centre, None)
    count = len(problem.freedoms)
    bending = dataclasses.replace(
        problem,
        groove=problem.groove_at(jnp.concatenate([ring, jnp.zeros_like(guess)])),
        directions=problem.directions[count:],
        ring_load=jnp.zeros(0),
        freedoms=(),
    )

    def scales(groove: Array) -> tuple[Array, Array]:
        scale = _pressed_scale(problem, groove)
        total = problem.multiplicity * jnp.sum(scale)
        return scale, total if outer is None else total + outer.given_load()

    minimum = _descend(bending, guess, scales, cap, BENDING_TOLERANCE)
    rings = jnp.concatenate([ring, minimum.ring])
    forces = forces_at(problem, minimum.centre, problem.groove_at(rings))
    force, matrix = _on_ring(problem, forces)
    balance, matrix = problem.ring_balance(rings, force), _anchored(problem.ring_stiffness(rings, matrix), count)
    follow = solve_dense(matrix[count:, count:], balance[count:])
    energy = problem.multiplicity * jnp.sum(forces.energy) - bending.ring_work(minimum.ring)
    return HeldBalls(
        energy - 0.5 * jnp.sum(balance[count:] * follow),
        force[:count] - matrix[:count, count:] @ follow,
        condensed(matrix, count),
        minimum.centre,
        minimum.ring,
    )


def _pressed_scale(problem: CentrifugalProblem, groove: Float[Array, "p ball"]) -> Float[Array, " ball"]:
    """Scale of the force balances of the balls between given grooves, N."""
    pair, _ = problem.arcs.facing(groove)
    depth = jnp.maximum(safe_norm(pair[0], pair[1], 1e-30) - jnp.sum(problem.offset), 0.0)
    return together(problem.stiffness) * jnp.max(depth) ** 1.5 + problem.centrifugal


def _anchored(matrix: Float[Array, "coordinate coordinate"], count: int) -> Float[Array, "coordinate coordinate"]:
    """The stiffness of both rings with a small stiffness added for the amplitudes, which come after the first `count`
    coordinates. It holds an outer ring that no support and no ball touches."""
    anchor = np.where(np.arange(matrix.shape[0]) < count, 0.0, 1e-3 * SOFTEST)
    return matrix + jnp.diag(jnp.asarray(anchor))


def force_at(
    problem: CentrifugalProblem,
    ring: Float[Array, " freedom"],
    centre: Float[Array, "2 ball"],
    amplitudes: Float[Array, " mode"] | None = None,
) -> Float[Array, " freedom"]:
    """The forces of `hold` in a form that has first derivatives: balls and amplitudes take one more Newton step, which
    carries the derivatives and is 0 at the solution.

    **Arguments:** `ring`: displacements of the inner ring, m; `centre`, `amplitudes`: solution of `hold`, m.
    """
    centre = jax.lax.stop_gradient(centre)
    if amplitudes is None:
        return _forces(problem, ring, centre)
    count = len(problem.freedoms)
    rings = jnp.concatenate([ring, jax.lax.stop_gradient(amplitudes)])
    held, at = jax.lax.stop_gradient((problem, rings))
    matrix = _on_ring(held, forces_at(held, centre, held.groove_at(at)))[1]
    matrix = _anchored(held.ring_stiffness(at, matrix), count)
    balance = problem.ring_balance(rings, _forces(problem, rings, centre))
    rings = rings.at[count:].add(-solve_dense(matrix[count:, count:], balance[count:]))
    return _forces(problem, rings, centre)[:count]


def _forces(
    problem: CentrifugalProblem, ring: Float[Array, " coordinate"], centre: Float[Array, "2 ball"]
) -> Float[Array, " coordinate"]:
    """Forces that hold the rings, N, in a form that has first derivatives: the balls take one Newton step from
    `centre`."""
    groove = problem.groove_at(ring)
    forces = forces_at(problem, centre, groove)
    matrix = jax.lax.stop_gradient(forces.stiffness) + 1e-3 * SOFTEST * jnp.eye(2)[:, :, None]
    step = solve_blocks(matrix, forces.balance[:, None, :])[:, 0]
    inner = inner_springs(problem, centre - step, groove)[1]
    return problem.multiplicity * jnp.einsum("fcn,cn->f", problem.directions, inner.force)


class _Ring(NamedTuple):
    ring: Array
    centre: Array
    step: Array
    energy: Array
    slope: Array
    fraction: Array
    done: Bool[Array, ""]
    trials: Int[Array, ""]
    steps: Int[Array, ""]


def start(problem: CentrifugalProblem, ring: Float[Array, " coordinate"]) -> Start:
    """Minimum of the potential to `RING_TOLERANCE`. **Arguments:** `ring`: estimated coordinates of the rings, m."""
    problem = jax.lax.stop_gradient(problem)
    total, count = _scale(problem)
    scale = total / count + problem.centrifugal
    cap = 0.5 * problem.centre_distance
    if not ring.size:
        return Start(_equilibrium(problem, problem.groove, scale, cap), ring, jnp.asarray(0))
    return _descend(problem, ring, lambda groove: (scale, total), cap, RING_TOLERANCE)


def _descend(
    problem: CentrifugalProblem,
    ring: Float[Array, " coordinate"],
    scales: Callable[[Array], tuple[Array, Array]],
    cap: Array,
    tolerance: float,
) -> Start:
    """Minimum of the potential over the coordinates of the rings, with every ball in equilibrium.

    **Arguments:** `ring`: first guess of the coordinates of the rings, m; `scales`: function from the coordinates of
    the grooves, m, to the scales of the force balances of the balls and of the rings, N; `cap`: largest change of a
    coordinate or ball centre in one step, m; `tolerance`: tolerance of the balances of the rings over their scale.
    """

    def evaluate(ring: Array):
        groove = problem.groove_at(ring)
        scale, total = scales(groove)
        centre = _equilibrium(problem, groove, scale, cap)
        forces = forces_at(problem, centre, groove)
        force, matrix = _on_ring(problem, forces)
        balance, matrix = problem.ring_balance(ring, force), problem.ring_stiffness(ring, matrix)
        step = -solve_dense(matrix + SOFTEST * jnp.eye(matrix.shape[0]), balance)
        step = step * jnp.minimum(1.0, cap / jnp.maximum(jnp.max(jnp.abs(step)), 1e-30))
        energy = problem.multiplicity * jnp.sum(forces.energy) - problem.ring_work(ring)
        small = jnp.max(jnp.abs(balance)) <= tolerance * total
        return centre, step, energy, jnp.sum(balance * step), small

    def advance(state: _Ring) -> _Ring:
        trial = state.ring + state.fraction * state.step
        centre, step, energy, slope, small = evaluate(trial)
        enough = energy <= state.energy + ARMIJO * state.fraction * state.slope
        near = jnp.abs(state.slope) <= 1e-12 * jnp.abs(energy) + 1e-18
        accept = enough | near | (state.fraction < SHORTEST)
        pick = lambda new, old: jnp.where(accept, new, old)
        hopeless = (state.trials == 0) & jnp.isnan(energy)
        return _Ring(
            ring=pick(trial, state.ring),
            centre=pick(centre, state.centre),
            step=pick(step, state.step),
            energy=pick(energy, state.energy),
            slope=pick(slope, state.slope),
            fraction=pick(1.0, 0.3 * state.fraction),
            done=(accept & small) | hopeless,
            trials=state.trials + 1,
            steps=state.steps + (accept & ~small).astype(int),
        )

    none, one = jnp.asarray(0), jnp.ones(())
    begin = _Ring(
        ring,
        jnp.zeros((2, problem.groove.shape[1])),
        jnp.zeros_like(ring),
        one * jnp.inf,
        0.0 * one,
        one,
        none > 0,
        none,
        none,
    )
    going = lambda state: (state.trials < RING_STEPS) & ~state.done
    end = jax.lax.while_loop(going, advance, begin)
    return Start(end.centre, end.ring, end.steps)


def _scale(problem: CentrifugalProblem) -> tuple[Array, int]:
    """Scale of the load on the ring, N, and number of balls of the bearing."""
    count = problem.groove.shape[1] * problem.multiplicity
    size = jnp.sqrt(jnp.sum(jnp.square(problem.ring_load)))
    if problem.held_load is not None:
        size = size + problem.held_load
    return size + 1e-3 * count, count


def ring_estimate(problem: CentrifugalProblem) -> Float[Array, " coordinate"]:
    """Estimated coordinates of the rings, m. Flexible rings start with a displacement as rigid bodies, and the inner
    ring is displaced with them."""
    inner = _inner_estimate(problem)
    if not problem.bent:
        return inner
    load = dict(zip(problem.freedoms, problem.ring_load, strict=True))
    in_plane = jnp.stack([load.get(name, jnp.zeros(())) for name in ("radial", "lateral")])
    amplitudes = LENGTH_UNIT * problem.bent.start(in_plane)
    along, across = problem.bent.displacement(amplitudes)
    follow = {"radial": along, "lateral": across}
    shift = [follow.get(name, jnp.zeros(())) for name in problem.freedoms]
    return jnp.concatenate([inner + jnp.stack(shift) if shift else inner, amplitudes])


def _inner_estimate(problem: CentrifugalProblem) -> Float[Array, " freedom"]:
    """Estimated displacements of the inner ring between round, rigid races, m. They are rather too large than too
    small, because Newton's method on a power of 3/2 converges from the side of larger loads, and a ring that touches no
    ball has no stiffness.

    The axial displacement follows from $\\sin\\alpha(\\cos\\alpha_0/\\cos\\alpha - 1)^{3/2} = F/(NK_nBD^{3/2})$, with F
    not below the axial force that loads half of the balls (Harris); the radial one follows from Sjovall's load
    distribution.
    """
    if not problem.freedoms:
        return jnp.zeros(0)
    total, count = _scale(problem)
    load = dict(zip(problem.freedoms, problem.ring_load, strict=True))
    zero = jnp.zeros(())
    both = together(problem.stiffness)
    # with radial preload the gap between the rings is smaller than the ball diameter
    distance, cosine = problem.centre_distance, jnp.minimum(problem.free_cosine, 1.0)
    axial, across = load.get("axial", zero), jnp.stack([load.get("radial", zero), load.get("lateral", zero)])
    radial = jnp.sqrt(jnp.sum(jnp.square(across)))
    tilting = jnp.abs(load.get("tilt", zero)) + jnp.abs(load.get("tilt_lateral", zero))
    sine = jnp.sqrt(jnp.maximum(1.0 - cosine * cosine, 0.0))
    tangent = sine / cosine
    thrust = jnp.maximum(jnp.maximum(jnp.abs(axial) + tilting, 1.22 * radial * tangent), 1.0)
    target = jnp.log(thrust / (count * both * distance**1.5))

    def deeper(_, angle):
        """One Newton step for the contact angle, on the logarithm of the axial force, from larger angles."""
        lift = jnp.maximum(cosine / jnp.cos(angle) - 1.0, 1e-12)
        value = jnp.log(jnp.sin(angle)) + 1.5 * jnp.log(lift) - target
        slope = 1.0 / jnp.tan(angle) + 1.5 * cosine * jnp.tan(angle) / (jnp.cos(angle) * lift)
        low = jnp.arccos(cosine) + 1e-9
        return jnp.clip(angle - value / slope, 0.5 * (low + angle), 1.5)

    free = jnp.arccos(cosine)
    angle = jax.lax.fori_loop(0, 12, deeper, jnp.minimum(free + 0.3, 1.45))
    depth = distance * jnp.sin(angle - free) / jnp.cos(angle)
    pushed = jnp.where(axial < 0, -1.0, 1.0)
    first, play = distance * sine, distance * (1.0 - cosine)
    if not problem.arcs.single:
        # with two arcs the axial and the radial play are smaller
        first = first - added([offset for offset in problem.arcs if offset is not None])
        play = play - problem.arcs.lift(problem.offset)
    mixed = 1.0 - 0.6 * jnp.minimum(1.0, radial * tangent / jnp.maximum(jnp.abs(axial), 1e-3))
    alone = (jnp.abs(axial) + tilting) <= 1e-9 * total
    inward = jnp.where(alone, problem.aligned, problem.aligned + pushed * (first + depth * mixed))
    moved = (5.0 * radial / (count * cosine * both)) ** (2.0 / 3.0)
    moved = moved + jnp.where(alone, play, 0.0)
    along = moved * across / jnp.where(radial > 0, radial, 1.0)
    guesses = {"axial": inward, "radial": along[0], "lateral": along[1]}
    return jnp.stack([guesses.get(name, zero) for name in problem.freedoms])
