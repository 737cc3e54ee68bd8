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
"""Load with which a contact that damping opens enters the friction laws, N, added in squares."""
LOG_LOADS = (-60.0, 20.0)
"""Bracket of ln(load/N) of a lubricated contact."""
LOAD_STEP = 1e-9
"""Last Newton step of ln(load), whose square is left as its error."""
THIN = 1e-8
"""Compression from which the search for a load begins at least, m."""


class Pressed(NamedTuple):
    """Elastic loads of both contacts, N, and the films in them; `None`: dry."""

    load: Float[Array, "2 ball"]
    contact: PointContact
    film: PointFilm | None


class RaceFriction(NamedTuple):
    """Forces of the races on the balls, conjugate to `rolling`, `transverse`, `spin` and `roll` of `RaceMotion`, N and
    N m; `resistance`: part of `roll` that is rolling resistance; `shear`: what the traction law found. `None`: not
    modelled."""

    rolling: Float[Array, "2 ball"]
    transverse: Float[Array, "2 ball"]
    spin: Float[Array, "2 ball"]
    roll: Float[Array, "2 ball"] | None = None
    resistance: Float[Array, "2 ball"] | None = None
    shear: Traction | None = None

    def on(self, races: RaceMotion) -> RaceMotion:
        """The forces in the places of the speeds that they are conjugate to."""
        zero = jnp.zeros_like(races.roll)
        roll = zero if self.roll is None else self.roll
        return RaceMotion(zero, zero, self.rolling, self.transverse, self.spin, roll)


class AbstractRaceLaw(eqx.Module):
    """Loads of the raceway contacts from the places of their centres, and their friction."""

    @abc.abstractmethod
    def pressed(self, approach: Float[Array, "2 ball"], meridian: Meridian, races: RaceMotion) -> Pressed:
        """**Arguments:** `approach`: distance of the centres of ball and groove less that at first contact without a
        film, m."""

    @abc.abstractmethod
    def friction(self, pressed: Pressed, load: Float[Array, "2 ball"], races: RaceMotion) -> RaceFriction:
        """**Arguments:** `load`: with contact damping, N, >= 0."""


class LubricatedRaces(AbstractRaceLaw):
    r"""The contact laws of a scene. A film of thickness h adds to the compression: the load solves
    $(Q/K)^{2/3} - h(Q) = l - g$. It has a root for open contacts too, where it is negligible and h fills the gap, so
    that loads are positive and smooth.

    **Arguments:** `system`: the equations of the steady bearing, whose laws, oil and geometry these are.
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
        found = race_friction(self.system, RaceState(held, pressed.contact, races, pressed.film))
        shear, rolling, curvature = found
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
    """Compression less film and approach, m: increasing in ln(load)."""
    system, contact, races, log_stiffness, approach = args
    film = _film(system, contact, jnp.exp(log_load), races).separation
    return jnp.exp((log_load - log_stiffness) * (2.0 / 3.0)) - film - approach
