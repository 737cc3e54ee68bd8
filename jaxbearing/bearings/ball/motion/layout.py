"""State of the moving ball bearing: its components, their units, and the places and rates that they stand for."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

BALL_STATE = ("q", "v", "u_x", "u_r", "u_t", "x", "r", "v_x", "v_r")
"""Components of a ball's state in the frame of the run: position along the pitch circle, m, its speed, surface speeds
of the three components of the spin, m/s, place along the axis and outward from that of a free ball, m, their rates."""
CAGE_STATE = ("x", "y", "z", "t_y", "t_z", "q", "v_x", "v_y", "v_z", "v_ty", "v_tz", "v")
"""Components of the cage's state: centre, tilts times pitch radius and angle times pitch radius, m, and their rates."""
RING_STATE = ("ring_x", "ring_y", "ring_z", "ring_ty", "ring_tz")
"""Displacement of the inner ring, tilts times the radius of its groove centres, m."""
RING_RATES = ("ring_v_x", "ring_v_y", "ring_v_z", "ring_v_ty", "ring_v_tz")
"""Rates of the displacement, m/s."""
GLOBAL_STATE = (*CAGE_STATE, *RING_STATE, *RING_RATES)
"""Components of what the balls share: cage and ring."""

PLACE, SLOW, FAST = 1e-5, 0.1, 1.0
"""Units of places, m, of speeds of centres, m/s, and of surface speeds, m/s: one tolerance serves for all."""
BALL_UNITS = (PLACE, SLOW, FAST, FAST, FAST, PLACE, PLACE, SLOW, SLOW)
GLOBAL_UNITS = (PLACE,) * 6 + (SLOW,) * 6 + (PLACE,) * 5 + (SLOW,) * 5


class Places(NamedTuple):
    """Places of balls, cage and ring.

    - `azimuth`: of each ball, `pockets`: of each pocket, rad.
    - `centre`: of each ball from the outer groove centre, (axial, outward), m.
    - `offset`: axial place of each ball from that of a free ball, m; `radius`: distance from the axis, m.
    - `cage`: centre (axial, along azimuth 0, along azimuth 90 degrees), m, and tilts, rad, of the signs of the ring's.
    - `ring`: displacements of the inner ring, m and rad, in the order of `RING_FREEDOMS`.
    """

    azimuth: Float[Array, " ball"]
    pockets: Float[Array, " ball"]
    centre: Float[Array, "2 ball"]
    offset: Float[Array, " ball"]
    radius: Float[Array, " ball"]
    cage: Float[Array, "5"]
    ring: Float[Array, "5"]


class Rates(NamedTuple):
    """Generalised speeds of balls, cage and ring; their conjugates are the generalised forces.

    - `orbit`: speed of each ball about the axis, rad/s; `spin`: w_x, w_r, w_t of each ball relative to the orbiting
      frame, rad/s, of the signs of `BallMotion`; `centre`: axial and outward speed of each ball, m/s.
    - `cage`: rates of `Places.cage` and the speed about the axis, m/s and rad/s; `ring`: rates of `Places.ring`.
    - `races`: speeds of the inner and the outer ring about the axis, rad/s.
    """

    orbit: Float[Array, " ball"]
    spin: Float[Array, "3 ball"]
    centre: Float[Array, "2 ball"]
    cage: Float[Array, "6"]
    ring: Float[Array, "5"]
    races: Float[Array, "2"]


def tilt_levers(lever: Array) -> Float[Array, "5"]:
    """Factors that turn three displacements and two tilts into lengths."""
    one = jnp.ones(())
    return jnp.stack([one, one, one, lever, lever])
