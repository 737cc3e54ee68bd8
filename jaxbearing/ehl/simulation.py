"""What a scene of a line contact says about its run in time."""

import equinox as eqx

from .._scene import number, optional_number
from .._types import Scalar
from ..numerics.checks import require
from ..time_laws import AbstractTimeFactor, Steady

DEFAULT_TOLERANCE = 1e-4


class FilmSimulation(eqx.Module):
    """A run in time, from the steady film of the speed at its start.

    **Arguments:**
    - `duration`: s; `None`: it must be given with the run.
    - `speed`: entrainment speed over that of the operation, as a function of time; it may change sign.
    - `tolerance`: largest local error of the film in one step, relative.
    """

    duration: Scalar | None = optional_number()
    speed: AbstractTimeFactor = Steady()
    tolerance: Scalar = number(DEFAULT_TOLERANCE)

    def __check_init__(self):
        require("simulation", duration=(self.duration, "> 0"), tolerance=(self.tolerance, "> 0"))
