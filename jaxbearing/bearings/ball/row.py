"""Convex energy of a ball bearing whose inner ring is held (see `bearings.row`)."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..ring import levers, shift_matrix
from ..row import AbstractRow, HeldRow, RowState, free_ring
from .build import build_core
from .scene import BallBearing
from .springs import CentrifugalProblem
from .start import force_at, hold


class BallRow(AbstractRow):
    """A row of balls in grooves that move to first order with the tilts of the ring.

    **Arguments:** `problem`: convex problem with all five degrees of freedom, as lengths; `lever`: lever of the tilts,
    m; `distance`: axial distance of the plane of the inner groove centres from the port, m.
    """

    problem: CentrifugalProblem
    lever: Float[Array, ""]
    distance: Float[Array, ""]

    def initial(self, displacement: Float[Array, "5"]) -> RowState:
        bent = self.problem.bent
        return RowState(jnp.zeros((2, self.problem.groove.shape[1])), jnp.zeros(bent.modes) if bent else None)

    def hold(self, displacement: Float[Array, "5"], state: RowState) -> HeldRow:
        arm, shift = levers(self.lever), shift_matrix(self.distance)
        held = hold(self.problem, (shift @ displacement) * arm, state.elements, state.amplitudes)
        stiffness = held.stiffness * arm[:, None] * arm[None, :]
        state = RowState(held.centre, held.amplitudes)
        return HeldRow(held.energy, shift.T @ (held.force * arm), shift.T @ stiffness @ shift, state)

    def force_at(self, displacement: Float[Array, "5"], state: RowState) -> Float[Array, "5"]:
        arm, shift = levers(self.lever), shift_matrix(self.distance)
        force = force_at(self.problem, (shift @ displacement) * arm, state.elements, state.amplitudes)
        return shift.T @ (force * arm)


def ball_row_of(scene: BallBearing, expansion: Array) -> BallRow:
    """The row of a scene at its speeds. Contact laws and loads of the scene have no effect.

    **Arguments:** `expansion`: see `InnerRing.expansion`, m."""
    ring = free_ring(scene.ring_lever, scene.port_distance, expansion)
    problem = build_core(scene, exact=False, ring=ring).at_free_angle()
    return BallRow(problem, jnp.asarray(ring.lever), jnp.asarray(scene.port_distance))
