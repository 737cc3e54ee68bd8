"""Settings of a run in time: the same for all kinds of bearings."""

from typing import ClassVar

from ..._scene import number, optional_number
from ..._types import Scalar
from ...numerics.checks import Checked
from ...numerics.integrator import SOLVERS, IntegratorOptions
from ...numerics.structure import choice
from ...time_laws import AbstractTimeFactor, RotatingLoad, Steady

DEFAULT_SOLVER = "tsit5"
DEFAULT_TOLERANCE = 1e-5


class Simulation(Checked):
    """A run in time, from the quasi-static state of the operating point.

    **Arguments:**
    - `duration`: s; `None`: it must be given with the run.
    - `speed`: inner ring speed over that of the operating point, as a function of time.
    - `load`: radial and lateral load over those of the operating point, as a function of time.
    - `rotating_load`: a further, turning load; it frees the ring across the load line too.
    - `solver`: one of `numerics.integrator.SOLVERS`; of a run of the rollers tsit5 where not given; "auto" chooses
      between tsit5 and kvaerno5 by the stiffness that it measures.
    - `tolerance`: relative tolerance, and absolute one in the units of the state.
    - `entrainment_smoothing`: smoothing of the mean surface speed's modulus in the films of the raceways, m/s: what
      film is left where a roller's surface passes through rest.
    """

    part: ClassVar[str] = "simulation"

    duration: Scalar | None = optional_number(bound="> 0", unit="s")
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    rotating_load: RotatingLoad | None = None
    solver: str = choice("simulation.solver", SOLVERS, DEFAULT_SOLVER)
    tolerance: Scalar = number(DEFAULT_TOLERANCE, bound="> 0", unit="1")
    entrainment_smoothing: Scalar = number(0.05, bound="> 0", unit="m/s")

    @property
    def options(self) -> IntegratorOptions:
        return IntegratorOptions(solver=self.solver, tolerance=self.tolerance)
