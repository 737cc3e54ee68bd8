r"""Line contacts of tilted rollers, with the approach $\delta(s) = f + gs$, less the profile, at $0\le s\le\ell$.

The load per length is $q = K\delta_+^{10/9}$ (Palmgren, source eq. (51)), $K = E'\ell^{-1/9}/(8\cdot 0.39^{10/9})$:
the source prints $\ell^{+0.11}$ and 0.35, but only -1/9 follows from its eq. (41) and is dimensionally homogeneous.
Load and moment are the gradient of an energy, $Q = \partial w/\partial f$, $M = \partial w/\partial g$.
"""

import abc
import dataclasses

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.quadrature import gauss_legendre
from ..numerics.roots import Root, monotone_root
from ..numerics.safe import positive_power
from ..numerics.structure import count as whole
from .profile import AbstractProfile

EXPONENT = 10.0 / 9.0
NODES = 16
EVEN = 0.3
"""Ratio of the smaller to the larger end approach above which Gauss-Legendre quadrature, then accurate to 1e-15,
replaces the closed form, which loses digits as g -> 0."""
LEAST_RISE = 1e-30
"""Change of the approach over the length, m, below which an uneven contact (see `EVEN`) is taken as unloaded."""
MARGIN = 1e-3
"""Margin of the bracket of `approach_under`, in units of ln(approach)."""
POINTS = 2
"""Gauss-Legendre points in each lamina; with one point, 30 laminae have an error of 2e-4 in the moment."""


def palmgren_stiffness(length: Scalar, reduced_modulus: Scalar) -> Float[Array, ""]:
    """Stiffness K of a line contact, N/m^(19/9). **Arguments:** `length`, m; `reduced_modulus` E', Pa."""
    require_numbers("> 0", length=length, reduced_modulus=reduced_modulus)
    return jnp.asarray(reduced_modulus / (8.0 * 0.39**EXPONENT) * length ** (-1.0 / 9.0))


def alike_modulus(reduced_modulus: Float[Array, ""] | Float[Array, "2 1"]) -> Float[Array, ""]:
    r"""Common E' of both contacts of a roller, Pa, that gives the same total approach under a load as the two E'.

    At a given load $\delta\propto E'^{-9/10}$. **Arguments:** `reduced_modulus`, Pa: one number for both contacts, or
    inner and outer.
    """
    if not jnp.ndim(reduced_modulus):
        return reduced_modulus
    return jnp.mean(reduced_modulus ** (-1.0 / EXPONENT)) ** -EXPONENT


