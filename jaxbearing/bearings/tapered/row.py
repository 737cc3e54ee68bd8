"""The row model of a tapered roller bearing: frictionless rollers under a held inner ring."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..ring import held_ring
from ..row import AbstractRow, HeldRow, RowState, initial_state, settled_force, settled_row
from .build import build_tapered
from .scene import TaperedRollerBearing
from .system import TaperedSystem


class TaperedRow(AbstractRow):
    """Rollers between cone, cup and rib."""

    scene: TaperedRollerBearing
    expansion: Float[Array, ""]

    def _held(self, displacement: Float[Array, "5"]) -> TaperedSystem:
        scene = self.scene
        ring = held_ring(displacement, scene.ring_lever, scene.port_distance, jnp.zeros(()), self.expansion)
        return build_tapered(scene, ring)

    def initial(self, displacement: Float[Array, "5"]) -> RowState:
        return initial_state(self._held(displacement))

    def hold(self, displacement: Float[Array, "5"], state: RowState) -> HeldRow:
        return settled_row(*self._both(displacement), state)

    def force_at(self, displacement: Float[Array, "5"], state: RowState) -> Float[Array, "5"]:
        held, full = self._both(displacement)
        return settled_force(held.ring, full, state)

    def _both(self, displacement: Float[Array, "5"]) -> tuple[TaperedSystem, TaperedSystem]:
        """Two sets of equations: with the ring held, and with the ring free. The second set gives the force on it."""
        held = self._held(displacement)
        return held, build_tapered(self.scene, held.ring.released(held.load_scale()))
