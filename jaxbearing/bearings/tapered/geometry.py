r"""Geometry of a tapered roller bearing: cones with one apex, spherical roller ends, a conical rib on the cone.

The meridian plane of a roller has the coordinates (a, r): a along the bearing axis, *positive from the rollers' big
ends towards the common apex O*, and r radially outwards. O is the origin. The half angles are $\alpha_o$ of the cup and
$\alpha_i$ of the cone. The roller has the half angle $\epsilon = (\alpha_o - \alpha_i)/2$, and its axis is inclined by
$\gamma = (\alpha_o + \alpha_i)/2$ (the source prints these two definitions in swapped order). Source eqs. (42), (43),
(53). Eq. (42), X_b, is not used: it only places the origin of the source and could not be reconstructed.
"""

import math
from collections.abc import Iterator
from typing import Any, ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._scene import number, optional_number
from ..._types import Scalar
from ...contacts import PointContact
from ...numerics.checks import array_module, demand, numbers_or_none
from ...numerics.refusals import refusals_of, refuse_all
from ...numerics.structure import count
from ..cage import AbstractCage
from ..cylindrical.geometry import ASSUMED_CAGE_INNER, ASSUMED_CAGE_OUTER
from ..inlet import of_inner_race
from ..parts import FIRST_ELEMENT, AbstractGeometry
from .usual_ends import USUAL_END_RADIUS, USUAL_RIB_HEIGHT, usual_end_radius, usual_flange_angle

LEAST_HALF_ANGLE = math.radians(0.3)
"""Smallest half angle of the rollers, rad. As it approaches 0, the apex goes to infinity and the bearing becomes a
cylindrical one."""


