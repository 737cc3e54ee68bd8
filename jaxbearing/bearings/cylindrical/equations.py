r"""Equations of the steady cylindrical roller bearing, as a block-arrow system.

Every roller orbits at the cage speed W and spins at the speed s (see `cylindrical.scene` for frames and signs). Each
roller has three equations (source eqs. (27)-(29), (38)):

- approach: $J_d/2 + \delta_i + \delta_o - h_i - h_o = d\cdot n$, with the diametral clearance $J_d$, the elastic
  approaches $\delta$, the film thicknesses h, the ring displacement d and the direction n of the roller. The residual
  is the logarithm of the ratio of the positive terms on the two sides. Its unknown is ln Qi, with the load $Q_i$ at the
  inner race. The load at the outer race is $Q_o = Q_i + m R_m W^2$, with the roller mass m and the pitch radius $R_m$.
  The pocket friction, about 0.1 % of the centrifugal force, is left out here, so that Q
  does not depend on the pocket;
- moment: $R_R(F_{C1} + F_{C2} - F_i - F_o) + M_{flange} + M_{rail} + \frac{R_R}{2}(P_i + P_o) = 0$, with the roller
  radius $R_R$, the friction forces $F_{C1}, F_{C2}$ of the pocket and $F_i, F_o$ of the races, and the rolling
  resistance P (see below). Its unknown is the mean speed of the surfaces at the outer race, as a change of s at this W.
  Near a cage speed at which that mean speed is 0, the film collapses and the moment has a cusp. With this unknown, the
  distance from the cusp stays the same when W changes;
- tangential: $Q_{C1} - Q_{C2} = F_i - F_o + F_E + F_{Ec} - F_{OL} + F_P$, with the loads $Q_{C1}, Q_{C2}$ of the two
  pocket films, the tangential forces $F_E$ of the flanges and $F_{Ec}$ of the side rails of the cage, the oil drag
  $F_{OL}$ and the rolling resistance $F_P$. This equation is eliminated: the two pocket films follow from it in closed
  form (`gaps.Pocket`).

The global equations are the balance of the ring, $\sum Q_i n = F_r$ (source eq. (37)), with the ring displacement d as
unknown, and the moment balance of the cage (source eq. (33)), with W as unknown. The cage offset is eliminated too: the
land must carry the sum of the pocket forces, and its eccentricity is the root of a monotone scalar equation
(`gaps.ShortJournal.static_equilibrium`).

Rolling resistance, if the scene models it (the source omits it): the pressure gradient of the film in each contact
defines the force $P = \ell\int h\,dp/dx\,dx$. The shear of the film brakes each of the two surfaces with P/2. The
pressure on a surface acts through the centre of that body, so that it has no moment about this centre. It pushes the
roller forward with the force $P R/R_R$, where R is the reduced radius, and it pushes the ring with the rest of P. The
force on the roller is $F_P = P_i (R_i'/R_R - 1/2) - P_o (R_o'/R_R - 1/2)$, with the reduced radii $R_i', R_o'$. Each
ring is braked by P/2 at its raceway. The dissipation is P times the mean speed.

The sign of $F_{C2} - F_{C1}$ in the x balance of the cage differs from the source's eq. (31). That equation contradicts
the source's eq. (32) and action = reaction. The friction force of an interaction and its
dissipation use the same sliding speed; only rolling resistance dissipates with the mean speed.
"""

import abc
import dataclasses
from typing import ClassVar, Generic, NamedTuple, Protocol, TypeVar

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...contacts.laws import ContactLaws, ContactState
from ...contacts.mixed import MixedState
from ...gaps import EndForces, PocketFilm
from ...lubricants import InletOil, Lubricant
from ...numerics.arrow import ArrowPoint, seen_by_elements
from ..elastic_ring import ElasticRing
from ..inlet import AbstractOils, OilElsewhere
from ..interactions import Interaction, of_land
from ..land import LandState, guided_land
from ..ring import LENGTH_UNIT, InnerRing
from ..rings import AbstractBetweenRings
from ..solution import CageState
from .forces import CageParts, RollerForces, forces_without_pocket, friction_on_rings, on_cage
from .in_plane import AbstractInPlane
from .kinematics import RollerKinematics, cage_slip
from .loads import LOG_LOAD_RANGE, approach_error, guessed_loads, per_race

