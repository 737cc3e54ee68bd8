r"""Effect of growth (by fits, temperatures and speed) on the clearance and roller size of a cylindrical roller bearing.

The raceways, with diameters $d_m \mp D_w$, grow by $\Delta G$ with their rings, and the rollers expand with their
temperature. The diametral clearance becomes $P_d' = P_d + \Delta G_o - \Delta G_i - 2\Delta D_w$.
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
    """Geometry of the bearing after growth."""
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
    """Diametral clearance of the bearing after growth."""
    return Play(_clearance(geometry, growth), None, None, jnp.asarray(True))
