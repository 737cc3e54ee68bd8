"""A cylindrical roller between its rings, for drawings."""

from typing import TYPE_CHECKING, Any

from ..outline import RING_SIDE, RING_THICKNESS, Outline

if TYPE_CHECKING:
    from .scene import CylindricalRollerBearing
else:
    CylindricalRollerBearing = Any


def roller_outline(scene: CylindricalRollerBearing) -> Outline:
    """See `AbstractBearing.outline`."""
    diameter, length = 1e3 * float(scene.geometry.roller_diameter), 1e3 * float(scene.geometry.roller_length)
    half, end = 0.5 * diameter, 0.5 * length + RING_SIDE * diameter
    back, x = half + RING_THICKNESS * diameter, 0.5 * length
    ring = lambda sign: [(-end, sign * half), (end, sign * half), (end, sign * back), (-end, sign * back)]
    return Outline(
        diameter=diameter,
        rings=[ring(1.0), ring(-1.0)],
        element=[(-x, -half), (x, -half), (x, half), (-x, half)],
        line=((-end, 0.0), (end, 0.0)),
        contacts={"outer": ((0.0, half), (0.0, 1.0)), "inner": ((0.0, -half), (0.0, -1.0))},
        shoulder=half,
        dimensions=[((0.0, -half), (0.0, half)), ((-x, half), (x, half))],
        labels={"roller_diameter": (0.0, 0.3 * half), "roller_length": (0.4 * x, half)},
        own_directions=False,
    )
