"""The frame in which a run counts positions: it turns with the rolling elements."""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._types import Scalar
from ...time_laws import AbstractTimeFactor


def turning_frame(
    reference_speed: Float[Array, ""], speed: AbstractTimeFactor, time: Scalar
) -> tuple[Float[Array, ""], Float[Array, ""], Float[Array, ""]]:
    """Angle, rad, speed and acceleration of the frame. **Arguments:** `reference_speed`: its speed at the operating
    point, rad/s; `speed`: that of the inner ring over that of the operating point; `time`, s."""
    time = jnp.asarray(time, dtype=float)
    factor, rate = jax.jvp(speed.factor, (time,), (jnp.ones_like(time),))
    return reference_speed * speed.integral(time), reference_speed * factor, reference_speed * rate
