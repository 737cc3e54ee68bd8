r"""Values between the ends of an implicit step, from that step and the one before.

diffrax interpolates Kvaerno's methods by Hermite's cubic. Its error $h^4y''''/384$ is several hundred tolerances where
an implicit method takes long steps. With the value and the rate at the start of the step before, the polynomial is of
degree five:

$$p(\theta) = c(\theta) + \theta^2(\theta - 1)^2(a + b\theta),\qquad p(-r) = y_{-1},\quad p'(-r) = hf_{-1},$$

$\theta$ the place in the step, $r$ the ratio of the two steps and $c$ the cubic. A fast transient in the step before
would make it oscillate. So each component has the cubic, $a = b = 0$, where the slopes of p are further than those of c
from the rates of the stages.
"""

from typing import Any

import diffrax as dfx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Scalar

RATIOS = (0.2, 5.0)
"""Ratios of the step before to this one with which the step before is used."""
WORSE = 2.0
"""Largest ratio of the distances of both slopes from the rates of the stages with which degree five is used."""


class TwoStepInterpolation(dfx.AbstractLocalInterpolation):
    """Interpolation of diffrax. **Arguments:** as Hermite's cubic has them, and `bend`, a, and `tilt`, b."""

    t0: Any
    t1: Any
    cubic: Any
    bend: Any
    tilt: Any

    def __init__(self, *, t0, t1, y0, y1, k, bend, tilt):
        self.t0, self.t1, self.bend, self.tilt = t0, t1, bend, tilt
        self.cubic = dfx.ThirdOrderHermitePolynomialInterpolation.from_k(t0=t0, t1=t1, y0=y0, y1=y1, k=k)

    def evaluate(self, t0: Any, t1: Any | None = None, left: bool = True) -> Any:
        if t1 is not None:
            return jax.tree.map(jnp.subtract, self.evaluate(t1, left=left), self.evaluate(t0, left=left))
        length = self.t1 - self.t0
        place = (t0 - self.t0) / jnp.where(length == 0, 1.0, length)
        weight = jnp.square(place * (place - 1.0))
        own = self.cubic.evaluate(t0, left=left)
        return jax.tree.map(lambda y, a, b: y + weight * (a + b * place), own, self.bend, self.tilt)


def bend_and_tilt(
    start: Float[Array, " n"],
    end: Float[Array, " n"],
    rates: Float[Array, "stage n"],
    length: Scalar,
    past: Float[Array, "stage n"],
    before: Scalar,
    places: np.ndarray,
    weights: Float[Array, " stage"],
) -> tuple[Float[Array, " n"], Float[Array, " n"]]:
    """a and b.

    **Arguments:** `start`, `end`: of the step; `rates`, `past`: of the stages of this step and of the one before, the
    first one at the start and the last one at the end; `length`, `before`: of both steps, s (0: there is none);
    `places`, `weights`: of the stages, those of the tableau.
    """
    ratio = before / length
    near = (ratio > RATIOS[0]) & (ratio < RATIOS[1])
    r = jnp.where(near, ratio, 1.0)
    first, last = length * rates[0], length * rates[-1]
    cube = first + last + 2.0 * (start - end)
    square = 3.0 * (end - start) - 2.0 * first - last
    slope = lambda place: (3.0 * cube * place + 2.0 * square) * place + first
    value = lambda place: ((cube * place + square) * place + first) * place + start
    weight = jnp.square(r * (1.0 + r))
    weight_slope = -2.0 * r * (1.0 + r) * (1.0 + 2.0 * r)
    at_start = (start - before * (weights @ past) - value(-r)) / weight
    tilt = (length * past[0] - slope(-r) - weight_slope * at_start) / weight
    bend = at_start + r * tilt
    cubic_off, off = jnp.zeros_like(start), jnp.zeros_like(start)
    for stage in range(len(places)):
        place = float(places[stage])
        if 0.0 < place < 1.0:
            apart = length * rates[stage] - slope(place)
            added = 2.0 * place * (place - 1.0) * (2.0 * place - 1.0) * (bend + tilt * place)
            added = added + (place * (place - 1.0)) ** 2 * tilt
            cubic_off, off = cubic_off + jnp.square(apart), off + jnp.square(apart - added)
    used = near & (off <= WORSE**2 * cubic_off)
    return jnp.where(used, bend, 0.0), jnp.where(used, tilt, 0.0)
