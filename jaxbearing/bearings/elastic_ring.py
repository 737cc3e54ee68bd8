r"""Flexible rings in the equations of a bearing. The amplitudes of their deflections are global unknowns; the rolling
elements feel them only as an opening of their contacts.

With the outward deflections $w_o(\psi)$ and $w_i(\psi)$ of the rings, the outer ring opens the contact of a rolling
element by $w_o$ and the inner ring by $-w_i$. The elements press the outer ring outwards with $Q_o\cos\alpha_o$ and
the inner ring inwards with $Q_i\cos\alpha_i$. The generalised load on an amplitude is, for both rings, the sum over
the elements of this force times the shape of the opening. The total energy of contacts, rings, housing and shaft less
the work of the loads stays convex, because the openings are linear in the amplitudes."""

from collections.abc import Sequence

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._types import Scalar
from ..materials import Material
from ..mounting.bent_ring import BentRing
from ..numerics.convex import anchored
from ..numerics.newton import NewtonResult
from ..numerics.safe import largest
from ..numerics.status import Status
from ..numerics.structure import switch
from .ring import ANCHOR, LENGTH_UNIT, InnerRing
from .ring_deflection import AbstractRingDeflection, InnerRingDeflection, RingDeflection
from .ring_shape import AbstractBendingRing

PLACES = 361
"""Number of azimuths at which the results give the deflection of a ring."""
LEANS = 0.1
"""Cosine of the angle between a support and the load above which the support counts in the first guess."""
UNSUPPORTED = "outer_ring.support_angle: the supports push only, and none of them stands where the load pushes the ring"
"""Cause of a failed solve."""


