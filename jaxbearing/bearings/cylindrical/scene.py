"""The cylindrical roller bearing as a scene: geometry, materials, oil, contact laws, cage, flange, drag.

Frames and signs. The plane (X, Y) has its origin at the bearing centre. Azimuths count from the load line,
counter-clockwise, which is the sense of inner ring rotation. The load on the inner ring and its displacement point
along azimuth 0; n is the outward unit vector at a roller, t the unit vector forward along the orbit. Spins are relative
to the orbiting frame and positive in normal running: a roller between a turning inner and a fixed outer ring spins
clockwise, so that its counter-clockwise spin is minus `spin_speed`. Pocket wall 1 is in front of the roller, wall 2
behind it.
"""

import dataclasses
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, ClassVar

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

from ..._types import Scalar
from ...contacts import LineContact, RigidRollingResistance
from ...lubricants import Lubricant, NoPressureViscosity
from ...mounting import Fits, PartTemperatures
from ...numerics.refusals import refusals_of, refuse_all
from ...thermal.settings import Thermal
from ...thermal.shares import OilTemperatures
from ..cage import ASSUMED_LANDS as ASSUMED_LANDS
from ..facts import RangeChecks
from ..growth import Growth, Play
from ..motion.family import AbstractMovingBearing
from ..motion.settings import Simulation
from ..mounted import mounting_problems
from ..operation import Operation
from ..outline import Outline
from ..parts import ContactLaws, Drag, Materials
from ..profile import RollerProfile
from ..rated import RatedContacts
from ..rating import Rating
from ..ring_shape import (
    FlexibleInnerRing,
    FlexibleRing,
    InnerRoundness,
    OuterRoundness,
    bending_problems,
    moving_problems,
    said_of_bending,
)
from ..solution import RING_FREEDOMS, LaminaLoads
from ..supplied import supply_problems
from ..warm import thermal_problems
from ..warming.settings import WarmUpSimulation
from .checks import CHECKS
from .geometry import ASSUMED_FLANGE_HEIGHT, RollerCage, RollerFlange, RollerGeometry, check_height
from .mounting import running_geometry, running_play
from .outline import roller_outline
from .rating import rated_contacts
from .thrust import NOT_MODELLED, check_axial

if TYPE_CHECKING:
    from .solution import RollerResults

_ACROSS = ("radial", "lateral", "tilt", "tilt_lateral")
"""Degrees of freedom of the inner ring that load the rollers."""


def _freedoms(value: object) -> tuple[str, ...]:
    """Converts `ring_freedom` to a tuple. **Raises:** `ValueError` if it is not one of the two that are possible."""
    if isinstance(value, list | tuple) and tuple(map(str, value)) in (("radial",), ("radial", "lateral")):
        return tuple(map(str, value))
    raise ValueError(f"ring_freedom must be ('radial',) or ('radial', 'lateral'), got {value!r}")


