r"""The tapered roller bearing as a scene: geometry, materials, oil, contact laws, operating point.

Frames and signs are those of ball bearings. Axial load and displacement push the inner ring (the cone) along $+e_x$,
radial ones along azimuth 0. A positive moment or tilt moves azimuth 0 of the inner ring along $+e_x$. Here $+e_x$
points from the rollers' big ends towards the common apex of the cones, so that a positive axial load presses the
bearing together. Loads and displacements are those of the *reference point* on the axis, at the distance
`operation.load_position` from the apex: by default the apex itself. (The source's tilt t and moment M_1 have the
opposite sense: $t = -$tilt.)
"""

import dataclasses
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, ClassVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from ..._scene import label, number
from ..._types import Scalar
from ...contacts import LineContact
from ...contacts.laws import ContactLaws
from ...contacts.point_laws import PointLaws
from ...lubricants import Lubricant
from ...mounting import Fits, PartTemperatures
from ...numerics.refusals import refusals_of, refuse_all
from ...thermal.settings import Thermal
from ...thermal.shares import OilTemperatures
from ..bearing import AbstractBearing
from ..facts import RangeChecks
from ..growth import Growth, Play
from ..mounted import mounting_problems
from ..operation import AbstractOperation
from ..outline import Outline
from ..parts import Drag, Materials
from ..profile import RollerProfile
from ..rated import RatedContacts
from ..rating import Rating
from ..ring_shape import (
    FlexibleInnerRing,
    FlexibleRing,
    InnerRoundness,
    OuterRoundness,
    bending_problems,
    said_of_bending,
)
from ..solution import LaminaLoads
from ..supplied import supply_problems
from ..warm import thermal_problems
from ..warming.settings import WarmUpSimulation
from .checks import CHECKS
from .geometry import TaperedCage, TaperedGeometry
from .mounting import closing, raceway_diameters, running_play
from .outline import tapered_outline
from .rating import rated_contacts

if TYPE_CHECKING:
    from .solution import TaperedResults

LOAD_POSITION = "reference point from the apex (of the rollers' middle: negative)"
"""Label of the field `load_position`."""


class TaperedOperation(AbstractOperation):
    """Operating point of a tapered roller bearing: the batched part of a sweep.

    It needs an axial load towards the apex, or an axial displacement. If no load or displacement across the axis is
    given, all rollers are alike, and only one of them is solved for.

    **Arguments:** those of `AbstractOperation`, at the reference point, and
    - `load_position`: position of the reference point along the axis, from the common apex of the cones, m. The rollers
      are on the negative side: the middle of their row is at `middle_position` of the scene, a negative number.
    """

    load_position: Scalar = number(0.0, kw_only=True, metadata=label("m", LOAD_POSITION))

    def _conflicts(self) -> Iterator[str | ValueError]:
        yield from super()._conflicts()
        if self.load("axial") is None and self.held_at("axial") is None:
            yield (
                "operation.axial_load: found nothing, expected a force, e.g. '1 kN', which is required where "
                "operation.displacement.axial is not given"
            )


