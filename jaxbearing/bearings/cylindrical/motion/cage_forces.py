"""Forces of a moving cage on rollers and guiding ring, and their reactions: pocket walls and lands (source eqs.
(31)-(36))."""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ....gaps import CompliantPocketFace
from ....gaps.pocket import PocketFace
from ....lubricants import InletOil
from ....numerics.series import cosine_and_sine
from ..forces import CageParts
from ..kinematics import RollerKinematics


class LandForces(NamedTuple):
    """Sums over all cage lands: force, N, and torque, N m, on the cage, torque on the guiding ring, N m, and
    dissipation, W; and the eccentricity ratio of the cage."""

    force: Float[Array, "2"]
    cage_torque: Float[Array, ""]
    ring_torque: Float[Array, ""]
    power: Float[Array, ""]
    eccentricity_ratio: Float[Array, ""]


class PocketState(NamedTuple):
    """Contacts with the front and the rear wall of every pocket. `gap_rate`: rate at which the front gap opens, m/s;
    the rear gap closes at the same rate."""

    front: PocketFace
    rear: PocketFace
    gap_rate: Float[Array, " roller"]


class RingShift(NamedTuple):
    """Displacement of the inner ring along its degrees of freedom, m, and their names."""

    values: Float[Array, " freedom"]
    freedoms: tuple[str, ...]

    @property
    def across_and_along(self) -> Float[Array, "2"]:
        """The displacement along X, a quarter turn behind the load line, and along Y, the load line."""
        lateral = self.values[1] if "lateral" in self.freedoms else jnp.zeros(())
        return jnp.stack([-lateral, self.values[0]])


def pocket_state(
    face: CompliantPocketFace,
    clearance: Float[Array, ""],
    viscosity: Float[Array, ""],
    roller: tuple[Array, Array, Array],
    position: tuple[Array, Array, Array],
    velocity: tuple[Array, Array, Array],
    azimuth: Float[Array, " roller"],
    orbit: Float[Array, " roller"],
    pitch_radius: Float[Array, ""],
) -> PocketState:
    """Films, loads and friction on both walls of every pocket.

    **Arguments:**
    - `face`: model of the film on one wall.
    - `clearance`: circumferential pocket clearance J_p, m.
    - `viscosity`: of the oil at the inlet, Pa s.
    - `roller`: q, m, and v and u, m/s, of each roller (see `rates`).
    - `position`: X, Y and q_c of the cage, m; `velocity`: V_x, V_y and v_c of the cage, m/s.
    - `azimuth`: of each roller, rad; `orbit`: orbital speed of each roller, rad/s.
    - `pitch_radius`: R_m, m.
    """
    (q, v, u), (x, y, q_c), (v_x, v_y, v_c) = roller, position, velocity
    # the speed of the roller's surface against the cage
    sliding = u - (v - v_c) * (face.roller_radius / pitch_radius)
    cosine, sine = cosine_and_sine(azimuth)
    ahead = (q_c - q) - (x * cosine + y * sine)
    rate = (v_c - v) - (v_x * cosine + v_y * sine) + (x * sine - y * cosine) * orbit
    half = 0.5 * clearance
    # one search for both walls needs half as many loops
    gaps = jnp.stack([half + ahead, half - ahead])
    walls = face.face(gaps, jnp.stack([rate, -rate]), jnp.stack([sliding, sliding]), viscosity)
    front, rear = (jax.tree.map(lambda leaf, i=i: leaf[i], walls) for i in (0, 1))
    return PocketState(front, rear, rate)


def land_forces(
    parts: CageParts,
    inlet: InletOil,
    motion: RollerKinematics,
    ring: RingShift,
    centre: Float[Array, "2"],
    velocity: Float[Array, "2"],
    cage_orbit: Float[Array, ""],
    turbulence_speed: Float[Array, ""],
) -> LandForces:
    """Forces, torques and losses of the lands that guide the cage.

    **Arguments:**
    - `ring`: displacement of the inner ring; its velocity is neglected.
    - `centre`, m, and `velocity`, m/s: of the cage, along X and Y.
    - `cage_orbit`: speed of the cage, rad/s.
    - `turbulence_speed`: cage speed at which the turbulence of the films is evaluated, rad/s.
    """
    assert parts.land is not None
    land = parts.land
    inner = parts.guidance == "inner_ring"
    if inner:
        offset, rate = ring.across_and_along - centre, -velocity
        journal, bush = motion.inner_speed, cage_orbit
        k_z, c_f = land.film_factors(inlet.density, inlet.viscosity, motion.inner_speed - turbulence_speed)
    else:
        offset, rate, journal, bush = centre, velocity, cage_orbit, motion.outer_speed
        k_z, c_f = land.film_factors(inlet.density, inlet.viscosity, turbulence_speed - motion.outer_speed)
    film = land.force_on_journal(offset[0], offset[1], rate[0], rate[1], journal, bush, inlet.viscosity, k_z)
    line = land.line_of_centres(offset[0], offset[1])
    along, across = line.direction
    on_journal, on_bush = land.torques(
        line.eccentricity_ratio, film[1] * along - film[0] * across, journal, bush, inlet.viscosity, c_f
    )
    on_cage, on_ring = (on_bush, on_journal) if inner else (on_journal, on_bush)
    n, sign = land.n_lands, -1.0 if inner else 1.0
    heat = land.dissipation(on_journal, on_bush, journal, bush) - film[0] * rate[0] - film[1] * rate[1]
    return LandForces(sign * n * jnp.stack(film), n * on_cage, n * on_ring, n * heat, line.eccentricity_ratio)
