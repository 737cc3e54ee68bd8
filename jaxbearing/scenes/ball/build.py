"""Builds the scene of a ball bearing from its valid table. Only Python and numpy numbers enter the constructors:
nothing runs on JAX."""

from functools import cache

from ...bearings.ball.geometry import BallGeometry
from ...bearings.ball.gyroscopic import AbstractGyroscopic, CappedCouple, ResolvedCouple, SharedCouple
from ...bearings.ball.scene import (
    BallAttitude,
    BallBearing,
    BallCage,
    BallDragSettings,
    BallMaterials,
    BallOperation,
)
from ...bearings.motion.settings import Simulation
from ...bearings.operation import LOAD_FIELDS
from ...bearings.rating import Rating
from ...bearings.warming.settings import WarmUpSimulation
from ...contacts import PointLaws, Supply
from ...lubricants import Lubricant
from ..bearing.build import built, cage, laws_of, part, seats, shapes, solids
from ..bearing.simulation import simulation, warm_up
from ..laws import BALL_FILMS, POINT_ROLLING, distributed_traction, thermal_factor
from ..mixed import mixed_friction
from ..oil.catalogue import lubricant
from .schema import BallBearingTable, BallContactTable, KinematicsTable


def ball_bearing(table: BallBearingTable) -> BallBearing:
    """The scene that a table describes.

    **Raises:** `ValueError` for combinations that the classes refuse.
    """
    oil = cache(lambda: None if table.oil is None else lubricant(table.oil))
    slips = lambda: table.contact is not None and table.contact.traction is not None
    return built(
        BallBearing,
        geometry=lambda: BallGeometry(**table.geometry.model_dump()),
        materials=lambda: BallMaterials(**solids(table, "rings", "balls", "cage", "inner_ring")),
        operation=lambda: BallOperation(**table.operation.model_dump(exclude_none=True)),
        kinematics=lambda: _kinematics(
            table.kinematics, slips(), table.geometry.shim_inner is not None or table.geometry.shim_outer is not None
        ),
        oil=oil,
        contact=lambda: None if table.contact is None else _laws(table.contact, oil()),
        cage=lambda: cage(BallCage, table.cage),
        drag=lambda: part(BallDragSettings, table.drag),
        rating=lambda: part(Rating, table.rating),
        **seats(table),
        **shapes(table),
        simulation=lambda: _run(table),
    )


def _run(table: BallBearingTable) -> Simulation | WarmUpSimulation | None:
    if table.simulation is None:
        return None
    if table.thermal is not None:
        return warm_up(table)
    loads = [load for load in map(table.operation.model_dump().get, LOAD_FIELDS.values()) if load]
    # a single load can be given over time by its values, several loads only by factors
    return simulation(table.simulation, table.operation.inner_speed, loads[0] if len(loads) == 1 else 0.0)


def _kinematics(table: KinematicsTable | None, slips: bool, arcs: bool) -> BallAttitude:
    """The attitude of the balls. Without a name in the table: equilibrium with traction; without traction outer race
    control, or the least sliding under linear traction if a ring has two groove arcs (`arcs`)."""
    attitude = None if table is None else table.attitude
    if attitude is None:
        attitude = "equilibrium" if slips else "linear_slip" if arcs else "outer"
    if table is None:
        return BallAttitude(attitude)
    return BallAttitude(attitude, _gyroscopic(table, attitude), table.orbit)


def _gyroscopic(table: KinematicsTable, attitude: str) -> AbstractGyroscopic | ResolvedCouple | None:
    """Model of the gyroscopic couple for an attitude of the balls."""
    sign = 1.0 if table.gyroscopic_sign is None else table.gyroscopic_sign
    match table.gyroscopic:
        case "shared":
            # under outer race control the outer race carries the whole couple (source eqs. (14)-(15))
            inner = 0.0 if attitude == "outer" else 1.0
            if table.inner_share is not None:
                inner = table.inner_share
            elif table.outer_share is not None:
                inner = 2.0 - table.outer_share
            return SharedCouple(inner, 2.0 - inner if table.outer_share is None else table.outer_share, sign)
        case "capped" if table.gyroscopic_friction is None:
            return CappedCouple(sign=sign)
        case "capped":
            return CappedCouple(table.gyroscopic_friction, sign)
        case "resolved":
            return ResolvedCouple()
    return None


def _laws(table: BallContactTable, oil: Lubricant | None) -> PointLaws:
    traction = None
    if table.traction is not None:
        traction = distributed_traction(table.traction, table.traction_accuracy, oil, spin=True)
    return laws_of(
        PointLaws,
        BallContactTable,
        table,
        film=BALL_FILMS[table.film](),
        thermal=thermal_factor(table.thermal),
        traction=traction,
        rolling=None if table.rolling_resistance is None else POINT_ROLLING[table.rolling_resistance](),
        supply=part(Supply, table.supply, exclude_none=True),
        mixed=mixed_friction(table.mixed),
    )
