r"""The shaft as a beam (Timoshenko), exact and without a mesh.

At a position s the shaft has the compliance per length $c(s)$ = diag(1/EA, 1/$\kappa$GA, 1/$\kappa$GA, 1/EI, 1/EI). A
load $F_j$ at $x_j$ gives the load $T(x_j - s)^T F_j$ at s, and a deformation at s displaces the position $x_i$ by
$T(x_i - s)$ times the deformation, with the shift T of `bearings.ring`. A shaft that is clamped at x = 0 is therefore
displaced by

$$u(x_i) = \int_0^{\min(x_i, x_j)} T(x_i - s)\,c(s)\,T(x_j - s)^T\,ds\,F_j.$$

The integrand is a polynomial of the second degree in each section; for the shaft's weight it is of the third degree.
Two Gauss points integrate both exactly. A free shaft has in addition the displacement $T(x)u_0$.

The result equals that of Timoshenko's finite element with Cowper's shear factor, which is exact for loads at nodes and
for uniform loads. Here several nodes at the same position, and positions that change their order, need no special
treatment.
"""

from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from ..bearings.ring import shift_matrix
from ..materials import Material
from .shaft import Gravity, Shaft

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(2)


def shear_factor(poisson_ratio: Array, ratio: Array) -> Float[Array, "..."]:
    r"""Shear factor of a round section (Cowper 1966).

    $\kappa = 6(1+\nu)(1+m^2)^2/[(7+6\nu)(1+m^2)^2 + (20+12\nu)m^2]$.

    **Arguments:** `poisson_ratio`: $\nu$; `ratio`: m, inner over outer diameter.
    """
    hollow = jnp.square(1.0 + jnp.square(ratio))
    more = (20.0 + 12.0 * poisson_ratio) * jnp.square(ratio)
    return 6.0 * (1.0 + poisson_ratio) * hollow / ((7.0 + 6.0 * poisson_ratio) * hollow + more)


class Beam(NamedTuple):
    """Sections of a shaft from x = 0: start and end, m, compliances per length, and weight per length, N/m."""

    start: Float[Array, " section"]
    end: Float[Array, " section"]
    axial: Float[Array, " section"]
    """Axial compliance per length 1/EA, 1/N."""
    shear: Float[Array, " section"]
    """Shear compliance per length 1/(kappa G A), 1/N."""
    bending: Float[Array, " section"]
    """Bending compliance per length 1/EI, 1/(N m^2)."""
    weight: Float[Array, "2 section"]
    """Weight per length along Y and Z, N/m."""

    def points(self, far: Float[Array, "..."]) -> tuple[Float[Array, "... section 2"], Float[Array, "... section 2"]]:
        """Integration points of each section between 0 and `far`, m, and their weights, m."""
        wide = lambda values: values.reshape((1,) * far.ndim + values.shape)
        start = wide(self.start)
        half = 0.5 * (jnp.clip(far[..., None], start, wide(self.end)) - start)[..., None]
        return start[..., None] + half * wide(1.0 + _POINTS)[..., None, :], half * wide(_WEIGHTS)[..., None, :]

    def compliance(self, at: Float[Array, " i"], loaded: Float[Array, " j"]) -> Float[Array, "i j 5 5"]:
        """Displacements at `at` per load at `loaded`, for a shaft that is clamped at x = 0."""
        near, far = at[:, None], loaded[None, :]
        place, weight = self.points(jnp.minimum(near, far))
        near, far = near[..., None, None] - place, far[..., None, None] - place
        total = lambda law, lever: jnp.sum(law[None, None, :, None] * weight * lever, axis=(-2, -1))
        across = total(self.bending, near * far) + total(self.shear, 1.0)
        of_moment, of_force, turn = (total(self.bending, lever) for lever in (-near, -far, 1.0))
        axial, zero = total(self.axial, 1.0), jnp.zeros_like(across)
        rows = [
            [axial, zero, zero, zero, zero],
            [zero, across, zero, of_moment, zero],
            [zero, zero, across, zero, of_moment],
            [zero, of_force, zero, turn, zero],
            [zero, zero, of_force, zero, turn],
        ]
        return jnp.stack([jnp.stack(row, axis=-1) for row in rows], axis=-2)

    def weight_at(self, place: Float[Array, "..."]) -> Float[Array, "... 5"]:
        """Load on a cut at `place` by the weight of the shaft beyond it, N and N m."""
        wide = lambda values: values.reshape((1,) * place.ndim + values.shape)
        end = wide(self.end)
        cut = jnp.clip(place[..., None], wide(self.start), end)
        reach, arm = end - cut, 0.5 * (end + cut) - place[..., None]
        forces = [jnp.sum(wide(weight) * reach, axis=-1) for weight in self.weight]
        moments = [-jnp.sum(wide(weight) * reach * arm, axis=-1) for weight in self.weight]
        return jnp.stack([jnp.zeros_like(forces[0]), *forces, *moments], axis=-1)

    def sagging(self, at: Float[Array, " i"]) -> Float[Array, "i 5"]:
        """Displacements under its own weight, for a shaft that is clamped at x = 0."""
        place, weight = self.points(at)
        load, lever = self.weight_at(place), at[:, None, None] - place
        total = lambda values: jnp.sum(weight * values, axis=(-2, -1))
        bend, shear = self.bending[None, :, None], self.shear[None, :, None]
        across = [total(shear * load[..., freedom] - lever * bend * load[..., freedom + 2]) for freedom in (1, 2)]
        turns = [total(bend * load[..., freedom]) for freedom in (3, 4)]
        return jnp.stack([jnp.zeros_like(at), *across, *turns], axis=-1)


