"""Solves the random scenes of a structure and judges them by the invariants; every breach is a `Breach`."""

import time
from collections.abc import Iterable
from typing import Any, NamedTuple

import jax
import numpy as np
from campaign.draws import Numbers, joined, pick, single
from campaign.structure import Results, Structure, Twin, in_chunks, results_of

from jaxbearing.numerics.status import Status

GRADIENT_LIMIT = 1e-5
"""Of gradient against finite differences, over the sum of all its parts."""
STEPS = (1e-5, 1e-4)
"""Relative changes of the numbers for the two finite differences: where a contact begins to touch within one of them,
the difference itself is off."""
FINER_STEPS = (1e-7, 1e-6)
"""Those of two more where both are off."""
HONEST = (Status.NOT_CONVERGED, Status.DIVERGED, Status.NO_EQUILIBRIUM, Status.OUTSIDE_VALIDITY)
HIDDEN = (
    *("elements.", "ring.", "cage.", "power_loss.", "boundary_power.", "rolling_by_race.", "supply.", "stiffness"),
    *("film", "profile.pressure", "traction_coefficient", "outer_ring.", "inner_ring."),
)
"""How the paths of results begin that a solve that failed must not show."""


class Breach(NamedTuple):
    """An invariant that does not hold."""

    structure: str
    rule: str
    case: int
    value: float
    numbers: dict[str, Any]


class Verdict(NamedTuple):
    """What the campaign says of one structure."""

    structure: str
    kind: str
    cases: int
    converged: int
    no_equilibrium: int
    refused: int
    failed: int
    median_steps: float
    most_steps: int
    worst_residual: float
    worst_closure: float | None
    """None: no balance of energy is judged."""
    worst_balance: float | None
    worst_gradient: float
    alone: int
    """Twins, and neighbours of gradients, that did not converge although their scene did, or the other way round."""
    seconds: float
    breaches: list[Breach]


def solve_batch(structure: Structure, numbers: Numbers, chunk: int) -> tuple[Any, Results]:
    solution = in_chunks(structure.solver, numbers, chunk)
    return solution, results_of(solution)


def _breaches(
    structure: Structure, rule: str, error: np.ndarray, limit: float, among: np.ndarray, numbers: Numbers
) -> Iterable[Breach]:
    error = np.broadcast_to(np.asarray(error, float), among.shape)
    for case in np.flatnonzero(among & ~(error <= limit)):
        yield Breach(structure.name, rule, int(case), float(error[case]), single(numbers, case))


def converged_cases(results: Results) -> np.ndarray:
    """Of two-disk machines, whose points have a status each, all must be."""
    status = results["status"]
    return np.all((status == Status.CONVERGED).reshape(len(status), -1), axis=1)


def judge_numbers(structure: Structure, numbers: Numbers, results: Results) -> list[Breach]:
    """A converged solution has finite numbers only, but where a contact does not touch; another one has a status that
    says so, and none to mistake for results."""
    good = converged_cases(results)
    cases = len(good)
    found: list[Breach] = []
    for path, values in results.items():
        if not np.issubdtype(values.dtype, np.floating):
            continue
        finite = np.isfinite(values.reshape(cases, -1))
        if path in structure.may_be_nan:
            place = path.rsplit("_", 1)[1]
            finite |= results[f"elements.load_{place}"].reshape(cases, -1) == 0.0
        holes = ~np.all(finite, axis=1)
        found += _breaches(structure, f"finite: {path}", holes.astype(float), 0.0, good, numbers)
        if path.startswith(HIDDEN):
            # of a two-disk machine the point that failed, of other scenes everything
            of = results["status"] != Status.CONVERGED
            of = of.reshape(of.shape + (1,) * (values.ndim - of.ndim))
            shown = np.any((of & np.isfinite(values)).reshape(cases, -1), axis=1)
            found += _breaches(structure, f"not shown: {path}", shown.astype(float), 0.0, ~good, numbers)
    unknown = ~np.isin(results["status"].reshape(cases, -1), [*HONEST, Status.CONVERGED]).all(axis=1)
    found += _breaches(structure, "a known status", unknown.astype(float), 0.0, np.ones(cases, bool), numbers)
    return found


