"""Shear stress of a Maxwell fluid along the strips of a contact, marched from inlet to exit."""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from .._types import Values
from .viscous import AbstractViscousFunction

TRIAL_FLOOR = 1e-12
"""Smoothing of the modulus of the trial stress, in units of the characteristic stress; no force changes by it."""


class Sliding(NamedTuple):
    """Sliding of body 1 relative to body 2; a component that is `None` is zero and is not computed.

    - `rolling`: along rolling, in the middle of the contact, m/s.
    - `transverse`: across rolling, m/s.
    - `spin`: about the normal, right-handed, rad/s.
    - `curvature`: k, 1/(m s), of a curved contact (Heathcote slip): at a distance y from the middle the sliding along
      rolling is smaller by k y^2.
    """

    rolling: Values
    transverse: Values | None = None
    spin: Values | None = None
    curvature: Values | None = None

    @property
    def plane(self) -> bool:
        """True if all sliding is along rolling."""
        return self.transverse is None and self.spin is None

    @property
    def alike(self) -> bool:
        """True if the sliding does not vary across the contact."""
        return self.spin is None and self.curvature is None


class Oil(NamedTuple):
    """Logarithms of shear modulus, viscosity and characteristic stress (in Pa, Pa s, Pa)."""

    log_modulus: Float[Array, "..."]
    log_viscosity: Float[Array, "..."]
    log_stress: Float[Array, "..."]


class Mesh(NamedTuple):
    """Midpoints of equal steps in theta, x = -a cos(theta) from inlet to exit, of one march or of two in a row.

    With one entry per step, in the order of the march: `step`, its width; `weight`, its weight in integrals over theta;
    `sine` = sin(theta) = p/p_s; `position` = x/a; `going`, 0 at the first step of a march, else 1; `place`, the index
    of its sine in `sines`. The `sines` are the different values of `sine`: quantities that depend on the pressure only
    are computed once for inlet and exit side.
    """

    step: np.ndarray
    weight: np.ndarray
    sine: np.ndarray
    position: np.ndarray
    going: np.ndarray
    place: np.ndarray
    sines: np.ndarray

    @classmethod
    def of(cls, steps: int) -> "Mesh":
        theta = (np.arange(steps) + 0.5) * np.pi / steps
        place = np.minimum(np.arange(steps), np.arange(steps)[::-1])
        sine = np.sin(theta[place])  # bitwise equal on both sides
        width = np.full(steps, np.pi / steps)
        going = (np.arange(steps) > 0).astype(float)
        return cls(width, width, sine, -np.cos(theta), going, place, sine[: (steps + 1) // 2])

    @classmethod
    def extrapolated(cls, steps: int) -> "Mesh":
        """A march and its repetition with half the steps, weighted to cancel the integrals' second-order error."""
        fine, coarse = cls.of(steps), cls.of(steps // 2)
        coarse = coarse._replace(weight=-coarse.weight / 3.0, place=coarse.place + fine.sines.size)
        fine = fine._replace(weight=fine.weight * 4.0 / 3.0)
        return cls(*(np.concatenate(pair) for pair in zip(fine, coarse, strict=True)))


class Maxwell(NamedTuple):
    """Shear modulus, Pa, `frequency` = modulus over viscosity, 1/s, and characteristic stress, Pa."""

    modulus: Float[Array, "..."]
    frequency: Float[Array, "..."]
    stress: Float[Array, "..."]

    @classmethod
    def of(cls, oil: Oil) -> "Maxwell":
        frequency = jnp.exp(oil.log_modulus - oil.log_viscosity)
        return cls(jnp.exp(oil.log_modulus), frequency, jnp.exp(oil.log_stress))


def relaxed_stress(
    viscous: AbstractViscousFunction,
    oil: Maxwell,
    half_step: Float[Array, "..."],
    stress: Float[Array, "component ..."],
    rate: Float[Array, "component ..."],
) -> Float[Array, "component ..."]:
    r"""Stress at the midpoint of a step of $dt/d\theta = K[\gamma - (\tau_r/\mu)F(|t|/\tau_r)\,t/|t|]$.

    The implicit half step, $t + \kappa\tau_rF(|t|/\tau_r)\,t/|t| = r$ with $r = \tau + k\gamma$ and $\kappa = k/\mu$,
    is isotropic: t is parallel to r, and its modulus is the root of a scalar equation. Value and derivative are finite
    from k = 0 (t = r) to $\kappa\to\infty$ (the viscous law), and at r = 0.

    **Arguments:**
    - `viscous`: F.
    - `oil`: at the pressure and temperature of the midpoint.
    - `half_step`: $k/G$, half of the time step, s.
    - `stress`: $\tau$ at the beginning of the step, Pa; the first axis holds one or two components.
    - `rate`: shear rate $\gamma$ during the step, 1/s, of the same shape.
    """
    trial = stress + (half_step * oil.modulus)[None] * rate
    unit = trial / oil.stress[None]
    size = jnp.sqrt(jnp.sum(jnp.square(unit), axis=0) + TRIAL_FLOOR**2)
    return trial * (viscous.relaxed_stress_ratio(size, half_step * oil.frequency) / size)[None]


def viscous_stress(
    viscous: AbstractViscousFunction, oil: Oil, rate: Float[Array, "component ..."]
) -> Float[Array, "component ..."]:
    """Stress of steady flow, the limit without elasticity, Pa. **Arguments:** as in `relaxed_stress`."""
    if rate.shape[0] == 1:
        scale = oil.log_viscosity - oil.log_stress
        return (jnp.exp(oil.log_stress) * viscous.stress_ratio_of_scaled(scale, rate[0]))[None]
    size = jnp.sqrt(jnp.sum(jnp.square(rate), axis=0) + jnp.finfo(float).tiny)
    ratio = viscous.stress_ratio_of_scaled(oil.log_viscosity - oil.log_stress, size)
    return rate * (jnp.exp(oil.log_stress) * ratio / size)[None]
