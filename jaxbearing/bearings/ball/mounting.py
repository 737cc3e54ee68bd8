r"""Clearance, contact angle and grooves of a ball bearing after the expansion of its parts.

The diameters of the groove bottoms are $G_i = d_m + (2f_i-1)D\cos\alpha - 2f_iD$ and
$G_o = d_m - (2f_o-1)D\cos\alpha + 2f_oD$. They change with the expansion of the rings at the raceways. The radii
$r_i, r_o$ of the grooves change with the temperature of their ring only (their change by the strain of the ring cancels
in the clearance, and changes $\cos\alpha$ by about 1e-5). With the radii $R_i$ and $R_o$ of the circles of groove
centres, $A_r = R_i - R_o$ and $BD = r_i + r_o - D$, the diametral clearance is $2(BD - A_r)$, and
$\cos\alpha = A_r/BD$.
"""

import dataclasses
from typing import Any, NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._scene import number
from ..._types import Scalar
from ..growth import Growth, Play
from .arcs import added
from .geometry import BallGeometry


class RunningBallGeometry(BallGeometry):
    """Geometry of a ball bearing after expansion. `contact_angle` and `diametral_clearance` keep their nominal values,
    for quantities that are defined for the nominal bearing, such as its ratings.

    **Arguments:** those of `BallGeometry`, and
    - `running_clearance`: diametral operating clearance, m; negative: radial preload. For rings with two arcs it is the
      clearance of `free_clearance`.
    - `axial_rest`: axial distance between the planes of the grooves at an axial displacement of 0, m: that at first
      contact in the nominal bearing, 0 in a bearing given by its clearance. It does not change with the operating
      clearance, so that displacements are smooth where the clearance passes 0.
    """

    running_clearance: Scalar = number(kw_only=True, unit="m")
    axial_rest: Scalar = number(kw_only=True, unit="m")

    @property
    def free_clearance(self) -> Scalar:
        return self.running_clearance

    @property
    def aligned(self) -> Array:
        return -jnp.asarray(self.axial_rest)


class _Grooves(NamedTuple):
    """Radii of both grooves and of the circles of groove centres, diameter of the balls, m. `shims`: shim angles, rad;
    `None` for rings with one arc."""

    radii: tuple[Array, Array]
    circles: tuple[Array, Array]
    ball: Array
    shims: tuple[Scalar | None, Scalar | None] = (None, None)

    @property
    def distance(self) -> Array:
        return self.radii[0] + self.radii[1] - self.ball

    @property
    def across(self) -> Array:
        """Radial distance A_r between the circles of groove centres, m."""
        return self.circles[0] - self.circles[1]

    @property
    def clearance(self) -> Array:
        """Diametral clearance of a bearing with one arc on each ring and the same circles of groove centres, m."""
        return 2.0 * (self.distance - self.across)

    @property
    def play(self) -> Array:
        """Diametral clearance between the balls and all groove arcs, m."""
        pairs = [(r - 0.5 * self.ball, a) for r, a in zip(self.radii, self.shims, strict=True) if a is not None]
        if not pairs:
            return self.clearance
        return self.clearance - added([4.0 * g * jnp.square(jnp.sin(0.5 * a)) for g, a in pairs])


def groove_bottoms(geometry: BallGeometry) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Diameters of the bottoms of the inner and the outer groove, m."""
    ball, cosine = geometry.ball_diameter, jnp.minimum(geometry.free_cosine, 1.0)
    inner = geometry.pitch_diameter + 2.0 * (geometry.inner_offset * cosine - geometry.conformity_inner * ball)
    outer = geometry.pitch_diameter - 2.0 * (geometry.outer_offset * cosine - geometry.conformity_outer * ball)
    # with nominal radial preload the inner ring is larger by the overlap
    return inner + 2.0 * geometry.centre_distance * jnp.maximum(geometry.free_cosine - 1.0, 0.0), outer


def _grown(geometry: BallGeometry, growth: Growth) -> _Grooves:
    inner, outer = groove_bottoms(geometry)
    radii = (
        geometry.conformity_inner * geometry.ball_diameter * (1.0 + growth.inner_strain),
        geometry.conformity_outer * geometry.ball_diameter * (1.0 + growth.outer_strain),
    )
    circles = (0.5 * (inner + growth.inner) + radii[0], 0.5 * (outer + growth.outer) - radii[1])
    ball = geometry.ball_diameter * (1.0 + growth.element_strain)
    return _Grooves(radii, circles, ball, (geometry.shim_inner, geometry.shim_outer))


def running_geometry(geometry: BallGeometry, growth: Growth) -> RunningBallGeometry:
    """The geometry of the bearing after expansion."""
    grooves = _grown(geometry, growth)
    cosine = jnp.minimum(grooves.across / grooves.distance, 1.0)
    middle = grooves.circles[1] + (grooves.radii[1] - 0.5 * grooves.ball) * cosine
    nominal: dict[str, Any] = {field.name: getattr(geometry, field.name) for field in dataclasses.fields(BallGeometry)}
    grown: dict[str, Any] = {
        "pitch_diameter": 2.0 * middle,
        "ball_diameter": grooves.ball,
        "conformity_inner": grooves.radii[0] / grooves.ball,
        "conformity_outer": grooves.radii[1] / grooves.ball,
    }
    return RunningBallGeometry(**(nominal | grown), running_clearance=grooves.clearance, axial_rest=-geometry.aligned)


def running_play(geometry: BallGeometry, growth: Growth) -> Play:
    """Clearance, contact angle and axial shift of the bearing after expansion."""
    grooves = _grown(geometry, growth)
    lift = grooves.clearance / (2.0 * grooves.distance)
    # the angle has its largest value where the circles of groove centres coincide; beyond it nothing touches
    open_ = (lift > 0.0) & (lift < 1.0)
    sine = jnp.where(open_, jnp.sqrt(jnp.where(open_, lift * (2.0 - lift), 1.0)), 0.0)
    angle = jnp.arctan2(sine, jnp.where(open_, 1.0 - lift, 1.0))
    shift = grooves.distance * sine - geometry.centre_distance * geometry.free_sine
    return Play(grooves.play, angle, shift, grooves.across > 0.0)
