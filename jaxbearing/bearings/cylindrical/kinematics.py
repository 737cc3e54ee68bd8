"""Kinematics of rollers between two rings."""

from typing import TYPE_CHECKING

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

if TYPE_CHECKING:
    from ..operation import Operation
    from .geometry import RollerGeometry


class RollerKinematics(eqx.Module):
    r"""Speeds of rollers of radius $R_R$ on raceways $R_i = R_m - R_R$, $R_o = R_m + R_R$.

    Rolling without slip: $W = (\omega_i R_i + \omega_o R_o)/(2R_m)$, $R_R s = (\omega_i - W) R_i$, where the spin s is
    relative to the orbiting frame and positive when clockwise (its value in normal running).

    The axes of tapered rollers are inclined by $\gamma$ to that of the bearing. All radii are then those of mid length:
    $R_R = \rho\sin\epsilon$, $R_m = \rho\cos\epsilon\sin\gamma$ and $R_k = \rho\sin\alpha_k = R_m \mp R_R\cos\gamma$
    (see `tapered.friction`). All speeds of a contact are proportional to the distance from the apex.

    **Arguments:** speeds of the rings, rad/s; radii, m; `axis_cosine`, `half_cosine`: cosines of the inclination gamma
    and of the half angle epsilon of tapered rollers, `None` for cylindrical ones.
    """

    inner_speed: Float[Array, ""]
    outer_speed: Float[Array, ""]
    pitch_radius: Float[Array, ""]
    roller_radius: Float[Array, ""]
    axis_cosine: Float[Array, ""] | None = None
    half_cosine: Float[Array, ""] | None = None

    def across(self, values: Array) -> Array:
        """Components across the bearing axis of vectors across the roller axis, and components along the bearing axis
        of vectors along the roller axis."""
        return values if self.axis_cosine is None else values * self.axis_cosine

    @property
    def inner_radius(self) -> Array:
        return self.pitch_radius - self.across(self.roller_radius)

    @property
    def outer_radius(self) -> Array:
        return self.pitch_radius + self.across(self.roller_radius)

    @property
    def free_orbit(self) -> Array:
        """Orbital speed W of rolling without slip, rad/s."""
        return (self.inner_speed * self.inner_radius + self.outer_speed * self.outer_radius) / (2.0 * self.pitch_radius)

    @property
    def orbit_scale(self) -> Array:
        """Orbital speed relative to the outer ring in rolling without slip, rad/s."""
        return (self.inner_speed - self.outer_speed) * self.inner_radius / (2.0 * self.pitch_radius)

    @property
    def free_spin(self) -> Array:
        """Spin s of rolling without slip, rad/s."""
        return self.orbit_scale * self.outer_radius / self.roller_radius

    @property
    def orbit_unit(self) -> Array:
        """Scale of orbital speeds, rad/s. It is not 0 while a ring turns, even if W or `orbit_scale` is 0."""
        return jnp.sqrt(0.5 * (jnp.square(self.orbit_scale) + jnp.square(self.free_orbit)))

    @property
    def spin_unit(self) -> Array:
        """Scale of spins, rad/s."""
        return self.orbit_unit * self.outer_radius / self.roller_radius

    def surface_speeds(
        self, orbit_change: Array, spin_change: Array
    ) -> tuple[Float[Array, "2 ..."], Float[Array, "2 ..."]]:
        """Mean speeds and sliding speeds (inner race, outer race), m/s, in the frame of the orbiting contact.

        Sliding is race minus roller on the inner race and roller minus race on the outer race. A positive value
        therefore drives the roller forward at the inner race and brakes it at the outer race.

        **Arguments:** `orbit_change`, `spin_change`: differences of orbital speed and spin from rolling without slip,
        rad/s. The sliding speeds are sums of these small numbers and therefore exact to round-off. Differences of
        surface speeds of 100 m/s would have too large a round-off for a steep traction law.
        """
        free = self.orbit_scale * self.outer_radius
        roller = self.roller_radius * spin_change
        inner = -orbit_change * self.inner_radius
        outer = orbit_change * self.outer_radius
        mean = free + 0.5 * jnp.stack([inner + roller, outer + roller])
        return mean, jnp.stack([inner - roller, outer - roller])


def cage_slip(orbit: Array, motion: RollerKinematics) -> Array:
    """Cage slip 1 - W/W_free, with the cage speed W_free of rolling without slip.

    Near W_free = 0 it stays finite, but has no meaning. For this the quotient is smoothed with 1e-8 of the speed scale,
    which is a relative error of 1e-16 if one ring is at rest.
    """
    free = motion.free_orbit
    return (free - orbit) * free / (jnp.square(free) + jnp.square(1e-8 * motion.orbit_unit))


def roller_kinematics(geometry: "RollerGeometry", operation: "Operation") -> RollerKinematics:
    """Kinematics of the rollers of a scene. **Arguments:** `geometry`, `operation`: of the scene."""
    sizes = (operation.inner_speed, operation.outer_speed, geometry.pitch_radius, geometry.roller_radius)
    return RollerKinematics(*(jnp.asarray(value) for value in sizes))
