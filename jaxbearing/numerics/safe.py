"""Functions for laws that are differentiated: they avoid overflow, kinks and gradients that are NaN.

A function that differs from the plain formula states its error; the others agree with it to round-off. No function
hides a wrong answer. Each is one inner `jax.jit`: a program has it once for each shape and calls it from many places.
"""

from functools import partial

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Batch, Scalar, Values

NORM_FLOOR = 1e-150
"""Default `floor` of `safe_norm`, in the unit of the vector. At lengths far above it the result is exact to
round-off."""


@jax.custom_jvp
def _log_add(a: Values, b: Values) -> Batch:
    return jnp.maximum(a, b) + jnp.log1p(jnp.exp(-jnp.abs(a - b)))


@_log_add.defjvp
def _log_add_jvp(primals, tangents):
    (a, b), (a_dot, b_dot) = primals, tangents
    value = _log_add(a, b)
    return value, jnp.exp(a - value) * a_dot + jnp.exp(b - value) * b_dot


@jax.jit
def log_add(a: Values, b: Values) -> Batch:
    """Logarithm ln(e^a + e^b) for finite a, b: no overflow; the derivative is the softmax of (a, b).

    `jnp.logaddexp` also handles infinities and NaN, which more than doubles the operations of a differentiated power
    sum and the time to compile it.
    """
    return _log_add(a, b)


@jax.custom_jvp
def _softplus(x: Values) -> Batch:
    return jnp.maximum(x, 0.0) + jnp.log1p(jnp.exp(-jnp.abs(jnp.asarray(x))))


@_softplus.defjvp
def _softplus_jvp(primals, tangents):
    (x,), (x_dot,) = primals, tangents
    value = _softplus(x)
    return value, jnp.exp(x - value) * x_dot


@jax.jit
def softplus(x: Values) -> Batch:
    """Softplus ln(1 + e^x) for finite x, without overflow: `log_add(x, 0)`, differentiated by x only."""
    return _softplus(x)


@jax.jit
def softplus_floor(x: Values, floor: Values, width: Values) -> Batch:
    r"""$f + w\,\ln(1 + e^{(x - f)/w})$: a smooth max(x, floor).

    The value is too high: above the floor by less than $w e^{-(x-f)/w}$ (1e-13 w at 30 w), at the floor by
    $w \ln 2$.

    **Arguments:** `x`; `floor` f, in the unit of `x`; `width` w > 0, the smoothing width, in the unit of `x`.
    """
    return floor + width * softplus((x - floor) / width)


@jax.jit
def smooth_abs(x: Values, width: Values) -> Batch:
    r"""$\sqrt{x^2 + w^2}$: |x| with slope 0 at 0; too high by $w$ at 0, by $w^2/(2|x|)$ far away.

    **Arguments:** `x`; `width` w > 0, in the unit of `x`.
    """
    return jnp.sqrt(jnp.square(x) + jnp.square(width))


@jax.jit
def smooth_sign(x: Values, width: Values) -> Batch:
    r"""$x/\sqrt{x^2 + w^2}$: the sign of x, smooth, odd and 0 at 0; too small in modulus by $w^2/(2x^2)$ far away.

    **Arguments:** `x`; `width` w > 0, in the unit of `x`.
    """
    return x / smooth_abs(x, width)


@jax.jit
def power(x: Values, exponent: Scalar) -> Batch:
    """Power x**exponent for x > 0, computed as exp(exponent ln x); relative error about 1e-16 |exponent ln x|.

    On a CPU it takes an eighth of the time of x**exponent, for which XLA calls scalar code.
    """
    return jnp.exp(exponent * jnp.log(x))


@partial(jax.jit, static_argnames=("exponent", "width", "order"))
def regular_power(x: Values, exponent: float, width: float, order: int = 2) -> Batch:
    r"""$x\,(x^n + w^n)^{(m-1)/n}$: $x^m$ for 0 < m < 1 with a finite slope at 0.

    The value at 0 is 0, the slope there $w^{m-1}$. The relative error for x >> w is $(1-m) w^n/(n x^n)$. (The
    alternative $(x^2+w^2)^{m/2} - w^m$ would keep the offset $w^m$ at every x.)

    **Arguments:**
    - `x`: >= 0.
    - `exponent`: m, above 0 and below 1.
    - `width`: w > 0, in the unit of `x`.
    - `order`: n, 2 or 4.
    """
    return x * power(jax.lax.integer_pow(jnp.asarray(x, dtype=float), order) + width**order, (exponent - 1.0) / order)


@partial(jax.jit, static_argnames=("floor",))
def safe_norm(x: Values, y: Values, floor: float = NORM_FLOOR) -> Batch:
    r"""$\sqrt{x^2 + y^2 + f^2}$: length of a plane vector, with gradient 0 (not NaN) at the origin.

    It is too large by f at the origin and by less than $f^2/(2r)$ at a length r > 0.

    **Arguments:** `x`, `y`: components; `floor`: f > 0, the length at the origin, in their unit.
    """
    return jnp.sqrt(jnp.square(x) + jnp.square(y) + floor**2)


@partial(jax.jit, static_argnames=("axis",))
def largest(x: Values, axis: int | None = None) -> Float[Array, "..."]:
    """Largest value along an axis, or of all values. Its derivative is that of the entry which is largest, of the first
    one if several are.

    The derivative of `jnp.max` compares the entries with the result. A program may compute an entry twice, with other
    last bits: then none is equal to the result, and the derivative is 0/0.
    """
    x = jnp.asarray(x)
    if axis is None:
        x, axis = jnp.ravel(x), 0
    place = jnp.argmax(jax.lax.stop_gradient(x), axis=axis, keepdims=True)
    return jnp.squeeze(jnp.take_along_axis(x, place, axis=axis), axis=axis)


@partial(jax.jit, static_argnames=("exponent",))
def positive_power(x: Values, exponent: float) -> Batch:
    """Power x**exponent for x > 0, 0 for x <= 0: value and gradient are finite everywhere for `exponent` > 1.

    Two `where` keep the power from being formed at x <= 0, where its gradient would be NaN.
    """
    positive = x > 0
    return jnp.where(positive, power(jnp.where(positive, x, 1.0), exponent), 0.0)


@jax.jit
def smoothstep(t: Values) -> Batch:
    """Cubic t^2 (3 - 2 t) with t clipped to [0, 1]: a step from 0 to 1 with a continuous slope."""
    t = jnp.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


@partial(jax.jit, static_argnames=("width",))
def nonnegative_pressure(pressure: Values, width: float = 1e6) -> Batch:
    r"""Pressure p for p >= 0, $w(e^{p/w} - 1)$ for p < 0: value and slope are exact at 0, and the value stays above -w.

    Newton's method tries pressures slightly below zero, where `log1p(A p)` of a viscosity law would be undefined. A
    softplus would change value and slope at p = 0.

    **Arguments:** `pressure` p, Pa; `width` w > 0, Pa.
    """
    negative = jnp.minimum(pressure, 0.0)
    return jnp.where(pressure >= 0, pressure, width * jnp.expm1(negative / width))
