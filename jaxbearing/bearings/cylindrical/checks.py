"""Range checks that apply to cylindrical roller bearings only."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp

from ..._checks import Information
from ...numerics.safe import safe_norm
from ..facts import LOADED, Excess, RangeChecks, SolvedBearing
from ..parts import azimuths
from .kinematics import roller_kinematics

if TYPE_CHECKING:
    from .scene import CylindricalRollerBearing
else:
    CylindricalRollerBearing = Any


def _squeezed(result: SolvedBearing) -> Excess:
    scene = result.scene
    if not scene.tilts or result.held:
        return {}
    load, opening = result.facts.contacts[0].load, result.facts.opening
    if opening is not None:
        # a roller between films carries some load everywhere
        load = jnp.where(opening < 0, load, 0.0)
    azimuth = azimuths(scene.geometry, load.shape[1])
    outward = jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])
    resultant = outward @ load[0]
    opposite = resultant @ outward < -0.5 * safe_norm(resultant[0], resultant[1])
    behind = jnp.max(jnp.where(opposite, load[0], 0.0))
    loose = jnp.asarray(scene.geometry.diametral_clearance) > 0
    text = "the tilt takes up the whole clearance: rollers opposite the load are squeezed"
    return {text: jnp.where(loose, behind - LOADED * jnp.max(load), -1.0)}


def _standing_cage(scene: CylindricalRollerBearing) -> Excess:
    if scene.contact is None:
        return {}
    motion = roller_kinematics(scene.geometry, scene.operation)
    text = Information("rolling without slip would nearly hold the cage still: its slip has no meaning")
    return {text: 0.01 * motion.orbit_unit - jnp.abs(motion.free_orbit)}


CHECKS = RangeChecks(results=(_squeezed,), inputs=(_standing_cage,))
