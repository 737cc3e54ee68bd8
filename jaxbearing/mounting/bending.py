r"""Bending of a thin ring in its plane, in harmonics of the angle along its circumference.

The outward deflection of the centroid circle is $w(\psi) = \sum_n a_n\cos n\psi + b_n\sin n\psi$. A radial load
$q_n\cos n\psi$ per length of circumference deflects the ring by $w_n = c_nq_n$ with

$$c_n = \frac{R^4}{EI(n^2-1)^2}(1 + i + n^2s),\quad n \ge 2,\qquad c_0 = \frac{R^2}{EA},\qquad
i = \frac{I}{AR^2},\quad s = \frac{EI}{\kappa GAR^2}$$

The order n = 1 is a displacement of the whole ring, which its own stiffness does not resist. The expressions are exact
for Timoshenko's ring, whose axial strain (i) and shear (s) are kept. A springy housing of stiffness $k_f$ per length of
circumference, and $k_t$ along it, adds $k_f + k_t/n^2$ to $1/c_n$.

**Validity:** thin rings; the curvature of the neutral fibre changes the stiffness by about $(h/R)^2$, 4 % at h/R = 0.2.
Deflections are small; bending out of the plane and twist of the section are not modelled.
**Reference:** derived from the harmonic solution of Timoshenko's ring; without shear and axial strain it is the
classical solution (Timoshenko, Strength of Materials, part II): two opposite loads P on a free ring change the diameter
along them by $(\pi/4 - 2/\pi)PR^3/EI$ = 0.149 PR^3/EI.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from .._types import Scalar

SHEAR_FACTOR = 5.0 / 6.0
"""Part of a rectangular section's area that carries shear."""


class RingSection(eqx.Module):
    """Section of a ring, and the radius of its centroid circle.

    **Arguments:**
    - `bending_stiffness`: EI about the axis of bending, N m^2, > 0.
    - `axial_stiffness`: EA, N, > 0.
    - `radius`: of the centroid circle, m, > 0.
    - `shear_stiffness`: kappa G A, N, > 0; `None`: shear strain is not modelled.
    """

    bending_stiffness: Scalar
    axial_stiffness: Scalar
    radius: Scalar
    shear_stiffness: Scalar | None = None

    @property
    def axial_share(self) -> Float[Array, ""]:
        r"""Influence of axial strain, $i = I/(AR^2)$; see the module."""
        return jnp.asarray(self.bending_stiffness / (self.axial_stiffness * jnp.square(self.radius)))

    @property
    def shear_share(self) -> Float[Array, ""]:
        r"""Influence of shear strain, $s = EI/(\kappa GAR^2)$; 0 if it is not modelled. See the module."""
        if self.shear_stiffness is None:
            return jnp.zeros(())
        return jnp.asarray(self.bending_stiffness / (self.shear_stiffness * jnp.square(self.radius)))

    def stiffness(self, orders: Int[np.ndarray, " order"]) -> Float[Array, " order"]:
        """Stiffness 1/c_n of each order, N/m^2: radial load per circumferential length over deflection; 0 for n = 1."""
        square = np.square(orders).astype(float)
        bending = self.bending_stiffness / self.radius**4 * np.square(square - 1.0) / self._softness(square)
        return jnp.where(orders == 0, self.axial_stiffness / jnp.square(self.radius), bending)

    def of_tangential_load(self, orders: Int[np.ndarray, " order"]) -> Float[Array, " order"]:
        """Factor f_T of a tangential load on w_n (`bent_ring`): effect of axial strain and shear in addition to c_n."""
        square = np.square(orders).astype(float)
        return jnp.asarray(1.0 + square * (self.axial_share + self.shear_share)) / self._softness(square)

    def of_moment(self, orders: Int[np.ndarray, " order"]) -> Float[Array, " order"]:
        """Factor f_M of a couple on w_n (`bent_ring`): effect of axial strain and shear in addition to c_n."""
        return 1.0 / self._softness(np.square(orders).astype(float))

    def _softness(self, square: Float[np.ndarray, " order"]) -> Float[Array, " order"]:
        return 1.0 + self.axial_share + square * self.shear_share

    def deflection_of_point_load(self, angle: Float[Array, "*point"]) -> Float[Array, "*point"]:
        r"""Deflection of a free ring by a unit radial load, m/N: the sum over all orders n >= 2, in closed form.

        $$w(\theta) = \frac{R^3}{\pi EI}\left[(1+i+s)\,k_2(\theta) + s\,k_1(\theta)\right]$$

        with $k_2 = -\frac12 + (\frac{\pi^2}{12} - \frac{3}{16})\cos\theta + \frac\pi4(\sin\theta - \theta\cos\theta)
        - \frac\theta4\sin\theta + \frac{\theta^2}{8}\cos\theta$ and $k_1 = \frac12 + \frac14\cos\theta
        - \frac{\pi-\theta}{2}\sin\theta$. Orders 0 and 1 are left out: add $c_0/(2\pi R)$ for the growth of the ring.

        **Arguments:** `angle` from the load, rad; it is reduced to $0 \le \theta \le \pi$.
        """
        turned = jnp.remainder(angle, 2.0 * jnp.pi)
        theta = jnp.minimum(turned, 2.0 * jnp.pi - turned)
        sine, cosine = jnp.sin(theta), jnp.cos(theta)
        bending = (
            -0.5
            + (jnp.pi**2 / 12.0 - 3.0 / 16.0) * cosine
            + 0.25 * jnp.pi * (sine - theta * cosine)
            - 0.25 * theta * sine
            + 0.125 * jnp.square(theta) * cosine
        )
        kink = 0.5 + 0.25 * cosine - 0.5 * (jnp.pi - theta) * sine
        softness = 1.0 + self.axial_share + self.shear_share
        unit = self.radius**3 / (jnp.pi * self.bending_stiffness)
        return unit * (softness * bending + self.shear_share * kink)


