"""Functions that stay finite, with a finite and right gradient, where the plain formula does not.

Every function here states its error against the plain formula. None of them hides a wrong
answer: outside the stated neighbourhood of the singular point they agree with the plain formula
to round-off.
"""

import jax
import jax.numpy as jnp

from .._types import Batch, Values

NORM_FLOOR = 1e-150
"""Length below which `safe_norm` is smooth instead of exact (in the caller's unit)."""


@jax.custom_jvp
def log_add(a: Values, b: Values) -> Batch:
    """ln(e^a + e^b) for finite a, b: no overflow; the derivative is the softmax of (a, b).

    Like `jnp.logaddexp` without its care for infinities and NaN, which more than doubles the operations of a
    differentiated power sum, and with it the time to compile it.
    """
    return jnp.maximum(a, b) + jnp.log1p(jnp.exp(-jnp.abs(a - b)))


@log_add.defjvp
def _log_add_jvp(primals, tangents):
    (a, b), (a_dot, b_dot) = primals, tangents
    value = log_add(a, b)
    return value, jnp.exp(a - value) * a_dot + jnp.exp(b - value) * b_dot


@jax.custom_jvp
def softplus(x: Values) -> Batch:
    """ln(1 + e^x) for finite x, without overflow: `log_add(x, 0)` without the derivative by the 0."""
    return jnp.maximum(x, 0.0) + jnp.log1p(jnp.exp(-jnp.abs(jnp.asarray(x))))


@softplus.defjvp
def _softplus_jvp(primals, tangents):
    (x,), (x_dot,) = primals, tangents
    value = softplus(x)
    return value, jnp.exp(x - value) * x_dot


def softplus_floor(x: Values, floor: Values, width: Values) -> Batch:
    r"""$f + w\,\ln(1 + e^{(x - f)/w})$: a smooth max(x, floor).

    Above the floor the value is too high by less than $w e^{-(x-f)/w}$ (1e-13 w at 30 w), at the
    floor by $w \ln 2$.

    **Arguments:** `x`; `floor`, the same unit; `width` > 0, the same unit: the smoothing width.
    """
    return floor + width * softplus((x - floor) / width)


def smooth_abs(x: Values, width: Values) -> Batch:
    r"""$\sqrt{x^2 + w^2}$: |x| with a slope at 0; too high by $w$ at 0, by $w^2/(2|x|)$ far away."""
    return jnp.sqrt(jnp.square(x) + jnp.square(width))


def smooth_sign(x: Values, width: Values) -> Batch:
    r"""$x/\sqrt{x^2 + w^2}$: odd, 0 at 0; off by $w^2/(2x^2)$ far away."""
    return x / smooth_abs(x, width)


def power(x: Values, exponent: float) -> Batch:
    """x**exponent for x > 0 as exp(exponent ln x): on a CPU, where XLA leaves the power of doubles to scalar code, an
    eighth of its time; relative error about 1e-16 |exponent ln x|."""
    return jnp.exp(exponent * jnp.log(x))


def regular_power(x: Values, exponent: float, width: float, order: int = 2) -> Batch:
    r"""$x\,(x^n + w^n)^{(m-1)/n}$: $x^m$ for 0 < m < 1 with a finite slope at 0 (x >= 0).

    Zero at zero, slope $w^{m-1}$ there; relative error $(1-m) w^n/(n x^n)$ for x >> w. (Subtracting
    an offset, $(x^2+w^2)^{m/2} - w^m$, would keep the offset $w^m$ at every x.)

    **Arguments:** `order`: n, even; 2 or 4.
    """
    return x * power(jax.lax.integer_pow(jnp.asarray(x, dtype=float), order) + width**order, (exponent - 1.0) / order)


def safe_norm(x: Values, y: Values, floor: float = NORM_FLOOR) -> Batch:
    r"""$\sqrt{x^2 + y^2 + f^2}$: length of a plane vector, gradient 0 (not NaN) at the origin."""
    return jnp.sqrt(jnp.square(x) + jnp.square(y) + floor**2)


def positive_power(x: Values, exponent: float) -> Batch:
    """x**exponent for x > 0 and 0 for x <= 0, exponent > 1: value and gradient finite everywhere.

    Double `where`: the power is never formed at x <= 0, where its gradient would be NaN.
    """
    positive = x > 0
    return jnp.where(positive, power(jnp.where(positive, x, 1.0), exponent), 0.0)


def smoothstep(t: Values) -> Batch:
    """t^2 (3 - 2 t) with t clipped to [0, 1]: C1 from 0 to 1."""
    t = jnp.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def nonnegative_pressure(pressure: Values, width: float = 1e6) -> Batch:
    r"""p for p >= 0, $w(e^{p/w} - 1)$ below: exact value and slope at 0, never below -w.

    Newton and autodiff probe pressures slightly below zero, where `log1p(A p)` of a viscosity law
    would be undefined. A softplus would bias value and slope at p = 0.

    **Arguments:** `pressure`, Pa; `width`, Pa.
    """
    negative = jnp.minimum(pressure, 0.0)
    return jnp.where(pressure >= 0, pressure, width * jnp.expm1(negative / width))
