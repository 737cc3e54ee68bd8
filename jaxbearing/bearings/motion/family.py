"""Interface of a bearing family with transient runs: its equations of motion, and how they are made from a scene.

Such a family has a scene class derived from `AbstractMovingBearing`, a class of its equations of motion
(`AbstractDynamics`) and a class that makes these from a scene (`AbstractMotion`). Integration, restart, batches,
history and files are common to all families and are in this folder. An *instant* holds all results of a run at one
time. A function is *pure* if JAX can transform it: its result depends on its arguments alone.
"""

import abc
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import equinox as eqx
from jaxtyping import Array, Float, Int

from ..._scene import AbstractHistory
from ..._solvers import MOVING_BEARING, solver
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

    The state is an `ArrowPoint`, scaled by the family so that one tolerance suits all components. Its last globals are
    the works of the energy balance; the motion does not depend on them. Positions are measured in a frame that turns
    with the elements, so that they stay small and lose no digits.
    """

    works: ClassVar[tuple[str, ...]]
    """Names of the works, J, that are integrated along with the motion, in their order in the state. A work is the
    integral of a power over time."""
    reference_speed: eqx.AbstractVar[Float[Array, ""]]
    """Speed of the frame at the operating point, rad/s."""

    @abc.abstractmethod
    def nested_rates(
        self, time: Scalar, state: ArrowPoint, guess: ArrowPoint, tolerance: Scalar
    ) -> tuple[ArrowPoint, ArrowPoint]:
        """Rates of the state, 1/s, and the solution of the nested equations that must be solved to compute them.

        The solution must be smooth in time: the integrator extrapolates it to the next `guess`. A family without nested
        equations returns an empty point. NaN rates make the integrator shorten its step.

        **Arguments:** `time`: s; `guess`: first guess of the solution; `tolerance`: tolerance of the integration.
        """

    @abc.abstractmethod
    def first_guess(self, time: Scalar, state: ArrowPoint) -> ArrowPoint:
        """The argument `guess` of `nested_rates` for a state without a preceding solution."""

    @abc.abstractmethod
    def observe(self, time: Scalar, state: ArrowPoint) -> Instant:
        """All results at one time, s; pure."""

    def peaks(self, times: Float[Array, "interval part"], states: ArrowPoint) -> PocketPeaks | None:
        """Largest pocket loads in each interval between two instants, because a shock is shorter than an interval.

        **Arguments:** `times`: times within each interval, s; `states`: states at these times, with one first axis of
        length interval * part.

        **Returns:** arrays of shape (interval, element); `None` if there is no cage.
        """
        return None

    @abc.abstractmethod
    def energy(self, state: ArrowPoint, first: Instant, last: Instant) -> Energy:
        """Works from the start of the run up to a state, J, and the error of their balance.

        **Arguments:** `first`, `last`: the instants of the start and of the state.
        """


class Start(NamedTuple):
    """Equations of motion and state at time 0. `status` and `residual` belong to the quasi-static solve that gave the
    state."""

    dynamics: AbstractDynamics
    state: ArrowPoint
    status: Int[Array, ""]
    residual: Float[Array, ""]


class Resumed(NamedTuple):
    """Equations of motion, and the last state of an earlier run."""

    dynamics: AbstractDynamics
    state: ArrowPoint


class AbstractMotion(abc.ABC):
    """Makes the equations of motion of a family from a scene. Objects of this class hold no numbers."""

    instant: ClassVar[type[Instant]]
    """Class of the instants, which also names the components of the states. The first component of a rolling element is
    its position along the pitch circle, m."""

    @abc.abstractmethod
    def require_moving(self, scene: Any) -> None:
        """Checks that the rolling elements of the scene are driven.

        **Raises:** `ValueError` if nothing drives them."""

    def require_settings(self, scene: Any, simulation: Simulation) -> None:
        """Checks the settings before anything is solved. This base method accepts all settings; families override it.

        **Raises:** `ValueError` if a setting is missing or does not belong to the scene.
        """
        return

    @abc.abstractmethod
    def quasi_static(self, scene: Any, options: NewtonOptions | None = None) -> Any:
        """Steady state of the operating point: positions and speeds of elements and cage, and a `status`; pure."""

    @abc.abstractmethod
    def begin(self, scene: Any, simulation: Simulation, found: Any) -> Start:
        """The equations of motion and the initial state of a run; pure.

        **Arguments:** `found`: result of `quasi_static` for the speed and the loads at time 0.
        """

    @abc.abstractmethod
    def resume(self, scene: Any, simulation: Simulation, last: LastState) -> Resumed:
        """The equations of motion and the initial state of a run that continues an earlier one; pure.

        Speeds and loads over time may differ from those of the earlier run; positions and speeds of the elements are
        continuous in any case.
        """

    @abc.abstractmethod
    def range_excess(self, scene: Any, instants: Instant) -> Excess:
        """Excess of the results of a run over the ranges of laws and bearings; pure.

        **Arguments:** `instants`: instants of a run or of a piece of it; the first axis of every array is time.

        **Returns:** text of a warning -> largest excess over all instants, positive if the warning applies.
        """


class AbstractMovingBearing(AbstractBearing):
    """Base of the bearings whose rolling elements can be simulated in time with `jaxbearing.simulate`."""

    runs_in_programs: ClassVar[bool] = True
    loads_over_time: ClassVar[tuple[str, ...]] = ("radial_load", "radial_load_lateral")
    """Fields of the operating point that `Simulation.load` multiplies."""

    cage: eqx.AbstractVar[Any]
    geometry: eqx.AbstractVar[Any]
    materials: eqx.AbstractVar[Any]
    simulation: eqx.AbstractVar[Any]

    @property
    def motion(self) -> AbstractMotion:
        """The object that makes the equations of motion of the family from a scene."""
        return solver(self.kind, "motion")()

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
        return solver(MOVING_BEARING, "simulated")(self, duration, **settings)

    def simulated_batch(self, duration: float, over: Mapping[str, object], **settings: Any) -> History:
        return solver(MOVING_BEARING, "simulated_batch")(self, duration, over, **settings)

    def check_restart(self, restart: object, duration: float | None = None) -> None:
        if self.thermal is not None:
            super().check_restart(restart, duration)
            return
        solver(MOVING_BEARING, "check_restart")(self, restart)
