"""Sizes and loads of a tapered roller bearing from which its life is computed."""

from typing import Any

import jax.numpy as jnp

from ..rated import RatedContacts
from .scene import TaperedRollerBearing


def rated_contacts(scene: TaperedRollerBearing, laminae: Any) -> RatedContacts:
    """**Arguments:** `LaminaLoads` of a solution."""
    geometry, operation = scene.geometry, scene.operation
    known = not operation.tilts and not operation.displaced
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
        radial_load=operation.radial_size if known else None,
        axial_load=jnp.asarray(operation.axial_load) if known else None,
    )
