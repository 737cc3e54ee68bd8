"""The search for the best parameters: starting points and optimisations."""

import dataclasses
from collections.abc import Mapping
from typing import TYPE_CHECKING

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from scipy import stats

from jaxbearing._types import Values
from jaxbearing.contacts import ReeEyring, deborah_number, viscous_function_for
from jaxbearing.lubricants import ExponentialRheology
from jaxbearing.machines import DiskState, TwoDisk
from jaxbearing.machines.two_disk import INNER_TOLERANCE
from jaxbearing.programs import KeptProgram

from .estimation import Estimate, estimate_from, linearized
from .holding import AbstractSearch, Held
from .identifiability import elastic_conditions, frozen_by_rule, not_determined
from .loss import TUNING, scale_of, variance_factor
from .measurements import MeasurementError, Measurements
from .options import FitOptions
from .parameters import (
    GROUPS,
    NAMES,
    POSITIVE,
    SCALES,
    Centre,
    centred_directions,
    natural,
    values_of,
    with_natural,
)
from .start import estimated_start, exponential_about
from .traction import Problem, coefficients, slope_over_slide
from .uncertainty import Spread, spread

if TYPE_CHECKING:
    import numpy.typing as npt

MODULUS, STRESS = NAMES.index("shear_modulus"), NAMES.index("stress")
MODULUS_SHIFTS = (0.0, 1.5, 3.0, -1.5, -3.0, -5.0, -7.0, -9.0, -12.0, -15.0)
"""Changes of ln(shear modulus) that are scanned for starting points."""
STRESS_SHIFTS, LARGEST_SHIFT = 4, 2.0
"""Rounds in which the first stress is adapted to the maxima of the curves, and largest change of its logarithm in one
round."""
SIGNIFICANT = 1e-3
"""Significance level (p-value) below which a better fit counts as a real effect."""
REWEIGHTINGS = 4
"""Number of optimisations with a robust loss or errors of the slide-to-roll ratio; scale and slopes are updated between
them."""


SMALLEST_BATCH, LARGEST_STEP = 32, 512
"""Smallest padded number of points, and the number above which it is a multiple of this instead of a power of two. The
padding are copies of weight 0; with it a program that was compiled for other curves can serve these too."""


