"""Transient runs of the ball bearing, with the interface of `motion.family`."""

from typing import ClassVar

from ....numerics.newton import NewtonOptions
from ...facts import Excess
from ...motion.family import AbstractMotion, Resumed, Start
from ...motion.history import Instant, LastState
from ...motion.settings import Simulation
from ..scene import BallBearing
from . import start
from .checks import run_excess
from .results import BallInstant
from .start import QuasiStatic


class BallBearingMotion(AbstractMotion):
    """Motion of balls, cage and inner ring in three dimensions."""

    instant: ClassVar[type[Instant]] = BallInstant

    def require_moving(self, scene: BallBearing) -> None:
        start.require_moving(scene)

    def require_settings(self, scene: BallBearing, simulation: Simulation) -> None:
        start.require_mass(scene, simulation)
        start.require_explicit(scene, simulation)

    def quasi_static(self, scene: BallBearing, options: NewtonOptions | None = None) -> QuasiStatic:
        return start.quasi_static(scene, options)

    def begin(self, scene: BallBearing, simulation: Simulation, found: QuasiStatic) -> Start:
        return start.begin(scene, simulation, found)

    def resume(self, scene: BallBearing, simulation: Simulation, last: LastState) -> Resumed:
        return start.resume(scene, simulation, last)

    def range_excess(self, scene: BallBearing, instants: Instant) -> Excess:
        assert isinstance(instants, BallInstant)
        return run_excess(scene, instants)
