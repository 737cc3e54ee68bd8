"""Internal geometry of a standard bearing: numbers with intervals."""

from typing import NamedTuple


class Estimate(NamedTuple):
    """A number of the geometry: SI value, least and greatest value of its 90 % interval, and whether it was given."""

    value: float
    least: float
    greatest: float
    given: bool = False


class Geometry(NamedTuple):
    """The most probable geometry, and its ratings by the package's formulas.

    **Arguments:** `n_elements`: number of balls or rollers; `diameter`, `pitch_diameter`, `length` (of rollers), m;
    `conformity_inner`, `conformity_outer`: conformities on which the ratings are based; `contact_angle`, rad;
    `dynamic_capacity`, `static_capacity`: computed, N; `standard_size`: whether the diameter is one of the usual sizes.
    """

    n_elements: Estimate
    diameter: Estimate
    pitch_diameter: Estimate
    length: Estimate
    conformity_inner: Estimate
    conformity_outer: Estimate
    contact_angle: Estimate
    dynamic_capacity: float
    static_capacity: float
    standard_size: bool