class TaperedGeometry(AbstractGeometry):
    """Main dimensions of a tapered roller bearing; the pitch diameter follows from them.

    **Arguments:**
    - `n_rollers`: number of rollers (structure).
    - `roller_diameter`: diameter D_w of the big end, m.
    - `roller_length`: length l_w of the contact, along the generator, m.
    - `contact_angle`: half angle of the cup, alpha_o, rad.
    - `roller_half_angle`: half angle of the roller's cone, epsilon, rad, at least 0.3 degrees.
    - `flange_angle`: angle alpha_f between the NORMAL of the rib and the bearing axis, rad; less than gamma =
      alpha_o - epsilon; not given: estimated so that rib and roller touch 0.8 of the big end's radius below the roller
      axis.
    - `end_radius`: radius R_s of the spherical big end of the roller, m; not given: estimated as 0.95 of the length of
      the roller's cone.
    - `first_element_angle`: azimuth of the first roller, rad; not given: 0, and the load line is a line of symmetry.
    - `bore`, `outside_diameter`, `width`: boundary dimensions of the bearing, m, used for fits, thermal networks and
      flexible rings.

    **Raises:** `ValueError` that names the field that makes the bearing impossible.
    """

    part: ClassVar[str] = "geometry"

    n_rollers: int = count("geometry.n_rollers")
    roller_diameter: Scalar = number(bound="> 0", unit="m")
    roller_length: Scalar = number(bound="> 0", unit="m")
    contact_angle: Scalar = number(bound="above 0 and below 90 degrees", unit="rad")
    roller_half_angle: Scalar = number(bound="above 0 and below 90 degrees", unit="rad")
    flange_angle: Scalar | None = optional_number(bound="above 0 and below 90 degrees", unit="rad")
    end_radius: Scalar | None = optional_number(bound="> 0", unit="m")
    first_element_angle: Scalar | None = optional_number(metadata=FIRST_ELEMENT)
    bore: Scalar | None = optional_number(bound="> 0", unit="m")
    outside_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    width: Scalar | None = optional_number(bound="> 0", unit="m")

    @property
    def n_elements(self) -> int:
        return self.n_rollers

    @property
    def element_diameter(self) -> Scalar:
        return self.mean_roller_diameter

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        if self.n_rollers < 1:
            yield f"geometry.n_rollers must be >= 1, got {self.n_rollers}"
            return
        sizes = numbers_or_none(
            *(self.roller_diameter, self.roller_length, self.contact_angle, self.roller_half_angle),
            *(size for size in (self.flange_angle, self.end_radius) if size is not None),
        )
        if sizes is not None:
            diameter, _, cup, half = sizes[:4]
            end, rib = self.end_radius, self.flange_angle
            if end is None:
                end = usual_end_radius(diameter, half, array_module(diameter, half))
            if rib is None:
                rib = usual_flange_angle(diameter, cup, half, end, array_module(diameter, cup, half, end))
            yield from refusals_of(_check, self.n_rollers, *sizes[:4], rib, end)

    @property
    def rib_angle(self) -> Scalar:
        """Angle alpha_f between the normal of the rib and the bearing axis, given or estimated, rad."""
        if self.flange_angle is not None:
            return self.flange_angle
        return usual_flange_angle(
            self.roller_diameter, self.contact_angle, self.roller_half_angle, self.sphere_radius, jnp
        )

    @property
    def sphere_radius(self) -> Scalar:
        """Radius R_s of the spherical big end, given or estimated, m."""
        if self.end_radius is not None:
            return self.end_radius
        return usual_end_radius(self.roller_diameter, self.roller_half_angle, jnp)

    def assumptions(self) -> list[str]:
        """Notes for the user on dimensions that are estimated."""
        estimates = {
            "flange_angle": f"so that rib and roller touch {USUAL_RIB_HEIGHT:g} of the big end's radius below the axis",
            "end_radius": f"{USUAL_END_RADIUS:g} of the length of the roller's cone (0.85 to 0.99 are usual)",
        }
        return [
            f"geometry.{name} is not given: estimated {words}"
            for name, words in estimates.items()
            if getattr(self, name) is None
        ]

    @property
    def cone_angle(self) -> Array:
        """Half angle alpha_i of the cone, rad."""
        return jnp.asarray(self.contact_angle) - 2.0 * self.roller_half_angle

    @property
    def axis_angle(self) -> Array:
        """Angle gamma between roller axis and bearing axis, rad."""
        return jnp.asarray(self.contact_angle) - self.roller_half_angle

    @property
    def apex_distance(self) -> Array:
        """Distance d from the apex to the big end along a generator, m."""
        return self.roller_diameter / (2.0 * jnp.sin(self.roller_half_angle))

    @property
    def big_end_radius(self) -> Array:
        """Radius Y_b of the circle through the centres of the big ends, m (eq. (43))."""
        return 0.5 * self.roller_diameter * jnp.sin(self.axis_angle) / jnp.tan(self.roller_half_angle)

    @property
    def mean_roller_diameter(self) -> Array:
        """Roller diameter at mid length, m."""
        return self.roller_diameter - self.roller_length * jnp.sin(self.roller_half_angle)

    @property
    def pitch_diameter(self) -> Array:
        r"""Diameter of the circle through the middles of the rollers, m: $2Y_b - \ell\cos\epsilon\sin\gamma$, where
        $\ell$ is the length along the generator."""
        along = self.roller_length * jnp.cos(self.roller_half_angle)
        return 2.0 * self.big_end_radius - along * jnp.sin(self.axis_angle)

    @property
    def end_height(self) -> Array:
        """Distance R_s cos(lambda) from the plane of the big end to the centre of its sphere, m."""
        return self.sphere_radius * jnp.sqrt(1.0 - jnp.square(self.roller_diameter / (2.0 * self.sphere_radius)))

    @property
    def flange_tilt(self) -> Array:
        """Angle theta = gamma - alpha_f, rad, by which the contact at the rib lies below the roller axis, seen from the
        centre of the sphere."""
        return self.axis_angle - self.rib_angle

    @property
    def sphere_centre(self) -> tuple[Array, Array]:
        """Coordinates (a, r) of the centre of the spherical big end, m."""
        k = self.roller_diameter / (2.0 * jnp.tan(self.roller_half_angle)) - self.end_height
        return -k * jnp.cos(self.axis_angle), k * jnp.sin(self.axis_angle)

    @property
    def flange_radius(self) -> Array:
        """Radius r_f of the contact on the rib, from the bearing axis, m."""
        height = self.sphere_radius * jnp.sin(self.rib_angle) - self.end_height * jnp.sin(self.axis_angle)
        return self.big_end_radius + height

    def rib_moment(self, force: Array, moment: Array) -> tuple[Array, Array]:
        """Components (a, r) of the moment about the apex, N m, of the rib's friction on a roller.

        **Arguments:** `force`: circumferential force on the roller, N; `moment`: about the normal of the rib, N m.
        """
        normal = (jnp.cos(jnp.asarray(self.rib_angle)), -jnp.sin(jnp.asarray(self.rib_angle)))
        axial, radius = self.sphere_centre[0] - self.sphere_radius * normal[0], self.flange_radius
        return force * radius + moment * normal[0], -force * axial + moment * normal[1]

    def flange_contact(self, race_modulus: Float[Array, ""] | Float[Array, "2 1"]) -> PointContact:
        """Contact of the spherical big end with the rib, a concave cone (eq. (53)). The rib is straight along its
        generator and curved in the direction of rolling, around the bearing axis. It is a part of the inner ring.

        **Arguments:** `race_modulus`: reduced modulus of the raceway contacts, Pa.
        """
        around = 1.0 / self.sphere_radius - jnp.sin(self.rib_angle) / self.flange_radius
        return PointContact(1.0 / around, jnp.asarray(self.sphere_radius), of_inner_race(race_modulus))

    def race_reduced_radii(self, position: Array) -> Array:
        """Reduced radii of the inner and the outer raceway contact in the plane normal to the generator, m; shape
        (2, ...). **Arguments:** `position`: s/l, 0 at the big end."""
        reach = self.apex_distance - self.roller_length * position
        roller = reach * jnp.tan(self.roller_half_angle)
        inner, outer = reach * jnp.tan(self.cone_angle), reach * jnp.tan(self.contact_angle)
        return jnp.stack([1.0 / (1.0 / roller + 1.0 / inner), 1.0 / (1.0 / roller - 1.0 / outer)])


