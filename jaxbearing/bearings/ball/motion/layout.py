"""State of the moving ball bearing: its components, their units, and the positions and speeds computed from them."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

BALL_STATE = ("q", "v", "u_x", "u_r", "u_t", "x", "r", "v_x", "v_r")
"""Components of the state of a ball in the frame of the run: position along the pitch circle, m, and its rate, m/s;
surface speeds of the three components of the spin, m/s; axial and outward displacement from the position of a free
ball, m, and their rates, m/s."""
CAGE_STATE = ("x", "y", "z", "t_y", "t_z", "q", "v_x", "v_y", "v_z", "v_ty", "v_tz", "v")
"""Components of the state of the cage: displacements of the centre, tilts times pitch radius and angle times pitch
radius, m, and their rates, m/s."""
RING_STATE = ("ring_x", "ring_y", "ring_z", "ring_ty", "ring_tz")
"""Displacements of the inner ring, and its tilts times the radius of the circle of its groove centres, m."""
RING_RATES = ("ring_v_x", "ring_v_y", "ring_v_z", "ring_v_ty", "ring_v_tz")
"""Rates of the components of `RING_STATE`, m/s."""
GLOBAL_STATE = (*CAGE_STATE, *RING_STATE, *RING_RATES)
"""Components of the state that all balls share: those of cage and ring."""

PLACE, SLOW, FAST = 1e-5, 0.1, 1.0
"""Units of positions, m, of speeds of centres, m/s, and of surface speeds, m/s, chosen so that one tolerance suits
all components."""
BALL_UNITS = (PLACE, SLOW, FAST, FAST, FAST, PLACE, PLACE, SLOW, SLOW)
GLOBAL_UNITS = (PLACE,) * 6 + (SLOW,) * 6 + (PLACE,) * 5 + (SLOW,) * 5


class Places(NamedTuple):
    """Positions of balls, cage and ring.

    - `azimuth`: azimuth of each ball, rad; `pockets`: azimuth of each pocket, rad.
    - `centre`: centre of each ball from the outer groove centre (axial, outward), m.
    - `offset`: axial displacement of each ball from the position of a free ball, m; `radius`: distance of each ball
      from the axis, m.
    - `cage`: displacement of the centre of the cage (axial, along azimuth 0, along azimuth 90 degrees), m, and its
      tilts, rad, with the signs of those of the ring.
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
    """Generalised speeds of balls, cage and ring. An object of this class also holds the conjugate generalised forces.

    - `orbit`: speed of each ball about the axis, rad/s; `spin`: spin components w_x, w_r, w_t of each ball relative to
      the orbiting frame, rad/s, with the signs of `BallMotion`; `centre`: axial and outward speed of each ball, m/s.
    - `cage`: rates of `Places.cage` and the speed about the axis, m/s and rad/s; `ring`: rates of `Places.ring`, m/s
      and rad/s.
    - `races`: speeds of the inner and the outer ring about the axis, rad/s.
    """

    orbit: Float[Array, " ball"]
    spin: Float[Array, "3 ball"]
    centre: Float[Array, "2 ball"]
    cage: Float[Array, "6"]
    ring: Float[Array, "5"]
    races: Float[Array, "2"]


def tilt_levers(lever: Array) -> Float[Array, "5"]:
    """Factors that convert three displacements and two tilts to lengths: 1 and `lever`, m."""
    one = jnp.ones(())
    return jnp.stack([one, one, one, lever, lever])
