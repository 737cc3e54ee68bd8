"""Kinematics of balls between two grooved rings: rolling without sliding, direction of the spin, relative motion."""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..._types import Values
from .arcs import RACE_SENSES


class BallMotion(NamedTuple):
    """Orbital speed of the ball centre and spin of the ball relative to the orbiting frame, rad/s; both are > 0 in
    normal running.

    The spin vector is $-\\omega_R(\\cos\\beta\\,e_x - \\sin\\beta\\,e_r) + \\omega_te_t$ with the `spin_speed`
    $\\omega_R$, the `attitude` $\\beta$, rad, in the plane through the bearing axis, and the `transverse` spin
    $\\omega_t$, which is 0 unless traction carries the gyroscopic couple ("resolved").
    """

    orbital_speed: Float[Array, "*batch"]
    spin_speed: Float[Array, "*batch"]
    attitude: Float[Array, "*batch"]
    transverse: Float[Array, "*batch"]

    @property
    def axial_spin(self) -> Float[Array, "*batch"]:
        """Component of the spin opposite to the bearing axis $e_x$, rad/s."""
        return self.spin_speed * jnp.cos(self.attitude)

    @property
    def radial_spin(self) -> Float[Array, "*batch"]:
        """Radially outward component of the spin, rad/s."""
        return self.spin_speed * jnp.sin(self.attitude)


class RaceMotion(NamedTuple):
    """Relative motion (ball minus race) in the contact with the inner or the outer race.

    - `race_speed`, `ball_speed`: speeds of the two surfaces along rolling, relative to the contact, m/s.
    - `rolling`, `transverse`: sliding speeds along $e_t$ and $b_k$, m/s.
    - `spin`, `roll`: relative angular speeds about the contact normal and about $b_k$, rad/s.
    """

    race_speed: Float[Array, "*batch"]
    ball_speed: Float[Array, "*batch"]
    rolling: Float[Array, "*batch"]
    transverse: Float[Array, "*batch"]
    spin: Float[Array, "*batch"]
    roll: Float[Array, "*batch"]

    @property
    def mean_speed(self) -> Float[Array, "*batch"]:
        """Entrainment speed, m/s; in normal running it has the sign of the race speed."""
        return 0.5 * (self.race_speed + self.ball_speed)


