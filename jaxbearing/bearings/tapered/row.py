"""The convex energy of a tapered roller bearing whose ring is held."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..ring import held_ring
from ..row import AbstractRow, HeldRow, settled_force, settled_row
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

    def initial(self, displacement: Float[Array, "5"]) -> Float[Array, "m element"]:
        return self._held(displacement).initial().elements

    def hold(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> HeldRow:
        held, full = self._both(displacement)
        return settled_row(full, held.ring, elements)

    def force_at(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> Float[Array, "5"]:
        held, full = self._both(displacement)
        return settled_force(full, held.ring, elements)

    def _both(self, displacement: Float[Array, "5"]) -> tuple[TaperedSystem, TaperedSystem]:
        """The equations with the ring held, and with the ring free, which give the force on it."""
        held = self._held(displacement)
        return held, build_tapered(self.scene, held.ring.released(held.load_scale()))
