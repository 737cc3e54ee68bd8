r"""Design of experiments: the operating point whose measurement would add most information.

Values with the Jacobian $J$, in standard deviations, add the information $\Delta = \ln\det(I + JCJ^T)$ to a covariance
$C$: twice the expected decrease of the entropy of the fields, in nats, for a problem linearized about its solution
(D-optimality).

**Reference:** Chaloner and Verdinelli (1995), *Bayesian experimental design: a review*, Statistical Science 10, 273.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .data import FLOOR
from .result import Calibration


@dataclass(frozen=True)
class Candidate:
    """An operating point that could be measured.

    **Arguments:**
    - `place`: number among the candidates, from 0; `conditions`: SI value by dotted path.
    - `information`: log det, nats; `nan` where the scene has no solution.
    - `standard_errors`: of the fields after one more measurement at this point, by dotted path.
    """

    place: int
    conditions: Mapping[str, float]
    information: float
    standard_errors: Mapping[str, float]


def next_points(found: Calibration, candidates: Mapping[str, object], rig: int = 0) -> tuple[Candidate, ...]:
    """Candidates sorted by information, the largest first. It is assumed that all results of the rig are measured at a
    candidate, with the errors of its data.

    **Arguments:** `found`: a calibration that converged; `candidates`: values, SI, by dotted path, columns of equal
    length; `rig`: number of the rig that measures.

    **Raises:** `ValueError` for a calibration without a result, for candidates of different lengths, and where a field
    of the rig's operating points is missing.
    """
    if not found.converged:
        raise ValueError(found.failure())
    search, problem = found.search, found.settled.problem
    columns = {path: np.atleast_1d(np.asarray(values, dtype=float)) for path, values in candidates.items()}
    counts = {len(values) for values in columns.values()}
    if len(counts) != 1:
        raise ValueError(f"candidates: found columns of the lengths {sorted(counts)}; expected as many values of each")
    missing = set(search.rigs[rig].conditions) - set(columns)
    if missing:
        raise ValueError(f"candidates: found no {', '.join(sorted(missing))}; expected the operating points of the rig")
    (count,) = counts
    evaluator = search.evaluators[rig]
    coordinates = problem.natural(found.settled.u)
    paths = [field.path for field in search.fields]
    own = [paths.index(path) for path in evaluator.paths]
    values = np.array([float(search.fields[i].value(coordinates[i])) for i in own])
    chain = np.array([float(search.fields[i].slope(coordinates[i])) for i in own])
    results, slopes = evaluator(columns, np.tile(values, (count, 1)), np.ones(count, dtype=bool))
    jacobian = np.zeros((count, len(evaluator.wanted), len(paths)))
    jacobian[:, :, own] = np.moveaxis(slopes, 1, 2) * chain
    jacobian /= _deviations(found, rig, results)[..., None]
    covariance = np.where(np.isfinite(found.covariance), found.covariance, 0.0)
    slope = np.array([float(field.slope(c)) for field, c in zip(search.fields, coordinates, strict=True)])
    ranked = []
    for place, rows in enumerate(jacobian):
        at = {path: float(column[place]) for path, column in columns.items()}
        information, after = _updated(covariance, rows)
        errors = np.sqrt(np.diag(after)) * slope
        ranked.append(Candidate(place, at, information, dict(zip(paths, map(float, errors), strict=True))))
    return tuple(sorted(ranked, key=lambda candidate: (not np.isfinite(candidate.information), -candidate.information)))


def _deviations(calibration: Calibration, rig: int, results: np.ndarray) -> np.ndarray:
    """Standard deviations of new results: root mean square of those given for the quantity in the rig's data, or, if
    none are given, assumed ones."""
    search, deviation = calibration.search, np.empty_like(results)
    for column, name in enumerate(search.evaluators[rig].wanted):
        mine = (search.observed.rig == rig) & (search.observed.name == name)
        if name in search.rigs[rig].deviations:
            deviation[:, column] = np.sqrt(np.mean(np.square(search.observed.deviation[mine])))
            continue
        largest = np.max(np.abs(search.observed.value[mine]))
        deviation[:, column] = search.options.relative_error * np.hypot(results[:, column], FLOOR * largest)
    return calibration.scale * deviation


def _updated(covariance: np.ndarray, rows: np.ndarray) -> tuple[float, np.ndarray]:
    """The information, nats, that values with the Jacobian `rows` add, and the covariance with these values."""
    if not np.all(np.isfinite(rows)):
        return float("nan"), np.full_like(covariance, np.nan)
    seen = np.eye(len(rows)) + rows @ covariance @ rows.T
    gain = covariance @ rows.T
    return float(np.linalg.slogdet(seen)[1]), covariance - gain @ np.linalg.solve(seen, gain.T)
