"""Comparison of makers' formulas with a solution: totals, parts, ratios, ranges. It changes no result of a solve."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bearings.bearing import AbstractBearing
from ..bearings.solution import Solution
from .catalogue import Catalogue
from .known import Known, contradictions, known_of
from .laws import Law, laws_of

_ROLLING, _DRAG = "rolling_resistance", "drag"
CLOSE = 1.05
"""Ratio of the largest to the smallest moment of the formulas, up to which there is no note on their difference."""


@dataclass(frozen=True)
class Physical:
    """Friction moments and losses of the solution.

    **Arguments:**
    - `total`: power loss over the relative speed of the rings, N m; `None` without losses or at rest.
    - `power`: power loss, W; `None` if the scene models no loss.
    - `parts`: moments divided as in the makers' formulas, N m: rolling (rolling resistance), drag, and sliding
      (everything else); `None` for a part that the scene does not model.
    - `locations`: power losses by location, W.
    """

    total: float | None
    power: float | None
    parts: Mapping[str, float | None]
    locations: Mapping[str, float]


@dataclass(frozen=True)
class Comparison:
    """Results of makers' formulas and of the physical model, side by side.

    **Arguments:**
    - `physical`: moments and losses of the solution.
    - `laws`: results of all formulas, including those that do not cover the bearing.
    - `duty`: inputs of the formulas in SI units: relative `speed` of the rings, `radial` and `axial` load, `moment`,
      `viscosity`, `mean_diameter`, `family`, `series`; `None` if unknown.
    - `notes`: sentences on contradictions and differences.
    """

    physical: Physical
    laws: tuple[Law, ...]
    duty: Mapping[str, Any]
    notes: tuple[str, ...]

    def __getitem__(self, law: str) -> Law:
        return next(result for result in self.laws if result.law == law)

    @property
    def spread(self) -> float | None:
        """Largest over smallest total moment of the formulas; `None` for fewer than two totals."""
        totals = [law.total for law in self.laws if law.total]
        return max(totals) / min(totals) if len(totals) > 1 else None


_OF_DUTY = ("speed", "radial", "axial", "moment", "viscosity", "mean_diameter", "family", "series")


def compared(scene: AbstractBearing, solution: Solution, catalogue: Catalogue | None = None) -> Comparison:
    """Comparison of the makers' formulas with a solution, which is not changed.

    **Raises:** `TypeError` if the scene is not a bearing; `ValueError` for a solution that did not converge or is a
    batch.
    """
    if not isinstance(scene, AbstractBearing) or not isinstance(solution, Solution):
        raise TypeError(f"makers' formulas are of bearings, got a {type(scene).__name__}")
    if np.ndim(np.asarray(solution.status)):
        raise ValueError("compare takes one solution, found a batch")
    if not bool(solution.converged):
        raise ValueError(f"a solve that failed has no results: {solution.failure()}")
    catalogue = Catalogue() if catalogue is None else catalogue
    known = known_of(scene, solution, catalogue)
    physical = _physical(solution, known.values["speed"])
    laws = tuple(_with_ratio(law, physical, known) for law in laws_of(known))
    comparison = Comparison(physical, laws, {name: known.values.get(name) for name in _OF_DUTY}, ())
    notes = [*contradictions(known, catalogue, scene.kind), *_notes(comparison)]
    return dataclasses.replace(comparison, notes=tuple(notes))


def _physical(solution: Solution, speed: float) -> Physical:
    loss = solution.power_loss
    losses = {field.name: getattr(loss, field.name) for field in dataclasses.fields(loss) if field.name != "total"}
    watts = {name: float(value) for name, value in losses.items() if value is not None}
    if not watts:
        return Physical(None, None, {}, {})
    others = [value for name, value in watts.items() if name not in (_ROLLING, _DRAG)]
    groups = {
        "rolling": watts.get(_ROLLING),
        "sliding": sum(others) if others else None,
        "seal": None,
        "drag": watts.get(_DRAG),
    }
    power = float(loss.total)
    if speed == 0.0:
        return Physical(None, power, dict.fromkeys(groups), watts)
    parts = {name: None if value is None else value / speed for name, value in groups.items()}
    return Physical(power / speed, power, parts, watts)


def _with_ratio(law: Law, physical: Physical, known: Known) -> Law:
    if law.total is None:
        return law
    ratio = law.total / physical.total if physical.total else None
    return dataclasses.replace(law, power=law.total * known.values["speed"], ratio=ratio)


def _notes(comparison: Comparison) -> list[str]:
    notes, parts = [], comparison.physical.parts
    if comparison.spread is not None and comparison.spread > CLOSE:
        notes.append(f"the makers' formulas differ by a factor of {comparison.spread:.3g} among themselves")
    if comparison.physical.power is None:
        notes.append("the scene models no loss: nothing stands beside the formulas")
    elif parts.get("rolling") is None:
        notes.append("the scene leaves rolling resistance out (contact.rolling_resistance), the makers have it")
    return notes
