r"""Growth of a cylindrical roller bearing: it changes the clearance and the size of the rollers.

The raceways, of diameters $d_m \mp D_w$, grow with their rings: $P_d' = P_d + \Delta G_o - \Delta G_i - 2\Delta D_w$.
Rollers scale with their temperature.
"""

import dataclasses

import jax.numpy as jnp
from jaxtyping import Array

from ..growth import Growth, Play
from .geometry import RollerGeometry


def _clearance(geometry: RollerGeometry, growth: Growth) -> Array:
    rollers = geometry.roller_diameter * growth.element_strain
    return geometry.diametral_clearance + growth.outer - growth.inner - 2.0 * rollers


def running_geometry(geometry: RollerGeometry, growth: Growth) -> RollerGeometry:
    """The geometry of the grown bearing."""
    scale = 1.0 + growth.element_strain
    return dataclasses.replace(
        geometry,
        pitch_diameter=geometry.pitch_diameter + 0.5 * (growth.inner + growth.outer),
        roller_diameter=geometry.roller_diameter * scale,
        roller_length=geometry.roller_length * scale,
        contact_length=None if geometry.contact_length is None else geometry.contact_length * scale,
        diametral_clearance=_clearance(geometry, growth),
    )


def running_play(geometry: RollerGeometry, growth: Growth) -> Play:
    """Clearance of the grown bearing."""
    return Play(_clearance(geometry, growth), None, None, jnp.asarray(True))
