"""Both rings in the equations of a bearing: degrees of freedom of the inner ring, amplitudes of flexible rings."""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ..numerics.arrow import AbstractArrowSystem
from ..numerics.convex import anchored
from .elastic_ring import BentRings, ElasticRing
from .ring import ANCHOR, LENGTH_UNIT, InnerRing


class AbstractBetweenRings(AbstractArrowSystem):
    """Rolling elements between two rings. The globals are the unknown degrees of freedom of the inner ring, the
    amplitudes of the outer ring and of the inner ring if they are flexible, and further unknowns of the family, in this
    order. The degrees of freedom of a flexible inner ring are those of its seat on the shaft.

    An element feels a flexible ring as one number, the opening of its contact (`local_inputs`); the openings are the
    last rows of `shared`. The second result of `element` has, after the rows of the degrees of freedom, one row for
    each flexible ring: the radial force with which each element presses the ring away.
    """

    ring: eqx.AbstractVar[InnerRing]
    outer: eqx.AbstractVar[ElasticRing | None]
    inner: eqx.AbstractVar[ElasticRing | None]

    @property
    def freedoms(self) -> tuple[str, ...]:
        """Unknown degrees of freedom of the inner ring."""
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
        """If a ring is flexible, returns for each element the globals without amplitudes, and the opening of its
        contact by each flexible ring, m. Returns `None` if both rings are rigid."""
        if not self.bent:
            return None
        others = jnp.concatenate([globals_[: len(self.freedoms)], globals_[self.ring_unknowns :]])
        openings = self.bent.openings(self.amplitudes(globals_))
        copied = jnp.broadcast_to(others[:, None], (others.size, openings[0].size))
        return jnp.concatenate([copied, *(opening[None] for opening in openings)])

    def opened(self, shared: Float[Array, "p element"]) -> dict[str, Float[Array, " element"]]:
        """Openings of the contacts by the flexible rings, m: "outer" or "inner" -> opening at each element."""
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
        """Joins the contributions of the elements to the forces on both rings, N.

        **Arguments:** `on_ring`: forces on the degrees of freedom of the inner ring, N; `outer`, `inner`: radial forces
        with which the elements press the outer and the inner ring away, N; those on rigid rings are left out."""
        rows = self.bent.pick(outer, inner)
        return jnp.concatenate([on_ring, *(row[None] for row in rows)]) if rows else on_ring

    def ring_balance(
        self, globals_: Float[Array, " g"], totals: Float[Array, " k"], floats: bool
    ) -> Float[Array, " row"]:
        """Unbalanced forces on the unknown degrees of freedom of the inner ring, N, and on the amplitudes of flexible
        rings, N. On the inner ring this is the force that holds it against the elements, less its load.

        **Arguments:** `floats`: True if a ring may lose contact with all elements; it is then anchored.
        """
        balance = self.of_freedoms(totals) - self.ring.load
        if floats:
            balance = balance + anchored(self.of_freedoms(globals_), ANCHOR * LENGTH_UNIT)
        return self.with_bending(balance, globals_, totals, floats)

    def with_bending(
        self, balance: Float[Array, " freedom"], globals_: Float[Array, " g"], totals: Float[Array, " k"], floats: bool
    ) -> Float[Array, " row"]:
        """Appends the balance of the amplitudes, N, to that of the degrees of freedom. **Arguments:** see
        `ring_balance`."""
        if not self.bent:
            return balance
        pressed = totals[len(self.freedoms) : self.ring_unknowns]
        return jnp.concatenate([balance, self.bent.balance(self.amplitudes(globals_), pressed, floats)])

    def rings_under(self, factor: Float[Array, ""]) -> tuple[InnerRing, ElasticRing | None]:
        """The inner and the outer ring with their given loads multiplied by a factor. The bending of an inner ring
        needs no scaling, because it has no given loads of its own."""
        return self.ring.under(self.ring.load * factor), None if self.outer is None else self.outer.under(factor)
