"""Identifiability in words: which fields the measurements determine, and which only in combination."""

from collections.abc import Sequence

import numpy as np

from fitting.uncertainty import SINGULAR, UNKNOWN, Spread, correlation, informative

from .parameters import FreeField

TOGETHER = 0.95
"""Magnitude of a correlation from which a note says that two fields can hardly be separated."""
STARTS = 3.0
"""Multiple of the start of a field of either sign: if the interval reaches beyond it on both sides of zero, the field
is not determined."""
FROM_PRIOR = 0.9
"""Standard error over that of the prior from which a note says that the field comes from its prior."""


def why_undetermined(
    uncertainty: Spread, jacobian: np.ndarray, free: np.ndarray, fields: Sequence[FreeField], coordinates: np.ndarray
) -> tuple[int, str] | None:
    """The field to hold next, and why: no measured value depends on it, only a combination with others is determined,
    or its interval is too wide; `None` if all are determined.

    An interval is too wide beyond a factor of 3 to either side for a positive number and, for a number of either sign,
    if it reaches beyond three times the start on both sides of zero. A start of 0 gives no such limit, and a field with
    a prior always counts as determined.

    **Arguments:** `jacobian`: of the measured values alone, by the coordinates, (value, field); `coordinates`: of all
    fields.
    """
    indices = np.flatnonzero(free)
    deviation = np.sqrt(np.diag(uncertainty.covariance))
    size = np.linalg.norm(jacobian, axis=0)
    lost = [int(i) for i in indices if not np.isfinite(deviation[i])]
    unseen = [i for i in lost if not size[i] > 0.0]
    if unseen:
        return unseen[-1], "no measured value changes with it"
    if lost:
        return lost[-1], f"only {_combination(jacobian, lost, fields)} is told"
    if uncertainty.degrees < 0:
        reason = (
            f"{len(indices)} free fields change {informative(jacobian, free)} of {len(jacobian)} measured values only"
        )
        return min(map(int, indices), key=lambda i: size[i]), reason
    if not np.isfinite(uncertainty.quantile):
        return None
    half = uncertainty.quantile * deviation
    share = np.zeros(len(fields))
    for i in map(int, indices):
        field = fields[i]
        if field.normal_prior is None:
            most = np.inf if not field.start else abs(field.value(coordinates[i])) + STARTS * abs(field.start)
            share[i] = half[i] / (UNKNOWN if field.positive else most / field.scale)
    index = int(np.argmax(share))
    if share[index] <= 1.0:
        return None
    if fields[index].positive:
        return index, f"it is uncertain by a factor of {np.exp(min(half[index], 700.0)):.3g} to either side"
    times = half[index] * fields[index].scale / abs(fields[index].start)
    return index, f"it is uncertain by {times:.3g} times its start to either side"


def _combination(jacobian: np.ndarray, lost: Sequence[int], fields: Sequence[FreeField]) -> str:
    """The combination of these fields that the values determine, in words: a product of powers if it is a single one
    and all fields are positive."""
    part = jacobian[:, list(lost)]
    _, singular, right = np.linalg.svd(part, full_matrices=False)
    names = [fields[i].path for i in lost]
    if int(np.sum(singular > SINGULAR * singular[0])) != 1 or not all(fields[i].positive for i in lost):
        return f"a combination of {' and '.join(names)}"
    exponents = right[0] / right[0][int(np.argmax(np.abs(right[0])))]
    shown = [name if abs(e - 1.0) < 5e-3 else f"{name}^{e:.2f}" for name, e in zip(names, exponents, strict=True)]
    return f"the product {' * '.join(shown)}"


def said_of(uncertainty: Spread, free: np.ndarray, fields: Sequence[FreeField]) -> list[str]:
    """Sentences on fields that can hardly be separated, and on fields whose uncertainty is nearly that of the prior."""
    sentences = []
    together = correlation(uncertainty.covariance)
    indices = [int(i) for i in np.flatnonzero(free)]
    for place, i in enumerate(indices):
        for j in indices[:place]:
            if abs(together[i, j]) >= TOGETHER:
                relation = "their product" if together[i, j] < 0.0 else "their ratio"
                combination = relation if fields[i].positive and fields[j].positive else "a combination of them"
                sentences.append(
                    f"{fields[j].path} and {fields[i].path} are hardly told apart (correlation {together[i, j]:.3f}): "
                    f"the measurements tell {combination} better than each."
                )
    for i in map(int, indices):
        prior = fields[i].normal_prior
        error = float(np.sqrt(uncertainty.covariance[i, i]))
        if prior is not None and error >= FROM_PRIOR * prior[1]:
            sentences.append(
                f"{fields[i].path} comes from its prior: the measurements narrow it by "
                f"{100.0 * (1.0 - error / prior[1]):.0f} % only."
            )
    return sentences
