r"""The shaft as a beam (Timoshenko), exact and without a mesh.

Cut at a place s, the shaft has the compliance $c(s)$ = diag(1/EA, 1/$\kappa$GA, 1/$\kappa$GA, 1/EI, 1/EI) per length. A
load at $x_j$ reaches the cut as $T(x_j - s)^T F$, and what the cut yields moves the place $x_i$ by $T(x_i - s)$ times
it, with the shift T of `bearings.ring`. Of a shaft that is clamped at x = 0

$$u(x_i) = \int_0^{\min(x_i, x_j)} T(x_i - s)\,c(s)\,T(x_j - s)^T\,ds\,F_j,$$

whose integrand is a polynomial of the second degree in each section; with the shaft's weight it is of the third. Two
points of Gauss integrate both exactly. The displacement of the free shaft is this one and $T(x)u_0$.

This is the finite element of Timoshenko's beam with Cowper's shear factor that is exact for loads at nodes and for
uniform loads; here nodes at one place, and places that change their order, need no care.
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
    r"""$\kappa = 6(1+\nu)(1+m^2)^2/[(7+6\nu)(1+m^2)^2 + (20+12\nu)m^2]$ of a round section (Cowper 1966).

    **Arguments:** `ratio`: m, inner over outer diameter.
    """
    hollow = jnp.square(1.0 + jnp.square(ratio))
    more = (20.0 + 12.0 * poisson_ratio) * jnp.square(ratio)
    return 6.0 * (1.0 + poisson_ratio) * hollow / ((7.0 + 6.0 * poisson_ratio) * hollow + more)


class Beam(NamedTuple):
    """Sections of a shaft, from x = 0: ends, m, compliances per length and weight per length, N/m."""

    start: Float[Array, " section"]
    end: Float[Array, " section"]
    axial: Float[Array, " section"]
    """1/EA, 1/N."""
    shear: Float[Array, " section"]
    """1/(kappa G A), 1/N."""
    bending: Float[Array, " section"]
    """1/EI, 1/(N m^2)."""
    weight: Float[Array, "2 section"]
    """Along Y and Z."""

    def points(self, far: Float[Array, "..."]) -> tuple[Float[Array, "... section 2"], Float[Array, "... section 2"]]:
        """Places of integration between 0 and `far`, m, and their weights, m, of every section."""
        wide = lambda values: values.reshape((1,) * far.ndim + values.shape)
        start = wide(self.start)
        half = 0.5 * (jnp.clip(far[..., None], start, wide(self.end)) - start)[..., None]
        return start[..., None] + half * wide(1.0 + _POINTS)[..., None, :], half * wide(_WEIGHTS)[..., None, :]

    def compliance(self, at: Float[Array, " i"], loaded: Float[Array, " j"]) -> Float[Array, "i j 5 5"]:
        """Displacements at `at` of the shaft that is clamped at x = 0, per load at `loaded`."""
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
        """Load of the weight of everything beyond a place on a cut there, N and N m."""
        wide = lambda values: values.reshape((1,) * place.ndim + values.shape)
        end = wide(self.end)
        cut = jnp.clip(place[..., None], wide(self.start), end)
        reach, arm = end - cut, 0.5 * (end + cut) - place[..., None]
        forces = [jnp.sum(wide(one) * reach, axis=-1) for one in self.weight]
        moments = [-jnp.sum(wide(one) * reach * arm, axis=-1) for one in self.weight]
        return jnp.stack([jnp.zeros_like(forces[0]), *forces, *moments], axis=-1)

    def sagging(self, at: Float[Array, " i"]) -> Float[Array, "i 5"]:
        """Displacements of the shaft that is clamped at x = 0 under its own weight."""
        place, weight = self.points(at)
        load, lever = self.weight_at(place), at[:, None, None] - place
        total = lambda values: jnp.sum(weight * values, axis=(-2, -1))
        bend, shear = self.bending[None, :, None], self.shear[None, :, None]
        across = [total(shear * load[..., one] - lever * bend * load[..., one + 2]) for one in (1, 2)]
        turns = [total(bend * load[..., one]) for one in (3, 4)]
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
    """Acceleration along Y and Z, m/s^2."""
    if gravity is None:
        return jnp.zeros(2)
    azimuth = jnp.asarray(gravity.azimuth)
    return gravity.acceleration * jnp.stack([jnp.cos(azimuth), jnp.sin(azimuth)])


def shifts(positions: Float[Array, " place"]) -> Float[Array, "place 5 5"]:
    """T(x) of every position: displacement there of a rigid shaft, per displacement of its point x = 0."""
    return jnp.stack([shift_matrix(one) for one in positions])


def element_stiffness(
    length: Array, outer: Array, inner: Array, material: Material
) -> tuple[Float[Array, "4 4"], Float[Array, ""]]:
    r"""Stiffness of Timoshenko's element of length L for (w, $\theta$) of both ends in one plane, with $\theta$ = -tilt,
    and $\phi = 12EI/(\kappa GAL^2)$. It is the inverse of what `Beam.compliance` gives of one section, and what other
    programs of rotor dynamics take."""
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
