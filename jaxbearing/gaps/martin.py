"""Rigid isoviscous line contact with normal velocity: Martin's film."""

import math
from typing import NamedTuple

import jax
import jax.numpy as jnp

from .._types import Batch, Values
from ..numerics.arguments import require_numbers
from ..numerics.safe import smooth_abs
from ..numerics.series import horner

MARTIN_LOAD = 4.894968493913369
"""Load factor Gw at s = 0: W = 4.895 mu u R L/h (Martin's 4.9; 2.45 with u1 + u2 in place of the mean speed u)."""
MARTIN_SHEAR = 2.01435066101268
"""Shear factor Gs at s = 0."""
MARTIN_ROLLING = 6.506905317803327
"""Rolling factor Gr at s = 0."""
SPEED_WIDTH = 1e-9
"""Smoothing of the entrainment speed at rest, m/s: relative error 5e-13 at 1 mm/s."""
_EXIT_START = (
    *(0.4751299201, -1.357426789, -0.5429352829, 1.330780164, 0.7815944628, -1.342517866, -0.7451151103),
    *(1.354473076, 0.682223562, -1.286782901, -0.6947424993, 1.131742606, 0.6585831024, -0.874813446),
    *(-0.478793966, 0.5172988587, 0.2392884099, -0.1930806543, -0.07298827808, 0.03282697006, 0.01025568186),
)
"""Coefficients of T/sqrt(1 + s^2) as a polynomial in s/(1 + sqrt(1 + s^2)).

They come from Chebyshev interpolation over all s, with the limits 1 and -3/8 of pure squeeze; one Newton step squares
the error of 3e-8."""
_SERIES_BELOW = 0.8
_SERIES = range(1, 14)
_I2_SERIES = tuple((-1) ** (k + 1) * 4.0**k / (2 * math.factorial(2 * k + 1)) for k in _SERIES)
_I4_SERIES = tuple((-1) ** k * (16.0**k / 8 - 4.0**k / 2) / math.factorial(2 * k + 1) for k in _SERIES)
_ARCTAN_SERIES = tuple((-1) ** k / (2 * k + 1) for k in range(12))


class MartinFactors(NamedTuple):
    """Factors of load, Couette shear and rolling of a line film (Gw, Gs, Gr)."""

    load: Batch
    shear: Batch
    rolling: Batch


def _angle(sin: Values, cos: Values) -> Batch:
    """Angle between 0 and pi from its sine and cosine (error < 1e-16).

    The angle, or its supplement, is halved three times, and the arctangent of that is a series. The arctangent of jnp
    takes seven times as long on a CPU, where XLA calls scalar code for doubles.
    """
    tangent = sin / (1.0 + jnp.abs(cos))
    for _ in range(2):
        tangent = tangent / (1.0 + jnp.sqrt(1.0 + tangent * tangent))
    square = tangent * tangent
    angle = 8.0 * tangent * horner(_ARCTAN_SERIES, square)
    return jnp.where(cos < 0, math.pi - angle, angle)


def _moments(exit_position: Values) -> tuple[Batch, Batch, Batch, Batch]:
    r"""Values of beta, sin(beta), I2, I4 with $\beta = \pi/2 + \arctan T$, $I_n = \int_0^\beta \sin^n$.

    With the angle counted from the inlet, fast separation (T -> -inf, beta -> 0) is free of cancellation; below
    beta = 0.8 the integrals are computed by their Taylor series (error < 1e-16).
    """
    sin = 1.0 / jnp.sqrt(1.0 + exit_position * exit_position)
    cos = -exit_position * sin
    beta = _angle(sin, cos)
    small = beta < _SERIES_BELOW
    b = jnp.where(small, beta, 0.0)
    b2 = b * b
    i2 = jnp.where(small, b * b2 * horner(_I2_SERIES, b2), 0.5 * (beta - sin * cos))
    i4 = jnp.where(small, b * b2 * horner(_I4_SERIES, b2), 0.75 * i2 - 0.25 * cos * sin**3)
    return beta, sin, i2, i4


