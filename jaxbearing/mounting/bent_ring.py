r"""A flexible ring (`bending`) under loads, on a housing all around it or on single supports.

The energy is a convex function of the amplitudes $x = (a_n, b_n)$ of the deflection:

$$U = \tfrac12\sum_n K_nx_n^2 + \sum_m\tfrac12k_m\langle w(\varphi_m) - g_m\rangle_+^2 - \sum_n G_nx_n$$

with the stiffness $K_n$ of ring and housing, the generalised loads $G_n$, and supports of stiffness $k_m$ at the angles
$\varphi_m$ with gaps $g_m$, which only push. A load at the angle $\varphi$ on the centroid circle contributes to the
cosine and the sine amplitude of order n

- a radial force P, outwards: $P\cos n\varphi$, $P\sin n\varphi$;
- a tangential force T, counter-clockwise: $-\frac{T}{n}f_T\sin n\varphi$, $\frac{T}{n}f_T\cos n\varphi$;
- a couple M, counter-clockwise: $\frac{n^2-1}{nR}Mf_M\sin n\varphi$, $-\frac{n^2-1}{nR}Mf_M\cos n\varphi$,

where $f_T = (1 + n^2(i+s))/(1+i+n^2s)$ and $f_M = 1/(1+i+n^2s)$ are exact for Timoshenko's ring, also on a springy
housing. Rolling elements press an outer ring with P = Q and an inner one with P = -Q.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from .._types import Scalar
from .bending import Foundation, RingSection, stiffness_of_orders

ALIGNED = 1e-9
"""Largest cosine that counts as 0: a direction is then at right angles to a support."""


class RimLoads(eqx.Module):
    """External forces on a ring, one entry for each force; for example at the teeth of a planet gear.

    **Arguments:**
    - `angle`: where they act, rad.
    - `radial`: outwards, N.
    - `tangential`: counter-clockwise, N.
    - `radius`: where they act, m: a tangential force away from the centroid circle adds a couple.
    """

    angle: Float[Array, " load"]
    radial: Float[Array, " load"]
    tangential: Float[Array, " load"]
    radius: Float[Array, " load"]

    def resultant(self) -> Float[Array, "2"]:
        """Sum of the forces along the angles 0 and 90 degrees, N."""
        sine, cosine = jnp.sin(self.angle), jnp.cos(self.angle)
        along = self.radial * cosine - self.tangential * sine
        across = self.radial * sine + self.tangential * cosine
        return jnp.stack([jnp.sum(along), jnp.sum(across)])


class Supports(eqx.Module):
    """Springs around a ring, such as the feet of a cut housing, that push the ring inwards and never pull.

    **Arguments:**
    - `angle`: where they stand, rad.
    - `stiffness`: N/m, > 0.
    - `gap`: outward deflection at which the ring touches, m; negative: the support is preloaded.
    """

    angle: Float[Array, " support"]
    stiffness: Float[Array, " support"]
    gap: Float[Array, " support"]

    def forces(self, deflection: Float[Array, " support"]) -> Float[Array, " support"]:
        """Inward forces on the ring, N, from its outward deflection there, m."""
        return self.stiffness * jnp.maximum(deflection - self.gap, 0.0)

    def cannot_bear(self, load: Float[Array, "2"], sideways: bool) -> Bool[Array, ""]:
        """True if no forces of the supports balance a load on the ring along the angles 0 and 90 degrees, N.

        The supports only push, so a load can be balanced if it is a sum of positive multiples of their directions. It
        cannot if some direction points along the load, and away from all supports or at right angles to them. In a
        plane it suffices to try the direction of the load and the normals to the supports.

        **Arguments:** `sideways`: True if the load along 90 degrees counts; False if the ring is held that way.
        """
        towards = jnp.stack([jnp.cos(self.angle), jnp.sin(self.angle)])
        if not sideways:
            return (load[0] != 0.0) & ~jnp.any(towards[0] * load[0] > 0.0)
        normals = jnp.stack([-towards[1], towards[0]])
        tried = jnp.concatenate([load[:, None], normals, -normals], axis=1)
        away = jnp.all(tried.T @ towards <= ALIGNED, axis=1)
        size = jnp.sqrt(jnp.sum(jnp.square(load)))
        return jnp.any(away & (load @ tried > ALIGNED * size)) & (size > 0.0)

    def energy(self, deflection: Float[Array, " support"]) -> Float[Array, ""]:
        """Elastic energy of the supports, J."""
        return 0.5 * jnp.sum(self.stiffness * jnp.square(jnp.maximum(deflection - self.gap, 0.0)))


class BentRing(eqx.Module):
    """A flexible ring with its housing or supports, and with its loads other than those of rolling elements.

    **Arguments:**
    - `section`: section of the ring.
    - `orders`: orders of the harmonics. Leave out 1 for a ring that nothing holds and whose loads balance each other:
      its position is undetermined.
    - `foundation`: housing around the ring, or shaft in it; `None`: there is none.
    - `supports`, `loads`: `None`: there are none.

    **Raises:** `ValueError` for orders that are not whole, not rising or negative; for order 1 of a ring that neither
    a foundation nor supports hold.
    """

    section: RingSection
    orders: tuple[int, ...] = eqx.field(static=True)
    foundation: Foundation | None = None
    supports: Supports | None = None
    loads: RimLoads | None = None

    def __check_init__(self):
        orders = np.asarray(self.orders, dtype=int)
        if orders.size == 0 or orders[0] < 0 or np.any(np.diff(orders) <= 0):
            raise ValueError(f"orders must be rising whole numbers from 0 on, got {self.orders}")
        if 1 in self.orders and self.foundation is None and self.supports is None:
            raise ValueError("orders: nothing holds the ring in place, leave out order 1")

    @property
    def modes(self) -> int:
        """Number of amplitudes: cosines of all orders, then sines of those above 0."""
        return int(self._of_modes.size)

    @property
    def _of_modes(self) -> Int[np.ndarray, " mode"]:
        """Order of each amplitude."""
        orders = np.asarray(self.orders, dtype=int)
        return np.concatenate([orders, orders[orders > 0]])

    @property
    def _sine(self) -> np.ndarray:
        """Mask of the amplitudes: True for sines."""
        return np.arange(self.modes) >= len(self.orders)

    def shapes(self, angle: Float[Array | np.ndarray, " place"]) -> Float[Array | np.ndarray, "mode place"]:
        """Deflection at the angles, rad, per unit of each amplitude.

        NumPy angles give a NumPy array. It is a constant of a compiled program, which need not compute the sines in
        every solve.
        """
        library = np if isinstance(angle, np.ndarray) else jnp
        turned, count = self._of_modes.astype(float)[:, None] * angle[None, :], len(self.orders)
        return library.concatenate([library.cos(turned[:count]), library.sin(turned[count:])])

    def deflection(
        self, amplitudes: Float[Array, " mode"], angle: Float[Array | np.ndarray, " place"]
    ) -> Float[Array, " place"]:
        """Outward deflection at the angles, rad; m."""
        return amplitudes @ self.shapes(angle)

    def stiffness(self) -> Float[Array, " mode"]:
        """Generalised stiffness of ring and foundation, N/m, for each amplitude."""
        orders = np.asarray(self.orders, dtype=int)
        place = np.arange(orders.size)
        of_order = stiffness_of_orders(self.section, self.foundation, orders)
        return of_order[np.concatenate([place, place[orders > 0]])]

    def given_loads(self) -> Float[Array, " mode"]:
        """Generalised loads of `loads`, N."""
        loads = self.loads
        if loads is None:
            return jnp.zeros(self.modes)
        order, section = self._of_modes, self.section
        shapes = self.shapes(loads.angle)
        # derivatives of the shapes by the angle, divided by the order; 0 for order 0, which no tangential load excites
        at = order.astype(float)[:, None] * loads.angle[None, :]
        turned = jnp.where(self._sine[:, None], jnp.cos(at), -jnp.sin(at))
        over = np.where(order > 0, 1.0 / np.maximum(order, 1), 0.0)
        tangential = over * section.of_tangential_load(order)
        couple = over * (np.square(order) - 1.0) * section.of_moment(order) / section.radius
        moment = loads.tangential * (loads.radius - section.radius)
        return shapes @ loads.radial + tangential * (turned @ loads.tangential) - couple * (turned @ moment)

    def balance(self, amplitudes: Float[Array, " mode"], pressed: Float[Array, " mode"]) -> Float[Array, " mode"]:
        """Residuals of equilibrium, N: gradient of `energy` less the generalised loads `pressed` of the elements."""
        rows = self.stiffness() * amplitudes - pressed - self.given_loads()
        if self.supports is None:
            return rows
        shapes = self.shapes(self.supports.angle)
        return rows + shapes @ self.supports.forces(amplitudes @ shapes)

    def tangent(self, amplitudes: Float[Array, " mode"]) -> Float[Array, "mode mode"]:
        """Derivatives of `balance` by the amplitudes, N/m."""
        stiffness = jnp.diag(self.stiffness())
        if self.supports is None:
            return stiffness
        shapes = self.shapes(self.supports.angle)
        touching = amplitudes @ shapes > self.supports.gap
        return stiffness + (shapes * jnp.where(touching, self.supports.stiffness, 0.0)[None]) @ shapes.T

    def energy(self, amplitudes: Float[Array, " mode"]) -> Float[Array, ""]:
        """Elastic energy less the work of `loads`, J; without rolling elements `balance` is its gradient."""
        energy = 0.5 * jnp.sum(self.stiffness() * jnp.square(amplitudes)) - self.given_loads() @ amplitudes
        if self.supports is None:
            return energy
        return energy + self.supports.energy(self.deflection(amplitudes, self.supports.angle))

    def reactions(self, amplitudes: Float[Array, " mode"]) -> Float[Array, " support"]:
        """Inward forces of the supports, N; none without supports."""
        if self.supports is None:
            return jnp.zeros(0)
        return self.supports.forces(self.deflection(amplitudes, self.supports.angle))

    def amplitudes(self, pressed: Float[Array, " mode"]) -> Float[Array, " mode"]:
        """Amplitudes, m, under the generalised loads `pressed`, N, and those of `loads`; only without supports.

        **Raises:** `ValueError` for a ring on supports, whose contacts open and close.
        """
        if self.supports is not None:
            raise ValueError("a ring on supports has no closed form: solve `balance`")
        return (pressed + self.given_loads()) / self.stiffness()


def point_load(ring: BentRing, angle: Scalar, force: Scalar) -> Float[Array, " mode"]:
    """Generalised loads of a radial force, N, outwards, at an angle, rad."""
    return ring.shapes(jnp.asarray(angle)[None])[:, 0] * force