class AbstractTiltedLine(Checked):
    """Load of a contact with the approach f + g s, m, s the distance from one end of the roller, m.

    **Arguments:**
    - `stiffness`: K of the load per length, N/m^(19/9), > 0.
    - `length`: of the contact, m, > 0.
    - `ratio`: K of the inner and of the outer contact over `stiffness`, where they differ; approaches then have the
      races on the last axis but one; `None`: all contacts are alike.
    """

    stiffness: eqx.AbstractVar[Scalar]
    length: eqx.AbstractVar[Scalar]
    ratio: eqx.AbstractVar[Float[Array, "2 1"] | None]

    def of_race(self, race: int) -> "AbstractTiltedLine":
        """Contact with one race only. **Arguments:** `race`: 0 inner, 1 outer."""
        if self.ratio is None:
            return self
        return dataclasses.replace(self, stiffness=self.stiffness * self.ratio[race, 0], ratio=None)

    def _constant(self, axes: int) -> Values:
        """K of all contacts, N/m^(19/9). **Arguments:** `axes`: number of axes of the array that K multiplies."""
        if self.ratio is None:
            return self.stiffness
        return self.stiffness * jnp.expand_dims(self.ratio, range(axes - 2))

    @abc.abstractmethod
    def load_and_moment(self, f: Values, g: Values) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
        """Load Q, N, and its moment about s = 0, N m; both 0 with slope 0 without contact."""

    @abc.abstractmethod
    def energy(self, f: Values, g: Values) -> Float[Array, "..."]:
        """Elastic energy w, J."""

    @abc.abstractmethod
    def drop(self, position: Values) -> Float[Array, "..."]:
        """Depth of the roller's profile, m. **Arguments:** `position`: s/l, from 0 to 1."""

    @property
    @abc.abstractmethod
    def places(self) -> np.ndarray:
        """Positions s/l among which the approach less the profile is largest where the contact carries most."""

    def approach_under(self, load: Values, g: Values) -> Root:
        """Approach f under which the contact carries a load: the inverse of `load_and_moment`. The value is f, m, the
        residual that of the search, in units of ln(load).

        The unknown is the logarithm of the largest approach along the roller. It lies between the approach of a contact
        that touches evenly along its length and that of one whose lowest place has the even approach. Where along the
        roller the approach is largest has no effect on f, and therefore none on its derivatives.

        **Arguments:** `load`: Q, N, > 0; `g`: slope.
        """
        load, g = jnp.broadcast_arrays(jnp.asarray(load, dtype=float), jnp.asarray(g, dtype=float))
        even = (load / (self._constant(load.ndim) * self.length)) ** (1.0 / EXPONENT)
        place = jnp.asarray(self.places).reshape(-1, *(1,) * g.ndim)
        along = jax.lax.stop_gradient(g[None] * (self.length * place) - self.drop(place))
        highest = jnp.max(along, axis=0)
        spread = highest - jnp.min(along, axis=0)

        def excess(log_most: Array, args: tuple[Array, Array, Array, AbstractTiltedLine]) -> Array:
            load_, g_, highest_, line = args
            return jnp.log(line.load_and_moment(jnp.exp(log_most) - highest_, g_)[0]) - jnp.log(load_)

        low, middle, high = (jnp.log(even + part * spread) for part in (0.0, 0.5, 1.0))
        root = monotone_root(excess, (load, g, highest, self), low - MARGIN, high + MARGIN, middle)
        return Root(jnp.exp(root.value) - highest, root.residual)

    def load_per_length(self, f: Values, g: Values, position: Values) -> Float[Array, "..."]:
        """Load per length q, N/m. **Arguments:** `position`: s/l, from 0 to 1."""
        approach = f + g * self.length * position - self.drop(position)
        return self._constant(jnp.ndim(approach)) * positive_power(approach, EXPONENT)

    def laminae(self, f: Float[Array, " batch"], g: Float[Array, " batch"], count: int) -> Float[Array, "batch lamina"]:
        """Loads of `count` equal laminae, N, from two Gauss-Legendre points in each."""
        places, weights = lamina_points(count)
        density = self.load_per_length(f[:, None], g[:, None], jnp.asarray(places)[None, :])
        each = density * jnp.asarray(weights)[None, :] * self.length
        return jnp.sum(each.reshape(f.shape[0], count, POINTS), axis=2)


class StraightLine(AbstractTiltedLine):
    r"""Straight roller: the integrals in closed form, exact for partial contact at either end.

    $Q = \frac{9}{19}\frac Kg(d_1^{19/9} - d_0^{19/9})$ with the end approaches $d_0 = f_+$, $d_1 = (f + g\ell)_+$; M
    and w likewise. Values and gradients are finite, and so are second derivatives except at first touch.

    **Arguments:** `stiffness` K, N/m^(19/9), `length`, m.
    """

    stiffness: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    ratio: Float[Array, "2 1"] | None = None

    @property
    def places(self) -> np.ndarray:
        return np.asarray([0.0, 1.0])

    def drop(self, position: Values) -> Float[Array, "..."]:
        return jnp.zeros_like(jnp.asarray(position, dtype=float))

    def load_and_moment(self, f: Values, g: Values) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
        f, g, length = (jnp.asarray(value, dtype=float) for value in (f, g, self.length))
        load, moment = _straight(*jnp.broadcast_arrays(f, g, length))
        constant = self._constant(load.ndim)
        return constant * load, constant * moment

    def energy(self, f: Values, g: Values) -> Float[Array, "..."]:
        f, g, length = (jnp.asarray(value, dtype=float) for value in (f, g, self.length))
        total = _sums(*jnp.broadcast_arrays(f, g, length), power=2, orders=1)[0]
        return self._constant(total.ndim) / (EXPONENT + 1.0) * total


def _ninth_power(x: Array, whole: int) -> Array:
    """Power x^(whole + 1/9) for x > 0, 0 for x <= 0, with whole >= 0.

    The ninth root is the only non-integer power; its infinite slope at x = 0 counts as 0.
    """
    positive = x > 0
    root = jnp.where(positive, jnp.where(positive, x, 1.0) ** (1.0 / 9.0), 0.0)
    return root * jnp.maximum(x, 0.0) ** whole if whole else root


