"""Growth of the parts of a mounted, warm and turning bearing, and its effect on the play."""

from typing import NamedTuple

import equinox as eqx
from jaxtyping import Array, Float

from .._scene import label


class Growth(NamedTuple):
    """Growth of the diameters of both raceways (in ball bearings at the bottom of the grooves), m, and thermal strains
    of inner ring, outer ring and rolling elements."""

    inner: Float[Array, ""]
    outer: Float[Array, ""]
    inner_strain: Float[Array, ""]
    outer_strain: Float[Array, ""]
    element_strain: Float[Array, ""]


class Play(NamedTuple):
    """Play of a bearing after growth of its parts.

    **Arguments:**
    - `measure`: play in the measure of the family, m: the diametral clearance (negative: radial preload), or for
      tapered bearings the axial displacement of the inner ring that restores contact.
    - `contact_angle`: contact angle of the unloaded bearing, rad; `None` if growth does not change it.
    - `axial_shift`: axial displacement of the inner ring from first contact on the drawing to first contact after
      growth, m; `None` if the bearing has no axial contact.
    - `possible`: False if elements and rings can no longer touch.
    """

    measure: Float[Array, ""]
    contact_angle: Float[Array, ""] | None
    axial_shift: Float[Array, ""] | None
    possible: Float[Array, ""]


class FitResult(eqx.Module):
    """State of a mounted bearing: its play after fits, temperatures and speed, and its seats.

    The changes `by_fits`, `by_temperatures` and `by_speed` are counted in this order: fits on the cold bearing at rest,
    then temperatures, then rotation.
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
