"""The rings of a cylindrical roller bearing: the inner one from its operating point, the outer one if it bends."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..elastic_ring import ElasticRing, elastic_ring
from ..ring import InnerRing, inner_ring
from .scene import CylindricalRollerBearing


def roller_ring(scene: CylindricalRollerBearing, lever: Array) -> InnerRing:
    """The ring of a scene, NaN where a traced radial load is not positive: a load factor of a run in time may bring
    that about (a known one was refused when the scene was built). `lever`: of `InnerRing`, m."""
    ring, radial = inner_ring(scene, lever), scene.operation.radial_load
    if radial is None:
        return ring
    return ring.under(jnp.where(jnp.asarray(radial) > 0, ring.load, jnp.nan))


def bending_ring(scene: CylindricalRollerBearing, azimuth: Float[Array, " roller"]) -> ElasticRing | None:
    """The outer ring of a scene, if it bends. **Arguments:** `azimuth`: of the rollers, rad."""
    geometry = scene.geometry
    if scene.outer_ring is None:
        return None
    width = geometry.roller_length if geometry.width is None else geometry.width
    return elastic_ring(scene.outer_ring, scene.materials.rings, geometry.outer_radius, width, azimuth)
