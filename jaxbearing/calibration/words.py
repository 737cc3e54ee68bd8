"""Identifiability in words: what the measurements tell of each field, and what they tell of combinations only."""

from collections.abc import Sequence

import numpy as np

from fitting.uncertainty import SINGULAR, UNKNOWN, Spread, correlation

from .parameters import FreeField

TOGETHER = 0.95
"""Correlation from which two fields are said to be told apart hardly."""
PART = 0.1
"""Part of a field in a direction from which it is named there."""
FROM_PRIOR = 0.9
"""Standard error over that of the prior from which the measurements are said to tell nothing more."""


def why_undetermined(
    found: Spread, jacobian: np.ndarray, free: np.ndarray, fields: Sequence[FreeField]
) -> tuple[int, str] | None:
    """The field to hold next, and why: no value moves with it, only a combination with others is told, or it is
    uncertain by more than a factor of 3; `None` where all are told.

    **Arguments:** `jacobian`: of the measured values alone, (value, field), by the coordinates.
    """
    indices = np.flatnonzero(free)
    deviation = np.sqrt(np.diag(found.covariance))
    size = np.linalg.norm(jacobian, axis=0)
    lost = [int(i) for i in indices if not np.isfinite(deviation[i])]
    unseen = [i for i in lost if not size[i] > 0.0]
    if unseen:
        return unseen[-1], "no measured value changes with it"
    if lost:
        return lost[-1], f"only {_combination(jacobian, lost, fields)} is told"
    if not np.isfinite(found.quantile):
        return None
    half = np.where([field.positive for field in fields], found.quantile * deviation, 0.0)
    half[~free] = 0.0
    index = int(np.argmax(half))
    if half[index] <= UNKNOWN or fields[index].normal_prior is not None:
        return None
    return index, f"it is uncertain by a factor of {np.exp(min(half[index], 700.0)):.3g} to either side"


def _combination(jacobian: np.ndarray, lost: Sequence[int], fields: Sequence[FreeField]) -> str:
    """The combination of these fields that the values do tell, if it is one."""
    part = jacobian[:, list(lost)]
    _, singular, right = np.linalg.svd(part, full_matrices=False)
    names = [fields[i].path for i in lost]
    if int(np.sum(singular > SINGULAR * singular[0])) != 1 or not all(fields[i].positive for i in lost):
        return f"a combination of {' and '.join(names)}"
    exponents = right[0] / right[0][int(np.argmax(np.abs(right[0])))]
    shown = [name if abs(e - 1.0) < 5e-3 else f"{name}^{e:.2f}" for name, e in zip(names, exponents, strict=True)]
    return f"the product {' * '.join(shown)}"


def said_of(found: Spread, free: np.ndarray, fields: Sequence[FreeField]) -> list[str]:
    """Sentences on fields that are told only together, and on those of which the prior tells nearly everything."""
    said = []
    together = correlation(found.covariance)
    indices = [int(i) for i in np.flatnonzero(free)]
    for place, i in enumerate(indices):
        for j in indices[:place]:
            if abs(together[i, j]) >= TOGETHER:
                told = "their product" if together[i, j] < 0.0 else "their ratio"
                what = told if fields[i].positive and fields[j].positive else "a combination of them"
                said.append(
                    f"{fields[j].path} and {fields[i].path} are hardly told apart (correlation {together[i, j]:.3f}): "
                    f"the measurements tell {what} better than each."
                )
    for i in indices:
        prior = fields[i].normal_prior
        error = float(np.sqrt(found.covariance[i, i]))
        if prior is not None and error >= FROM_PRIOR * prior[1]:
            said.append(
                f"{fields[i].path} comes from its prior: the measurements narrow it by "
                f"{100.0 * (1.0 - error / prior[1]):.0f} % only."
            )
    return said
