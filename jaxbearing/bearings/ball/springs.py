"""Energy, forces and stiffness of balls between two grooved rings, at frozen centrifugal forces: a convex problem.

See `start`, which minimises the energy.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.safe import safe_norm
from ..elastic_ring import BentRings, ElasticRing
from ..ring import LENGTH_UNIT
from .arcs import Arcs, added, coordinate_map

NO_APPROACH = 1e-300
"""Approach of bodies that do not touch, m: their force is 0, and the root of it has a derivative."""


class CentrifugalProblem(eqx.Module):
    """Balls between two grooves under given forces. Units m, N; (inner, outer) or (axial, radial) first.

    `groove`: coordinates of the inner groove at every ball with the ring at rest (`arcs`; of one arc its centre);
    `directions`: their change for a unit of every coordinate of the rings: the degrees of freedom of the inner one (a
    length each), then the amplitudes of an `outer` and of an `inner` flexible ring; `ring_load`: on the degrees of
    freedom;
    `held_load`: of `InnerRing`; `aligned`: axial displacement at which the planes of the grooves coincide;
    `multiplicity`: balls that each ball stands for.
    """

    offset: Float[Array, "2"]
    stiffness: Float[Array, "2"]
    groove: Float[Array, "p ball"]
    directions: Float[Array, "coordinate p ball"]
    ring_load: Float[Array, " freedom"]
    held_load: Float[Array, ""] | None
    centrifugal: Float[Array, " ball"]
    centre_distance: Float[Array, ""]
    free_cosine: Float[Array, ""]
    aligned: Float[Array, ""]
    multiplicity: int = eqx.field(static=True)
    freedoms: tuple[str, ...] = eqx.field(static=True)
    arcs: Arcs = Arcs()
    outer: ElasticRing | None = None
    inner: ElasticRing | None = None

    @property
    def bent(self) -> BentRings:
        """The flexible rings."""
        return BentRings(self.outer, self.inner)

    def carried(self) -> Float[Array, " mode"]:
        """Generalised loads of the centrifugal forces, which move with the outer groove, on the flexible rings, N."""
        return self.bent.pressed(self.bent.pick(self.centrifugal, jnp.zeros_like(self.centrifugal)))

    def groove_at(self, ring: Float[Array, " coordinate"]) -> Float[Array, "p ball"]:
        return self.groove + jnp.einsum("f,fcn->cn", ring, self.directions)

    def ring_work(self, ring: Float[Array, " coordinate"]) -> Array:
        """Work of the loads on the rings at displacements, m, less the energy of flexible rings, J."""
        if not self.bent:
            return jnp.sum(self.ring_load * ring)
        d = len(self.freedoms)
        return jnp.sum(self.ring_load * ring[:d]) + jnp.sum(self.carried() * ring[d:]) - self.bent.energy(ring[d:])

    def ring_balance(self, ring: Array, force: Float[Array, " coordinate"]) -> Float[Array, " coordinate"]:
        """Derivatives of the whole energy by the displacements of the rings, N; `force`: by those of the grooves."""
        if not self.bent:
            return force - self.ring_load
        d = len(self.freedoms)
        bent = self.bent.balance(ring[d:] / LENGTH_UNIT, self.carried() - force[d:], floats=False)
        return jnp.concatenate([force[:d] - self.ring_load, bent])

    def ring_stiffness(self, ring: Array, matrix: Float[Array, "coordinate coordinate"]) -> Array:
        """Derivatives of `ring_balance`, N/m; `matrix`: those of its `force`."""
        if not self.bent:
            return matrix
        d = len(self.freedoms)
        return matrix.at[d:, d:].add(self.bent.tangent(ring[d:]))


class Forces(NamedTuple):
    """Energy, forces and stiffness of the springs at a ball, for a ball centre and coordinates of the inner groove."""

    energy: Float[Array, " ball"]
    balance: Float[Array, "2 ball"]
    """d energy / d centre."""
    inner: Float[Array, "p ball"]
    """d energy / d groove: forces on the coordinates of the inner groove."""
    stiffness: Float[Array, "2 2 ball"]
    """d balance / d centre."""
    coupling: Float[Array, "2 p ball"]
    """- d balance / d groove."""
    of_groove: Float[Array, "p p ball"]
    """d inner / d groove."""


class Spring(NamedTuple):
    """The contacts of a ball on one ring: energy, J, force that the ball exerts on the ring, N, and stiffness, N/m."""

    energy: Array
    force: Array
    stiffness: Array


def spring(arm: Float[Array, "2 ball"], offset: Array, constant: Array) -> Spring:
    """Energy, force and stiffness of one contact, whose centres are `arm` apart."""
    length = safe_norm(arm[0], arm[1], 1e-30)
    approach = jnp.maximum(length - offset, NO_APPROACH)
    root = jnp.sqrt(approach)
    load = constant * approach * root
    normal = arm / length[None]
    along = normal[:, None] * normal[None, :]
    across = jnp.eye(2)[:, :, None] - along
    stiffness = (1.5 * constant * root)[None, None] * along + (load / length)[None, None] * across
    return Spring(0.4 * load * approach, load[None] * normal, stiffness)


def inner_springs(problem: CentrifugalProblem, centre: Array, groove: Array) -> tuple[Spring, Spring, Array]:
    """The contacts with the inner ring: with respect to ball centre, to the coordinates of the groove, and to both."""
    places = problem.arcs.inner_centres(groove)
    springs = [spring(place - centre, problem.offset[0], problem.stiffness[0]) for place in places]
    if problem.arcs.inner is None:
        return springs[0], springs[0], springs[0].stiffness
    energy = added([one.energy for one in springs])
    ball = Spring(energy, added([one.force for one in springs]), added([one.stiffness for one in springs]))
    pairs = [(one, coordinate_map(side)) for one, side in zip(springs, problem.arcs.inner_sides, strict=True)]
    coupling = added([jnp.einsum("abn,bp->apn", one.stiffness, of) for one, of in pairs])
    force = added([jnp.einsum("ap,an->pn", of, one.force) for one, of in pairs])
    stiffness = added([jnp.einsum("ap,abn,bq->pqn", of, one.stiffness, of) for one, of in pairs])
    return ball, Spring(energy, force, stiffness), coupling


def outer_springs(problem: CentrifugalProblem, centre: Array) -> Spring:
    """The contacts with the outer ring."""
    springs = [spring(arm, problem.offset[1], problem.stiffness[1]) for arm in problem.arcs.from_outer(centre)]
    return Spring(*(added(parts) for parts in zip(*springs, strict=True)))


def forces_at(problem: CentrifugalProblem, centre: Array, groove: Array) -> Forces:
    """The energy and its derivatives at ball centres and coordinates of the inner groove, m."""
    ball, ring, coupling = inner_springs(problem, centre, groove)
    outer = outer_springs(problem, centre)
    push = jnp.stack([jnp.zeros_like(problem.centrifugal), problem.centrifugal])
    energy = ball.energy + outer.energy - problem.centrifugal * centre[1]
    balance, stiffness = outer.force - ball.force - push, outer.stiffness + ball.stiffness
    return Forces(energy, balance, ring.force, stiffness, coupling, ring.stiffness)


def together(stiffness: Float[Array, "2"]) -> Float[Array, ""]:
    """Constant of both contacts of a ball, one behind the other, N/m^(3/2)."""
    return jnp.sum(stiffness ** (-2.0 / 3.0)) ** -1.5
