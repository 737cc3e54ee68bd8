"""Maximum of a smooth function that is known at a few points only."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values
from .safe import largest


def peak(positions: Values, values: Float[Array, "... place"]) -> Float[Array, "..."]:
    """Maximum of the parabola through the highest value and its two neighbours.

    **Limits:** exact for a parabola. The error of an inner maximum is of third order in the distance of the points, and
    the result is never below the highest value. For fewer than three points, and for a maximum outside of them, the
    result is the highest value.

    **Arguments:** `positions`: increasing along the last axis, broadcast against the `values`.
    """
    values = jnp.asarray(values)
    count = values.shape[-1]
    if count < 3:
        return largest(values, axis=-1)
    positions = jnp.broadcast_to(jnp.asarray(positions), values.shape)
    middle = jnp.clip(jnp.argmax(values, axis=-1, keepdims=True), 1, count - 2)
    at = lambda array, index: jnp.take_along_axis(array, index, axis=-1)[..., 0]
    (x0, x1, x2), (y0, y1, y2) = ([at(each, middle + k) for k in (-1, 0, 1)] for each in (positions, values))
    before, after = (y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1)
    bend = (after - before) / (x2 - x0)
    hollow = bend < 0
    vertex = 0.5 * (x0 + x1) - 0.5 * before / jnp.where(hollow, bend, -1.0)
    vertex = jnp.clip(vertex, x0, x2)
    top = y0 + (vertex - x0) * (before + bend * (vertex - x1))
    highest = largest(values, axis=-1)
    return jnp.where(hollow, jnp.maximum(top, highest), highest)
