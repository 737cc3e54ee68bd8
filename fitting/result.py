"""Result of a fit."""

from typing import NamedTuple

import equinox as eqx
import numpy as np

from jaxbearing.lubricants import Lubricant
from jaxbearing.machines import TwoDisk

from .measurements import Measurements
from .options import FitOptions


class Parameter(NamedTuple):
    """One parameter of the rheology, SI. `standard_error`, `lower`, `upper` are None if the data do not determine the
    parameter or it was not fitted; `fixed`: whether it was held; `reason`: why it was held or has no interval."""

    value: float
    standard_error: float | None
    lower: float | None
    upper: float | None
    fixed: bool
    reason: str = ""


class CurveFit(NamedTuple):
    """One curve: mean conditions, SI, Deborah number, and the root mean square of the differences."""

    name: str
    points: int
    pressure: float
    entrainment_speed: float
    temperature: float
    deborah_number: float
    rms: float


class FitResult(eqx.Module):
    """Result of a fit.

    - `parameters`: by name, in the order of the law.
    - `unidentifiable`: names of parameters that the data do not determine.
    - `rms`: root mean square of model minus measurement, in traction coefficient.
    - `correlation`, `covariance`: of the parameters named in `fitted`, in natural coordinates.
    - `condition`: condition number of the column-scaled Jacobian.
    - `loss`: half the sum of squares that was minimised; `steps`: steps of the optimiser in its last run; `starts`:
      number of starts that ended within 1e-6 of the best loss, and number of all starts.
    - `aic`, `bic`: information criteria of the weighted residuals.
    - `oil`: the scene's oil with the fitted rheology; `predicted`: traction coefficient of the model at each point;
      `outlier`: mask of the points beyond 4 robust standard deviations.
    - `scene`: the machine with this oil and viscous function; `options`: those of the fit.
    - `reason`: why there is no result, if the cause is not that the optimiser stopped early.
    - `undetermined`: whether the data determine no parameter: all keep their first values, and nothing was fitted.
    - `first_values`: origin of the first values, if they are not those of the scene's own exponential law.
    - `notes`: sentences that the user must read: identifiability, lack of fit, bounds.
    """

    converged: bool
    model: str
    method: str
    rms: float
    parameters: dict[str, Parameter]
    unidentifiable: tuple[str, ...]
    fitted: tuple[str, ...]
    correlation: np.ndarray
    covariance: np.ndarray
    condition: float
    curves: tuple[CurveFit, ...]
    loss: float
    steps: int
    starts: tuple[int, int]
    aic: float
    bic: float
    oil: Lubricant
    measurements: Measurements
    predicted: np.ndarray
    deviation: np.ndarray
    outlier: np.ndarray
    level: float
    notes: tuple[str, ...]
    scene: TwoDisk
    options: FitOptions
    reason: str = ""
    undetermined: bool = False
    first_values: str = ""

    @property
    def status(self) -> str:
        """End of the fit: "converged", "undetermined" or "not_converged"."""
        return "converged" if self.converged else "undetermined" if self.undetermined else "not_converged"

    def failure(self) -> str:
        """One sentence on a fit that did not converge."""
        if self.undetermined:
            return f"undetermined: {self.reason}"
        stopped = f"{self.method} stopped after {self.steps} steps at a loss of {self.loss:.4g}"
        return f"not converged: {self.reason or stopped}"
