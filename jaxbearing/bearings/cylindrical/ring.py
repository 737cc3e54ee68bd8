"""The rings of a cylindrical roller bearing: the inner ring at its operating point, and flexible rings."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..elastic_ring import BentRings, elastic_ring
from ..ring import InnerRing, inner_ring
from .scene import CylindricalRollerBearing


def roller_ring(scene: CylindricalRollerBearing, lever: Array) -> InnerRing:
    """The inner ring of a scene. Its load is NaN if a traced radial load is not positive, for example because of the
    load factor of a transient run; a known load was checked when the scene was built.

    **Arguments:** `lever`: as in `InnerRing`, m.
    """
    ring, radial = inner_ring(scene, lever), scene.operation.radial_load
    if radial is None:
        return ring
    return ring.under(jnp.where(jnp.asarray(radial) > 0, ring.load, jnp.nan))


def bending_rings(scene: CylindricalRollerBearing, azimuth: Float[Array, " roller"]) -> BentRings:
    """The flexible rings of a scene. **Arguments:** `azimuth`: of the rollers, rad."""
    rings, (inner, outer) = scene.materials.of_rings, scene.raceway_diameters
    return BentRings(
        elastic_ring(scene.outer_ring, rings[1], outer, scene.ring_width, azimuth),
        elastic_ring(scene.inner_ring, rings[0], inner, scene.ring_width, azimuth),
    )