class _Exit(NamedTuple):
    """Exit position T of a film and the `_moments` at it."""

    position: Batch
    angle: Batch
    sine: Batch
    second: Batch
    fourth: Batch


def _excess_and_slope(exit_: _Exit) -> tuple[Batch, Batch]:
    r"""Sum T + s(T), and the slope ds/dT < 0.

    The printed quotient is $s = (I_2-(1+T^2)I_4)/D$, $D = TI_4 + \sin^4\beta/4$. With
    $I_4 = \tfrac34I_2 - \tfrac14\cos\beta\sin^3\beta$ it is $s = I_2/(4D) - T$, which does not cancel. With
    dI2/dT = sin^4 and dD/dT = I4 the slope is $-I_4(2T+s)/D$.
    """
    t, _, sin, i2, i4 = exit_
    denominator = t * i4 + 0.25 * sin**4
    excess = 0.25 * i2 / denominator
    return excess, -i4 * (t + excess) / denominator


def _moved(exit_: _Exit, way: Values) -> _Exit:
    """First-order change of T and the moments by a small change `way` of T."""
    t, _, sin, _, _ = exit_
    square = sin * sin
    return _Exit(way, square * way, -t * sin * square * way, square**2 * way, square**3 * way)


@jax.custom_jvp
def _exit(s):
    """Exit position and moments at s, by one Newton step from the polynomial `_EXIT_START`.

    The moments are expensive: they are computed once, at the start, and corrected to first order. The relative error of
    the factors is 4e-13.
    """
    root = jnp.sqrt(1.0 + s * s)
    t = root * horner(_EXIT_START, s / (1.0 + root))
    start = _Exit(t, *_moments(t))
    excess, slope = _excess_and_slope(start)
    return _Exit(*(a + b for a, b in zip(start, _moved(start, (s - (excess - t)) / slope), strict=True)))


@_exit.defjvp
def _exit_jvp(primals, tangents):
    outlet = _exit(primals[0])
    return outlet, _moved(outlet, tangents[0] / _excess_and_slope(outlet)[1])


def martin_exit(s: Values) -> Batch:
    r"""Exit position T, in units of $\sqrt{2Rh_0}$, of a line film with squeeze number s; there p = dp/dx = 0.

    The inverse of the explicit, decreasing $s(T) = -(I_2-(1+T^2)I_4)/(J_3-TI_4)$ by Newton's method, with the
    derivative 1/s'(T), for |s| < 1e60.

    **Limits:** 0.4751 at s = 0; -s as s -> -inf (pure squeeze); -3s/8 as s -> +inf.
    **Reference:** Martin (1916), Engineering 102, 119; Dowson, Markho and Jones (1976), ASME J.
    Lubr. Technol. 98, 509.
    """
    require_numbers("finite", s=s)
    return _exit(jnp.asarray(s)).position


def _factors(speed: Values, squeeze: Values) -> MartinFactors:
    """Products u Gw and u Gr, and Gs, from u and $\\dot h\\sqrt{2R/h_0}$, m/s: finite as u -> 0, where Gw is not."""
    speed, squeeze = jnp.asarray(speed), jnp.asarray(squeeze)
    outlet = _exit(squeeze / speed)
    t, beta, sin, i2, _ = outlet
    sin2 = sin * sin
    excess, _ = _excess_and_slope(outlet)  # T + s without cancellation at s << 0
    return MartinFactors(
        load=6.0 * (speed * sin2 - squeeze * i2),
        shear=beta,
        rolling=12.0 * (speed * (beta - i2 * (1.0 + t * excess)) - 0.5 * squeeze * sin2),
    )


