"""The rings of a cylindrical roller bearing: the inner one from its operating point, and flexible rings."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..elastic_ring import BentRings, elastic_ring
from ..ring import InnerRing, inner_ring
from .scene import CylindricalRollerBearing


def roller_ring(scene: CylindricalRollerBearing, lever: Array) -> InnerRing:
    """The ring of a scene, NaN where a traced radial load is not positive: a load factor of a transient run may bring
    that about (a known one was refused when the scene was built). `lever`: of `InnerRing`, m."""
    ring, radial = inner_ring(scene, lever), scene.operation.radial_load
    if radial is None:
        return ring
    return ring.under(jnp.where(jnp.asarray(radial) > 0, ring.load, jnp.nan))


def bending_rings(scene: CylindricalRollerBearing, azimuth: Float[Array, " roller"]) -> BentRings:
    """The rings of a scene that bend. **Arguments:** `azimuth`: of the rollers, rad."""
    rings, (inner, outer) = scene.materials.of_rings, scene.raceway_diameters
    return BentRings(
        elastic_ring(scene.outer_ring, rings[1], outer, scene.ring_width, azimuth),
        elastic_ring(scene.inner_ring, rings[0], inner, scene.ring_width, azimuth),
    )