EASED_ENTRAINMENT = 0.3
"""Entrainment speed that is added at the start of homotopy path 0 (see `homotopy`), divided by the entrainment speed of
rolling without slip."""
EASED_PRESSURE = 1.5e9
"""Hertz pressure of the most loaded roller at the start of homotopy path 1, Pa. It is so high that traction certainly
drives the rollers."""
APPROACH = "approach of the rings at a roller"
LOG_LOAD_STEP = 3.0
"""Longest step of ln Qi."""

Rollers = TypeVar("Rollers", bound="AbstractLubricatedRollers")


class PressedRollers(NamedTuple):
    """Contacts of all rollers with the races (inner, outer), from the unknowns of the normal direction.

    - `load`, N, and `approach` in the middle of the roller, m.
    - `opening`: of the rings at each roller, m.
    - `along`: loads along rollers that tilt; `None` for rollers that carry evenly along their length.
    """

    load: Float[Array, "2 roller"]
    approach: Float[Array, "2 roller"]
    opening: Float[Array, " roller"]
    along: "LoadsAlong | None" = None


class LoadsAlong(NamedTuple):
    """Loads along rollers that tilt.

    - `start`, m, and `slope`: the approach is `start` + `slope` s, with the distance s from one end of the roller.
    - `moment`: about the middle of the roller, N m.
    - `laminae`: loads of the laminae in which films and friction are computed, N.
    - `residual`: of the nested search for `start`.
    """

    start: Float[Array, "2 roller"]
    slope: Float[Array, "2 roller"]
    moment: Float[Array, "2 roller"]
    laminae: Float[Array, "2 roller lamina"]
    residual: Float[Array, ""]


class PressedContacts(Protocol):
    """Protocol of the contacts of all rollers with the races (inner, outer).

    - `load`: N.
    - `along`: loads along rollers that tilt; `None` for rollers that are not cut into laminae.
    """

    @property
    def load(self) -> Array: ...

    @property
    def along(self) -> LoadsAlong | None: ...


Pressed = TypeVar("Pressed", bound=PressedContacts)


class RollerState(NamedTuple, Generic[Pressed]):
    """State of every roller for given unknowns. The last axis runs over the rollers. A first axis of length 2 runs over
    the races (inner, outer), and in `cage_force` over the components.

    `contact` holds the films of whole contacts and the sums of their forces; `laminae` holds the films and forces of
    each lamina of rollers that tilt, on a further axis. `errors` are the scaled residuals of the normal direction."""

    pressed: Pressed
    orbital_speed: Float[Array, " roller"]
    spin_speed: Float[Array, " roller"]
    mean_speed: Float[Array, "2 roller"]
    sliding_speed: Float[Array, "2 roller"]
    contact: ContactState
    laminae: ContactState | None
    errors: tuple[Float[Array, " roller"], ...]
    pocket: PocketFilm | None = None
    inner_flange: EndForces | None = None
    outer_flange: EndForces | None = None
    rails: EndForces | None = None
    drag_force: Float[Array, " roller"] | None = None
    moment_error: Float[Array, " roller"] | None = None
    cage_moment: Float[Array, " roller"] | None = None
    cage_force: Float[Array, "2 roller"] | None = None

    @property
    def load(self) -> Float[Array, "2 roller"]:
        """Loads on both races, N."""
        return self.pressed.load


