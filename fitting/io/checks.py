"""Checks that every curve file must pass whatever its layout, and remarks on unusual content."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float64

from .errors import CurveError

_LARGEST_USUAL = 2.0
"""Slide-to-roll ratio beyond which the two surfaces move against each other."""


def check_count(file: str, count: int, line: int | None, what: str = "two rows of numbers") -> None:
    """Refuses fewer than two points; `line` is that of the last one, or of the header.

    **Raises:** `CurveError`.
    """
    if count < 2:
        actual = "a header without points" if count == 0 else "a single point"
        raise CurveError(file, line, "", actual, f"at least {what}")


def check_sliding(file: str, column: str, slide_to_roll: Float64[np.ndarray, " point"]) -> None:
    """Refuses curves without sliding, which say nothing about traction.

    **Raises:** `CurveError`.
    """
    if not slide_to_roll.any():
        raise CurveError(file, None, column, "slide-to-roll ratios that are all 0", "some that are not")


def remarks(
    slide_to_roll: Float64[np.ndarray, " point"], traction_coefficient: Float64[np.ndarray, " point"]
) -> Sequence[str]:
    """Notes on values that are allowed and often a mistake."""
    notes = []
    largest = np.abs(slide_to_roll).max()
    if largest > _LARGEST_USUAL:
        notes.append(
            f"The largest slide-to-roll ratio is {largest:g}, surfaces that move against each other; "
            "if the file means percent, its column is 'slide_to_roll [%]'."
        )
    opposite = np.count_nonzero(np.sign(slide_to_roll) * np.sign(traction_coefficient) < 0.0)
    if opposite:
        points = "1 point has" if opposite == 1 else f"{opposite} points have"
        notes.append(f"{points} a traction coefficient of another sign than the slide-to-roll ratio: kept as measured.")
    return notes
