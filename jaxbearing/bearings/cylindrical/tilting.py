r"""Equations of a cylindrical roller bearing whose rollers may tilt, because rings are misaligned or rollers have a
profile. The contacts are dry and frictionless. Their loads are integrated in closed form along straight rollers, and
over laminae along a profile.

The unknowns of a roller are the outward displacement x of its end s = 0 and its tilt phi, which moves the end s = l
outwards. The global unknowns are the displacements of the inner ring, m, and its tilt $\tau$ times the roller length. A
positive $\tau$ moves the ring at azimuth 0 along +axial; the end s = l is on the axial side, where the ring then moves
inwards. With the profile h(s) of the roller (on both contacts), the approaches at s are

$\delta_o = x + \phi s - h$, $\delta_i = d\cdot n - J_d/2 - \tau\cos\psi(s - \ell/2) - x - \phi s - h$.

The balances of a roller are $Q_o - Q_i = F_c$, $M_o - M_i = F_c\ell/2$, those of the ring $\sum Q_in = F$,
$-\sum(M_i - Q_i\ell/2)\cos\psi = M$. They are the gradient of one convex potential, with the springs of `ring.ANCHOR`.

Flexible rings move outwards by $w_o$, $w_i$ at a roller, along its whole length: $w_o$ is subtracted from
$\delta_o$, and the roller presses the outer ring by $Q_o$; $w_i$ is added to $\delta_i$, and the roller presses the
inner ring by $-Q_i$. Races that are not round change $\delta_i$, by the same amount along the whole roller.
"""

import dataclasses
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import AbstractTiltedLine
from ...numerics.arrow import ArrowPoint, seen_by_elements
from ...numerics.batching import in_turn
from ...numerics.convex import Minimum, anchored, find_minimum
from ..elastic_ring import ElasticRing
from ..ring import ANCHOR, LENGTH_UNIT, TILTS, InnerRing
from ..row import AbstractRowSystem
from ..tapered.system import FARTHEST, LONGEST_STEP, MOST_TILT, START_TOLERANCE

SLOW = 1e-2
"""If the centrifugal force is below this fraction of a roller's share of the load, the bearing is first solved at
rest."""
HALVINGS = 60
"""Number of bisections for the approach of a roller that only its centrifugal force presses on the outer race."""


class TiltingState(NamedTuple):
    """Contacts of all rollers with the races (inner, outer): the approach is f + g s, with `approach` f, m, at the end
    s = 0 and `slope` g, rad; `load`, N, and its `moment` about s = 0, N m."""

    approach: Float[Array, "2 roller"]
    slope: Float[Array, "2 roller"]
    load: Float[Array, "2 roller"]
    moment: Float[Array, "2 roller"]


