"""Settings of a transient run: the same for all kinds of bearings."""

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
    """A transient run, from the quasi-static state of the operating point.

    **Arguments:**
    - `duration`: s; `None`: it must be given with the run.
    - `speed`: inner ring speed over that of the operating point, as a function of time.
    - `load`: radial and lateral load over those of the operating point, as a function of time; of ball bearings all
      loads and moments.
    - `rotating_load`: a further, turning load; it frees the ring across the load line too.
    - `solver`: one of `numerics.integrator.SOLVERS`; of a run of the rollers tsit5 where not given; "auto" chooses
      between tsit5 and kvaerno5 by the stiffness that it measures.
    - `tolerance`: relative tolerance, and absolute one in the units of the state.
    - `entrainment_smoothing`: smoothing of the mean surface speed's modulus in the films of the raceways, m/s: what
      film is left where a roller's surface passes through rest.
    - `ring_mass`: of the inner ring with the shaft's share, kg, of a ball bearing whose ring moves under loads.
    - `ring_damping`: of that ring, from outside, N s/m; of ball bearings 0 where not given.
    - `meridian`: whether balls and inner ring move in the planes through the axis by their inertia, or are in balance
      there at every instant ("quasi_static": no mass and no damping count).
    - `contact_damping`: normal loads of ball bearings are the elastic ones times 1 + that times the rate of approach,
      s/m; 0.05 s/m where not given.
    """

    part: ClassVar[str] = "simulation"

    duration: Scalar | None = optional_number(bound="> 0", unit="s")
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    rotating_load: RotatingLoad | None = None
    solver: str = choice("simulation.solver", SOLVERS, DEFAULT_SOLVER)
    tolerance: Scalar = number(DEFAULT_TOLERANCE, bound="> 0", unit="1")
    entrainment_smoothing: Scalar = number(0.05, bound="> 0", unit="m/s")
    ring_mass: Scalar | None = optional_number(bound="> 0", unit="kg")
    ring_damping: Scalar | None = optional_number(bound=">= 0", unit="N s/m")
    contact_damping: Scalar | None = optional_number(bound=">= 0", unit="s/m")
    meridian: str = choice("simulation.meridian", ("dynamic", "quasi_static"), "dynamic")

    def require_no_mass(self) -> None:
        """**Raises:** `ValueError` where settings of ball bearings are given, which other bearings do not have."""
        for name in ("ring_mass", "ring_damping", "contact_damping"):
            if getattr(self, name) is not None:
                raise ValueError(f"simulation.{name}: expected none, it belongs to a run of a ball bearing")

    @property
    def options(self) -> IntegratorOptions:
        return IntegratorOptions(solver=self.solver, tolerance=self.tolerance)