class AbstractLubricatedRollers(AbstractOils, AbstractBetweenRings, Generic[Pressed]):
    """Lubricated rollers between two rings. The unknowns of a roller are those of the normal direction, which a
    subclass defines, and with a `cage` its speed at the outer race. The last global is then the cage speed. Without a
    cage the raceways are frictionless and the rollers roll without slip.
    """

    kinematics: eqx.AbstractVar[RollerKinematics]
    contact: eqx.AbstractVar[LineContact]
    laws: eqx.AbstractVar[ContactLaws]
    oil: eqx.AbstractVar[Lubricant]
    azimuth: eqx.AbstractVar[Float[Array, " roller"]]
    roller_mass: eqx.AbstractVar[Float[Array, ""]]
    cage: eqx.AbstractVar[CageParts | None]

    # -- normal direction -----------------------------------------------------------------------------------------

    normal_names: ClassVar[tuple[str, ...]]
    """Names of the equations of the normal direction of a roller."""
    normal_caps: ClassVar[tuple[float, ...]]
    """Longest steps of its unknowns."""

    @abc.abstractmethod
    def normal_bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        """Lower and upper bounds of the unknowns of the normal direction and of the rings."""

    def load_scale(self) -> Array:
        """Scale of the ring's balances, N."""
        return self.ring.scale()

    @abc.abstractmethod
    def normal(
        self,
        unknowns: Float[Array, "m roller"],
        shared: Float[Array, "p roller"],
        orbit: Float[Array, " roller"],
        spin: Float[Array, " roller"],
    ) -> Pressed:
        """Loads and approaches. **Arguments:** `orbit`, `spin`: orbital speeds and spins, rad/s; others as in
        `rollers`."""

    @abc.abstractmethod
    def films(
        self, pressed: Pressed, mean_speed: Float[Array, "2 roller"], sliding: Float[Array, "2 roller"]
    ) -> tuple[ContactState, ContactState | None]:
        """`RollerState.contact` and `RollerState.laminae`. **Arguments:** speeds on both races, m/s."""

    @abc.abstractmethod
    def normal_errors(self, pressed: Pressed, contact: ContactState) -> tuple[Float[Array, " roller"], ...]:
        """Scaled residuals of the normal direction of each roller."""

    @abc.abstractmethod
    def on_ring(self, pressed: Pressed) -> Float[Array, "row roller"]:
        """Contributions of the rollers to the balances of both rings."""

    @abc.abstractmethod
    def ring_rows(self, globals_: Float[Array, " g"], totals: Float[Array, " k"]) -> Float[Array, " row"]:
        """Residuals of the balances of both rings, divided by `load_scale`."""

    @property
    def cage_row(self) -> int:
        """Row of the cage speed in `shared`."""
        return len(self.freedoms)

    # -- scales ---------------------------------------------------------------------------------------------------

    def friction_scale(self) -> Array:
        """Scale of friction forces, N: 1 % of the roller's centrifugal force plus its equal share of the load."""
        return 0.01 * (self.load_scale() / self.azimuth.shape[0] + self.centrifugal(self.kinematics.free_orbit))

    def centrifugal(self, orbital_speed: Array) -> Array:
        return self.roller_mass * self.kinematics.pitch_radius * jnp.square(orbital_speed)

    # -- solver contract ------------------------------------------------------------------------------------------

    def equation_names(self) -> tuple[str, ...]:
        ring = self.ring_names()
        if self.cage is None:
            return (*self.normal_names, *ring)
        return (*self.normal_names, "moment balance of a roller", *ring, "moment balance of the cage")

    def step_caps(self) -> ArrowPoint:
        caps, ring = list(self.normal_caps), [5.0] * self.ring_unknowns
        if self.cage is not None:
            caps, ring = [*caps, 0.2], [*ring, 0.2]
        return ArrowPoint(jnp.asarray(caps)[:, None], jnp.asarray(ring))

    def bounds(self) -> tuple[ArrowPoint, ArrowPoint]:
        ends = self.normal_bounds()
        if self.cage is None:
            return ends
        low, high = (
            ArrowPoint(
                jnp.concatenate([end.elements, jnp.full((1, 1), 3.0 * side)]), jnp.append(end.globals, 2.0 * side)
            )
            for end, side in zip(ends, (-1.0, 1.0), strict=True)
        )
        return low, high

    @property
    def homotopies(self) -> int:
        return 0 if self.cage is None else 2

    def homotopy(self, parameter, path):
        """Path 0 adds entrainment in every contact. Where a ring and the cage turn at nearly the same speed, a film
        collapses, and the friction on a roller falls with its slip; added entrainment makes the friction grow with the
        slip again. Path 1 adds load, which forces the rollers to roll without slip."""
        contact = jax.tree.map(lambda values: per_race(values)[0], self.contact)
        per_roller = 2.0 * jnp.pi * EASED_PRESSURE**2 * contact.reduced_radius * contact.length
        heavy = per_roller / contact.reduced_modulus * self.azimuth.shape[0] / 4.0
        factor = jnp.where(path == 1, jnp.maximum(heavy / self.load_scale(), 1.0) ** parameter, 1.0)
        return self.with_entrainment(jnp.where(path == 0, parameter, 0.0)).under(factor)

    def with_entrainment(self: Rollers, parameter: Float[Array, ""]) -> Rollers:
        """The same system with entrainment added in every contact (see `homotopy`)."""
        extra = EASED_ENTRAINMENT * jnp.abs(self.kinematics.orbit_scale) * self.kinematics.outer_radius
        offset = self.laws.entrainment_offset + parameter**3 * extra
        return eqx.tree_at(lambda system: system.laws.entrainment_offset, self, offset)

    @abc.abstractmethod
    def under(self: Rollers, factor: Float[Array, ""]) -> Rollers:
        """The same system with the given loads multiplied by a factor."""

    @property
    def extra_totals(self) -> int:
        # the one global of the cage needs three totals: the moment on the cage and two components of its force
        return 0 if self.cage is None else 2

    def element(self, unknowns, shared):
        state = self.rollers(unknowns, shared)
        balance, nested = self.on_ring(state.pressed), state.contact.inner_residual
        if state.pressed.along is not None:
            nested = jnp.maximum(nested, state.pressed.along.residual)
        if state.moment_error is None or state.cage_moment is None or state.cage_force is None:
            return jnp.stack(state.errors), balance, nested
        local = jnp.stack([*state.errors, state.moment_error])
        contributions = jnp.concatenate([balance, state.cage_moment[None, :], state.cage_force])
        return local, contributions, nested

    def global_residual(self, globals_, totals):
        d = self.ring_unknowns
        ring = self.ring_rows(globals_, totals)
        if self.cage is None:
            return ring, jnp.zeros(())
        land = self.land(self.orbit(globals_[d]), totals[d + 1], totals[d + 2])
        scale = self.friction_scale() * self.kinematics.pitch_radius * self.azimuth.shape[0]
        # the moment falls with the cage speed: with its sign changed the diagonal is positive, as for a stiffness
        return jnp.concatenate([ring, -(totals[d] + land.cage_torque)[None] / scale]), land.residual

    # -- physics --------------------------------------------------------------------------------------------------

    def orbit(self, scaled: Array) -> Array:
        """Orbital speed W, rad/s, from the scaled unknown, which is 0 in rolling without slip."""
        return self.kinematics.free_orbit + self.kinematics.orbit_unit * scaled

    def at(self, point: ArrowPoint) -> RollerState[Pressed]:
        return self.rollers(point.elements, seen_by_elements(self, point))

    def rollers(self, unknowns: Float[Array, "m roller"], shared: Float[Array, "p roller"]) -> RollerState[Pressed]:
        """State of the rollers.

        **Arguments:** `shared`: the globals. If a ring bends, the values of `local_inputs` instead.
        """
        motion = self.kinematics
        if self.cage is None:
            orbit_change = spin_change = jnp.zeros_like(unknowns[0])
        else:
            cage = shared[self.cage_row]
            orbit_change = motion.orbit_unit * cage
            # twice the change of the outer race's mean speed is R_R spin_change + R_o orbit_change
            spin_change = motion.spin_unit * (unknowns[-1] - cage)
        orbit, spin = motion.free_orbit + orbit_change, motion.free_spin + spin_change
        mean_speed, sliding = motion.surface_speeds(orbit_change, spin_change)
        pressed = self.normal(unknowns, shared, orbit, spin)
        contact, laminae = self.films(pressed, mean_speed, sliding)
        state = RollerState(
            pressed=pressed,
            orbital_speed=orbit,
            spin_speed=spin,
            mean_speed=mean_speed,
            sliding_speed=sliding,
            contact=contact,
            laminae=laminae,
            errors=self.normal_errors(pressed, contact),
        )
        return state if self.cage is None else self._with_cage(state, self.cage)

    def forces(self, state: RollerState[Pressed], cage: CageParts) -> RollerForces:
        """Sum of all forces on the rollers except those of the pocket walls."""
        orbit, spin = state.orbital_speed, state.spin_speed
        return forces_without_pocket(self.kinematics, self.contact, state.contact, cage, orbit, spin)

    def _with_cage(self, state: RollerState[Pressed], cage: CageParts) -> RollerState[Pressed]:
        """Tangential and moment balance of the rollers, and their forces on the cage."""
        motion, spin = self.kinematics, state.spin_speed
        assert cage.pocket is not None
        forces = self.forces(state, cage)
        # tangential balance: the front minus the rear load of the pocket films carries the remaining force
        pocket = cage.pocket.balance(forces.tangential, spin, self.oil_of("pocket").viscosity)
        moment = forces.moment + motion.roller_radius * (pocket.friction_front + pocket.friction_rear)
        cage_moment, cage_force = on_cage(
            motion,
            self.azimuth,
            (pocket.load_front, pocket.load_rear),
            (pocket.friction_front, pocket.friction_rear),
            forces.rails,
        )
        return state._replace(
            pocket=pocket,
            inner_flange=forces.inner_flange,
            outer_flange=forces.outer_flange,
            rails=forces.rails,
            drag_force=forces.drag_force,
            moment_error=moment / (self.friction_scale() * motion.roller_radius),
            cage_moment=cage_moment,
            cage_force=cage_force,
        )

    def mixed(self, state: RollerState[Pressed]) -> MixedState | None:
        """Mixed friction of the contacts for the results; `None` if it is not modelled."""
        speeds = (state.mean_speed, state.sliding_speed)
        return self.laws.mixed_state(self.contact, state.load, state.contact, *speeds, self.inlet)

    def land(self, orbit: Array, force_x: Array, force_y: Array) -> LandState:
        """State of the lands under the sum of the pocket forces: eccentricity, torques on cage and guiding ring.

        **Arguments:** `orbit`: cage speed, rad/s; `force_x`, `force_y`: force of the rollers on the cage, N.
        """
        cage, motion = self.cage, self.kinematics
        assert cage is not None
        assert cage.land is not None
        return guided_land(
            cage.land,
            cage.guidance,
            motion.inner_speed,
            motion.outer_speed,
            orbit,
            force_x,
            force_y,
            self.oil_of("cage_pilot"),
        )

    def land_at(self, point: ArrowPoint, state: RollerState[Pressed]) -> LandState:
        assert state.cage_force is not None
        force = jnp.sum(state.cage_force, axis=1)
        return self.land(self.orbit(point.globals[-1]), force[0], force[1])

    def cage_state(self, point: ArrowPoint, land: LandState) -> CageState:
        orbit = self.orbit(point.globals[-1])
        return CageState(
            speed=orbit,
            slip=cage_slip(orbit, self.kinematics),
            eccentricity_ratio=land.eccentricity_ratio,
            attitude_angle=land.attitude_angle,
        )

    def interactions(self, state: RollerState[Pressed], land: LandState) -> list[Interaction]:
        """All friction of a bearing with sliding rollers. The power of each interaction is computed from its own force
        and its own speed."""
        motion, pocket, cage = self.kinematics, state.pocket, self.cage
        assert pocket is not None
        assert cage is not None
        speeds, flanges = (state.sliding_speed, state.mean_speed), (state.inner_flange, state.outer_flange)
        interactions = friction_on_rings(motion, state.contact, *speeds, *flanges)
        friction = pocket.friction_front + pocket.friction_rear
        interactions.append(Interaction("pocket", jnp.sum(friction * motion.roller_radius * state.spin_speed)))
        if state.rails is not None:
            interactions.append(Interaction("element_ends", jnp.sum(state.rails.power)))
        interactions.append(of_land(land.power, land.ring_torque, cage.guidance))
        if state.drag_force is not None:
            power = jnp.sum(state.drag_force * motion.pitch_radius * state.orbital_speed)
            interactions.append(Interaction("drag", power))
        return interactions


