"""Both rings of a bearing in its equations: freedoms of the inner one, amplitudes of an outer one that bends."""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import AbstractArrowSystem
from ..numerics.convex import anchored
from .elastic_ring import EQUATION, ElasticRing
from .ring import ANCHOR, LENGTH_UNIT, InnerRing


class AbstractBetweenRings(AbstractArrowSystem):
    """Rolling elements between two rings. The globals are the unknown freedoms of the inner ring, then the amplitudes
    of the outer one if it bends, then what else a family has.

    An element feels a ring that bends as one number, the deflection at its place (`local_inputs`), which is the last
    row of `shared`. In the second result of `element`, the row after those of the freedoms is then the outward force of
    each element on the outer ring.
    """

    ring: eqx.AbstractVar[InnerRing]
    outer: eqx.AbstractVar[ElasticRing | None]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Freedoms of the ring that are unknown."""
        return self.ring.freedoms

    @property
    def ring_unknowns(self) -> int:
        """Number of globals that belong to the rings."""
        return len(self.freedoms) + (0 if self.outer is None else self.outer.modes)

    def ring_names(self) -> tuple[str, ...]:
        """Names of the equations of both rings."""
        names = self.ring.equation_names()
        return names if self.outer is None else (*names, *(EQUATION,) * self.outer.modes)

    def of_freedoms(self, values: Float[Array, "row ..."]) -> Float[Array, "freedom ..."]:
        """Selects the rows that belong to the freedoms of the inner ring."""
        count = len(self.freedoms)
        return values if values.shape[0] == count else values[:count]

    def amplitudes(self, globals_: Float[Array, " g"]) -> Float[Array, " mode"]:
        """The unknowns of a flexible outer ring."""
        return globals_[len(self.freedoms) : self.ring_unknowns]

    def local_inputs(self, globals_):
        """With an outer ring that bends, returns the globals without its amplitudes, and its deflection at each
        element, m. Returns `None` for a rigid outer ring."""
        if self.outer is None:
            return None
        others = jnp.concatenate([globals_[: len(self.freedoms)], globals_[self.ring_unknowns :]])
        deflection = self.outer.deflection(self.amplitudes(globals_))
        copied = jnp.broadcast_to(others[:, None], (others.size, deflection.size))
        return jnp.concatenate([copied, deflection[None]])

    def gathered(self, globals_, acting):
        totals = jnp.sum(acting, axis=1)
        if self.outer is None:
            return totals
        d = len(self.freedoms)
        return jnp.concatenate([totals[:d], self.outer.pressed(acting[d]), totals[d + 1 :]])

    @staticmethod
    def on_both(on_ring: Float[Array, "freedom element"], outward: Float[Array, " element"]) -> Array:
        """Contributions to the forces on both rings, N, from those on the freedoms of the inner ring, and the outward
        force on an outer ring that bends."""
        return jnp.concatenate([on_ring, outward[None]])

    def ring_balance(
        self, globals_: Float[Array, " g"], totals: Float[Array, " k"], floats: bool
    ) -> Float[Array, " row"]:
        """Returns the forces of the elements on the unknown freedoms of the inner ring less the load on these, N, and
        the forces on the amplitudes of an outer ring that bends.

        **Arguments:** `floats`: whether a ring may stand where no element touches it: it is anchored then.
        """
        balance = self.of_freedoms(totals) - self.ring.load
        if floats:
            balance = balance + anchored(self.of_freedoms(globals_), ANCHOR * LENGTH_UNIT)
        if self.outer is None:
            return balance
        bent = self.outer.balance(self.amplitudes(globals_), totals[len(self.freedoms) : self.ring_unknowns], floats)
        return jnp.concatenate([balance, bent])

    def rings_under(self, factor: Float[Array, ""]) -> tuple[InnerRing, ElasticRing | None]:
        """Both rings under multiples of their loads."""
        return self.ring.under(self.ring.load * factor), None if self.outer is None else self.outer.under(factor)
