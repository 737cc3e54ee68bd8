"""Loads and friction of the raceway contacts of moving balls, by the laws of the scene."""

import abc
from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ....contacts import PointContact
from ....contacts.distributed import Traction
from ....contacts.point_laws import PointFilm
from ....numerics.roots import monotone_root
from ....numerics.safe import safe_norm
from ..arcs import RACE_SENSES
from ..friction import race_friction
from ..kinematics import RaceMotion
from ..pairs import LubricatedBallSystem
from ..state import RaceState
from .speeds import Meridian

LOAD_FLOOR = 1e-3
"""Load, N, of a contact in the friction laws if damping has reduced its force to 0; added to all loads in squares."""
LOG_LOADS = (-60.0, 20.0)
"""Bracket of ln(load/N) of a lubricated contact."""
LOAD_STEP = 1e-9
"""Largest last Newton step of ln(load); the remaining error is about its square."""
THIN = 1e-8
"""Smallest compression, m, that the initial guess of a load assumes."""


class Pressed(NamedTuple):
    """Elastic loads of both contacts, N, the contacts, and their films. `film`: `None` if the contacts are dry."""

    load: Float[Array, "2 ball"]
    contact: PointContact
    film: PointFilm | None


class RaceFriction(NamedTuple):
    """Friction forces, N, and moments, N m, of the races on the balls. Each is conjugate to the speed of the same name
    in `RaceMotion`.

    `resistance`: part of the moment `roll` that is rolling resistance; `shear`: result of the traction law. `None`: not
    modelled.
    """

    rolling: Float[Array, "2 ball"]
    transverse: Float[Array, "2 ball"]
    spin: Float[Array, "2 ball"]
    roll: Float[Array, "2 ball"] | None = None
    resistance: Float[Array, "2 ball"] | None = None
    shear: Traction | None = None

    def on(self, races: RaceMotion) -> RaceMotion:
        """The forces and moments as a `RaceMotion`: each stands in the field of its conjugate speed."""
        zero = jnp.zeros_like(races.roll)
        roll = zero if self.roll is None else self.roll
        return RaceMotion(zero, zero, self.rolling, self.transverse, self.spin, roll)


class AbstractRaceLaw(eqx.Module):
    """Loads of the raceway contacts, from the positions of ball and groove centres, and friction of these contacts."""

    @abc.abstractmethod
    def pressed(self, approach: Float[Array, "2 ball"], meridian: Meridian, races: RaceMotion) -> Pressed:
        """Elastic loads and films of the contacts.

        **Arguments:** `approach`: distance of the centres of ball and groove minus this distance at first contact
        without a film, m.
        """

    @abc.abstractmethod
    def friction(self, pressed: Pressed, load: Float[Array, "2 ball"], races: RaceMotion) -> RaceFriction:
        """Friction of the races on the balls. **Arguments:** `load`: loads with contact damping, N, >= 0."""


class LubricatedRaces(AbstractRaceLaw):
    r"""Raceway contacts with the film, traction and friction laws of a scene.

    A film of thickness h adds to the compression: the load Q solves $(Q/K)^{2/3} - h(Q) = l - g$, with the contact
    stiffness K and the approach $l - g$. This equation has a root for an open contact too: the film fills the gap, and
    the load is negligible. Loads are therefore positive and smooth.

    **Arguments:** `system`: equations of the steady bearing; its contact laws, oil and geometry are used.
    """

    system: LubricatedBallSystem

    def pressed(self, approach: Float[Array, "2 ball"], meridian: Meridian, races: RaceMotion) -> Pressed:
        system = self.system
        inner, outer = meridian.cosine
        contact = system.geometry.contacts(inner, outer, system.reduced_modulus).shaped()
        log_stiffness = jnp.log(system.grooves.stiffness)[:, None]
        args = (system, contact, races, log_stiffness, approach)
        guess = 1.5 * jnp.log(jnp.maximum(approach, THIN)) + log_stiffness
        root = monotone_root(_compression, args, *LOG_LOADS, guess, tolerance=LOAD_STEP)
        load = jnp.exp(root.value)
        return Pressed(load, contact, _film(system, contact, load, races))

    def friction(self, pressed: Pressed, load: Float[Array, "2 ball"], races: RaceMotion) -> RaceFriction:
        assert pressed.film is not None
        held = safe_norm(load, LOAD_FLOOR)
        friction = race_friction(self.system, RaceState(held, pressed.contact, races, pressed.film))
        shear, rolling, curvature = friction
        moments = [jnp.asarray(-RACE_SENSES * moment) for moment in (rolling, curvature) if moment is not None]
        return RaceFriction(
            rolling=jnp.asarray(-RACE_SENSES * shear.rolling),
            transverse=jnp.asarray(-RACE_SENSES * shear.transverse),
            spin=-shear.moment,
            roll=sum(moments[1:], moments[0]) if moments else None,
            resistance=None if rolling is None else moments[0],
            shear=shear,
        )


def _film(system: LubricatedBallSystem, contact: PointContact, load: Array, races: RaceMotion) -> PointFilm:
    return system.laws.film_state(contact, load, races.mean_speed, races.rolling, system.oil, system.inlet)


def _compression(log_load: Array, args: tuple[LubricatedBallSystem, PointContact, RaceMotion, Array, Array]) -> Array:
    """Compression minus film thickness minus approach, m; it increases with ln(load) and is 0 at the root."""
    system, contact, races, log_stiffness, approach = args
    film = _film(system, contact, jnp.exp(log_load), races).separation
    return jnp.exp((log_load - log_stiffness) * (2.0 / 3.0)) - film - approach