class LubricatedRollerSystem(AbstractInPlane, AbstractLubricatedRollers[PressedRollers]):
    """Rollers that carry evenly along their length. The unknown of the normal direction is ln Qi."""

    normal_names: ClassVar[tuple[str, ...]] = (APPROACH,)
    normal_caps: ClassVar[tuple[float, ...]] = (LOG_LOAD_STEP,)

    kinematics: RollerKinematics
    contact: LineContact
    laws: ContactLaws
    oil: Lubricant
    inlet: InletOil
    directions: Float[Array, "freedom roller"]
    azimuth: Float[Array, " roller"]
    ring: InnerRing
    radial_clearance: Float[Array, ""]
    roller_mass: Float[Array, ""]
    held: Float[Array, " roller"] | None = None
    out_of_round: Float[Array, " roller"] | None = None
    outer: ElasticRing | None = None
    inner: ElasticRing | None = None
    cage: CageParts | None = None
    elsewhere: OilElsewhere | None = None
    """Oil of the other interactions, if it differs from `inlet`, the oil of the raceways."""

    @property
    def cage_row(self) -> int:
        return 1 if self.bent else self.directions.shape[0]

    def initial(self) -> ArrowPoint:
        """Starts from rolling without slip. The loads are those of a dry elastic bearing whose clearance is reduced by
        the films, plus Martin's film force on the rollers outside the loaded zone. The ring displacement is the one
        that carries the load."""
        motion, n = self.kinematics, self.azimuth.shape[0]
        mean_speed, _ = motion.surface_speeds(jnp.zeros(()), jnp.zeros(()))
        along = self.ring.across()
        opening = self.radial_clearance
        for inward in (self.held, self.out_of_round):
            opening = opening if inward is None else opening - inward
        shift, log_load = guessed_loads(
            self.contact,
            self.laws,
            self.inlet,
            mean_speed,
            jnp.einsum("f,fn->n", along, self.directions),
            self.load_scale(),
            self.centrifugal(motion.free_orbit),
            opening,
        )
        ring = self.begun(along * shift / LENGTH_UNIT)
        if self.cage is None:
            return ArrowPoint(log_load[None, :], ring)
        return ArrowPoint(jnp.stack([log_load, jnp.zeros(n)]), jnp.concatenate([ring, jnp.zeros(1)]))

    def normal_bounds(self):
        ring = jnp.full(self.ring_unknowns, 1e4)
        low, high = (jnp.full((1, 1), end) for end in LOG_LOAD_RANGE)
        return ArrowPoint(low, -ring), ArrowPoint(high, ring)

    def under(self, factor):
        ring, outer = self.rings_under(factor)
        return dataclasses.replace(self, ring=ring, outer=outer)

    def local_inputs(self, globals_):
        """With flexible rings, returns the displacement of the rings towards each other at each roller and, with a
        cage, the cage speed. Returns `None` if both rings are rigid."""
        if not self.bent:
            return None
        shift = self.approaching(globals_)
        return shift[None] if self.cage is None else jnp.stack([shift, jnp.broadcast_to(globals_[-1], shift.shape)])

    def gathered(self, globals_, acting):
        if not self.bent:
            return jnp.sum(acting, axis=1)
        return jnp.concatenate([self.on_rings(acting[:2]), jnp.sum(acting[2:], axis=1)])

    def normal(self, unknowns, shared, orbit, spin):
        del spin
        inner = jnp.exp(unknowns[0])
        load = jnp.stack([inner, inner + self.centrifugal(orbit)])
        shift = shared[0] if self.bent else self.inward(shared[: self.directions.shape[0]])
        return PressedRollers(load, self.contact.palmgren_approach(load), self.radial_clearance - shift)

    def films(self, pressed, mean_speed, sliding):
        state = self.laws.evaluate(self.contact, pressed.load, mean_speed, sliding, self.oil, self.inlet)
        return state, None

    def normal_errors(self, pressed, contact):
        return (approach_error(pressed.approach, contact.separation, pressed.opening),)

    def on_ring(self, pressed):
        return pressed.load if self.bent else pressed.load[0][None, :] * self.directions
