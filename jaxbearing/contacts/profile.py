"""Profiles of rollers: how much is ground off towards the ends, so that the load does not peak there."""

import abc
import math
from typing import ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from ..numerics.arguments import require_numbers
from ..numerics.checks import Checked, bounded
from ..numerics.precision import as_float


class AbstractProfile(Checked):
    """Radial drop of a roller over its length; a straight roller has no profile."""

    part: ClassVar[str] = "profile"

    @abc.abstractmethod
    def drop_at(self, position: Values) -> Float[Array, "..."]:
        """Depth below the straight generator, m, >= 0. **Arguments:** `position`: -1 and 1 at the ends, 0 in the
        middle."""


class CrownedProfile(AbstractProfile):
    r"""Parabola, $h = h_e[(|x| - x_0)_+/(1 - x_0)]^2$: crowned over the whole length, or beyond a straight middle.

    **Arguments:**
    - `drop`: h_e, what is ground off at the ends, m, >= 0.
    - `straight_fraction`: x0, part of the length that is straight, >= 0 and below 1.
    """

    drop: Scalar = bounded(">= 0", unit="m", converter=as_float)
    straight_fraction: Scalar = bounded(">= 0 and below 1", unit="1", converter=as_float, default=0.0)

    def drop_at(self, position: Values) -> Float[Array, "..."]:
        beyond = jnp.maximum(jnp.abs(position) - self.straight_fraction, 0.0)
        return self.drop * jnp.square(beyond / (1.0 - self.straight_fraction))


class LogarithmicProfile(AbstractProfile):
    r"""Logarithm that ends in a finite drop, $h = h_e\frac{\ln[1 - (1 - r)x^2]}{\ln r}$.

    **Limits:** with $h_e = A\ln(1/r)$ and r to 0 it is Lundberg's $A\ln[1/(1 - x^2)]$, which has an even pressure
    under the load that fits A and is infinite at the ends; r to 1: the parabola $h_ex^2$.
    **Reference:** Lundberg (1939), in the spirit of Johns and Gohar (1981), who made it finite; the standard profile of
    ISO 16281, $0.00035D\ln[1/(1 - x^2)]$, has r = 0 and A = 0.00035 D ([M]).

    **Arguments:**
    - `drop`: h_e, what is ground off at the ends, m, >= 0.
    - `end_ratio`: r, above 0 and below 1: the smaller, the nearer to the ends the roller falls off.
    """

    drop: Scalar = bounded(">= 0", unit="m", converter=as_float)
    end_ratio: Scalar = bounded("above 0 and below 1", unit="1", converter=as_float, default=0.01)

    def drop_at(self, position: Values) -> Float[Array, "..."]:
        return self.drop * jnp.log1p(-(1.0 - self.end_ratio) * jnp.square(position)) / jnp.log(self.end_ratio)


def lundberg_drop(amplitude: float, end_ratio: float) -> float:
    """Drop at the ends of the `LogarithmicProfile` that follows A ln[1/(1 - x^2)] away from them, m."""
    require_numbers(">= 0", amplitude=amplitude)
    require_numbers("above 0 and below 1", end_ratio=end_ratio)
    return amplitude * math.log(1.0 / end_ratio)
