"""The verb `calibrate`: estimates fields of scenes, with intervals, from measurements."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import jax
import numpy as np

from fitting.holding import Held, Settled, settled
from fitting.loss import LOSSES, scale_of
from fitting.result import Parameter
from fitting.uncertainty import Spread, correlation

from .._scene import AbstractScene
from ..distribution import Distribution
from ..numerics.garbage import rare_garbage_collection
from ..numerics.newton import NewtonOptions
from ..numerics.precision import as_float, require_x64
from ..solve import require_solvable, solve
from ..sweeps.cases import listed
from ..sweeps.recipe import in_scene
from ..tolerance.results import Label
from .data import Data
from .evaluation import Evaluator
from .held_back import held_back_of
from .labels import labels_in
from .parameters import FreeField, free_fields, scenes_with
from .result import Calibration, Misfit
from .search import Options, Search
from .words import said_of

OUTLIER, FEWEST = 4.0, 10
"""Number of robust standard deviations beyond which a value is an outlier; fewest degrees of freedom of the fit at
which outliers are marked, and fewest points at which a lack of fit is reported."""
BIAS = 0.5
"""Modulus of the mean difference of a quantity over the root mean square, above which a lack of fit is reported."""
ALL_USED = "as many fields as measured values that change with them"
"""Reason why the size of the errors cannot be estimated."""
SAME_LOSS = 1e-6
"""Relative difference of losses up to which they count as the same minimum."""


@rare_garbage_collection()
def calibrate(
    scene: AbstractScene | Sequence[AbstractScene],
    data: Any,
    free: Sequence[str],
    *,
    priors: Mapping[str, Distribution] | None = None,
    bounds: Mapping[str, tuple[float | None, float | None]] | None = None,
    folds: int = 0,
    options: Options | None = None,
    newton: NewtonOptions | None = None,
    progress: Callable[[int], None] | None = None,
) -> Calibration:
    """Estimates fields of scenes, with intervals, from measurements at many operating points.

        data = {"conditions": {"operation.inner_speed": speeds}, "measured": {"power_loss.total": losses}}
        found = jb.calibrate(scene, data, ["drag.coefficient"])
        found["drag.coefficient"].value, found["drag.coefficient"].lower, found["drag.coefficient"].upper

    The method is least squares with exact derivatives of the solves. Fields that must be positive are fitted as
    logarithms. A field that the measurements do not determine is held at its start, and the reason is given. The size
    of the errors is estimated from the differences between model and measurements, unless `options.known_errors`.

    **Arguments:**
    - `scene`: from `load_scene`, or built from parts; or several, one for each rig.
    - `data`: `calibration.Data`, or a mapping with the names of its fields; or several, one for each rig.
    - `free`: dotted paths of the fields; each is fitted in every scene that has it.
    - `priors`: dotted path -> `Distribution` of the prior knowledge; a uniform one is a pair of bounds.
    - `bounds`: dotted path -> lower and upper bound, SI; either may be `None`.
    - `folds`: number of parts for cross-validation: the operating points of each part are predicted from the others;
      0: none.
    - `options`: of the calibration, `calibration.Options`; `newton`: of the solver.
    - `progress`: called with the number of operating points that were just solved.

    **Raises:** `ValueError` for data, fields or options that do not fit together; `SolveError` where an operating point
    cannot be solved with the start values of the fields; `AttributeError` for a field that does not exist.
    """
    require_x64()
    options = Options() if options is None else options
    _check_options(options, folds)
    scenes = [scene] if isinstance(scene, AbstractScene) else list(scene)
    rigs = [Data.of(rig) for rig in ([data] if isinstance(data, Data | Mapping) else data)]
    if len(rigs) != len(scenes):
        raise ValueError(f"data: found {len(rigs)} for {len(scenes)} scenes; expected as many")
    for rig_scene in scenes:
        require_solvable(rig_scene)
    fields = free_fields(scenes, free, priors or {}, bounds or {})
    scenes = [_started(own, fields) for own in scenes]
    search = _search(scenes, rigs, fields, options, NewtonOptions() if newton is None else newton, progress)
    outcome = settled(search, Held(np.ones(len(fields), dtype=bool), {}, {}))
    return _result(search, scenes, outcome, folds)


def _check_options(options: Options, folds: int) -> None:
    if options.loss not in LOSSES:
        raise ValueError(f"loss: found {options.loss!r}, expected one of {', '.join(LOSSES)}")
    if not 0.0 < options.level < 1.0:
        raise ValueError(f"level: found {options.level}, expected a number between 0 and 1")
    if not options.relative_error > 0.0:
        raise ValueError(f"relative_error: found {options.relative_error}, expected a number > 0")
    if options.starts < 1:
        raise ValueError(f"starts: found {options.starts}, expected 1 or more")
    if folds < 0 or folds == 1:
        raise ValueError(f"folds: found {folds}, expected 0, or 2 or more")


def _started(scene: AbstractScene, fields: Sequence[FreeField]) -> AbstractScene:
    own = {field.path: field.start for field in fields if scenes_with([scene], field.path)}
    return jax.tree.map(as_float, scene.replace(own))


def _search(
    scenes: Sequence[AbstractScene],
    rigs: Sequence[Data],
    fields: Sequence[FreeField],
    options: Options,
    newton: NewtonOptions,
    progress: Callable[[int], None] | None,
) -> Search:
    """Search over checked data, in which conditions and results are named by their paths in the scenes."""
    evaluators, resolved = [], []
    for scene, data in zip(scenes, rigs, strict=True):
        own = [field.path for field in fields if scenes_with([scene], field.path)]
        both = next((path for path in data.conditions if path in own), None)
        if both is not None:
            raise ValueError(
                f"free: found '{both}', which is an operating point of {data.origin}; expected one of the two"
            )
        if data.conditions:
            in_scene(scene, listed(data.conditions))
        labels, data = _resolved(scene, data, newton)
        evaluators.append(Evaluator(scene, own, labels, newton, progress))
        resolved.append(data)
    search = Search(evaluators, resolved, fields, options)
    if not search.count:
        raise ValueError("held_back: found every measured value; expected one or more that are fitted")
    _check_start(search)
    return search


def _resolved(scene: AbstractScene, data: Data, newton: NewtonOptions) -> tuple[dict[str, Label], Data]:
    """Label of each measured result by its path, and the data with these paths as names.

    **Raises:** `ValueError` for a name that is no result, and for a result that is named twice.
    """
    resolved = labels_in(scene, list(data.measured), newton)
    labels = dict(resolved.values())
    if len(labels) < len(resolved):
        raise ValueError(f"measured: found one result twice in {', '.join(resolved)}; expected each once")
    by_path = lambda part: {resolved[name][0]: np.asarray(value, dtype=float) for name, value in part.items()}
    return labels, Data(data.conditions, by_path(data.measured), by_path(data.deviations), data.held_back, data.origin)


def _check_start(search: Search) -> None:
    """**Raises:** `SolveError` if an operating point with a value to fit cannot be solved at the start; `ValueError` if
    it can be solved, but the value is not finite."""
    start = np.array([[field.coordinate(field.start) for field in search.fields]])
    values, _ = search.predicted(start)
    lost = np.flatnonzero(~np.isfinite(values[0]) & (search.weight > 0))
    if not len(lost):
        return
    rig, point = search.observed.rig[lost[0]], search.observed.point[lost[0]]
    evaluator, data = search.evaluators[rig], search.rigs[rig]
    solve(evaluator.base.replace({path: float(column[point]) for path, column in data.conditions.items()}))
    raise ValueError(f"{data.origin}: found no {search.observed.name[lost[0]]} at operating point {point + 1}")


def _result(search: Search, scenes: Sequence[AbstractScene], outcome: Settled, folds: int) -> Calibration:
    problem, estimate, u, held, ended = outcome
    coordinates = problem.natural(u)
    spread = search.spread(problem, u, held.free)
    values, slopes = search.predicted(coordinates[None])
    predicted, slopes = values[0], slopes[0]
    observed, used = search.observed, problem.weight > 0
    best = int(np.nanargmin(np.where(np.isfinite(estimate.loss), estimate.loss, np.inf)))
    least = float(estimate.loss[best])
    agree = int(np.sum(estimate.loss <= least * (1.0 + SAME_LOSS) + np.finfo(float).eps))
    finite = np.where(np.isfinite(spread.covariance), spread.covariance, 0.0)
    scale = float(np.sqrt(search.variance(problem, u, held.free)))
    standard = (predicted - observed.value) / observed.deviation
    outlier = np.zeros(len(observed), dtype=bool)
    if spread.degrees >= FEWEST and np.any(standard[used]):
        outlier = used & (np.abs(standard) > OUTLIER * scale_of(standard[used]))
    fitted = [i for i in range(len(held.free)) if held.free[i]]
    undetermined = not np.any(held.free) and not held.pinned and bool(np.all(np.isfinite(predicted[used])))
    reason = _failure(search, held, ended, bool(estimate.converged[best]), predicted[used], undetermined)
    held_back = None if reason else held_back_of(search, outcome, spread, scale, folds)
    misfits = _misfits(search, predicted, used)
    notes = [] if reason else _notes(search, held, spread, outlier, misfits, (agree, len(estimate.loss)))
    parameters = _parameters(search.fields, coordinates, spread, held)
    at_end = {path: parameter.value for path, parameter in parameters.items()}
    own = lambda scene: {path: at_end[path] for path in at_end if scenes_with([scene], path)}
    return Calibration(
        converged=not reason,
        reason=reason,
        parameters=parameters,
        fields=search.fields,
        fitted=tuple(search.fields[i].path for i in fitted),
        covariance=spread.covariance,
        correlation=correlation(spread.covariance)[np.ix_(fitted, fitted)],
        scale=scale,
        measured=observed.value,
        predicted=predicted,
        deviation=observed.deviation,
        predicted_deviation=np.sqrt(np.einsum("pi,ij,pj->p", slopes, finite, slopes)),
        names=tuple(observed.name),
        rigs=observed.rig,
        points=observed.point,
        misfits=misfits,
        outlier=outlier,
        held_back=held_back,
        loss=least,
        evaluations=search.evaluations,
        starts=(agree, len(estimate.loss)),
        notes=tuple(notes),
        data=tuple(search.rigs),
        options=search.options,
        scenes=tuple(scene.replace(own(scene)) for scene in scenes),
        search=search,
        settled=outcome,
        undetermined=undetermined,
    )


def _failure(
    search: Search, held: Held, ended: bool, converged: bool, predicted: np.ndarray, undetermined: bool
) -> str:
    """Reason why the calibration failed, or an empty text."""
    if undetermined:
        reasons = "; ".join(f"{search.fields[i].path}: {why}" for i, why in held.reasons.items())
        return f"the measurements cannot tell any field ({reasons})"
    if not np.all(np.isfinite(predicted)):
        return (
            f"{int(np.sum(~np.isfinite(predicted)))} of {len(predicted)} values cannot be predicted: the solve failed"
        )
    if not ended:
        return "bounds and fields that cannot be told alternate without end"
    return "" if converged else "the search ended without a minimum"


def _parameters(
    fields: Sequence[FreeField], coordinates: np.ndarray, spread: Spread, held: Held
) -> dict[str, Parameter]:
    parameters = {}
    for i, field in enumerate(fields):
        value = float(field.value(coordinates[i]))
        deviation = float(np.sqrt(spread.covariance[i, i]))
        half = spread.quantile * deviation
        if not held.free[i] or not np.isfinite(half):
            reason = held.reasons.get(i, ALL_USED)
            parameters[field.path] = Parameter(value, None, None, None, not bool(held.free[i]), reason)
            continue
        low, high = (float(field.value(coordinates[i] + side * half)) for side in (-1.0, 1.0))
        parameters[field.path] = Parameter(value, deviation * float(field.slope(coordinates[i])), low, high, False)
    return parameters


def _misfits(search: Search, predicted: np.ndarray, used: np.ndarray) -> tuple[Misfit, ...]:
    """Differences between model and measurements, for each rig and quantity."""
    misfits = []
    for number, evaluator in enumerate(search.evaluators):
        for name, label in evaluator.labels.items():
            mine = used & (search.observed.rig == number) & (search.observed.name == name)
            if not np.any(mine):
                continue
            difference, value = predicted[mine] - search.observed.value[mine], search.observed.value[mine]
            rms, size = (float(np.sqrt(np.mean(np.square(part)))) for part in (difference, value))
            relative = rms / size if size > 0.0 else float("inf")
            mean = float(np.mean(difference))
            misfits.append(Misfit(number, name, label.unit, int(np.sum(mine)), rms, mean, relative))
    return tuple(misfits)


def _notes(
    search: Search,
    held: Held,
    spread: Spread,
    outlier: np.ndarray,
    misfits: Sequence[Misfit],
    starts: tuple[int, int],
) -> list[str]:
    """Notes for the user, one sentence each."""
    fields = search.fields
    notes = [
        f"{fields[i].path} cannot be determined: {why}." for i, why in held.reasons.items() if i not in held.pinned
    ]
    notes += [f"{fields[i].path} is {held.reasons[i]} and has no interval." for i in held.pinned]
    kept = [fields[i].path for i in range(len(fields)) if not held.free[i]]
    if kept and np.any(held.free):
        notes.append(f"All intervals hold for these values of {', '.join(kept)}.")
    if np.any(held.free) and not np.isfinite(spread.quantile):
        notes.append(f"No intervals: {ALL_USED}.")
    notes += said_of(spread, held.free, fields)
    assumed = sorted({name for data in search.rigs for name in data.measured if name not in data.deviations})
    if search.options.known_errors and assumed:
        size = f"{100.0 * search.options.relative_error:g} % of the value"
        notes.append(f"The errors of {', '.join(assumed)} are not in the data; as known ones {size} are taken.")
    for misfit in misfits:
        if misfit.points >= FEWEST and abs(misfit.mean) > BIAS * misfit.rms:
            side = "above" if misfit.mean > 0.0 else "below"
            where = f" of rig {misfit.rig + 1}" if len(search.rigs) > 1 else ""
            notes.append(
                f"Lack of fit: {misfit.name}{where} is {side} its measurements in the mean, "
                f"by {misfit.mean:+.3g} {misfit.unit}."
            )
    if np.any(outlier):
        notes.append(f"{int(np.sum(outlier))} of {len(outlier)} values are outliers (beyond {OUTLIER:g} sigma).")
    if starts[0] < starts[1]:
        notes.append(f"{starts[0]} of {starts[1]} starts ended at the best fit.")
    return notes
