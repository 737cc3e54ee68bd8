"""Geometry of a cylindrical roller bearing, of its cage, and of the flanges that guide its rollers."""

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import jax.numpy as jnp

from ..._types import Scalar
from ...materials import check_interference
from ...numerics.checks import Checked, demand, numbers_or_none
from ...numerics.refusals import refusals_of, refuse_all
from ...numerics.structure import choice, count
from ..cage import AbstractCage
from ..parts import FIRST_ELEMENT, AbstractGeometry, check_between, check_row_fits, number, optional_number
from .thrust import SIDES, ThrustFlanges, check_flanges

ASSUMED_CAGE_INNER = 7.0 / 12.0
"""Default of the cage bore: (pitch diameter - cage bore) / roller diameter."""
ASSUMED_CAGE_OUTER = 4.0 / 12.0
"""Default of the cage outside diameter: (cage outside diameter - pitch diameter) / roller diameter."""
ASSUMED_FLANGE_HEIGHT = 2.5 / 12.0
"""Default of the flange height over the roller diameter."""


class RollerGeometry(AbstractGeometry):
    """Main dimensions of a cylindrical roller bearing, m.

    **Arguments:**
    - `n_rollers`: number of rollers (structure: another number recompiles).
    - `pitch_diameter`, `roller_diameter`, `roller_length` (of the whole roller): m, > 0.
    - `contact_length`: length of the cylindrical part that carries load, m, > 0; `roller_length` where not given.
    - `diametral_clearance`: DIAMETRAL internal clearance of the assembled bearing, m; negative: preload.
    - `first_element_angle`: azimuth of the first roller, rad; not given: 0, and the load line is a line of symmetry.
    - `flange_stiffness`: k of the axial force k x^(10/9) of a flange, where x is the axial displacement of the inner
      ring beyond first contact, N/m^(10/9), > 0; not given: the ring has no axial support (types N and NU).
    - `flange_gap`: axial displacement of the inner ring, from the middle of its play, at which it touches a flange, m,
      >= 0; half of the axial clearance between two flanges; required with `flange_stiffness`.
    - `thrust`: direction of the axial loads on the inner ring that its flanges carry, "+x" or "-x" (type NJ) or "both"
      (type NUP); not given: both (structure).
    - `bore`, `outside_diameter`, `width`: boundary dimensions of the bearing, m, used for fits, thermal networks and
      flexible rings.
    """

    part: ClassVar[str] = "geometry"

    n_rollers: int = count("geometry.n_rollers")
    pitch_diameter: Scalar = number(bound="> 0", unit="m")
    roller_diameter: Scalar = number(bound="> 0", unit="m")
    roller_length: Scalar = number(bound="> 0", unit="m")
    diametral_clearance: Scalar = number(unit="m")
    contact_length: Scalar | None = optional_number(bound="> 0", unit="m")
    first_element_angle: Scalar | None = optional_number(metadata=FIRST_ELEMENT)
    flange_stiffness: Scalar | None = optional_number(bound="> 0", unit="N/m^(10/9)")
    flange_gap: Scalar | None = optional_number(bound=">= 0", unit="m")
    thrust: Literal["both", "+x", "-x"] | None = choice("geometry.thrust", SIDES, None)
    bore: Scalar | None = optional_number(bound="> 0", unit="m")
    outside_diameter: Scalar | None = optional_number(bound="> 0", unit="m")
    width: Scalar | None = optional_number(bound="> 0", unit="m")

    @property
    def n_elements(self) -> int:
        return self.n_rollers

    @property
    def element_diameter(self) -> Scalar:
        return self.roller_diameter

    def __check_init__(self):
        super().__check_init__()
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        yield from refusals_of(check_row_fits, self.n_rollers, self.roller_diameter, self.pitch_diameter)
        clearance = numbers_or_none(self.diametral_clearance)
        if clearance is not None:
            name = "geometry.diametral_clearance"
            yield from refusals_of(check_interference, name, -clearance[0], self.pitch_diameter)
            yield from refusals_of(_check_play, self.diametral_clearance, self.pitch_diameter)
        yield from refusals_of(check_flanges, self)
        sizes = numbers_or_none(self.contact_length, self.roller_length)
        if sizes is not None:
            yield from refusals_of(
                demand,
                "geometry.contact_length must be at most the roller length",
                sizes[0] <= sizes[1],
                lambda: (
                    f"geometry.contact_length must be at most the roller length, {float(sizes[1]):.6g} m, got "
                    f"{float(sizes[0]):.6g} m"
                ),
            )

    @property
    def loaded_length(self) -> Scalar:
        """Length of the raceway contacts, m."""
        return self.roller_length if self.contact_length is None else self.contact_length

    @property
    def thrust_flanges(self) -> ThrustFlanges | None:
        """Flanges that support the inner ring axially; `None` if there are none."""
        if self.flange_stiffness is None:
            return None
        return ThrustFlanges(
            jnp.asarray(self.flange_stiffness), jnp.asarray(self.flange_gap), SIDES[self.thrust or "both"]
        )

    @property
    def pitch_radius(self) -> Scalar:
        return self.pitch_diameter / 2.0

    @property
    def roller_radius(self) -> Scalar:
        return self.roller_diameter / 2.0

    @property
    def inner_radius(self) -> Scalar:
        """Radius of the inner raceway, m."""
        return self.pitch_radius - self.roller_radius

    @property
    def outer_radius(self) -> Scalar:
        """Radius of the outer raceway, m."""
        return self.pitch_radius + self.roller_radius


