"""Energy, forces and stiffness of balls between two grooved rings under given centrifugal forces: a convex problem.

The module `start` minimises the energy.
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
"""Approach assumed for bodies that do not touch, m. It gives practically no force, and its square root has a
derivative."""


class CentrifugalProblem(eqx.Module):
    """Balls between two grooves under given forces. Units are m and N; the first axis of arrays is (inner, outer) or
    (axial, radial).

    - `offset`, `stiffness`, `centre_distance`, `free_cosine`, `aligned`: as in `Grooves`.
    - `groove`: coordinates of the inner groove at every ball if the coordinates of the rings are 0 (`arcs`; with one
      arc, its centre).
    - `directions`: derivatives of these coordinates by the coordinates of the rings: first the degrees of freedom of
      the inner ring (all lengths), then the amplitudes of an `outer` and of an `inner` flexible ring.
    - `ring_load`: loads on the degrees of freedom; `held_load`: as in `InnerRing`; `centrifugal`: force on each ball.
    - `multiplicity`: number of balls of the bearing that each ball stands for.
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
        """Generalised loads of the centrifugal forces on the amplitudes of flexible rings, N. They exist because the
        balls move with the outer groove."""
        return self.bent.pressed(self.bent.pick(self.centrifugal, jnp.zeros_like(self.centrifugal)))

    def groove_at(self, ring: Float[Array, " coordinate"]) -> Float[Array, "p ball"]:
        return self.groove + jnp.einsum("f,fcn->cn", ring, self.directions)

    def ring_work(self, ring: Float[Array, " coordinate"]) -> Array:
        """Work of the loads on the rings at given coordinates `ring`, m, minus the energy of flexible rings, J."""
        if not self.bent:
            return jnp.sum(self.ring_load * ring)
        d = len(self.freedoms)
        return jnp.sum(self.ring_load * ring[:d]) + jnp.sum(self.carried() * ring[d:]) - self.bent.energy(ring[d:])

    def ring_balance(self, ring: Array, force: Float[Array, " coordinate"]) -> Float[Array, " coordinate"]:
        """Derivatives of the total energy by the coordinates of the rings, N; `force`: the part of the balls, N."""
        if not self.bent:
            return force - self.ring_load
        d = len(self.freedoms)
        bent = self.bent.balance(ring[d:] / LENGTH_UNIT, self.carried() - force[d:], floats=False)
        return jnp.concatenate([force[:d] - self.ring_load, bent])

    def ring_stiffness(self, ring: Array, matrix: Float[Array, "coordinate coordinate"]) -> Array:
        """Derivatives of `ring_balance` by the coordinates of the rings, N/m; `matrix`: the part of the balls, N/m."""
        if not self.bent:
            return matrix
        d = len(self.freedoms)
        return matrix.at[d:, d:].add(self.bent.tangent(ring[d:]))


class Forces(NamedTuple):
    """Energy, J, forces, N, and stiffness, N/m, of the springs at each ball (the contacts), for given ball centre and
    coordinates of the inner groove."""

    energy: Float[Array, " ball"]
    balance: Float[Array, "2 ball"]
    """Derivative of `energy` by the ball centre."""
    inner: Float[Array, "p ball"]
    """Derivative of `energy` by the coordinates of the inner groove: the forces on them."""
    stiffness: Float[Array, "2 2 ball"]
    """Derivative of `balance` by the ball centre."""
    coupling: Float[Array, "2 p ball"]
    """Derivative of `balance` by the coordinates of the inner groove, with its sign changed."""
    of_groove: Float[Array, "p p ball"]
    """Derivative of `inner` by the coordinates of the inner groove."""


class Spring(NamedTuple):
    """Contact of a ball with one ring, or sum over its contacts with the ring: energy, J, and its first and second
    derivatives (force, N, and stiffness, N/m) by the arm of the contact or by the coordinates of the groove."""

    energy: Array
    force: Array
    stiffness: Array


def spring(arm: Float[Array, "2 ball"], offset: Array, constant: Array) -> Spring:
    """Energy, force and stiffness of one contact.

    **Arguments:** `arm`: vector between ball and groove centre, m; `offset`: its length at first contact, m;
    `constant`: contact stiffness, N/m^(3/2)."""
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
    """The contacts with the inner ring: energy, force and stiffness with respect to the ball centre, the same with
    respect to the coordinates of the groove, and the stiffness that couples both."""
    places = problem.arcs.inner_centres(groove)
    springs = [spring(place - centre, problem.offset[0], problem.stiffness[0]) for place in places]
    if problem.arcs.inner is None:
        return springs[0], springs[0], springs[0].stiffness
    energy = added([contact.energy for contact in springs])
    ball = Spring(
        energy, added([contact.force for contact in springs]), added([contact.stiffness for contact in springs])
    )
    pairs = [(contact, coordinate_map(side)) for contact, side in zip(springs, problem.arcs.inner_sides, strict=True)]
    coupling = added([jnp.einsum("abn,bp->apn", contact.stiffness, of) for contact, of in pairs])
    force = added([jnp.einsum("ap,an->pn", of, contact.force) for contact, of in pairs])
    stiffness = added([jnp.einsum("ap,abn,bq->pqn", of, contact.stiffness, of) for contact, of in pairs])
    return ball, Spring(energy, force, stiffness), coupling


def outer_springs(problem: CentrifugalProblem, centre: Array) -> Spring:
    """The contacts with the outer ring, with respect to the ball centre."""
    springs = [spring(arm, problem.offset[1], problem.stiffness[1]) for arm in problem.arcs.from_outer(centre)]
    return Spring(*(added(parts) for parts in zip(*springs, strict=True)))


def forces_at(problem: CentrifugalProblem, centre: Array, groove: Array) -> Forces:
    """Energy, forces and stiffness at given ball centres and coordinates of the inner groove, m."""
    ball, ring, coupling = inner_springs(problem, centre, groove)
    outer = outer_springs(problem, centre)
    push = jnp.stack([jnp.zeros_like(problem.centrifugal), problem.centrifugal])
    energy = ball.energy + outer.energy - problem.centrifugal * centre[1]
    balance, stiffness = outer.force - ball.force - push, outer.stiffness + ball.stiffness
    return Forces(energy, balance, ring.force, stiffness, coupling, ring.stiffness)


def together(stiffness: Float[Array, "2"]) -> Float[Array, ""]:
    """Stiffness of the inner and the outer contact of a ball in series, N/m^(3/2)."""
    return jnp.sum(stiffness ** (-2.0 / 3.0)) ** -1.5
