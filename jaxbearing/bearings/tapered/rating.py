"""Sizes and loads of a tapered roller bearing from which its life is computed."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..rated import RatedContacts, is_misaligned, sizes_of_loads
from ..solution import LaminaLoads

if TYPE_CHECKING:
    from .scene import TaperedRollerBearing
else:
    TaperedRollerBearing = Any


def rated_contacts(
    scene: TaperedRollerBearing, laminae: LaminaLoads | None, force: Float[Array, " freedom"] | None = None
) -> RatedContacts:
    """Sizes and loads of the raceway contacts for the life.

    **Arguments:** `laminae`: loads of the laminae of a solution, `None` if the bearing is unloaded; `force`: the field
    `force` of the solution.
    """
    if laminae is None:
        unloaded = jnp.zeros((scene.n_elements, 1))
        laminae = LaminaLoads(unloaded, unloaded)
    geometry, operation = scene.geometry, scene.operation
    radial, axial = (None, None) if is_misaligned(operation) else sizes_of_loads(operation, force)
    return RatedContacts(
        n_elements=geometry.n_rollers,
        diameter=geometry.mean_roller_diameter,
        pitch_diameter=geometry.pitch_diameter,
        contact_angle=geometry.contact_angle,
        rings=scene.materials.rings,
        inner_ring=scene.materials.inner_ring,
        elements=scene.materials.rollers,
        inner=laminae.inner,
        outer=laminae.outer,
        length=geometry.roller_length,
        profiled=laminae.profiled,
        radial_load=radial,
        axial_load=axial,
    )
