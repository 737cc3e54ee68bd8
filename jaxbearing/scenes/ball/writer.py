"""The tables of a scene file from a ball bearing: the way back from `ball.build`."""

from ...bearings.ball.gyroscopic import CappedCouple, ResolvedCouple, SharedCouple
from ...bearings.ball.scene import BallAttitude, BallBearing
from ...contacts import PointLaws
from ...lubricants import Lubricant
from ..bearing.simulation import BallSimulationTable
from ..bearing.simulation_writer import simulation
from ..bearing.writer import bearing_tables, cage, flow_law, march_accuracy, thermal_law
from ..laws import BALL_FILMS, POINT_ROLLING, POINT_THERMAL
from ..mixed import mixed_rows
from ..part_writer import Rows, given, law_name, rows, shown, unwritable
from .schema import BallBearingTable, BallCageTable, KinematicsTable

_GYROSCOPIC = {type(None): "off", SharedCouple: "shared", CappedCouple: "capped", ResolvedCouple: "resolved"}


def ball_tables(scene: BallBearing) -> Rows:
    """The tables that describe a scene. **Raises:** `SceneError` for what a file cannot hold."""
    return bearing_tables(
        scene,
        BallBearingTable,
        contact=None if scene.contact is None else _laws(scene.contact, scene.oil),
        kinematics=_kinematics(scene.kinematics),
        cage=cage(BallCageTable, scene.cage),
        simulation=simulation(scene.simulation, BallSimulationTable),
    )


def _kinematics(part: BallAttitude) -> Rows:
    couple = part.gyroscopic
    if type(couple) not in _GYROSCOPIC:
        known = ", ".join(kind.__name__ for kind in _GYROSCOPIC if kind is not type(None))
        raise unwritable("kinematics.gyroscopic", shown(couple), f"None or one of {known}")
    entries = {"attitude": part.attitude, "gyroscopic": _GYROSCOPIC[type(couple)]}
    sign = None if not isinstance(couple, SharedCouple | CappedCouple) else {"gyroscopic_sign": int(couple.sign)}
    return entries | rows(KinematicsTable, couple) | (sign or {}) | {"orbit": part.orbit}


def _laws(contact: PointLaws, oil: Lubricant | None) -> Rows:
    traction = contact.traction
    entries = {
        "film": law_name(BALL_FILMS, contact.film, "contact.film"),
        "thermal": thermal_law(POINT_THERMAL, contact.thermal),
        "traction": None if traction is None else flow_law(traction.viscous, oil, "contact.traction.viscous"),
        "traction_accuracy": None if traction is None else march_accuracy(traction, "contact.traction", spin=True),
        "rolling_resistance": contact.rolling and law_name(POINT_ROLLING, contact.rolling, "contact.rolling"),
    }
    return given(entries) | mixed_rows(contact.mixed)
