"""Results of a transient run that only the cylindrical roller bearing has, labelled (see `motion.history`)."""

from typing import ClassVar

import equinox as eqx
from jaxtyping import Array, Float

from ...motion.history import Energy, Instant
from ...solution import label
from ..solution import PowerLoss, RollerResults

ELEMENT_STATE = ("q", "v", "u")
"""Components of a roller's state: position along the pitch circle, m, its speed and that of the spin, m/s."""
CAGE_STATE = ("x", "y", "q", "v_x", "v_y", "v")
"""Components of the cage's state: centre and angle times pitch radius, m, and their rates, m/s."""


class RollerInstant(Instant):
    """State and results of rollers and cage at one time."""

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
    `lever_arm`, up to `error`; `load_on_ring` is balanced within the raceways, which are quasi-static."""

    lever_arm: Float[Array, ""] = eqx.field(
        metadata=label(
            "J", "neglected by the model: moment of the pocket loads about the cage's centre, not the bearing's"
        )
    )
    raceway_elastic: Float[Array, ""] = eqx.field(metadata=label("J", "gain of elastic energy of the raceways"))
    load_on_ring: Float[Array, ""] = eqx.field(metadata=label("J", "work of the radial load on the ring"))
