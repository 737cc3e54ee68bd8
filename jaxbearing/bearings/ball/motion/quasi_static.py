r"""Equations of motion with quasi-static axial and radial positions of the balls and quasi-static inner ring.

Orbit, spin and cage are states with inertia, as in `rates`. The axial and the outward position of each ball and the
displacements of the ring are not: whenever rates are evaluated, they are solved for from the balances of forces

$$0 = G_x,\qquad 0 = G_r + mR\dot\psi^2 + F_0,\qquad 0 = F + \sum G_{ring}.$$

The forces G of the races, with friction, come from the same interaction speeds as in `rates`, but with the speeds of
the ball centres and of the ring set to 0 and the balls on the pitch circle. Forces of pockets and lands are left out of
these balances, so that the loads depend on the state only.

Left out are the oscillations of balls and ring in their contacts, of 3e3 to 1e5 rad/s, and the inertia of the ring.
"""

import dataclasses
from typing import ClassVar

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...._types import Scalar
from ....numerics.arrow import AbstractArrowSystem, ArrowPoint
from ....numerics.plain_newton import plain_newton
from ...motion.family import AbstractDynamics
from ...motion.history import Energy, Instant, PocketPeaks
from ..core import FORCE_FLOOR
from ..kinematics import RaceMotion
from .energy import WORKS
from .layout import PLACE, Places, Rates, tilt_levers
from .rates import BallDynamics

OWN, CAGE = 5, 12
"""Number of components of the state of a ball and of the cage that are states here: the first ones of the layout."""
LOAD_TOLERANCE = 0.3
"""Tolerance of the scaled residual of the balances before the last Newton step, which squares it, over the square root
of the integration tolerance."""
STEPS = 40
"""Largest number of Newton steps of one solve."""
FAILURE = 2.0
"""Factor on the tolerance of the residual above which the rates are NaN; the integrator then shortens its step."""
FINE = 1e-11
"""Integration tolerance assumed for the solution of the balances if none is given."""


class MeridianBalance(AbstractArrowSystem):
    """Force balances of the balls (axial and outward) and of the ring, at given orbits and spins.

    Unknowns are the displacements of each ball from the position of a free ball, and the displacements of the ring
    along its free degrees of freedom, all as lengths in units of `PLACE`."""

    dynamics: BallDynamics
    places: Places
    rates: Rates
    load: Float[Array, "5"]
    """Loads on the five degrees of freedom of the ring, N and N m."""

    @property
    def free(self) -> np.ndarray:
        return np.flatnonzero(self.dynamics.ring.free)

    @property
    def ball_scale(self) -> Array:
        """Scale of the force balances of a ball, N."""
        return self.ring_scale / self.places.azimuth.shape[0]

    @property
    def ring_scale(self) -> Array:
        """Scale of the force balances of the ring, N: the loads on it and the centrifugal forces of all balls."""
        forces = self.load / tilt_levers(self.dynamics.ring.lever)
        return jnp.sqrt(jnp.sum(jnp.square(forces))) + jnp.sum(self.outward)

    @property
    def outward(self) -> Float[Array, " ball"]:
        """Centrifugal force of each ball plus `FORCE_FLOOR`, N."""
        return self.dynamics.centrifugal(self.rates.orbit) + FORCE_FLOOR

    def equation_names(self) -> tuple[str, ...]:
        ring = tuple("load balance of the ring" for _ in self.free)
        return ("axial balance of a ball", "outward balance of a ball", *ring)

    def step_caps(self) -> ArrowPoint:
        return ArrowPoint(jnp.full((2, 1), 2.0), jnp.full(len(self.free), 2.0))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        high = ArrowPoint(jnp.full((2, 1), 1e4), jnp.full(len(self.free), 1e4))
        return jax.tree.map(jnp.negative, high), high

    def initial(self) -> ArrowPoint:
        return ArrowPoint(jnp.zeros((2, self.places.azimuth.shape[0])), jnp.zeros(len(self.free)))

    def element(self, unknowns, shared):
        """See `AbstractArrowSystem`. Each ball gets its own copy of the ring, so that the forces on the ring are
        obtained for each ball separately."""
        dynamics, count = self.dynamics, unknowns.shape[1]
        own = self.moved(unknowns, shared)
        meridian = dynamics.levers.meridian(own)
        rates = self.rates._replace(centre=jnp.zeros((2, count)), ring=jnp.zeros((5, count)))
        move = lambda rate: dynamics.levers.race_speeds(own, meridian, rate)
        (_, races), transpose = jax.vjp(move, rates)
        approach = meridian.distance - dynamics.levers.grooves.offset[:, None]
        pressed = dynamics.races.pressed(approach, meridian, races)
        on: RaceMotion = dynamics.races.friction(pressed, pressed.load, races).on(races)
        (pulled,) = transpose((-pressed.load, on))
        balance = pulled.centre + jnp.stack([jnp.zeros(count), self.outward])
        levers = tilt_levers(dynamics.ring.lever)[:, None]
        # the signs are those of spring forces: each balance grows with its own unknown
        return -balance / self.ball_scale, -(pulled.ring / levers)[self.free], jnp.zeros(())

    def global_residual(self, globals_, totals):
        load = (self.load / tilt_levers(self.dynamics.ring.lever))[self.free]
        return (totals - load) / self.ring_scale, jnp.zeros(())

    def moved(self, unknowns: Float[Array, "2 ball"], shared: Float[Array, "freedom ball"]) -> Places:
        """The positions for given unknowns, with a copy of the displacements of the ring for each ball."""
        dynamics, count = self.dynamics, unknowns.shape[1]
        offset, outward = PLACE * unknowns
        lengths = jnp.zeros((5, count)).at[self.free].set(PLACE * shared)
        ring = dynamics.ring.held[:, None] + lengths / tilt_levers(dynamics.ring.lever)[:, None]
        centre = jnp.stack([dynamics.free_offset + offset, dynamics.free_radius + outward])
        return self.places._replace(centre=centre, offset=offset, ring=ring)


