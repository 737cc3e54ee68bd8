"""The ball bearing as a scene: geometry, materials, oil, contact laws, cage, drag, attitude of the balls.

Frames and signs. $e_x$ points along the bearing axis. Azimuths count from the load line, counter-clockwise, which is
the direction of rotation of the inner ring. A positive axial load or displacement pushes the inner ring along $+e_x$, a
positive radial one along azimuth 0; a positive moment or tilt moves azimuth 0 of the inner ring along $+e_x$. Contact
angles are positive where the inner race pushes the ball along $+e_x$. The cross-section of a groove arc is taken as a
full circle; range checks use `geometry.shoulder_angle_*` as the angle at which the groove ends.
"""

import dataclasses
import functools
import math
import operator
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, ClassVar, Literal

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array

from ..._types import Scalar
from ...contacts import PointContact
from ...contacts.point_laws import PointLaws
from ...gaps.ball_pocket import SUPERPOSITIONS
from ...lubricants import Lubricant, NoPressureViscosity
from ...materials import BALL_PRESSURE, Material
from ...mounting import Fits, PartTemperatures
from ...numerics.checks import demand, numbers_or_none
from ...numerics.refusals import refusals_of, refuse_all
from ...numerics.structure import choice
from ...thermal.settings import Thermal
from ...thermal.shares import OilTemperatures
from ..cage import ASSUMED_LANDS as ASSUMED_LANDS
from ..cage import AbstractCage
from ..facts import RangeChecks
from ..growth import Growth, Play
from ..motion.family import AbstractMovingBearing
from ..motion.settings import Simulation
from ..mounted import mounting_problems
from ..operation import LOAD_FIELDS, AbstractOperation
from ..outline import Outline
from ..parts import AbstractMaterials, DragSettings
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
from ..solution import LaminaLoads
from ..supplied import supply_problems
from ..warm import thermal_problems
from ..warming.settings import WarmUpSimulation
from .checks import CHECKS
from .geometry import BallGeometry
from .gyroscopic import AbstractGyroscopic, ResolvedCouple
from .mounting import groove_bottoms, running_geometry, running_play
from .outline import ball_outline
from .rating import rated_contacts

if TYPE_CHECKING:
    from .solution import BallResults

ASSUMED_CAGE_THICKNESS = 0.4
"""Radial thickness of the cage over the ball diameter, assumed if a scene does not give the diameters of the cage."""


class BallOperation(AbstractOperation):
    """Operating point of a ball bearing: the batched part of a sweep.

    It needs a load or a prescribed displacement of the ring. If none is given perpendicular to the axis, all balls are
    alike, and only one of them is solved for.

    **Arguments:** those of `AbstractOperation`.
    """

    def _conflicts(self) -> Iterator[str | ValueError]:
        yield from super()._conflicts()
        loads = [load for load in map(self.load, LOAD_FIELDS) if load is not None]
        if self.displaced:
            return
        if not loads:
            yield (
                "operation.axial_load: a ball bearing needs an axial_load, a radial_load or a moment, or a displacement"
            )
        elif numbers_or_none(*loads) is not None:
            yield from refusals_of(
                demand,
                "operation.axial_load, radial_load or moment must differ from 0",
                functools.reduce(operator.or_, (abs(load) > 0 for load in loads)),
                lambda: "operation.axial_load: all loads are 0, and nothing holds the inner ring in its place",
            )


class BallMaterials(AbstractMaterials):
    """Materials of a ball bearing: `rings`, `balls` and, for transient runs, `cage`. If `inner_ring` is given, `rings`
    is the material of the outer ring only."""

    rings: Material
    balls: Material
    cage: Material | None = None
    inner_ring: Material | None = None

    @property
    def elements(self) -> Material:
        return self.balls


