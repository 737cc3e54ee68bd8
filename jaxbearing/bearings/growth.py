"""Growth of the parts of a bearing that is mounted, warm and turning, and what it makes of its play."""

from typing import NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from .._scene import label


class Growth(NamedTuple):
    """Growth of the diameters of both raceways (of balls: of the groove bottoms), m; thermal strains of inner ring,
    outer ring and rolling elements."""

    inner: Float[Array, ""]
    outer: Float[Array, ""]
    inner_strain: Float[Array, ""]
    outer_strain: Float[Array, ""]
    element_strain: Float[Array, ""]


class Play(NamedTuple):
    """Play of a grown bearing.

    **Arguments:**
    - `measure`: what the family calls its play, m: the diametral clearance (negative: radial preload), of tapered
      bearings the axial displacement that restores touching.
    - `contact_angle`: of the unloaded bearing, rad; `None`: growth does not change it.
    - `axial_shift`: of the inner ring, from first contact on the drawing to first contact here, m; `None`: the bearing
      has no axial contact.
    - `possible`: False where elements and rings cannot touch any more.
    """

    measure: Float[Array, ""]
    contact_angle: Float[Array, ""] | None
    axial_shift: Float[Array, ""] | None
    possible: Float[Array, ""]


class FitResult(eqx.Module):
    """State of a mounted bearing: what fits, temperatures and speeds make of its play.

    What is by fits, by temperatures and by speed is added in this order: fits on the cold bearing at rest, then
    temperatures, then rotation.
    """

    clearance: Float[Array, ""] | None = eqx.field(
        metadata=label("m", "diametral clearance mounted, warm and turning; negative: radial preload")
    )
    contact_angle: Float[Array, ""] | None = eqx.field(
        metadata=label("rad", "contact angle mounted, warm and turning, unloaded")
    )
    axial_shift: Float[Array, ""] | None = eqx.field(
        metadata=label("m", "axial displacement of the inner ring from first contact on the drawing to first contact")
    )
    drawn: Float[Array, ""] = eqx.field(
        metadata=label("m", "clearance on the drawing; of tapered bearings 0, from where the axial shift counts")
    )
    by_fits: Float[Array, ""] = eqx.field(metadata=label("m", "change of clearance, or axial shift, by the fits"))
    by_temperatures: Float[Array, ""] = eqx.field(
        metadata=label("m", "change of clearance, or axial shift, by the temperatures of the parts")
    )
    by_speed: Float[Array, ""] = eqx.field(
        metadata=label("m", "change of clearance, or axial shift, by the rotation of the rings")
    )
    growth_inner: Float[Array, ""] = eqx.field(metadata=label("m", "expansion of the diameter of the inner raceway"))
    growth_outer: Float[Array, ""] = eqx.field(metadata=label("m", "expansion of the diameter of the outer raceway"))
    interference_inner: Float[Array, ""] | None = eqx.field(
        metadata=label("m", "interference of inner ring and shaft in operation; negative: a gap")
    )
    interference_outer: Float[Array, ""] | None = eqx.field(
        metadata=label("m", "interference of outer ring and housing in operation; negative: a gap")
    )
    pressure_inner: Float[Array, ""] | None = eqx.field(metadata=label("Pa", "pressure between inner ring and shaft"))
    pressure_outer: Float[Array, ""] | None = eqx.field(metadata=label("Pa", "pressure between outer ring and housing"))
    loose_speed: Float[Array, ""] | None = eqx.field(
        metadata=label("rad/s", "speed at which the inner ring comes loose on the shaft at these temperatures")
    )
    loose_speed_outer: Float[Array, ""] | None = eqx.field(
        metadata=label("rad/s", "speed of outer ring and housing together at which they part at these temperatures")
    )
    hoop_stress: Float[Array, ""] = eqx.field(metadata=label("Pa", "stress around the bore of the inner ring"))
