"""Angles and spherical ends of tapered rollers from pitch diameter, mean roller diameter, length and cup angle."""

import math
from types import SimpleNamespace
from typing import NamedTuple

from ..bearings.tapered.usual_ends import usual_end_radius, usual_flange_angle

TURNS = 60
"""Number of steps of the fixed-point iteration; each reduces the error to about a fifth of its size."""

_FUNCTIONS = SimpleNamespace(sin=math.sin, arcsin=math.asin, minimum=min)
"""Functions of plain numbers under NumPy's names; the import of NumPy would take a third of the time of a command."""


class TaperedShape(NamedTuple):
    """Roller dimensions that a scene needs. **Arguments:** `roller_diameter`: of the big end, m; `half_angle`,
    `flange_angle`: rad; `end_radius`: m."""

    roller_diameter: float
    half_angle: float
    flange_angle: float
    end_radius: float


def tapered_shape(mean_diameter: float, pitch_diameter: float, length: float, cup_angle: float) -> TaperedShape:
    """The shape whose cones have a common apex.

    With the roller's half angle $\\epsilon$ and its axis at $\\gamma = \\alpha_o - \\epsilon$ the pitch diameter is
    $d_m = D_w\\sin\\gamma/\\tan\\epsilon - l\\cos\\epsilon\\sin\\gamma$ and the mean diameter
    $D_w - l\\sin\\epsilon$, as in `bearings.tapered.geometry`.

    **Arguments:** lengths, m; `cup_angle`: half angle of the cup, rad.
    """
    half = 0.0
    for _ in range(TURNS):
        tilt = math.sin(cup_angle - half)
        big = mean_diameter + length * math.sin(half)
        half = math.atan(big * tilt / (pitch_diameter + length * math.cos(half) * tilt))
    big = mean_diameter + length * math.sin(half)
    radius = float(usual_end_radius(big, half, _FUNCTIONS))
    return TaperedShape(big, half, float(usual_flange_angle(big, cup_angle, half, radius, _FUNCTIONS)), radius)