class QuasiStaticBallDynamics(AbstractDynamics):
    """Equations of motion of balls on the pitch circle and of the cage; see the module.

    **Arguments:**
    - `reference_speed`: speed of the frame in which positions are counted, at the operating point, rad/s.
    - `full`: the full equations, with `on_pitch_circle`, without contact damping and without a mass of the ring.
    - `guess`: first guess of the unknowns of the balances if no better one is given.
    """

    works: ClassVar[tuple[str, ...]] = WORKS

    reference_speed: Float[Array, ""]
    full: BallDynamics
    guess: ArrowPoint

    # -- state ----------------------------------------------------------------------------------------------------

    def of_whole(self, state: ArrowPoint) -> ArrowPoint:
        """The components of a state of the full equations that are states here."""
        balls, shared = state.elements[:OWN], state.globals
        return ArrowPoint(balls, jnp.concatenate([shared[:CAGE], shared[-len(WORKS) :]]))

    def whole(self, state: ArrowPoint, solved: ArrowPoint) -> ArrowPoint:
        """The state of the full equations: the state here, the positions `solved` for, and speeds of 0 for them."""
        places, count = solved.elements, state.elements.shape[1]
        ring = jnp.zeros(5).at[np.flatnonzero(self.full.ring.free)].set(solved.globals)
        balls = jnp.concatenate([state.elements, places, jnp.zeros((2, count))])
        shared = [state.globals[:CAGE], ring, jnp.zeros(5), state.globals[CAGE:]]
        return ArrowPoint(balls, jnp.concatenate(shared))

    def balance(self, time: Scalar, state: ArrowPoint) -> MeridianBalance:
        places, rates = self.full.moving(time, self.whole(state, self.guess))
        return MeridianBalance(self.full, places, rates, self.full.ring_load(time))

    def solved(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint | None = None, tolerance: Scalar = FINE
    ) -> tuple[ArrowPoint, Float[Array, ""]]:
        """Solution of the balances (positions of balls and ring), and its scaled residual over the tolerance."""
        limit = LOAD_TOLERANCE * jnp.sqrt(tolerance)
        root = plain_newton(
            self.balance(time, state), self.guess if guess is None else guess, tolerance=limit, max_steps=STEPS
        )
        return root.point, root.residual / limit

    # -- rates ----------------------------------------------------------------------------------------------------

    def rates(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """Derivatives of the state by time, 1/s; NaN if no solution of the balances is found."""
        return self.nested_rates(time, state, self.guess, FINE)[0]

    def nested_rates(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint, tolerance: Scalar
    ) -> tuple[ArrowPoint, ArrowPoint]:
        solved, excess = self.solved(time, state, guess, tolerance)
        rates = self.of_whole(self.full.rates(time, self.whole(state, solved)))
        return jax.tree.map(lambda rate: jnp.where(excess < FAILURE, rate, jnp.nan), rates), solved

    def first_guess(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        return self.guess

    # -- results --------------------------------------------------------------------------------------------------

    def observe(self, time: Scalar, state: ArrowPoint) -> Instant:
        return self.full.observe(time, self.whole(state, self.solved(time, state)[0]))

    def peaks(self, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks | None:
        whole = jax.vmap(lambda time, state: self.whole(state, self.solved(time, state)[0]))
        return self.full.peaks(times, whole(times.reshape(-1), states))

    def energy(self, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
        return self.full.energy(self.whole(state, self.guess), first, last)


def quasi_static_dynamics(full: BallDynamics, state: ArrowPoint) -> tuple[QuasiStaticBallDynamics, ArrowPoint]:
    """The quasi-static equations and their state, from the full equations and their state.

    **Arguments:** `full`: the full equations; `state`: their state, whose positions of balls and ring are the first
    guess for the balances.
    """
    ring = dataclasses.replace(full.ring, body=None)
    parts = dataclasses.replace(full, ring=ring, contact_damping=jnp.zeros(()), on_pitch_circle=True)
    free = np.flatnonzero(full.ring.free)
    guess = ArrowPoint(state.elements[5:7], state.globals[CAGE : CAGE + 5][free])
    dynamics = QuasiStaticBallDynamics(full.reference_speed, parts, guess)
    return dynamics, dynamics.of_whole(state)
