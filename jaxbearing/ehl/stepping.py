r"""Steps in time of a line contact: variable-step BDF2 with error control, one compiled segment after the other.

The discrete problem is a differential-algebraic one of index 1: $m = \bar\rho H(P, H_{00})$ is differentiated in time,
the load is an algebraic row, and cavitation a complementarity. Each step solves the same rows as the steady film, with

$\partial_t m \approx c_0 m^{n+1} - c_1 m^n + c_2 m^{n-1}$, $c_0 = \frac1h + \frac1{h + h_1}$,
$c_1 = \frac{h + h_1}{h h_1}$, $c_2 = \frac{h}{h_1(h + h_1)}$,

h the step, h_1 the one before (the first step: implicit Euler). BDF2 damps what is stiff (L-stable at constant steps,
stable while steps grow by less than 2.41: here by 2 at most). The local error is measured against the parabola through
the last three m, which is also the first guess: with the third derivative y''' the step errs by
$\frac{y'''}{6} h(h + h_1) A$, the parabola by $-\frac{y'''}{6} h(h + h_1) B$, $A = h(h + h_1)/(2h + h_1)$,
$B = h + h_1 + h_2$; so the error is A/(A + B) of their difference.
"""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from ..numerics.status import Status
from ..time_laws import AbstractTimeFactor
from .equations import Equations, Fluid, Point, face_fluxes, film_shape, mass
from .mesh import Mesh
from .newton import newton

FIRST_STEP = 1e-4
"""First trial step, in a/u_0. In steps far below 1e-7 the round-off of m would show in the mass
balance (1e-8)."""
SHORTEST_STEP = 1e-13
"""Shortest step, in a/u_0; a run that would need a shorter one has failed."""
LARGEST_GROWTH, SMALLEST_GROWTH = 2.0, 0.2
CLOSEST_KINK = 1e-6
"""Distance in time within which a kink of the speed is skipped, in a/u_0."""
JUMP = 1e-9
"""Change of the speed, over the reference speed, above which it counts as a jump and not as round-off."""
SAFETY = 0.85
AFTER_FAILURE = 0.3
"""Length of the next trial step over that of a step whose equations could not be solved."""
NEWTON_TOLERANCE = 1e-9
"""Largest change of an unknown by the last Newton step."""
NEWTON_STEPS = 12
SEGMENT = 32
"""Number of steps that one call of the compiled program takes."""


class Motion(NamedTuple):
    """State of a run: enough to go on exactly as if it had not stopped. Times in a/u_0.

    `points`, `masses`: at the last three times, newest first; `steps`: between them; `known`: how many there are;
    `proposal`: the step to try next.
    """

    time: Float[Array, ""]
    points: Point
    """Unknowns at the last three times, with a leading axis of three."""
    masses: Float[Array, "3 node"]
    steps: Float[Array, "2"]
    known: Int[Array, ""]
    proposal: Float[Array, ""]


class Drive(eqx.Module):
    """Constants of a run. **Arguments:** `fluid`; `wedge`; `speed`: over that of the operation, as a function of time;
    `unit`: s, one unit of the dimensionless time; `base`: the operation's speed over the reference speed (its
    sign); `tolerance`: largest relative error of m in one step; `film_limit`: dimensionless."""

    fluid: Fluid
    wedge: Scalar
    speed: AbstractTimeFactor
    unit: Scalar
    base: Scalar
    tolerance: Scalar
    film_limit: Scalar

    def speed_at(self, time: Float[Array, ""]) -> Float[Array, ""]:
        """Entrainment speed over the reference speed. **Arguments:** `time`, in a/u_0."""
        return jnp.asarray(self.base * self.speed.factor(time * self.unit))

    def next_halt(self, time: Float[Array, ""], stop: Float[Array, ""]) -> Float[Array, ""]:
        """The next kink of the speed, or `stop`: a step ends there."""
        kinks = self.speed.kinks() / self.unit
        ahead = (kinks > time + CLOSEST_KINK) & (kinks < stop - CLOSEST_KINK)
        return jnp.minimum(stop, jnp.min(kinks, initial=jnp.inf, where=ahead))


class Record(NamedTuple):
    """Accepted steps of a segment, in the first `taken` rows."""

    time: Float[Array, " row"]
    point: Point
    speed: Float[Array, " row"]
    balance: Float[Array, " row"]


