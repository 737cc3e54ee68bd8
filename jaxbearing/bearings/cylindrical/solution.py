"""Results of a cylindrical roller bearing, labelled (see `solution`)."""

import equinox as eqx
from jaxtyping import Array, Float

from ..operation import Operation
from ..solution import Solution, label


class RollerResults(eqx.Module):
    """Arrays over the rolling elements; what is not modelled is `None`. Speeds are positive in normal running."""

    azimuth: Float[Array, " element"] = eqx.field(metadata=label("rad", "azimuth from the load line"))
    load_inner: Float[Array, " element"] = eqx.field(metadata=label("N", "normal load on the inner raceway"))
    load_outer: Float[Array, " element"] = eqx.field(metadata=label("N", "normal load on the outer raceway"))
    pressure_inner: Float[Array, " element"] = eqx.field(
        metadata=label("Pa", "Hertz (peak) pressure on the inner raceway")
    )
    pressure_outer: Float[Array, " element"] = eqx.field(
        metadata=label("Pa", "Hertz (peak) pressure on the outer raceway")
    )
    orbital_speed: Float[Array, " element"] = eqx.field(
        metadata=label("rad/s", "speed of the roller centre about the bearing axis")
    )
    spin_speed: Float[Array, " element"] = eqx.field(
        metadata=label("rad/s", "spin about the roller's own axis, relative to its orbit")
    )
    film_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "central film on the inner raceway")
    )
    film_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "central film on the outer raceway")
    )
    film_least_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "central film of the lamina that carries most, inner")
    )
    film_least_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "central film of the lamina that carries most, outer")
    )
    temperature_rise_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("K", "inlet heating, inner")
    )
    temperature_rise_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("K", "inlet heating, outer")
    )
    sliding_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m/s", "sliding speed on the inner race")
    )
    sliding_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m/s", "sliding speed on the outer race")
    )
    traction_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "forward force by the inner race")
    )
    traction_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "backward force by the outer race")
    )
    pocket_film_front: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "film in front of the roller")
    )
    pocket_film_rear: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("m", "film behind the roller")
    )
    pocket_load_front: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "pocket load in front")
    )
    pocket_load_rear: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "pocket load behind")
    )
    film_ratio_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("1", "film over roughness (lambda), inner raceway")
    )
    film_ratio_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("1", "film over roughness (lambda), outer raceway")
    )
    load_share_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("1", "part of the load that asperities carry, inner raceway")
    )
    load_share_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("1", "part of the load that asperities carry, outer raceway")
    )
    boundary_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "boundary friction along rolling, inner raceway")
    )
    boundary_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("N", "boundary friction along rolling, outer raceway")
    )
    flash_inner: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("K", "flash temperature, inner raceway")
    )
    flash_outer: Float[Array, " element"] | None = eqx.field(
        default=None, metadata=label("K", "flash temperature, outer raceway")
    )


class PowerLoss(eqx.Module):
    """Dissipated power by location, W; the entries add up to `total`. Losses that a scene does not model are `None`,
    and `total` is `None` where it models none."""

    total: Float[Array, ""] | None = eqx.field(default=None, metadata=label("W", "total"))
    inner_raceway: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "sliding on the inner raceway")
    )
    outer_raceway: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "sliding on the outer raceway")
    )
    rolling_resistance: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "rolling resistance of the raceways")
    )
    pocket: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "rollers sliding in the cage pockets")
    )
    element_ends: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "roller ends against the cage rails")
    )
    flange: Float[Array, ""] | None = eqx.field(
        default=None, metadata=label("W", "roller ends against the ring flanges")
    )
    cage_pilot: Float[Array, ""] | None = eqx.field(default=None, metadata=label("W", "cage lands on the guiding ring"))
    drag: Float[Array, ""] | None = eqx.field(default=None, metadata=label("W", "oil drag on the orbiting rollers"))


RollerSolution = Solution[Operation, RollerResults, PowerLoss]
"""Result of a steady solve of a cylindrical roller bearing."""
