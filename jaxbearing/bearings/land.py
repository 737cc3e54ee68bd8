"""Cage lands on the guiding ring: eccentricity, torques, dissipation."""

from typing import Literal, NamedTuple

from jaxtyping import Array, Float

from ..gaps import ShortJournal
from ..lubricants import InletOil
from ..numerics.safe import safe_norm


class LandState(NamedTuple):
    """State of all cage lands together: position of the cage, torques on the cage and on the guiding ring, N m,
    dissipation, W."""

    eccentricity_ratio: Float[Array, ""]
    attitude_angle: Float[Array, ""]
    cage_torque: Float[Array, ""]
    ring_torque: Float[Array, ""]
    power: Float[Array, ""]
    residual: Float[Array, ""]


def guided_land(
    land: ShortJournal,
    guidance: Literal["inner_ring", "outer_ring"],
    inner_speed: Array,
    outer_speed: Array,
    cage_speed: Array,
    force_x: Array,
    force_y: Array,
    inlet: InletOil,
) -> LandState:
    """Steady state of the cage lands that carry a force on the cage.

    **Arguments:** `inner_speed`, `outer_speed`, `cage_speed`: rad/s; `force_x`, `force_y`: force on the cage, N;
    `inlet`: oil of the lands.
    """
    inner = guidance == "inner_ring"
    journal, bush = (inner_speed, cage_speed) if inner else (cage_speed, outer_speed)
    k_z, c_f = land.film_factors(inlet.density, inlet.viscosity, journal - bush)
    film = land.static_equilibrium(safe_norm(force_x, force_y) / land.n_lands, journal, bush, inlet.viscosity, k_z)
    on_journal, on_bush = land.torques(
        film.eccentricity_ratio, film.tangential_force, journal, bush, inlet.viscosity, c_f
    )
    on_cage, on_ring = (on_bush, on_journal) if inner else (on_journal, on_bush)
    return LandState(
        eccentricity_ratio=film.eccentricity_ratio,
        attitude_angle=film.attitude_angle,
        cage_torque=land.n_lands * on_cage,
        ring_torque=land.n_lands * on_ring,
        power=land.n_lands * land.dissipation(on_journal, on_bush, journal, bush),
        residual=film.residual,
    )
