r"""Rings with one or two groove arcs: the contacts of a ball and the centres of the arcs.

A ring with two arcs (a split ring or a gothic arch) has two circles of groove centres. They lie at the distances
$\pm e$ from its middle plane, $e = (f - \frac12)D\sin a$ with the shim angle a. Side s = 1 is the flank that carries
thrust of the inner ring along $+e_x$, where contact angles are positive; s = -1 is the other flank. The centre of arc s
lies at $+se_i$ along the axis of the inner ring, and at $-se_o$ along that of the outer ring.

The contacts of a ball are ordered: first those on the inner ring, then those on the outer ring, side 1 first on each.

The groove of an inner ring with two arcs has three coordinates at a ball, to first order in its displacements: $A_1$
(axial) and $A_2$ (outward) of the point midway between both arc centres, and $\lambda = e_i\tau$ with the tilt $\tau$
of the groove in the half-plane of the ball. The centre of arc s is $(A_1 + se_i, A_2 - s\lambda)$. With one arc there
are only $A_1$ and $A_2$.
"""

import functools
import operator
from collections.abc import Iterable
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

RACE_SENSES = np.asarray([[1.0], [-1.0]])
"""Direction of the contact's x axis along the orbit: 1 on the inner race, -1 on the outer race."""


def added(values: Iterable[Array]) -> Array:
    """Sum of one or more values. A single value is returned unchanged."""
    return functools.reduce(operator.add, values)


def sides_of(offset: Array | None) -> tuple[int, ...]:
    """Sides of the arcs of a ring: (0,) for one arc, (1, -1) for two."""
    return (0,) if offset is None else (1, -1)


def coordinate_map(side: int) -> Float[np.ndarray, "2 p"]:
    """Derivatives of the centre of the inner arc of a `side` (axial, outward) by the coordinates of the groove."""
    return np.eye(2) if side == 0 else np.asarray([[1.0, 0.0, 0.0], [0.0, 1.0, -float(side)]])


class Arcs(NamedTuple):
    """Distances e of the circles of groove centres from the middle plane of each ring, m; `None`: one arc."""

    inner: Float[Array, ""] | None = None
    outer: Float[Array, ""] | None = None

    @property
    def single(self) -> bool:
        """True if each ring has one arc."""
        return self.inner is None and self.outer is None

    @property
    def coordinates(self) -> int:
        """Number of coordinates of the inner groove at a ball: 2, or 3 with two arcs (see the module)."""
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
        """Index of the first contact on the outer ring."""
        return len(self.inner_sides)

    @property
    def sides(self) -> tuple[int, ...]:
        """Side of each contact: 1 or -1; 0 on a ring with one arc."""
        return self.inner_sides + self.outer_sides

    @property
    def senses(self) -> Float[np.ndarray, "contact 1"]:
        """Direction of each contact's x axis along the orbit: 1 on the inner ring, -1 on the outer ring."""
        return RACE_SENSES[np.asarray(self.races)]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the contacts in results: the race, with `_second` added for the flank for thrust along -e_x."""
        names = ("inner", "outer")
        return tuple(
            names[race] + ("_second" if side == -1 else "") for race, side in zip(self.races, self.sides, strict=True)
        )

    def named(self, results: dict[str, Float[Array, "contact ball"]]) -> dict[str, Float[Array, " ball"]]:
        """Results of the single contacts, under the names of their fields (`load_inner`, `load_inner_second`, ...)."""
        return {f"{name}_{place}": values[k] for name, values in results.items() for k, place in enumerate(self.names)}

    def of_contacts(self, values: Float[Array, "2"]) -> Float[Array, " contact"]:
        """Value of each contact, from the values of the inner and the outer race."""
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
        """Vectors from the centre of each outer arc to the ball centres, m; `centre`: the same from the point midway
        between the outer arc centres."""
        if self.outer is None:
            return [centre]
        return [jnp.stack([centre[0] + side * self.outer, centre[1]]) for side in self.outer_sides]

    def facing(self, groove: Float[Array, "p ball"]) -> tuple[Float[Array, "2 ball"], Float[Array, " ball"] | None]:
        """Vector from the outer to the inner arc centre, m, both on the side towards which the inner ring has moved
        axially; and this side (1 or -1), `None` if each ring has one arc."""
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
        """Ball centres from the point midway between the outer arc centres, m; `centre`: the same from the centre of
        the outer arc on the `side` given by `facing`."""
        if self.outer is None or side is None:
            return centre
        return centre.at[0].add(-side * self.outer)

    def lift(self, offset: Float[Array, "2"]) -> Array:
        r"""Radial distance, m, by which the circles of groove centres of inner and outer ring come nearer to each
        other if rings have two arcs instead of one: $\sum_k(g_k - \sqrt{g_k^2 - e_k^2})$.

        **Arguments:** `offset`: g of (inner, outer), m."""
        return added(
            [
                jnp.square(e) / (offset[k] + jnp.sqrt(jnp.square(offset[k]) - jnp.square(e)))
                for k, e in enumerate(self)
                if e is not None
            ]
        )
