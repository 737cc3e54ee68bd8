"""Results of a tapered roller bearing, labelled (see `solution`)."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from ..computed import computed
from ..solution import Solution, label
from .scene import TaperedOperation

if TYPE_CHECKING:
    from .friction import TaperedFriction
    from .system import TaperedState, TaperedSystem

_Values = Float[Array, " element"]


class SolvedTapered(NamedTuple):
    """Converged state of the rollers. **Arguments:** `place`: displacements of the rollers along and across their
    axis, m, and their tilts, rad; `friction`: friction of the bearing, `None` for dry rollers."""

    system: "TaperedSystem"
    state: "TaperedState"
    place: Float[Array, "3 roller"]
    friction: "TaperedFriction | None"


def _result(unit: str, description: str) -> Any:
    return eqx.field(metadata=label(unit, description))


def _computed(unit: str, description: str, of: Callable[[SolvedTapered], Array | None], **default: None) -> Any:
    return computed(unit, description, of, **default)


def _optional(unit: str, description: str) -> Any:
    return eqx.field(default=None, metadata=label(unit, description))


class TaperedResults(eqx.Module):
    """Results of the rollers as arrays, one value for each roller. A result that is not modelled is `None`. Films of
    contacts without load are NaN, and so are tractions of raceway contacts without load. Speeds are positive in normal
    running."""

    azimuth: _Values = _result("rad", "azimuth from the load line")
    load_inner: _Values = _result("N", "normal load on the inner raceway")
    load_outer: _Values = _result("N", "normal load on the outer raceway")
    load_flange: _Values = _result("N", "normal load of the roller end on the rib")
    contact_angle_inner: _Values = _result("rad", "half angle of the cone")
    contact_angle_outer: _Values = _result("rad", "half angle of the cup")
    pressure_inner: _Values = _result("Pa", "Hertz (peak) pressure on the inner raceway")
    pressure_outer: _Values = _result("Pa", "Hertz (peak) pressure on the outer raceway")
    pressure_flange: _Values = _result("Pa", "Hertz (peak) pressure on the rib")
    orbital_speed: _Values = _result("rad/s", "speed of the roller centre about the bearing axis")
    spin_speed: _Values = _result("rad/s", "spin about the roller's own axis, relative to its orbit")
    roller_shift: _Values = _computed(
        "m", "displacement of the big end along the roller axis, towards the small end", lambda at: at.place[0]
    )
    roller_lift: _Values = _computed(
        "m", "displacement of the big end across the roller axis, outwards", lambda at: at.place[1]
    )
    roller_tilt: _Values = _computed("rad", "tilt of the roller, small end outwards", lambda at: at.place[2])
    film_inner: _Values | None = _optional("m", "central film on the inner raceway, at mid length")
    film_outer: _Values | None = _optional("m", "central film on the outer raceway, at mid length")
    film_flange: _Values | None = _optional("m", "central film on the rib")
    temperature_rise_inner: _Values | None = _optional("K", "inlet heating, inner")
    temperature_rise_outer: _Values | None = _optional("K", "inlet heating, outer")
    temperature_rise_flange: _Values | None = _optional("K", "inlet heating, rib")
    sliding_flange: _Values | None = _optional("m/s", "speed of the rib over the roller end")
    spin_flange: _Values | None = _optional("rad/s", "spin of the rib over the roller end about the normal")
    sliding_inner: _Values | None = _optional("m/s", "sliding speed on the inner race, at mid length")
    sliding_outer: _Values | None = _optional("m/s", "sliding speed on the outer race, at mid length")
    traction_inner: _Values | None = _optional("N", "forward force by the inner race")
    traction_outer: _Values | None = _optional("N", "backward force by the outer race")
    traction_flange: _Values | None = _optional("N", "forward force by the rib")
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
    film_ratio_flange: _Values | None = _optional("1", "film over roughness (lambda), rib")
    load_share_flange: _Values | None = _optional("1", "part of the load that asperities carry, rib")
    boundary_flange: _Values | None = _optional("N", "boundary friction around the bearing, rib")
    flash_flange: _Values | None = _optional("K", "flash temperature, rib")


_Power = Float[Array, ""]


class TaperedPowerLoss(eqx.Module):
    """Dissipated power by location, W; the entries add up to `total`. Losses that a scene does not model are `None`,
    and `total` is `None` where it models none."""

    total: _Power | None = _optional("W", "total")
    inner_raceway: _Power | None = _optional("W", "sliding on the inner raceway")
    outer_raceway: _Power | None = _optional("W", "sliding on the outer raceway")
    rolling_resistance: _Power | None = _optional("W", "rolling resistance of the raceways")
    pocket: _Power | None = _optional("W", "rollers sliding in the cage pockets")
    flange: _Power | None = _optional("W", "roller ends sliding on the rib")
    cage_pilot: _Power | None = _optional("W", "cage lands on the guiding ring")
    drag: _Power | None = _optional("W", "oil drag on the orbiting rollers")


TaperedSolution = Solution[TaperedOperation, TaperedResults, TaperedPowerLoss]
"""Result of a steady solve of a tapered roller bearing."""
