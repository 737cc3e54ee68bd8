"""Results of a transient run that only cylindrical roller bearings have (see `motion.history`)."""

from typing import ClassVar

import equinox as eqx
from jaxtyping import Array, Float

from ...motion.history import Energy, Instant
from ...solution import label
from ..solution import PowerLoss, RollerResults

ELEMENT_STATE = ("q", "v", "u")
"""Components of a roller's state: position along the pitch circle, m, and its rate, m/s, both in the frame of the run;
surface speed of the spin, m/s."""
CAGE_STATE = ("x", "y", "q", "v_x", "v_y", "v")
"""Components of the cage's state: centre (x, y) and angle times pitch radius (q), m, and their rates, m/s."""


class RollerInstant(Instant):
    """State and results of the rollers and the cage at one instant."""

    element_state: ClassVar[tuple[str, ...]] = ELEMENT_STATE
    cage_state: ClassVar[tuple[str, ...]] = CAGE_STATE

    elements: RollerResults
    power_loss: PowerLoss
    state_elements: Float[Array, "element_state element"] = eqx.field(
        metadata=label("1", "state of the rolling elements: position, orbital and spin speed in the frame of the run")
    )
    state_cage: Float[Array, " cage_state"] = eqx.field(
        metadata=label(
            "1", "state of the cage: x, y, angle times pitch radius in the frame of the run, and their rates"
        )
    )


class RollerEnergy(Energy):
    """Works and energies over the run, J (see `energy`). `drive` = `kinetic` + `dissipation` + `pocket_films` +
    `lever_arm`, up to the relative `error`. `load_on_ring` is not part of this balance: the radial direction is
    quasi-static and has a balance of its own."""

    lever_arm: Float[Array, ""] = eqx.field(
        metadata=label(
            "J", "neglected by the model: moment of the pocket loads about the cage's centre, not the bearing's"
        )
    )
    raceway_elastic: Float[Array, ""] = eqx.field(metadata=label("J", "gain of elastic energy of the raceways"))
    load_on_ring: Float[Array, ""] = eqx.field(metadata=label("J", "work of the radial load on the ring"))
