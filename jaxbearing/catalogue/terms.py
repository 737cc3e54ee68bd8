"""Terms of the least-squares problem of an internal geometry (`estimate`): usual proportions, and given numbers."""

import math
from collections.abc import Mapping

from .designation import Designation
from .geometry import Geometry
from .proportions import Normal, proportions_of

UNKNOWNS = ("diameter", "pitch", "length", "inner_groove", "outer_groove", "angle")
"""Unknowns: natural logarithms of element diameter (mm; of tapered rollers, at mid length), pitch diameter (mm),
effective roller length (mm) and both conformities minus 0.5, and the contact angle (rad)."""
GIVEN = 1e-5
"""Standard deviation of given numbers: of a logarithm, or of an angle in rad."""

USUAL_ANGLES = {"angular_contact": Normal(30.0, 5.0), "spindle": Normal(15.0, 3.0)}
"""Contact angle where the designation states none, degrees: the designs without a suffix differ between makers."""


def angle_of(bearing: Designation, angle: float | None) -> Normal:
    """Contact angle, rad; without deviation where it is given or stated by the designation."""
    if angle is not None:
        return Normal(angle, 0.0)
    if bearing.contact_angle is not None:
        return Normal(math.radians(bearing.contact_angle), 0.0)
    if bearing.usual_angle is not None and bearing.tightness is not None:
        return Normal(math.radians(bearing.usual_angle), math.radians(bearing.tightness))
    usual = USUAL_ANGLES.get(bearing.kind, Normal(0.0, 0.0))
    return Normal(math.radians(usual.mean), math.radians(usual.deviation))


def terms_of(bearing: Designation, known: Mapping[str, float], angle: Normal) -> dict[str, list[float]]:
    """Means and weights (1/deviation) of the terms of the least-squares problem; arguments as those of `estimate`."""
    usual = proportions_of(bearing.kind, bearing.series)
    half, mean = 0.5 * (bearing.outside - bearing.bore), 0.5 * (bearing.outside + bearing.bore)
    shifted = lambda law, scale: Normal(law.mean + math.log(scale), law.deviation)
    has_length = math.isfinite(usual.length.deviation)
    priors = {
        "diameter": shifted(usual.diameter, half),
        "pitch": shifted(usual.pitch, mean),
        "length": shifted(usual.length, bearing.race_width) if has_length else Normal(0.0, GIVEN),
        "inner_groove": usual.inner_groove,
        "outer_groove": usual.outer_groove,
        "angle": angle,
    }
    for name, field in (("diameter", "diameter"), ("pitch", "pitch_diameter"), ("length", "length")):
        if field in known:
            priors[name] = Normal(math.log(1e3 * known[field]), GIVEN)
    ratings = [
        _rating(known.get(name), law)
        for name, law in (("dynamic_capacity", usual.dynamic), ("static_capacity", usual.static))
    ]
    weight = lambda law: 1.0 / max(law.deviation, GIVEN)
    return {
        "mean": [priors[name].mean for name in UNKNOWNS],
        "weight": [weight(priors[name]) for name in UNKNOWNS],
        "rating": [law.mean for law in ratings],
        "rating_weight": [weight(law) for law in ratings],
        "fill": [usual.fill.mean, usual.gap_fill.mean, usual.angle_fill.mean],
        "fill_weight": [weight(law) for law in (usual.fill, usual.gap_fill, usual.angle_fill)],
    }


def _rating(value: float | None, law: Normal) -> Normal:
    """Distribution of ln of the computed rating, N, that corresponds to a printed one."""
    return Normal(0.0, math.inf) if value is None else Normal(math.log(value) - law.mean, law.deviation)


def is_usual(bearing: Designation, geometry: Geometry, angle: Normal, reach: float) -> bool:
    """True if each number of a geometry is within `reach` standard deviations of the usual proportions.

    **Arguments:** as for `estimate`; `geometry`: its result; `reach`: number of deviations.
    """
    terms = terms_of(bearing, {}, angle)
    size = lambda estimate: math.log(1e3 * estimate.value)
    groove = lambda estimate: math.log(estimate.value - 0.5)
    unknowns = [size(geometry.diameter), size(geometry.pitch_diameter), size(geometry.length)]
    unknowns += [groove(geometry.conformity_inner), groove(geometry.conformity_outer), geometry.contact_angle.value]
    laws = zip(unknowns, terms["mean"], terms["weight"], strict=True)
    return all(abs(value - mean) * weight <= reach for value, mean, weight in laws)
