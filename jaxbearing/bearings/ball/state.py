"""Parts of the equations of lubricated balls, and what they find at every ball."""

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
    """Terms of the cage in the equations; all are prepared, with the oil at its inlet temperature."""

    pocket: BallPocket
    land: ShortJournal
    guidance: Literal["inner_ring", "outer_ring"] = eqx.field(static=True)


class BallDrag(eqx.Module):
    """Drag on the orbiting balls: a law with its own coefficient, and the density of the oil-air mixture."""

    law: ReynoldsDrag | RollerDrag
    density: Float[Array, ""]

    def force(self, speed: Array, viscosity: Array) -> Array:
        """N, of the sign of the orbital speed, m/s; it acts against it."""
        if isinstance(self.law, RollerDrag):
            return self.law.force(speed, self.density)
        return self.law.force(speed, self.density, viscosity)


class BallGuess(NamedTuple):
    """Start of the iteration: from the bearing without friction."""

    log_load: Float[Array, " ball"]
    angle: Float[Array, " ball"]
    attitude: Float[Array, " ball"]
    ring: Float[Array, " coordinate"]
    """Displacements of the inner ring, m, then the amplitudes of flexible rings."""


class BallPlaces(NamedTuple):
    """Start of the iteration of balls with more than two contacts: centres and displacements of the rings (as in
    `BallGuess`), m, and loads and contact angles, N and rad, of the bearing without friction."""

    centre: Float[Array, "2 ball"]
    ring: Float[Array, " coordinate"]
    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]


class BallsState(NamedTuple):
    """Everything that happens at every ball, for given unknowns; arrays over balls, contacts first (`arcs`)."""

    load: Float[Array, "contact ball"]
    angle: Float[Array, "contact ball"]
    """Contact angles on the races: of the inner one against the tilted ring."""
    centre: Float[Array, "2 ball"]
    """Centre of the ball, from the outer groove centre, m."""
    motion: BallMotion
    contact: PointContact
    """The contacts at these angles, with the shapes of their ellipses."""
    races: RaceMotion
    friction: Float[Array, "contact ball"] | None
    film: PointFilm
    orbit_residual: Float[Array, ""]
    """Gives how far centrifugal forces of balls that roll without sliding are off, over their loads; 0 for others."""
    traction: Traction | None
    rolling: Float[Array, "contact ball"] | None
    """Moment of the film's pressure against the roll, N m."""
    curvature: Float[Array, "contact ball"] | None
    """Moment of Heathcote slip against the roll, N m."""
    pocket_force: Float[Array, " ball"] | None
    """Outward force of the pocket's friction on the ball in the balance of forces, N."""
    pocket: BallPocketFilm | None
    drag_force: Float[Array, " ball"] | None
    fit: Float[Array, "2 ball"]
    """Residuals of the two equations of the contacts."""
    rows: tuple[Array, ...]
    """Residuals of the ball's motion, in the order of its unknowns."""
    on_ring: Float[Array, "row ball"]
    """Contributions of each ball to the forces on the inner ring's degrees of freedom, N; then the radial forces on
    rings that bend."""
    cage_moment: Float[Array, " ball"] | None
    cage_force: Float[Array, "2 ball"] | None


class RaceState(NamedTuple):
    """State on which the friction of the raceways depends; the fields are those of `BallsState`."""

    load: Float[Array, "2 ball"]
    contact: PointContact
    races: RaceMotion
    film: PointFilm
