"""Usual proportions inside rolling bearings, as normal distributions with a mean and a standard deviation.

They are calibrated on bearings with published geometry: 257 spindle bearings of one maker, a few deep groove and
tapered bearings of the literature, and cylindrical roller bearings whose raceway diameters are in catalogues and whose
static ratings give the roller lengths. A maker may build differently, so every estimate has an interval.
"""

import math
from typing import NamedTuple

INCH = 25.4
_SIXTY_FOURTHS = (2, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 22, 24, 26, 28, 30, 32)
BALL_SIZES = (
    *(INCH * n / 64.0 for n in _SIXTY_FOURTHS),
    *(INCH * n / 32.0 for n in range(17, 41)),
    *(INCH * n / 16.0 for n in range(21, 65)),
)
"""Usual ball diameters, mm; most sizes of ISO 3290 are such inch sizes."""
ROLLER_SIZES = (
    *(0.5 * n for n in range(6, 16)),
    *map(float, range(8, 27)),
    *map(float, range(28, 101, 2)),
)
"""Usual diameters of cylindrical rollers, mm."""
GAP = (1.10, -0.078, 0.0228)
"""Coefficients of the gap between balls in a cage, mm: constant, factor of the ball diameter and factor of the pitch
diameter; fitted to the spindle bearings."""
FILL_ANGLE = 189.0
"""Angle that the balls of a deep groove bearing take up side by side, when they are filled in between the rings,
degrees."""


class Normal(NamedTuple):
    """Mean and standard deviation of a quantity; an infinite deviation means that nothing is known."""

    mean: float
    deviation: float

    @property
    def is_known(self) -> bool:
        """True if the deviation is 0, so that the mean is the exact value."""
        return self.deviation == 0.0


NOTHING = Normal(0.0, math.inf)


_ln = math.log
_RATED = Normal(_ln(0.02), 1e-4)
"""Natural logarithm of conformity minus 0.5 for the conformity of 0.52 that ISO 281 and ISO 76 assume."""


class Proportions(NamedTuple):
    """Usual proportions of a type of bearing. Logarithms are natural; lengths are relative to H, half the difference of
    the boundary diameters, to the mean of these, or to a width.

    **Arguments:**
    - `diameter`: ln of rolling element diameter (of tapered rollers, at mid length) over H.
    - `pitch`: ln of pitch diameter over the mean of the boundary diameters.
    - `length`: ln of effective roller length over the width (of the cup, for tapered ones).
    - `fill`: ln of Z D/(pi d_m), of rollers.
    - `gap_fill`: deviation of ln of Z D/(pi d_m) of balls from the one with the gaps of `GAP`.
    - `angle_fill`: deviation of ln of the filling angle of balls from `FILL_ANGLE`.
    - `inner_groove`, `outer_groove`: ln of conformity minus 0.5, for the conformity that the ratings assume.
    - `dynamic`, `static`: ln of a printed rating over the computed one. For many bearings, today's catalogues print
      more than ISO 281 gives.
    """

    diameter: Normal
    pitch: Normal
    dynamic: Normal
    static: Normal
    length: Normal = NOTHING
    fill: Normal = NOTHING
    gap_fill: Normal = NOTHING
    angle_fill: Normal = NOTHING
    inner_groove: Normal = _RATED
    outer_groove: Normal = _RATED


_LENGTHS = {"10": 0.47, "2": 0.58, "3": 0.62, "4": 0.58, "22": 0.62, "23": 0.64}
"""Effective length of cylindrical rollers over the width of the bearing, by series."""


def proportions_of(kind: str, series: str) -> Proportions:
    """The usual proportions of a bearing; arguments are the fields of `Designation`."""
    if kind == "deep_groove":
        thin = series in ("618", "619", "160")
        return Proportions(
            diameter=Normal(_ln(0.58 if thin else 0.60), 0.07 if thin else 0.045),
            pitch=Normal(0.0, 0.004),
            angle_fill=Normal(0.0, 0.03),
            dynamic=Normal(0.03, 0.04),
            static=Normal(0.0, 0.03),
        )
    if kind in ("angular_contact", "spindle"):
        spindle = kind == "spindle"
        return Proportions(
            diameter=Normal(_ln(0.54 if spindle else 0.60), 0.13 if spindle else 0.05),
            pitch=Normal(0.0, 0.004),
            gap_fill=Normal(0.0, 0.05),
            inner_groove=Normal(_ln(0.022), 0.4) if spindle else _RATED,
            outer_groove=Normal(_ln(0.021), 0.15) if spindle else _RATED,
            dynamic=Normal(0.0, 0.012) if spindle else Normal(0.03, 0.05),
            static=Normal(0.0, 0.012) if spindle else Normal(0.0, 0.04),
        )
    if kind == "cylindrical":
        return Proportions(
            diameter=Normal(_ln(0.52 if series == "10" else 0.55), 0.04),
            pitch=Normal(_ln(1.006), 0.004),
            length=Normal(_ln(_LENGTHS[series]), 0.10),
            fill=Normal(_ln(0.86), 0.05),
            dynamic=Normal(0.07, 0.07),
            static=Normal(0.0, 0.03),
        )
    return Proportions(
        diameter=Normal(_ln(0.52), 0.06),
        pitch=Normal(_ln(0.987), 0.012),
        length=Normal(_ln(0.78), 0.09),
        fill=Normal(_ln(0.87), 0.05),
        dynamic=Normal(0.07, 0.08),
        static=Normal(0.0, 0.05),
    )
