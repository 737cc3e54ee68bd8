"""Bounds of single numbers, keyed by the words that messages show. Nothing here needs JAX or NumPy."""

import math
from typing import Any, NamedTuple


class Interval(NamedTuple):
    """Allowed values between `low` and `high`. The two flags tell whether an end is allowed itself. NaN never is, and
    infinity only as an allowed end."""

    low: float
    high: float
    low_allowed: bool = False
    high_allowed: bool = False

    def holds(self, value: Any) -> Any:
        """True where the value lies inside: one answer for a number, one for each entry of an array."""
        above = value >= self.low if self.low_allowed else value > self.low
        return above & (value <= self.high if self.high_allowed else value < self.high)


CLOSURES = "between -10 mm and 10 mm"
"""Bound of closures: the search for an equilibrium of a shaft moves no ring farther (`shafts.search.FARTHEST`)."""

RANGES = {
    "finite": Interval(-math.inf, math.inf),
    "> 0": Interval(0.0, math.inf),
    ">= 0": Interval(0.0, math.inf, low_allowed=True),
    "> 0 or infinite": Interval(0.0, math.inf, high_allowed=True),
    ">= 0 or infinite": Interval(0.0, math.inf, True, True),
    "between 0 and 1": Interval(0.0, 1.0, True, True),
    "above 0 and below 1": Interval(0.0, 1.0),
    "above 0 and at most 1": Interval(0.0, 1.0, high_allowed=True),
    ">= 0 and below 1": Interval(0.0, 1.0, low_allowed=True),
    "between 0 and 0.5": Interval(0.0, 0.5, True, True),
    "between 0 and 2": Interval(0.0, 2.0, True, True),
    "above 0.5 and at most 1": Interval(0.5, 1.0, high_allowed=True),
    ">= 0 and below 90 degrees": Interval(0.0, 0.5 * math.pi, low_allowed=True),
    "above 0 and below 90 degrees": Interval(0.0, 0.5 * math.pi),
    CLOSURES: Interval(-0.01, 0.01, True, True),
    "between 0.5 and 8": Interval(0.5, 8.0, True, True),
    "between 1.05 and 64": Interval(1.05, 64.0, True, True),
    "between 2 and 64": Interval(2.0, 64.0, True, True),
    "> 0.0632 mPa s (Roelands' smallest viscosity)": Interval(6.32e-5, math.inf),
    "> 138 K (the pole of Roelands' law)": Interval(138.0, math.inf),
    "> 0.3 cSt (0.3e-6 m^2/s)": Interval(0.3e-6, math.inf),
}
"""Bounds of fields in SI units; each key is the text that messages show."""