def judge_balances(
    structure: Structure, numbers: Numbers, results: Results
) -> tuple[list[Breach], float | None, float | None]:
    """Breaches, the worst closure of energy and the worst of all other balances; None where there are none."""
    good = converged_cases(results)
    found: list[Breach] = []
    closure = worst = None
    if not np.any(good):
        return found, closure, worst
    solved, theirs = pick(numbers, good), {path: values[good] for path, values in results.items()}
    for rule, (values, limit) in structure.balances(solved, theirs).items():
        error = np.zeros(good.shape)
        error[good] = values
        found += _breaches(structure, rule, error, limit, good, numbers)
        largest = float(np.max(error))
        if rule == "drive power = total loss":
            closure = largest
        else:
            worst = largest if worst is None else max(worst, largest)
    return found, closure, worst


def judge_status(structure: Structure, numbers: Numbers, results: Results) -> tuple[list[Breach], dict[str, int]]:
    """Every scene converges, is refused beyond the envelope, or provably has no equilibrium."""
    good = converged_cases(results)
    cases = len(good)
    outside = np.zeros(cases, bool) if structure.outside is None else structure.outside(numbers)
    status = results["status"].reshape(cases, -1).max(axis=1)
    none = (status == Status.NO_EQUILIBRIUM) & ~outside
    failed = ~good & ~none & ~outside
    found = list(_breaches(structure, "refused beyond the envelope", good.astype(float), 0.0, outside, numbers))
    found += _breaches(structure, "converges", failed.astype(float), 0.0, failed, numbers)
    certified = np.zeros(cases, bool)
    for case in np.flatnonzero(none):
        one = single(numbers, case)
        certified[case] = structure.certificate is not None and structure.certificate(structure.single_scene(one))
    found += _breaches(structure, "no_equilibrium is certified", (~certified).astype(float), 0.0, none, numbers)
    return found, {
        "converged": int(np.sum(good & ~outside)),
        "no_equilibrium": int(np.sum(none & certified)),
        "refused": int(np.sum(outside & ~good)),
        "failed": int(np.sum(failed | (none & ~certified))),
    }


def judge_twin(
    structure: Structure, twin: Twin, numbers: Numbers, results: Results, chunk: int
) -> tuple[list[Breach], int]:
    """Breaches, and how many pairs cannot be compared since one of the two did not converge."""
    first = numbers if twin.base is None else twin.base(numbers)
    if twin.base is not None:
        results = solve_batch(structure, first, chunk)[1]
    others = twin.change(numbers)
    there = solve_batch(structure, others, chunk)[1]
    here, other = converged_cases(results), converged_cases(there)
    with np.errstate(all="ignore"):
        error = twin.error(first, results, others, there)
    return list(_breaches(structure, twin.name, error, twin.limit, here & other, first)), int(np.sum(here != other))


