"""The convex energy of a cylindrical roller bearing whose inner ring is held and whose other ring bends, or whose races
are not round: rollers carry evenly along their length, so that the ring feels forces across the axis only."""

import dataclasses

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.arrow import ArrowPoint, linearize, solve_arrow
from ...numerics.newton import newton_solve
from ..ring import LENGTH_UNIT, held_ring
from ..row import AbstractRow, HeldRow
from .equations import DryRollerSystem
from .in_plane import outward
from .scene import CylindricalRollerBearing
from .steady import build_system, port_of

PALMGREN_ENERGY = 0.9 / 1.9
"""Elastic energy of a contact over load times approach, whose approach grows as the load to the power 0.9."""


class InPlaneRow(AbstractRow):
    """Rollers that carry evenly along their length. `elements`: amplitudes of the outer ring, in units of
    `LENGTH_UNIT`, as one column; there are none where the ring is rigid."""

    scene: CylindricalRollerBearing
    expansion: Float[Array, ""]

    def initial(self, displacement: Float[Array, "5"]) -> Float[Array, "m element"]:
        return self._held(displacement).initial().globals[:, None]

    def hold(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> HeldRow:
        system, result = newton_solve(self._held(displacement))
        assert isinstance(system, DryRollerSystem)
        load = system.loads(system.inward_shift(result.point))[0]
        port = port_of(system, result, load[0])
        return HeldRow(_energy(system, load, result.point), port.force, port.stiffness, result.point.globals[:, None])

    def force_at(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> Float[Array, "5"]:
        system = self._held(displacement)
        point = ArrowPoint(jnp.zeros((0, system.azimuth.shape[0])), jax.lax.stop_gradient(elements[:, 0]))
        # one step from the root, which does not move it and carries the derivative
        equations, jacobian = linearize(system, point)
        step = solve_arrow(jax.lax.stop_gradient(jacobian), equations.residual)
        point = jax.tree.map(lambda here, moved: here - moved, point, step)
        load = system.loads(system.inward_shift(point))[0]
        return jnp.zeros(5).at[1:3].set(outward(system.azimuth) @ load[0])

    def _held(self, displacement: Float[Array, "5"]) -> DryRollerSystem:
        scene = dataclasses.replace(self.scene, contact=None)
        # evenly loaded rollers do not feel a tilt
        across = displacement.at[3:].set(0.0)
        ring = held_ring(across, scene.ring_lever, scene.port_distance, jnp.zeros(()), self.expansion)
        system = build_system(scene, ring)
        assert isinstance(system, DryRollerSystem)
        return system


def _energy(system: DryRollerSystem, load: Float[Array, "2 roller"], point: ArrowPoint) -> Float[Array, ""]:
    """Energy of contacts and ring less the work of centrifugal forces and of given loads on the ring, J."""
    approach = system.contact.palmgren_approach(load)
    contacts = PALMGREN_ENERGY * jnp.sum(load * approach) - system.centrifugal() * jnp.sum(approach[1])
    if system.outer is None:
        return contacts
    amplitudes = system.amplitudes(point.globals)
    # rollers follow the ring outwards
    thrown = system.centrifugal() * jnp.sum(system.outer.deflection(amplitudes))
    return contacts - thrown + system.outer.ring.energy(LENGTH_UNIT * amplitudes)
