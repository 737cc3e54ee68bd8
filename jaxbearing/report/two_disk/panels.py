"""Charts of a two-disk machine: one for each temperature and speed, with one traction curve for each pressure."""

from collections.abc import Sequence

import numpy as np

from ...machines import TwoDiskSolution
from ..colours import CURVES
from ..display import ZERO_CELSIUS, axis_unit
from ..panels import DASHES, MARKERS, Axis, Curves, Series
from .curves import Curve, curves_of


def two_disk_panels(solution: TwoDiskSolution) -> list[Curves]:
    """Charts of traction curves, one for each pair of temperature and speed."""
    curves = list(curves_of(solution))
    places = dict.fromkeys(curve.place[:2] for curve in curves)
    return [
        traction_panel(solution, [curve for curve in curves if curve.place[:2] == place], f"traction-{i}")
        for i, place in enumerate(places)
    ]


def traction_panel(solution: TwoDiskSolution, curves: Sequence[Curve], name: str = "traction") -> Curves:
    """Chart of the traction curves at one temperature and speed."""
    slide = np.asarray(solution.operation.slide_to_roll)
    order = np.argsort(slide, kind="stable")
    return Curves(
        name=name,
        title=operating_point(curves[0]),
        caption="One curve for each pressure.",
        series=[
            Series(
                curve_name(solution, curve),
                100.0 * slide[order],
                curve.of(solution.traction_coefficient)[order],
                CURVES[i % len(CURVES)],
                MARKERS[i % len(MARKERS)],
                DASHES[i // len(CURVES) % len(DASHES)],
            )
            for i, curve in enumerate(curves)
        ],
        x=Axis("slide-to-roll ratio, %"),
        y=Axis("traction coefficient"),
    )


def operating_point(curve: Curve) -> str:
    """Temperature and speed of a curve as text."""
    unit, factor = axis_unit("m/s", curve.entrainment_speed)
    return f"{curve.temperature - ZERO_CELSIUS:.5g} °C, {factor * curve.entrainment_speed:.5g} {unit}"


def curve_name(solution: TwoDiskSolution, curve: Curve) -> str:
    """Name of a curve in its chart: its pressure, or its load and pressure if the operation gives loads."""
    unit, factor = axis_unit("Pa", curve.pressure)
    if solution.operation.pressure is not None:
        return f"{factor * curve.pressure:.4g} {unit}"
    load_unit, load_factor = axis_unit("N", curve.load)
    return f"{load_factor * curve.load:.4g} {load_unit} ({factor * curve.pressure:.3g} {unit})"
