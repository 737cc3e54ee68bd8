"""A bearing without friction whose ring is held: one convex energy, whose gradient is the force on the ring.

Centrifugal forces are those of the unloaded bearing's contact angle, so that force and stiffness come of an energy.
Shafts on bearings begin their search with it, and find the preload of bearings at rest, where it is exact.
"""

import abc
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import ArrowPoint, linearize
from ..numerics.convex import settled
from ..numerics.small_linear import solve_blocks
from .ring import LENGTH_UNIT, InnerRing, levers, shift_matrix
from .solution import RING_FREEDOMS


class HeldRow(NamedTuple):
    """A row under a held ring at its port.

    - `energy`: J, up to a constant.
    - `force`, `stiffness`: as `ring.Port`; the stiffness is symmetric.
    - `elements`: state of the rolling elements, to begin the next search with.
    """

    energy: Float[Array, ""]
    force: Float[Array, "5"]
    stiffness: Float[Array, "5 5"]
    elements: Float[Array, "m element"]


class AbstractRow(eqx.Module):
    """A row of rolling elements between two rings, at its speed."""

    @abc.abstractmethod
    def initial(self, displacement: Float[Array, "5"]) -> Float[Array, "m element"]:
        """First guess of `hold` for the elements."""

    @abc.abstractmethod
    def hold(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> HeldRow:
        """The row with its ring held at a displacement of the port, closure included, m and rad; not differentiated.

        **Arguments:** `elements`: of a displacement nearby, or `initial`.
        """

    @abc.abstractmethod
    def force_at(self, displacement: Float[Array, "5"], elements: Float[Array, "m element"]) -> Float[Array, "5"]:
        """The force of `hold`, with its first derivatives by all numbers; `elements`: those that `hold` found there."""


def free_ring(lever: Array, distance: Array, expansion: Array | None) -> InnerRing:
    """A ring with five unknown freedoms and no load. **Arguments:** as `InnerRing`."""
    return InnerRing(jnp.zeros(5), jnp.zeros(5), jnp.asarray(lever), RING_FREEDOMS, expansion, distance)


def settled_row(full: Any, ring: InnerRing, elements: Float[Array, "m element"]) -> HeldRow:
    """A row of rollers whose equations are the gradient of one potential.

    **Arguments:**
    - `full`: the convex system with all five freedoms of the ring, which scales its residuals by `load_scale`.
    - `ring`: held at the displacement.
    - `elements`: first guess.
    """
    found = settled(full, ArrowPoint(elements, ring.held / LENGTH_UNIT))
    scale, arm = full.load_scale(), levers(ring.lever)
    stiffness = found.stiffness * (scale / LENGTH_UNIT) * arm[:, None] * arm[None, :]
    shift = jnp.eye(5) if ring.distance is None else shift_matrix(ring.distance)
    force = _at_port(full, ring, found.residual)
    return HeldRow(found.energy, force, shift.T @ stiffness @ shift, found.point.elements)


def settled_force(full: Any, ring: InnerRing, elements: Float[Array, "m element"]) -> Float[Array, "5"]:
    """The force of `settled_row` with its first derivatives: one Newton step of the elements, which does not move
    them. **Arguments:** as `settled_row`; `elements`: those that it found."""
    elements, globals_ = jax.lax.stop_gradient(elements), ring.held / LENGTH_UNIT
    equations, jacobian = linearize(full, ArrowPoint(elements, globals_))
    local = jax.lax.stop_gradient(jacobian.local)
    step = solve_blocks(local, equations.residual.elements[:, None, :])[:, 0]
    shared = jnp.broadcast_to(globals_[:, None], (5, elements.shape[1]))
    totals = jnp.sum(full.element(elements - step, shared)[1], axis=1)
    return _at_port(full, ring, full.global_residual(globals_, totals)[0])


def _at_port(full: Any, ring: InnerRing, residual: Float[Array, "5"]) -> Float[Array, "5"]:
    force = (residual * full.load_scale() + full.ring.load) * levers(ring.lever)
    return force if ring.distance is None else shift_matrix(ring.distance).T @ force