class Advanced(NamedTuple):
    """Result of a segment. `status`: -1 while the run goes on; `thin`: it ended below the film limit."""

    motion: Motion
    record: Record
    taken: Int[Array, ""]
    rejected: Int[Array, ""]
    newton_steps: Int[Array, ""]
    status: Int[Array, ""]
    thin: Bool[Array, ""]


def at_rest(point: Point, fluid: Fluid, mesh: Mesh, time: Scalar = 0.0) -> Motion:
    """Start of a run at a point, without any earlier history."""
    m = mass(fluid, point.pressure, film_shape(point, mesh))
    three = lambda leaf: jnp.broadcast_to(leaf, (3, *leaf.shape))
    time = jnp.asarray(time, dtype=float)
    # strong types: the first segment and the next ones are one program
    first = jnp.asarray(FIRST_STEP, dtype=float)
    return Motion(time, jax.tree.map(three, point), three(m), jnp.ones(2), jnp.asarray(1, dtype=int), first)


def _extrapolation(step: Array, steps: Array, known: Array) -> Float[Array, "3"]:
    """Weights of the last three values in their extrapolation by one step: as a constant, a line or a parabola."""
    h, h1, h2 = step, steps[0], steps[1]
    nothing = jnp.zeros_like(h)
    constant = jnp.stack([nothing + 1.0, nothing, nothing])
    line = jnp.stack([1.0 + h / h1, -h / h1, nothing])
    parabola = jnp.stack(
        [
            (h + h1) * (h + h1 + h2) / (h1 * (h1 + h2)),
            -h * (h + h1 + h2) / (h1 * h2),
            h * (h + h1) / ((h1 + h2) * h2),
        ]
    )
    return jnp.where(known == 1, constant, jnp.where(known == 2, line, parabola))


def _derivative(step: Array, steps: Array, masses: Array, known: Array) -> tuple[Array, Array]:
    """Factor c_0 of the new m in its time derivative, and the part of the derivative from earlier m."""
    h, h1 = step, steps[0]
    first = known == 1
    rate = jnp.where(first, 1.0 / h, 1.0 / h + 1.0 / (h + h1))
    newest = jnp.where(first, 1.0 / h, (h + h1) / (h * h1))
    older = jnp.where(first, 0.0, h / (h1 * (h + h1)))
    return rate, older * masses[1] - newest * masses[0]


def _error_part(step: Array, steps: Array, known: Array) -> Array:
    """Share of the difference between solution and extrapolation that counts as error: 1 (too much) for the first
    step; 1/2 for the second, whose extrapolation is a line."""
    h, h1, h2 = step, steps[0], steps[1]
    a, b = h * (h + h1) / (2.0 * h + h1), h + h1 + h2
    return jnp.where(known == 1, 1.0, jnp.where(known == 2, 0.5, a / (a + b)))


def mass_imbalance(equations: Equations, point: Point, mesh: Mesh) -> Float[Array, ""]:
    """Error of the mass balance of the zone under pressure (inflow less outflow less change of the mass in it), over
    the sum of the changes in it and the largest flux through a face."""
    film = film_shape(point, mesh)
    flux = face_fluxes(equations, point.pressure, film, mesh)
    m = mass(equations.fluid, point.pressure, film)
    change = (equations.rate * m + equations.past)[1:-1] * jnp.asarray(mesh.cell)
    inside = point.pressure[1:-1] > 0
    left = jnp.sum(jnp.where(inside, flux[1:] - flux[:-1] - change, 0.0))
    through = jnp.max(jnp.where(inside, jnp.maximum(jnp.abs(flux[1:]), jnp.abs(flux[:-1])), 0.0))
    size = jnp.sum(jnp.where(inside, jnp.abs(change), 0.0)) + through
    return jnp.abs(left) / jnp.where(size > 0, size, 1.0)


def _select(condition: Array, new: object, old: object):
    return jax.tree.map(lambda a, b: jnp.where(condition, a, b), new, old)


