"""Tolerance classes of seats (ISO 286), and the normal tolerance class of bearings (ISO 492).

The numbers were read in a maker's fit tables, except those from memory: j5 and j6 above 65 mm, IT4 and IT8, J6 and J7
above 250 mm. Functions refuse a class that is not in the tables. They take and return lengths in m; the diameter may be
traced.
"""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar
from ..numerics.arguments import require_choice

_EDGES = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
"""Upper ends of the diameter ranges, mm; each belongs to the range that it ends."""
_GRADES = {
    4: (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
}
"""Width of the grades IT4 to IT8 in each diameter range, um."""
_UPPER = {
    "h": (0,) * 13,
    "g": (-2, -4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "f": (-6, -10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
}
"""Upper deviation of shafts in each diameter range, um."""
_LOWER = {
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
}
"""Lower deviation of shafts in each diameter range, um."""
_SHAFT_J = {
    5: ((np.nan, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20), (np.nan, 3, 4, 5, 5, 6, 6, 6, 7, 7, 7, 7, 7)),
    6: (
        (np.nan, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
        (np.nan, 6, 7, 8, 9, 11, 12, 13, 14, 16, 16, 18, 20),
    ),
}
_HOLE_J = {
    6: ((np.nan, -3, -4, -5, -5, -6, -6, -6, -7, -7, -7, -7, -7), (np.nan, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33)),
    7: (
        (np.nan, np.nan, -7, -8, -9, -11, -12, -13, -14, -16, -16, -18, -20),
        (np.nan, np.nan, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
    ),
}
"""Lower and upper deviations of holes J by grade, um; `_SHAFT_J` holds those of shafts j."""
_BORE = ((18, 8), (30, 10), (50, 12), (80, 15), (120, 20), (180, 25), (250, 30), (315, 35), (400, 40), (500, 45))
_OUTSIDE = ((18, 8), (30, 9), (50, 11), (80, 13), (120, 15), (150, 18), *_BORE[5:])
"""Diameters of bearings, normal class: (upper end of the range, mm; size of the negative lower deviation, um)."""
_CLOSE = ("K", "M", "N", "P")
"""Holes that are corrected by the difference to the next finer grade (`_step`); they have no grade 4."""
SHAFT_CLASSES = tuple(
    f"{letter}{grade}"
    for letter in ("f", "g", "h", "j", "js", "k", "m", "n", "p")
    for grade in _GRADES
    if letter != "j" or grade in _SHAFT_J
)
HOLE_CLASSES = tuple(
    f"{letter}{grade}"
    for letter in ("F", "G", "H", "J", "JS", *_CLOSE)
    for grade in _GRADES
    if (letter != "J" or grade in _HOLE_J) and (letter not in _CLOSE or grade > 4)
)
"""Tolerance classes of holes in the tables; `SHAFT_CLASSES` are those of shafts."""


class Limits(NamedTuple):
    """Lower and upper limit of a deviation or of an interference, m."""

    lower: Float[Array, ""]
    upper: Float[Array, ""]


def shaft_limits(tolerance: str, diameter: Scalar) -> Limits:
    """Deviations of a shaft's diameter from the nominal one.

    **Arguments:** `tolerance`: such as "k5"; `diameter`: nominal, m, above 0 and at most 0.5.

    **Raises:** `ValueError` for a class that is not in the tables. The limits are NaN for a diameter outside them.
    """
    return _at(diameter, *_shaft(tolerance))


def _shaft(tolerance: str) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper deviation for each range of diameters, um."""
    letter, grade = _parsed(tolerance, SHAFT_CLASSES)
    width = np.asarray(_GRADES[grade], float)
    if letter == "js":
        lower, upper = -0.5 * width, 0.5 * width
    elif letter == "j":
        lower, upper = np.asarray(_SHAFT_J[grade], float)
    elif letter in _UPPER:
        upper = np.asarray(_UPPER[letter], float)
        lower = upper - width
    else:
        lower = np.asarray(_LOWER[letter], float)
        if letter == "k" and grade > 7:
            lower = np.zeros_like(lower)
        upper = lower + width
    return lower, upper


def hole_limits(tolerance: str, diameter: Scalar) -> Limits:
    """Deviations of a housing's bore from the nominal diameter.

    **Arguments:** `tolerance`: such as "J7"; `diameter`: nominal, m, above 0 and at most 0.5.

    **Raises:** `ValueError` as `shaft_limits`.
    """
    return _at(diameter, *_hole(tolerance))


def _hole(tolerance: str) -> tuple[np.ndarray, np.ndarray]:
    letter, grade = _parsed(tolerance, HOLE_CLASSES)
    width = np.asarray(_GRADES[grade], float)
    if letter == "JS":
        lower, upper = -0.5 * width, 0.5 * width
    elif letter == "J":
        lower, upper = np.asarray(_HOLE_J[grade], float)
    elif letter.lower() in _UPPER:
        lower = -np.asarray(_UPPER[letter.lower()], float)
        upper = lower + width
    else:
        upper = -np.asarray(_LOWER[letter.lower()], float) + _step(letter, grade, width)
        if (letter, grade) == ("M", 6):
            # above 250 and up to 315 mm the standard departs from its rule
            upper[_EDGES.index(315)] = -9.0
        lower = upper - width
    return lower, upper


def covered(tolerance: str) -> tuple[float, float]:
    """Range of diameters in the table of a tolerance class, m: above the first value and up to the second."""
    lower, _ = _shaft(tolerance) if tolerance in SHAFT_CLASSES else _hole(tolerance)
    first = int(np.argmax(np.isfinite(lower)))
    return 1e-3 * ((0, *_EDGES)[first]), 1e-3 * _EDGES[-1]


def bore_limits(diameter: Scalar) -> Limits:
    """Deviations of a bearing's bore, normal class; `diameter` in m. NaN beyond 0.5 m."""
    return _below(diameter, _BORE)


def outside_limits(diameter: Scalar) -> Limits:
    """Deviations of a bearing's outside diameter, normal class; `diameter` in m. NaN beyond 0.5 m."""
    return _below(diameter, _OUTSIDE)


def shaft_interference(tolerance: str, diameter: Scalar) -> Limits:
    """Smallest and largest interference of a bearing's bore, normal class, on a shaft; m."""
    shaft, bore = shaft_limits(tolerance, diameter), bore_limits(diameter)
    return Limits(shaft.lower - bore.upper, shaft.upper - bore.lower)


def housing_interference(tolerance: str, diameter: Scalar) -> Limits:
    """Smallest and largest interference of a bearing's outside diameter, normal class, in a housing; m."""
    hole, outside = hole_limits(tolerance, diameter), outside_limits(diameter)
    return Limits(outside.lower - hole.upper, outside.upper - hole.lower)


def _parsed(tolerance: str, classes: tuple[str, ...]) -> tuple[str, int]:
    require_choice("tolerance class", tolerance, classes)
    return tolerance[:-1], int(tolerance[-1])


def _step(letter: str, grade: int, width: np.ndarray) -> np.ndarray:
    """Correction of the deviations of holes in `_CLOSE`, um: width of the grade less that of the next finer grade."""
    step = width - np.asarray(_GRADES[grade - 1], float)
    if letter == "P" and grade == 8:
        return np.zeros_like(step)
    step[0] = 0.0  # no correction up to 3 mm
    return step


def _place(diameter: Scalar, ends: tuple[int, ...]) -> Array:
    """Index of the range of a diameter. Round-off in millimetres must not move a nominal size to the next range."""
    # compare with all ends at once: a bisection is a loop, which costs a tenth of a dry solve
    size = jnp.asarray(diameter) * 1e3 * (1.0 - 1e-12)
    return jnp.searchsorted(jnp.asarray(ends, float), size, side="left", method="compare_all")


def _at(diameter: Scalar, lower: np.ndarray, upper: np.ndarray) -> Limits:
    place, inside = _place(diameter, _EDGES), jnp.asarray(diameter) > 0.0
    pick = lambda row: jnp.where(inside, jnp.asarray([*(1e-6 * row), np.nan])[place], jnp.nan)
    return Limits(pick(lower), pick(upper))


def _below(diameter: Scalar, table: tuple[tuple[int, int], ...]) -> Limits:
    place = _place(diameter, tuple(end for end, _ in table))
    lower = jnp.asarray([*(-1e-6 * np.asarray([deviation for _, deviation in table], float)), np.nan])[place]
    return Limits(jnp.where(jnp.asarray(diameter) > 0.0, lower, jnp.nan), 0.0 * lower)
