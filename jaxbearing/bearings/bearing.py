"""Base class of all bearing scenes. It defines the methods that a bearing family implements, and which degrees of
freedom of the inner ring are unknown. A family is a kind of bearing, such as ball or cylindrical roller bearings; a
folder beside this file holds it.

Terms: a *scene* is the complete description of a problem. The *port* is the point of the inner ring at which loads and
displacements are exchanged with a shaft (see `ring`). The *row* of a bearing is a simplified model of its rolling
elements without films and friction; the search for the equilibrium of a shaft starts with it. The *seats* are the
surfaces of shaft and housing that the rings sit on; their fits are in `[fits]` of a scene file. The *load line* is the
radial direction at azimuth 0. A tilt is *exact* if the grooves move by the full rotation of the ring, and linearised if
they move by its first-order displacement.
"""

import abc
import dataclasses
import functools
import operator
from collections.abc import Callable
from typing import Any, ClassVar, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array

from .._scene import SIMULATED, AbstractHistory, AbstractScene, only_if
from .._solvers import BEARING, solver
from .._types import Values
from ..contacts import LineContact, PointContact
from ..materials import ROLLER_PRESSURE
from ..mounting import Fits, PartTemperatures
from ..numerics.newton import NewtonOptions
from ..numerics.status import Status
from ..thermal.settings import Thermal
from ..thermal.shares import OilTemperatures
from .facts import RangeChecks
from .growth import Growth, Play
from .mounted import fit_excess, running_scene
from .operation import AbstractOperation
from .outline import Outline
from .parts import AbstractGeometry
from .rated import RatedContacts
from .rating import Rating
from .ring import InnerRing
from .ring_shape import FlexibleInnerRing, FlexibleRing, InnerRoundness, OuterRoundness
from .row import AbstractRow
from .solution import RING_FREEDOMS, TILTS, LaminaLoads, Solution
from .warm import settled, solve_warm

Bearing = TypeVar("Bearing", bound="AbstractBearing")