class CylindricalRollerBearing(AbstractMovingBearing):
    """A cylindrical roller bearing under radial load, steady or in a transient run.

    Every part except geometry, materials and operation may be `None`. Such a part is not modelled: it adds no unknowns,
    no equations and no run time.

    - `contact=None`: dry and frictionless. Only the load distribution is solved, and rollers orbit without slip.
    - `contact.traction=None`: films and, if given, rolling resistance, but no sliding friction on the raceways. Rollers
      orbit without slip.
    - With `contact.traction`, a steady solve needs a `cage`: without it, a roller outside the loaded zone has no steady
      state. Only a scene with a `simulation` may leave the cage out.
    - `profile`, or `operation.misalignment` or `operation.moment`: rollers may tilt, divided into laminae if they have
      a `profile`. Films, friction and cage are modelled as without tilt. A run of rollers and cage in motion does not
      have it.
    - `geometry.flange_stiffness`: flanges hold the ring along its axis. This axial degree of freedom is independent of
      all others.
    - `outer_ring`: flexible outer ring in its housing; `None`: it is rigid. A run of rollers and cage in motion
      requires rigid rings.
    - `inner_ring`: flexible inner ring on its shaft; `None`: it is rigid. A run of rollers and cage in motion requires
      rigid rings.
    - `inner_roundness`, `outer_roundness`: deviations of a raceway that is not round, stationary relative to the load.
    - `simulation`: settings of a transient run, or a `WarmUpSimulation` if the scene has `thermal`. A steady solve
      ignores it.

    **Raises:** `ValueError` for combinations that have no steady state or lack a required part.
    """

    kind: ClassVar[str] = "cylindrical_roller_bearing"

    geometry: RollerGeometry
    materials: Materials
    operation: Operation
    oil: Lubricant | None = None
    contact: ContactLaws | None = None
    cage: RollerCage | None = None
    flange: RollerFlange | None = None
    drag: Drag | None = None
    simulation: Simulation | WarmUpSimulation | None = None
    ring_freedom: tuple[str, ...] = eqx.field(static=True, converter=_freedoms, default=("radial",))
    rating: Rating | None = None
    profile: RollerProfile | None = None
    fits: Fits | None = None
    temperatures: PartTemperatures | None = None
    thermal: Thermal | None = None
    oil_temperatures: OilTemperatures | None = None
    outer_ring: FlexibleRing | None = None
    inner_ring: FlexibleInnerRing | None = None
    inner_roundness: InnerRoundness | None = None
    outer_roundness: OuterRoundness | None = None

    def __check_init__(self):
        refuse_all(self._problems())

    def _problems(self) -> Iterator[str | ValueError]:
        yield from refusals_of(check_axial, self.geometry, self.operation)
        yield from mounting_problems(self)
        yield from thermal_problems(self)
        yield from supply_problems(self)
        moves = isinstance(self.simulation, Simulation) and self.thermal is None
        yield from bending_problems(self, self.operation, lambda: self.raceway_diameters[0], self.ring_width)
        if moves:
            yield from moving_problems(self, round_races=False)
            yield from refusals_of(check_run, self.operation, self.profile)
        if self.contact is None:
            return
        if self.cage is not None:
            yield from refusals_of(self.cage.check_fits, self.geometry)
        if self.flange is not None:
            yield from refusals_of(check_height, self.flange, self.geometry)
        yield from refusals_of(self.operation.check_rings_turn)
        if self.slips and self.cage is None and not moves:
            ways = "or leave out contact.traction" if self.tilts else "leave out contact.traction, or use simulate"
            yield (
                "cage: a lubricated bearing with traction and without a cage has no steady state (a roller outside the "
                f"loaded zone slows down for ever); give it a cage, {ways}"
            )
        if self.oil is None:
            yield "oil: a scene with a [contact] table needs an oil"
            return
        if self.slips and (self.oil.density is None):
            yield "oil.density: the cage land and the drag need it"
        if isinstance(self.oil.pressure_viscosity, NoPressureViscosity):
            laws = {"film": self.contact.film, "rolling_resistance": self.contact.rolling}
            for name, law in laws.items():
                if law is not None and law.piezoviscous_only:
                    yield (
                        f"contact.{name}: {type(law).__name__} holds for oils whose viscosity rises with pressure, not "
                        "for an isoviscous one; film = 'moes' and rolling_resistance = 'full_range' do"
                    )

    @property
    def raceway_diameters(self) -> tuple[Array, Array]:
        geometry = self.geometry
        return (
            jnp.asarray(geometry.pitch_diameter - geometry.roller_diameter),
            jnp.asarray(geometry.pitch_diameter + geometry.roller_diameter),
        )

    @property
    def roller_mass(self) -> Array:
        """Mass of a roller, kg."""
        radius = jnp.asarray(self.geometry.roller_radius)
        return self.materials.rollers.density * jnp.pi * radius**2 * self.geometry.roller_length

    @property
    def ring_width(self) -> Scalar:
        """Default width of flexible rings, m: the width of the bearing, or the roller length if no width is given."""
        return self.geometry.roller_length if self.geometry.width is None else self.geometry.width

    def play(self, growth: Growth) -> Play:
        return running_play(self.geometry, growth)

    def grown(self, growth: Growth) -> "CylindricalRollerBearing":
        return dataclasses.replace(self, geometry=running_geometry(self.geometry, growth))

    def range_checks(self) -> RangeChecks:
        return CHECKS

    def outline(self, of: Callable[[str], float] | None = None) -> Outline:
        return roller_outline(self)

    def rated_contacts(
        self, elements: "RollerResults | None", laminae: LaminaLoads | None, force: Array | None = None
    ) -> RatedContacts:
        return rated_contacts(self, elements, laminae, force)

    def with_lateral_freedom(self) -> "CylindricalRollerBearing":
        return self if self.tilts else self.replace({"ring_freedom": ("radial", "lateral")})

    @property
    def modelled_freedoms(self) -> tuple[str, ...]:
        return RING_FREEDOMS if self.geometry.flange_stiffness is not None else _ACROSS

    @property
    def unknown_freedoms(self) -> tuple[str, ...]:
        """See `AbstractBearing`. The axial one is left out, because it follows in closed form."""
        return tuple(name for name in super().unknown_freedoms if name in _ACROSS)

    @property
    def skewed(self) -> bool:
        return super().skewed or "lateral" in self.ring_freedom

    @property
    def tilts(self) -> bool:
        """True if rollers may tilt; otherwise they carry evenly along their length."""
        return self.profile is not None or self.operation.tilts

    @property
    def ring_lever(self) -> Array:
        """Lever by which the equations multiply the tilts of the ring, m."""
        return jnp.asarray(self.geometry.loaded_length)

    @property
    def port_distance(self) -> Array:
        """Distance of the ring's reference point from the middle of the rollers along $+e_x$, m: 0."""
        return jnp.zeros(())

    @property
    def slips(self) -> bool:
        """True if roller and cage speeds are unknowns. Without traction they are those of rolling without slip."""
        return self.contact is not None and self.contact.traction is not None

    @property
    def dissipates(self) -> bool:
        return self.contact is not None and (self.slips or self.contact.resists_rolling)

    def race_lines(self, elements: "RollerResults | None") -> LineContact:
        length = jnp.asarray(self.geometry.loaded_length)
        roller, races = 0.5 * jnp.asarray(self.geometry.roller_diameter), jnp.stack(self.raceway_diameters)[:, None]
        radii = 1.0 / (1.0 / roller + jnp.asarray([[2.0], [-2.0]]) / races)
        return LineContact(radii, length, self.materials.race_modulus)

    def unused_parts(self) -> tuple[str, ...]:
        """Tables that the scene names but that have no effect without traction on the raceways."""
        if self.slips:
            return ()
        named = {"cage": self.cage, "flange": self.flange, "drag": self.drag}
        if self.contact is None:
            named["oil"] = None if self.rating is not None else self.oil
        return tuple(name for name, part in named.items() if part is not None)

    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: assumptions of the model, and uses for which the scene's data were not made."""
        notes = []
        if self.contact is not None and self.oil is not None:
            notes += [f"oil: {note}" for note in self.oil.notes]
            notes += _misfit(self.contact, self.oil)
        if self.geometry.flange_stiffness is not None:
            notes.append(NOT_MODELLED)
        if self.geometry.contact_length is None:
            notes.append("geometry.contact_length is not given: the whole roller length carries load")
        if self.slips and self.cage is not None:
            notes += self.cage.assumptions()
        notes += said_of_bending(self)
        if self.slips and self.flange is not None and self.flange.height is None:
            notes.append(f"flange.height is not given: assumed {ASSUMED_FLANGE_HEIGHT:.3f} of the roller diameter")
        return tuple(notes)


