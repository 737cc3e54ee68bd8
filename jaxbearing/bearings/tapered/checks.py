"""Range checks that apply to tapered roller bearings only."""

from typing import TYPE_CHECKING, Any

import jax.numpy as jnp

from ..._checks import Information
from ..facts import BUSY, Excess, RangeChecks, SolvedBearing

if TYPE_CHECKING:
    from .scene import TaperedRollerBearing
else:
    TaperedRollerBearing = Any


def _skidding(result: SolvedBearing) -> Excess:
    reserve = result.facts.traction_reserve
    if reserve is None:
        return {}
    # every roller with a large load must keep itself rolling; and since the cage transmits forces between rollers,
    # all rollers together must have a reserve too
    own = result.facts.contacts[0].loaded(BUSY)[:1]
    least = jnp.minimum(jnp.min(jnp.where(own, reserve, jnp.inf)), jnp.min(jnp.sum(reserve, axis=1)))
    text = (
        "rollers would skid (to keep them rolling takes more traction than the raceway films have at 10 % sliding): "
        "speeds and losses are those of pure rolling; a scene with a cage models the skidding"
    )
    return {text: -least}


def _at_apex(scene: TaperedRollerBearing) -> Excess:
    if scene.operation.load("tilt") is None and scene.operation.load("tilt_lateral") is None:
        return {}
    text = Information(
        "operation.load_position is 0: radial load and moment act at the common apex of the cones, not at the "
        "bearing's middle"
    )
    return {text: jnp.where(jnp.asarray(scene.operation.load_position) == 0.0, 1.0, -1.0)}


CHECKS = RangeChecks(results=(_skidding,), loads=(_at_apex,))