class BallKinematics(eqx.Module):
    r"""Balls of diameter D on a pitch circle $d_m$, $\gamma' = D/d_m$, between an inner and an outer ring.

    At a ball: $e_x$ axial, $e_r$ radially outward, $e_t = e_x\times e_r$ along the orbit. The contact normals, from the
    ball's centre, are $n_o = \cos\alpha_oe_r + \sin\alpha_oe_x$ and $n_i = -\cos\alpha_ie_r - \sin\alpha_ie_x$, and
    $(e_t, b_k, n_k)$ is right-handed. Elastic changes of the rolling radii are neglected.

    **Reference:** Jones (1959), Trans. ASME D 81, 1; Harris, *Rolling Bearing Analysis*; source eqs. (3)-(12).

    **Arguments:**
    - `inner_speed`, `outer_speed`: speeds of the rings, rad/s.
    - `pitch_diameter`: $d_m$, m.
    - `ball_diameter`: D, m.
    """

    inner_speed: Float[Array, ""]
    outer_speed: Float[Array, ""]
    pitch_diameter: Float[Array, ""]
    ball_diameter: Float[Array, ""]

    @property
    def ratio(self) -> Array:
        """Ratio of ball diameter to pitch diameter, $\\gamma' = D/d_m$."""
        return self.ball_diameter / self.pitch_diameter

    def rolling(self, inner_angle: Values, outer_angle: Values, attitude: Values) -> BallMotion:
        """Motion without sliding at the centres of both contacts, for given contact angles and attitude, rad."""
        inner_lever, outer_lever = 1.0 - self.ratio * jnp.cos(inner_angle), 1.0 + self.ratio * jnp.cos(outer_angle)
        inner, outer = inner_lever * jnp.cos(outer_angle - attitude), outer_lever * jnp.cos(inner_angle - attitude)
        both = inner + outer
        orbital = (self.inner_speed * inner + self.outer_speed * outer) / both
        # equals (orbital - outer_speed) a_o / c_o, but avoids the difference of nearly equal speeds
        relative = self.inner_speed - self.outer_speed
        spin = relative * inner_lever * outer_lever / (self.ratio * both)
        return BallMotion(orbital, spin, jnp.broadcast_to(attitude, spin.shape), jnp.zeros_like(spin))

    def held(self, orbital_speed: Values, inner_angle: Values, outer_angle: Values, attitude: Values) -> BallMotion:
        """Motion at a given orbital speed, rad/s, with the same sliding speed on both races; angles in rad."""
        inner = (self.inner_speed - orbital_speed) * (1.0 - self.ratio * jnp.cos(inner_angle))
        outer = (orbital_speed - self.outer_speed) * (1.0 + self.ratio * jnp.cos(outer_angle))
        cosines = jnp.cos(inner_angle - attitude) + jnp.cos(outer_angle - attitude)
        spin = (inner + outer) / (self.ratio * cosines)
        ones = jnp.ones_like(spin)
        return BallMotion(orbital_speed * ones, spin, attitude * ones, jnp.zeros_like(spin))

    def orbit_scale(self, free: Array, floor: float = 0.0) -> Float[Array, ""]:
        """Scale of orbital speeds, rad/s; not 0 while a ring turns.

        **Arguments:** `free`: orbital speed of a ball that rolls without sliding, rad/s; `floor`: floor of the scale,
        added as a square, rad/s."""
        both = 0.5 * (jnp.square(free) + jnp.square(free - self.outer_speed))
        return jnp.sqrt(both + floor**2)

    def outer_control(self, outer_angle: Values) -> Float[Array, "..."]:
        """Attitude at which the ball does not spin on the outer race, rad (source eq. (10))."""
        return jnp.arctan2(jnp.sin(outer_angle), jnp.cos(outer_angle) + self.ratio)

    def inner_control(self, inner_angle: Values) -> Float[Array, "..."]:
        """Attitude at which the ball does not spin on the inner race, rad (source eq. (11))."""
        return jnp.arctan2(jnp.sin(inner_angle), jnp.cos(inner_angle) - self.ratio)

    def raceway_control(self, inner_angle: Values, outer_angle: Values, attitude: Values) -> Float[Array, "..."]:
        """Degree of outer race control, 100 (beta_i - beta)/(beta_i - beta_o): 100 is outer, 0 inner race control
        (source eq. (94)).

        It is set to 100 where beta_i and beta_o agree within 1e-9 rad (contact angles 0), because it has no meaning
        there.
        """
        inner, outer = self.inner_control(inner_angle), self.outer_control(outer_angle)
        apart = jnp.abs(inner - outer) > 1e-9
        return jnp.where(apart, 100.0 * (inner - attitude) / jnp.where(apart, inner - outer, 1.0), 100.0)

    def inner_race(self, motion: BallMotion, angle: Values) -> RaceMotion:
        """Relative motion on the inner race at a contact angle, rad."""
        return self._over(motion, angle, 1.0, self.inner_speed)

    def outer_race(self, motion: BallMotion, angle: Values) -> RaceMotion:
        """Relative motion on the outer race at a contact angle, rad."""
        return self._over(motion, angle, -1.0, self.outer_speed)

    def races(
        self,
        motion: BallMotion,
        angle: Float[Array, "contact ball"],
        senses: Float[np.ndarray, "contact 1"] = RACE_SENSES,
    ) -> RaceMotion:
        """Relative motion at every contact of the balls.

        **Arguments:** `angle`: contact angles, rad; `senses`: 1 for a contact on the inner race, -1 on the outer race;
        default: one contact on each.
        """
        ring = jnp.where(senses > 0, self.inner_speed, self.outer_speed)
        return self._over(jax.tree.map(lambda leaf: leaf[None], motion), angle, senses, ring)

    def _over(
        self, motion: BallMotion, angle: Values, side: float | Float[np.ndarray, "contact 1"], ring_speed: Array
    ) -> RaceMotion:
        sense = jnp.asarray(side)
        drive = sense * (ring_speed - motion.orbital_speed)
        race = drive * 0.5 * self.pitch_diameter * (1.0 - sense * self.ratio * jnp.cos(angle))
        along, across = (motion.spin_speed * turn(angle - motion.attitude) for turn in (jnp.cos, jnp.sin))
        ball = 0.5 * self.ball_diameter * along
        return RaceMotion(
            race_speed=race,
            ball_speed=ball,
            rolling=sense * (ball - race),
            transverse=jnp.broadcast_to(-0.5 * motion.transverse * self.ball_diameter, ball.shape),
            spin=drive * jnp.sin(angle) + sense * across,
            roll=drive * jnp.cos(angle) + sense * along,
        )
