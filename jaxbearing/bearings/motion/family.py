"""Interface of a family of bearings in motion: its equations of motion, and the way from a scene to them.

A family that moves has a scene that derives from `AbstractMovingBearing` and a folder with two classes: one of
equations of motion (`AbstractDynamics`) and one that makes them from a scene (`AbstractMotion`). Integration, restart,
batches, history and files are those of this folder, for every family. An *instant* holds all results of a run at one
time. A function is *pure* if JAX can transform it: its result depends on its arguments alone.
"""

import abc
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float, Int

from ..._scene import AbstractHistory
from ..._types import Scalar
from ...materials import CATALOGUE
from ...numerics.arrow import ArrowPoint
from ...numerics.newton import NewtonOptions
from ..bearing import AbstractBearing
from ..cage import ASSUMED_MATERIAL
from ..cage_stress import CageSection, cage_section
from ..facts import Excess
from .history import Energy, History, Instant, LastState, PocketPeaks
from .settings import Simulation


class AbstractDynamics(eqx.Module):
    """Equations of motion of one bearing.

    The state is an `ArrowPoint` in units of the family, in which one tolerance serves for all components. Its last
    globals are the works of the energy balance, which nothing depends on. Positions are counted in a frame that turns
    with the elements, so that they stay small and are resolved.
    """

    works: ClassVar[tuple[str, ...]]
    """Names of the works, integrals of power over time in J, that are integrated beside the motion, in their order in
    the state."""
    reference_speed: eqx.AbstractVar[Float[Array, ""]]
    """Speed of the frame at the operating point, rad/s."""

    @abc.abstractmethod
    def nested_rates(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint, tolerance: Scalar
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """Rates of the state, 1/s, and the solution of the equations that are solved inside them.

        The solution must follow time smoothly: the integrator extrapolates it to the next `guess`. A family without
        equations inside its rates returns an empty point. NaN rates make the integrator shorten its step.

        **Arguments:** `time`, s; `guess`: of the solution; `tolerance`: of the integration.
        """

    @abc.abstractmethod
    def first_guess(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """The argument `guess` of `nested_rates` for a state that nothing is known about."""

    @abc.abstractmethod
    def observe(self, time: Scalar, state: ArrowPoint) -> Instant:
        """All results at one time, s; pure."""

    def peaks(self, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks | None:
        """Largest pocket loads in each interval between two instants, for shocks that last less than an interval.

        **Arguments:** `times`, s, within each interval; `states`: at these times, with `interval * part` in front.

        **Returns:** arrays of shape (interval, element); `None` if the elements do not meet a cage.
        """
        return None

    @abc.abstractmethod
    def energy(self, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
        """Works from the start of the run up to a state, J, and what their balance leaves open.

        **Arguments:** `first`, `last`: the instants of the start and of the state.
        """


class Start(NamedTuple):
    """Equations of motion and state at time 0. `status` and `residual` are those of the quasi-static solve from which
    the state follows."""

    dynamics: AbstractDynamics
    state: ArrowPoint
    status: Int[Array, ""]
    residual: Float[Array, ""]


class Resumed(NamedTuple):
    """Equations of motion, and the state that an earlier run ended with."""

    dynamics: AbstractDynamics
    state: ArrowPoint


class AbstractMotion(abc.ABC):
    """The way from the scene of a family to its equations of motion; it holds no numbers."""

    instant: ClassVar[type[Instant]]
    """Class of the instants; it names the components of the states. The first one of a rolling element is its
    position along the pitch circle, m."""

    @abc.abstractmethod
    def require_moving(self, scene: Any) -> None:
        """**Raises:** `ValueError` for a scene whose rolling elements nothing drives."""

    def require_settings(self, scene: Any, simulation: Simulation) -> None:
        """Checks the settings before anything is solved. Here all are accepted; families override it.

        **Raises:** `ValueError` if a setting is missing or does not belong to the scene.
        """
        return

    @abc.abstractmethod
    def quasi_static(self, scene: Any, options: NewtonOptions | None = None) -> Any:
        """Steady state of the operating point, as places and speeds of elements and cage, with a `status`; pure."""

    @abc.abstractmethod
    def begin(self, scene: Any, simulation: Simulation, found: Any) -> Start:
        """The equations of motion and the state that a run begins with; pure.

        **Arguments:** `found`: the result of `quasi_static` for the speed and the loads of time 0.
        """

    @abc.abstractmethod
    def resume(self, scene: Any, simulation: Simulation, last: LastState) -> Resumed:
        """The equations of motion and the state that an earlier run ended with; pure.

        Speeds and loads over time may differ from those of the earlier run; places and speeds of the elements are
        continuous all the same.
        """

    @abc.abstractmethod
    def range_excess(self, scene: Any, instants: Instant) -> Excess:
        """Excess of the results of a run over the ranges of laws and bearings; pure.

        **Arguments:** `instants`: of a run or of a piece of it, with the times in front of every array.

        **Returns:** text -> the largest number of all instants, positive where the check applies.
        """


class AbstractMovingBearing(AbstractBearing):
    """Base of the bearings whose rolling elements `jaxbearing.simulate` moves in time."""

    runs_in_programs: ClassVar[bool] = True
    loads_over_time: ClassVar[tuple[str, ...]] = ("radial_load", "radial_load_lateral")
    """Fields of the operating point that `Simulation.load` multiplies."""

    cage: eqx.AbstractVar[Any]
    geometry: eqx.AbstractVar[Any]
    materials: eqx.AbstractVar[Any]
    simulation: eqx.AbstractVar[Any]

    @property
    @abc.abstractmethod
    def motion(self) -> AbstractMotion:
        """The object that makes the equations of motion of the family from a scene."""

    @property
    def cage_section(self) -> CageSection | None:
        """The section of the cage, for its stresses; `None` without a cage."""
        if self.cage is None:
            return None
        solid = self.materials.cage or CATALOGUE[ASSUMED_MATERIAL]
        return cage_section(self.cage, self.geometry, solid.density)

    def simulated(self, duration: float | None, **settings: Any) -> AbstractHistory:
        if self.thermal is not None:
            return super().simulated(duration, **settings)
        from .runs import simulate_bearing

        return simulate_bearing(self, duration, **settings)

    def simulated_batch(self, duration: float, over: Mapping[str, object], **settings: Any) -> History:
        from .batch import simulate_bearing_batch

        return simulate_bearing_batch(self, duration, over, **settings)

    def check_restart(self, restart: object, duration: float | None = None) -> None:
        if self.thermal is not None:
            super().check_restart(restart, duration)
            return
        from .run import check_fits

        check_fits(self, restart)
