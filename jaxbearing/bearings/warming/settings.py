"""Settings of a transient run of the temperatures of a bearing, for all families."""

from typing import TYPE_CHECKING, ClassVar

import jax.numpy as jnp

from ..._scene import label, number, optional_number
from ..._types import Scalar
from ...numerics.checks import Checked
from ...numerics.integrator import IntegratorOptions
from ...numerics.structure import choice, count
from ...time_laws import AbstractTimeFactor, Steady
from ..heat import inlet_temperature, thermal_of
from ..operation import LOAD_FIELDS

if TYPE_CHECKING:
    from ..bearing import AbstractBearing

SOLVERS = ("kvaerno3", "kvaerno4", "kvaerno5")
"""Integration methods for runs of temperatures, whose equations are stiff."""
SOLVER = "kvaerno5"
"""Default integration method."""
INSTANTS = 192
"""Default number of instants of a run."""
MOST_INSTANTS = 100_000
"""Largest number of instants of a run."""


class WarmUpSimulation(Checked):
    """A transient run of the temperatures.

    **Arguments:**
    - `duration`: duration of the run, which must be passed with the run if it is not given here, s.
    - `speed`: speeds of both rings over those of the operating point, as a function of time; not 0 at time 0.
    - `load`: all loads and moments over those of the operating point, as a function of time.
    - `oil_inlet`: temperature difference between entering oil and ambient over that of the operating point, as a
      function of time. 0 means oil at the ambient temperature.
    - `oil_flow`: oil flow over that of the operating point, as a function of time. The heat capacity of the oil in the
      bearing remains that of the operating point.
    - `start`: temperature of all nodes at time 0, K; by default the ambient temperature.
    - `instants`: number of instants of a run of temperatures after the first one, if no interval is given.
    - `solver`: one of kvaerno3, kvaerno4 and kvaerno5.
    - `tolerance`: relative tolerance, also the absolute tolerance in units of 1 K and 1 kJ.
    """

    part: ClassVar[str] = "simulation"

    duration: Scalar | None = optional_number(bound="> 0", unit="s")
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    oil_inlet: AbstractTimeFactor = Steady()
    oil_flow: AbstractTimeFactor = Steady()
    start: Scalar | None = optional_number(
        bound="> 0", metadata=label("K", "temperature of all nodes at time 0 of a run of temperatures")
    )
    instants: int = count("simulation.instants", INSTANTS, least=1, most=MOST_INSTANTS)
    solver: str = choice("simulation.solver", SOLVERS, SOLVER)
    tolerance: Scalar = number(1e-5, bound="> 0", unit="1")

    @property
    def options(self) -> IntegratorOptions:
        from ...thermal.warming_up import usual_options  # imports diffrax, which scenes do without

        usual = usual_options()
        return IntegratorOptions(
            solver=self.solver,
            tolerance=self.tolerance,
            max_steps=usual.max_steps,
            shortest_step=usual.shortest_step,
        )

    @property
    def laws(self) -> tuple[AbstractTimeFactor, ...]:
        """All functions of time."""
        return self.speed, self.load, self.oil_inlet, self.oil_flow


def at_instant(scene: "AbstractBearing", settings: WarmUpSimulation, time: Scalar) -> "AbstractBearing":
    """The scene with its speeds, loads and oil at a time, s. Inputs that do not change keep their exact values."""
    operation, thermal = scene.operation, thermal_of(scene)
    changes: dict[str, Scalar] = {}
    if not isinstance(settings.speed, Steady):
        factor = settings.speed.factor(time)
        changes |= {f"operation.{name}": factor * getattr(operation, name) for name in ("inner_speed", "outer_speed")}
    if not isinstance(settings.load, Steady):
        factor = settings.load.factor(time)
        loads = {name: getattr(operation, name) for name in LOAD_FIELDS.values()}
        changes |= {f"operation.{name}": factor * load for name, load in loads.items() if load is not None}
    if not isinstance(settings.oil_flow, Steady):
        changes["operation.oil_flow"] = settings.oil_flow.factor(time) * operation.oil_flow
    if not isinstance(settings.oil_inlet, Steady):
        warmer = jnp.asarray(inlet_temperature(scene)) - thermal.ambient
        changes["thermal.oil_inlet"] = thermal.ambient + settings.oil_inlet.factor(time) * warmer
    return scene.replace(changes) if changes else scene
