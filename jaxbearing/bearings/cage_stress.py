r"""Estimate of the stresses in a one-piece cage due to its rotation and the impacts of its rolling elements.

The cage is a thin ring of mean radius R, whose rails bend in the plane of the ring, with bars between the pockets.

- Rotation: $\sigma = \rho\omega^2R^2$.
- Rails. A radial force $F_r$ (outward) and a tangential one $F_t$ (in the sense of orbit) at angle 0 bend the ring by
  $M(\varphi) = \frac{F_rR}{\pi}\sum_{n\ge2}\frac{\cos n\varphi}{n^2-1} + \frac{F_tR}{\pi}\sum_{n\ge2}
  \frac{\sin n\varphi}{n(n^2-1)}$. The harmonics 0 and 1 move the ring as a whole, and its inertia carries them. With
  $s = (\pi - \varphi)/2$ on $0\le\varphi<2\pi$ the sums are $\frac12 + \frac14\cos\varphi - s\sin\varphi$ and
  $\frac34\sin\varphi - s(1-\cos\varphi)$. Two opposite radial forces give $FR/\pi$ under each and
  $-(\frac12 - \frac1\pi)FR$ half way between.
- Bars. A bar of length l is clamped in the rails, and the force on it acts in its middle: $M = Fl/8$.

Left out: warping and twist of the rails, notches, the shape of a bar between round pockets (its least width is assumed
along its whole length), loads along the axis, and fatigue.
"""

from typing import TYPE_CHECKING

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Scalar, Values
from .parts import AbstractGeometry
from .solution import label

if TYPE_CHECKING:
    from .cage import AbstractCage


class CageSection(eqx.Module):
    """Properties of a cage from which its stresses follow for a given speed and given loads."""

    mean_radius: Float[Array, ""] = eqx.field(metadata=label("m", "mean radius of the cage"))
    density: Float[Array, ""] = eqx.field(metadata=label("kg/m^3", "density of the cage"))
    rail_modulus: Float[Array, ""] = eqx.field(
        metadata=label("m^3", "section modulus of all cage rails together, bent in the plane of the bearing")
    )
    bar_length: Float[Array, ""] = eqx.field(metadata=label("m", "length of a cage bar between the rails"))
    bar_modulus: Float[Array, ""] = eqx.field(
        metadata=label("m^3", "section modulus of a cage bar, bent along the orbit")
    )

    def hoop(self, speed: Values) -> Array:
        """Hoop stress due to rotation, Pa, at a cage speed, rad/s."""
        return self.density * jnp.square(self.mean_radius * jnp.asarray(speed))

    def bar(self, force: Values) -> Array:
        """Bending stress of a bar, Pa, >= 0, under a force along the orbit, N."""
        return jnp.abs(jnp.asarray(force)) * self.bar_length / (8.0 * self.bar_modulus)

    def rails(
        self, place: Float[Array, " place"], azimuth: Float[Array, " force"], tangential: Float[Array, "*time force"]
    ) -> Float[Array, "*time place"]:
        """Bending stress of the rails at given places of the cage, Pa; positive if the outer side is in tension.

        **Arguments:** `place`, `azimuth`: angles of the places and of the forces in the frame of the cage, rad;
        `tangential`: tangential forces on the cage, N, positive in the sense of the orbit.
        """
        arm = tangential_bending(jnp.mod(place[:, None] - azimuth[None, :], 2.0 * jnp.pi))
        moment = self.mean_radius / jnp.pi * jnp.einsum("...f,pf->...p", tangential, arm)
        return moment / self.rail_modulus


def radial_bending(angle: Array) -> Array:
    """Bending moment of a free ring under a radial force F, over $FR/\\pi$.

    **Arguments:** `angle`: angle from the force, rad, from 0 to 2 pi.
    """
    half = 0.5 * (jnp.pi - angle)
    return 0.5 + 0.25 * jnp.cos(angle) - half * jnp.sin(angle)


def tangential_bending(angle: Array) -> Array:
    """Bending moment of a free ring under a tangential force F, over $FR/\\pi$.

    **Arguments:** `angle`: angle from the force, rad, from 0 to 2 pi.
    """
    half = 0.5 * (jnp.pi - angle)
    return 0.75 * jnp.sin(angle) - half * (1.0 - jnp.cos(angle))


def cage_section(cage: "AbstractCage", geometry: AbstractGeometry, density: Scalar) -> CageSection:
    """Computes the section of a cage. The rails are as wide as the lands and as high as the cage is thick; the width of
    a bar is the distance between neighbouring pockets at the mean radius.

    **Arguments:** `geometry`: geometry of the bearing; `density`: density of the cage, kg/m^3.
    """
    bore, outside = (0.5 * jnp.asarray(size, dtype=float) for size in (cage.bore(geometry), cage.outside(geometry)))
    radius, height = 0.5 * (bore + outside), outside - bore
    across, along = cage.pocket_opening(geometry)
    width = 2.0 * jnp.pi * radius / geometry.n_elements - along
    # pockets that overlap leave no bar: the width and the section modulus are 0
    width = jnp.maximum(width, 0.0)
    rails = cage.lands * jnp.asarray(cage.land_width)
    return CageSection(
        mean_radius=radius,
        density=jnp.asarray(density, dtype=float),
        rail_modulus=rails * jnp.square(height) / 6.0,
        bar_length=jnp.asarray(across, dtype=float),
        bar_modulus=jnp.square(width) * height / 6.0,
    )
