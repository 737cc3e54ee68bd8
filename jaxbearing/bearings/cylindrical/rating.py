"""Sizes and loads of a cylindrical roller bearing from which its life is computed."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..rated import RatedContacts, is_misaligned, sizes_of_loads
from ..solution import LaminaLoads

if TYPE_CHECKING:
    from .scene import CylindricalRollerBearing
    from .solution import RollerResults
else:
    CylindricalRollerBearing = Any


def rated_contacts(
    scene: CylindricalRollerBearing,
    elements: "RollerResults | None",
    laminae: LaminaLoads | None,
    force: Float[Array, " freedom"] | None = None,
) -> RatedContacts:
    """Sizes and loads of the raceway contacts for the life.

    **Arguments:** `elements`: results of the rollers, `None` if the bearing is unloaded; `laminae`: loads of the
    laminae of a solution, used instead of `elements` if there are any; `force`: the field `force` of the solution.
    """
    geometry, operation = scene.geometry, scene.operation
    radial, _ = sizes_of_loads(operation, force)
    # ISO 281 has no formula for an axial load on flanges: it refers to the manufacturer
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