class RollerCage(AbstractCage[RollerGeometry]):
    """One-piece cage, guided by one ring on `n_lands` lands, with a pocket film in front of and behind each roller.

    **Arguments:** those of `AbstractCage`, and
    - `pocket_clearance`: TOTAL circumferential clearance of a roller in its pocket, m, > 0.
    - `pocket_axial_clearance`: TOTAL axial clearance of a roller between the cage rails, m; not given: the films
      between roller ends and rails are not modelled.
    """

    element: ClassVar[str] = "roller"
    assumed_inner: ClassVar[float] = ASSUMED_CAGE_INNER
    assumed_outer: ClassVar[float] = ASSUMED_CAGE_OUTER

    pocket_axial_clearance: Scalar | None = optional_number(bound="> 0", unit="m")

    def pocket_opening(self, geometry: RollerGeometry) -> tuple[Scalar, Scalar]:
        axial = 0.0 if self.pocket_axial_clearance is None else self.pocket_axial_clearance
        return geometry.roller_length + axial, geometry.roller_diameter + self.pocket_clearance

    def mass_and_inertia(self, geometry: RollerGeometry, density: Scalar) -> tuple[Scalar, Scalar]:
        """Mass, kg, and moment of inertia about the axis, kg m^2, of a ring with a rectangular pocket for each roller.

        The width of the ring is the roller length, the axial clearance in the pocket and the lands together. In the
        inertia a pocket is a point mass at mid-radius; its real extent would reduce the inertia by another 0.4 %."""
        inner, outer = self.bore(geometry) / 2.0, self.outside(geometry) / 2.0
        (pocket_width, length), depth = self.pocket_opening(geometry), outer - inner
        width = pocket_width + self.lands * self.land_width
        ring = density * math.pi * (outer * outer - inner * inner) * width
        pockets = geometry.n_rollers * density * pocket_width * length * depth
        middle = 0.5 * (inner + outer)
        inertia = 0.5 * ring * (inner * inner + outer * outer) - pockets * middle * middle
        return ring - pockets, inertia


class RollerFlange(Checked):
    """Flanges that guide the rollers axially, on the inner ring, the outer ring or both. They cause film friction only;
    axial loads on the inner ring are carried by `geometry.flange_stiffness`.

    **Arguments:**
    - `ring`: "inner", "outer" or "both".
    - `axial_clearance`: TOTAL axial clearance of a roller between its two flanges, m.
    - `angle`: flange opening angle, rad.
    - `height`: height of the flange above the raceway, m; assumed from the roller diameter where not given.
    """

    part: ClassVar[str] = "flange"

    ring: Literal["inner", "outer", "both"] = choice("flange.ring", ("inner", "outer", "both"))
    axial_clearance: Scalar = number(bound="> 0", unit="m")
    angle: Scalar = number(0.0, bound=">= 0 and below 90 degrees", unit="rad")
    height: Scalar | None = optional_number(bound="> 0", unit="m")

    def rim_height(self, geometry: RollerGeometry) -> Scalar:
        return ASSUMED_FLANGE_HEIGHT * geometry.roller_diameter if self.height is None else self.height


LARGEST_PLAY = 0.1
"""Diametral clearance over pitch diameter above which a wrong unit is assumed; real bearings have at most 0.002."""


def _check_play(clearance: object, pitch_diameter: object) -> None:
    """**Raises:** `ValueError` for a diametral clearance, m, above `LARGEST_PLAY` times the pitch diameter, m."""
    sizes = numbers_or_none(clearance, pitch_diameter)
    if sizes is None:
        return
    demand(
        "geometry.diametral_clearance must be at most a tenth of the pitch diameter",
        sizes[0] <= LARGEST_PLAY * sizes[1],
        lambda: (
            f"geometry.diametral_clearance: found {1e3 * float(sizes[0]):g} mm on a pitch diameter of "
            f"{1e3 * float(sizes[1]):g} mm, expected at most a tenth of it; check the unit"
        ),
    )


def check_height(flange: RollerFlange, geometry: RollerGeometry) -> None:
    """**Raises:** `ValueError` for a flange height that is not between 0 and the roller diameter (half of it, if both
    rings have flanges)."""
    sizes = numbers_or_none(flange.rim_height(geometry), geometry.roller_diameter)
    if sizes is not None:
        height, roller = sizes
        limit = roller / 2.0 if flange.ring == "both" else roller
        check_between("flange.height", height, 0.0, limit, "raceway", "what the roller leaves to it")
