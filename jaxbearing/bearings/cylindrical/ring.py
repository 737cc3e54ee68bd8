"""The inner ring of a cylindrical roller bearing, from its operating point."""

import jax.numpy as jnp
from jaxtyping import Array

from ..ring import InnerRing, inner_ring
from .scene import CylindricalRollerBearing


def roller_ring(scene: CylindricalRollerBearing, lever: Array) -> InnerRing:
    """The ring of a scene, NaN where a traced radial load is not positive: a load factor of a run in time may bring
    that about (a known one was refused when the scene was built). `lever`: of `InnerRing`, m."""
    ring, radial = inner_ring(scene, lever), scene.operation.radial_load
    if radial is None:
        return ring
    return ring.under(jnp.where(jnp.asarray(radial) > 0, ring.load, jnp.nan))
