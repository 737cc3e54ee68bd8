r"""Equations of lubricated balls with up to four contacts: one ring has two groove arcs, or both rings have.

The unknowns of each ball are the position (V, W) of its centre and those of its motion (`equations`). The position and
the displacements of the ring give the distance l from the ball centre to each groove centre. The load Q of a contact is
that at which the elastic deformation equals the overlap l - g of the undeformed surfaces plus the film thickness h,

$$(Q/K)^{2/3} = l - g + h(Q),$$

with the distance g at first contact and the contact stiffness K. Each contact has one such equation. It has exactly one
root, because the film becomes thinner with the load. It is solved for $\ln Q$ in the form
$\ln[(Q/K)^{2/3} + (g - l)_+] = \ln[h(Q) + (l - g)_+]$, in which all terms are positive and the difference of the two
sides is nearly linear in $\ln Q$. No unknown of the ball goes to infinity where a contact opens. If even at
`LEAST_LOAD` the film is thinner than the gap, the contact is open and has that load.

The two equations of the contacts are the balances of forces on the ball, with sums over all its contacts.
With traction, the motion follows from the balances of moments and forces of `friction`, again with sums over all
contacts: two contacts can roll without sliding, three would determine the orbital speed and both components of the
spin, and with four there is in general one condition too many. Without traction the motion is that with the least
sliding and spin (`linear_slip`).
"""

from typing import Any, ClassVar

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ...contacts import PointContact
from ...contacts.point_laws import PointFilm
from ...numerics.arrow import ArrowPoint
from ...numerics.roots import Root, monotone_root
from ..ring import LENGTH_UNIT
from .core import FORCE_FLOOR
from .equations import AbstractBallEquations, OfContacts
from .kinematics import BallMotion, RaceMotion
from .linear_slip import linear_slip, slip_weights
from .state import BallPlaces, BallsState

LEAST_LOAD = 1e-9
"""Load of an open contact (the film does not fill the gap), N."""
LARGEST_LOAD = 1e8
"""Largest load of a contact during the iteration, N."""
FIRST_FILM = 1e-7
"""Film thickness assumed in the first guess of the load of a contact, m."""
LOAD_TOLERANCE = 1e-9
"""Largest last Newton step of ln(load); the error that remains is of the order of its square."""