def martin_factors(s: Values) -> MartinFactors:
    r"""Factors of load, shear and rolling at the squeeze number $s = (\dot h/u)\sqrt{2R/h_0}$, |s| < 1e60.

    With $\beta = \pi/2+\arctan T$ (see `martin_exit`): $G_s = \beta$, $G_w = 6(\sin^2\beta - sI_2)$,
    $G_r = 12[\beta - I_2/\sin^2\beta - s(\sin^2\beta/2 + TI_2)]$.

    **Limits:** s = 0: `MARTIN_LOAD`, `MARTIN_SHEAR`, `MARTIN_ROLLING`; s -> -inf: $G_w\to-3\pi s$, $G_s\to\pi$,
    $G_r\to4\pi$; s -> +inf: $G_w\to128/(27s^2)$, $G_s\to8/(3s)$, $G_r\to64/(9s)$: the film never pulls.
    """
    require_numbers("finite", s=s)
    return _factors(1.0, s)


def _speeds(entrainment_speed: Values, radius: Values, film: Values, squeeze_rate: Values) -> tuple[Batch, Batch]:
    r"""Entrainment speed, smoothed at rest by 1e-9 m/s, and $\dot h\sqrt{2R/h_0}$, m/s."""
    return smooth_abs(entrainment_speed, SPEED_WIDTH), squeeze_rate * jnp.sqrt(2.0 * jnp.asarray(radius) / film)


def martin_load(
    viscosity: Values, entrainment_speed: Values, radius: Values, length: Values, film: Values, squeeze_rate: Values
) -> Batch:
    r"""Normal load $W = \mu uRL/h_0\,G_w(s)$, N, >= 0.

    **Limits:** u -> 0: pure squeeze, $3\sqrt2\pi\mu L(R/h_0)^{3/2}(-\dot h)$ on approach, 0 on separation.

    **Arguments:** `viscosity`, Pa s; `entrainment_speed` u = |u1 + u2|/2 relative to the contact,
    m/s; `radius`, equivalent, m; `length`, m; `film`, minimum film h0, m, > 0; `squeeze_rate`,
    dh0/dt, m/s, negative when approaching.
    """
    require_numbers("> 0", viscosity=viscosity, radius=radius, length=length, film=film)
    require_numbers("finite", entrainment_speed=entrainment_speed, squeeze_rate=squeeze_rate)
    factors = _factors(*_speeds(entrainment_speed, radius, film, squeeze_rate))
    return viscosity * jnp.asarray(radius) * length / film * factors.load


def martin_shear(
    viscosity: Values,
    sliding_speed: Values,
    entrainment_speed: Values,
    radius: Values,
    length: Values,
    film: Values,
    squeeze_rate: Values,
) -> Batch:
    r"""Couette force $F_s = \mu(u_1-u_2)L\sqrt{2R/h_0}\,G_s(s)$, N, with the sign of u1 - u2.

    **Arguments:** `sliding_speed`, u1 - u2, m/s; others as in `martin_load`.
    """
    require_numbers("> 0", viscosity=viscosity, radius=radius, length=length, film=film)
    require_numbers(
        "finite", sliding_speed=sliding_speed, entrainment_speed=entrainment_speed, squeeze_rate=squeeze_rate
    )
    factors = _factors(*_speeds(entrainment_speed, radius, film, squeeze_rate))
    return viscosity * sliding_speed * length * jnp.sqrt(2.0 * jnp.asarray(radius) / film) * factors.shear


def martin_rolling(
    viscosity: Values, entrainment_speed: Values, radius: Values, length: Values, film: Values, squeeze_rate: Values
) -> Batch:
    r"""Pressure-flow (rolling) force $P = \mu uL\sqrt{2R/h_0}\,G_r(s)$, N: the integral of h dp/dx, 0 in pure squeeze.

    With u1 > u2 >= 0 the shear force on body 1, along its motion, is -(Fs + P/2), and on body 2 Fs - P/2; the pressure
    adds +P R/R_k along the motion on body k, of radius R_k. **Arguments:** as in `martin_load`.
    """
    require_numbers("> 0", viscosity=viscosity, radius=radius, length=length, film=film)
    require_numbers("finite", entrainment_speed=entrainment_speed, squeeze_rate=squeeze_rate)
    factors = _factors(*_speeds(entrainment_speed, radius, film, squeeze_rate))
    return viscosity * length * jnp.sqrt(2.0 * jnp.asarray(radius) / film) * factors.rolling
