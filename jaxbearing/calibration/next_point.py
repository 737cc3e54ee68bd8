r"""Design of experiments: which operating point would tell most, if it were measured next.

The information that values with the slopes $J$, in standard deviations, add to a covariance $C$ is
$\Delta = \ln\det(I + JCJ^T)$: twice the expected fall of the entropy of the fields, in nats, of a problem that is
linear about its solution (D-optimality).

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
    - `place`: number among the candidates; `conditions`: dotted path -> SI value.
    - `information`: log det, nats; `nan` where the scene has no solution.
    - `standard_errors`: by dotted path, of the fields after one more measurement there.
    """

    place: int
    conditions: Mapping[str, float]
    information: float
    standard_errors: Mapping[str, float]


def next_points(found: Calibration, candidates: Mapping[str, object], rig: int = 0) -> tuple[Candidate, ...]:
    """Candidates in the order of what they tell, the most first. All results that the rig measures are measured there,
    with errors as those of its data.

    **Arguments:** `found`: a calibration that converged; `candidates`: dotted path -> values, SI, as many for each;
    `rig`: number of the rig at which is measured.

    **Raises:** `ValueError` for a calibration without a result, for candidates of different lengths, and for another
    set of fields than the rig's operating points.
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
        told, after = _updated(covariance, rows)
        errors = np.sqrt(np.diag(after)) * slope
        ranked.append(Candidate(place, at, told, dict(zip(paths, map(float, errors), strict=True))))
    return tuple(sorted(ranked, key=lambda one: (not np.isfinite(one.information), -one.information)))


def _deviations(found: Calibration, rig: int, results: np.ndarray) -> np.ndarray:
    """Standard deviations of results as the rig's data have them, in the mean of those of each quantity, or assumed."""
    search, deviation = found.search, np.empty_like(results)
    for column, name in enumerate(search.evaluators[rig].wanted):
        mine = (search.observed.rig == rig) & (search.observed.name == name)
        if name in search.rigs[rig].deviations:
            deviation[:, column] = np.sqrt(np.mean(np.square(search.observed.deviation[mine])))
            continue
        largest = np.max(np.abs(search.observed.value[mine]))
        deviation[:, column] = search.options.relative_error * np.hypot(results[:, column], FLOOR * largest)
    return found.scale * deviation


def _updated(covariance: np.ndarray, rows: np.ndarray) -> tuple[float, np.ndarray]:
    """The information, nats, that values with these slopes add, and the covariance with them."""
    if not np.all(np.isfinite(rows)):
        return float("nan"), np.full_like(covariance, np.nan)
    seen = np.eye(len(rows)) + rows @ covariance @ rows.T
    gain = covariance @ rows.T
    return float(np.linalg.slogdet(seen)[1]), covariance - gain @ np.linalg.solve(seen, gain.T)
