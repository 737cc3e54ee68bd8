r"""Geometry of a tapered roller bearing: cones with one apex, spherical roller ends, a conical rib on the cone.

Meridian plane of a roller: (a, r), a along the bearing axis, *positive from the rollers' big ends towards the common
apex O*, r radially outwards; O is the origin. Half angles of cup $\alpha_o$ and cone $\alpha_i$, roller half angle
$\epsilon = (\alpha_o - \alpha_i)/2$, roller axis $\gamma = (\alpha_o + \alpha_i)/2$ (the source prints these two
definitions in swapped order). Source eqs. (42), (43), (53): the first, X_b, only places its origin and could not be
reconstructed.
"""

import math

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

from .._scene import number
from .._types import Scalar
from ..contacts import PointContact
from ..numerics.checks import known, require

LEAST_HALF_ANGLE = math.radians(0.3)
"""Of the rollers: below, the apex goes to infinity and the bearing is a cylindrical one."""


class TaperedGeometry(eqx.Module):
    """Main dimensions; the pitch diameter follows from them.

    **Arguments:**
    - `n_rollers`: structure.
    - `roller_diameter`: D_w, of the big end, m.
    - `roller_length`: l_w, of contact, along the generator, m.
    - `contact_angle`: half angle of the cup, alpha_o, rad.
    - `roller_half_angle`: epsilon, rad, at least 0.3 degrees.
    - `flange_angle`: of the NORMAL of the rib to the bearing axis, alpha_f, rad; less than gamma = alpha_o - epsilon.
    - `end_radius`: R_s, of the sphere of the roller's big end, m.

    **Raises:** `ValueError` naming the field that makes the bearing impossible.
    """

    n_rollers: int = eqx.field(static=True)
    roller_diameter: Scalar = number()
    roller_length: Scalar = number()
    contact_angle: Scalar = number()
    roller_half_angle: Scalar = number()
    flange_angle: Scalar = number()
    end_radius: Scalar = number()

    def __check_init__(self):
        names = ("roller_diameter", "roller_length", "contact_angle", "roller_half_angle", "flange_angle", "end_radius")
        require("geometry", **{name: (getattr(self, name), "> 0") for name in names})
        if self.n_rollers < 1:
            raise ValueError(f"geometry.n_rollers must be >= 1, got {self.n_rollers}")
        sizes = known(*(getattr(self, name) for name in names))
        if sizes is not None:
            _check(self.n_rollers, *sizes)

    @property
    def cone_angle(self) -> Array:
        """alpha_i, rad."""
        return jnp.asarray(self.contact_angle) - 2.0 * self.roller_half_angle

    @property
    def axis_angle(self) -> Array:
        """gamma, of the roller axis to the bearing axis, rad."""
        return jnp.asarray(self.contact_angle) - self.roller_half_angle

    @property
    def apex_distance(self) -> Array:
        """d, from the apex to the big end along a generator, m."""
        return self.roller_diameter / (2.0 * jnp.sin(self.roller_half_angle))

    @property
    def big_end_radius(self) -> Array:
        """Y_b, of the circle of big-end centres, m (eq. (43))."""
        return 0.5 * self.roller_diameter * jnp.sin(self.axis_angle) / jnp.tan(self.roller_half_angle)

    @property
    def mean_roller_diameter(self) -> Array:
        """At mid length, m."""
        return self.roller_diameter - self.roller_length * jnp.sin(self.roller_half_angle)

    @property
    def pitch_diameter(self) -> Array:
        """Of the circle of the rollers' middles, m."""
        return 2.0 * (self.big_end_radius - 0.5 * self.roller_length * jnp.sin(self.axis_angle))

    @property
    def end_height(self) -> Array:
        """R_s cos(lambda): from the big end's plane to the centre of its sphere, m."""
        return self.end_radius * jnp.sqrt(1.0 - jnp.square(self.roller_diameter / (2.0 * self.end_radius)))

    @property
    def flange_tilt(self) -> Array:
        """theta = gamma - alpha_f, rad: the contact at the rib lies below the roller axis."""
        return self.axis_angle - self.flange_angle

    @property
    def sphere_centre(self) -> tuple[Array, Array]:
        """(a, r) of the sphere's centre, m."""
        k = self.roller_diameter / (2.0 * jnp.tan(self.roller_half_angle)) - self.end_height
        return -k * jnp.cos(self.axis_angle), k * jnp.sin(self.axis_angle)

    @property
    def flange_radius(self) -> Array:
        """r_f: of the contact on the rib about the bearing axis, m."""
        height = self.end_radius * jnp.sin(self.flange_angle) - self.end_height * jnp.sin(self.axis_angle)
        return self.big_end_radius + height

    def flange_contact(self, reduced_modulus: Scalar) -> PointContact:
        """Sphere on the concave cone of the rib (eq. (53)): straight along its generator, curved around the axis, which
        is the direction of rolling."""
        around = 1.0 / self.end_radius - jnp.sin(self.flange_angle) / self.flange_radius
        return PointContact(1.0 / around, jnp.asarray(self.end_radius), reduced_modulus)

    def race_reduced_radii(self, position: Array) -> Array:
        """Reduced radii of the inner and outer contact normal to the generator at s/l, m; shape (2, ...)."""
        reach = self.apex_distance - self.roller_length * position
        roller = reach * jnp.tan(self.roller_half_angle)
        inner, outer = reach * jnp.tan(self.cone_angle), reach * jnp.tan(self.contact_angle)
        return jnp.stack([1.0 / (1.0 / roller + 1.0 / inner), 1.0 / (1.0 / roller - 1.0 / outer)])