def filled(count: int) -> int:
    """Padded number of points for `count` points."""
    if count > LARGEST_STEP:
        return -(-count // LARGEST_STEP) * LARGEST_STEP
    return max(SMALLEST_BATCH, 1 << (count - 1).bit_length())


def _state(
    scene: TwoDisk, slide_to_roll: Values, entrainment_speed: Values, temperature: Values, load: Values
) -> DiskState:
    state = scene.state(slide_to_roll, entrainment_speed, temperature, load=load)
    return jax.tree.map(lambda leaf: jnp.broadcast_to(leaf, state.film.shape), state)


_compiled_state = KeptProgram(_state, quick=True)


class Search(AbstractSearch[Problem, Estimate, Array]):
    """Data and methods of one fit that all its optimisations share.

    **Arguments:** as for `fit.fit`; the scene has the viscous function of the fit, and its oil has a rheology.
    """

    def __init__(self, measurements: Measurements, scene: TwoDisk, options: FitOptions):
        self.measurements, self.scene, self.options = measurements, scene, options
        self.loss, self.limits = options.loss, _limits(options)
        self.count = len(measurements.slide_to_roll)
        columns = (
            measurements.slide_to_roll,
            measurements.entrainment_speed,
            measurements.temperature,
            measurements.load,
        )
        self.batch = _compiled_state(scene, *(self.fill(column) for column in columns))
        self.state = jax.tree.map(lambda leaf: leaf[: self.count], self.batch)
        lost = np.flatnonzero(~(np.asarray(self.state.inner_residual) <= INNER_TOLERANCE))
        if len(lost):
            raise MeasurementError(
                f"inlet temperature: found no solution at {len(lost)} of {self.count} points, the first at a slide-to-"
                f"roll ratio of {100 * float(measurements.slide_to_roll[lost[0]]):.3g} %; expected conditions that the "
                "scene's thermal law holds for"
            )
        self.pressure = np.asarray(self.state.patch.mean_pressure)
        self.temperature = np.asarray(self.state.temperature)
        speed = measurements.entrainment_speed
        self.deborah = np.asarray(deborah_number(self.state.patch, speed, self.state.temperature, scene.oil))
        self.centre = Centre.of(self.pressure, self.temperature)
        self.rheology, self.scene = self._first_values(scene)
        self.coefficient = np.asarray(measurements.traction_coefficient)
        self.bend = TUNING[options.loss] if options.loss != "linear" else 1.0
        self.curve = np.asarray(measurements.curve)
        self.deviation = options.errors.deviation(self.coefficient, self.curve)
        self.scale = 1.0

    def _first_values(self, scene: TwoDisk) -> tuple[ExponentialRheology, TwoDisk]:
        """The exponential law of the oil, or the one tangent to its law in the middle of the data; and the scene with
        that law."""
        rheology = scene.oil.rheology
        if isinstance(rheology, ExponentialRheology):
            return rheology, scene
        assert rheology is not None
        rheology = exponential_about(rheology, self.centre.pressure, 1.0 / self.centre.inverse_temperature)
        return rheology, eqx.tree_at(lambda s: s.oil.rheology, scene, rheology)

    def fill(self, values: "npt.ArrayLike") -> Float[Array, " batch"]:
        """One value for each point, padded with copies of the last value."""
        return jnp.asarray(np.pad(np.asarray(values, dtype=float), (0, filled(self.count) - self.count), mode="edge"))

    def weight(self, values: np.ndarray) -> Float[Array, "... batch"]:
        """Weights of the points, padded with 0 along the last axis."""
        return jnp.asarray(np.pad(values, [(0, 0)] * (values.ndim - 1) + [(0, filled(self.count) - self.count)]))

    def free_by_rule(self) -> tuple[np.ndarray, dict[int, str]]:
        """Mask of the parameters to fit, and the reasons of the rules (one pressure, one temperature) by index."""
        held = ("shear_modulus" in self.options.fixed, "stress" in self.options.fixed)
        reasons = frozen_by_rule(self.pressure, self.temperature, held)
        fixed = [NAMES.index(name) for name in self.options.fixed]
        free = np.array([i not in fixed and (i not in reasons or i in self.insisted) for i in range(len(NAMES))])
        return free, reasons

    @property
    def insisted(self) -> set[int]:
        """Parameters that the user wants to be fitted in any case."""
        return {NAMES.index(name) for name in self.options.free}

    def elastic_part_shows(self, free: np.ndarray) -> bool:
        """True if a fit with a free shear modulus is significantly better than one with the scene's value (F test). The
        Deborah number alone does not decide, because it is computed with the scene's modulus, which may be far off."""
        without = free.copy()
        without[list(GROUPS[0])] = False
        losses = []
        for tried in (without, free):
            problem = self.problem(tried, {})
            losses.append(float(np.nanmin(np.asarray(self.optimised(problem, self.starts(problem, tried))[1].loss))))
        degrees = self.count - int(np.sum(free))
        if degrees <= 0 or not losses[1] > 0.0:
            return False
        gain = (losses[0] - losses[1]) / int(np.sum(free & ~without)) / (losses[1] / degrees)
        return bool(stats.f.sf(gain, int(np.sum(free & ~without)), degrees) < SIGNIFICANT)

    def problem(self, free: np.ndarray, pinned: Mapping[int, float], base: np.ndarray | None = None) -> Problem:
        start = estimated_start(
            self.rheology,
            viscous_function_for(self.scene.contact.traction.viscous, self.scene.oil).name != ReeEyring.name,
            self.scene.oil,
            self.state,
            self.coefficient,
            self.deborah,
            self.curve,
        )
        own, estimated = self.within_bounds(natural(self.rheology)), natural(start)
        coordinates = np.where(free, estimated, own) if base is None else np.where(free, base, own)
        for index, value in pinned.items():
            coordinates[index] = value
        directions = centred_directions(self.centre, float(self.rheology.reference_temperature), free)
        return Problem(
            scene=self.scene,
            state=self.batch,
            rheology=self.rheology,
            measured=self.fill(self.coefficient),
            deviation=self.fill(self.deviation * self.scale * self.bend),
            weight=self.weight(np.ones(self.count)),
            base=jnp.asarray(coordinates),
            directions=jnp.asarray(directions),
            scales=jnp.ones(len(NAMES)),
            loss=self.options.loss,
        )

    def starts(self, problem: Problem, free: np.ndarray) -> np.ndarray:
        """Starting points: the best of a scan over the shear modulus, each with the stress adapted to the maxima of the
        curves; then random points about the first, with standard deviations of ln 3, 1 1/GPa and 0.5 kK.

        The scan is needed because far from the solution the modulus may have no effect at all, and no optimiser can
        start there.
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
        starts = np.zeros((self.options.starts, len(NAMES)))
        for row, move in zip(starts, natural_starts, strict=True):
            row[free] = np.linalg.solve(directions[block], move[free])
        return starts

    def stress_shift(self, coordinates: np.ndarray) -> float:
        """Change of ln(stress) with which the model meets the measured maxima of the curves in the median."""
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

    def deborah_at(self, coordinates: np.ndarray) -> np.ndarray:
        """Deborah numbers of the points with the rheology that has these natural coordinates."""
        oil = dataclasses.replace(self.scene.oil, rheology=with_natural(self.rheology, jnp.asarray(coordinates)))
        speed = self.measurements.entrainment_speed
        return np.asarray(deborah_number(self.state.patch, speed, self.state.temperature, oil))

    def predicted(self, coordinates: np.ndarray) -> np.ndarray:
        """Traction coefficients of the model at natural coordinates."""
        every = coefficients(self.scene, self.batch, self.rheology, jnp.asarray(coordinates))
        return np.asarray(every)[: self.count]

    def optimised(self, problem: Problem, starts: np.ndarray) -> tuple[Problem, Estimate, Array]:
        """The last problem, the estimates from all starts, and the unknowns of the best; with a robust loss or errors
        of the slide-to-roll ratio the deviations are updated between several optimisations."""
        rounds = 1 if self.options.loss == "linear" and not self.options.errors.slide_to_roll else REWEIGHTINGS
        estimate, u = None, jnp.asarray(starts[0])
        for turn in range(rounds):
            estimate = estimate_from(problem, jnp.asarray(starts), self.options.method)
            best = int(jnp.argmin(jnp.where(jnp.isfinite(estimate.loss), estimate.loss, jnp.inf)))
            u = estimate.u[best]
            if turn + 1 < rounds:
                slope = (
                    np.asarray(slope_over_slide(problem, u))[: self.count] if self.options.errors.slide_to_roll else 0.0
                )
                self.deviation = self.options.errors.deviation(self.coefficient, self.curve, slope)
                if self.options.loss != "linear":
                    predicted = np.asarray(linearized(problem, u)[0])[: self.count]
                    self.scale = scale_of((predicted - self.coefficient) / self.deviation)
                deviation = self.fill(self.deviation * self.scale * self.bend)
                problem = eqx.tree_at(lambda p: p.deviation, problem, deviation)
                starts = np.tile(np.asarray(u), (len(starts), 1))
        assert estimate is not None
        return problem, estimate, u

    def slopes(self, problem: Problem, u: Array) -> tuple[np.ndarray, np.ndarray]:
        _, residual, jacobian = (np.asarray(part)[: self.count] for part in linearized(problem, u))
        return residual, jacobian

    def spread(self, problem: Problem, u: Array, free: np.ndarray) -> Spread:
        """Uncertainty of the free parameters."""
        residual, jacobian = self.slopes(problem, u)
        variance = variance_factor(residual, self.options.loss, int(np.sum(free)))
        return spread(jacobian, free, variance, self.options.level)

    def insisted_blindly(self, held: Held) -> np.ndarray:
        """Mask of the parameters that are fitted only because the user asks for it, although the data do not determine
        them; the intervals of the others hold for the values that these take."""
        return np.array([i in self.insisted and i in held.reasons and held.free[i] for i in range(len(NAMES))])

    def undetermined(self, problem: Problem, u: Array, held: Held) -> tuple[int, str] | None:
        judged = held.free & ~self.insisted_blindly(held)
        elastic = elastic_conditions(self.pressure, self.temperature, self.deborah_at(np.asarray(problem.natural(u))))
        elastic = {i: reason for i, reason in elastic.items() if judged[i] and i not in self.insisted}
        if elastic and GROUPS[0][0] in np.flatnonzero(held.free):
            index = min(elastic)
            return index, elastic[index]
        spread = self.spread(problem, u, judged)
        if spread.degrees <= 0:
            return None
        reasons = not_determined(spread, np.asarray(problem.directions), judged, self.centre)
        reasons = {index: reason for index, reason in reasons.items() if index not in self.insisted}
        if not reasons:
            return None
        # coefficients first: with beta or alpha held, the data may determine the rest
        index = max(reasons, key=lambda i: i % 3)
        return index, reasons[index]

    def value_in_words(self, index: int, coordinate: float) -> str:
        return f"{values_of(np.full(len(NAMES), coordinate))[index]:g}"


def _limits(options: FitOptions) -> tuple[np.ndarray, np.ndarray]:
    """Bounds in natural coordinates, infinite where there is none."""
    limits = np.full(len(NAMES), -np.inf), np.full(len(NAMES), np.inf)
    for name, pair in options.bounds.items():
        index = NAMES.index(name)
        for limit, value in zip(limits, pair, strict=True):
            if value is not None:
                limit[index] = np.log(value) if POSITIVE[index] else value / SCALES[index]
    return limits
