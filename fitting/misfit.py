"""Residuals of a fit: misfit of each curve, information criteria, and a test whether the residuals are random."""

import numpy as np

from jaxbearing.contacts import deborah_number
from jaxbearing.lubricants import Lubricant
from jaxbearing.machines import DiskState, TwoDisk

from .loss import scale_of
from .measurements import Measurements
from .result import CurveFit

SYSTEMATIC = 2.6
"""Lag-one correlation of the residuals, in its standard deviations, from which neighbours are not independent (1 %)."""
LARGEST = 2.5
"""Limit of residuals in that correlation, in robust standard deviations: one outlier must not hide the others."""
MISSED = 0.3
"""Root mean square of the differences over that of the coefficients, above which a note reports a lack of fit."""
NOTHING = 0.9
"""The same ratio above which the model follows no curve: the optimiser ended on a plateau, and the fit has failed."""
FEWEST = 8
"""Pairs of neighbouring residuals, of all curves together, below which their correlation is not judged."""


def curve_fits(
    measurements: Measurements, state: DiskState, scene: TwoDisk, oil: Lubricant, difference: np.ndarray
) -> tuple[CurveFit, ...]:
    """Mean conditions and misfit of every curve."""
    deborah = np.asarray(deborah_number(state.patch, measurements.entrainment_speed, state.temperature, oil))
    fits = []
    for number, name in enumerate(measurements.curve_names):
        points = measurements.in_curve(number)
        mean = lambda values, points=points: float(np.mean(np.asarray(values)[points]))
        fits.append(
            CurveFit(
                name=name,
                points=int(np.sum(points)),
                pressure=mean(state.patch.pressure),
                entrainment_speed=mean(measurements.entrainment_speed),
                temperature=mean(measurements.temperature),
                deborah_number=mean(deborah),
                rms=float(np.sqrt(mean(np.square(difference)))),
            )
        )
    return tuple(fits)


def information(difference: np.ndarray, deviation: np.ndarray, parameters: int) -> tuple[float, float]:
    """Akaike's and Schwarz's criteria for normal errors of known ratios and unknown size.

    **Arguments:** `difference`: model minus measurement; `deviation`: its assumed standard deviation (it may depend on
    the model); `parameters`: how many were fitted.
    """
    count = len(difference)
    mean_square = max(float(np.mean(np.square(difference / deviation))), np.finfo(float).tiny)
    fitness = float(count * np.log(mean_square) + 2.0 * np.sum(np.log(deviation)))
    return fitness + 2.0 * (parameters + 1), fitness + float(np.log(count)) * (parameters + 1)


def neighbour_correlation(measurements: Measurements, standard: np.ndarray) -> tuple[float, int]:
    """Correlation of residuals of points next to each other in slide-to-roll ratio in a curve, and number of pairs."""
    slide = np.asarray(measurements.slide_to_roll)
    limit = LARGEST * scale_of(standard)
    standard = np.clip(standard, -limit, limit)
    pairs: list[np.ndarray] = []
    for number in range(len(measurements.curve_names)):
        points = np.flatnonzero(measurements.in_curve(number))
        ordered = standard[points[np.argsort(slide[points], kind="stable")]]
        pairs.append(np.stack([ordered[:-1], ordered[1:]]))
    left, right = np.concatenate(pairs, axis=1)
    size = float(np.sum(np.square(standard)))
    return (float(np.sum(left * right)) / size if size > 0 else 0.0), left.size


def missed_share(measurements: Measurements, difference: np.ndarray, outlier: np.ndarray) -> float:
    """Root mean square of the differences over that of the coefficients, outliers left out."""
    coefficient = np.asarray(measurements.traction_coefficient)
    rms, size = (float(np.sqrt(np.mean(np.square(x[~outlier])))) for x in (difference, coefficient))
    return rms / max(size, float(np.finfo(float).tiny))


def lack_of_fit(
    measurements: Measurements, standard: np.ndarray, difference: np.ndarray, outlier: np.ndarray
) -> list[str]:
    """A sentence if the residuals are large or not random, else none. **Arguments:** `standard`: residuals over their
    deviations; `outlier`: mask of points that do not count for the size."""
    share = missed_share(measurements, difference, outlier)
    if share > MISSED:
        return [f"Lack of fit: the model misses the curves by {100 * share:.0f} % of their size (rms)."]
    correlation, pairs = neighbour_correlation(measurements, standard)
    if pairs < FEWEST or correlation * np.sqrt(pairs) < SYSTEMATIC:
        return []
    worst = int(np.argmax(np.abs(difference)))
    slide = float(np.asarray(measurements.slide_to_roll)[worst])
    curve = measurements.curve_names[measurements.curve[worst]]
    return [
        f"Lack of fit: neighbouring residuals are alike (correlation {correlation:.2f} of {pairs} pairs), so the model "
        f"misses something and the intervals are too narrow; largest difference {difference[worst]:+.2g} at a slide-to-"
        f"roll ratio of {100 * slide:.3g} % in curve '{curve}'."
    ]
