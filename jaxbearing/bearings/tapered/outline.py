"""Outline of a tapered roller between cup, cone and rib, for drawings."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..outline import RING_SIDE, RING_THICKNESS, Outline, Point, between, moved

if TYPE_CHECKING:
    from .scene import TaperedRollerBearing
else:
    TaperedRollerBearing = Any


def tapered_outline(scene: TaperedRollerBearing) -> Outline:
    """See `AbstractBearing.outline`. The common apex of the cones lies to the right, on the axis."""
    geometry = scene.geometry
    number = lambda value: float(np.asarray(value))
    diameter = 1e3 * number(geometry.roller_diameter)
    far, length = 1e3 * number(geometry.apex_distance), 1e3 * number(geometry.roller_length)
    cup, cone, axis = (number(a) for a in (geometry.contact_angle, geometry.cone_angle, geometry.axis_angle))
    on = lambda angle, reach: (-reach * math.cos(angle), reach * math.sin(angle))
    side, thick = RING_SIDE * diameter, RING_THICKNESS * diameter
    big, small, middle = far, far - length, far - 0.5 * length
    reach = far * math.cos(number(geometry.roller_half_angle))
    touch = moved(on(cone, big), (math.sin(axis), math.cos(axis)), 0.12 * diameter)
    ends = on(cone, big), on(cup, big)
    labels = {
        "roller_diameter": between(*ends, 0.7),
        "roller_length": on(cup, big - 0.4 * length),
        "contact_angle": on(cup, big - 0.75 * length),
        "roller_half_angle": on(0.5 * (cup + cone), small),
        "flange_angle": between(*ends, 0.06),
        "end_radius": between(*ends, 0.4),
    }
    return Outline(
        diameter=diameter,
        rings=[
            _cup(on(cup, big + side), on(cup, small - side), thick),
            _cone(on(cone, big), on(cone, small - side), axis, 0.22 * diameter, side, thick),
        ],
        element=[on(cone, big), on(cup, big), on(cup, small), on(cone, small)],
        line=(on(axis, reach + side), on(axis, reach - length - side)),
        contacts={
            "outer": (on(cup, middle), (math.sin(cup), math.cos(cup))),
            "inner": (on(cone, middle), (-math.sin(cone), -math.cos(cone))),
            "flange": (touch, (-math.cos(axis), math.sin(axis))),
        },
        shoulder=500.0 * number(geometry.mean_roller_diameter),
        dimensions=[(on(cone, big), on(cup, big)), (on(cup, big), on(cup, small))],
        # dimensions that are not given have no value to write
        labels={name: place for name, place in labels.items() if getattr(geometry, name) is not None},
    )


def _cup(big: Point, small: Point, thick: float) -> list[Point]:
    top = max(big[1], small[1]) + thick
    return [big, small, (small[0], top), (big[0], top)]


def _cone(big: Point, small: Point, axis: float, height: float, side: float, thick: float) -> list[Point]:
    """Cross-section of the inner ring (cone), with the rib at the big ends of the rollers."""
    top = moved(big, (math.sin(axis), math.cos(axis)), height)
    bottom = min(big[1], small[1]) - thick
    left = big[0] - 1.4 * side
    return [small, big, top, (left, top[1]), (left, bottom), (small[0], bottom)]
