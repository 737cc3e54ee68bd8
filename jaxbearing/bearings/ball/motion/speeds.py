r"""Interaction speeds of a moving ball bearing, as linear functions of its generalised speeds.

Each interaction speed $s = G(\text{position})\,\dot q$ is defined once. An interaction law gives the force f(s), and
transposition gives the generalised forces $G^Tf$. The power of every interaction is then $f\cdot s$, and the energy
balance is exact.

Frames and signs are those of `kinematics`. The spin relative to the orbiting frame is $-w_xe_x + w_re_r + w_te_t$. A
tilt $t_1$ of ring or cage moves azimuth 0 along $+e_x$, a tilt $t_2$ azimuth 90 degrees; the rotation vector is
$t_2e_y - t_1e_z$.

Races. A ball with the distance $r$ from the axis and the radius $r_b$ touches a race at the contact angle $\alpha$. The
inner groove centre has the speed $g$, and $\tau = \dot t_2\cos\psi - \dot t_1\sin\psi$ is the rotation rate of the ring
about $e_r$. The interaction speeds are

- sliding along the orbit:
  $u_{to} = (\dot\psi - \omega_o)(r + r_b\cos\alpha_o) - r_b(w_x\cos\alpha_o + w_r\sin\alpha_o)$,
  $u_{ti} = r_b(w_x\cos\alpha_i + w_r\sin\alpha_i) - (\omega_i - \dot\psi)(r - r_b\cos\alpha_i) - g_t
  - f_iD\sin\alpha_i\,\tau$;
- sliding across rolling: $u_{bo} = -r_bw_t + \dot x\cos\alpha_o - \dot r\sin\alpha_o$,
  $u_{bi} = -r_bw_t - (\dot x - g_x)\cos\alpha_i + (\dot r - g_r)\sin\alpha_i
  - f_iD(\dot t_1\cos\psi + \dot t_2\sin\psi)$;
- spin: $(\dot\psi - \omega_o)\sin\alpha_o - (w_x\sin\alpha_o - w_r\cos\alpha_o)$ and
  $(\omega_i - \dot\psi)\sin\alpha_i + (w_x\sin\alpha_i - w_r\cos\alpha_i) + \tau\cos\alpha_i$.

Pockets. The offset of a ball from the axis of its pocket at the azimuth $\psi_c$ has the components
$s_t = R(\psi - \psi_c) + Y\sin\psi_c - Z\cos\psi_c$ along the orbit and
$s_x = x - X - R(t_1\cos\psi_c + t_2\sin\psi_c)$ along the axis. The azimuth is $\psi_c$ and not $\psi$, so that the
force has the right moment about the centre of the cage.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ....numerics.safe import safe_norm
from ....numerics.series import cosine_and_sine
from ..kinematics import RaceMotion
from ..system import Grooves
from .layout import Places, Rates
from .neighbours import NeighbourSpeeds, neighbour_place, neighbour_speeds

OFFSET_FLOOR = 1e-9
"""Floor of the offset of a ball from the axis of its pocket, m: at 0 its direction is undefined."""


class Meridian(NamedTuple):
    """Contacts of every ball in its half-plane, inner race first: sine and cosine of the contact angles, distances
    between ball and groove centres, m, and `wedge`, the derivative of the inner distance by the azimuth, m/rad."""

    sine: Float[Array, "2 ball"]
    cosine: Float[Array, "2 ball"]
    distance: Float[Array, "2 ball"]
    wedge: Float[Array, " ball"]


class PocketPlace(NamedTuple):
    """Offset of every ball from the axis of its pocket: magnitude, m, and direction (along the orbit, axial)."""

    size: Float[Array, " ball"]
    direction: Float[Array, "2 ball"]


class PocketSpeeds(NamedTuple):
    """Relative motion of every ball and its pocket.

    `opening`: rate of the magnitude of the offset, m/s; `surface`: sliding speeds of the ball (outward, around) on the
    wall towards which it is offset and on the opposite wall, m/s."""

    opening: Float[Array, " ball"]
    surface: Float[Array, "wall 2 ball"]


class LandSpeeds(NamedTuple):
    """Relative motion in the cage lands. `offset`: rate of the offset of the journal from the bush in each land, m/s;
    `turning`: speeds of journal and bush, rad/s."""

    offset: Float[Array, "2 land"]
    turning: Float[Array, "2"]


class Speeds(NamedTuple):
    """All interaction speeds; arrays over both races have the shape (race, ball).

    - `apart`: rates of the distances between ball and groove centres, m/s, positive in compression.
    - `races`: relative motion on the races; `drag`: orbital speed, m/s.
    - `pocket`, `lands`: `None` without a cage; `neighbours`: `None` with a cage.
    """

    apart: Float[Array, "2 ball"]
    races: RaceMotion
    drag: Float[Array, " ball"]
    pocket: PocketSpeeds | None
    lands: LandSpeeds | None
    neighbours: NeighbourSpeeds | None = None


class Levers(eqx.Module):
    """Lengths of the bearing on which the interaction speeds depend.

    **Arguments:**
    - `grooves`: grooves of the races; `ball_radius`, `pitch_radius`: radii of the balls and of the pitch circle, m.
    - `land_places`: axial positions of the cage lands, m; `None` without a cage.
    - `on_outer`: True if the outer ring guides the cage; the lands of the cage are then the journals.
    - `balls_meet`: True if there is no cage and neighbouring balls can touch.
    """

    grooves: Grooves
    ball_radius: Float[Array, ""]
    pitch_radius: Float[Array, ""]
    land_places: Float[Array, " land"] | None = None
    on_outer: bool = eqx.field(static=True, default=False)
    balls_meet: bool = eqx.field(static=True, default=False)

    def meridian(self, places: Places) -> Meridian:
        cosine, sine = cosine_and_sine(places.azimuth)
        dx, dy, dz, t1, t2 = places.ring
        axial, radial = places.centre
        lever = self.grooves.lever
        groove = self.grooves.rest + jnp.stack(
            [dx + lever * (t1 * cosine + t2 * sine), dy * cosine + dz * sine],
        )
        inner = groove - places.centre
        distance = jnp.stack([safe_norm(inner[0], inner[1]), safe_norm(axial, radial)])
        sines = jnp.stack([inner[0], axial]) / distance
        cosines = jnp.stack([inner[1], radial]) / distance
        wedge = sines[0] * lever * (t2 * cosine - t1 * sine) + cosines[0] * (dz * cosine - dy * sine)
        return Meridian(sines, cosines, distance, wedge)

    def pocket_place(self, places: Places) -> PocketPlace:
        cosine, sine = cosine_and_sine(places.pockets)
        x, y, z, t1, t2 = places.cage
        along = self.pitch_radius * (places.azimuth - places.pockets) + y * sine - z * cosine
        axial = places.offset - x - self.pitch_radius * (t1 * cosine + t2 * sine)
        size = safe_norm(along, axial, OFFSET_FLOOR)
        return PocketPlace(size, jnp.stack([along / size, axial / size]))

    def land_offsets(self, places: Places) -> Float[Array, "2 land"]:
        """Offsets of the journals from the bushes, m."""
        return self._across_lands(places.ring, places.cage)

    def _across_lands(self, ring: Array, cage: Array) -> Array:
        """Displacement of the journal relative to the bush in the plane of each land, from the displacements of ring
        and cage, m; likewise for their rates."""
        places = self.land_places
        assert places is not None
        at_lands = lambda body: body[1:3, None] - body[3:5, None] * places[None, :]
        return at_lands(cage) if self.on_outer else at_lands(ring) - at_lands(cage)

    # -- speeds ---------------------------------------------------------------------------------------------------

    def speeds(self, places: Places, meridian: Meridian, rates: Rates) -> Speeds:
        """All interaction speeds; linear in `rates`."""
        apart, races = self.race_speeds(places, meridian, rates)
        return Speeds(
            apart=apart,
            races=races,
            drag=self.pitch_radius * rates.orbit,
            pocket=None if self.land_places is None else self.pocket_speeds(places, rates),
            lands=None if self.land_places is None else self.land_speeds(rates),
            neighbours=neighbour_speeds(places, neighbour_place(places), rates) if self.balls_meet else None,
        )

    def land_speeds(self, rates: Rates) -> LandSpeeds:
        """The part `lands` of `speeds`."""
        cage, inner, outer = rates.cage[5], rates.races[0], rates.races[1]
        turning = jnp.stack([cage, outer] if self.on_outer else [inner, cage])
        return LandSpeeds(self._across_lands(rates.ring, rates.cage[:5]), turning)

    def race_speeds(self, places: Places, meridian: Meridian, rates: Rates) -> tuple[Array, RaceMotion]:
        """The parts `apart` and `races` of `speeds`. The displacements of the ring and their rates may have a last axis
        over the balls."""
        cosine, sine = cosine_and_sine(places.azimuth)
        (sin_i, sin_o), (cos_i, cos_o) = meridian.sine, meridian.cosine
        (w_x, w_r, w_t), (x, r) = rates.spin, rates.centre
        dx, dy, dz, t1, t2 = rates.ring
        grooves, ball = self.grooves, self.ball_radius
        tilting, turning = t1 * cosine + t2 * sine, about_radius(rates.ring, cosine, sine)
        groove_x, groove_r = dx + grooves.lever * tilting, dy * cosine + dz * sine
        groove_t = dz * cosine - dy * sine + grooves.groove_arm * sin_i * turning
        slow, fast = rates.races[0] - rates.orbit, rates.orbit - rates.races[1]
        apart = jnp.stack(
            [
                (groove_x - x) * sin_i + (groove_r - r) * cos_i + rates.orbit * meridian.wedge,
                x * sin_o + r * cos_o,
            ]
        )
        race = jnp.stack([slow * (places.radius - ball * cos_i), fast * (places.radius + ball * cos_o)])
        surface = ball * (w_x[None] * meridian.cosine + w_r[None] * meridian.sine)
        transverse = jnp.stack(
            [
                -ball * w_t - (x - groove_x) * cos_i + (r - groove_r) * sin_i - grooves.groove_arm * tilting,
                -ball * w_t + x * cos_o - r * sin_o,
            ]
        )
        spin = jnp.stack(
            [
                slow * sin_i + (w_x * sin_i - w_r * cos_i) + turning * cos_i,
                fast * sin_o - (w_x * sin_o - w_r * cos_o),
            ]
        )
        roll = jnp.stack(
            [
                slow * cos_i + (w_x * cos_i + w_r * sin_i) - turning * sin_i,
                fast * cos_o - (w_x * cos_o + w_r * sin_o),
            ]
        )
        rolling = jnp.stack([surface[0] - race[0] - groove_t, race[1] - surface[1]])
        return apart, RaceMotion(race, surface, rolling, transverse, spin, roll)

    def pocket_speeds(self, places: Places, rates: Rates) -> PocketSpeeds:
        """The part `pocket` of `speeds`."""
        cosine, sine = cosine_and_sine(places.pockets)
        n_t, n_x = self.pocket_place(places).direction
        _, y, z, t1, t2 = places.cage
        v_x, v_y, v_z, v_1, v_2, cage = rates.cage
        (w_x, w_r, w_t), (x, r) = rates.spin, rates.centre
        pitch, ball = self.pitch_radius, self.ball_radius
        along = pitch * (rates.orbit - cage) + v_y * sine - v_z * cosine + cage * (y * cosine + z * sine)
        axial = x - v_x - pitch * (v_1 * cosine + v_2 * sine + cage * (t2 * cosine - t1 * sine))
        # spin relative to the cage: about the axis, the radius and the tangent of the orbit
        about_x = rates.orbit - w_x - cage
        about_r = w_r - (v_2 * cosine - v_1 * sine)
        about_t = w_t + (v_2 * sine + v_1 * cosine)
        outward, around = ball * (about_t * n_x - about_x * n_t), ball * about_r
        lifting, passing = r - (v_y * cosine + v_z * sine), n_t * axial - n_x * along
        ahead = jnp.stack([outward + lifting, around + passing])
        behind = jnp.stack([lifting - outward, passing - around])
        return PocketSpeeds(n_t * along + n_x * axial, jnp.stack([ahead, behind]))


def about_radius(ring: Float[Array, "5"], cosine: Array, sine: Array) -> Array:
    """Rotation rate of the tilting ring about the radius through each ball, rad/s. **Arguments:** `ring`: rates of the
    displacements of the ring, m/s and rad/s."""
    return ring[4] * cosine - ring[3] * sine