class ElasticRing(eqx.Module):
    """A flexible ring in the equations. Its unknowns are the amplitudes of its deflection in units of `LENGTH_UNIT`.

    **Arguments:**
    - `ring`: the ring, with its foundation, supports and given loads.
    - `shapes`: opening of the contact of each rolling element over each amplitude, dimensionless: the outward
      deflection of an outer ring, the inward deflection of an inner ring.
    - `inner`: True for the inner ring.
    """

    ring: BentRing
    shapes: Float[Array, "mode element"]
    inner: bool = switch("inner", False)

    @property
    def equation(self) -> str:
        """Name of the equation of each amplitude."""
        return f"bending of the {'inner' if self.inner else 'outer'} ring"

    @property
    def modes(self) -> int:
        return self.ring.modes

    def opening(self, amplitudes: Float[Array, " mode"]) -> Float[Array, " element"]:
        """Opening of the contact of each rolling element by the ring, m."""
        return LENGTH_UNIT * (amplitudes @ self.shapes)

    def pressed(self, load: Float[Array, " element"]) -> Float[Array, " mode"]:
        """Generalised loads of the rolling elements on the amplitudes, N.

        **Arguments:** `load`: radial force with which each element presses the ring away, N."""
        return self.shapes @ load

    def balance(
        self, amplitudes: Float[Array, " mode"], pressed: Float[Array, " mode"], floats: bool
    ) -> Float[Array, " mode"]:
        """Unbalanced generalised forces on the amplitudes, N.

        **Arguments:** `floats`: True if the ring may lose contact with all elements and supports; it is then anchored.
        """
        balance = self.ring.balance(LENGTH_UNIT * amplitudes, pressed)
        return balance + anchored(amplitudes, ANCHOR * LENGTH_UNIT) if floats else balance

    def given_load(self) -> Float[Array, ""]:
        """Size of the external forces on the undeformed ring, N: its given loads, and the forces of supports that press
        it already."""
        supports, loads = self.ring.supports, self.ring.loads
        size = jnp.zeros(())
        if supports is not None:
            size = size + jnp.sum(supports.forces(jnp.zeros_like(supports.gap)))
        return size if loads is None else size + jnp.sum(jnp.abs(loads.radial) + jnp.abs(loads.tangential))

    def under(self, factor: Float[Array, ""]) -> "ElasticRing":
        """Returns the ring with its given loads multiplied by a factor. If nothing holds an outer ring, these loads
        balance the loads on the inner ring, and both must be scaled by the same factor."""
        loads = self.ring.loads
        if loads is None:
            return self
        scaled = [loads.radial * factor, loads.tangential * factor]
        return eqx.tree_at(lambda outer: [outer.ring.loads.radial, outer.ring.loads.tangential], self, scaled)

    def start(self, load: Float[Array, "2"]) -> Float[Array, " mode"]:
        """First guess: the ring displaced as a rigid body until its foundation and supports carry the load on the
        bearing. An inner ring is displaced against the load, because the elements press it that way. The guess for a
        free ring is 0.

        **Arguments:** `load`: load on the bearing along and across the load line, N."""
        ring, orders = self.ring, self.ring.orders
        amplitudes = jnp.zeros(ring.modes)
        if 1 not in orders:
            return amplitudes
        square = jnp.sum(jnp.square(load))
        size = jnp.sqrt(jnp.where(square > 0, square, 1.0))
        along = load / size
        stiffness, gap = ring.stiffness()[orders.index(1)], jnp.zeros(())
        if ring.supports is not None:
            lean = jnp.cos(ring.supports.angle) * along[0] + jnp.sin(ring.supports.angle) * along[1]
            lean = jnp.where(lean > LEANS, lean, 0.0)
            stiffness = stiffness + jnp.sum(ring.supports.stiffness * jnp.square(lean))
            gap = largest(jnp.where(lean > 0, ring.supports.gap / jnp.where(lean > 0, lean, 1.0), 0.0))
        leaning = stiffness > 0
        shift = gap + jnp.where(leaning, size / jnp.where(leaning, stiffness, 1.0), 0.0)
        # the cosines of all orders come first; order 1 is the first order with a sine
        cosine, sine = orders.index(1), len(orders)
        along = -along if self.inner else along
        return amplitudes.at[np.asarray([cosine, sine])].set(along * shift / LENGTH_UNIT)

    def judged(self, ring: InnerRing, result: NewtonResult) -> tuple[NewtonResult, Bool[Array, ""]]:
        """Returns the result of a solve and whether it failed because the supports of the ring cannot carry the loads;
        in that case the status of the result becomes `no_equilibrium`."""
        supports, loads = self.ring.supports, dict(zip(ring.freedoms, ring.load, strict=True))
        if supports is None or self.ring.foundation is not None or "radial" not in loads:
            return result, jnp.asarray(False)
        load = jnp.stack([loads["radial"], loads.get("lateral", jnp.zeros(()))])
        if self.ring.loads is not None:
            load = load + self.ring.loads.resultant()
        none = supports.cannot_bear(load, "lateral" in loads) & ~result.converged
        return result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status)), none

    def displacement(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "2"]:
        """Displacement of a shaft that follows the rigid-body displacement of the ring, along and across the load line,
        in the unit of `amplitudes`: the amplitudes of order 1 of an outer ring, those of an inner ring with the
        opposite sign. It is 0 if the ring does not have the order 1."""
        orders = self.ring.orders
        if 1 not in orders:
            return jnp.zeros(2)
        # the cosines of all orders come first; order 1 is the first order with a sine
        first_order = amplitudes[np.asarray([orders.index(1), len(orders)])]
        return -first_order if self.inner else first_order

    def shape(self, amplitudes: Float[Array, " mode"]) -> AbstractRingDeflection:
        """Deflected shape of the ring, as results show it."""
        scaled, ring = LENGTH_UNIT * amplitudes, self.ring
        azimuth = np.linspace(0.0, 2.0 * np.pi, PLACES)
        count = len(ring.orders)
        sines = scaled[count:] if ring.orders[0] > 0 else jnp.concatenate([jnp.zeros(1), scaled[count:]])
        orders = jnp.asarray(ring.orders, dtype=float)
        forces = None if ring.supports is None else ring.reactions(scaled)
        radius = jnp.asarray(ring.section.radius)
        deflection = ring.deflection(scaled, azimuth)
        fields = (jnp.asarray(azimuth), deflection, scaled[:count], sines, radius, orders)
        return InnerRingDeflection(*fields) if self.inner else RingDeflection(*fields, forces)


