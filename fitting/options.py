"""Options of a fit."""

from collections.abc import Mapping
from typing import NamedTuple

from .estimation import METHODS
from .loss import LOSSES, Errors
from .parameters import NAMES
from .viscous import VISCOUS

MOST_STARTS = 1000


class FitOptions(NamedTuple):
    """Options of a fit.

    **Arguments:**
    - `model`: viscous function; None: the scene's.
    - `method`: one of `METHODS`.
    - `loss`: one of `LOSSES`; all but the linear one reduce the weight of outliers.
    - `errors`: of the measured points.
    - `fixed`: names of parameters to hold at the scene's values.
    - `free`: names of parameters to fit even if the data are found not to determine them.
    - `bounds`: (lower, upper) by name of parameter, SI; either may be None.
    - `starts`: number of starting points, which are tried together.
    - `level`: of the confidence intervals.
    - `seed`: of the random starting points.
    """

    model: str | None = None
    method: str = "levenberg_marquardt"
    loss: str = "linear"
    errors: Errors = Errors()
    fixed: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    bounds: Mapping[str, tuple[float | None, float | None]] = {}
    starts: int = 3
    level: float = 0.95
    seed: int = 0

    def check(self) -> None:
        """Checks all options.

        **Raises:** `ValueError` that names the wrong option.
        """
        for name, value, known in (("method", self.method, METHODS), ("loss", self.loss, LOSSES)):
            if value not in known:
                raise ValueError(f"{name}: found {value!r}, expected one of {', '.join(known)}")
        if self.model is not None and self.model not in VISCOUS:
            raise ValueError(f"model: found {self.model!r}, expected one of {', '.join(VISCOUS)}")
        for option, names in (("fixed", self.fixed), ("free", self.free), ("bounds", self.bounds)):
            for name in names:
                if name not in NAMES:
                    raise ValueError(f"{option}: found {name!r}, expected one of {', '.join(NAMES)}")
        if not 0.0 <= self.errors.relative < 1.0:
            raise ValueError(
                f"errors.relative: found {self.errors.relative}, expected a ratio from 0 to below 1 (2 % is 0.02)"
            )
        if not 0.0 < self.level < 1.0:
            raise ValueError(f"level: found {self.level}, expected a number between 0 and 1")
        for name, (low, high) in self.bounds.items():
            if low is not None and high is not None and not low < high:
                raise ValueError(f"bounds: found {low:g} to {high:g} for {name}, expected the lower one first")
            if name in ("shear_modulus", "stress") and any(limit is not None and limit <= 0 for limit in (low, high)):
                raise ValueError(f"bounds: found {low} to {high} for {name}, expected bounds > 0")
        if not 1 <= self.starts <= MOST_STARTS:
            raise ValueError(f"starts: found {self.starts}, expected 1 to {MOST_STARTS}")
