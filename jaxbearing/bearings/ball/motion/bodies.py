"""Cage and inner ring of a moving ball bearing: inertia, cage lands and driving forces."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ....gaps import CompliantBallPocketFace, ShortJournal
from ....gaps.ball_pocket_face import BallPocketFace
from ....lubricants import InletOil
from ....numerics.safe import safe_norm
from .layout import tilt_levers
from .speeds import LandSpeeds, PocketPlace, PocketSpeeds


class TurningBody(eqx.Module):
    r"""A body of revolution that turns fast about the bearing axis and has small tilts $t_1, t_2$.

    Its equations of motion are $m\ddot x = F$, $I_t\ddot t_1 = M_1 - I_p\omega\dot t_2$,
    $I_t\ddot t_2 = M_2 + I_p\omega\dot t_1$ and $I_p\dot\omega = M_x$, with the moments $M_1, M_2$ conjugate to the
    tilts.

    **Arguments:** `mass`: mass, kg; `polar`, `transverse`: moments of inertia about the axis and about a diameter,
    kg m^2.
    """

    mass: Float[Array, ""]
    polar: Float[Array, ""]
    transverse: Float[Array, ""]

    def acceleration(
        self, force: Float[Array, "5"], tilting: Float[Array, "2"], speed: Float[Array, ""]
    ) -> Float[Array, "5"]:
        """Accelerations of the centre, m/s^2, and of the tilts, rad/s^2.

        **Arguments:** `force`: forces and moments conjugate to them, N and N m; `tilting`: rates of the tilts, rad/s;
        `speed`: speed about the axis, rad/s."""
        turn = self.polar * speed * jnp.stack([-tilting[1], tilting[0]])
        return jnp.concatenate([force[:3] / self.mass, (force[3:] + turn) / self.transverse])

    def kinetic_energy(self, rates: Float[Array, "5"]) -> Float[Array, ""]:
        """Kinetic energy without the rotation about the axis, J."""
        return 0.5 * (self.mass * jnp.sum(rates[:3] ** 2) + self.transverse * jnp.sum(rates[3:] ** 2))


class MovingCage(eqx.Module):
    """The cage: its body, its pockets and its lands.

    **Arguments:**
    - `body`: mass and moments of inertia; `imbalance`: offset of the centre of mass in the direction of the cage angle,
      m.
    - `pocket`: film on one wall of a pocket; `viscosity`: viscosity of the oil in the pockets, Pa s.
    - `land`: film of one land; `oil`: oil in the lands.
    """

    body: TurningBody
    pocket: CompliantBallPocketFace
    viscosity: Float[Array, ""]
    land: ShortJournal
    oil: InletOil
    imbalance: Float[Array, ""]

    def walls(self, place: PocketPlace, speeds: PocketSpeeds) -> BallPocketFace:
        """Films and contacts on both walls of every pocket; first the wall towards which the ball is offset."""
        half = 0.5 * self.pocket.clearance
        gap = jnp.stack([half - place.size, half + place.size])
        rate = jnp.stack([-speeds.opening, speeds.opening])
        along, across = speeds.surface[:, 0], speeds.surface[:, 1]
        return self.pocket.face(gap, rate, along, across, self.viscosity)

    def acceleration(
        self, force: Float[Array, "6"], rates: Float[Array, "6"], angle: Float[Array, ""]
    ) -> Float[Array, "6"]:
        """Accelerations of centre, tilts and angle of the cage, m/s^2 and rad/s^2.

        **Arguments:** `force`: forces and moments conjugate to `rates`, N and N m; `angle`: angle of the cage, rad."""
        pulled = force[:5] + jnp.concatenate([self.imbalance_force(rates[5], angle), jnp.zeros(2)])
        moved = self.body.acceleration(pulled, rates[3:5], rates[5])
        return jnp.append(moved, force[5] / self.body.polar)

    def imbalance_force(self, speed: Array, angle: Array) -> Float[Array, "3"]:
        """Force of the imbalance, N. Its tangential part, from the angular acceleration, is neglected."""
        size = self.body.mass * self.imbalance * jnp.square(speed)
        return size * jnp.stack([jnp.zeros(()), jnp.cos(angle), jnp.sin(angle)])

    def kinetic_energy(self, rates: Float[Array, "6"]) -> Float[Array, ""]:
        """Kinetic energy of the cage, J."""
        return self.body.kinetic_energy(rates[:5]) + 0.5 * self.body.polar * jnp.square(rates[5])


class Lands(NamedTuple):
    """Forces of the cage lands, conjugate to their speeds, N and N m, and the eccentricity ratio of each land."""

    forces: LandSpeeds
    eccentricity_ratio: Float[Array, " land"]

    @property
    def load(self) -> Float[Array, " land"]:
        """Magnitude of the force of each land, N."""
        y, z = self.forces.offset
        return safe_norm(y, z)


def moving_lands(cage: MovingCage, offset: Float[Array, "2 land"], speeds: LandSpeeds) -> Lands:
    """Forces of the films of all cage lands. **Arguments:** `offset`: offset of the journal from the bush at each land,
    m."""
    land, viscosity = cage.land, cage.oil.viscosity
    journal, bush = speeds.turning
    k_z, c_f = land.film_factors(cage.oil.density, viscosity, journal - bush)
    (y, z), (v_y, v_z) = offset, speeds.offset
    film = land.force_on_journal(y, z, v_y, v_z, journal, bush, viscosity, k_z)
    line = land.line_of_centres(y, z)
    along, across = line.direction
    torques = land.torques(line.eccentricity_ratio, film[1] * along - film[0] * across, journal, bush, viscosity, c_f)
    return Lands(LandSpeeds(jnp.stack(film), jnp.sum(jnp.stack(torques), axis=1)), line.eccentricity_ratio)


class MovingRing(eqx.Module):
    """The inner ring, with the mass of the shaft that moves with it.

    **Arguments:**
    - `body`: mass and moments of inertia; `None`: the ring is held.
    - `load`: loads on the five degrees of freedom at the operating point, N and N m; `held`: prescribed displacements,
      m and rad.
    - `damping`: external damping of the displacements, N s/m; that of the tilts is `damping` times `lever` squared.
    - `lever`: radius R_i of the circle of inner groove centres, m.
    - `free`: for each degree of freedom, true if it moves, false if it is held.
    """

    body: TurningBody | None
    load: Float[Array, "5"]
    held: Float[Array, "5"]
    damping: Float[Array, ""]
    lever: Float[Array, ""]
    free: tuple[bool, ...] = eqx.field(static=True, default=(False,) * 5)

    @property
    def mask(self) -> Float[Array, "5"]:
        return jnp.asarray(self.free, dtype=float)

    def damping_force(self, rates: Float[Array, "5"]) -> Float[Array, "5"]:
        """External damping forces and moments, conjugate to the displacements, N and N m."""
        return -self.damping * jnp.square(tilt_levers(self.lever)) * rates

    def acceleration(
        self, force: Float[Array, "5"], rates: Float[Array, "5"], speed: Float[Array, ""]
    ) -> Float[Array, "5"]:
        """Accelerations of the displacements, m/s^2 and rad/s^2; 0 for held degrees of freedom.

        **Arguments:** `force`: sum of the forces of balls, lands, damping and loads, N and N m; `rates`: rates of the
        displacements, m/s and rad/s; `speed`: speed of the ring about its axis, rad/s."""
        if self.body is None:
            return jnp.zeros(5)
        return self.mask * self.body.acceleration(force, rates[3:], speed)

    def kinetic_energy(self, rates: Float[Array, "5"]) -> Float[Array, ""]:
        """Kinetic energy without the rotation about the axis, which is prescribed, J."""
        return jnp.zeros(()) if self.body is None else self.body.kinetic_energy(rates)
