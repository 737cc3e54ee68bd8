"""Semismooth Newton's method for a line contact: a new active set in each step, limited steps, no exceptions."""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from ..numerics.dense import solve_dense
from ..numerics.status import Status
from .equations import Equations, Point, film_shape
from .linear import as_point, linearize
from .mesh import Mesh

LONGEST_STEP = 0.3
"""Largest change of a pressure in one step, in Hertz pressures."""
DEEPEST_FALL = 0.8
"""Largest part of the film at a node that one step may remove."""

ROUNDING = 1e-14
"""Largest change of an unknown that counts as round-off."""


class Root(NamedTuple):
    """Result of the iteration; after a failure, the last finite point. `step`: largest change of an unknown in
    the last step; `residual`: largest row before that step."""

    point: Point
    status: Int[Array, ""]
    iterations: Int[Array, ""]
    step: Float[Array, ""]
    residual: Float[Array, ""]
    cavitated: Bool[Array, " inner"]
    """Nodes that cavitate, in the last step."""

    @property
    def converged(self) -> Bool[Array, ""]:
        return self.status == Status.CONVERGED


def newton(
    equations: Equations, guess: Point, mesh: Mesh, *, tolerance: float, max_steps: int, wanted: Bool[Array, ""]
) -> Root:
    """Newton steps until the largest change of an unknown by a full step is below `tolerance` and the set of cavitated
    nodes is that of the step before.

    `guess`: its film must be > 0 everywhere; `wanted`: where False, no step is made and the status is not converged.
    """

    def go_on(root: Root) -> Bool[Array, ""]:
        return root.status < 0

    def advance(root: Root) -> Root:
        linear = linearize(equations, root.point, mesh)
        step = as_point(-solve_dense(linear.matrix, linear.rows))
        change = jnp.maximum(jnp.max(jnp.abs(step.pressure)), jnp.abs(step.offset))
        flat = mesh_film_change(step, mesh)
        fall = jnp.max(-flat / linear.film)
        most = jnp.max(jnp.abs(step.pressure))
        fraction = jnp.minimum(1.0, LONGEST_STEP / jnp.maximum(most, LONGEST_STEP))
        fraction = jnp.minimum(fraction, DEEPEST_FALL / jnp.maximum(fall, DEEPEST_FALL))
        usable = jnp.isfinite(change)
        point = jax.tree.map(lambda z, d: jnp.where(usable, z + fraction * d, z), root.point, step)
        # without the rounding of P - P
        empty = jnp.concatenate([jnp.ones(1, bool), linear.cavitated, jnp.ones(1, bool)]) & usable & (fraction >= 1.0)
        point = Point(jnp.where(empty, 0.0, point.pressure), point.offset)
        iterations = root.iterations + 1
        # pressures at the edge of the film are below any tolerance: there the set itself must no longer change
        resting = jnp.all(linear.cavitated == root.cavitated) | (change <= ROUNDING)
        done = usable & (change <= tolerance) & resting
        status = jnp.where(iterations >= max_steps, int(Status.NOT_CONVERGED), -1)
        status = jnp.where(done, int(Status.CONVERGED), status)
        status = jnp.where(usable, status, int(Status.DIVERGED))
        return Root(point, status, iterations, change, jnp.max(jnp.abs(linear.rows)), linear.cavitated)

    start = jnp.where(wanted, -1, int(Status.NOT_CONVERGED))
    nothing = jnp.asarray(jnp.inf)
    none = jnp.zeros(mesh.size - 2, dtype=bool)
    return jax.lax.while_loop(go_on, advance, Root(guess, start, jnp.asarray(0), nothing, nothing, none))


def mesh_film_change(step: Point, mesh: Mesh) -> Float[Array, " node"]:
    """Change of the film by a change of the unknowns."""
    return step.offset + jnp.asarray(mesh.kernel) @ step.pressure[1:-1]


def smallest_film(point: Point, mesh: Mesh) -> Float[Array, ""]:
    """Smallest H of a point."""
    return jnp.min(film_shape(point, mesh))
