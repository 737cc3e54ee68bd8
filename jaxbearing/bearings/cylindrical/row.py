"""The row model of a cylindrical roller bearing: frictionless tilting rollers and flanges under a held inner ring."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.safe import positive_power
from ..ring import held_ring
from ..row import AbstractRow, HeldRow, RowState, initial_state, settled_force, settled_row
from .scene import CylindricalRollerBearing
from .thrust import EXPONENT, ThrustFlanges
from .tilting import TiltingRollers
from .tilting_steady import build_tilting

_ACROSS = (0.0, 1.0, 1.0, 1.0, 1.0)


class TiltingRow(AbstractRow):
    """Rollers between straight raceways, with or without flanges."""

    scene: CylindricalRollerBearing
    expansion: Float[Array, ""]

    def _held(self, displacement: Float[Array, "5"]) -> TiltingRollers:
        scene = self.scene
        ring = held_ring(displacement, scene.ring_lever, scene.port_distance, jnp.zeros(()), self.expansion)
        return build_tilting(scene, ring)

    def initial(self, displacement: Float[Array, "5"]) -> RowState:
        return initial_state(self._held(displacement))

    def hold(self, displacement: Float[Array, "5"], state: RowState) -> HeldRow:
        row = settled_row(*self._both(displacement), state)
        # the artificial springs of the unknowns must not support the ring along its axis
        across = jnp.asarray(_ACROSS)
        row = row._replace(force=row.force * across, stiffness=row.stiffness * across[:, None] * across[None, :])
        flanges = self.scene.geometry.thrust_flanges
        return row if flanges is None else _with_flanges(row, flanges, displacement[0])

    def force_at(self, displacement: Float[Array, "5"], state: RowState) -> Float[Array, "5"]:
        held, full = self._both(displacement)
        force = settled_force(held.ring, full, state) * jnp.asarray(_ACROSS)
        flanges = self.scene.geometry.thrust_flanges
        return force if flanges is None else force.at[0].set(flanges.force(displacement[0]))

    def _both(self, displacement: Float[Array, "5"]) -> tuple[TiltingRollers, TiltingRollers]:
        """Two sets of equations: with the ring held, and with the ring free. The second set gives the force on it."""
        held = self._held(displacement)
        return held, build_tilting(self.scene, held.ring.released(held.load_scale()))


def _with_flanges(row: HeldRow, flanges: ThrustFlanges, axial: Array) -> HeldRow:
    sides = [side * axial - flanges.gap for side in flanges.sides]
    energy = flanges.stiffness / (1.0 + EXPONENT) * sum(positive_power(side, 1.0 + EXPONENT) for side in sides)
    # at first contact this power, with exponent 1/9, has an unbounded slope
    touched = [jnp.where(side > 0, jnp.where(side > 0, side, 1.0) ** (EXPONENT - 1.0), 0.0) for side in sides]
    stiffness = flanges.stiffness * EXPONENT * sum(touched)
    return row._replace(
        energy=row.energy + energy,
        force=row.force.at[0].set(flanges.force(axial)),
        stiffness=row.stiffness.at[0, 0].set(stiffness),
    )
