r"""Ball-to-ball contacts of neighbouring balls without a cage.

The centres $p_j$ in space have the distance $d_j = |p_{j+1} - p_j|$ in the direction $n_j$. The interaction speeds of
each pair are the rate of the distance, $n_j\cdot(\dot p_{j+1} - \dot p_j)$, and the sliding speed at the point where
the balls are closest, which is the part of $\dot p_j - \dot p_{j+1}$ perpendicular to $n_j$ plus
$\tfrac12d_j(\Omega_j + \Omega_{j+1})\times n_j$. They are linear in the generalised speeds, and 0 for two balls that
move together as a rigid body; the forces of the contact therefore have no resultant moment on the pair.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ....gaps.meeting_balls import MeetingBalls, MetBalls
from ....numerics.series import cosine_and_sine
from .layout import Places, Rates

STILL = 1e-9
"""Floor of the magnitude of the entrainment speed, m/s, added as a square: at 0 its direction is undefined."""


class NeighbourSpeeds(NamedTuple):
    """Relative motion of each ball and the next one: rate of the distance of their centres, m/s, and sliding velocity,
    m/s, with components along the axis and along azimuths 0 and 90 degrees."""

    apart: Float[Array, " ball"]
    sliding: Float[Array, "3 ball"]


class NeighbourPlace(NamedTuple):
    """Distance between the centres of each ball and the next one, m, and its direction (unit vector in space)."""

    distance: Float[Array, " ball"]
    normal: Float[Array, "3 ball"]


class Neighbours(eqx.Module):
    """The ball-to-ball contacts.

    **Arguments:** `law`: law of the film between two balls; `viscosity`: viscosity of the oil in this film, Pa s.
    """

    law: MeetingBalls
    viscosity: Float[Array, ""]

    def contacts(self, place: NeighbourPlace, places: Places, rates: Rates) -> MetBalls:
        """Load, film and friction of the contact between each ball and the next one."""
        _, turning = _in_space(places, rates)
        entraining = 0.5 * place.distance[None] * jnp.cross(turning - _next(turning), place.normal, axis=0)
        gap = place.distance - 2.0 * self.law.ball_radius
        apart = neighbour_speeds(places, place, rates).apart
        speed = jnp.sqrt(jnp.sum(jnp.square(entraining), axis=0) + STILL**2)
        return self.law.contact(gap, apart, speed, self.viscosity)


def neighbour_place(places: Places) -> NeighbourPlace:
    cosine, sine = cosine_and_sine(places.azimuth)
    centre = jnp.stack([places.centre[0], places.radius * cosine, places.radius * sine])
    ahead = _next(centre) - centre
    distance = jnp.sqrt(jnp.sum(jnp.square(ahead), axis=0))
    return NeighbourPlace(distance, ahead / distance[None])


def neighbour_speeds(places: Places, place: NeighbourPlace, rates: Rates) -> NeighbourSpeeds:
    """Interaction speeds of all pairs of balls (see the module), linear in `rates`."""
    moving, turning = _in_space(places, rates)
    parting = _next(moving) - moving
    apart = jnp.sum(parting * place.normal, axis=0)
    around = jnp.cross(turning + _next(turning), place.normal, axis=0)
    return NeighbourSpeeds(apart, apart[None] * place.normal - parting + 0.5 * place.distance[None] * around)


def _in_space(places: Places, rates: Rates) -> tuple[Float[Array, "3 ball"], Float[Array, "3 ball"]]:
    """Velocity of the centre, m/s, and angular velocity, rad/s, of each ball, as vectors in space."""
    cosine, sine = cosine_and_sine(places.azimuth)
    (w_x, w_r, w_t), (x, r) = rates.spin, rates.centre
    along = places.radius * rates.orbit
    space = lambda axial, outward, around: jnp.stack(
        [axial, outward * cosine - around * sine, outward * sine + around * cosine]
    )
    return space(x, r, along), space(rates.orbit - w_x, w_r, w_t)


def _next(values: Array) -> Array:
    """Values of the next ball around the circle, for every ball."""
    return jnp.roll(values, -1, axis=-1)
