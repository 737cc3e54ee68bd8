"""The Jacobian of a line contact from its two parts: a band by autodiff, and the constant dense kernel.

The residual is a function of pressure P and film H at five neighbouring nodes, and H = H00 + X^2/2 + K P. So

    dR/dP = B_P + B_H K,    dR/dH00 = B_H 1,

with five diagonals in B_P and B_H, found by ten directional derivatives of an elementwise function (nodes that are five
apart share one: "colours"). Each iteration then costs 5 n^2 multiplications for B_H K and one dense LU of
2/3 n^3: a Jacobian by `jax.jacfwd` would cost n directional derivatives with a product by K in each.
"""

import functools
from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .equations import Equations, Point, film_shape, reynolds_residual
from .mesh import Mesh

REACH = 2
"""Neighbours to each side that the residual at a node sees."""
BAND = 2 * REACH + 1


class Linearized(NamedTuple):
    """Rows of the semismooth Newton step at a point: the inner nodes, then the load.

    A node is `cavitated` where P + c R < 0, and its row is P = 0 there; -c R = 0 elsewhere, c = 1/|dR/dP| of the node.
    """

    rows: Float[Array, " row"]
    matrix: Float[Array, "row row"]
    cavitated: Bool[Array, " inner"]
    scale: Float[Array, " inner"]
    film: Float[Array, " node"]


@functools.lru_cache(maxsize=64)
def _static(nodes: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Seed vectors of the colours; for each band offset the colour of the column, masks of nodes and of unknowns."""
    columns = np.arange(nodes)
    seeds = (columns[None, :] % BAND == np.arange(BAND)[:, None]).astype(float)
    inner = np.arange(1, nodes - 1)
    column = inner[None, :] + np.arange(-REACH, REACH + 1)[:, None]
    inside = (column >= 0) & (column < nodes)
    # the pressures at both ends are known: 0
    unknown = (column >= 1) & (column < nodes - 1)
    return seeds, column % BAND, inside.astype(float), unknown.astype(float)


def bands(
    equations: Equations, point: Point, film: Float[Array, " node"], mesh: Mesh
) -> tuple[Float[Array, " inner"], Float[Array, "5 inner"], Float[Array, "5 inner"]]:
    """Residual, and its derivatives by pressure and by film at the offsets -2 to 2 of each inner node."""
    seeds, colour, inside, unknown = _static(mesh.size)
    residual, push = jax.linearize(lambda p, h: reynolds_residual(equations, p, h, mesh), point.pressure, film)
    zero, seeds = jnp.zeros_like(film), jnp.asarray(seeds)
    by_pressure = jax.vmap(lambda seed: push(seed, zero))(seeds)
    by_film = jax.vmap(lambda seed: push(zero, seed))(seeds)
    row = jnp.arange(mesh.size - 2)[None, :]
    pick = lambda compressed, mask: compressed[colour, row] * mask
    return residual, pick(by_pressure, unknown), pick(by_film, inside)


def linearize(equations: Equations, point: Point, mesh: Mesh) -> Linearized:
    """Rows and matrix at a point."""
    film = film_shape(point, mesh)
    residual, band_p, band_h = bands(equations, point, film, mesh)
    inner = mesh.size - 2
    # the barrier keeps the compiler from copying the shifted constant five times
    kernel = jax.lax.optimization_barrier(jnp.asarray(np.pad(mesh.kernel, ((1, 1), (0, 0)))))
    offset = np.arange(inner)[None, :] - np.arange(inner)[:, None]
    by_pressure = jnp.zeros((inner, inner))
    for i in range(BAND):
        by_pressure += band_h[i][:, None] * kernel[i : i + inner]
        by_pressure += jnp.where(offset == i - REACH, band_p[i][:, None], 0.0)
    by_offset = jnp.sum(band_h, axis=0)

    diagonal = jnp.abs(jnp.diagonal(by_pressure))
    scale = jax.lax.stop_gradient(1.0 / jnp.where(diagonal > 0, diagonal, 1.0))
    pressure = point.pressure[1:-1]
    cavitated = pressure + scale * residual < 0
    rows = jnp.where(cavitated, pressure, -scale * residual)
    load = jnp.sum(jnp.asarray(mesh.weight) * pressure) - 0.5 * jnp.pi
    top = jnp.where(cavitated[:, None], jnp.asarray(np.eye(inner)), -scale[:, None] * by_pressure)
    border = jnp.where(cavitated, 0.0, -scale * by_offset)
    matrix = jnp.concatenate(
        [
            jnp.concatenate([top, border[:, None]], axis=1),
            jnp.concatenate([jnp.asarray(mesh.weight), jnp.zeros(1)])[None, :],
        ]
    )
    return Linearized(jnp.concatenate([rows, load[None]]), matrix, cavitated, scale, film)


def as_point(values: Float[Array, " row"]) -> Point:
    """Inner pressures and offset as a point, 0 at both ends."""
    zero = jnp.zeros(1)
    return Point(jnp.concatenate([zero, values[:-1], zero]), values[-1])


class Equilibrium(eqx.Module):
    """Rows of the equations at a point for a given set of cavitated nodes, as implicit differentiation needs them."""

    cavitated: Bool[Array, " inner"]
    scale: Float[Array, " inner"]

    def rows(self, equations: Equations, point: Point, mesh: Mesh) -> Float[Array, " row"]:
        residual = reynolds_residual(equations, point.pressure, film_shape(point, mesh), mesh)
        rows = jnp.where(self.cavitated, 0.0, -self.scale * residual)
        return jnp.concatenate([rows, jnp.zeros(1)])