def judge_gradient(
    structure: Structure, numbers: Numbers, results: Results, chunk: int, seed: int
) -> tuple[list[Breach], float, int]:
    """Gradient of the summary by every number: finite, and equal to finite differences along a random direction; the
    largest error, and how many converged scenes have neighbours that did not."""
    good = converged_cases(results)
    converged, _, slope = in_chunks(structure.differentiated, numbers, chunk)
    good &= converged
    dice = np.random.default_rng(seed)
    cases = len(good)
    found: list[Breach] = []
    parts = {}
    for name, values in slope.items():
        rows = np.broadcast_to(values, numbers[name].shape).reshape(cases, -1)
        holes = ~np.all(np.isfinite(rows), axis=1)
        found += _breaches(structure, f"finite gradient: {name}", holes.astype(float), 0.0, good, numbers)
        parts[name] = rows * numbers[name].reshape(cases, -1)
    direction = {name: dice.choice([-1.0, 1.0], (cases, 1)) for name in parts}
    along = np.sum([np.sum(parts[name] * direction[name], axis=1) for name in parts], axis=0)
    size = np.sum([np.sum(np.abs(part), axis=1) for part in parts.values()], axis=0)

    def moved(step: float) -> Numbers:
        factor = {name: np.exp(step * direction[name]) for name in numbers}
        return {n: v * factor[n].reshape((cases,) + (1,) * (v.ndim - 1)) for n, v in numbers.items()}

    def compared(steps: tuple[float, ...]) -> tuple[np.ndarray, np.ndarray]:
        """Error of each case at its best step, and whether all of it converged."""
        signs = [sign * step for step in steps for sign in (1.0, -1.0)]
        solution, around = solve_batch(structure, joined([moved(step) for step in signs]), chunk)
        values = np.asarray(structure.summarised(solution)).reshape(len(signs), cases)
        solved = np.all(converged_cases(around).reshape(len(signs), cases), axis=0)
        differences = [(values[2 * i] - values[2 * i + 1]) / (2.0 * step) for i, step in enumerate(steps)]
        with np.errstate(all="ignore"):
            return np.min([np.abs(d - along) for d in differences], axis=0) / np.maximum(size, 1e-3), solved

    error, solved = compared(STEPS)
    alone = int(np.sum(good & ~solved))
    good &= solved
    if not np.all(error[good] <= GRADIENT_LIMIT):
        finer, solved = compared(FINER_STEPS)
        error = np.where(solved, np.minimum(error, finer), error)
    found += _breaches(structure, "gradient = finite difference", error, GRADIENT_LIMIT, good, numbers)
    return found, float(np.max(error[good], initial=0.0)), alone


def refused_scenes(structure: Structure, numbers: Numbers) -> list[Breach]:
    """Scenes that plain numbers, which are validated, cannot build: a fault of the draws, or of the validation."""
    found = []
    for case in range(len(next(iter(numbers.values())))):
        one = single(numbers, case)
        try:
            structure.single_scene(one)
        except ValueError as error:
            found.append(Breach(structure.name, f"can be built: {error}", case, 1.0, one))
    return found


def campaign(structure: Structure, cases: int, seed: int, chunk: int = 32, part: float = 0.1) -> Verdict:
    """All invariants on random scenes of a structure; a `part` of them has twins, 0.3 of that gradients."""
    start = time.time()
    units = np.random.default_rng(seed).random((cases, structure.size))
    numbers = structure.at(units)
    breaches = refused_scenes(structure, numbers)
    # one size for all: another one would be compiled anew
    _, results = solve_batch(structure, numbers, chunk)
    breaches += judge_numbers(structure, numbers, results)
    balances, closure, worst = judge_balances(structure, numbers, results)
    statuses, counts = judge_status(structure, numbers, results)
    breaches += balances + statuses
    few = slice(0, max(2, round(part * cases)))
    sampled, theirs = pick(numbers, few), {path: values[few] for path, values in results.items()}
    alone = 0
    for twin in structure.twins:
        more, lost = judge_twin(structure, twin, sampled, theirs, chunk)
        breaches += more
        alone += lost
    least = slice(0, max(2, round(0.3 * part * cases)))
    slopes, gradient, lost = judge_gradient(
        structure, pick(numbers, least), {path: values[least] for path, values in results.items()}, chunk, seed
    )
    good = converged_cases(results)
    steps = results.get("iterations", np.zeros(cases))[good]
    residual = results.get("residual_norm", results.get("inner_residual", np.zeros(cases))).reshape(cases, -1)[good]
    jax.clear_caches()
    return Verdict(
        structure=structure.name,
        kind=structure.kind,
        cases=cases,
        **counts,
        median_steps=float(np.median(steps)) if steps.size else 0.0,
        most_steps=int(np.max(steps, initial=0)),
        worst_residual=float(np.max(residual, initial=0.0)),
        worst_closure=closure,
        worst_balance=worst,
        worst_gradient=gradient,
        alone=alone + lost,
        seconds=time.time() - start,
        breaches=breaches + slopes,
    )
