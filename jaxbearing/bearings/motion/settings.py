"""Settings of a transient run, for all kinds of bearings."""

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
    """A transient run that starts from the quasi-static state of the operating point.

    **Arguments:**
    - `duration`: duration of the run, which must be passed with the run if it is not given here, s.
    - `speed`: inner ring speed over that of the operating point, as a function of time.
    - `load`: radial and lateral load over those of the operating point, as a function of time. In ball bearings it
      applies to all loads and moments.
    - `rotating_load`: additional load whose direction rotates. With it the ring can also move across the load line.
    - `solver`: one of `numerics.integrator.SOLVERS`, by default tsit5 for a run of the rolling elements. "auto"
      chooses between tsit5 and kvaerno5 by the stiffness that it measures.
    - `tolerance`: relative tolerance, also the absolute tolerance in the units of the state.
    - `entrainment_smoothing`: speed by which the absolute value of the mean surface speed in the raceway films is
      smoothed, m/s; not given: that of `contact`, as in the steady state. It determines the film that remains where the
      surface of a roller passes through rest.
    - `ring_mass`: mass of the inner ring and its share of the shaft for a ball bearing whose ring moves under loads,
      kg.
    - `ring_damping`: external damping of the moving inner ring, by default 0 for ball bearings, N s/m.
    - `meridian`: motion of balls and inner ring in the planes through the axis: "dynamic", with their inertia, or
      "quasi_static", in balance at every instant, so that masses and damping have no effect.
    - `contact_damping`: damping factor of the ball contacts, by default 0.05 s/m. The normal load is the elastic load
      times 1 + this factor times the rate of approach.
    """

    part: ClassVar[str] = "simulation"

    duration: Scalar | None = optional_number(bound="> 0", unit="s")
    speed: AbstractTimeFactor = Steady()
    load: AbstractTimeFactor = Steady()
    rotating_load: RotatingLoad | None = None
    solver: str = choice("simulation.solver", SOLVERS, DEFAULT_SOLVER)
    tolerance: Scalar = number(DEFAULT_TOLERANCE, bound="> 0", unit="1")
    entrainment_smoothing: Scalar | None = optional_number(bound="> 0", unit="m/s")
    ring_mass: Scalar | None = optional_number(bound="> 0", unit="kg")
    ring_damping: Scalar | None = optional_number(bound=">= 0", unit="N s/m")
    contact_damping: Scalar | None = optional_number(bound=">= 0", unit="s/m")
    meridian: str = choice("simulation.meridian", ("dynamic", "quasi_static"), "dynamic")

    def require_no_mass(self) -> None:
        """Checks that no setting is given that only ball bearings have.

        **Raises:** `ValueError` if one is given."""
        for name in ("ring_mass", "ring_damping", "contact_damping"):
            if getattr(self, name) is not None:
                raise ValueError(f"simulation.{name}: expected none, it belongs to a run of a ball bearing")

    @property
    def options(self) -> IntegratorOptions:
        return IntegratorOptions(solver=self.solver, tolerance=self.tolerance)
