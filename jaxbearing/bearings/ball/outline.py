"""Outline of a ball and of its grooves, for drawings."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..flanks import SECOND
from ..outline import RING_SIDE, RING_THICKNESS, Outline, Point, moved

if TYPE_CHECKING:
    from .scene import BallBearing
else:
    BallBearing = Any

_SHOULDER = 0.3
"""Height of the shoulders above the ball centre, in ball diameters; assumed, because scenes do not give it."""


def ball_outline(scene: BallBearing, of: Callable[[str], float] | None) -> Outline:
    """Outline of a ball and its rings (see `AbstractBearing.outline`)."""
    geometry = scene.geometry
    diameter, half = 1e3 * float(geometry.ball_diameter), 500.0 * float(geometry.ball_diameter)
    free = float(geometry.nominal_angle)
    contacts: dict[str, tuple[Point, Point]] = {}
    rings = []
    for side, sign in (("outer", 1.0), ("inner", -1.0)):
        angle = free if of is None else of(f"contact_angle_{side}")
        direction = sign * math.sin(angle), sign * math.cos(angle)
        conformity, apart = float(getattr(geometry, f"conformity_{side}")), getattr(geometry.arcs, side)
        contacts[side] = moved((0.0, 0.0), direction, half), direction
        if apart is None:
            rings.append(_groove(diameter, conformity, direction, sign))
            continue
        rings.append(_two_arcs(diameter, conformity, direction, sign, 1e3 * float(apart)))
        back = -free if of is None else of(f"contact_angle_{side}{SECOND}")
        direction = sign * math.sin(back), sign * math.cos(back)
        contacts[f"{side}{SECOND}"] = moved((0.0, 0.0), direction, half), direction
    point = lambda sign, at: (sign * half * math.sin(at), sign * half * math.cos(at))
    labels = {
        "ball_diameter": (-0.6 * half, 0.0),
        "conformity_outer": point(1.0, free - 0.5),
        "conformity_inner": point(-1.0, free - 0.5),
    }
    if geometry.contact_angle is not None:
        labels["contact_angle"] = (0.5 * point(1.0, free)[0], 0.5 * point(1.0, free)[1])
    return Outline(
        diameter=diameter,
        rings=rings,
        element=None,
        line=(_carrying(contacts, "inner", of), _carrying(contacts, "outer", of)),
        contacts=contacts,
        shoulder=_SHOULDER * diameter,
        dimensions=[((-half, 0.0), (half, 0.0))],
        labels=labels,
    )


def _carrying(contacts: dict[str, tuple[Point, Point]], race: str, of: Callable[[str], float] | None) -> Point:
    """Position of the most loaded contact on a race; without loads, of the first contact."""
    sides = [side for side in (race, f"{race}{SECOND}") if side in contacts]
    return contacts[sides[0] if of is None else max(sides, key=lambda side: of(f"load_{side}"))][0]


def _groove(diameter: float, conformity: float, direction: Point, sign: float) -> list[Point]:
    """Outline of a ring whose groove touches the ball in the given direction: the part above (`sign` 1, outer ring) or
    below (`sign` -1, inner ring) the shoulders. Lengths in mm."""
    radius = conformity * diameter
    cx, cy = moved((0.0, 0.0), direction, (0.5 - conformity) * diameter)
    shoulder = sign * _SHOULDER * diameter
    reach = math.sqrt(max(radius * radius - (shoulder - cy) ** 2, 0.0))
    start = math.atan2(sign * (shoulder - cy), reach)
    angles = np.linspace(math.pi - start, start, 40)
    arc = [(cx + radius * math.cos(a), cy + sign * radius * math.sin(a)) for a in angles]
    end, back = (0.5 + RING_SIDE) * diameter, sign * (0.5 + RING_THICKNESS) * diameter
    return [(-end, shoulder), *arc, (end, shoulder), (end, back), (-end, back)]


def _two_arcs(diameter: float, conformity: float, direction: Point, sign: float, apart: float) -> list[Point]:
    """Outline of a ring with two groove arcs, the first of which touches the ball in the given direction; see
    `_groove`.

    **Arguments:** `apart`: distance of the centres of the arcs from the middle plane of the ring, mm."""
    radius = conformity * diameter
    cx, cy = moved((0.0, 0.0), direction, (0.5 - conformity) * diameter)
    shoulder = sign * _SHOULDER * diameter
    reach = math.sqrt(max(radius * radius - (shoulder - cy) ** 2, 0.0))
    middle, other = cx + sign * apart, cx + 2.0 * sign * apart
    arc = []
    for x in np.linspace(
        min(cx + sign * reach, other - sign * reach), max(cx + sign * reach, other - sign * reach), 61
    ):
        centre = cx if sign * (x - middle) >= 0.0 else other
        arc.append((float(x), cy + sign * math.sqrt(max(radius * radius - (x - centre) ** 2, 0.0))))
    end, back = (0.5 + RING_SIDE) * diameter, sign * (0.5 + RING_THICKNESS) * diameter
    return [(-end, shoulder), *arc, (end, shoulder), (end, back), (-end, back)]