class AbstractBearing(AbstractScene):
    """Base of all bearings. The inner ring has the degrees of freedom of `solution.RING_FREEDOMS`, or some of them.

    A family is a folder beside this file. Its scene class implements the solve under given loads or with a held ring
    (`solve_ring`), the range checks of the family, and the inputs of the life calculation.
    """

    element: ClassVar[str] = "roller"
    """Name of a rolling element."""
    yield_pressure: ClassVar[float] = ROLLER_PRESSURE
    """Hertz pressure beyond which elements and races yield, Pa."""
    required_part: ClassVar[str] = "traction on the raceways"
    """Name of the part of the model that the `unused_parts` of a scene need to have an effect, for messages."""

    # a type checker lets a family narrow a field of this class only if it is Any here
    geometry: eqx.AbstractVar[Any]
    materials: eqx.AbstractVar[Any]
    operation: eqx.AbstractVar[Any]
    oil: eqx.AbstractVar[Any]
    contact: eqx.AbstractVar[Any]
    rating: eqx.AbstractVar[Rating | None]
    fits: eqx.AbstractVar[Fits | None]
    temperatures: eqx.AbstractVar[PartTemperatures | None]
    thermal: eqx.AbstractVar[Thermal | None]
    oil_temperatures: eqx.AbstractVar[OilTemperatures | None]
    outer_ring: eqx.AbstractVar[FlexibleRing | None]
    inner_ring: eqx.AbstractVar[FlexibleInnerRing | None]
    inner_roundness: eqx.AbstractVar[InnerRoundness | None]
    outer_roundness: eqx.AbstractVar[OuterRoundness | None]

    def steady_solution(self, options: NewtonOptions) -> Solution:
        return self.solved_running(lambda running: running.solve_ring(options))

    def simulated(self, duration: float | None, **settings: Any) -> AbstractHistory:
        """Simulates the temperatures over time, for which the scene needs a thermal network. A family whose rolling
        elements can be simulated overrides this method, and simulates them if the scene has no network."""
        if self.thermal is None:
            raise TypeError(f"cannot simulate a {type(self).__name__} without [thermal]; simulate takes: {SIMULATED}")
        return solver(BEARING, "simulated")(self, duration, **settings)

    def check_restart(self, restart: object, duration: float | None = None) -> None:
        """Checks that a run of this scene can continue from a state.

        **Raises:** `TypeError` or `ValueError` if it cannot."""
        if self.thermal is None:
            raise TypeError(f"cannot simulate a {type(self).__name__} without [thermal]; simulate takes: {SIMULATED}")
        solver(BEARING, "check_restart")(self, restart)

    def solved_running(self, solve: "Callable[[AbstractBearing], Solution]") -> Solution:
        """Solves the bearing with its running dimensions. If the scene has fits, these and the temperatures and speeds
        change the dimensions; without fits they stay as given. With a thermal network the temperatures are unknowns
        too.

        If the fits are impossible, the solve gets an operating point of NaN, so that it fails at once. The solution
        still shows the given operating point.

        **Arguments:** `solve`: function that solves a scene with neither a thermal network nor fits.
        """
        if self.thermal is not None:
            return solve_warm(self, solve)
        if self.fits is None:
            return solve(self)
        running, fit, impossible = running_scene(self)
        assert fit is not None
        possible = ~functools.reduce(operator.or_, (cause.applies for cause in impossible.values()))
        solution = solve(only_if(running, possible))
        good = solution.converged
        checks = {text: good & (excess > 0) for text, excess in fit_excess(self, fit).items()}
        return dataclasses.replace(
            solution,
            status=jnp.where(possible, solution.status, int(Status.INVALID_INPUT)),
            operation=self.operation,
            fit=jax.tree.map(lambda leaf: jnp.where(good, leaf, jnp.nan), fit),
            checks={**solution.checks, **checks},
            notes=(*solution.notes, *self.fits.assumptions(self.temperatures is not None)),
            failure_causes={**solution.failure_causes, **impossible},
        )

    def settled(self: Bearing, solution: Solution) -> Bearing:
        """Returns the scene at the temperatures of its solution; without a thermal network, the scene unchanged."""
        return settled(self, solution)

    @property
    @abc.abstractmethod
    def dissipates(self) -> bool:
        """True if the model of the scene includes friction losses."""

    @property
    @abc.abstractmethod
    def raceway_diameters(self) -> tuple[Array, Array]:
        """Diameters of the inner and the outer raceway, m; in a ball bearing those at the bottom of the grooves."""

    @abc.abstractmethod
    def play(self, growth: Growth) -> Play:
        """Returns the play of the bearing after fits, temperatures and speed have changed its parts."""

    @abc.abstractmethod
    def grown(self: Bearing, growth: Growth) -> Bearing:
        """Returns the bearing with its dimensions changed by `growth`, and without fits."""

    play_is_clearance: ClassVar[bool] = True
    """True if the play is a diametral clearance; otherwise it is an axial displacement."""

    def solve_ring(
        self, options: NewtonOptions, ring: InnerRing | None = None, exact_tilt: bool | None = None
    ) -> Solution:
        """Solves the steady state with the solver of the family (`_solvers`).

        **Arguments:**
        - `ring`: an inner ring with given displacements (a held ring); by default the ring of the operating point, with
          its loads.
        - `exact_tilt`: True to move the grooves of a ball bearing by the exact rotation of the ring, False to linearise
          it; by default the choice of the scene. Rollers have no grooves.
        """
        return solver(self.kind, "solve_ring")(self, options, ring, exact_tilt)

    def row(self, expansion: Array) -> AbstractRow:
        """The frictionless model of the bearing for a given displacement of the inner ring, from which the solve of a
        shaft starts. Centrifugal forces act at the speeds of the bearing.

        **Arguments:** `expansion`: expansion of the inner raceway's radius less that of the outer one, m.
        """
        return solver(self.kind, "row")(self, expansion)

    @abc.abstractmethod
    def range_checks(self) -> RangeChecks:
        """Range checks of this family, in addition to those of all bearings."""

    @abc.abstractmethod
    def rated_contacts(self, elements: Any, laminae: LaminaLoads | None, force: Array | None = None) -> RatedContacts:
        """Sizes and loads of the raceway contacts for the life calculation.

        **Arguments:** fields of a solution with these names: `elements`, the state of the rolling elements, `None` of
        an unloaded bearing; `laminae`, the loads on the slices of the rollers; `force`, the loads that hold the ring.
        If the displacement of the ring is given, the equivalent load P of ISO 281 follows from `force`; without `force`
        it is not known.
        """

    @abc.abstractmethod
    def outline(self, of: Callable[[str], float] | None = None) -> Outline:
        """Shapes, for drawings, of one rolling element and of the parts that it touches.

        **Arguments:** `of`: function that takes the name of a result and returns its value for the drawn element; by
        default the unloaded bearing is drawn.
        """

    @property
    def n_elements(self) -> int:
        """Number of rolling elements."""
        geometry: AbstractGeometry = self.geometry
        return geometry.n_elements

    @property
    def element_diameter(self) -> Values:
        """Diameter of a rolling element, at its middle, m; not the pitch diameter of the bearing."""
        geometry: AbstractGeometry = self.geometry
        return geometry.element_diameter

    @property
    def drawing_angle(self) -> Array:
        """Nominal contact angle, rad; 0 if the geometry has none or gives a clearance instead."""
        nominal = getattr(self.geometry, "contact_angle", None)
        return jnp.asarray(0.0 if nominal is None else nominal)

    @property
    def one_way_angle(self) -> Array:
        """Nominal contact angle of a bearing that carries axial load in one direction only, rad. Families whose
        bearings carry it in both directions return 0 for these."""
        return self.drawing_angle

    def point_contacts(self, elements: Any) -> PointContact | None:
        """Raceway contacts of a solution as point contacts, shape (2 races, element). This base method returns `None`,
        for line contacts; families with point contacts override it."""
        return None

    def race_lines(self, elements: Any) -> LineContact | None:
        """Raceway contacts as uniformly loaded line contacts, shape (2 races, 1). This base method returns `None`, for
        point contacts; families with line contacts override it."""
        return None

    @property
    def line_contacts(self) -> bool:
        """True if raceways and elements touch along lines."""
        return self.element == "roller"

    @property
    @abc.abstractmethod
    def ring_lever(self) -> Array:
        """Length by which the equations multiply the tilts of the ring, so that all its unknowns are lengths, m."""

    @property
    @abc.abstractmethod
    def port_distance(self) -> Array:
        """Distance along the axis $e_x$ from the port to the point of the ring for which the family writes its
        equations, m. If the bearing is solved alone, the field `ring` of the solution gives the displacement of that
        point."""

    @property
    @abc.abstractmethod
    def slips(self) -> bool:
        """True if the speeds of the elements are unknowns. Otherwise they follow from rolling without sliding."""

    @abc.abstractmethod
    def unused_parts(self) -> tuple[str, ...]:
        """Tables of the scene that have no effect."""

    @abc.abstractmethod
    def assumptions(self) -> tuple[str, ...]:
        """Notes for the user: assumptions of the model, and uses that the data of the scene do not cover."""

    def with_lateral_freedom(self: Bearing) -> Bearing:
        """Returns the scene with both the radial and the lateral displacement of the ring as unknowns, as the stiffness
        of a shaft support requires. Families with fewer unknowns override it; this base method returns the scene
        unchanged."""
        return self

    @property
    def modelled_freedoms(self) -> tuple[str, ...]:
        """Degrees of freedom of the inner ring that the bearing resists."""
        return RING_FREEDOMS

    @property
    def skewed(self) -> bool:
        """True if the ring can move across the load line, because of its loads, its given displacements or the
        positions of the rolling elements."""
        operation: AbstractOperation = self.operation
        return operation.skewed or self.geometry.first_element_angle is not None

    @property
    def unknown_freedoms(self) -> tuple[str, ...]:
        """Degrees of freedom of the inner ring that are unknowns of a solve under given loads.

        A degree of freedom is left out if the bearing does not resist it (`modelled_freedoms`), if its displacement is
        given, or if symmetry keeps it at 0: if all rolling elements are loaded alike, of the three displacements only
        the axial one remains, and if the load line is a line of symmetry, the lateral one is left out. A tilt is an
        unknown only if its moment is given; otherwise it is prescribed, by default as 0.
        """
        operation: AbstractOperation = self.operation
        forces = ["axial"]
        if not operation.symmetric:
            forces += ["radial", "lateral"] if self.skewed else ["radial"]
        free = [name for name in forces if operation.held_at(name) is None]
        free += [name for name in TILTS if operation.load(name) is not None]
        return tuple(name for name in free if name in self.modelled_freedoms)

    @property
    def shown_freedoms(self) -> tuple[str, ...]:
        """Degrees of freedom whose displacement is a result or was given."""
        operation: AbstractOperation = self.operation
        free = self.unknown_freedoms
        return tuple(name for name in RING_FREEDOMS if name in free or operation.held_at(name) is not None)
