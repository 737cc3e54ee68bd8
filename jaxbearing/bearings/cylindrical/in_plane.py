"""Base of the equations of cylindrical rollers that carry evenly along their length: displacements of the
inner ring and, if it bends, amplitudes of the outer one."""

import dataclasses
from typing import TypeVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...numerics.arrow import AbstractArrowSystem
from ..elastic_ring import EQUATION, ElasticRing
from ..ring import LENGTH_UNIT, InnerRing

System = TypeVar("System", bound="AbstractInPlane")
IN_PLANE = ("radial", "lateral")
"""Freedoms of the inner ring in the model of rollers that carry evenly along their length."""


def outward(azimuth: Float[Array, " roller"]) -> Float[Array, "2 roller"]:
    """Outward unit vector at each roller, along the load line and along azimuth 90 degrees."""
    return jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])


class AbstractInPlane(AbstractArrowSystem):
    """Base of the equations of rollers that carry evenly along their length.

    - `directions`: outward unit vectors along the unknown freedoms of the `ring`.
    - `held`: given part of the displacement of the inner ring towards each roller, m; `None` if none is given.
    - `out_of_round`: displacement towards each roller of races that are not round, m; `None` if they are round.
    - `outer`: the outer ring if it bends; `None` if it is rigid. Its amplitudes are globals, after those of the inner
      ring. A roller feels them as a part of the displacement towards it (`local_inputs`).
    """

    directions: eqx.AbstractVar[Float[Array, "freedom roller"]]
    azimuth: eqx.AbstractVar[Float[Array, " roller"]]
    ring: eqx.AbstractVar[InnerRing]
    held: eqx.AbstractVar[Float[Array, " roller"] | None]
    out_of_round: eqx.AbstractVar[Float[Array, " roller"] | None]
    outer: eqx.AbstractVar[ElasticRing | None]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Freedoms of the ring that are unknown."""
        return self.ring.freedoms

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return self.ring.size()

    def inward(self, shared: Float[Array, "freedom ..."]) -> Float[Array, " roller"]:
        """Displacement of the inner ring towards each roller, m, from its unknowns."""
        shift = jnp.sum(shared * self.directions, axis=0) * LENGTH_UNIT
        for given in (self.held, self.out_of_round):
            shift = shift if given is None else shift + given
        return shift

    @property
    def modes(self) -> int:
        """Number of amplitudes of the outer ring."""
        return 0 if self.outer is None else self.outer.modes

    def amplitudes(self, globals_: Float[Array, " g"]) -> Float[Array, " mode"]:
        """The unknowns of the outer ring."""
        first = self.directions.shape[0]
        return globals_[first : first + self.modes]

    def approaching(self, globals_: Float[Array, " g"], outer: ElasticRing) -> Float[Array, " roller"]:
        """Displacement of the rings towards each other at each roller, m."""
        shift = self.inward(globals_[: self.directions.shape[0], None])
        return shift - outer.deflection(self.amplitudes(globals_))

    def on_rings(self, load: Float[Array, "2 roller"], outer: ElasticRing) -> Float[Array, " row"]:
        """Sums of the loads on both races, N, as they act on the displacements of the inner and the amplitudes of the
        outer ring."""
        return jnp.concatenate([self.directions @ load[0], outer.pressed(load[1])])

    def ring_rows(self, globals_: Float[Array, " g"], totals: Float[Array, " k"]) -> Float[Array, " row"]:
        """Balances of both rings over `load_scale`."""
        d = self.directions.shape[0]
        rows = (totals[:d] - self.ring.load) / self.load_scale()
        if self.outer is None:
            return rows
        amplitudes = self.amplitudes(globals_)
        bent = self.outer.balance(amplitudes, totals[d : d + self.modes], self.ring.asks)
        return jnp.concatenate([rows, bent / self.load_scale()])

    def ring_names(self) -> tuple[str, ...]:
        """Names of the equations of both rings."""
        return (*self.ring.equation_names(), *(EQUATION,) * self.modes)

    def begun(self, ring: Float[Array, " freedom"]) -> Float[Array, " row"]:
        """First guess of the unknowns of both rings, from that of the inner ring on a rigid one."""
        if self.outer is None:
            return ring
        load = jnp.zeros(2).at[self.ring.places - 1].set(self.ring.load)
        amplitudes = self.outer.start(load)
        # the inner ring follows the outer one, whose first order is a displacement
        follow = self.outer.deflection(amplitudes) @ self.directions.T / LENGTH_UNIT
        weights = jnp.sum(jnp.square(self.directions), axis=1)
        return jnp.concatenate([ring + follow / weights, amplitudes])

    def in_plane(self: System) -> System:
        """The equations with both freedoms of the ring unknown."""
        ring, both = self.ring, outward(self.azimuth)
        free = InnerRing(jnp.full(2, ring.size() / jnp.sqrt(2.0)), jnp.zeros(5), ring.lever, IN_PLANE)
        held = None if ring.expansion is None else jnp.broadcast_to(ring.expansion, self.azimuth.shape)
        return dataclasses.replace(self, directions=both, ring=free, held=held)
