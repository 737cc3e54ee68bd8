r"""Distribution of the sliding loss over the cross-section of a groove.

The traction law divides a contact into strips along rolling and gives the power of each. In a groove of radius r, a
strip at the distance y from the middle of the contact lies at the angle $\alpha + s\,y/r$, with the contact angle
$\alpha$ and s = 1 on the inner race, -1 on the outer race, where the traction law's axis across rolling points towards
smaller angles. The power of a strip is spread evenly over its width, so that the total over all angles is conserved.
"""

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ....contacts.distributed import StripPower
from ..arcs import RACE_SENSES
from .speeds import Levers, Meridian

LIMIT = 120
"""Largest angle of a groove, degrees. It includes the contacts of thrust bearings at 90 degrees."""
EDGES = np.radians(np.arange(-LIMIT, LIMIT + 1.0))
"""Ends of the intervals of angle over which the loss is summed, rad; each is one degree wide."""
ANGLES = 0.5 * (EDGES[:-1] + EDGES[1:])
"""Middles of the intervals of angle, rad."""


def groove_loss(levers: Levers, meridian: Meridian, strips: StripPower) -> Float[Array, "2 groove_angle"]:
    """Sliding loss of all balls together on the inner and the outer race in every interval of `EDGES`, W.

    **Arguments:** `strips`: power and width of the strips of both contacts of every ball, shape (2, ball, strip).
    """
    radius = (levers.grooves.offset + levers.ball_radius)[:, None, None]
    angle = jnp.arctan2(meridian.sine, meridian.cosine)[..., None]
    total = jnp.sum(strips.width, axis=-1, keepdims=True)
    middle = jnp.cumsum(strips.width, axis=-1) - 0.5 * strips.width - 0.5 * total
    width = strips.width / radius
    start = angle + RACE_SENSES[..., None] * middle / radius - 0.5 * width
    below = jnp.clip((EDGES.reshape(-1, 1, 1, 1) - start[None]) / width[None], 0.0, 1.0)
    return jnp.diff(jnp.sum(strips.power[None] * below, axis=(-2, -1)), axis=0).T