class BallAttitude(eqx.Module):
    """Model of the rotation of the balls.

    **Arguments:**
    - `attitude`: rule for the direction of the spin axis of a ball: "outer" or "inner" race control (no spin on that
      race), "linear_slip" (moment balance under tractions proportional to pressure and sliding, for dry bearings and
      for rings with two groove arcs without traction), "min_power" (least spin power), "equilibrium" (moment balance of
      the ball under its traction).
    - `gyroscopic`: law for the friction that carries the gyroscopic couple: `None` (couple left out), an
      `AbstractGyroscopic`, or `ResolvedCouple()`.
    - `orbit`: orbital speed of balls that roll without sliding: "own", for each ball from its contact angles, or
      "common", the mean of these speeds weighted by the inner loads.
    """

    attitude: Literal["outer", "inner", "linear_slip", "min_power", "equilibrium"] = choice(
        "kinematics.attitude", ("outer", "inner", "linear_slip", "min_power", "equilibrium"), "equilibrium"
    )
    gyroscopic: AbstractGyroscopic | ResolvedCouple | None = None
    orbit: Literal["own", "common"] = choice("kinematics.orbit", ("own", "common"), "own")

    def __check_init__(self):
        if isinstance(self.gyroscopic, ResolvedCouple) and self.attitude != "equilibrium":
            raise ValueError("kinematics.gyroscopic: 'resolved' needs kinematics.attitude = 'equilibrium'")


class BallCage(AbstractCage[BallGeometry]):
    """One-piece cage with cylindrical pockets, guided by one ring on `n_lands` lands.

    **Arguments:** those of `AbstractCage`, and
    - `pocket_clearance`: DIAMETRAL clearance, pocket diameter minus ball diameter, m, > 0.
    - `pocket_superposition`: rule that combines the film loads of the entrainment along and across the axis of a
      pocket: "root_of_squares" (exact) or "sum" (as in the source, up to 41 % more load).
    """

    element: ClassVar[str] = "ball"
    assumed_inner: ClassVar[float] = ASSUMED_CAGE_THICKNESS
    assumed_outer: ClassVar[float] = ASSUMED_CAGE_THICKNESS

    pocket_superposition: Literal["root_of_squares", "sum"] = choice(
        "cage.pocket_superposition", SUPERPOSITIONS, "root_of_squares"
    )

    def pocket_opening(self, geometry: BallGeometry) -> tuple[Scalar, Scalar]:
        hole = geometry.ball_diameter + self.pocket_clearance
        return hole, hole

    def land_places(self, geometry: BallGeometry) -> Array:
        """Axial positions of the middles of the lands relative to the ball centres, m: beside the pockets, evenly
        spaced."""
        if self.lands == 1:
            return jnp.zeros(1)
        side = 0.5 * (geometry.ball_diameter + self.pocket_clearance + self.land_width)
        return jnp.linspace(-1.0, 1.0, self.lands) * side

    def mass_and_inertias(self, geometry: BallGeometry, density: Scalar) -> tuple[Scalar, Scalar, Scalar]:
        """Mass, kg, and moments of inertia about the axis and about a diameter, kg m^2, of a ring as wide as pockets
        and lands together. The cylindrical holes of the pockets are subtracted from the mass; the moments of inertia
        are those of a full ring with this mass."""
        inner, outer = self.bore(geometry) / 2.0, self.outside(geometry) / 2.0
        hole, _ = self.pocket_opening(geometry)
        width = hole + self.lands * self.land_width
        ring = math.pi * (outer * outer - inner * inner) * width
        plugs = geometry.n_balls * 0.25 * math.pi * hole * hole * (outer - inner)
        mass = density * (ring - plugs)
        polar = 0.5 * mass * (inner * inner + outer * outer)
        return mass, polar, 0.5 * polar + mass * width * width / 12.0


class BallDragSettings(DragSettings):
    """Oil drag on the orbiting balls. If no coefficient is given, it is that of an isolated sphere."""


