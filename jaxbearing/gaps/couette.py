"""Sheared oil between a roller end and a ring flange or the cage rails: plane Couette flow."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp

from .._types import Batch, Scalar, Values
from ..numerics.checks import Checked, bounded
from ..numerics.quadrature import gauss_legendre
from ..numerics.safe import softplus_floor
from ..numerics.structure import count

FILM_FLOOR = 0.5e-6
"""Smallest film at a roller end, m."""
FILM_FLOOR_WIDTH = 0.05e-6
"""Smoothing width of `FILM_FLOOR`, m: raises the film by 7 % at the floor, by less than 1e-12 above 2 um."""
LENS_EDGE = 1e-13
"""Distance from the edge of the roller circle, over the roller radius, within which a rail edge counts as lying on it
(where the lens ends); without it the angle of a tangent race would have an infinite slope."""
NODES = 40


class EndForces(NamedTuple):
    """Forces of the end films of one roller, both sides together, counter-clockwise positive.

    `tangential_force` on the roller along the orbit, N; `moment` on the roller about its centre,
    N m; `ring_moment` on the ring about the bearing centre, N m; `power` dissipated, W, >= 0.
    """

    tangential_force: Batch
    moment: Batch
    ring_moment: Batch
    power: Batch


def _lens(start: Values, stop: Values, pitch_radius: Values, roller_radius: Values):
    r"""Quadrature over the part of [start, stop] inside the roller circle: r, phi, sin(phi), weights dr.

    phi(r) is half of the angle, seen from the bearing centre, that the roller circle covers at the radius r. With
    $r = R_m + R_R\sin\theta$ the square root at the circle's edge becomes the smooth $\cos\theta$:
    $\sin(\phi/2) = R_R\cos\theta/(2\sqrt{rR_m})$, so that 40 points are exact to round-off. A rail that misses the
    circle has an interval of length 0. dr < 0 if stop < start.
    """

    def angle(radius):
        x = (radius - pitch_radius) / roller_radius
        inside = jnp.abs(x) < 1.0 - LENS_EDGE
        return jnp.where(inside, jnp.arcsin(jnp.where(inside, x, 0.0)), jnp.sign(x) * (0.5 * jnp.pi))

    nodes, weights = gauss_legendre(NODES)
    first, span = angle(start), angle(stop) - angle(start)
    theta = first + span * nodes
    cos = jnp.cos(theta)
    r = pitch_radius + roller_radius * jnp.sin(theta)
    half_sin = roller_radius * cos / (2.0 * jnp.sqrt(r * pitch_radius))
    phi = 2.0 * jnp.arcsin(half_sin)
    sin_phi = 2.0 * half_sin * jnp.sqrt(1.0 - jnp.square(half_sin))
    return r, phi, sin_phi, weights * span * roller_radius * cos


def end_film(film: Values) -> Batch:
    """Smooth max(film, 0.5 um): keeps the shear stress finite where an end gap closes."""
    return softplus_floor(film, FILM_FLOOR, FILM_FLOOR_WIDTH)


class FlangeCoefficients(eqx.Module):
    r"""Flange integrals including the viscosity; the forces are linear in both speeds.

    `first` = n int (mu/h) 2 r phi dr; `second` = n int (mu/h) 2 r^2 sin(phi) dr;
    `third` = n int (mu/h) 2 r^3 phi dr.

    **Arguments:**
    - `first`, `second`, `third`: the integrals, N s/m, N s and N m s.
    - `pitch_radius`: of the circle of roller centres, m.
    """

    first: Batch
    second: Batch
    third: Batch
    pitch_radius: Scalar

    def evaluate(self, spin: Values, ring_speed_relative: Values) -> EndForces:
        r"""Forces at roller spin w and ring speed $\Omega$, both relative to the orbiting frame, rad/s.

        $R_mF_t + M + M_{ring} = 0$ to round-off; power $-wM - \Omega M_{ring} \ge 0$.
        """
        spin, ring = jnp.asarray(spin), jnp.asarray(ring_speed_relative)
        r_m = self.pitch_radius
        slip = spin - ring
        force = spin * r_m * self.first - slip * self.second
        moment = -(slip * self.third + spin * jnp.square(r_m) * self.first - (spin + slip) * r_m * self.second)
        ring_moment = slip * self.third - spin * r_m * self.second
        return EndForces(force, moment, ring_moment, -spin * moment - ring * ring_moment)


class Flange(Checked):
    r"""Roller ends against the flanges of one ring, inner or outer.

    The integrals cover the lens in which the roller circle overlaps the flange annulus from `race_radius` to
    `rim_radius` (rim > race on the inner ring, rim < race on the outer). The film is
    $h = h_0 + |r - R_{race}|\tan\theta_f$. With $\phi(r)$ the half angle of the roller circle (see `_lens`):

    $F_t = n\int\frac{\mu r}{h}[-2(w-\Omega)r\sin\phi + 2wR_m\phi]\,dr$,
    $M = -n\int\frac{\mu r}{h}[2\phi((w-\Omega)r^2 + wR_m^2) - 2\sin\phi(2w-\Omega)R_mr]\,dr$,
    $M_{ring} = n\int\frac{\mu r}{h}[2\phi(w-\Omega)r^2 - 2wR_mr\sin\phi]\,dr$.

    **Limits:** the film is floored at 0.5 um (`end_film`); no overlap: no force, finite gradients.
    **Validity:** laminar plane Couette flow, no normal load, no corner chamfers.
    **Reference:** classical Couette shear; the source names it in Table 3 row 6, without a formula.

    **Arguments:**
    - `race_radius`, `rim_radius`: of raceway and rim of the flange about the bearing axis, m, > 0.
    - `pitch_radius`, `roller_radius`: of the circle of roller centres, and of a roller, m, > 0.
    - `side_clearance`: h_0, film at the race, AXIAL, ONE side: half of the total axial guiding clearance (decision), m.
    - `angle`: flange opening angle, rad.
    - `n_sides`: number of roller ends that touch flanges of this ring; structure.
    """

    race_radius: Scalar = bounded("> 0")
    rim_radius: Scalar = bounded("> 0")
    pitch_radius: Scalar = bounded("> 0")
    roller_radius: Scalar = bounded("> 0")
    side_clearance: Scalar = bounded(">= 0")
    angle: Scalar = bounded(">= 0 and below 90 degrees")
    n_sides: int = count("n_sides", 2, least=1)

    def coefficients(self, viscosity: Values) -> FlangeCoefficients:
        """Integrals at a viscosity, Pa s, for evaluation at many speeds."""
        r, phi, sin_phi, dr = _lens(self.race_radius, self.rim_radius, self.pitch_radius, self.roller_radius)
        outwards = jnp.where(self.rim_radius >= jnp.asarray(self.race_radius), 1.0, -1.0)
        height = outwards * (r - self.race_radius)
        weight = 2.0 * outwards * dr * r / end_film(self.side_clearance + height * jnp.tan(self.angle))
        scale = self.n_sides * jnp.asarray(viscosity)
        return FlangeCoefficients(
            first=scale * jnp.sum(weight * phi),
            second=scale * jnp.sum(weight * r * sin_phi),
            third=scale * jnp.sum(weight * r * r * phi),
            pitch_radius=self.pitch_radius,
        )


class PocketEdgeCoefficients(eqx.Module):
    """Pocket-edge integrals: n mu/j times int rho^2 dA (`polar`) and times int (y - R_m) dA (`first`).

    **Arguments:**
    - `polar`: N m s.
    - `first`: N s.
    """

    polar: Batch
    first: Batch

    def evaluate(self, spin: Values) -> EndForces:
        """Forces at the roller spin w relative to the cage, rad/s; `ring_moment` is 0.

        The reaction on the cage about the bearing centre is -(R_m F_t + M).
        """
        spin = jnp.asarray(spin)
        force, moment = -spin * self.first, -spin * self.polar
        return EndForces(force, moment, jnp.zeros_like(moment), -spin * moment)


class PocketEdge(Checked):
    r"""Roller ends against the side rails of the cage, at rest in the orbiting frame.

    $M = -n\mu w/j\int\rho^2dA$, $F_t = -n\mu w/j\int(y-R_m)dA$ over the lens in which the roller circle overlaps the
    rail annulus from `inner_radius` to `outer_radius`; rho is the distance from the roller centre, y the coordinate
    from the bearing centre towards the roller centre.

    **Limits:** rails that miss the roller: no force; film floored at 0.5 um (`end_film`).
    **Validity:** laminar plane Couette flow, no normal load.
    **Reference:** classical Couette shear; the source names it in Table 3 row 5, without a formula.

    **Arguments:**
    - `inner_radius`, `outer_radius`: of the rails about the bearing axis, m, > 0.
    - `pitch_radius`, `roller_radius`: of the circle of roller centres, and of a roller, m, > 0.
    - `side_clearance`: j, AXIAL film on ONE side: half of the total axial pocket clearance, m.
    - `n_sides`: number of roller ends beside rails; structure.
    """

    inner_radius: Scalar = bounded("> 0")
    outer_radius: Scalar = bounded("> 0")
    pitch_radius: Scalar = bounded("> 0")
    roller_radius: Scalar = bounded("> 0")
    side_clearance: Scalar = bounded(">= 0")
    n_sides: int = count("n_sides", 2, least=1)

    def _integrals(self) -> tuple[Batch, Batch, Batch]:
        r_m = self.pitch_radius
        r, phi, sin_phi, dr = _lens(self.inner_radius, self.outer_radius, r_m, self.roller_radius)
        area = jnp.sum(2.0 * r * phi * dr)
        # written with differences, since r^2 + R_m^2 - 2 r R_m cos cancels for a small roller
        polar = jnp.sum(r * (2.0 * phi * jnp.square(r - r_m) + 4.0 * r * r_m * (phi - sin_phi)) * dr)
        first = jnp.sum(2.0 * r * ((r - r_m) * phi - r * (phi - sin_phi)) * dr)
        return area, polar, first

    def overlap_area(self) -> Batch:
        """Area of the lens on one side, m^2."""
        return self._integrals()[0]

    def coefficients(self, viscosity: Values) -> PocketEdgeCoefficients:
        """Integrals at a viscosity, Pa s, for evaluation at many speeds."""
        _, polar, first = self._integrals()
        scale = self.n_sides * jnp.asarray(viscosity) / end_film(self.side_clearance)
        return PocketEdgeCoefficients(polar=scale * polar, first=scale * first)
