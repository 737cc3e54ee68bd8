r"""Equations of tapered rollers that may skid: raceways with traction, rib friction, oil drag and a cage.

The normal direction is that of the dry rollers (`system`): positions and tilt of each roller, with the centrifugal
force and the gyroscopic moment of its own orbit and spin. Friction does not change the normal loads.

Along the rolling direction a tapered roller has the equations of a cylindrical one (`cylindrical.equations`). Its axis
and both lines of contact meet in the apex, so all speeds of a contact are proportional to the distance $\rho$ from the
apex, and a raceway slides everywhere or nowhere. The moments about the apex of all forces on a roller lie in the
meridian plane. They are balanced along the roller axis, $e_x$, and across it, $e_z$. With all radii at mid length (see
`RollerKinematics`), a force T along the orbit at a raceway has the moments $\mp TR_R$ and $T\rho\cos\epsilon$, and the
net load P of the pocket, which acts at mid length on the roller axis, has the moment $-P\rho\cos\epsilon$ across the
axis and none along it. Dividing by $\rho\cos\epsilon$ leaves

- moment: $R_R(F_{C1} + F_{C2} - F_i - F_o) + G_x + \frac{R_R}{2}(P_i + P_o) = 0$;
- tangential: $Q_{C1} - Q_{C2} = F_i - F_o + \frac{G_z}{\rho\cos\epsilon} - F_{OL} + F_P$, with $F_P = \sum\pm P_k(
  \frac{R_k'}{R_R\cos\epsilon} - \frac12)$ of the reduced radii $R_k'$.

The rib gives G, the moment of its circumferential force $F_f$ at $(a_f, r_f)$ and of the moment $M_f$ about its normal.
Rollers that do not slide are the limit of strong traction (`friction`). There the equations are the same, with
constraint forces in place of traction.

A roller without load on a raceway has no friction there.

**Validity:** as `friction`, except for pure rolling. The axial component of the pocket friction on the cage, and the
friction of the pockets in the normal balance of the rollers, are left out.
**Reference:** own derivation.
"""

import dataclasses
from typing import ClassVar, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...contacts.laws import ContactLaws
from ...contacts.point_laws import PointLaws
from ...gaps import EndForces, Pocket
from ...lubricants import InletOil, Lubricant
from ...numerics.arrow import ArrowPoint
from ...numerics.newton import NewtonResult
from ..cylindrical.equations import AbstractLubricatedRollers, RollerState
from ..cylindrical.forces import CageParts, drag_of
from ..cylindrical.kinematics import RollerKinematics
from ..elastic_ring import ElasticRing
from ..inlet import OilElsewhere, oil_elsewhere, oil_of_races
from ..interactions import friction_totals
from ..parts import azimuths
from ..ring import LENGTH_UNIT, InnerRing
from .build import RollerBody, TaperedMotion, roller_body, roller_inertia
from .friction import (
    RaceFriction,
    RibFriction,
    RollerBalance,
    TaperedFriction,
    rib_friction,
    rib_motion,
    where_loaded,
)
from .geometry import TaperedGeometry
from .scene import TaperedRollerBearing
from .solution import TaperedPowerLoss
from .system import LONGEST_STEP, Inertia, TaperedState, TaperedSystem

LEAST_BRAKES = 1e-4
"""Factor of all resistance at the start of homotopy path 0 (`SkiddingSystem.homotopy`)."""
LIGHT = 1e-6
"""Load from which a contact of raceway or rib has films and friction, over the scale of the loads of a roller. The
change is smooth: friction is 0 without load."""


class PressedTapered(NamedTuple):
    """Contacts of all rollers.

    - `place`: unknowns of the normal direction; `inertia`: inertia forces on each roller.
    """

    contacts: TaperedState
    inertia: Inertia
    place: Float[Array, "3 roller"]

    @property
    def load(self) -> Float[Array, "2 roller"]:
        return self.contacts.load

    @property
    def along(self) -> None:
        """Always `None`: contacts are not cut into laminae."""


