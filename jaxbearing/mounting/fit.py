r"""One interference fit: the pressure between two bodies, and the speed at which they separate.

$$c = u_\mathrm{outer}(p = 1) - u_\mathrm{inner}(p = 1),\quad
I_\mathrm{op} = I - s + 2(u_\omega + u_T)_\mathrm{inner} - 2(u_\omega + u_T)_\mathrm{outer},\quad
p = \max(I_\mathrm{op}, 0)/(2c)$$

I is the diametral interference, s its loss by smoothing, c the radial compliance of the joint, u the radial growth by
pressure p, rotation $\omega$ and temperature T (`annulus`).

At the limit between tight and loose the pressure is continuous, and its slope jumps; the derivative there is that of
the tight fit. The jump is not smoothed: a width of 1 um would change the clearance of a loose ring by half of it.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .annulus import Annulus, Numbers


class FitState(NamedTuple):
    """State of a fit.

    - `pressure`: Pa; 0 if the fit is loose.
    - `interference`: effective diametral interference, m; negative: a gap.
    - `spin_loss`: loss of interference by rotation, divided by the square of the speed, m s^2.
    - `loose_speed`: speed at which the bodies separate at these temperatures, rad/s; 0 if they are loose at rest,
      infinite if they separate at no speed.
    """

    pressure: Float[Array, "..."]
    interference: Float[Array, "..."]
    spin_loss: Float[Array, "..."]
    loose_speed: Float[Array, "..."]


class Fit(eqx.Module):
    """Two bodies that are fitted together and turn together; or many pairs, as arrays of numbers.

    **Arguments:**
    - `inner`, `outer`: the bodies; `inner.outside` and `outer.bore` are the diameter of the fit.
    - `interference`: diametral, as machined, m; negative: a gap.
    - `smoothing`: loss of interference by flattened asperities, m.
    """

    inner: Annulus
    outer: Annulus
    interference: Numbers
    smoothing: Numbers = 0.0

    def state(self) -> FitState:
        diameter = self.inner.outside
        stiffness = self.outer.pressed(diameter, 1.0, 0.0) - self.inner.pressed(diameter, 0.0, 1.0)
        still = self.interference - self.smoothing + self.inner.warmed(diameter) - self.outer.warmed(diameter)
        by_square = [body.spun_by_square(diameter) for body in (self.inner, self.outer)]
        loss = by_square[1] - by_square[0]
        spun = [
            growth * jnp.square(body.speed) for growth, body in zip(by_square, (self.inner, self.outer), strict=True)
        ]
        interference = still + spun[0] - spun[1]
        pressure = jnp.where(interference >= 0.0, interference, 0.0) / stiffness
        parts = (still > 0.0) & (loss > 0.0)
        speed = jnp.sqrt(jnp.where(parts, still, 1.0) / jnp.where(parts, loss, 1.0))
        speed = jnp.where(parts, speed, jnp.where(still > 0.0, jnp.inf, 0.0))
        return FitState(pressure, interference, loss, speed)
