"""Ring part of the equations of cylindrical rollers that carry evenly along their length: displacements of the inner
ring and amplitudes of flexible rings."""

import dataclasses
from typing import TypeVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..ring import LENGTH_UNIT, InnerRing
from ..rings import AbstractBetweenRings

System = TypeVar("System", bound="AbstractInPlane")
IN_PLANE = ("radial", "lateral")
"""Degrees of freedom of the inner ring if the rollers carry evenly along their length."""


def outward(azimuth: Float[Array, " roller"]) -> Float[Array, "2 roller"]:
    """Outward unit vector at each roller: its components along azimuth 0 (the load line) and azimuth 90 degrees."""
    return jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])


class AbstractInPlane(AbstractBetweenRings):
    """Base of the equations of rollers that carry evenly along their length.

    - `directions`: components of the outward unit vectors along the unknown degrees of freedom of the `ring`.
    - `held`: given displacement of the inner ring towards each roller, m; `None` if none is given.
    - `out_of_round`: approach of the races at each roller because they are not round, m; `None` if they are round.
    - `outer`, `inner`: flexible rings; `None` if they are rigid. Their bending opens the contacts of a roller, which
      reduces the displacement of the rings towards each other (`local_inputs`).
    """

    directions: eqx.AbstractVar[Float[Array, "freedom roller"]]
    azimuth: eqx.AbstractVar[Float[Array, " roller"]]
    held: eqx.AbstractVar[Float[Array, " roller"] | None]
    out_of_round: eqx.AbstractVar[Float[Array, " roller"] | None]

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return self.ring.size()

    def inward(self, shared: Float[Array, "freedom ..."]) -> Float[Array, " roller"]:
        """Displacement of the inner ring towards each roller, m, from the ring's unknowns. It includes `held` and
        `out_of_round`."""
        shift = jnp.sum(shared * self.directions, axis=0) * LENGTH_UNIT
        for inward in (self.held, self.out_of_round):
            shift = shift if inward is None else shift + inward
        return shift

    def approaching(self, globals_: Float[Array, " g"]) -> Float[Array, " roller"]:
        """Displacement of the rings towards each other at each roller, m. It includes the bending of flexible rings."""
        shift = self.inward(globals_[: self.directions.shape[0], None])
        for opening in self.bent.openings(self.amplitudes(globals_)):
            shift = shift - opening
        return shift

    def on_rings(self, load: Float[Array, "2 roller"]) -> Float[Array, " row"]:
        """Resultants of the roller loads, N: forces on the degrees of freedom of the inner ring, then generalised
        forces on the amplitudes of flexible rings. **Arguments:** `load`: on the inner and the outer race, N."""
        return jnp.concatenate([self.directions @ load[0], self.bent.pressed(self.bent.pick(load[1], load[0]))])

    def ring_rows(self, globals_: Float[Array, " g"], totals: Float[Array, " k"]) -> Float[Array, " row"]:
        """Residuals of the force balances of both rings, divided by `load_scale`."""
        balance = totals[: self.directions.shape[0]] - self.ring.load
        return self.with_bending(balance, globals_, totals, self.ring.needs_held_load) / self.load_scale()

    def begun(self, ring: Float[Array, " freedom"]) -> Float[Array, " row"]:
        """First guess of the unknowns of both rings. **Arguments:** `ring`: guess of the displacements of the inner
        ring if all rings were rigid, in `LENGTH_UNIT`."""
        if not self.bent:
            return ring
        load = jnp.zeros(2).at[self.ring.places - 1].set(self.ring.load)
        amplitudes = self.bent.start(load)
        # the first harmonic of the bending is a displacement of the raceway, which the shaft follows
        follow = sum(self.bent.openings(amplitudes)) @ self.directions.T / LENGTH_UNIT
        weights = jnp.sum(jnp.square(self.directions), axis=1)
        return jnp.concatenate([ring + follow / weights, amplitudes])

    def in_plane(self: System) -> System:
        """These equations with the radial and the lateral displacement of the ring as unknowns."""
        ring, both = self.ring, outward(self.azimuth)
        free = InnerRing(jnp.full(2, ring.size() / jnp.sqrt(2.0)), jnp.zeros(5), ring.lever, IN_PLANE)
        return dataclasses.replace(self, directions=both, ring=free, held=None)