class BentRings(eqx.Module):
    """The flexible rings of a bearing. Arrays of amplitudes hold those of the outer ring first, then those of the inner
    ring.

    **Arguments:** `outer`, `inner`: the rings; `None` for a rigid ring.
    """

    outer: ElasticRing | None
    inner: ElasticRing | None

    @property
    def each(self) -> tuple[ElasticRing, ...]:
        """The flexible rings, the outer one first."""
        return tuple(ring for ring in (self.outer, self.inner) if ring is not None)

    def __bool__(self) -> bool:
        return bool(self.each)

    @property
    def modes(self) -> int:
        """Number of amplitudes of both rings."""
        return sum(ring.modes for ring in self.each)

    def of_each(self, values: Array) -> list[tuple[ElasticRing, Array]]:
        """Splits an array with one entry per amplitude into a list of pairs of a ring and its part of the array."""
        ends = np.cumsum([0, *(ring.modes for ring in self.each)]).tolist()
        return [(ring, values[ends[k] : ends[k + 1]]) for k, ring in enumerate(self.each)]

    def names(self) -> tuple[str, ...]:
        """Names of the equations of all amplitudes."""
        return tuple(ring.equation for ring in self.each for _ in range(ring.modes))

    def shapes(self) -> Float[Array, "mode element"]:
        """Shapes of both rings (`ElasticRing.shapes`), dimensionless."""
        return jnp.concatenate([ring.shapes for ring in self.each])

    def openings(self, amplitudes: Float[Array, " mode"]) -> list[Float[Array, " element"]]:
        """Opening of the contact of each rolling element by each ring, m."""
        return [ring.opening(part) for ring, part in self.of_each(amplitudes)]

    def pick(self, outer: Array, inner: Array) -> list[Array]:
        """Selects those of two values, of the outer and of the inner ring, whose rings are flexible."""
        return [value for ring, value in ((self.outer, outer), (self.inner, inner)) if ring is not None]

    def pressed(self, loads: Sequence[Float[Array, " element"]]) -> Float[Array, " mode"]:
        """Generalised loads of the rolling elements on the amplitudes, N.

        **Arguments:** `loads`: the argument `load` of `ElasticRing.pressed` for each flexible ring, N.
        """
        return _joined([ring.pressed(load) for ring, load in zip(self.each, loads, strict=True)])

    def balance(
        self, amplitudes: Float[Array, " mode"], pressed: Float[Array, " mode"], floats: bool
    ) -> Float[Array, " mode"]:
        """See `ElasticRing.balance`."""
        parts = zip(self.of_each(amplitudes), self.of_each(pressed), strict=True)
        return _joined([ring.balance(own, loads, floats) for (ring, own), (_, loads) in parts])

    def energy(self, amplitudes: Float[Array, " mode"]) -> Float[Array, ""]:
        """Energy of rings, foundations and supports less the work of the given loads, J; amplitudes in m."""
        first, *others = [ring.ring.energy(part) for ring, part in self.of_each(amplitudes)]
        return sum(others, first)

    def tangent(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "mode mode"]:
        """Second derivatives of the energy with respect to the amplitudes, N/m; amplitudes in m."""
        blocks = [ring.ring.tangent(part) for ring, part in self.of_each(amplitudes)]
        return blocks[0] if len(blocks) == 1 else jax.scipy.linalg.block_diag(*blocks)

    def start(self, load: Float[Array, "2"]) -> Float[Array, " mode"]:
        """See `ElasticRing.start`."""
        return _joined([ring.start(load) for ring in self.each])

    def displacement(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "2"]:
        """Sum of `ElasticRing.displacement` over the flexible rings: the shaft follows both."""
        first, *others = [ring.displacement(part) for ring, part in self.of_each(amplitudes)]
        return sum(others, first)

    def results(self, amplitudes: Float[Array, " mode"]) -> dict[str, AbstractRingDeflection]:
        """Deflected shapes of the flexible rings: field of the solution -> result."""
        return {
            "inner_ring" if ring.inner else "outer_ring": ring.shape(part) for ring, part in self.of_each(amplitudes)
        }


def _joined(parts: list[Array]) -> Array:
    return parts[0] if len(parts) == 1 else jnp.concatenate(parts)


def elastic_ring(
    part: AbstractBendingRing | None,
    material: Material,
    raceway_diameter: Scalar,
    width: Scalar | None,
    azimuth: Float[Array, " element"],
) -> ElasticRing | None:
    """Makes the `ElasticRing` of a ring of a scene; `None` for a rigid ring, which has no part or no harmonics.

    **Arguments:** `part`: the flexible ring of the scene; `material`: its material; `raceway_diameter`: diameter of its
    raceway, m; `width`: see `AbstractBendingRing.bent_ring`, m; `azimuth`: azimuths of the rolling elements, rad.
    """
    if part is None or not part.harmonics:
        return None
    ring = part.bent_ring(material, 0.5 * raceway_diameter, width)
    return ElasticRing(ring, jnp.asarray(part.sense * ring.shapes(azimuth)), part.sense < 0)
