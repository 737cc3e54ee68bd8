"""From a valid table of a ball bearing to the scene of the library. Only Python and numpy numbers enter the
constructors: nothing runs on JAX."""

from collections.abc import Callable
from typing import Any

from ..bearings.ball_bearing import (
    BallAttitude,
    BallBearing,
    BallCage,
    BallDragSettings,
    BallMaterials,
    BallOperation,
)
from ..bearings.ball_geometry import BallGeometry
from ..bearings.gyroscopic import CappedCouple, ResolvedCouple, SharedCouple
from ..contacts import PointLaws
from ..lubricants import Lubricant
from .ball_schema import BallBearingTable, BallContactTable, KinematicsTable
from .bearing_build import cage, part
from .laws import POINT_FILMS, distributed_traction, thermal_factor
from .materials import material
from .oils import lubricant

GYROSCOPIC: dict[str, Callable[[str], Any]] = {
    "off": lambda attitude: None,
    # all of it at the outer race where that controls the ball (source eqs. (14)-(15))
    "shared": lambda attitude: SharedCouple(0.0, 2.0) if attitude == "outer" else SharedCouple(),
    "capped": lambda attitude: CappedCouple(),
    "resolved": lambda attitude: ResolvedCouple(),
}
"""Name -> the law, for an attitude of the balls."""


def ball_bearing(table: BallBearingTable) -> BallBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = None if table.oil is None else lubricant(table.oil)
    contact = None if table.contact is None else _laws(table.contact, oil)
    slips = contact is not None and contact.traction is not None
    return BallBearing(
        geometry=BallGeometry(**table.geometry.model_dump()),
        materials=BallMaterials(rings=material(table.materials.rings), balls=material(table.materials.balls)),
        operation=BallOperation(**table.operation.model_dump(exclude_none=True)),
        kinematics=_kinematics(table.kinematics, slips),
        oil=oil,
        contact=contact,
        cage=cage(BallCage, table.cage),
        drag=part(BallDragSettings, table.drag),
    )


def _kinematics(table: KinematicsTable | None, slips: bool) -> BallAttitude:
    """Left out: in equilibrium with traction, without it outer race control."""
    attitude = None if table is None else table.attitude
    if attitude is None:
        attitude = "equilibrium" if slips else "outer"
    return BallAttitude(attitude, None if table is None else GYROSCOPIC[table.gyroscopic](attitude))


def _laws(table: BallContactTable, oil: Lubricant | None) -> PointLaws:
    traction = None
    if table.traction is not None:
        traction = distributed_traction(table.traction, table.traction_accuracy, oil)
    return PointLaws(
        film=POINT_FILMS[table.film](),
        thermal=thermal_factor(table.thermal),
        traction=traction,
        rolling_resistance=table.rolling_resistance is not None,
    )
