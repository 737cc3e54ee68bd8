"""Facts about the seats of a mounted bearing, as text."""

from collections.abc import Iterator, Mapping

import numpy as np
from jaxtyping import Array

from ...bearings.growth import FitResult
from ..display import digits, with_unit

_SEATS = {"inner": "inner ring on the shaft", "outer": "outer ring in the housing"}


def fit_facts(fit: FitResult, outer_speed: float) -> Iterator[tuple[str, str]]:
    """Name and text of each fact: the clearance (or axial position of first contact) from drawing to operation, and the
    seats.

    **Arguments:** `outer_speed`: speed of the outer ring and its housing, rad/s; 0 leaves out the speed at which the
    outer ring becomes loose."""
    um = lambda value, sign="": f"{1e6 * float(np.asarray(value)):{sign}.1f}"
    parts = {"fits": fit.by_fits, "temperatures": fit.by_temperatures, "speed": fit.by_speed}
    changes = ", ".join(f"{name} {um(value, '+')}" for name, value in parts.items())
    if fit.clearance is not None:
        angle = "" if fit.contact_angle is None else f"; contact angle {with_unit(float(fit.contact_angle), 'rad', 4)}"
        yield "Clearance", f"{um(fit.drawn)} -> {um(fit.clearance)} um: {changes}{angle}"
    elif fit.axial_shift is not None:
        yield "First contact", f"moves the inner ring axially by {um(fit.axial_shift, '+')} um: {changes}"
    seats = list(_seats(fit, {"inner": fit.loose_speed, "outer": fit.loose_speed_outer if outer_speed else None}))
    if seats:
        yield "Seats", ", ".join(seats)


def _seats(fit: FitResult, loose_from: Mapping[str, Array | None]) -> Iterator[str]:
    for ring, words in _SEATS.items():
        interference, pressure = getattr(fit, f"interference_{ring}"), getattr(fit, f"pressure_{ring}")
        if interference is None:
            continue
        size = 1e6 * float(interference)
        if size < 0.0:
            yield f"{words} loose by {-size:.1f} um"
            continue
        at = f"{words} tight by {size:.1f} um at {digits(1e-6 * float(pressure), 3)} MPa"
        speed = loose_from[ring]
        if speed is not None and np.isfinite(float(speed)):
            at += f", loose from {with_unit(float(speed), 'rad/s', 3)}"
        yield at
