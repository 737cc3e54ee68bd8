r"""Line contacts along which the approach varies: $\delta(s) = f + gs$, less the roller's profile, $0\le s\le\ell$.

Each slice carries $q = K\delta_+^{10/9}$ per length (Palmgren, source eq. (51)), $K = E'\ell^{-1/9}/(8\cdot
0.39^{10/9})$: the source prints $\ell^{+0.11}$ and 0.35, but only -1/9 follows from its eq. (41) and is dimensionally
homogeneous. All of it is the gradient of an energy, $Q = \partial w/\partial f$, $M = \partial w/\partial g$.
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
from ..numerics.safe import positive_power
from ..numerics.structure import count as whole
from .profile import AbstractProfile

EXPONENT = 10.0 / 9.0
NODES = 16
EVEN = 0.3
"""Smaller over larger approach of the two ends from which on Gauss-Legendre quadrature replaces the closed form, which
loses its digits as g goes to 0; its error is below 1e-15 there."""
LEAST_RISE = 1e-30
"""Rise of the approach over the length, m, below which a contact that is not even is taken as open."""
POINTS = 2
"""Gauss-Legendre points in each lamina: with its middle alone 30 laminae give a moment that is 2e-4 off."""


def palmgren_stiffness(length: Scalar, reduced_modulus: Scalar) -> Float[Array, ""]:
    """K, N/m^(19/9), of a contact of this length, m, and modulus E', Pa."""
    require_numbers("> 0", length=length, reduced_modulus=reduced_modulus)
    return jnp.asarray(reduced_modulus / (8.0 * 0.39**EXPONENT) * length ** (-1.0 / 9.0))


def alike_modulus(reduced_modulus: Float[Array, ""] | Float[Array, "2 1"]) -> Float[Array, ""]:
    r"""E' of two contacts that are alike and that a load brings as near as both contacts of a roller together, Pa:
    $\delta\propto E'^{-9/10}$ at a load. **Arguments:** one number for both, or inner and outer."""
    if not jnp.ndim(reduced_modulus):
        return reduced_modulus
    return jnp.mean(reduced_modulus ** (-1.0 / EXPONENT)) ** -EXPONENT


class AbstractTiltedLine(Checked):
    """Load of a contact whose approach is f + g s, m; s from one end of the roller, m.

    **Arguments:**
    - `stiffness`: K of the line load by the approach, N/m^(19/9), > 0.
    - `length`: of the contact, m, > 0.
    - `ratio`: of contacts with the inner and the outer race that differ, K of either over `stiffness`, against
      approaches with races on the last axis but one; `None`: all contacts are alike.
    """

    stiffness: eqx.AbstractVar[Scalar]
    length: eqx.AbstractVar[Scalar]
    ratio: eqx.AbstractVar[Float[Array, "2 1"] | None]

    def of_race(self, race: int) -> "AbstractTiltedLine":
        """The contact with one race alone. **Arguments:** `race`: 0 inner, 1 outer."""
        if self.ratio is None:
            return self
        return dataclasses.replace(self, stiffness=self.stiffness * self.ratio[race, 0], ratio=None)

    def _constant(self, axes: int) -> Values:
        """K of all contacts, N/m^(19/9). **Arguments:** `axes`: number of axes of what it is multiplied with."""
        if self.ratio is None:
            return self.stiffness
        return self.stiffness * jnp.expand_dims(self.ratio, range(axes - 2))

    @abc.abstractmethod
    def load_and_moment(self, f: Values, g: Values) -> tuple[Float[Array, "..."], Float[Array, "..."]]:
        """Q, N, and its moment about s = 0, N m; 0 with slope 0 where nothing touches."""

    @abc.abstractmethod
    def energy(self, f: Values, g: Values) -> Float[Array, "..."]:
        """w, J."""

    @abc.abstractmethod
    def drop(self, position: Values) -> Float[Array, "..."]:
        """Depth of the roller's profile, m, at a place, s/l from 0 to 1."""

    def load_per_length(self, f: Values, g: Values, position: Values) -> Float[Array, "..."]:
        """q, N/m, at a place s/l."""
        approach = f + g * self.length * position - self.drop(position)
        return self._constant(jnp.ndim(approach)) * positive_power(approach, EXPONENT)

    def laminae(self, f: Float[Array, " batch"], g: Float[Array, " batch"], count: int) -> Float[Array, "batch lamina"]:
        """Loads of `count` equal laminae, N, by two Gauss-Legendre points in each."""
        places, weights = lamina_points(count)
        density = self.load_per_length(f[:, None], g[:, None], jnp.asarray(places)[None, :])
        each = density * jnp.asarray(weights)[None, :] * self.length
        return jnp.sum(each.reshape(f.shape[0], count, POINTS), axis=2)


