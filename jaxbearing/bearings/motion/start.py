"""Initial state of a transient run, for all families."""

import dataclasses
from typing import TypeVar

import jax.numpy as jnp

from ..._scene import only_if
from ...numerics.checks import InputChecks, check_inputs
from ...numerics.newton import NewtonOptions
from ...numerics.status import Status
from .family import AbstractMovingBearing, Start
from .settings import Simulation

Bearing = TypeVar("Bearing", bound=AbstractMovingBearing)


def at_start(scene: Bearing, simulation: Simulation) -> Bearing:
    """The scene at the speed and loads of time 0."""
    zero, operation = jnp.zeros(()), scene.operation
    factor = simulation.load.factor(zero)
    names = [name for name in scene.loads_over_time if getattr(operation, name) is not None]
    loads = {name: getattr(operation, name) * factor for name in names}
    return scene.at_operation(inner_speed=operation.inner_speed * simulation.speed.factor(zero), **loads)


def quasi_static_start(
    scene: AbstractMovingBearing, simulation: Simulation, options: NewtonOptions | None = None
) -> Start:
    """Equations of motion and initial state of a run; pure and jit-able.

    If a traced input is invalid, `status` is `INVALID_INPUT` and the state is NaN.

    **Arguments:** `simulation`: speeds and loads over time; `options`: options of the quasi-static solve.

    **Raises:** `ValueError` for a scene whose rolling elements nothing drives, or whose ring is held.
    """
    lane, inputs = checked_lane(scene, simulation)
    start = lane.motion.begin(lane, simulation, lane.motion.quasi_static(at_start(lane, simulation), options))
    return start._replace(status=jnp.where(inputs.valid, start.status, int(Status.INVALID_INPUT)))


def checked_lane(scene: Bearing, simulation: Simulation) -> tuple[Bearing, InputChecks]:
    """Checks the inputs of a scene. Returns the scene, with an operating point of NaN if traced inputs are invalid, and
    the result of the checks."""
    inputs = check_inputs(dataclasses.replace(scene, simulation=simulation))
    return only_if(scene, inputs.valid), inputs
