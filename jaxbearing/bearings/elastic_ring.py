"""A flexible outer ring in the equations of a bearing: its amplitudes are global unknowns, which the rolling elements
feel only as an opening of their own."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._types import Scalar
from ..materials import Material
from ..mounting.bent_ring import BentRing
from ..numerics.convex import anchored
from ..numerics.newton import NewtonResult
from ..numerics.status import Status
from .ring import ANCHOR, LENGTH_UNIT, InnerRing
from .ring_deflection import RingDeflection
from .ring_shape import FlexibleRing

PLACES = 361
"""Azimuths at which results have the deflection of the ring."""
LEANS = 0.1
"""Least cosine of the angle between the load and a support that counts in the first guess."""
UNSUPPORTED = "outer_ring.support_angle: the supports push only, and none of them stands where the load pushes the ring"
"""Why a solve failed."""
EQUATION = "bending of the outer ring"
"""Name of the equation of each amplitude."""


class ElasticRing(eqx.Module):
    """A ring in the equations; unknowns are its amplitudes in units of `LENGTH_UNIT`.

    **Arguments:** `ring`; `shapes`: outward deflections at the rolling elements over the amplitudes, dimensionless.
    """

    ring: BentRing
    shapes: Float[Array, "mode element"]

    @property
    def modes(self) -> int:
        return self.ring.modes

    def deflection(self, amplitudes: Float[Array, " mode"]) -> Float[Array, " element"]:
        """Outward deflection at the rolling elements, m."""
        return LENGTH_UNIT * (amplitudes @ self.shapes)

    def pressed(self, load: Float[Array, " element"]) -> Float[Array, " mode"]:
        """Generalised loads of the rolling elements, N, from their radial forces on the ring."""
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
        """First guess: the ring displaced as a rigid body to where housing and supports bear the load on the bearing,
        along and across the load line, N. A free ring begins round."""
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
        """Displacement of the ring as a rigid body, along and across the load line, from its amplitudes, m: the
        harmonic of order 1, or 0 without that."""
        orders = self.ring.orders
        if 1 not in orders:
            return jnp.zeros(2)
        # order 1 is the first that has a sine
        return amplitudes[np.asarray([orders.index(1), len(orders)])]

    def shape(self, amplitudes: Float[Array, " mode"]) -> RingDeflection:
        """The result."""
        scaled, ring = LENGTH_UNIT * amplitudes, self.ring
        azimuth = np.linspace(0.0, 2.0 * np.pi, PLACES)
        count = len(ring.orders)
        sines = scaled[count:] if ring.orders[0] > 0 else jnp.concatenate([jnp.zeros(1), scaled[count:]])
        orders = jnp.asarray(ring.orders, dtype=float)
        forces = None if ring.supports is None else ring.reactions(scaled)
        radius = jnp.asarray(ring.section.radius)
        deflection = ring.deflection(scaled, azimuth)
        return RingDeflection(jnp.asarray(azimuth), deflection, scaled[:count], sines, radius, orders, forces)


def elastic_ring(
    part: FlexibleRing,
    material: Material,
    raceway_radius: Scalar,
    width: Scalar | None,
    azimuth: Float[Array, " element"],
) -> ElasticRing | None:
    """The outer ring of a scene in the equations; `None` if it has no harmonics and is therefore rigid.

    **Arguments:** `part`: of the scene; `raceway_radius`, `width`: of `FlexibleRing.bent_ring`, m; `azimuth`: of the
    rolling elements, rad.
    """
    if not part.harmonics:
        return None
    ring = part.bent_ring(material, raceway_radius, width)
    return ElasticRing(ring, jnp.asarray(ring.shapes(azimuth)))
