"""Motion of the cylindrical roller bearing: implementation of the interface `motion.family`."""

from typing import ClassVar

from ....numerics.newton import NewtonOptions
from ...facts import Excess
from ...motion.family import AbstractMotion, Resumed, Start
from ...motion.history import Instant, LastState
from ...motion.settings import Simulation
from ..scene import CylindricalRollerBearing
from . import start
from .checks import run_excess
from .results import RollerInstant
from .start import QuasiStatic


class RollerMotion(AbstractMotion):
    """Motion of rollers and cage in the plane perpendicular to the axis."""

    instant: ClassVar[type[Instant]] = RollerInstant

    def require_moving(self, scene: CylindricalRollerBearing) -> None:
        start.require_moving(scene)

    def require_settings(self, scene: CylindricalRollerBearing, simulation: Simulation) -> None:
        simulation.require_no_mass()

    def quasi_static(self, scene: CylindricalRollerBearing, options: NewtonOptions | None = None) -> QuasiStatic:
        return start.quasi_static(scene, options)

    def begin(self, scene: CylindricalRollerBearing, simulation: Simulation, found: QuasiStatic) -> Start:
        return start.begin(scene, simulation, found)

    def resume(self, scene: CylindricalRollerBearing, simulation: Simulation, last: LastState) -> Resumed:
        return start.resume(scene, simulation, last)

    def range_excess(self, scene: CylindricalRollerBearing, instants: Instant) -> Excess:
        assert isinstance(instants, RollerInstant)
        return run_excess(scene, instants)
