"""The fit: from measured curves and a scene to the oil's rheology with its uncertainty."""

import dataclasses
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np

from jaxbearing.contacts import BairWiner, ElsharkawyHamrock, GecimWiner, ReeEyring, deborah_number
from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.machines import TwoDisk

from .estimation import METHODS, Problem, coefficients, estimate_from, linearized, slope_over_slide
from .identifiability import frozen_by_rule, in_words, not_determined
from .loss import LOSSES, TUNING, Errors, scale_of, variance_factor
from .measurements import Measurements
from .misfit import curve_fits, information, lack_of_fit
from .parameters import NAMES, POSITIVE, SCALES, SYMBOLS, Centre, centred_directions, natural, values_of, with_natural
from .result import FitResult, Parameter
from .start import estimated_start
from .uncertainty import correlation, spread

VISCOUS = {
    "ree_eyring": ReeEyring,
    "bair_winer": BairWiner,
    "gecim_winer": GecimWiner,
    "elsharkawy_hamrock": ElsharkawyHamrock,
}
MODULUS, STRESS = NAMES.index("shear_modulus"), NAMES.index("stress")
MODULUS_SHIFTS = (0.0, 1.5, 3.0, -1.5, -3.0, -5.0, -7.0, -9.0, -12.0, -15.0)
"""Changes of ln(shear modulus) that are looked at before the first start."""
STRESS_SHIFTS, LARGEST_SHIFT = 4, 2.0
"""Rounds in which the first stress is brought to the tops of the curves, and the largest change of its logarithm."""
OUTLIER = 4.0
"""Robust standard deviations beyond which a point is named an outlier."""
REWEIGHTINGS = 4
"""Times that scale and slopes are renewed with a robust loss or errors in the slide ratio."""
REFITS = 6
"""Times that parameters may be frozen, for what the data tell or for their bounds."""
SAME_LOSS = 1e-6
"""Relative difference of losses that count as the same minimum."""
EXACT = 1e-6
"""Residual, in assumed standard deviations, that is no residual at all."""


