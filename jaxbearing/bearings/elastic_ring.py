r"""Flexible rings in the equations of a bearing: their amplitudes are global unknowns, which the rolling elements feel
only as an opening of their contacts.

With the outward deflections $w_o(\psi)$ and $w_i(\psi)$ of both rings, the outer ring opens the contact of a rolling
element by $w_o$ and the inner ring by $-w_i$. The elements press the outer ring outwards by $Q_o\cos\alpha_o$ and the
inner one inwards by $Q_i\cos\alpha_i$: the generalised loads on the amplitudes are the products of these forces and of
the shapes of the openings, for both rings alike. The total energy of contacts, rings, housing and shaft less the work
of the loads stays convex, because the openings are linear in the amplitudes."""

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
from ..numerics.status import Status
from ..numerics.structure import switch
from .ring import ANCHOR, LENGTH_UNIT, InnerRing
from .ring_deflection import AbstractRingDeflection, InnerRingDeflection, RingDeflection
from .ring_shape import AbstractBendingRing

PLACES = 361
"""Azimuths at which results have the deflection of the ring."""
LEANS = 0.1
"""Least cosine of the angle between the load and a support that counts in the first guess."""
UNSUPPORTED = "outer_ring.support_angle: the supports push only, and none of them stands where the load pushes the ring"
"""Why a solve failed."""


