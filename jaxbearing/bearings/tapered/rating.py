"""Sizes and loads of a tapered roller bearing from which its life is computed."""

from jaxtyping import Array, Float

from ..rated import RatedContacts, is_misaligned, sizes_of_loads
from ..solution import LaminaLoads
from .scene import TaperedRollerBearing


def rated_contacts(
    scene: TaperedRollerBearing, laminae: LaminaLoads, force: Float[Array, " freedom"] | None = None
) -> RatedContacts:
    """**Arguments:** `LaminaLoads` of a solution; `force`: its `force`."""
    geometry, operation = scene.geometry, scene.operation
    radial, axial = (None, None) if is_misaligned(operation) else sizes_of_loads(operation, force)
    return RatedContacts(
        n_elements=geometry.n_rollers,
        diameter=geometry.mean_roller_diameter,
        pitch_diameter=geometry.pitch_diameter,
        contact_angle=geometry.contact_angle,
        rings=scene.materials.rings,
        elements=scene.materials.rollers,
        inner=laminae.inner,
        outer=laminae.outer,
        length=geometry.roller_length,
        profiled=laminae.profiled,
        radial_load=radial,
        axial_load=axial,
    )
