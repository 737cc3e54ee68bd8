r"""Equations of the steady lubricated ball bearing, as a block-arrow system.

Unknowns of each ball:

- two unknowns of its contacts, which fix its position. For balls with two contacts (module `pairs`) they are ln Qi,
  with the load Qi at the inner race, and the inner contact angle. For balls with more contacts (`arched`) they are
  the position of the ball centre;
- with traction the spin and, with `attitude="min_power"`, the attitude beta, which is the angle of the spin axis to
  the bearing axis. With `"equilibrium"` they are the axial and the radial part of the spin instead, because polar
  coordinates are singular where the spin of a skidding ball passes through 0;
- if traction carries the gyroscopic couple and its balance is solved ("resolved"): the spin about the tangent of the
  orbit (`transverse`) and the transverse friction at the inner race (`carried`);
- without a cage the orbital speed, with one the radial friction of the pocket.

Global unknowns: the displacements of the ring; with a cage, the speed of the cage, which is the orbital speed of all
balls; without traction, on request, one orbital speed for all balls.

The modules `pairs` and `arched` contain the contacts without traction and the two equations that belong to the two
contact unknowns. The module `friction` contains the friction on the balls and the equations of their motion.

The cage has no mass and transmits the pocket forces to its lands. If the inner ring guides the cage, these forces enter
the balance of that ring, $F_r = \sum p_r\cos\psi + W_{FCi}\cos\chi$, $W_{FCi}\cos\chi = \sum(F_{C2} - F_{C1})\cos\psi$
(source eqs. (18)-(19), (22)). Here $F_r$ is the radial load on the ring, $p_r$ the radial force of the ring on a ball,
$\psi$ the azimuth of the ball, and $W_{FCi}$ the force of the ring on the cage, in the direction $\chi$. $F_{C1}$ and
$F_{C2}$ are the radial friction forces of a ball at the front and at the rear of its pocket. The radial friction of
each pocket is therefore added to the radial force of its ball on the ring; it has no moment. The tangential forces are
those of the pockets, which act through the lands, and $F_{ti}$ of the balls. They cancel along the load line if the
balls on both sides of it run alike. The balances and the stiffness of the ring leave out the tangential forces.
"""

import dataclasses
from collections.abc import Callable
from typing import ClassVar, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.arrow import ArrowPoint, seen_by_elements
from ..land import LandState, guided_land
from ..ring import LENGTH_UNIT
from .core import orbit_row, orbit_totals
from .friction import with_traction
from .kinematics import BallMotion
from .lubricated import AbstractLubricatedBallSystem
from .state import BallsState

EASIEST_SLIDE = 1e-3
"""Factor on the sliding speed in the traction law at the start of a homotopy (the easiest system)."""
THINNEST_FILM = 1e-3
"""Factor on the film thicknesses at the start of the homotopy of the films."""
WIDEST_START = 0.3
"""Width, m/s, of the range of sliding speeds in which boundary friction develops, at the start of its homotopy."""


OWN_EQUATIONS = {
    "spin": "moment about the bearing axis on a ball",
    "axial spin": "moment about the bearing axis on a ball",
    "radial spin": "moment about the radius on a ball",
    "attitude": "least spin power of a ball",
    "orbit": "tangential force on a ball",
    "outward": "radial pocket friction on a ball",
    "transverse": "moment about the tangent on a ball",
    "carried": "transverse friction at the inner race of a ball",
}
"""Names of the equations that belong to the unknowns of a ball's motion."""


class OfContacts(NamedTuple):
    """The two unknowns of the contacts of a ball. `names`: names of their equations; `caps`: largest change of each in
    one Newton step; `lowest`, `highest`: bounds. All numbers are in scaled units."""

    names: tuple[str, str]
    caps: tuple[float, float]
    lowest: tuple[float, float]
    highest: tuple[float, float]


