"""Results of transient runs that only the ball bearing has, with their labels (see `motion.history`)."""

from typing import ClassVar

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float

from ...motion.history import Energy, Instant
from ...solution import label
from ..solution import BallPowerLoss, BallResults
from .groove_loss import ANGLES
from .layout import BALL_STATE, GLOBAL_STATE


class LooseBallPowerLoss(BallPowerLoss):
    """Dissipated power by location, W, of a ball bearing without a cage."""

    between_balls: Float[Array, ""] | None = eqx.field(default=None, metadata=label("W", "balls sliding on each other"))


class BallInstant(Instant):
    """State and results of balls, cage and ring at one time."""

    element_state: ClassVar[tuple[str, ...]] = BALL_STATE
    cage_state: ClassVar[tuple[str, ...]] = GLOBAL_STATE
    groove_angles: ClassVar[np.ndarray] = ANGLES

    elements: BallResults
    power_loss: BallPowerLoss
    axial_load: Float[Array, ""] = eqx.field(metadata=label("N", "axial load on the inner ring"))
    moment: Float[Array, ""] = eqx.field(metadata=label("N m", "moment on the inner ring"))
    moment_lateral: Float[Array, ""] = eqx.field(metadata=label("N m", "moment on the inner ring about the load line"))
    axial_place: Float[Array, " element"] = eqx.field(
        metadata=label("m", "place of the ball along the axis, from that of a free ball")
    )
    outward_place: Float[Array, " element"] = eqx.field(
        metadata=label("m", "distance of the ball from the pitch circle, outward")
    )
    pocket_offset: Float[Array, " element"] | None = eqx.field(
        metadata=label("m", "distance of the ball from the axis of its pocket")
    )
    gap_ahead: Float[Array, " element"] | None = eqx.field(
        metadata=label("m", "gap between the ball and the next one; negative in contact")
    )
    load_ahead: Float[Array, " element"] | None = eqx.field(
        metadata=label("N", "load between the ball and the next one")
    )
    cage_axial: Float[Array, ""] | None = eqx.field(metadata=label("m", "cage centre along the axis"))
    cage_tilt: Float[Array, ""] | None = eqx.field(
        metadata=label("rad", "tilt of the cage that moves its azimuth 0 along the axis")
    )
    cage_tilt_lateral: Float[Array, ""] | None = eqx.field(
        metadata=label("rad", "tilt of the cage that moves its azimuth 90 degrees along the axis")
    )
    damping_power: Float[Array, ""] = eqx.field(
        metadata=label("W", "loss by the damping of the raceway contacts and of the ring")
    )
    orbital_slip: Float[Array, " element"] = eqx.field(
        metadata=label("1", "1 - orbital speed of the ball / that of rolling without slip at its angles and attitude")
    )
    slide_to_roll_inner: Float[Array, " element"] = eqx.field(
        metadata=label("1", "sliding along rolling over the mean speed of the surfaces, inner")
    )
    slide_to_roll_outer: Float[Array, " element"] = eqx.field(
        metadata=label("1", "sliding along rolling over the mean speed of the surfaces, outer")
    )
    sliding_power_inner: Float[Array, " element"] = eqx.field(
        metadata=label("W", "loss of the ball by sliding and spin on the inner raceway")
    )
    sliding_power_outer: Float[Array, " element"] = eqx.field(
        metadata=label("W", "loss of the ball by sliding and spin on the outer raceway")
    )
    groove_loss_inner: Float[Array, " groove_angle"] | None = eqx.field(
        metadata=label("W", "loss by sliding and spin on the inner raceway in each degree of its groove")
    )
    groove_loss_outer: Float[Array, " groove_angle"] | None = eqx.field(
        metadata=label("W", "loss by sliding and spin on the outer raceway in each degree of its groove")
    )
    pocket_power: Float[Array, " element"] | None = eqx.field(
        metadata=label("W", "loss of the ball by sliding in its pocket")
    )
    pocket_angle: Float[Array, " element"] | None = eqx.field(
        metadata=label("rad", "direction of the ball's offset in its pocket, from that of the orbit towards the axis")
    )
    land_load: Float[Array, " land"] | None = eqx.field(metadata=label("N", "load of the cage on each guiding land"))
    state_elements: Float[Array, "element_state element"] = eqx.field(
        metadata=label(
            "1", "state of the balls: orbit, spin and place in the plane of the groove, in the frame of the run"
        )
    )
    state_cage: Float[Array, " cage_state"] = eqx.field(
        metadata=label("1", "state of cage and inner ring: places, tilts and angle as lengths, and their rates")
    )


class BallEnergy(Energy):
    """Works and changes of energies over the run, J (see `energy`). The balance is `drive` + `load_on_ring` =
    `kinetic` + `dissipation` + `damping` + `pocket_films` + `raceways`; `error` is the difference of its sides over
    `drive`."""

    damping: Float[Array, ""] = eqx.field(
        metadata=label("J", "dissipated by the damping of the raceway contacts and of the ring")
    )
    raceways: Float[Array, ""] = eqx.field(
        metadata=label("J", "work against the elastic loads of the raceways, stored but for that of changing films")
    )
    raceway_elastic: Float[Array, ""] = eqx.field(metadata=label("J", "gain of elastic energy of the raceways"))
    load_on_ring: Float[Array, ""] = eqx.field(metadata=label("J", "work of the loads on the ring and of an imbalance"))