def rectangular_section(
    youngs_modulus: Scalar, width: Scalar, height: Scalar, radius: Scalar, poisson_ratio: Scalar | None = None
) -> RingSection:
    """A ring of rectangular section.

    **Arguments:** modulus of elasticity, Pa, > 0; `width` along the axis, `height` along the radius and centroid
    `radius`, m, > 0; `poisson_ratio`: for the shear strain; `None`: shear strain is not modelled.
    """
    area = width * height
    shear = None
    if poisson_ratio is not None:
        shear = SHEAR_FACTOR * youngs_modulus / (2.0 * (1.0 + poisson_ratio)) * area
    return RingSection(youngs_modulus * area * height**2 / 12.0, youngs_modulus * area, radius, shear)


class Foundation(eqx.Module):
    """Springs around the whole ring, which push and pull: a housing in which the ring is pressed.

    A massive housing has about $k_f = Ebn/(2(1-\\nu^2)R)$ (half-plane, plane strain; uncertain by a factor of 2 for
    small n): 5e10 N/m^2 for steel, b = 20 mm, R = 85 mm, n = 2. Thin or light housings have 1e9 to 1e10 N/m^2.

    **Arguments:**
    - `stiffness`: $k_f$, radial force per length of circumference and deflection, N/m^2, >= 0: one number, or one for
      each order.
    - `shear`: $k_t$, tangential force per length and displacement, N/m^2, >= 0, of a ring that is glued or tightly
      fitted.
    """

    stiffness: Scalar | Float[Array, " order"]
    shear: Scalar = 0.0

    def of_orders(self, orders: Int[np.ndarray, " order"]) -> Float[Array, " order"]:
        """Stiffness $k_f + k_t/n^2$ of each order, N/m^2; $k_f$ for n = 0."""
        square = np.square(orders).astype(float)
        along = np.where(orders > 0, 1.0 / np.maximum(square, 1.0), 0.0)
        return jnp.asarray(self.stiffness + self.shear * along)


def aliased_compliance(
    section: RingSection, foundation: Foundation | None, count: int, repeats: int = 500
) -> Float[Array, " order"]:
    r"""Amplitudes of the orders 0 to `count`/2 for unit loads, m/N, if all loads act at `count` evenly spaced places.

    At these places the orders m and $lN \pm m$ have the same shape, so that their compliances add up. With the sums the
    orders 0 to N/2 give the deflections at the places without truncation of the orders.

    **Arguments:** `count`: N, even; `repeats`: number of terms l of the sum. Its error falls with the third power of
    the number; with shear strain, with the first power.

    **Raises:** `ValueError` for an odd `count`.
    """
    if count % 2:
        raise ValueError(f"count must be even, got {count}")
    half, steps = count // 2, count * np.arange(1, repeats + 1)
    of = lambda orders: compliance_of_orders(section, foundation, orders.ravel()).reshape(orders.shape)
    orders = np.arange(half + 1)
    own = of(orders)
    above, below = of(steps[:, None] + orders), of(steps[:, None] - orders)
    others = jnp.sum(above, axis=0) + jnp.where((orders == 0) | (orders == half), 0.0, jnp.sum(below, axis=0))
    return own + others


def compliance_of_orders(
    section: RingSection, foundation: Foundation | None, orders: Int[np.ndarray, " order"]
) -> Float[Array, " order"]:
    """Amplitude of each order by a unit point load at the crest of its shape, m/N; infinite without stiffness."""
    return 1.0 / stiffness_of_orders(section, foundation, orders)


def stiffness_of_orders(
    section: RingSection, foundation: Foundation | None, orders: Int[np.ndarray, " order"]
) -> Float[Array, " order"]:
    """Generalised stiffness of each order, N/m: $\\pi R(1/c_n + k_f + k_t/n^2)$, twice this for n = 0."""
    each = section.stiffness(orders)
    if foundation is not None:
        each = each + foundation.of_orders(orders)
    return jnp.pi * section.radius * np.where(orders == 0, 2.0, 1.0) * each
