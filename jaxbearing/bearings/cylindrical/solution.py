"""Results of a cylindrical roller bearing, labelled (see `solution`)."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from ..computed import computed
from ..operation import Operation
from ..solution import Solution, label

if TYPE_CHECKING:
    from .equations import AbstractLubricatedRollers, RollerState

_Values = Float[Array, " element"]


class SolvedRollers(NamedTuple):
    """Converged state of lubricated rollers."""

    system: "AbstractLubricatedRollers"
    state: "RollerState"


def _result(unit: str, description: str) -> Any:
    return eqx.field(metadata=label(unit, description))


def _optional(unit: str, description: str) -> Any:
    return eqx.field(default=None, metadata=label(unit, description))


def _computed(unit: str, description: str, of: Callable[[SolvedRollers], Array | None]) -> Any:
    """Field of `RollerResults` that the function `of` computes; `None` for dry rollers and transient runs."""
    return computed(unit, description, of, default=None)


class RollerResults(eqx.Module):
    """Results of the rollers as arrays, one value for each roller. A result that is not modelled is `None`. Speeds are
    positive in normal running."""

    azimuth: _Values = _result("rad", "azimuth from the load line")
    load_inner: _Values = _result("N", "normal load on the inner raceway")
    load_outer: _Values = _result("N", "normal load on the outer raceway")
    pressure_inner: _Values = _result("Pa", "Hertz (peak) pressure on the inner raceway")
    pressure_outer: _Values = _result("Pa", "Hertz (peak) pressure on the outer raceway")
    orbital_speed: _Values = _result("rad/s", "speed of the roller centre about the bearing axis")
    spin_speed: _Values = _result("rad/s", "spin about the roller's own axis, relative to its orbit")
    film_inner: _Values | None = _optional("m", "central film on the inner raceway")
    film_outer: _Values | None = _optional("m", "central film on the outer raceway")
    film_least_inner: _Values | None = _optional("m", "thinnest central film along a roller that tilts, inner")
    film_least_outer: _Values | None = _optional("m", "thinnest central film along a roller that tilts, outer")
    temperature_rise_inner: _Values | None = _optional("K", "inlet heating, inner")
    temperature_rise_outer: _Values | None = _optional("K", "inlet heating, outer")
    sliding_inner: _Values | None = _optional("m/s", "sliding speed on the inner race")
    sliding_outer: _Values | None = _optional("m/s", "sliding speed on the outer race")
    traction_inner: _Values | None = _optional("N", "forward force by the inner race")
    traction_outer: _Values | None = _optional("N", "backward force by the outer race")
    pocket_film_front: _Values | None = _optional("m", "film in front of the roller")
    pocket_film_rear: _Values | None = _optional("m", "film behind the roller")
    pocket_load_front: _Values | None = _optional("N", "pocket load in front")
    pocket_load_rear: _Values | None = _optional("N", "pocket load behind")
    film_ratio_inner: _Values | None = _optional("1", "film over roughness (lambda), inner raceway")
    film_ratio_outer: _Values | None = _optional("1", "film over roughness (lambda), outer raceway")
    load_share_inner: _Values | None = _optional("1", "part of the load that asperities carry, inner raceway")
    load_share_outer: _Values | None = _optional("1", "part of the load that asperities carry, outer raceway")
    boundary_inner: _Values | None = _optional("N", "boundary friction along rolling, inner raceway")
    boundary_outer: _Values | None = _optional("N", "boundary friction along rolling, outer raceway")
    flash_inner: _Values | None = _optional("K", "flash temperature, inner raceway")
    flash_outer: _Values | None = _optional("K", "flash temperature, outer raceway")


_Power = Float[Array, ""]


class PowerLoss(eqx.Module):
    """Dissipated power by location, W; the entries add up to `total`. Losses that a scene does not model are `None`,
    and `total` is `None` where it models none."""

    total: _Power | None = _optional("W", "total")
    inner_raceway: _Power | None = _optional("W", "sliding on the inner raceway")
    outer_raceway: _Power | None = _optional("W", "sliding on the outer raceway")
    rolling_resistance: _Power | None = _optional("W", "rolling resistance of the raceways")
    pocket: _Power | None = _optional("W", "rollers sliding in the cage pockets")
    element_ends: _Power | None = _optional("W", "roller ends against the cage rails")
    flange: _Power | None = _optional("W", "roller ends against the ring flanges")
    cage_pilot: _Power | None = _optional("W", "cage lands on the guiding ring")
    drag: _Power | None = _optional("W", "oil drag on the orbiting rollers")


RollerSolution = Solution[Operation, RollerResults, PowerLoss]
"""Result of a steady solve of a cylindrical roller bearing."""