def _check(
    n_rollers: int, diameter: float, length: float, cup: float, half: float, flange: float, end_radius: float
) -> None:
    """**Raises:** `ValueError` for a bearing that cannot be built."""
    degrees = lambda angle: f"{math.degrees(angle):g} degrees"
    gamma, cone = cup - half, cup - 2.0 * half
    if not cup < 0.5 * math.pi:
        raise ValueError(f"geometry.contact_angle must be below 90 degrees, got {degrees(cup)}")
    if half < LEAST_HALF_ANGLE:
        raise ValueError(
            f"geometry.roller_half_angle must be at least 0.3 degrees, got {degrees(half)}: a smaller taper is a "
            "cylindrical roller bearing"
        )
    if cone <= 0.0:
        raise ValueError(f"geometry.roller_half_angle must be below half the contact_angle, got {degrees(half)}")
    if length * math.sin(half) >= 0.5 * diameter:
        raise ValueError(
            f"geometry.roller_length must be below {0.5 * diameter / math.sin(half):g} m (the roller's cone ends "
            f"there), got {length:g} m"
        )
    # a longer radius than the cone is fits the rib closer than a sphere can: Hertz's contact does not hold
    slant = 0.5 * diameter / math.sin(half)
    if not 0.5 * diameter < end_radius < slant:
        raise ValueError(
            f"geometry.end_radius must be above {0.5 * diameter:g} m (half the roller_diameter) and below {slant:g} m "
            f"(from the apex of the roller's cone to its big end), got {end_radius:g} m"
        )
    radius = 0.5 * diameter * math.sin(gamma) / math.tan(half)
    # rollers are nearest where they touch their neighbours: the plane of two axes through the apex
    if math.sin(half) >= math.sin(gamma) * math.sin(math.pi / max(n_rollers, 2)):
        most = math.ceil(math.pi / math.asin(math.sin(half) / math.sin(gamma))) - 1
        raise ValueError(
            f"geometry.n_rollers: {n_rollers} rollers of big-end diameter {diameter:g} m do not fit on a circle of "
            f"radius {radius:g} m, at most {most}"
        )
    height = math.sqrt(end_radius**2 - 0.25 * diameter**2)
    contact_radius = radius + end_radius * math.sin(flange) - height * math.sin(gamma)
    cone_big_end = diameter / (2.0 * math.sin(half)) * math.sin(cone)
    # at the rim of the end face, and where the rib ends at the cone
    rim = gamma - math.asin(0.5 * diameter / end_radius)
    foot = (cone_big_end - radius + height * math.sin(gamma)) / end_radius
    lowest = max(rim, math.asin(max(foot, 0.0))) if foot < math.sin(gamma) else math.inf
    if lowest >= gamma:
        raise ValueError(
            f"geometry.flange_angle: no angle puts the contact of the rib on the roller's end face; an end_radius of "
            f"{end_radius:g} m does not fit the other sizes"
        )
    if not lowest < flange < gamma:
        if flange >= gamma:
            why = "the roller end would not touch the rib below its axis"
        elif flange <= rim:
            why = "the contact lies beyond the roller's end face"
        else:
            why = f"the contact, at radius {contact_radius:g} m, lies below the cone's big end, {cone_big_end:g} m"
        raise ValueError(
            f"geometry.flange_angle must be above {degrees(lowest)} and below {degrees(gamma)} (the roller axis) with "
            f"an end_radius of {end_radius:g} m, got {degrees(flange)}: {why}"
        )
