"""The convex energy of a ball bearing whose ring is held."""

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..ring import levers, shift_matrix
from ..row import AbstractRow, HeldRow, free_ring
from .build import build_core
from .scene import BallBearing
from .springs import CentrifugalProblem
from .start import force_at, hold


class BallRow(AbstractRow):
    """Balls in grooves that move to first order with the ring's tilts.

    **Arguments:** `problem`: with all five freedoms, lengths; `lever`: of the tilts, m; `distance`: of the plane of the
    inner groove centres from the port, m.
    """

    problem: CentrifugalProblem
    lever: Float[Array, ""]
    distance: Float[Array, ""]

    def initial(self, displacement: Float[Array, "5"]) -> Float[Array, "m element"]:
        return jnp.zeros((2, self.problem.groove.shape[1]))

    def hold(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> HeldRow:
        arm, shift = levers(self.lever), shift_matrix(self.distance)
        held = hold(self.problem, (shift @ displacement) * arm)
        stiffness = held.stiffness * arm[:, None] * arm[None, :]
        return HeldRow(held.energy, shift.T @ (held.force * arm), shift.T @ stiffness @ shift, held.centre)

    def force_at(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> Float[Array, "5"]:
        arm, shift = levers(self.lever), shift_matrix(self.distance)
        return shift.T @ (force_at(self.problem, (shift @ displacement) * arm, elements) * arm)


def ball_row_of(scene: BallBearing, expansion: Array) -> BallRow:
    """The row of a scene at its speeds; its contact laws and loads have no effect."""
    ring = free_ring(scene.ring_lever, scene.port_distance, expansion)
    problem = build_core(scene, exact=False, ring=ring).at_free_angle()
    return BallRow(problem, jnp.asarray(ring.lever), jnp.asarray(scene.port_distance))
