"""Settings of a line contact's transient run."""

from typing import ClassVar

from .._scene import number, optional_number
from .._types import Scalar
from ..numerics.checks import Checked
from ..time_laws import AbstractTimeFactor, Steady

DEFAULT_TOLERANCE = 1e-4


class FilmSimulation(Checked):
    """Settings of a transient run, which starts from the steady film at its initial speed.

    **Arguments:**
    - `duration`: length of the run, s; `None`: to be given to `simulate`.
    - `speed`: entrainment speed over that of the operation, as a function of time; it may change sign.
    - `tolerance`: largest local error of the film in one step, relative.
    """

    part: ClassVar[str] = "simulation"

    duration: Scalar | None = optional_number(bound="> 0", unit="s")
    speed: AbstractTimeFactor = Steady()
    tolerance: Scalar = number(DEFAULT_TOLERANCE, bound="> 0", unit="1")