class SkiddingSystem(AbstractLubricatedRollers[PressedTapered]):
    """Tapered rollers that may skid (see the module).

    - `dry`: the same bearing without friction, with its equilibrium as first guess.
    - `rib`: laws of the rib; `None`: it has no films and no friction.
    - `azimuth`: of the rollers, rad.
    - `body`: mass and inertia of a roller.
    - `roller_mass`: mass of a roller, kg.
    - `brakes`: factor of rolling resistance, drag and rib friction, and of the viscosity in pockets and lands; not 1 in
      a homotopy only.
    - `heavier`: factor of the inertia forces; not 1 in a homotopy, and 0 for loads that have no equilibrium.
    """

    normal_names: ClassVar[tuple[str, ...]] = (
        "force balance along a roller",
        "force balance across a roller",
        "moment balance in the plane of a roller",
    )
    normal_caps: ClassVar[tuple[float, ...]] = (LONGEST_STEP / LENGTH_UNIT,) * 3

    dry: TaperedSystem
    ring: InnerRing
    outer: ElasticRing | None
    inner: ElasticRing | None
    azimuth: Float[Array, " roller"]
    kinematics: RollerKinematics
    geometry: TaperedGeometry
    body: RollerBody
    roller_mass: Float[Array, ""]
    contact: LineContact
    laws: ContactLaws
    rib: PointLaws | None
    oil: Lubricant
    inlet: InletOil
    cage: CageParts | None
    elsewhere: OilElsewhere | None
    brakes: Float[Array, ""]
    heavier: Float[Array, ""]

    def initial(self) -> ArrowPoint:
        """Starts from pure rolling at the equilibrium of the dry bearing."""
        guess = self.dry.initial()
        return ArrowPoint(jnp.pad(guess.elements, ((0, 1), (0, 0))), jnp.append(guess.globals, 0.0))

    def normal_bounds(self):
        """Positions and tilts have the bounds of the dry rollers."""
        return self.dry.bounds()

    @property
    def homotopies(self) -> int:
        return 2 + self.dry.homotopies

    def homotopy(self, parameter, path):
        """Path 0 begins without resistance, at rollers that hardly slide. Path 1 adds entrainment in every contact (as
        for cylindrical rollers), path 2 inertia forces (as for dry rollers)."""
        brakes = jnp.where(path == 0, LEAST_BRAKES**parameter, 1.0)
        eased = dataclasses.replace(self.with_entrainment(jnp.where(path == 1, parameter, 0.0)), brakes=brakes)
        if not self.dry.homotopies:
            return eased
        seated = jnp.where(path == 2, parameter, 0.0)
        heavier = self.heavier * jnp.maximum(self.dry.slowness(), 1.0) ** seated
        return dataclasses.replace(eased, dry=self.dry.homotopy(seated, path), heavier=heavier)

    def oil_of(self, place):
        oil = super().oil_of(place)
        return oil if place == "flange" else dataclasses.replace(oil, viscosity=oil.viscosity * self.brakes)

    def under(self, factor):
        ring, outer = self.rings_under(factor)
        dry = dataclasses.replace(self.dry, ring=ring, outer=outer)
        return dataclasses.replace(self, dry=dry, ring=ring, outer=outer)

    def normal(self, unknowns, shared, orbit, spin):
        own = roller_inertia(self.geometry, self.body, TaperedMotion(orbit, spin)).times(self.heavier)
        return PressedTapered(self.dry.state(unknowns[:3], shared), own, unknowns[:3])

    def films(self, pressed, mean_speed, sliding):
        load = jnp.maximum(pressed.load, 0.0)
        pressing, share = self.pressing(load)
        state = self.laws.evaluate(self.contact, pressing, mean_speed, sliding, self.oil, self.inlet)
        traction, rolling = state.traction, state.rolling_force
        assert traction is not None
        rolling = None if rolling is None else rolling * share * self.brakes
        return state._replace(traction=traction * share, rolling_force=rolling), None

    def pressing(self, load: Array) -> tuple[Array, Array]:
        """Loads at which the laws of a contact are evaluated, N, and the factor of its friction (`LIGHT`)."""
        pressing = jnp.sqrt(jnp.square(load) + jnp.square(LIGHT * self.dry.roller_scale()))
        return pressing, load / pressing

    def normal_errors(self, pressed, contact):
        del contact
        balance = self.dry.balance(pressed.contacts, pressed.inertia) + self.dry.anchors(pressed.place)
        return tuple(balance / self.dry.roller_scale())

    def on_ring(self, pressed):
        return self.dry.on_rings_of(pressed.contacts)

    def ring_rows(self, globals_, totals):
        return self.ring_balance(globals_, totals, floats=True) / self.load_scale()

    def forces(self, state, cage):
        if cage.drag is not None:
            cage = eqx.tree_at(lambda parts: parts.drag.coefficient, cage, cage.drag.coefficient * self.brakes)
        forces = super().forces(state, cage)
        friction = self.rib_friction(state)
        if friction is None or friction.traction is None:
            return forces
        end = self._on_end(friction)
        moment, tangential = forces.moment + end.moment, forces.tangential + end.tangential_force
        return forces._replace(moment=moment, tangential=tangential, inner_flange=end)

    def rib_friction(self, state) -> RibFriction | None:
        """Films and friction of the roller ends on the rib; `None` if they are not modelled."""
        if self.rib is None:
            return None
        motion = self.kinematics
        # the speed of the inner ring relative to the orbit, without cancellation
        free = motion.free_spin * motion.roller_radius / motion.inner_radius
        relative = free - (state.orbital_speed - motion.free_orbit)
        moving = rib_motion(self.geometry, state.spin_speed, relative)
        load = state.pressed.contacts.flange_load
        pressing, share = self.pressing(jnp.maximum(load, 0.0))
        oil, modulus = self.oil_of("flange"), self.contact.reduced_modulus
        return rib_friction(self.rib, self.geometry, modulus, self.oil, oil, moving, (load, pressing, share))

    def _on_end(self, friction: RibFriction) -> EndForces:
        """Forces of the rib on the rollers: the force at mid length on the roller axis and the moment about this axis
        that have the same moments about the apex."""
        rib, geometry, motion = friction.traction, self.geometry, self.kinematics
        assert rib is not None
        axial, radial = geometry.rib_moment(rib.rolling, rib.moment)
        sine, cosine = jnp.sin(geometry.axis_angle), jnp.cos(geometry.axis_angle)
        return EndForces(
            tangential_force=self.brakes * (axial * sine + radial * cosine) * sine / motion.pitch_radius,
            moment=self.brakes * (axial * cosine - radial * sine),
            ring_moment=-axial,
            power=rib.power,
        )


