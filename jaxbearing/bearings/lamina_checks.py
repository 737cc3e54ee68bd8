"""What loads per lamina tell of a contact: whether its end carries too much."""

import jax.numpy as jnp
from jaxtyping import Array, Float

BUSY = 0.1
"""Load of a contact, over the largest, from which on its distribution along the roller is looked at."""
EDGE_LOADED = 1.5
EDGE_WARNING = (
    "rollers are loaded on an edge, with more than 1.5 times their mean load per length at an end: the peak of "
    "pressure there is higher than that of laminae, and the film thinner than at mid length"
)


def edge_excess(laminae: Float[Array, "2 roller lamina"], load: Float[Array, "2 roller"]) -> Float[Array, ""]:
    """By how much the load of an end lamina over the mean exceeds `EDGE_LOADED`, at most; loads in N."""
    busy = (load > 0) & (load >= BUSY * jnp.max(load))
    mean = jnp.where(busy, load, 1.0) / laminae.shape[2]
    end = jnp.maximum(laminae[..., 0], laminae[..., -1]) / mean
    return jnp.max(jnp.where(busy, end, 0.0)) - EDGE_LOADED
