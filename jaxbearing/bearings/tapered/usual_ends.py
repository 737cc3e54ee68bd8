"""Usual end spheres of tapered rollers, and usual angles of their rib. Nothing here imports JAX: `catalogue` needs no
more of the bearings than this."""

from typing import Any

USUAL_END_RADIUS = 0.95
"""Radius of the roller's end sphere over the length of the roller's cone where a scene does not give it; 0.85 to 0.99
are usual."""
USUAL_RIB_HEIGHT = 0.8
"""Distance of the rib contact from the roller's axis over the radius of the big end where a scene does not give the
angle of the rib: low on the rib."""


def usual_end_radius(diameter: Any, half: Any, xp: Any) -> Any:
    """The estimate of R_s, m. **Arguments:** of the big end, m; epsilon, rad; `xp`: module of the sine."""
    return USUAL_END_RADIUS * 0.5 * diameter / xp.sin(half)


def usual_flange_angle(diameter: Any, cup: Any, half: Any, end_radius: Any, xp: Any) -> Any:
    """The estimate of alpha_f, rad. **Arguments:** as of `TaperedGeometry`; `xp`: module of the arc sine."""
    # a sphere smaller than the end face is refused whatever the angle
    return cup - half - xp.arcsin(xp.minimum(USUAL_RIB_HEIGHT * 0.5 * diameter / end_radius, 1.0))