def beam_of(shaft: Shaft) -> Beam | None:
    """The sections of a shaft as a beam; `None` for a rigid shaft."""
    if not shaft.sections:
        return None
    of = lambda get: jnp.stack([jnp.asarray(get(section), dtype=float) for section in shaft.sections])
    material = lambda section: shaft.material if section.material is None else section.material
    outer, inner = of(lambda s: s.outer_diameter), of(lambda s: s.inner_diameter)
    modulus, poisson = of(lambda s: material(s).youngs_modulus), of(lambda s: material(s).poisson_ratio)
    area, inertia = jnp.pi / 4.0 * (outer**2 - inner**2), jnp.pi / 64.0 * (outer**4 - inner**4)
    shear_modulus = 0.5 * modulus / (1.0 + poisson)
    end = jnp.cumsum(of(lambda s: s.length))
    return Beam(
        start=jnp.concatenate([jnp.zeros(1), end[:-1]]),
        end=end,
        axial=1.0 / (modulus * area),
        shear=1.0 / (shear_factor(poisson, inner / outer) * shear_modulus * area),
        bending=1.0 / (modulus * inertia),
        weight=gravity_along(shaft.gravity)[:, None] * (of(lambda s: material(s).density) * area)[None],
    )


def gravity_along(gravity: Gravity | None) -> Float[Array, "2"]:
    """Acceleration of gravity along Y and Z, m/s^2."""
    if gravity is None:
        return jnp.zeros(2)
    azimuth = jnp.asarray(gravity.azimuth)
    return gravity.acceleration * jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])


def shifts(positions: Float[Array, " place"]) -> Float[Array, "place 5 5"]:
    """Shift T(x) of each position: displacement of a rigid shaft there, per displacement of its point x = 0."""
    return jnp.stack([shift_matrix(position) for position in positions])


def element_stiffness(
    length: Array, outer: Array, inner: Array, material: Material
) -> tuple[Float[Array, "4 4"], Float[Array, ""]]:
    r"""Stiffness of Timoshenko's element of length L for (w, $\theta$) of both ends in one plane, with $\theta$ =
    -tilt, and $\phi = 12EI/(\kappa GAL^2)$. With one end clamped it is the inverse of `Beam.compliance` of one section.
    Other programs for rotor dynamics use this element."""
    area, inertia = jnp.pi / 4.0 * (outer**2 - inner**2), jnp.pi / 64.0 * (outer**4 - inner**4)
    shear_modulus = 0.5 * material.youngs_modulus / (1.0 + material.poisson_ratio)
    kappa = shear_factor(jnp.asarray(material.poisson_ratio), inner / outer)
    phi = 12.0 * material.youngs_modulus * inertia / (kappa * shear_modulus * area * length**2)
    near, far = (4.0 + phi) * length**2, (2.0 - phi) * length**2
    six = 6.0 * length
    twelve = 12.0 * jnp.ones_like(six)
    rows = [
        [twelve, six, -twelve, six],
        [six, near, -six, far],
        [-twelve, -six, twelve, -six],
        [six, far, -six, near],
    ]
    matrix = jnp.stack([jnp.stack(row) for row in rows])
    return matrix * material.youngs_modulus * inertia / (length**3 * (1.0 + phi)), phi