class BallBearing(AbstractMovingBearing):
    """A single-row ball bearing under any combination of axial load, radial load and moment.

    - `contact=None`: dry and frictionless: loads, contact angles and motion without traction, with
      `kinematics.attitude` "outer", "inner" or "linear_slip".
    - `contact.traction=None`: films too, and the rolling resistance if its law is given; balls roll without sliding.
    - With traction the balls slide and spin; without a `cage` every ball has its own orbital speed.
    - `outer_ring`: a flexible outer ring in its housing; `inner_ring`: a flexible inner ring on its shaft;
      `None`: the ring is rigid. `inner_roundness`, `outer_roundness`: raceways that are not round; their shape does not
      rotate relative to the load. In transient runs of the balls both rings are rigid and round.
    - `simulation`: settings of a transient run beyond the operating point; a steady solve ignores them.

    **Raises:** `ValueError` for combinations of parts that have no steady state, or that lack a required part.
    """

    kind: ClassVar[str] = "ball_bearing"
    element: ClassVar[str] = "ball"
    yield_pressure: ClassVar[float] = BALL_PRESSURE
    loads_over_time: ClassVar[tuple[str, ...]] = tuple(LOAD_FIELDS.values())

    geometry: BallGeometry
    materials: BallMaterials
    operation: BallOperation
    kinematics: BallAttitude = BallAttitude()
    oil: Lubricant | None = None
    contact: PointLaws | None = None
    cage: BallCage | None = None
    drag: BallDragSettings | None = None
    rating: Rating | None = None
    fits: Fits | None = None
    temperatures: PartTemperatures | None = None
    thermal: Thermal | None = None
    simulation: Simulation | WarmUpSimulation | None = None
    oil_temperatures: OilTemperatures | None = None
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
        yield from self._attitude_problems()
        yield from bending_problems(self, self.operation, lambda: self.raceway_diameters[0], self.geometry.width)
        if isinstance(self.simulation, Simulation) and self.thermal is None:
            yield from moving_problems(self, round_races=True)
        if self.slips and self.kinematics.orbit == "common":
            yield (
                "kinematics.orbit: 'common' is for balls that roll without sliding; with contact.traction they orbit "
                "with the cage, or without one each by its own balance of forces"
            )
        if self.contact is None:
            return
        if self.cage is not None:
            yield from refusals_of(self.cage.check_fits, self.geometry)
        if self.oil is None:
            yield "oil: a scene with a [contact] table needs an oil"
            return
        yield from refusals_of(self.operation.check_rings_turn)
        if self.slips and self.cage is not None and self.oil.density is None:
            yield "oil.density: the cage land and the drag need it"
        if isinstance(self.oil.pressure_viscosity, NoPressureViscosity) and self.contact.film.piezoviscous_only:
            yield (
                f"contact.film: {type(self.contact.film).__name__} holds for oils whose viscosity rises with pressure, "
                "not for an isoviscous one"
            )

    def _attitude_problems(self) -> Iterator[str]:
        attitude = self.kinematics.attitude
        if self.geometry.has_arcs:
            yield from self._arc_problems()
            return
        if not self.slips and attitude not in ("outer", "inner", "linear_slip"):
            yield (
                f"kinematics.attitude: '{attitude}' needs traction (contact.traction); without "
                "friction the attitude is that of 'outer' or 'inner' race control"
            )
        if self.contact is not None and attitude == "linear_slip":
            yield (
                "kinematics.attitude: 'linear_slip' is for bearings without films and friction; leave out [contact] or "
                "choose another attitude"
            )

    def _arc_problems(self) -> Iterator[str]:
        """Conflicts of rings with two groove arcs with other parts of the scene."""
        name = "shim_outer" if self.geometry.shim_inner is None else "shim_inner"
        if isinstance(self.simulation, Simulation):
            yield (
                f"geometry.{name}: found beside [simulation] without [thermal], expected one of the two: balls in "
                "motion have two contacts"
            )
        expected, traction = ("equilibrium", "with") if self.slips else ("linear_slip", "without")
        if self.kinematics.attitude != expected:
            yield (
                f"kinematics.attitude: found '{self.kinematics.attitude}', expected '{expected}' with geometry.{name} "
                f"and {traction} traction (contact.traction): race control is for balls with two contacts"
            )
        if self.contact is not None and self.kinematics.orbit == "common":
            yield (
                f"kinematics.orbit: found 'common' beside geometry.{name} and [contact], expected 'own': such balls "
                "orbit each at its own speed"
            )

    @property
    def raceway_diameters(self) -> tuple[Array, Array]:
        return groove_bottoms(self.geometry)

    def play(self, growth: Growth) -> Play:
        return running_play(self.geometry, growth)

    def grown(self, growth: Growth) -> "BallBearing":
        return dataclasses.replace(self, geometry=running_geometry(self.geometry, growth))

    def range_checks(self) -> RangeChecks:
        return CHECKS

    def outline(self, of: Callable[[str], float] | None = None) -> Outline:
        return ball_outline(self, of)

    def rated_contacts(
        self, elements: "BallResults | None", laminae: LaminaLoads | None, force: Array | None = None
    ) -> RatedContacts:
        return rated_contacts(self, elements, force)

    @property
    def drawing_angle(self) -> Array:
        return jnp.asarray(self.geometry.nominal_angle)

    @property
    def one_way_angle(self) -> Array:
        return jnp.zeros(()) if self.geometry.has_arcs else self.drawing_angle

    def point_contacts(self, elements: "BallResults") -> PointContact:
        cosines = (jnp.cos(elements.contact_angle_inner), jnp.cos(elements.contact_angle_outer))
        return self.geometry.contacts(*cosines, self.materials.race_modulus)

    @property
    def tilts_by_standard(self) -> bool:
        """True if the tilt of the ring is treated as in ISO 16281 (`Rating.tilt`)."""
        return self.rating is not None and self.rating.tilt == "iso"

    @property
    def slips(self) -> bool:
        """True if the balls have traction and their speeds are unknowns; else the speeds follow from rolling without
        sliding."""
        return self.contact is not None and self.contact.traction is not None

    @property
    def dissipates(self) -> bool:
        return self.contact is not None and (self.slips or self.contact.resists_rolling)

    @property
    def ring_lever(self) -> Array:
        """Length by which the equations multiply the tilts of the ring, m (see `Rating.tilt`)."""
        if self.tilts_by_standard:
            return 0.5 * jnp.asarray(self.geometry.pitch_diameter)
        return self.geometry.groove_circle_radius

    @property
    def port_distance(self) -> Array:
        r"""Axial distance of the plane of the inner groove centres, at which the displacements `ring` are given, from
        the plane of the unloaded balls, m: $(f_i - \frac12)D\sin\alpha$ at the contact angle of the unloaded bearing.
        With two groove arcs on a ring it is 0, because both are the middle plane."""
        if self.geometry.has_arcs:
            return jnp.zeros(())
        return self.geometry.inner_offset * self.geometry.free_sine

    def unused_parts(self) -> tuple[str, ...]:
        """Tables of the scene that have no effect because there is no traction on the raceways."""
        if self.slips:
            return ()
        named = {"cage": self.cage, "drag": self.drag}
        if self.contact is None:
            # a rating takes the viscosity ratio from the oil
            named["oil"] = None if self.rating is not None else self.oil
        return tuple(name for name, part in named.items() if part is not None)

    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: assumptions of the model, and uses for which the data of the scene are not intended."""
        notes = []
        if self.contact is not None and self.oil is not None:
            notes += [f"oil: {note}" for note in self.oil.notes]
            if self.contact.traction is not None:
                notes += self.contact.traction.notes(self.oil)
            if self.contact.heathcote:
                notes.append(
                    "contact.heathcote: ball and race slide also because their contact is curved (Heathcote slip), "
                    "which the source leaves out"
                )
            if self.contact.mixed is not None:
                notes.append(
                    "contact.mixed: boundary friction against the spin of the balls is left out, balls that spin lose "
                    "too little in mixed friction"
                )
        if self.slips and self.cage is not None:
            notes += self.cage.assumptions()
        if self.kinematics.orbit == "common":
            notes.append(
                "kinematics.orbit = 'common': all balls orbit at the mean of their own speeds, weighted by their inner "
                "loads"
            )
        if self.slips and self.kinematics.attitude != "equilibrium":
            notes.append(
                f"kinematics.attitude = '{self.kinematics.attitude}' is a hypothesis: the moments about the radius do "
                "not balance, and the losses do not add up to the drive power"
            )
        if self.kinematics.attitude == "linear_slip":
            notes.append(
                "kinematics.attitude = 'linear_slip': speeds of the balls are those of tractions proportional to "
                "pressure and sliding; no loss of sliding is computed from them"
            )
        notes += said_of_bending(self)
        if self.rating is not None:
            notes += self.rating.groove_assumptions()
        if self.tilts_by_standard:
            notes.append(
                "rating.tilt = 'iso': displacements, loads and stiffness follow the equations of ISO 16281, to first "
                "order in the tilt and with half the pitch diameter as its lever"
            )
        return tuple(notes)