def advance(drive: Drive, motion: Motion, stop: Float[Array, ""], mesh: Mesh) -> Advanced:
    """Takes up to `SEGMENT` accepted steps, until `stop` (in a/u_0), the film limit, or a failure."""
    empty = jax.tree.map(lambda leaf: jnp.zeros((SEGMENT, *leaf.shape[1:])), motion.points)
    rows = jnp.zeros(SEGMENT)
    begin = Advanced(
        motion,
        Record(rows, empty, rows, rows),
        jnp.asarray(0),
        jnp.asarray(0),
        jnp.asarray(0),
        jnp.asarray(-1),
        jnp.asarray(False),
    )

    def go_on(state: Advanced) -> Array:
        return (state.status < 0) & (state.taken < SEGMENT)

    def take(state: Advanced) -> Advanced:
        now = state.motion
        halt = drive.next_halt(now.time, stop)
        left = halt - now.time
        halts = now.proposal >= left
        # avoid a tiny step just before the halt
        step = jnp.where(halts, left, jnp.minimum(now.proposal, 0.5 * left))
        last_one = halts & (halt >= stop)
        time = jnp.where(halts, halt, now.time + step)
        # where the speed jumps at the halt, its value just before
        then, until = drive.speed_at(time), drive.speed_at(time * (1.0 - 4.0 * jnp.finfo(float).eps))
        speed = jnp.where(halts & (jnp.abs(then - until) > JUMP), until, then)
        weights = _extrapolation(step, now.steps, now.known)
        ahead = jax.tree.map(lambda leaf: jnp.tensordot(weights, leaf, 1), now.points)
        ahead = Point(jnp.maximum(ahead.pressure, 0.0), ahead.offset)
        newest = jax.tree.map(lambda leaf: leaf[0], now.points)
        before = film_shape(newest, mesh)
        guess = _select(jnp.min(film_shape(ahead, mesh) / before) > 0.2, ahead, newest)
        rate, past = _derivative(step, now.steps, now.masses, now.known)
        equations = Equations(drive.fluid, drive.wedge, speed, rate, past)
        wanted = jnp.asarray(True)
        root = newton(equations, guess, mesh, tolerance=NEWTON_TOLERANCE, max_steps=NEWTON_STEPS, wanted=wanted)
        film = film_shape(root.point, mesh)
        m = mass(drive.fluid, root.point.pressure, film)
        differs = jnp.abs(m - weights @ now.masses) / jnp.abs(m)
        error = _error_part(step, now.steps, now.known) * jnp.max(differs) / drive.tolerance
        sound = root.converged & jnp.isfinite(error) & (jnp.min(film) > 0)
        accept = sound & (error <= 1.0)
        order = jnp.where(now.known == 1, 2.0, 3.0)
        growth = SAFETY * jnp.maximum(error, 1e-12) ** (-1.0 / order)
        growth = jnp.clip(growth, SMALLEST_GROWTH, LARGEST_GROWTH)
        proposal = step * jnp.where(sound, growth, AFTER_FAILURE)
        # a step cut short by a halt says nothing against the step proposed before it
        proposal = jnp.where(accept & (step < now.proposal), jnp.maximum(proposal, now.proposal), proposal)
        shifted = lambda new, old: jnp.concatenate([new[None], old[:-1]])
        moved = Motion(
            time,
            jax.tree.map(shifted, root.point, now.points),
            shifted(m, now.masses),
            jnp.stack([step, now.steps[0]]),
            jnp.minimum(now.known + 1, 3),
            proposal,
        )
        thin = accept & (jnp.min(film) < drive.film_limit)
        status = jnp.where(accept & (last_one | thin), int(Status.CONVERGED), -1)
        stuck = ~accept & (proposal < SHORTEST_STEP)
        status = jnp.where(stuck, int(Status.NOT_CONVERGED), status)
        record = state.record
        put = lambda rows, row: rows.at[state.taken].set(jnp.where(accept, row, rows[state.taken]))
        record = Record(
            put(record.time, time),
            jax.tree.map(put, record.point, root.point),
            put(record.speed, speed),
            put(record.balance, mass_imbalance(equations, root.point, mesh)),
        )
        return Advanced(
            _select(accept, moved, now._replace(proposal=proposal)),
            record,
            state.taken + accept.astype(int),
            state.rejected + (~accept).astype(int),
            state.newton_steps + root.iterations,
            status,
            thin,
        )

    return jax.lax.while_loop(go_on, take, begin)