class ElasticRing(eqx.Module):
    """A ring in the equations; unknowns are its amplitudes in units of `LENGTH_UNIT`.

    **Arguments:**
    - `ring`: the ring, with what holds and loads it.
    - `shapes`: by how much it opens the contacts of the rolling elements, over the amplitudes, dimensionless: outward
      deflections of an outer ring, inward ones of an inner ring.
    - `inner`: whether it is the inner ring.
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
        """By how much the ring opens the contacts of the rolling elements, m."""
        return LENGTH_UNIT * (amplitudes @ self.shapes)

    def pressed(self, load: Float[Array, " element"]) -> Float[Array, " mode"]:
        """Generalised loads of the rolling elements, N, from the radial forces by which they press the ring away."""
        return self.shapes @ load

    def balance(
        self, amplitudes: Float[Array, " mode"], pressed: Float[Array, " mode"], floats: bool
    ) -> Float[Array, " mode"]:
        """Forces on the amplitudes that do not balance, N.

        **Arguments:** `floats`: whether the ring may stand where neither elements nor supports touch it: it is anchored
        then.
        """
        balance = self.ring.balance(LENGTH_UNIT * amplitudes, pressed)
        return balance + anchored(amplitudes, ANCHOR * LENGTH_UNIT) if floats else balance

    def given_load(self) -> Float[Array, ""]:
        """Size of what acts on the round ring from outside, N: supports that press it already, and given loads."""
        supports, loads = self.ring.supports, self.ring.loads
        size = jnp.zeros(())
        if supports is not None:
            size = size + jnp.sum(supports.forces(jnp.zeros_like(supports.gap)))
        return size if loads is None else size + jnp.sum(jnp.abs(loads.radial) + jnp.abs(loads.tangential))

    def under(self, factor: Float[Array, ""]) -> "ElasticRing":
        """The same ring under multiples of its given loads, which balance those on the inner ring where nothing else
        holds the ring."""
        loads = self.ring.loads
        if loads is None:
            return self
        scaled = [loads.radial * factor, loads.tangential * factor]
        return eqx.tree_at(lambda outer: [outer.ring.loads.radial, outer.ring.loads.tangential], self, scaled)

    def start(self, load: Float[Array, "2"]) -> Float[Array, " mode"]:
        """First guess: the ring displaced as a rigid body to where what holds it bears the load on the bearing, along
        and across the load line, N. The elements press an inner ring against that load. A free ring begins round."""
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
            gap = jnp.max(jnp.where(lean > 0, ring.supports.gap / jnp.where(lean > 0, lean, 1.0), 0.0))
        leaning = stiffness > 0
        shift = gap + jnp.where(leaning, size / jnp.where(leaning, stiffness, 1.0), 0.0)
        # order 1 is the first that has a sine
        cosine, sine = orders.index(1), len(orders)
        along = -along if self.inner else along
        return amplitudes.at[np.asarray([cosine, sine])].set(along * shift / LENGTH_UNIT)

    def judged(self, ring: InnerRing, result: NewtonResult) -> tuple[NewtonResult, Bool[Array, ""]]:
        """The result of a solve, with the status `no_equilibrium` if it failed and the supports of the ring cannot bear
        the loads; and whether that is so."""
        supports, given = self.ring.supports, dict(zip(ring.freedoms, ring.load, strict=True))
        if supports is None or self.ring.foundation is not None or "radial" not in given:
            return result, jnp.asarray(False)
        load = jnp.stack([given["radial"], given.get("lateral", jnp.zeros(()))])
        if self.ring.loads is not None:
            load = load + self.ring.loads.resultant()
        none = supports.cannot_bear(load, "lateral" in given) & ~result.converged
        return result._replace(status=jnp.where(none, int(Status.NO_EQUILIBRIUM), result.status)), none

    def displacement(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "2"]:
        """Displacement of the shaft that follows the ring as a rigid body, along and across the load line, from its
        amplitudes, m: the harmonic of order 1 of an outer ring, that of an inner one with its sign changed; 0 without
        that order."""
        orders = self.ring.orders
        if 1 not in orders:
            return jnp.zeros(2)
        # order 1 is the first that has a sine
        found = amplitudes[np.asarray([orders.index(1), len(orders)])]
        return -found if self.inner else found

    def shape(self, amplitudes: Float[Array, " mode"]) -> AbstractRingDeflection:
        """The result."""
        scaled, ring = LENGTH_UNIT * amplitudes, self.ring
        azimuth = np.linspace(0.0, 2.0 * np.pi, PLACES)
        count = len(ring.orders)
        sines = scaled[count:] if ring.orders[0] > 0 else jnp.concatenate([jnp.zeros(1), scaled[count:]])
        orders = jnp.asarray(ring.orders, dtype=float)
        forces = None if ring.supports is None else ring.reactions(scaled)
        radius = jnp.asarray(ring.section.radius)
        deflection = ring.deflection(scaled, azimuth)
        found = (jnp.asarray(azimuth), deflection, scaled[:count], sines, radius, orders)
        return InnerRingDeflection(*found) if self.inner else RingDeflection(*found, forces)


class BentRings(eqx.Module):
    """The rings of a bearing that bend. Their amplitudes stand one behind the other: those of the outer ring, then
    those of the inner one.

    **Arguments:** `outer`, `inner`: `None` for a rigid ring.
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
        """Number of all amplitudes."""
        return sum(ring.modes for ring in self.each)

    def of_each(self, values: Array) -> list[tuple[ElasticRing, Array]]:
        """Each ring with its part of an array that has one entry for each amplitude."""
        ends = np.cumsum([0, *(ring.modes for ring in self.each)]).tolist()
        return [(ring, values[ends[k] : ends[k + 1]]) for k, ring in enumerate(self.each)]

    def names(self) -> tuple[str, ...]:
        """Names of the equations of all amplitudes."""
        return tuple(ring.equation for ring in self.each for _ in range(ring.modes))

    def shapes(self) -> Float[Array, "mode element"]:
        """Openings at the rolling elements over the amplitudes, dimensionless."""
        return jnp.concatenate([ring.shapes for ring in self.each])

    def openings(self, amplitudes: Float[Array, " mode"]) -> list[Float[Array, " element"]]:
        """By how much each ring opens the contacts of the rolling elements, m."""
        return [ring.opening(part) for ring, part in self.of_each(amplitudes)]

    def pick(self, outer: Array, inner: Array) -> list[Array]:
        """Selects the values of the flexible rings."""
        return [value for ring, value in ((self.outer, outer), (self.inner, inner)) if ring is not None]

    def pressed(self, loads: Sequence[Float[Array, " element"]]) -> Float[Array, " mode"]:
        """Generalised loads of the rolling elements, N.

        **Arguments:** `loads`: forces on each ring, as `ElasticRing.pressed` takes them.
        """
        return _joined([ring.pressed(load) for ring, load in zip(self.each, loads, strict=True)])

    def balance(
        self, amplitudes: Float[Array, " mode"], pressed: Float[Array, " mode"], floats: bool
    ) -> Float[Array, " mode"]:
        """See `ElasticRing.balance`."""
        parts = zip(self.of_each(amplitudes), self.of_each(pressed), strict=True)
        return _joined([ring.balance(own, loads, floats) for (ring, own), (_, loads) in parts])

    def energy(self, amplitudes: Float[Array, " mode"]) -> Float[Array, ""]:
        """Energy of the rings and of what holds them less the work of loads from outside, J; amplitudes in m."""
        first, *others = [ring.ring.energy(part) for ring, part in self.of_each(amplitudes)]
        return sum(others, first)

    def tangent(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "mode mode"]:
        """Second derivatives of the energy, N/m; amplitudes in m."""
        blocks = [ring.ring.tangent(part) for ring, part in self.of_each(amplitudes)]
        return blocks[0] if len(blocks) == 1 else jax.scipy.linalg.block_diag(*blocks)

    def start(self, load: Float[Array, "2"]) -> Float[Array, " mode"]:
        """See `ElasticRing.start`."""
        return _joined([ring.start(load) for ring in self.each])

    def displacement(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "2"]:
        """See `ElasticRing.displacement`; the shaft follows both rings."""
        first, *others = [ring.displacement(part) for ring, part in self.of_each(amplitudes)]
        return sum(others, first)

    def results(self, amplitudes: Float[Array, " mode"]) -> dict[str, AbstractRingDeflection]:
        """The results of the flexible rings, by their names in a solution."""
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
    """A ring of a scene in the equations; `None` if the scene has none, or none with harmonics: it is rigid then.

    **Arguments:** `part`: of the scene; `raceway_diameter`, m; `width`: of `AbstractBendingRing.bent_ring`, m;
    `azimuth`: of the rolling elements, rad.
    """
    if part is None or not part.harmonics:
        return None
    ring = part.bent_ring(material, 0.5 * raceway_diameter, width)
    return ElasticRing(ring, jnp.asarray(part.sense * ring.shapes(azimuth)), part.sense < 0)