class AbstractBallEquations(AbstractLubricatedBallSystem):
    """Equations of a lubricated ball bearing, see the docstring of the module. Subclasses supply the two unknowns of
    the contacts (`of_contacts`), the contacts without traction (`frictionless`) and the initial guess."""

    of_contacts: ClassVar[OfContacts]

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        own = tuple(OWN_EQUATIONS[name] for name in self.own_unknowns)
        orbit = "common orbital speed" if self.cage is None else "moment balance of the cage"
        last = (orbit,) if self.global_orbit else ()
        return (*self.of_contacts.names, *own, *self.ring_names(), *last)

    def step_caps(self) -> ArrowPoint:
        caps = dict.fromkeys(("spin", "axial spin", "radial spin", "orbit"), 0.15)
        caps |= {"attitude": 0.3, "outward": 1.0, "transverse": 0.02, "carried": 1.0}
        elements = [*self.of_contacts.caps, *(caps[name] for name in self.own_unknowns)]
        ring = [5.0] * self.ring_unknowns + [0.15] * self.global_orbit
        return ArrowPoint(jnp.asarray(elements)[:, None], jnp.asarray(ring))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        own = len(self.own_unknowns)
        lowest, highest = [*self.of_contacts.lowest] + [-50.0] * own, [*self.of_contacts.highest] + [50.0] * own
        ring = jnp.asarray([1e5] * self.ring_unknowns + [3.0] * self.global_orbit)
        return ArrowPoint(jnp.asarray(lowest)[:, None], -ring), ArrowPoint(jnp.asarray(highest)[:, None], ring)

    def _started(
        self,
        contacts: tuple[Array, Array],
        ring: Float[Array, " coordinate"],
        load: Float[Array, " ball"],
        rolling: BallMotion,
        held: Callable[[Array], BallMotion],
    ) -> ArrowPoint:
        """Initial guess of all unknowns.

        **Arguments:** `contacts`: initial guess of the two contact unknowns; `ring`: displacements of the rings, m;
        `load`: load of each ball, N; `rolling`: motion of the balls if each has its own orbital speed; `held`: function
        that returns the motion of the balls if all have the given orbital speed, rad/s.
        """
        reference, zeros = self.reference, jnp.zeros_like(load)
        orbit = common = (rolling.orbital_speed - reference.orbital_speed) / self.orbit_unit
        if self.global_orbit:
            common = jnp.sum(load * orbit) / jnp.sum(load)
            rolling = held(self.orbit(common))
        start = {
            "spin": (rolling.spin_speed - reference.spin_speed) / self.spin_unit(),
            "attitude": rolling.attitude,
            "orbit": orbit,
            "outward": zeros,
            "transverse": zeros,
            "carried": zeros,
        }
        parts = zip(self._spin_parts(rolling), self._spin_parts(reference), strict=True)
        start |= {name: (value - ref) / self.spin_unit() for (name, value), (_, ref) in parts}
        elements = jnp.stack([*contacts, *(start[name] for name in self.own_unknowns)])
        scaled = ring / LENGTH_UNIT
        return ArrowPoint(elements, jnp.append(scaled, common) if self.global_orbit else scaled)

    @property
    def increasing(self) -> bool:
        """The equations need not grow with their own unknown at a root: a pivot can be negative if a ball has almost
        lost contact with the inner race."""
        return False

    @property
    def rounding(self) -> float:
        """Factor of the tolerance. In slow, heavily loaded contacts the round-off of a speed changes the friction by up
        to 1e-8 of the friction scale, which is 1 % of the load of a ball."""
        return 100.0

    @property
    def homotopies(self) -> int:
        return (2 if self.resolved or self.heavier is not None else 1) + self.rough

    @property
    def rough(self) -> bool:
        """True if asperities rub, so that friction starts within a narrow range of sliding speeds."""
        return self.slips and self.laws.mixed is not None

    def homotopy(self, parameter, path):
        """With traction, the easier systems have less sliding in the traction law, so the traction saturates less. If
        traction has to carry the gyroscopic couple, the first path lowers that couple and the second the sliding.
        For rough balls an additional first path widens the range of sliding speeds in which boundary friction develops.
        The narrower this range is, the closer to rolling a ball must stay on the way to its root.
        Without traction, the first path raises the load until the contacts are stiffer than the films, and the second
        thins the films. The films of lightly loaded balls are much thicker than the deflection of their contacts."""
        if self.heavier is not None:
            of_load, of_films = jnp.where(path == 0, parameter, 0.0), jnp.where(path == 0, 0.0, parameter)
            guess = jax.tree.map(lambda a, b: jnp.where(of_load > 0, a, b), self.heavy_guess, self.guess)
            ring, outer = self.rings_under(self.heavier**of_load)
            return dataclasses.replace(self, ring=ring, outer=outer, film_share=THINNEST_FILM**of_films, guess=guess)
        if not self.rough:
            return self._slower(parameter, path)
        first = path == 0
        return self._wider(jnp.where(first, parameter, 0.0))._slower(jnp.where(first, 0.0, parameter), path - 1)

    def _wider(self, parameter):
        """Boundary friction that starts within a wider range of sliding speeds."""
        mixed = self.laws.mixed
        assert mixed is not None
        width = mixed.slide_width * jnp.maximum(WIDEST_START / mixed.slide_width, 1.0) ** parameter
        return eqx.tree_at(lambda system: system.laws.mixed.slide_width, self, width)

    def _slower(self, parameter, path):
        """The system with less sliding in the traction laws, or with a smaller gyroscopic couple."""
        slide = EASIEST_SLIDE**parameter
        if not self.resolved:
            return dataclasses.replace(self, slide_share=slide)
        couple = self.couple_share * jnp.where(path == 0, 1.0 - parameter, 1.0)
        return dataclasses.replace(self, couple_share=couple, slide_share=jnp.where(path == 0, 1.0, slide))

    @property
    def extra_totals(self) -> int:
        # With a common orbit, one global needs two totals: the weighted sum of the speeds and the sum of the weights.
        # With a cage, one global needs three totals: the moment on the cage and two components of its force.
        return 1 if self.common_orbit else 0 if self.cage is None else 2

    def element(self, unknowns, shared):
        state = self.balls(unknowns, shared)
        totals = [state.on_ring]
        if state.cage_moment is not None and state.cage_force is not None:
            totals += [self.multiplicity * state.cage_moment[None, :], state.cage_force]
        if self.common_orbit:
            own = self.free_rolling(state)
            totals.append(self.multiplicity * orbit_totals(state.load[0], own, state.motion.orbital_speed))
        local = jnp.concatenate([state.fit, *(row[None, :] for row in state.rows)])
        return local, jnp.concatenate(totals), jnp.maximum(jnp.max(state.film.residual), state.orbit_residual)

    def global_residual(self, globals_, totals):
        d = self.ring_unknowns
        ring = self.ring_balance(globals_, totals, self.ring.needs_held_load) / self.load_scale()
        if self.common_orbit:
            return jnp.append(ring, orbit_row(totals[d:], self.orbit_unit)), jnp.zeros(())
        if self.cage is None:
            return ring, jnp.zeros(())
        land = self.land(self.orbit(globals_[d]), totals[d + 1], totals[d + 2])
        scale = self.friction_scale() * 0.5 * self.kinematics.pitch_diameter * self.ball_count
        # the moment decreases with the cage speed: with its sign changed, the diagonal of the Jacobian is positive
        return jnp.concatenate([ring, -(totals[d] + land.cage_torque)[None] / scale]), land.residual

    # -- physics --------------------------------------------------------------------------------------------------

    def at(self, point: ArrowPoint) -> BallsState:
        return self.balls(point.elements, seen_by_elements(self, point))

    def land(self, orbit: Array, force_x: Array, force_y: Array) -> LandState:
        """State of the cage lands (cylinders of a ring that guide the cage), which carry the sum of the pocket forces.

        **Arguments:** `orbit`: speed of the cage, rad/s; `force_x`, `force_y`: sums of the pocket forces along and
        across the load line, N."""
        cage, motion = self.cage, self.kinematics
        assert cage is not None
        return guided_land(
            cage.land,
            cage.guidance,
            motion.inner_speed,
            motion.outer_speed,
            orbit,
            force_x,
            force_y,
            self.oil_of("cage_pilot"),
        )

    def land_at(self, point: ArrowPoint, state: BallsState) -> LandState:
        assert state.cage_force is not None
        force = jnp.sum(state.cage_force, axis=1)
        return self.land(self.orbit(point.globals[-1]), force[0], force[1])

    def balls(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        state = self.frictionless(unknowns, shared)
        return with_traction(self, state) if self.slips else state
