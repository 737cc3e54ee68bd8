"""Parts of the equations of lubricated balls, their first guesses, and the state of the balls."""

from typing import Literal, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from ...contacts import PointContact
from ...contacts.distributed import Traction
from ...contacts.point_laws import PointFilm
from ...gaps import ReynoldsDrag, RollerDrag, ShortJournal
from ...gaps.ball_pocket import BallPocket, BallPocketFilm
from .kinematics import BallMotion, RaceMotion


class BallCageParts(eqx.Module):
    """Parts of the cage in the equations: film law of the pockets, film law of the lands, and the guiding ring."""

    pocket: BallPocket
    land: ShortJournal
    guidance: Literal["inner_ring", "outer_ring"] = eqx.field(static=True)


class BallDrag(eqx.Module):
    """Drag on the orbiting balls: the law, and the density of the oil-air mixture, kg/m^3."""

    law: ReynoldsDrag | RollerDrag
    density: Float[Array, ""]

    def force(self, speed: Array, viscosity: Array) -> Array:
        """Drag force, N, with the sign of the orbital speed; it acts on the ball against this speed.

        **Arguments:** `speed`: orbital speed, m/s; `viscosity`: viscosity of the oil, Pa s."""
        if isinstance(self.law, RollerDrag):
            return self.law.force(speed, self.density)
        return self.law.force(speed, self.density, viscosity)


class BallGuess(NamedTuple):
    """First guess for balls with two contacts, from the bearing without friction: logarithm of the inner load (in N),
    contact angle at the inner race, rad, attitude, rad, and the rings."""

    log_load: Float[Array, " ball"]
    angle: Float[Array, " ball"]
    attitude: Float[Array, " ball"]
    ring: Float[Array, " coordinate"]
    """Displacements of the inner ring, m, then the amplitudes of flexible rings."""


class BallPlaces(NamedTuple):
    """First guess for balls with more than two contacts, from the bearing without friction: ball centres and
    displacements of the rings (as in `BallGuess`), m, contact loads, N, and contact angles, rad."""

    centre: Float[Array, "2 ball"]
    ring: Float[Array, " coordinate"]
    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]


class BallsState(NamedTuple):
    """State of all balls for given unknowns. The last axis of arrays is over the balls; an axis over the contacts
    (`arcs`) comes first. Fields that are not modelled, or not known yet, are `None`."""

    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    """Contact angles, rad; that at the inner race is relative to the tilted ring."""
    centre: Float[Array, "2 ball"]
    """Centre of the ball, from the outer groove centre, m."""
    motion: BallMotion
    contact: PointContact
    """The contacts at these angles, with the shapes of their ellipses."""
    races: RaceMotion
    friction: Float[Array, "contact ball"] | None
    film: PointFilm
    orbit_residual: Float[Array, ""]
    """Largest residual of the nested solves: for balls with two contacts that roll without sliding, the error of the
    centrifugal force over its sum with the inner load, else 0; for balls with more contacts, that of the loads."""
    traction: Traction | None
    rolling: Float[Array, "contact ball"] | None
    """Moment against the roll by the pressure in the film, N m."""
    curvature: Float[Array, "contact ball"] | None
    """Moment against the roll by Heathcote slip, N m."""
    pocket_force: Float[Array, " ball"] | None
    """Outward friction force of the pocket on the ball, as used in the force balance of the ball, N."""
    pocket: BallPocketFilm | None
    drag_force: Float[Array, " ball"] | None
    fit: Float[Array, "2 ball"]
    """Scaled residuals of the two equations of the contacts."""
    rows: tuple[Array, ...]
    """Scaled residuals of the equations of motion of the ball, in the order of its unknowns."""
    on_ring: Float[Array, "row ball"]
    """Contributions of each ball to the forces on the degrees of freedom of the inner ring, N; then the radial forces
    on flexible rings, N."""
    cage_moment: Float[Array, " ball"] | None
    cage_force: Float[Array, "2 ball"] | None


class RaceState(NamedTuple):
    """Part of the state on which the friction of the raceways depends; the fields are those of `BallsState`."""

    load: Float[Array, "2 ball"]
    contact: PointContact
    races: RaceMotion
    film: PointFilm
