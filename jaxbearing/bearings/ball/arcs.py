r"""Rings with one groove arc or two: contacts of a ball, and what the arcs make of groove centres.

A ring with two arcs (a split ring or a gothic arch) has two circles of groove centres. They lie at the distances
$\pm e$ from its middle plane, $e = (f - \frac12)D\sin a$ with the shim angle a. Side s = 1 is the flank that carries
thrust of the inner ring along $+e_x$, where contact angles are positive; s = -1 is the other flank. The centre of arc s
lies at $+se_i$ along the axis of the inner ring, and at $-se_o$ along that of the outer ring.

Contacts of a ball come in this order: those on the inner ring, then those on the outer ring, of each ring side 1 first.

The inner groove of a ring with two arcs has three coordinates at a ball, to first order in its displacements: $A_1$ and
$A_2$ of the middle between both centres, and $\lambda = e_i\tau$ of its tilt $\tau$ in the half-plane of the ball. The
centre of arc s is $(A_1 + se_i, A_2 - s\lambda)$. A ring with one arc has $A_1$ and $A_2$ only.
"""

import functools
import operator
from collections.abc import Iterable
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

RACE_SENSES = np.asarray([[1.0], [-1.0]])
"""Sense of the contact's x axis along the orbit, of one contact on the inner and one on the outer race."""


def added(values: Iterable[Array]) -> Array:
    """Sum of one value or more. A single one stays as it is."""
    return functools.reduce(operator.add, values)


def sides_of(offset: Array | None) -> tuple[int, ...]:
    """Sides of the arcs of a ring: (0,) of a ring with one arc."""
    return (0,) if offset is None else (1, -1)


def coordinate_map(side: int) -> Float[np.ndarray, "2 p"]:
    """Derivatives of the centre of an inner arc (axial, outward) with respect to the coordinates of the groove."""
    return np.eye(2) if side == 0 else np.asarray([[1.0, 0.0, 0.0], [0.0, 1.0, -float(side)]])


class Arcs(NamedTuple):
    """Distances e of the circles of groove centres from the middle planes of the rings, m; `None`: one arc."""

    inner: Float[Array, ""] | None = None
    outer: Float[Array, ""] | None = None

    @property
    def single(self) -> bool:
        """True if each ring has one arc."""
        return self.inner is None and self.outer is None

    @property
    def coordinates(self) -> int:
        """Number of coordinates of the inner groove at a ball, see the module."""
        return 2 if self.inner is None else 3

    @property
    def inner_sides(self) -> tuple[int, ...]:
        return sides_of(self.inner)

    @property
    def outer_sides(self) -> tuple[int, ...]:
        return sides_of(self.outer)

    @property
    def races(self) -> tuple[int, ...]:
        """Race of each contact: 0 inner, 1 outer."""
        return (0,) * len(self.inner_sides) + (1,) * len(self.outer_sides)

    @property
    def first_outer(self) -> int:
        """Place of the first contact on the outer ring."""
        return len(self.inner_sides)

    @property
    def sides(self) -> tuple[int, ...]:
        """Side of each contact, 0 on a ring with one arc."""
        return self.inner_sides + self.outer_sides

    @property
    def senses(self) -> Float[np.ndarray, "contact 1"]:
        """1 of contacts on the inner ring, -1 of those on the outer one: the sense of the contact's x axis along the
        orbit."""
        return RACE_SENSES[np.asarray(self.races)]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the contacts in results: the race, and `_second` for the flank that carries thrust along -e_x."""
        names = ("inner", "outer")
        return tuple(
            names[race] + ("_second" if side == -1 else "") for race, side in zip(self.races, self.sides, strict=True)
        )

    def named(self, found: dict[str, Float[Array, "contact ball"]]) -> dict[str, Float[Array, " ball"]]:
        """Results of each contact by the names of the fields that hold them."""
        return {f"{name}_{place}": values[k] for name, values in found.items() for k, place in enumerate(self.names)}

    def of_contacts(self, values: Float[Array, "2"]) -> Float[Array, " contact"]:
        """Values of each contact from those of the races."""
        return values if self.single else values[np.asarray(self.races)]

    def on_inner(self, values: Float[Array, "contact ball"]) -> Float[Array, " ball"]:
        """Sum over the contacts on the inner ring."""
        return added([values[k] for k in range(self.first_outer)])

    def on_outer(self, values: Float[Array, "contact ball"]) -> Float[Array, " ball"]:
        """Sum over the contacts on the outer ring."""
        return added([values[k] for k in range(self.first_outer, len(self.races))])

    def by_race(self, values: Float[Array, "contact ball"]) -> tuple[Array, Array]:
        """Sums over the contacts on the inner and on the outer ring."""
        return self.on_inner(values), self.on_outer(values)

    def inner_centres(self, groove: Float[Array, "p ball"]) -> list[Float[Array, "2 ball"]]:
        """Centres of the inner arcs (axial, outward), m, from the coordinates of the groove."""
        if self.inner is None:
            return [groove]
        return [jnp.stack([groove[0] + side * self.inner, groove[1] - side * groove[2]]) for side in self.inner_sides]

    def from_outer(self, centre: Float[Array, "2 ball"]) -> list[Float[Array, "2 ball"]]:
        """Ball centres from the centres of the outer arcs, m; `centre`: from the middle of these."""
        if self.outer is None:
            return [centre]
        return [jnp.stack([centre[0] + side * self.outer, centre[1]]) for side in self.outer_sides]

    def facing(self, groove: Float[Array, "p ball"]) -> tuple[Float[Array, "2 ball"], Float[Array, " ball"] | None]:
        """Inner groove centre from the outer one, both of the side towards which the inner ring has moved, m; and that
        side, `None` if each ring has one arc."""
        if self.single:
            return groove, None
        side = jnp.where(groove[0] < 0, -1.0, 1.0)
        axial, outward = groove[0], groove[1]
        if self.inner is not None:
            axial, outward = axial + side * self.inner, outward - side * groove[2]
        if self.outer is not None:
            axial = axial + side * self.outer
        return jnp.stack([axial, outward]), side

    def moved_out(self, centre: Float[Array, "2 ball"], side: Float[Array, " ball"] | None) -> Float[Array, "2 ball"]:
        """Ball centres from the middle of the outer arcs, m; `centre`: from the outer arc of the `side` of `facing`."""
        if self.outer is None or side is None:
            return centre
        return centre.at[0].add(-side * self.outer)

    def lift(self, offset: Float[Array, "2"]) -> Array:
        r"""$\sum_k(g_k - \sqrt{g_k^2 - e_k^2})$: by how much two arcs bring the circles of groove centres of inner and
        outer ring nearer to each other than one arc each, m. **Arguments:** `offset`: g of (inner, outer), m."""
        return added(
            [
                jnp.square(e) / (offset[k] + jnp.sqrt(jnp.square(offset[k]) - jnp.square(e)))
                for k, e in enumerate(self)
                if e is not None
            ]
        )