class TiltingRollers(AbstractRowSystem):
    """Equations of a bearing with tilting rollers (see the module).

    - `columns`: displacement of the inner race towards each roller, and its slope along the roller, for a unit of each
      unknown degree of freedom of the ring.
    - `held`: the same displacement, m, and slope, rad, by given displacements of the ring, by expansion and by races
      that are not round.
    """

    line: AbstractTiltedLine
    azimuth: Float[Array, " roller"]
    columns: Float[Array, "freedom 2 roller"]
    held: Float[Array, "2 roller"]
    ring: InnerRing
    radial_clearance: Float[Array, ""]
    centrifugal: Float[Array, ""]
    guess: ArrowPoint | None
    outer: ElasticRing | None = None
    inner: ElasticRing | None = None

    def load_scale(self) -> Array:
        return self.ring.scale()

    def roller_scale(self) -> Array:
        return self.load_scale() / self.azimuth.size + self.centrifugal

    def units(self) -> Float[Array, "2 1"]:
        """Factors that convert the unknowns of a roller to x, m, and phi, rad."""
        return LENGTH_UNIT * jnp.stack([jnp.ones(()), 1.0 / jnp.asarray(self.line.length)])[:, None]

    def equation_names(self) -> tuple[str, ...]:
        return ("force balance of a roller", "moment balance of a roller", *self.ring_names())

    def step_caps(self) -> ArrowPoint:
        cap = LONGEST_STEP / LENGTH_UNIT
        return ArrowPoint(jnp.full((2, 1), cap), jnp.full(self.ring_unknowns, cap))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        far = FARTHEST / LENGTH_UNIT
        tilt = MOST_TILT * jnp.asarray(self.line.length) / LENGTH_UNIT
        ring = self.ring.of_each(lambda name: tilt if name in TILTS else far)
        if self.bent:
            ring = jnp.concatenate([ring, jnp.full(self.bent.modes, far)])
        high = ArrowPoint(jnp.full((2, 1), far), ring)
        return ArrowPoint(-high.elements, -high.globals), high

    def initial(self) -> ArrowPoint:
        """First guess. The ring is displaced by the clearance plus the approaches of one roller that carries the whole
        load. The rollers are half-way between the races, or further out if the outer race then carries their
        centrifugal forces."""
        if self.guess is not None:
            return self.guess
        if self.ring.needs_held_load:
            # given displacements at their values, all unknowns of the rings at 0
            return ArrowPoint(self._between(self.held[0]), jnp.zeros(self.ring_unknowns))
        load = self.load_scale() + self.centrifugal
        depth = jnp.maximum(
            self.radial_clearance + 2.0 * (load / (self.line.stiffness * self.line.length)) ** 0.9, 1e-6
        )
        ring = depth * self.ring.across() / LENGTH_UNIT
        inward = LENGTH_UNIT * jnp.einsum("f,fn->n", ring, self.columns[:, 0])
        if self.bent:
            ring = jnp.concatenate([ring, jnp.zeros(self.bent.modes)])
        return ArrowPoint(self._between(inward), ring)

    def _between(self, inward: Float[Array, " roller"]) -> Float[Array, "2 roller"]:
        """First guess of the roller unknowns. **Arguments:** `inward`: displacement of the inner race towards each
        roller, m."""
        half = 0.5 * (inward - self.radial_clearance)
        seat = (self.centrifugal / (self.line.of_race(1).stiffness * self.line.length)) ** 0.9
        out = jnp.maximum(half, seat) / LENGTH_UNIT
        return jnp.stack([out, jnp.zeros_like(out)])

    def without_guess(self) -> "TiltingRollers":
        return dataclasses.replace(self, guess=None)

    def acting(self, unknowns, shared):
        """See `AbstractConvexArrow`. The energy of a roller is the energy of its contacts minus the work of its
        centrifugal force, J."""
        state = self.state(unknowns, shared)
        balance = self.balance(state) + anchored(unknowns, ANCHOR * LENGTH_UNIT)
        totals = jnp.einsum("fcn,cn->fn", self.columns, self.ring_force(state))
        if self.bent:
            totals = self.on_both(totals, state.load[1], state.load[0])
        out, tilt = self.units() * unknowns
        energy = jnp.sum(self.line.energy(state.approach, state.slope), axis=0)
        energy = energy - self.centrifugal * (out + 0.5 * self.line.length * tilt)
        return balance / self.roller_scale(), totals, energy

    def global_residual(self, globals_, totals):
        return self.ring_balance(globals_, totals, floats=True) / self.load_scale(), jnp.zeros(())

    def started(self) -> tuple["TiltingRollers", Minimum]:
        """These equations with the minimum of the potential as first guess, and the result of the search for it.

        For a slow bearing, the search begins at the solution for the bearing at rest, in which the unloaded rollers
        are placed on the outer race. A very small centrifugal force needs very small approaches, and the search does
        not find such positions from far away.
        """
        minimum = in_turn(_minimum, jax.lax.stop_gradient(self))
        return dataclasses.replace(self, guess=minimum.point), minimum

    def seated(self, point: ArrowPoint) -> ArrowPoint:
        """The point, with each roller that does not touch the inner race moved to where its centrifugal force is in
        balance with its load on the outer race. Profiles are symmetric about the middle: such a roller does not
        tilt."""
        line, length, zero = self.line.of_race(1), jnp.asarray(self.line.length), jnp.zeros(())
        position = jnp.linspace(0.0, 1.0, 101)
        high = (self.centrifugal / (line.stiffness * length)) ** 0.9 + jnp.max(line.drop(position))

        def halved(_: Array, ends: tuple[Array, Array]) -> tuple[Array, Array]:
            middle = 0.5 * (ends[0] + ends[1])
            heavy = line.load_and_moment(middle, zero)[0] > self.centrifugal
            return jnp.where(heavy, ends[0], middle), jnp.where(heavy, middle, ends[1])

        depth = jax.lax.fori_loop(0, HALVINGS, halved, (zero, high))[1]
        flat = jnp.stack([depth, zero])[:, None] / self.units() * jnp.ones_like(point.elements)
        alone = self.at(ArrowPoint(flat, point.globals)).load[0] == 0.0
        return ArrowPoint(jnp.where(alone, flat, point.elements), point.globals)

    def at(self, point: ArrowPoint) -> TiltingState:
        return self.state(point.elements, seen_by_elements(self, point))

    def state(self, unknowns: Float[Array, "2 roller"], shared: Float[Array, "p roller"]) -> TiltingState:
        inward, turn = self.held + LENGTH_UNIT * jnp.einsum("fn,fcn->cn", self.of_freedoms(shared), self.columns)
        out, tilt = self.units() * unknowns
        # `turn` is about the middle of the roller
        inner = inward - self.radial_clearance - 0.5 * self.line.length * turn - out
        opened = self.opened(shared)
        approach = [
            value - opened[side] if side in opened else value for side, value in (("inner", inner), ("outer", out))
        ]
        approach, slope = jnp.stack(approach), jnp.stack([turn - tilt, tilt])
        return TiltingState(approach, slope, *self.line.load_and_moment(approach, slope))

    def balance(self, state: TiltingState) -> Float[Array, "2 roller"]:
        """Residuals of the balances of each roller: force, N, and moment about s = 0, divided by the length, N."""
        force = state.load[1] - state.load[0] - self.centrifugal
        moment = (state.moment[1] - state.moment[0]) / self.line.length - 0.5 * self.centrifugal
        return jnp.stack([force, moment])

    def ring_force(self, state: TiltingState) -> Float[Array, "2 roller"]:
        """Force of the inner race on each roller, N, and its moment about the middle of the roller, N m. They are
        conjugate to the two rows of `columns`: displacement towards the roller, and slope."""
        return jnp.stack([state.load[0], state.moment[0] - 0.5 * self.line.length * state.load[0]])


def _minimum(system: TiltingRollers) -> Minimum:
    """Minimum of the potential for `TiltingRollers.started`."""
    slow = system.centrifugal < SLOW * system.load_scale() / system.azimuth.size
    resting = dataclasses.replace(system, centrifugal=jnp.where(slow, 0.0, system.centrifugal))

    def search(carry: tuple[ArrowPoint, Array], centrifugal: Array) -> tuple[tuple[ArrowPoint, Array], Minimum]:
        guess, steps = carry
        minimum = find_minimum(
            dataclasses.replace(system, guess=guess, centrifugal=centrifugal), tolerance=START_TOLERANCE
        )
        seated = system.seated(minimum.point)
        guess = ArrowPoint(*(jnp.where(slow, new, old) for new, old in zip(seated, minimum.point, strict=True)))
        return (guess, steps + minimum.steps), minimum

    first = (resting.initial(), jnp.asarray(0))
    both = jnp.stack([resting.centrifugal, system.centrifugal])
    (_, steps), minima = jax.lax.scan(search, first, both)
    return jax.tree.map(lambda leaf: leaf[-1], minima)._replace(steps=steps)
