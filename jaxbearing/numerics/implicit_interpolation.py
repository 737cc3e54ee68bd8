r"""Values between the ends of an implicit step.

diffrax interpolates Kvaerno's methods by Hermite's cubic, from values and rates at both ends. Its error
$h^4y''''/384$ is several hundred tolerances where an implicit method takes long steps. Here each component has one of
two polynomials,

$$y_0 + (y_1 - y_0)\theta + \theta(1 - \theta)(c_0 + c_1\theta + c_2\theta^2 + c_3\theta^3),$$

$\theta$ the place in the step:

- If $h|J_{ii}|$ is small: degree five, through values and rates at the ends of this step and at the start of the step
  before. A fast transient in the step before would make it oscillate. If its slopes are more than `WORSE` times
  as far from the rates of the stages as those of the cubic, the cubic is used.
- If $h|J_{ii}|$ is large: through the values of the stages. The rate of such a component is $J_{ii}$ times its error,
  and no slope can be taken from it.
"""

from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float

from .._types import Scalar

RATIOS = (0.2, 5.0)
"""Range of the ratio of the previous step to this one in which the previous step is used."""
WORSE = 2.0
"""Degree five is used if its slopes are at most so many times as far from the rates of the stages as the cubic's."""
STIFF = 10.0
"""Step times rate above which a component is interpolated through the values of the stages."""


class ImplicitInterpolation(dfx.AbstractLocalInterpolation):
    """Interpolation for diffrax by the polynomials of this module. **Arguments:** `bends`: c_0 to c_3."""

    t0: Any
    t1: Any
    y0: Any
    y1: Any
    bends: Any

    def __init__(self, *, t0, t1, y0, y1, k, bends):
        del k
        self.t0, self.t1, self.y0, self.y1, self.bends = t0, t1, y0, y1, bends

    def evaluate(self, t0: Any, t1: Any | None = None, left: bool = True) -> Any:
        if t1 is not None:
            return jax.tree.map(jnp.subtract, self.evaluate(t1), self.evaluate(t0))
        length = self.t1 - self.t0
        place = (t0 - self.t0) / jnp.where(length == 0, 1.0, length)
        bend = lambda c: place * (1.0 - place) * (c[0] + place * (c[1] + place * (c[2] + place * c[3])))
        return jax.tree.map(lambda a, b, c: a + place * (b - a) + bend(c), self.y0, self.y1, self.bends)


def two_step_bends(
    start: Float[Array, " n"],
    end: Float[Array, " n"],
    rates: Float[Array, "stage n"],
    length: Scalar,
    past: Float[Array, "stage n"],
    before: Scalar,
    places: np.ndarray,
    weights: Float[Array, " stage"],
) -> Float[Array, "4 n"]:
    """Coefficients c_0 to c_3 of the polynomial of degree five, or of the cubic.

    **Arguments:** `start`, `end`: values at both ends of the step; `rates`, `past`: rates at the stages of this step
    and of the previous one, the first stage at the start and the last one at the end; `length`, `before`: lengths of
    both steps, s (0: no previous step); `places`, `weights`: of the stages in the step, by the tableau.
    """
    ratio = before / length
    near = (ratio > RATIOS[0]) & (ratio < RATIOS[1])
    r = jnp.where(near, ratio, 1.0)
    first, last = length * rates[0], length * rates[-1]
    cube = first + last + 2.0 * (start - end)
    square = 3.0 * (end - start) - 2.0 * first - last
    slope = lambda place: (3.0 * cube * place + 2.0 * square) * place + first
    value = lambda place: ((cube * place + square) * place + first) * place + start
    # the cubic and theta^2 (1 - theta)^2 (bend + tilt theta)
    weight = jnp.square(r * (1.0 + r))
    weight_slope = -2.0 * r * (1.0 + r) * (1.0 + 2.0 * r)
    at_start = (start - before * (weights @ past) - value(-r)) / weight
    tilt = (length * past[0] - slope(-r) - weight_slope * at_start) / weight
    bend = at_start + r * tilt
    cubic_off, off = jnp.zeros_like(start), jnp.zeros_like(start)
    for stage in inner_stages(places):
        place = float(places[stage])
        apart = length * rates[stage] - slope(place)
        added = 2.0 * place * (place - 1.0) * (2.0 * place - 1.0) * (bend + tilt * place)
        added = added + (place * (place - 1.0)) ** 2 * tilt
        cubic_off, off = cubic_off + jnp.square(apart), off + jnp.square(apart - added)
    used = near & (off <= WORSE**2 * cubic_off)
    bend, tilt = jnp.where(used, bend, 0.0), jnp.where(used, tilt, 0.0)
    return jnp.stack([-(cube + square), bend - cube, tilt - bend, -tilt])


def stage_bends(
    start: Float[Array, " n"], end: Float[Array, " n"], values: Float[Array, "stage n"], places: np.ndarray
) -> Float[Array, "4 n"]:
    """Coefficients c_0 to c_3 of the polynomial through the stage values. **Arguments:** `places`: of the stages."""
    inner = inner_stages(places)
    at = places[inner]
    solve = np.linalg.inv(np.vander(at, increasing=True)) / (at * (1.0 - at))
    chord = start[None] + jnp.asarray(at)[:, None] * (end - start)[None]
    bends = jnp.asarray(solve) @ (values[jnp.asarray(inner)] - chord)
    return jnp.concatenate([bends, jnp.zeros((4 - len(inner), start.size))])


def inner_stages(places: np.ndarray) -> list[int]:
    """Stages between the ends of the step."""
    return [stage for stage in range(len(places)) if 0.0 < places[stage] < 1.0]


def chosen_bends(smooth: Float[Array, "4 n"], stiff: Float[Array, "4 n"], rates: Float[Array, " n"]) -> Array:
    """Coefficients c_0 to c_3: `stiff` for each component whose rate is above `STIFF`, else `smooth`.

    **Arguments:** `rates`: the step times the diagonal of the Jacobian.
    """
    is_stiff: Bool[Array, " n"] = jnp.abs(rates) > STIFF
    return jnp.where(is_stiff[None], stiff, smooth)