class StraightLine(AbstractTiltedLine):
    r"""Straight generators: the integrals in closed form, exact for partial contact at either end.

    $Q = \frac{9}{19}\frac Kg(d_1^{19/9} - d_0^{19/9})$ with the approaches of the ends, $d_0 = f_+$, $d_1 = (f +
    g\ell)_+$; M and w alike. Finite values, gradients and, but at first touch, second derivatives.

    **Arguments:** `stiffness` K, N/m^(19/9), `length`, m.
    """

    stiffness: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    ratio: Float[Array, "2 1"] | None = None

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
    """x^(whole + 1/9) for x > 0, 0 for x <= 0, whole >= 0: the ninth root is the one power that is formed, and is
    shared. Its own slope at x = 0 is left out."""
    positive = x > 0
    root = jnp.where(positive, jnp.where(positive, x, 1.0) ** (1.0 / 9.0), 0.0)
    return root * jnp.maximum(x, 0.0) ** whole if whole else root


def _sums(f: Array, g: Array, length: Array, power: int, orders: int) -> list[Array]:
    """Integrals of delta^(power + 1/9) s^m over the contact, m = 0 ... orders - 1 (at most 3)."""
    rise = g * length
    first, last = jnp.maximum(f, 0.0), jnp.maximum(f + rise, 0.0)
    even = jnp.minimum(first, last) > EVEN * jnp.maximum(first, last)
    # each branch sees arguments of its own kind only, so that the other's derivative is finite
    nodes, weights = gauss_legendre(NODES)
    at = jnp.asarray(nodes).reshape(-1, *(1,) * f.ndim)
    weight = jnp.asarray(weights).reshape(at.shape)
    density = weight * _ninth_power(jnp.where(even, f, 1.0)[None] + jnp.where(even, rise, 0.0)[None] * at, power)
    # not even, and hardly rising: an approach that is smaller still
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
    # 0 over a negative slope is -0
    return jnp.where(load > 0, load, 0.0), jnp.where(load > 0, moment, 0.0)


@_straight.defjvp
def _straight_jvp(primals, tangents):
    """Derivatives by the integrals of the slope, (10/9) delta^(1/9) s^m."""
    (f, g, length), (f_dot, g_dot, length_dot) = primals, tangents
    load, moment = _straight(f, g, length)
    slopes = [EXPONENT * one for one in _sums(f, g, length, power=0, orders=3)]
    end = _ninth_power(f + g * length, 1) * length_dot
    load_dot = slopes[0] * f_dot + slopes[1] * g_dot + end
    return (load, moment), (load_dot, slopes[1] * f_dot + slopes[2] * g_dot + length * end)


class SlicedLine(AbstractTiltedLine):
    """Laminae, each by the approach at two Gauss-Legendre points: error O(n^-4) where all of the length touches and the
    profile is smooth, O(n^-2) with an edge of contact inside.

    **Arguments:**
    - `stiffness` K, N/m^(19/9), `length`, m.
    - `profile`: of the roller; `None`: straight.
    - `count`: laminae (structure).
    """

    stiffness: Scalar = bounded("> 0")
    length: Scalar = bounded("> 0")
    profile: AbstractProfile | None = None
    count: int = whole("count", 30, least=1)
    ratio: Float[Array, "2 1"] | None = None

    def drop(self, position: Values) -> Float[Array, "..."]:
        if self.profile is None:
            return jnp.zeros_like(jnp.asarray(position, dtype=float))
        return self.profile.drop_at(2.0 * position - 1.0)

    def _points(self, f: Values, g: Values) -> tuple[Array, Array, Array]:
        """Places s/l, weights (together 1) and approaches of all points, on the first axis."""
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
    """Places and weights of `POINTS` points in each of `count` laminae of [0, 1], in their order."""
    nodes, weights = gauss_legendre(POINTS)
    places = (np.arange(count)[:, None] + nodes[None, :]) / count
    return places.ravel(), np.tile(weights / count, count)
