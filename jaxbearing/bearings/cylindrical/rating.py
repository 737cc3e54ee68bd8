"""Sizes and loads of a cylindrical roller bearing from which its life is computed."""

from typing import TYPE_CHECKING

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..rated import RatedContacts, is_misaligned, sizes_of_loads
from ..solution import LaminaLoads
from .scene import CylindricalRollerBearing

if TYPE_CHECKING:
    from .solution import RollerResults


def rated_contacts(
    scene: CylindricalRollerBearing,
    elements: "RollerResults | None",
    laminae: LaminaLoads | None,
    force: Float[Array, " freedom"] | None = None,
) -> RatedContacts:
    """**Arguments:** `RollerResults`, `None` of an unloaded bearing, and, of rollers in laminae, `LaminaLoads` of a
    solution; `force`: its `force`."""
    geometry, operation = scene.geometry, scene.operation
    radial, _ = sizes_of_loads(operation, force)
    # ISO 281 has no formula for an axial load on flanges: it sends its reader to the maker
    other = is_misaligned(operation) or operation.axial_given
    loads = (jnp.zeros(scene.n_elements),) * 2
    if laminae is not None:
        loads = (laminae.inner, laminae.outer)
    elif elements is not None:
        loads = (elements.load_inner, elements.load_outer)
    return RatedContacts(
        n_elements=geometry.n_rollers,
        diameter=geometry.roller_diameter,
        pitch_diameter=geometry.pitch_diameter,
        contact_angle=0.0,
        rings=scene.materials.rings,
        inner_ring=scene.materials.inner_ring,
        elements=scene.materials.rollers,
        inner=loads[0],
        outer=loads[1],
        length=geometry.loaded_length,
        profiled=laminae is not None and laminae.profiled,
        radial_load=None if other else radial,
    )