def _sums(f: Array, g: Array, length: Array, power: int, orders: int) -> list[Array]:
    """Integrals of delta^(power + 1/9) s^m over the contact, m = 0 ... orders - 1 (at most 3)."""
    rise = g * length
    first, last = jnp.maximum(f, 0.0), jnp.maximum(f + rise, 0.0)
    even = jnp.minimum(first, last) > EVEN * jnp.maximum(first, last)
    # each branch gets arguments of its own case only, so that the derivative of the unused branch is finite
    nodes, weights = gauss_legendre(NODES)
    at = jnp.asarray(nodes).reshape(-1, *(1,) * f.ndim)
    weight = jnp.asarray(weights).reshape(at.shape)
    density = weight * _ninth_power(jnp.where(even, f, 1.0)[None] + jnp.where(even, rise, 0.0)[None] * at, power)
    # uneven with hardly any rise: the approach is even smaller than the rise, and any slope will do
    slope = jnp.where(even | (jnp.abs(rise) < LEAST_RISE), 1.0, g)
    ends = jnp.stack([last, first])
    ending, plain = _ninth_power(ends, power), []
    for m in range(orders):
        ending = ending * ends
        plain.append((ending[0] - ending[1]) / ((power + m + 10.0 / 9.0) * slope))
    # s = (delta - f)/g
    steep = [plain[0]]
    if orders > 1:
        steep.append((plain[1] - f * plain[0]) / slope)
    if orders > 2:
        steep.append((plain[2] - 2.0 * f * plain[1] + f * f * plain[0]) / (slope * slope))
    smooth = [length ** (m + 1) * jnp.sum(density * at**m, axis=0) for m in range(orders)]
    return [jnp.where(even, a, b) for a, b in zip(smooth, steep, strict=True)]


@jax.custom_jvp
def _straight(f: Array, g: Array, length: Array) -> tuple[Array, Array]:
    """Integrals of delta^(10/9) and delta^(10/9) s over the contact."""
    load, moment = _sums(f, g, length, power=1, orders=2)
    # 0 divided by a negative slope is -0
    return jnp.where(load > 0, load, 0.0), jnp.where(load > 0, moment, 0.0)


@_straight.defjvp
def _straight_jvp(primals, tangents):
    """Derivatives by the integrals of the slope, (10/9) delta^(1/9) s^m."""
    (f, g, length), (f_dot, g_dot, length_dot) = primals, tangents
    load, moment = _straight(f, g, length)
    slopes = [EXPONENT * integral for integral in _sums(f, g, length, power=0, orders=3)]
    end = _ninth_power(f + g * length, 1) * length_dot
    load_dot = slopes[0] * f_dot + slopes[1] * g_dot + end
    return (load, moment), (load_dot, slopes[1] * f_dot + slopes[2] * g_dot + length * end)


class SlicedLine(AbstractTiltedLine):
    """Profiled roller cut into n laminae, with two Gauss-Legendre points in each.

    The error is O(n^-4) where the whole length is in contact and the profile is smooth, O(n^-2) where the contact ends
    within the length.

    **Arguments:**
    - `stiffness` K, N/m^(19/9), `length`, m.
    - `profile`: of the roller; `None`: straight.
    - `count`: number n of laminae (structure).
    """

    stiffness: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    profile: AbstractProfile | None = None
    count: int = whole("count", 30, least=1)
    ratio: Float[Array, "2 1"] | None = None

    @property
    def places(self) -> np.ndarray:
        return lamina_points(self.count)[0]

    def drop(self, position: Values) -> Float[Array, "..."]:
        if self.profile is None:
            return jnp.zeros_like(jnp.asarray(position, dtype=float))
        return self.profile.drop_at(2.0 * position - 1.0)

    def _points(self, f: Values, g: Values) -> tuple[Array, Array, Array]:
        """Positions s/l, weights (of sum 1) and approaches, m, of all points, on the first axis."""
        f, g = jnp.broadcast_arrays(jnp.asarray(f, dtype=float), jnp.asarray(g, dtype=float))
        places, weights = lamina_points(self.count)
        shape = (-1, *(1,) * f.ndim)
        place = jnp.asarray(places).reshape(shape)
        approach = f[None] + g[None] * (self.length * place) - self.drop(place)
        return place, jnp.asarray(weights).reshape(shape), approach

    def load_and_moment(self, f: Values, g: Values) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
        place, weight, approach = self._points(f, g)
        load = self._constant(approach.ndim) * self.length * weight * positive_power(approach, EXPONENT)
        return jnp.sum(load, axis=0), self.length * jnp.sum(load * place, axis=0)

    def energy(self, f: Values, g: Values) -> Float[Array, "..."]:
        _, weight, approach = self._points(f, g)
        each = weight * positive_power(approach, EXPONENT + 1.0)
        return self._constant(each.ndim - 1) * self.length / (EXPONENT + 1.0) * jnp.sum(each, axis=0)


def lamina_points(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Positions and weights of `POINTS` Gauss-Legendre points in each of `count` equal laminae of [0, 1], in order."""
    nodes, weights = gauss_legendre(POINTS)
    places = (np.arange(count)[:, None] + nodes[None, :]) / count
    return places.ravel(), np.tile(weights / count, count)