class TaperedRollerBearing(AbstractBearing):
    """A steady single-row tapered roller bearing under axial load, radial load and moment.

    The rollers roll without sliding about the apex (`friction`), unless the scene has a cage (`skidding`). Results are
    loads of raceways and rib, displacements, films and friction losses. A part that is `None` is not modelled.

    - `contact`: laws of the raceway contacts: films and, if given, rolling resistance and traction. Without a `cage`
      the traction has no effect on the motion. It tells whether the films can carry the forces that keep the rollers
      rolling.
    - `cage`: with it and `contact.traction`, rollers may skid: their spins and the speed of the cage are unknowns.
    - `rib`: laws of the contacts of roller ends and rib: film and, if given, traction.
    - `drag`: oil drag on the orbiting rollers.
    - `profile`: laminae and profile of the rollers; `None`: rollers are straight, and contacts are integrated in closed
      form.
    - `fits`: fits of the rings on the shaft and in the housing.
    - `temperatures`: temperatures of the parts.
    - `outer_ring`: flexible cup, which bends in its plane; `None`: it is rigid.
    - `inner_ring`: flexible cone, which bends in its plane; `None`: it is rigid.
    - `inner_roundness`, `outer_roundness`: deviations of a raceway that is not round, stationary relative to the load.
    - `closing`: changes of the approaches of inner race, outer race and rib by growth, m (`mounting.closing`). The
      solver computes them for a scene with `fits`. A user leaves them out.

    **Raises:** `ValueError` for combinations that lack a required part.
    """

    kind: ClassVar[str] = "tapered_roller_bearing"
    required_part: ClassVar[str] = "[contact]"

    geometry: TaperedGeometry
    materials: Materials
    operation: TaperedOperation
    oil: Lubricant | None = None
    contact: ContactLaws | None = None
    profile: RollerProfile | None = None
    rating: Rating | None = None
    rib: PointLaws | None = None
    cage: TaperedCage | None = None
    drag: Drag | None = None
    fits: Fits | None = None
    temperatures: PartTemperatures | None = None
    thermal: Thermal | None = None
    simulation: WarmUpSimulation | None = None
    oil_temperatures: OilTemperatures | None = None
    closing: Float[Array, "3"] | None = None
    outer_ring: FlexibleRing | None = None
    inner_ring: FlexibleInnerRing | None = None
    inner_roundness: InnerRoundness | None = None
    outer_roundness: OuterRoundness | None = None

    def __check_init__(self):
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        yield from mounting_problems(self)
        yield from thermal_problems(self)
        yield from supply_problems(self)
        yield from bending_problems(self, self.operation, lambda: self.raceway_diameters[0], self.ring_width)
        if self.contact is None:
            if self.rib is not None:
                yield "contact: a scene with laws of the rib needs those of the raceways"
            return
        if self.oil is None:
            yield "oil: a scene with a [contact] table needs an oil"
        if self.cage is not None:
            yield from refusals_of(self.cage.check_fits, self.geometry)
        needing = {"the cage land": self.slips, "the drag": self.drag is not None}
        if self.oil is not None and self.oil.density is None and any(needing.values()):
            names = [name for name, needs in needing.items() if needs]
            yield f"oil.density: {' and '.join(names)} need{'s' * (len(names) == 1)} it"
        if self.rib is not None and self.rib.resists_rolling:
            yield "rib.rolling: the rib has none, the roller ends slide on it"
        yield from refusals_of(self.operation.check_rings_turn)

    play_is_clearance: ClassVar[bool] = False

    @property
    def raceway_diameters(self) -> tuple[Array, Array]:
        return raceway_diameters(self.geometry)

    @property
    def ring_width(self) -> Scalar:
        """Default width of flexible rings, m: the width of the bearing, or the roller length if no width is given."""
        return self.geometry.roller_length if self.geometry.width is None else self.geometry.width

    def play(self, growth: Growth) -> Play:
        return running_play(self.geometry, growth)

    def grown(self, growth: Growth) -> "TaperedRollerBearing":
        return dataclasses.replace(self, closing=closing(self.geometry, growth))

    def range_checks(self) -> RangeChecks:
        return CHECKS

    def outline(self, of: Callable[[str], float] | None = None) -> Outline:
        return tapered_outline(self)

    def rated_contacts(
        self, elements: "TaperedResults | None", laminae: LaminaLoads | None, force: Array | None = None
    ) -> RatedContacts:
        return rated_contacts(self, laminae, force)

    @property
    def slips(self) -> bool:
        """True if roller and cage speeds are unknowns. Without a cage, or without traction, they are those of pure
        rolling."""
        return self.cage is not None and self.contact is not None and self.contact.traction is not None

    @property
    def dissipates(self) -> bool:
        if self.contact is None:
            return False
        slides = self.rib is not None and self.rib.traction is not None
        return self.contact.resists_rolling or slides or self.drag is not None or self.slips

    def race_lines(self, elements: "TaperedResults | None") -> LineContact:
        radii = self.geometry.race_reduced_radii(jnp.asarray(0.5))[:, None]
        return LineContact(radii, jnp.asarray(self.geometry.roller_length), self.materials.race_modulus)

    @property
    def ring_lever(self) -> Array:
        """Lever by which the equations multiply the tilts of the ring, m."""
        return self.geometry.apex_distance

    @property
    def port_distance(self) -> Array:
        r"""Distance of the loads' reference point from the plane of the rollers' middles along $+e_x$, m: the sum of
        $(\frac{D_w}{2\tan\epsilon} - \frac{l_w}2\cos\epsilon)\cos\gamma$, which is the distance to the apex, and
        `load_position`."""
        geometry, half = self.geometry, jnp.asarray(self.geometry.roller_half_angle)
        along = 0.5 * geometry.roller_diameter / jnp.tan(half) - 0.5 * geometry.roller_length * jnp.cos(half)
        return along * jnp.cos(geometry.axis_angle) + self.operation.load_position

    @property
    def middle_position(self) -> Array:
        """Position of the middle of the row of rollers, counted as `load_position`, m: a negative number."""
        return self.operation.load_position - self.port_distance

    def unused_parts(self) -> tuple[str, ...]:
        """Tables that the scene names but that have no effect."""
        named: dict[str, object] = {"cage": None if self.slips else self.cage}
        if self.contact is None:
            named |= {"oil": self.oil if self.rating is None else None, "drag": self.drag}
        return tuple(name for name, part in named.items() if part is not None)

    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: assumptions of the model, and uses for which its data were not made."""
        notes = self.geometry.assumptions() + said_of_bending(self)
        if self.contact is not None and self.oil is not None:
            notes += [f"oil: {note}" for note in self.oil.notes]
            laws = (self.contact.traction, None if self.rib is None else self.rib.traction)
            notes += dict.fromkeys(note for law in laws if law is not None for note in law.notes(self.oil))
        if self.slips and self.cage is not None:
            notes += self.cage.assumptions()
        return tuple(notes)