class TaperedCage(AbstractCage[TaperedGeometry]):
    """One-piece cage, guided by one ring on `n_lands` lands, with a pocket film in front of and behind each roller. The
    walls of a pocket are parallel to the lines of the roller that face them.

    **Arguments:** those of `AbstractCage`, and
    - `inner_diameter`, `outer_diameter`: at mid length of the rollers, or at the lands on the side that is guided, m.
    - `pocket_clearance`: TOTAL circumferential clearance of a roller in its pocket, m, > 0.
    """

    element: ClassVar[str] = "roller"
    assumed_inner: ClassVar[float] = ASSUMED_CAGE_INNER
    assumed_outer: ClassVar[float] = ASSUMED_CAGE_OUTER

    def pocket_opening(self, geometry: TaperedGeometry) -> tuple[Scalar, Scalar]:
        return geometry.roller_length, geometry.mean_roller_diameter + self.pocket_clearance

    def raceways(self, geometry: TaperedGeometry) -> tuple[Scalar, Scalar]:
        """Diameters of both raceways at mid length, m."""
        across = geometry.mean_roller_diameter * jnp.cos(geometry.axis_angle)
        return geometry.pitch_diameter - across, geometry.pitch_diameter + across


def _check(n_rollers: int, diameter: Any, length: Any, cup: Any, half: Any, flange: Any, end_radius: Any) -> None:
    """Checks the dimensions, which may be numbers or traced. **Raises:** `ValueError` for a bearing that is known to be
    impossible."""
    xp = array_module(diameter, length, cup, half, flange, end_radius)
    degrees = lambda angle: f"{math.degrees(float(angle)):g} degrees"
    metres = lambda size: f"{float(size):g} m"
    gamma, cone = cup - half, cup - 2.0 * half
    demand(
        "geometry.roller_half_angle must be at least 0.3 degrees",
        half >= LEAST_HALF_ANGLE,
        lambda: (
            f"geometry.roller_half_angle must be at least 0.3 degrees, got {degrees(half)}: a smaller taper is a "
            "cylindrical roller bearing"
        ),
    )
    demand(
        "geometry.roller_half_angle must be below half the contact_angle",
        cone > 0.0,
        lambda: f"geometry.roller_half_angle must be below half the contact_angle, got {degrees(half)}",
    )
    # from the apex of the roller's cone to its big end
    slant = 0.5 * diameter / xp.sin(half)
    demand(
        "geometry.roller_length must end before the tip of the roller's cone",
        length < slant,
        lambda: (
            f"geometry.roller_length must be below {metres(slant)} (the roller's cone ends there), got {metres(length)}"
        ),
    )
    # a radius above the length of the roller's cone conforms too closely to the rib for a Hertz contact
    fits = (end_radius > 0.5 * diameter) & (end_radius < slant)
    demand(
        "geometry.end_radius must be above half the roller_diameter and below the length of the roller's cone",
        fits,
        lambda: (
            f"geometry.end_radius must be above {metres(0.5 * diameter)} (half the roller_diameter) and below "
            f"{metres(slant)} (from the apex of the roller's cone to its big end), got {metres(end_radius)}"
        ),
    )
    radius = 0.5 * diameter * xp.sin(gamma) / xp.tan(half)
    # neighbouring rollers are nearest in the plane of their two axes, which meet at the apex
    most = lambda: math.ceil(math.pi / math.asin(math.sin(half) / math.sin(gamma))) - 1
    demand(
        "geometry.n_rollers must be so small that the rollers fit beside each other",
        xp.sin(half) < xp.sin(gamma) * math.sin(math.pi / max(n_rollers, 2)),
        lambda: (
            f"geometry.n_rollers: {n_rollers} rollers of big-end diameter {metres(diameter)} do not fit on a circle of "
            f"radius {metres(radius)}, at most {most()}"
        ),
    )
    height = xp.sqrt(xp.where(fits, end_radius**2 - 0.25 * diameter**2, 0.0))
    contact_radius = radius + end_radius * xp.sin(flange) - height * xp.sin(gamma)
    cone_big_end = diameter / (2.0 * xp.sin(half)) * xp.sin(cone)
    # angles of the contact at the rim of the end face, and (its sine) where the rib meets the cone
    rim = gamma - xp.arcsin(0.5 * diameter / end_radius)
    foot = (cone_big_end - radius + height * xp.sin(gamma)) / end_radius
    lowest = xp.where(foot < xp.sin(gamma), xp.maximum(rim, xp.arcsin(xp.clip(foot, 0.0, 1.0))), math.inf)
    demand(
        "geometry.flange_angle: an angle must exist that puts the contact of the rib on the roller's end face",
        lowest < gamma,
        lambda: (
            f"geometry.flange_angle: no angle puts the contact of the rib on the roller's end face; an end_radius of "
            f"{metres(end_radius)} does not fit the other sizes"
        ),
    )

    def why() -> str:
        if flange >= gamma:
            return "the roller end would not touch the rib below its axis"
        if flange <= rim:
            return "the contact lies beyond the roller's end face"
        return f"the contact, at radius {metres(contact_radius)}, lies below the cone's big end, {metres(cone_big_end)}"

    demand(
        "geometry.flange_angle must put the contact of the rib on the roller's end face, below its axis",
        (lowest < flange) & (flange < gamma),
        lambda: (
            f"geometry.flange_angle must be above {degrees(lowest)} and below {degrees(gamma)} (the roller axis) with "
            f"an end_radius of {metres(end_radius)}, got {degrees(flange)}: {why()}"
        ),
    )