def build_skidding(scene: TaperedRollerBearing, dry: TaperedSystem, heavier: Float[Array, ""]) -> SkiddingSystem:
    """Equations of rollers that may skid.

    **Arguments:** `scene`: it has a cage and traction; `dry`: the same bearing without friction, with its equilibrium
    as first guess, or without a guess for equations that are not solved; `heavier`: factor of the inertia forces.
    """
    geometry, operation = scene.geometry, scene.operation
    assert scene.contact is not None
    assert scene.oil is not None
    body = roller_body(geometry, jnp.asarray(scene.materials.rollers.density))
    kinematics = RollerKinematics(
        inner_speed=jnp.asarray(operation.inner_speed),
        outer_speed=jnp.asarray(operation.outer_speed),
        pitch_radius=0.5 * geometry.pitch_diameter,
        roller_radius=0.5 * geometry.mean_roller_diameter,
        axis_cosine=jnp.cos(geometry.axis_angle),
        half_cosine=jnp.cos(jnp.asarray(geometry.roller_half_angle)),
    )
    return SkiddingSystem(
        dry=dry,
        ring=dry.ring,
        outer=dry.outer,
        inner=dry.inner,
        azimuth=azimuths(geometry, geometry.n_rollers),
        kinematics=kinematics,
        geometry=geometry,
        body=body,
        roller_mass=body.mass,
        contact=scene.race_lines(None),
        laws=scene.contact,
        rib=scene.rib,
        oil=scene.oil,
        inlet=oil_of_races(scene),
        cage=_cage_parts(scene, kinematics),
        elsewhere=oil_elsewhere(scene),
        brakes=jnp.ones(()),
        heavier=heavier,
    )


def _cage_parts(scene: TaperedRollerBearing, motion: RollerKinematics) -> CageParts:
    """Models of the forces on rollers and cage except those of raceways and rib."""
    cage, geometry = scene.cage, scene.geometry
    assert cage is not None
    drag, density = drag_of(scene)
    pocket = Pocket(
        clearance=jnp.asarray(cage.pocket_clearance),
        length=jnp.asarray(geometry.roller_length),
        roller_radius=motion.roller_radius,
    )
    return CageParts(pocket=pocket, land=cage.land(geometry), guidance=cage.guidance, drag=drag, drag_density=density)


def skidding_friction(
    system: SkiddingSystem, result: NewtonResult, state: RollerState[PressedTapered]
) -> TaperedFriction:
    """Films, friction, losses and torques, and the state of the cage, of a solution. **Arguments:** `state`: of the
    rollers."""
    contact, load = state.contact, state.load
    loaded = load > 0
    only = lambda values, absent=jnp.nan: None if values is None else jnp.where(loaded, values, absent)
    mixed = system.mixed(state)
    races = RaceFriction(
        film=jnp.where(loaded, contact.film, jnp.nan),
        temperature_rise=only(contact.temperature_rise),
        rolling=contact.rolling_force,
        capacity=None,
        speed=state.mean_speed,
        radius=jnp.broadcast_to(system.contact.reduced_radius, (2, 1)),
        residual=contact.inner_residual,
        asperities=None,
        starved=contact.supply,
        sliding=state.sliding_speed,
        mixed=None if mixed is None else where_loaded(mixed, loaded),
    )
    land = system.land_at(result.point, state)
    traction = contact.traction
    assert traction is not None
    return TaperedFriction(
        races=races,
        rib=system.rib_friction(state),
        drag_force=state.drag_force,
        balance=RollerBalance(None, traction * jnp.asarray([[1.0], [-1.0]])),
        totals=friction_totals(TaperedPowerLoss, system.interactions(state, land), system.kinematics),
        cage=system.cage_state(result.point, land),
        pocket=state.pocket,
    )