class FitOptions(NamedTuple):
    """How to fit.

    **Arguments:**
    - `model`: viscous function; None: the scene's.
    - `method`: one of `METHODS`.
    - `loss`: one of `LOSSES`; what is not linear lets outliers count less.
    - `errors`: of the measured points.
    - `fixed`: names of parameters to hold at the scene's values.
    - `free`: names of parameters to fit even where a rule says that the data cannot tell them.
    - `bounds`: name -> (lower, upper), SI; either may be None.
    - `starts`: number of starting points, tried at once.
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
        """**Raises:** `ValueError` naming the option."""
        for name, value, known in (("method", self.method, METHODS), ("loss", self.loss, LOSSES)):
            if value not in known:
                raise ValueError(f"{name}: found {value!r}, expected one of {', '.join(known)}")
        if self.model is not None and self.model not in VISCOUS:
            raise ValueError(f"model: found {self.model!r}, expected one of {', '.join(VISCOUS)}")
        for option, names in (("fixed", self.fixed), ("free", self.free), ("bounds", self.bounds)):
            for name in names:
                if name not in NAMES:
                    raise ValueError(f"{option}: found {name!r}, expected one of {', '.join(NAMES)}")
        if not 0.0 < self.level < 1.0:
            raise ValueError(f"level: found {self.level}, expected a number between 0 and 1")
        if self.starts < 1:
            raise ValueError(f"starts: found {self.starts}, expected at least 1")


def fit(measurements: Measurements, scene: TwoDisk, options: FitOptions | None = None) -> FitResult:
    """Shear modulus and characteristic stress of the scene's oil from measured traction curves.

    The model is that of `jaxbearing.solve(scene)`. Start: stress and modulus from the shape of the curves
    (`start.estimated_start`), the best of a scan over the modulus, and random ones about them. Parameters that the data
    cannot tell are held at the scene's values and said so: by rule before (one pressure, one temperature, viscous
    only), by their uncertainty after. Several starts run at once; everything is compiled once for a number of points.

    **Raises:** `ValueError` for options that make no sense, and where the scene's oil has no rheology.
    """
    options = FitOptions() if options is None else options
    options.check()
    if scene.oil.rheology is None:
        raise ValueError("oil.rheology: found nothing, expected first values of shear modulus and stress")
    scene, model = _with_model(scene, options.model)
    search = _Search(measurements, scene, options)
    free, reasons = search.free_by_rule()
    pinned: dict[int, float] = {}
    u_best, estimate, problem = None, None, search.problem(free, pinned)
    starts = search.starts(problem, free)
    for _ in range(REFITS):
        problem, estimate, u_best = search.optimised(problem, starts)
        free, reasons, changed = search.revised(problem, u_best, free, reasons, pinned)
        if not changed:
            break
        coordinates = np.asarray(problem.natural(u_best))
        problem = search.problem(free, pinned, coordinates)
        starts = np.zeros((len(starts), len(NAMES)))
    return search.result(problem, u_best, estimate, free, reasons, pinned, model)


class _Search:
    """One fit at work: what stays the same from run to run."""

    def __init__(self, measurements: Measurements, scene: TwoDisk, options: FitOptions):
        self.measurements, self.scene, self.options = measurements, scene, options
        self.state = eqx.filter_jit(lambda m, s: m.state(s))(measurements, scene)
        assert scene.oil.rheology is not None
        self.rheology = scene.oil.rheology
        self.pressure = np.asarray(self.state.patch.mean_pressure)
        self.temperature = np.asarray(self.state.temperature)
        speed = measurements.entrainment_speed
        self.deborah = np.asarray(deborah_number(self.state.patch, speed, self.state.temperature, scene.oil))
        self.centre = Centre.of(self.pressure, self.temperature)
        self.coefficient = np.asarray(measurements.traction_coefficient)
        self.bend = TUNING[options.loss] if options.loss != "linear" else 1.0
        self.curve = np.asarray(measurements.curve)
        self.deviation = options.errors.deviation(self.coefficient, self.curve)
        self.scale = 1.0

    def free_by_rule(self) -> tuple[np.ndarray, dict[int, str]]:
        reasons = frozen_by_rule(self.pressure, self.temperature, self.deborah)
        fixed = [NAMES.index(name) for name in self.options.fixed]
        insisted = [NAMES.index(name) for name in self.options.free]
        free = np.array([i not in fixed and (i not in reasons or i in insisted) for i in range(len(NAMES))])
        return free, reasons

    def problem(self, free: np.ndarray, pinned: Mapping[int, float], base: np.ndarray | None = None) -> Problem:
        start = estimated_start(
            self.rheology,
            self.scene.oil,
            self.state,
            self.coefficient,
            self.deborah,
            self.curve,
        )
        own, estimated = natural(self.rheology), natural(start)
        coordinates = np.where(free, estimated, own) if base is None else np.where(free, base, own)
        for index, value in pinned.items():
            coordinates[index] = value
        directions = centred_directions(self.centre, float(self.rheology.reference_temperature), free)
        return Problem(
            scene=self.scene,
            state=self.state,
            rheology=self.rheology,
            coefficient=jnp.asarray(self.coefficient),
            deviation=jnp.asarray(self.deviation * self.scale * self.bend),
            weight=jnp.ones(len(self.coefficient)),
            base=jnp.asarray(coordinates),
            directions=jnp.asarray(directions),
            scales=jnp.ones(len(NAMES)),
            loss=self.options.loss,
        )

    def starts(self, problem: Problem, free: np.ndarray) -> np.ndarray:
        """The most promising of a scan over the shear modulus, at each of which the stress is brought to the tops of
        the curves; then random ones about the first: a factor of 3 in ln, 1 1/GPa, 0.5 kK.

        Far from the solution the modulus may not show at all, and no optimiser finds its way from there.
        """
        base, directions = np.asarray(problem.base), np.asarray(problem.directions)
        axes = np.eye(len(NAMES))
        scanned = []
        for shift in MODULUS_SHIFTS if free[MODULUS] else (0.0,):
            moved = base + shift * axes[MODULUS]
            if free[STRESS]:
                moved = moved + self.stress_shift(moved) * axes[STRESS]
            residual = (self.predicted(moved) - self.coefficient) / self.deviation
            scanned.append((float(np.sum(np.square(residual))), shift, moved - base))
        scanned.sort(key=lambda entry: (not np.isfinite(entry[0]), entry[0], abs(entry[1])))
        natural_starts = [move for *_, move in scanned[: max(self.options.starts - 1, 1)]]
        rng = np.random.default_rng(self.options.seed)
        spreads = np.array([np.log(3.0), 1.0, 0.5] * 2)
        while len(natural_starts) < self.options.starts:
            natural_starts.append(natural_starts[0] + rng.normal(size=len(NAMES)) * spreads)
        block = np.ix_(free, free)
        found = np.zeros((self.options.starts, len(NAMES)))
        for row, move in zip(found, natural_starts, strict=True):
            row[free] = np.linalg.solve(directions[block], move[free])
        return found

    def stress_shift(self, coordinates: np.ndarray) -> float:
        """Change of ln(stress) that brings the model to the measured tops of the curves, in the mean."""
        curve, size = self.curve, np.abs(self.coefficient)
        tops = [points[np.argmax(size[points])] for points in (np.flatnonzero(curve == n) for n in np.unique(curve))]
        shift = 0.0
        for _ in range(STRESS_SHIFTS):
            predicted = np.abs(self.predicted(coordinates + shift * np.eye(len(NAMES))[STRESS]))
            usable = [top for top in tops if predicted[top] > 0 and size[top] > 0]
            if not usable:
                break
            change = float(np.median(np.log(size[usable] / predicted[usable])))
            shift += float(np.clip(change, -LARGEST_SHIFT, LARGEST_SHIFT))
        return shift

    def predicted(self, coordinates: np.ndarray) -> np.ndarray:
        """Coefficients at natural coordinates."""
        return np.asarray(coefficients(self.scene, self.state, self.rheology, jnp.asarray(coordinates)))

    def optimised(self, problem: Problem, starts: np.ndarray) -> tuple[Problem, Any, Any]:
        """The best of the starts; with a robust loss or errors of the slide ratio the deviations are renewed."""
        rounds = 1 if self.options.loss == "linear" and not self.options.errors.slide_to_roll else REWEIGHTINGS
        found, u = None, jnp.asarray(starts[0])
        for turn in range(rounds):
            found = estimate_from(problem, jnp.asarray(starts), self.options.method)
            best = int(jnp.argmin(jnp.where(jnp.isfinite(found.loss), found.loss, jnp.inf)))
            u = found.u[best]
            if turn + 1 < rounds:
                slope = np.asarray(slope_over_slide(problem, u)) if self.options.errors.slide_to_roll else 0.0
                self.deviation = self.options.errors.deviation(self.coefficient, self.curve, slope)
                if self.options.loss != "linear":
                    predicted = np.asarray(linearized(problem, u)[0])
                    self.scale = scale_of((predicted - self.coefficient) / self.deviation)
                deviation = jnp.asarray(self.deviation * self.scale * self.bend)
                problem = eqx.tree_at(lambda p: p.deviation, problem, deviation)
                starts = np.tile(np.asarray(u), (len(starts), 1))
        return problem, found, u

    def revised(
        self, problem: Problem, u: Any, free: np.ndarray, reasons: dict[int, str], pinned: dict[int, float]
    ) -> tuple[np.ndarray, dict[int, str], bool]:
        """Freezes what is outside its bounds, or else what the data do not determine."""
        coordinates = np.asarray(problem.natural(u))
        values = values_of(coordinates)
        for name, (low, high) in self.options.bounds.items():
            index = NAMES.index(name)
            below = low is not None and values[index] < low
            above = high is not None and values[index] > high
            if free[index] and (below or above):
                limit = float(low if below else high)  # pyright: ignore[reportArgumentType]
                free = free.copy()
                free[index] = False
                pinned[index] = float(np.log(limit)) if POSITIVE[index] else limit / float(SCALES[index])
                return free, {**reasons, index: f"at its bound {limit:g}"}, True
        found = not_determined(self.spread(problem, u, free), np.asarray(problem.directions), free, self.centre)
        insisted = {NAMES.index(name) for name in self.options.free}
        worst = {index: reason for index, reason in found.items() if index not in insisted}
        reasons = {**reasons, **{i: r for i, r in found.items() if i in insisted}}
        if not worst:
            return free, reasons, False
        # coefficients first: with beta or alpha held the rest may well be determined
        index = max(worst, key=lambda i: i % 3)
        free = free.copy()
        free[index] = False
        return free, {**reasons, index: worst[index]}, True

    def spread(self, problem: Problem, u: Any, free: np.ndarray) -> Any:
        _, residual, jacobian = (np.asarray(part) for part in linearized(problem, u))
        variance = variance_factor(residual, self.options.loss, int(np.sum(free)))
        return spread(jacobian, free, variance, self.options.level)

    def result(
        self,
        problem: Problem,
        u: Any,
        estimate: Any,
        free: np.ndarray,
        reasons: Mapping[int, str],
        pinned: Mapping[int, float],
        model: str,
    ) -> FitResult:
        coordinates = np.asarray(problem.natural(u))
        spread = self.spread(problem, u, free)
        predicted = np.asarray(problem.predicted(u))
        difference = predicted - self.coefficient
        standard = difference / self.deviation
        rheology = _plain(with_natural(self.rheology, jnp.asarray(coordinates)), model, self.scene)
        oil = dataclasses.replace(self.scene.oil, rheology=rheology)
        best = float(jnp.min(estimate.loss))
        index = int(jnp.argmin(jnp.where(jnp.isfinite(estimate.loss), estimate.loss, jnp.inf)))
        exact = EXACT**2 * len(self.coefficient)
        agree = int(jnp.sum(estimate.loss <= best * (1.0 + SAME_LOSS) + exact))
        fitted = [i for i in range(len(NAMES)) if free[i]]
        judged = {i: r for i, r in reasons.items() if i not in pinned}
        outlier = np.abs(standard) > OUTLIER * scale_of(standard)
        aic, bic = information(standard, len(fitted))
        notes = [in_words(i, reason) for i, reason in sorted(judged.items()) if NAMES[i] not in self.options.fixed]
        notes += [f"{SYMBOLS[i]} is at its bound and has no interval." for i in pinned]
        if best > exact:
            notes += lack_of_fit(self.measurements, standard, difference)
        if best > exact and np.any(outlier):
            notes.append(f"{int(np.sum(outlier))} of {len(outlier)} points are outliers (beyond {OUTLIER:g} sigma).")
        if agree < len(estimate.loss):
            notes.append(f"{agree} of {len(estimate.loss)} starts ended at the best fit.")
        return FitResult(
            converged=bool(estimate.converged[index]),
            model=model,
            method=self.options.method,
            rms=float(np.sqrt(np.mean(np.square(difference)))),
            parameters=self.parameters(coordinates, spread, free, reasons),
            unidentifiable=tuple(NAMES[i] for i in sorted(judged)),
            fitted=tuple(NAMES[i] for i in fitted),
            correlation=correlation(spread.covariance)[np.ix_(fitted, fitted)],
            covariance=spread.covariance[np.ix_(fitted, fitted)],
            condition=spread.condition,
            curves=curve_fits(self.measurements, self.state, self.scene, oil, difference),
            loss=best,
            steps=int(estimate.steps[index]),
            starts=(agree, len(estimate.loss)),
            aic=aic,
            bic=bic,
            oil=oil,
            measurements=self.measurements,
            predicted=predicted,
            deviation=self.deviation,
            outlier=outlier,
            level=self.options.level,
            notes=tuple(notes),
        )

    def parameters(
        self, coordinates: np.ndarray, spread: Any, free: np.ndarray, reasons: Mapping[int, str]
    ) -> dict[str, Parameter]:
        values, found = values_of(coordinates), {}
        for index, name in enumerate(NAMES):
            deviation = np.sqrt(spread.covariance[index, index])
            half = spread.quantile * deviation
            if not free[index] or index in reasons or not np.isfinite(half):
                reason = reasons.get(index, "held at the scene's value")
                found[name] = Parameter(float(values[index]), None, None, None, not bool(free[index]), reason)
                continue
            low, high = values_of(coordinates - half)[index], values_of(coordinates + half)[index]
            error = deviation * (values[index] if POSITIVE[index] else SCALES[index])
            found[name] = Parameter(float(values[index]), float(error), float(low), float(high), False)
        return found


def _with_model(scene: TwoDisk, model: str | None) -> tuple[TwoDisk, str]:
    """The scene with another viscous function; the exponent of Elsharkawy and Hamrock's law is the oil's, or 2."""
    traction = scene.contact.traction
    if model is None or model == traction.viscous.name:
        return scene, traction.viscous.name
    exponent = None if scene.oil.rheology is None else scene.oil.rheology.exponent
    viscous = VISCOUS[model]()
    if model == "elsharkawy_hamrock" and exponent is not None:
        viscous = ElsharkawyHamrock(exponent)
    return eqx.tree_at(lambda s: s.contact.traction, scene, dataclasses.replace(traction, viscous=viscous)), model


def _plain(rheology: ExponentialRheology, model: str, scene: TwoDisk) -> ExponentialRheology:
    """Numbers instead of arrays, with the name of the law that they were fitted with."""
    numbers = {name: np.float64(getattr(rheology, name)) for name in NAMES}
    viscous = scene.contact.traction.viscous
    exponent = float(viscous.exponent) if isinstance(viscous, ElsharkawyHamrock) else None
    return dataclasses.replace(rheology, **numbers, viscous_function=model, exponent=exponent)


def fit_models(
    measurements: Measurements, scene: TwoDisk, models: Iterable[str], options: FitOptions | None = None
) -> dict[str, FitResult]:
    """The same fit with each viscous function, for `comparison.compare`."""
    options = FitOptions() if options is None else options
    return {model: fit(measurements, scene, options._replace(model=model)) for model in models}