class ArchedBallSystem(AbstractBallEquations):
    """Lubricated balls with up to four contacts; see the docstring of the module.

    **Arguments:** `spread`: size of the contact ellipses as in `linear_slip`, m^2/N^(2/3).
    """

    of_contacts: ClassVar[OfContacts] = OfContacts(
        names=("axial balance of a ball", "radial balance of a ball"),
        caps=(5.0, 5.0),
        lowest=(-1e5, -1e5),
        highest=(1e5, 1e5),
    )

    spread: Float[Array, "2"] = eqx.field(kw_only=True)

    @property
    def own_unknowns(self) -> tuple[str, ...]:
        names = ("axial spin", "radial spin", "orbit" if self.cage is None else "outward")
        return (*names, "transverse") if self.resolved else names

    # -- solver contract ------------------------------------------------------------------------------------------

    def initial(self) -> ArrowPoint:
        guess = self.guess
        assert isinstance(guess, BallPlaces)
        slip = self._least_slip(guess.load, guess.angle)
        held = lambda orbit: slip._replace(orbital_speed=orbit * jnp.ones_like(slip.spin_speed))
        axial, outward = (guess.centre - self.free_centre()) / LENGTH_UNIT
        weight = self.arcs.on_inner(guess.load) + FORCE_FLOOR
        return self._started((axial, outward), guess.ring, weight, slip, held)

    # -- physics --------------------------------------------------------------------------------------------------

    def ball_scale(self) -> Array:
        """Scale of the balances of forces on a ball, N."""
        return 100.0 * self.friction_scale()

    def frictionless(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        d = len(self.freedoms)
        own = dict(zip(self.own_unknowns, unknowns[2:], strict=True))
        centre = self.free_centre() + LENGTH_UNIT * unknowns[:2]
        touch = self.touch(shared, centre)
        angle, first_outer = touch.angle, self.arcs.first_outer
        orbit = self.orbit(shared[d] if self.global_orbit else own["orbit"])
        motion = self._motion(angle[0], angle[first_outer], orbit, own)
        races = self.races_of(motion, angle)
        contact = self.geometry.contacts_on(jnp.cos(angle), self.arcs.races, self.reduced_modulus).shaped()
        load, film, missed = self._loads(contact, touch.apart, races)
        friction = self._taken(motion, load) if self.resolved else self.couple_friction(motion, load)
        push = self.push(touch, load, None if self.resolved else friction)
        outward, on_ring = self.centrifugal(orbit), push.on_ring
        pocket = self.friction_scale() * own["outward"] if "outward" in own else None
        if pocket is not None and self.cage is not None:
            outward = outward + pocket
            if self.cage.guidance == "inner_ring":
                on_ring = on_ring + self._through_land(pocket)
        return BallsState(
            load=load,
            angle=angle,
            centre=centre,
            motion=motion,
            contact=contact,
            races=races,
            friction=friction,
            film=film,
            orbit_residual=missed,
            traction=None,
            rolling=None,
            curvature=None,
            pocket_force=pocket,
            pocket=None,
            drag_force=None,
            fit=push.balance(outward) / self.ball_scale(),
            rows=() if self.slips else self._slip_rows(motion, load, angle),
            on_ring=on_ring,
            cage_moment=None,
            cage_force=None,
        )

    def _taken(self, motion: BallMotion, load: Float[Array, "contact ball"]) -> Float[Array, "contact ball"]:
        """Sum of the transverse friction that carries the gyroscopic couple, N, all assigned to the first contact,
        because only the sum is used."""
        taken = 2.0 * self.couple(motion) / self.kinematics.ball_diameter
        return jnp.zeros_like(load).at[0].set(taken)

    def balls(self, unknowns: Float[Array, "m ball"], shared: Float[Array, "g ball"]) -> BallsState:
        state = super().balls(unknowns, shared)
        if not self.resolved:
            return state
        # only now the transverse traction of each contact is known, which acts on the ball and on the inner ring
        assert state.traction is not None
        touch = self.touch(shared, state.centre)
        carried = jnp.asarray(self.arcs.senses * state.traction.transverse)
        push, bare = self.push(touch, state.load, carried), self.push(touch, state.load, None)
        more = (push.net - bare.net) / self.ball_scale()
        return state._replace(
            friction=carried, fit=state.fit + more, on_ring=state.on_ring + (push.on_ring - bare.on_ring)
        )

    def free_rolling(self, state: BallsState) -> Float[Array, " ball"]:
        return self._least_slip(state.load, state.angle).orbital_speed

    def constrained(self, state: BallsState) -> BallMotion:
        return self._least_slip(state.load, state.angle)

    def _loads(
        self, contact: PointContact, apart: Float[Array, "contact ball"], races: RaceMotion
    ) -> tuple[Float[Array, "contact ball"], PointFilm, Float[Array, ""]]:
        """Loads of the contacts, N, their films, and the largest residual of the equations of the closed contacts.

        **Arguments:** `apart`: distances of the groove centres from the ball centre, m.
        """
        closed = apart - self.arcs.of_contacts(self.grooves.offset)[:, None]
        stiffness = self.arcs.of_contacts(self.grooves.stiffness)[:, None]
        share = 1.0 if self.slips else self.film_share
        args = (self.laws, contact, stiffness, closed, races.mean_speed, races.rolling, self.oil, self.inlet, share)
        root, opened = _filled(args)
        load = jnp.exp(root.value)
        film = self.laws.film_state(contact, load, races.mean_speed, races.rolling, self.oil, self.inlet)
        return load, film, jnp.max(jnp.where(opened, 0.0, root.residual))

    def _least_slip(self, load: Float[Array, "contact ball"], angle: Float[Array, "contact ball"]) -> BallMotion:
        weight = slip_weights(load, self.arcs, FORCE_FLOOR)
        return linear_slip(self.kinematics, angle, weight, self.spread, self.arcs.races)

    def _slip_rows(
        self, motion: BallMotion, load: Float[Array, "contact ball"], angle: Float[Array, "contact ball"]
    ) -> tuple[Array, ...]:
        """Residuals of the motion of balls without traction: its scaled difference from the motion of least sliding."""
        slip, unit = self._least_slip(load, angle), self.spin_unit()
        axial, radial = ((motion.axial_spin - slip.axial_spin) / unit, (motion.radial_spin - slip.radial_spin) / unit)
        return axial, radial, (motion.orbital_speed - slip.orbital_speed) / self.orbit_unit


def _misfit(log_load: Float[Array, "contact ball"], args: Any) -> Float[Array, "contact ball"]:
    """Logarithm of the left over the right side of the load equation (see the module)."""
    laws, contact, stiffness, closed, speed, sliding, oil, inlet, share = args
    film = share * laws.film_state(contact, jnp.exp(log_load), speed, sliding, oil, inlet).separation
    compression = jnp.exp((log_load - jnp.log(stiffness)) * (2.0 / 3.0))
    return jnp.log(compression + jnp.maximum(-closed, 0.0)) - jnp.log(film + jnp.maximum(closed, 0.0))


def _filled(args: Any) -> tuple[Root, Array]:
    """Logarithms of the loads, and which contacts are open: those whose film does not fill the gap at `LEAST_LOAD`."""
    _, _, stiffness, closed, *_ = args
    low = float(np.log(LEAST_LOAD))
    opened = jax.lax.stop_gradient(_misfit(jnp.full_like(closed, low), args)) >= 0.0
    depth = jnp.maximum(closed, 0.0) + FIRST_FILM
    guess = jnp.where(opened, low, jnp.log(stiffness) + 1.5 * jnp.log(depth))

    def function(log_load: Array, both: Any) -> Array:
        args, opened = both
        return jnp.where(opened, log_load - low, _misfit(log_load, args))

    high = float(np.log(LARGEST_LOAD))
    return monotone_root(function, (args, opened), low - 1.0, high, guess, tolerance=LOAD_TOLERANCE), opened
