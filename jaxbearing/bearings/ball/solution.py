"""Results of a ball bearing with their labels (see `bearings.solution`)."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from ..computed import computed
from ..solution import Solution, label
from .scene import BallOperation

if TYPE_CHECKING:
    from .core import BallCore, BallState
    from .equations import AbstractBallEquations
    from .state import BallsState

_Values = Float[Array, " element"]


class SolvedBalls(NamedTuple):
    """Converged state of the balls.

    **Arguments:** `system`: the equations; `state`: the state of the balls; `films`: the same state if the balls are
    lubricated, else `None`."""

    system: "BallCore | AbstractBallEquations"
    state: "BallState | BallsState"
    films: "BallsState | None" = None

    @property
    def angle(self) -> tuple[Array, Array]:
        """Contact angles at the inner and the outer race, rad; on rings with two arcs, those of the flanks for thrust
        along +e_x."""
        return self.state.angle[0], self.state.angle[self.system.arcs.first_outer]


def _result(unit: str, description: str) -> Any:
    return eqx.field(metadata=label(unit, description))


def _between_races(of: Callable[[SolvedBalls], Array]) -> Callable[[SolvedBalls], Array | None]:
    """A result about race control, which is defined only for balls with two contacts (else `None`)."""
    return lambda at: of(at) if at.system.arcs.single else None


def _computed(unit: str, description: str, of: Callable[[SolvedBalls], Array | None], **default: None) -> Any:
    return computed(unit, description, of, **default)


def _optional(unit: str, description: str) -> Any:
    return eqx.field(default=None, metadata=label(unit, description))


class BallResults(eqx.Module):
    """Results at the balls, as arrays over the balls; results that are not modelled are `None`. Speeds are positive in
    normal running. For a ring with two groove arcs, the results of the contacts are those of the flank for thrust along
    +e_x; fields with `_second` in their name hold those of the other flank."""

    azimuth: _Values = _result("rad", "azimuth from the load line")
    load_inner: _Values = _result("N", "normal load on the inner raceway")
    load_outer: _Values = _result("N", "normal load on the outer raceway")
    contact_angle_inner: _Values = _result("rad", "contact angle, inner")
    contact_angle_outer: _Values = _result("rad", "contact angle, outer")
    pressure_inner: _Values = _result("Pa", "Hertz (peak) pressure on the inner raceway")
    pressure_outer: _Values = _result("Pa", "Hertz (peak) pressure on the outer raceway")
    orbital_speed: _Values = _result("rad/s", "speed of the ball centre about the bearing axis")
    spin_speed: _Values = _result("rad/s", "spin of the ball, relative to its orbit")
    attitude_angle: _Values = _result("rad", "attitude of the spin, beta")
    raceway_control: _Values | None = _computed(
        "percent",
        "100: outer race control, 0: inner race control",
        _between_races(lambda at: at.system.kinematics.raceway_control(*at.angle, at.state.motion.attitude)),
    )
    control_angle_inner: _Values | None = _computed(
        "rad",
        "attitude of the spin under inner race control, beta_i",
        _between_races(lambda at: at.system.kinematics.inner_control(at.angle[0])),
    )
    control_angle_outer: _Values | None = _computed(
        "rad",
        "attitude of the spin under outer race control, beta_o",
        _between_races(lambda at: at.system.kinematics.outer_control(at.angle[1])),
    )
    centrifugal_force: _Values = _computed(
        "N", "centrifugal force on the ball", lambda at: at.system.centrifugal(at.state.motion.orbital_speed)
    )
    gyroscopic_couple: _Values = _computed(
        "N m",
        "gyroscopic couple of the ball, carried where the scene says by what",
        lambda at: at.system.couple(at.state.motion),
    )
    spin_to_roll_inner: _Values = _result("1", "spin about the contact normal over roll, inner")
    spin_to_roll_outer: _Values = _result("1", "spin about the contact normal over roll, outer")
    gyroscopic_limit: _Values | None = _optional(
        "N m", "gyroscopic couple that friction (0.05 of the loads) could carry, where the scene leaves the couple out"
    )
    transverse_spin: _Values | None = _optional(
        "rad/s", "spin about the tangent of the orbit, of the gyroscopic couple"
    )
    film_inner: _Values | None = _optional("m", "central film on the inner raceway")
    film_outer: _Values | None = _optional("m", "central film on the outer raceway")
    temperature_rise_inner: _Values | None = _optional("K", "inlet heating, inner")
    temperature_rise_outer: _Values | None = _optional("K", "inlet heating, outer")
    sliding_inner: _Values | None = _optional("m/s", "sliding along rolling, inner")
    sliding_outer: _Values | None = _optional("m/s", "sliding along rolling, outer")
    traction_inner: _Values | None = _optional("N", "force of the inner race on the ball along the orbit")
    traction_outer: _Values | None = _optional("N", "force of the outer race on the ball along the orbit")
    spin_moment_inner: _Values | None = _optional("N m", "moment that brakes the spin, inner")
    spin_moment_outer: _Values | None = _optional("N m", "moment that brakes the spin, outer")
    pocket_film_front: _Values | None = _optional("m", "film in front of the ball")
    pocket_film_rear: _Values | None = _optional("m", "film behind the ball")
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
    load_inner_second: _Values | None = _optional("N", "normal load on the second flank of the inner raceway")
    load_outer_second: _Values | None = _optional("N", "normal load on the second flank of the outer raceway")
    contact_angle_inner_second: _Values | None = _optional("rad", "contact angle on the second flank, inner")
    contact_angle_outer_second: _Values | None = _optional("rad", "contact angle on the second flank, outer")
    pressure_inner_second: _Values | None = _optional("Pa", "Hertz (peak) pressure on the second flank, inner raceway")
    pressure_outer_second: _Values | None = _optional("Pa", "Hertz (peak) pressure on the second flank, outer raceway")
    spin_to_roll_inner_second: _Values | None = _optional(
        "1", "spin about the contact normal over roll on the second flank, inner"
    )
    spin_to_roll_outer_second: _Values | None = _optional(
        "1", "spin about the contact normal over roll on the second flank, outer"
    )
    film_inner_second: _Values | None = _optional("m", "central film on the second flank of the inner raceway")
    film_outer_second: _Values | None = _optional("m", "central film on the second flank of the outer raceway")
    temperature_rise_inner_second: _Values | None = _optional("K", "inlet heating on the second flank, inner")
    temperature_rise_outer_second: _Values | None = _optional("K", "inlet heating on the second flank, outer")
    sliding_inner_second: _Values | None = _optional("m/s", "sliding along rolling on the second flank, inner")
    sliding_outer_second: _Values | None = _optional("m/s", "sliding along rolling on the second flank, outer")
    traction_inner_second: _Values | None = _optional(
        "N", "force of the second flank of the inner race on the ball along the orbit"
    )
    traction_outer_second: _Values | None = _optional(
        "N", "force of the second flank of the outer race on the ball along the orbit"
    )
    spin_moment_inner_second: _Values | None = _optional(
        "N m", "moment that brakes the spin on the second flank, inner"
    )
    spin_moment_outer_second: _Values | None = _optional(
        "N m", "moment that brakes the spin on the second flank, outer"
    )
    film_ratio_inner_second: _Values | None = _optional(
        "1", "film over roughness (lambda), second flank of the inner raceway"
    )
    film_ratio_outer_second: _Values | None = _optional(
        "1", "film over roughness (lambda), second flank of the outer raceway"
    )
    load_share_inner_second: _Values | None = _optional(
        "1", "part of the load that asperities carry, second flank of the inner raceway"
    )
    load_share_outer_second: _Values | None = _optional(
        "1", "part of the load that asperities carry, second flank of the outer raceway"
    )
    boundary_inner_second: _Values | None = _optional(
        "N", "boundary friction along rolling, second flank of the inner raceway"
    )
    boundary_outer_second: _Values | None = _optional(
        "N", "boundary friction along rolling, second flank of the outer raceway"
    )
    flash_inner_second: _Values | None = _optional("K", "flash temperature, second flank of the inner raceway")
    flash_outer_second: _Values | None = _optional("K", "flash temperature, second flank of the outer raceway")
    loaded_contacts: _Values | None = _optional("1", "contacts of the ball that carry load")


_Power = Float[Array, ""]


class BallPowerLoss(eqx.Module):
    """Dissipated power by location, W; the entries add up to `total`. Losses that the scene does not model are `None`;
    if it models none, `total` is `None` too."""

    total: _Power | None = _optional("W", "total")
    inner_raceway: _Power | None = _optional("W", "sliding and spin on the inner raceway")
    outer_raceway: _Power | None = _optional("W", "sliding and spin on the outer raceway")
    rolling_resistance: _Power | None = _optional("W", "rolling resistance of the raceways")
    pocket: _Power | None = _optional("W", "balls sliding in the cage pockets")
    cage_pilot: _Power | None = _optional("W", "cage lands on the guiding ring")
    drag: _Power | None = _optional("W", "oil drag on the orbiting balls")


BallSolution = Solution[BallOperation, BallResults, BallPowerLoss]
"""Result of a steady solve of a ball bearing."""
