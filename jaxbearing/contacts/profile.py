"""Profiles of rollers: how much is ground off towards the ends to avoid pressure peaks there."""

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
    """Radial drop of a roller's surface along its length; a straight roller has no profile."""

    part: ClassVar[str] = "profile"

    @abc.abstractmethod
    def drop_at(self, position: Values) -> Float[Array, "..."]:
        """Depth below the straight generator, m, >= 0.

        **Arguments:** `position`: -1 and 1 at the ends of the roller, 0 in the middle.
        """


class CrownedProfile(AbstractProfile):
    r"""Parabola, $h = h_e[(|x| - x_0)_+/(1 - x_0)]^2$: crowned over the whole length, or beyond a straight middle.

    **Arguments:**
    - `drop`: h_e, radial drop at the ends, m, >= 0.
    - `straight_fraction`: x0, fraction of the length that is straight, >= 0 and below 1.
    """

    drop: Scalar = bounded(">= 0", unit="m", converter=as_float)
    straight_fraction: Scalar = bounded(">= 0 and below 1", unit="1", converter=as_float, default=0.0)

    def drop_at(self, position: Values) -> Float[Array, "..."]:
        beyond = jnp.maximum(jnp.abs(position) - self.straight_fraction, 0.0)
        return self.drop * jnp.square(beyond / (1.0 - self.straight_fraction))


class LogarithmicProfile(AbstractProfile):
    r"""Logarithmic profile with a finite drop at the ends, $h = h_e\frac{\ln[1 - (1 - r)x^2]}{\ln r}$.

    **Limits:** with $h_e = A\ln(1/r)$ and r -> 0 it is Lundberg's $A\ln[1/(1 - x^2)]$, which is infinite at the ends
    and gives a uniform pressure at the one load that A is made for; r -> 1: the parabola $h_ex^2$.
    **Reference:** Lundberg (1939), made finite in the manner of Johns and Gohar (1981); the standard profile of
    ISO 16281, $0.00035D\ln[1/(1 - x^2)]$, has r = 0 and A = 0.00035 D (from memory).

    **Arguments:**
    - `drop`: h_e, radial drop at the ends, m, >= 0.
    - `end_ratio`: r, above 0 and below 1: the smaller it is, the more the drop is confined to the ends.
    """

    drop: Scalar = bounded(">= 0", unit="m", converter=as_float)
    end_ratio: Scalar = bounded("above 0 and below 1", unit="1", converter=as_float, default=0.01)

    def drop_at(self, position: Values) -> Float[Array, "..."]:
        return self.drop * jnp.log1p(-(1.0 - self.end_ratio) * jnp.square(position)) / jnp.log(self.end_ratio)


def lundberg_drop(amplitude: float, end_ratio: float) -> float:
    """Drop h_e, m, with which a `LogarithmicProfile` follows Lundberg's A ln[1/(1 - x^2)] away from the ends."""
    require_numbers(">= 0", amplitude=amplitude)
    require_numbers("above 0 and below 1", end_ratio=end_ratio)
    return amplitude * math.log(1.0 / end_ratio)
