"""Result of a calibration."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fitting.result import Parameter

from .._scene import AbstractScene
from .data import Data
from .parameters import FreeField
from .search import Options


@dataclass(frozen=True)
class Misfit:
    """Differences of one measured quantity in one rig, model minus measurement, SI.

    **Arguments:**
    - `rig`: number of the rig; `name`: path of the result; `unit`: its SI unit.
    - `points`: number of fitted values; `rms`, `mean`: of their differences; `relative`: root mean square of the
      differences over that of the values.
    """

    rig: int
    name: str
    unit: str
    points: int
    rms: float
    mean: float
    relative: float


@dataclass(frozen=True)
class HeldBack:
    """Values that were predicted by a calibration that did not fit them.

    **Arguments:**
    - `place`: index of each value among all measured values; `measured`, `predicted`: SI.
    - `deviation`: standard deviation of predicted minus measured, from the fields and the error of measurement.
    - `quantile`: half-width of an interval over `deviation`.
    - `converged`: whether every calibration without some of the values converged.
    """

    place: np.ndarray
    measured: np.ndarray
    predicted: np.ndarray
    deviation: np.ndarray
    quantile: float
    converged: bool

    @property
    def inside(self) -> float:
        """Share of the values inside their intervals."""
        return float(np.mean(np.abs(self.predicted - self.measured) <= self.quantile * self.deviation))

    @property
    def relative(self) -> float:
        """Root mean square of the differences over that of the values."""
        difference = np.sqrt(np.mean(np.square(self.predicted - self.measured)))
        return float(difference / np.sqrt(np.mean(np.square(self.measured))))


@dataclass(frozen=True, eq=False)
class Calibration:
    """Result of `jaxbearing.calibrate`.

    **Arguments:**
    - `converged`; `reason`: why it did not converge; `undetermined`: whether the measurements determine no field, so
      that all keep their starting values.
    - `parameters`: by dotted path, SI: value, standard error, interval, and why a field is held.
    - `fields`: the free fields with their units, bounds and priors.
    - `fitted`: paths of the fields that were fitted and not held.
    - `covariance`: of the coordinates of all fields (logarithms of positive ones), 0 for held fields; `correlation`: of
      the fields in `fitted`.
    - `scale`: size of the errors over the deviations that were given or assumed.
    - `measured`, `predicted`, `deviation`: of each value; `predicted_deviation`: standard deviation of `predicted` that
      follows from the uncertainty of the fields.
    - `names`, `rigs`, `points`: path of the result, rig and operating point of each value.
    - `misfits`: by rig and quantity.
    - `outlier`: mask of the values beyond 4 robust standard deviations.
    - `held_back`: predictions of values that were not fitted; `None` where there are none.
    - `loss`, `evaluations`: half the sum of squares, and number of operating points that were solved.
    - `starts`: number of starts that ended at the best fit, and number of all starts.
    - `notes`: sentences that the user must read.
    - `data`, `options`, `scenes`: those given, but the scenes have the calibrated values.
    """

    converged: bool
    reason: str
    parameters: Mapping[str, Parameter]
    fields: tuple[FreeField, ...]
    fitted: tuple[str, ...]
    covariance: np.ndarray
    correlation: np.ndarray
    scale: float
    measured: np.ndarray
    predicted: np.ndarray
    deviation: np.ndarray
    predicted_deviation: np.ndarray
    names: tuple[str, ...]
    rigs: np.ndarray
    points: np.ndarray
    misfits: tuple[Misfit, ...]
    outlier: np.ndarray
    held_back: HeldBack | None
    loss: float
    evaluations: int
    starts: tuple[int, int]
    notes: tuple[str, ...]
    data: tuple[Data, ...]
    options: Options
    scenes: tuple[AbstractScene, ...] = field(repr=False)
    search: Any = field(repr=False, default=None)
    settled: Any = field(repr=False, default=None)
    undetermined: bool = False

    def __getitem__(self, path: str) -> Parameter:
        return self.parameters[path]

    @property
    def values(self) -> dict[str, float]:
        """Calibrated values by dotted path, for `scene.replace`."""
        return {path: parameter.value for path, parameter in self.parameters.items()}

    @property
    def status(self) -> str:
        """End of the calibration: "converged", "undetermined" or "not_converged"."""
        return "converged" if self.converged else "undetermined" if self.undetermined else "not_converged"

    def failure(self) -> str:
        """One sentence on a calibration that did not converge."""
        return f"{self.status.replace('_', ' ')}: {self.reason}"