def check_run(operation: Operation, profile: RollerProfile | None) -> None:
    """Checks the operating point of a transient run, and that its rollers carry evenly along their length.

    **Raises:** `ValueError` for given displacements, an axial load, or no radial load; for a moment, a misalignment or
    a profile of the rollers.
    """
    names = ("moment", "moment_lateral", "misalignment", "misalignment_lateral")
    tilting = [f"operation.{name}" for name in names if getattr(operation, name) is not None]
    tilting += [] if profile is None else ["profile"]
    if tilting:
        raise ValueError(
            f"{tilting[0]}: expected none in a transient run, where rollers carry evenly along their length"
        )
    if operation.displaced:
        raise ValueError("operation.displacement: expected none in a transient run, where loads move the ring")
    if operation.axial_given:
        name = "displacement.axial" if operation.axial_load is None else "axial_load"
        raise ValueError(f"operation.{name}: a transient run moves the ring across the axis only")
    if operation.radial_load is None:
        raise ValueError("operation.radial_load: a transient run needs one")


def _misfit(contact: ContactLaws, oil: Lubricant) -> list[str]:
    """Notes on laws that were not made for this oil."""
    notes = []
    if contact.traction is not None:
        notes += contact.traction.notes(oil)
    isoviscous = isinstance(oil.pressure_viscosity, NoPressureViscosity)
    if isinstance(contact.rolling, RigidRollingResistance) and not isoviscous:
        notes.append(
            "contact.rolling_resistance leaves out the rise of viscosity with pressure: about half the resistance of a "
            "loaded contact (full_range has it)"
        )
    return notes
