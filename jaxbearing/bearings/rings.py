"""Both rings of a bearing in its equations: degrees of freedom of the inner one, amplitudes of those that bend."""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import AbstractArrowSystem
from ..numerics.convex import anchored
from .elastic_ring import BentRings, ElasticRing
from .ring import ANCHOR, LENGTH_UNIT, InnerRing


class AbstractBetweenRings(AbstractArrowSystem):
    """Rolling elements between two rings. The globals are the unknown degrees of freedom of the inner ring, then the
    amplitudes of the outer ring if it bends, then those of the inner ring if it bends, then what else a family has.
    The degrees of freedom of a flexible inner ring are those of its seat on the shaft.

    An element feels a flexible ring as one number, the opening of its contact (`local_inputs`): the last rows of
    `shared`. In the second result of `element`, one row for each flexible ring comes after those of the degrees of
    freedom: the radial force by which each element presses that ring away.
    """

    ring: eqx.AbstractVar[InnerRing]
    outer: eqx.AbstractVar[ElasticRing | None]
    inner: eqx.AbstractVar[ElasticRing | None]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Degrees of freedom of the ring that are unknown."""
        return self.ring.freedoms

    @property
    def bent(self) -> BentRings:
        """The flexible rings."""
        return BentRings(self.outer, self.inner)

    @property
    def ring_unknowns(self) -> int:
        """Number of globals that belong to the rings."""
        return len(self.freedoms) + self.bent.modes

    def ring_names(self) -> tuple[str, ...]:
        """Names of the equations of both rings."""
        return (*self.ring.equation_names(), *self.bent.names())

    def of_freedoms(self, values: Float[Array, "row ..."]) -> Float[Array, "freedom ..."]:
        """Selects the rows that belong to the degrees of freedom of the inner ring."""
        count = len(self.freedoms)
        return values if values.shape[0] == count else values[:count]

    def amplitudes(self, globals_: Float[Array, " g"]) -> Float[Array, " mode"]:
        """The unknowns of the flexible rings."""
        return globals_[len(self.freedoms) : self.ring_unknowns]

    def local_inputs(self, globals_):
        """With flexible rings, returns the globals without their amplitudes, and the opening of each element's contact
        by each of these rings, m. Returns `None` if both rings are rigid."""
        if not self.bent:
            return None
        others = jnp.concatenate([globals_[: len(self.freedoms)], globals_[self.ring_unknowns :]])
        openings = self.bent.openings(self.amplitudes(globals_))
        copied = jnp.broadcast_to(others[:, None], (others.size, openings[0].size))
        return jnp.concatenate([copied, *(opening[None] for opening in openings)])

    def opened(self, shared: Float[Array, "p element"]) -> dict[str, Float[Array, " element"]]:
        """Openings of the contacts by the flexible rings, m, by `outer` and `inner`."""
        each = self.bent.each
        return {"inner" if ring.inner else "outer": shared[k - len(each)] for k, ring in enumerate(each)}

    def gathered(self, globals_, acting):
        totals, bent = jnp.sum(acting, axis=1), self.bent
        if not bent:
            return totals
        first = len(self.freedoms)
        last = first + len(bent.each)
        return jnp.concatenate([totals[:first], bent.pressed(list(acting[first:last])), totals[last:]])

    def on_both(
        self, on_ring: Float[Array, "freedom element"], outer: Float[Array, " element"], inner: Float[Array, " element"]
    ) -> Array:
        """Contributions to the forces on both rings, N, from those on the degrees of freedom of the inner ring, and
        the radial forces by which the elements press the outer and the inner ring away."""
        rows = self.bent.pick(outer, inner)
        return jnp.concatenate([on_ring, *(row[None] for row in rows)]) if rows else on_ring

    def ring_balance(
        self, globals_: Float[Array, " g"], totals: Float[Array, " k"], floats: bool
    ) -> Float[Array, " row"]:
        """Returns the forces that hold the unknown degrees of freedom of the inner ring against the elements less the
        load on these, N, and the forces on the amplitudes of flexible rings.

        **Arguments:** `floats`: whether a ring may stand where no element touches it: it is anchored then.
        """
        balance = self.of_freedoms(totals) - self.ring.load
        if floats:
            balance = balance + anchored(self.of_freedoms(globals_), ANCHOR * LENGTH_UNIT)
        return self.with_bending(balance, globals_, totals, floats)

    def with_bending(
        self, balance: Float[Array, " freedom"], globals_: Float[Array, " g"], totals: Float[Array, " k"], floats: bool
    ) -> Float[Array, " row"]:
        """The balance of the degrees of freedom, then that of the amplitudes, N. **Arguments:** as `ring_balance`."""
        if not self.bent:
            return balance
        pressed = totals[len(self.freedoms) : self.ring_unknowns]
        return jnp.concatenate([balance, self.bent.balance(self.amplitudes(globals_), pressed, floats)])

    def rings_under(self, factor: Float[Array, ""]) -> tuple[InnerRing, ElasticRing | None]:
        """The inner and the outer ring under multiples of their loads; nothing else loads a flexible inner ring."""
        return self.ring.under(self.ring.load * factor), None if self.outer is None else self.outer.under(factor)
