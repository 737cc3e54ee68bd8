r"""Friction of a tapered roller bearing whose rollers roll without sliding about the apex, and the forces that keep
them rolling.

Raceways. If a cone rolls on a cone with the same apex, the surfaces do not slide on each other anywhere along the line
of contact. The tangential forces there are *constraint forces*, which do no work and follow from the balance of the
roller. Slip stays microscopic as long as they are small against the traction that the film can carry (otherwise there
is a warning, see `SKIDDING`). Constraint forces act in the circumferential direction only. With the distance $\rho$
from the apex and $A_k = \int t_k\rho\,d\rho$, their moment about the *apex* is $A_k m_k$, $m_k = (\sin\alpha_k,
\cos\alpha_k)$ in (a, r), independent of their distribution along the line. The balance of moments about the apex in
the meridian plane gives two equations for the two unknowns of a roller, $A_i$ and $A_o$:

$A_i m_i + A_o m_o + G = 0$, $A_i = -G\cdot p_o/\sin2\epsilon$, $A_o = G\cdot p_i/\sin2\epsilon$, $p_k = (-\cos\alpha_k,
\sin\alpha_k)$,

where G is the moment about the apex of all forces that dissipate. They are, in a frame that orbits with the rollers and
with the spin S of a roller (`spin_speed`):

- *Rolling resistance*, with the force $P_k$ and the power $P_ku$ (`contacts.rolling`) at the speed $u =
  S\rho\sin\epsilon$, $\rho$ at mid length. Ring and roller turn against each other at $S\sin\gamma/\sin\alpha_k$ about
  the line of contact. The pressure is displaced against the motion and exerts the couple $-P_kR_kp_k$ on the roller,
  with the reduced radius $R_k = \rho\sin\epsilon\sin\alpha_k/\sin\gamma$. (Its circumferential force is a part of the
  constraint force.)
- *Rib*: at $x_f = (a_f, r_f)$ rib and roller end move with $u_1 = (\omega_i - \omega_m)r_f$ and $u_2 = SR_s\sin\theta$.
  They slide on each other and spin about the normal $n_f$ with $(\omega_i - \omega_m)\cos\alpha_f + S\cos\theta$. The
  film is sheared in the Hertz ellipse. This gives a circumferential force $F_f$ and a moment $M_f$ about the normal:
  $F_f(r_f, -a_f) + M_fn_f$. Shear outside the ellipse and the small rolling resistance of this contact are left out.
- *Drag* D against the orbit, at mid length on the roller axis: $-D(r_m, -a_m)$.

Gyroscopic and normal forces have no moment in that plane. The torques that drive the rings are computed from the same
forces: $\sum[A_i\sin\alpha_i + P_iR_i\cos\alpha_i + F_fr_f + M_f\cos\alpha_f]$ and $\sum[A_o\sin\alpha_o +
P_oR_o\cos\alpha_o]$. Their power must be the sum of the dissipations, which tests every sign.

**Validity:** pure rolling (`skidding`: rollers that may slide on the raceways). Friction does not change the normal
loads and does not skew the rollers: the force of the rib along its generator and the effect of friction on the
equilibrium of the cone are left out. There is no cage: if
drag acts on a roller without load on the cone, the constraint forces stand for the pocket that would push it, not for
forces of the raceways.
**Reference:** own derivation; the source's tapered bearing is frictionless.
"""

import dataclasses
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact, PointContact, Sliding, Traction
from ...contacts.laws import ContactLaws
from ...contacts.mixed import Asperities, MixedState
from ...contacts.oil_supply import Starvation
from ...contacts.point_laws import PointFilm, PointLaws
from ...gaps import PocketFilm, RollerDrag
from ...lubricants import InletOil, Lubricant
from ..inlet import oil_elsewhere, oil_of, oil_of_races, oil_temperature
from ..interactions import FrictionTotals, Interaction, friction_totals
from ..parts import drag_density
from ..solution import CageState
from .build import TaperedMotion, rolling_motion
from .geometry import TaperedGeometry
from .scene import TaperedRollerBearing
from .solution import TaperedPowerLoss
from .system import TaperedState

SKIDDING = 0.1
"""Slide-to-roll ratio at which the largest traction of a film is evaluated. Beyond it, the laws of film and rolling
resistance do not hold, because they are laws of rolling."""


class RibMotion(NamedTuple):
    """Motion at the contact of rib and roller end, in the orbiting frame.

    - `mean_speed`: mean circumferential speed of both surfaces, m/s.
    - `sliding_speed`: circumferential speed of the rib relative to the roller end, m/s.
    - `spin`: of the rib relative to the roller end, about the normal that points into the roller, rad/s.
    """

    mean_speed: Array
    sliding_speed: Array
    spin: Array


class RaceFriction(NamedTuple):
    """Films and friction of the raceway contacts; the first axis runs over the races (inner, outer). `None`: not
    modelled. For contacts without load, film and temperature rise are NaN, and forces are 0.

    - `film`, m; `temperature_rise`, K.
    - `rolling`: rolling resistance P, N.
    - `capacity`: traction at the slide-to-roll ratio `SKIDDING`, N.
    - `speed`: mean surface speed at mid length, m/s; `radius`: reduced radius at mid length, m.
    - `sliding`: sliding speed at mid length of rollers that may skid, m/s.
    - `residual`: largest residual of nested solves.
    - `asperities`: film ratio and load share in mixed friction, `mixed`: its state for rollers that may skid;
      `starved`: effect of starvation.
    """

    film: Float[Array, "2 roller"]
    temperature_rise: Float[Array, "2 roller"] | None
    rolling: Float[Array, "2 roller"] | None
    capacity: Float[Array, "2 roller"] | None
    speed: Float[Array, "2 _"]
    radius: Float[Array, "2 1"]
    residual: Float[Array, ""]
    asperities: Asperities | None
    starved: Starvation | None
    sliding: Float[Array, "2 roller"] | None = None
    mixed: MixedState | None = None


class RibFriction(NamedTuple):
    """Films and friction of the roller ends on the rib; fields not listed here are as in `RaceFriction`.

    - `traction`: circumferential force of the rib on the roller, its moment about the normal and its power, of film and
      asperities together.
    - `mixed`: state of mixed friction.
    """

    motion: RibMotion
    film: Float[Array, " roller"]
    temperature_rise: Float[Array, " roller"] | None
    traction: Traction | None
    residual: Float[Array, ""]
    mixed: MixedState | None


class RollerBalance(NamedTuple):
    """Forces of the raceways on every roller, constraint forces in pure rolling; the first axis runs over the races.

    - `arms`: moments A_k about the apex, N m, of constraint forces.
    - `traction`: circumferential force on the roller, without the part that rolling resistance exerts, N.
    """

    arms: Float[Array, "2 roller"] | None
    traction: Float[Array, "2 roller"]


class TaperedFriction(NamedTuple):
    """Friction of races and rib, oil drag on a roller, N, balance of the rollers, and losses and torques. `balance` is
    `None` if the scene models no friction. `cage` and `pocket`: state of the cage and films of its pockets, `None` in
    pure rolling."""

    races: RaceFriction
    rib: RibFriction | None
    drag_force: Array | None
    balance: RollerBalance | None
    totals: FrictionTotals[TaperedPowerLoss]
    cage: CageState | None = None
    pocket: PocketFilm | None = None


class _Roller(NamedTuple):
    """Geometry in the equations of friction.

    - `sine`: sin(alpha_k).
    - `line`: unit vectors p_k = (a, r) from the apex along the lines of contact.
    - `double`: sin(2 epsilon).
    - `reach`: distance rho of mid length from the apex, m.
    """

    sine: Float[Array, "2 1"]
    line: Float[Array, "component race 1"]
    double: Array
    reach: Array


def rib_motion(geometry: TaperedGeometry, spin_speed: Array, relative: Array | None = None) -> RibMotion:
    """Motion at the rib (see the module).

    **Arguments:** `spin_speed`: of the rollers, rad/s; `relative`: speed of the inner ring relative to the orbit,
    rad/s, by default that of pure rolling, which follows from the spin without cancellation.
    """
    if relative is None:
        relative = spin_speed * jnp.sin(geometry.roller_half_angle) / jnp.sin(geometry.cone_angle)
    rib = relative * geometry.flange_radius
    end = spin_speed * geometry.sphere_radius * jnp.sin(geometry.flange_tilt)
    spin = relative * jnp.cos(jnp.asarray(geometry.rib_angle)) + spin_speed * jnp.cos(geometry.flange_tilt)
    return RibMotion(0.5 * (rib + end), rib - end, spin)


def tapered_friction(scene: TaperedRollerBearing, state: TaperedState) -> TaperedFriction:
    """Films, friction, losses and torques at the loads of a solution. **Arguments:** `scene`: it must have an oil and
    contact laws."""
    geometry, operation, oil = scene.geometry, scene.operation, scene.oil
    assert scene.contact is not None
    assert oil is not None
    motion, inlet, elsewhere = rolling_motion(geometry, operation), oil_of_races(scene), oil_elsewhere(scene)
    modulus = scene.materials.race_modulus
    roller = _roller(geometry)
    races = _races(geometry, scene.contact, state.load, roller.reach, motion, modulus, oil, inlet)
    rib = None
    if scene.rib is not None:
        load, at_rib = state.flange_load, oil_of(inlet, elsewhere, "flange")
        pressing = (load, jnp.where(load > 0, load, 1.0), load > 0)
        rib = rib_friction(scene.rib, geometry, modulus, oil, at_rib, rib_motion(geometry, motion.spin_speed), pressing)
    drag = None
    if scene.drag is not None:
        fraction, temperature = scene.drag.through_flow_fraction, oil_temperature(scene, "drag")
        density = drag_density(oil, operation, geometry.pitch_diameter, fraction, temperature)
        area = jnp.asarray(geometry.roller_length) * geometry.mean_roller_diameter
        speed = 0.5 * geometry.pitch_diameter * motion.orbital_speed
        drag = RollerDrag(jnp.asarray(scene.drag.coefficient), area).force(speed, density)
    traction = None if rib is None else rib.traction
    nothing = TaperedFriction(races, rib, drag, None, friction_totals(TaperedPowerLoss, [], scene.operation))
    if races.rolling is None and traction is None and drag is None:
        return nothing
    balance, torques = _balance(geometry, roller, races, traction, drag)
    multiplicity = geometry.n_rollers // state.load.shape[1]
    total = lambda values: multiplicity * jnp.sum(values, axis=-1)
    inner, outer = total(torques)
    # the constraint forces act on the rings and do no work
    interactions = [Interaction("", None, inner, outer)]
    if races.rolling is not None:
        powers = total(races.rolling * races.speed)
        interactions.append(Interaction("rolling_resistance", jnp.sum(powers), by_race=powers))
    if traction is not None:
        interactions.append(Interaction("flange", total(traction.power)))
    if drag is not None:
        power = geometry.n_rollers * drag * 0.5 * geometry.pitch_diameter * motion.orbital_speed
        interactions.append(Interaction("drag", power))
    return nothing._replace(balance=balance, totals=friction_totals(TaperedPowerLoss, interactions, scene.operation))


def _roller(geometry: TaperedGeometry) -> _Roller:
    half = jnp.asarray(geometry.roller_half_angle)
    angle = jnp.stack([geometry.cone_angle, jnp.asarray(geometry.contact_angle)])[:, None]
    sine, cosine = jnp.sin(angle), jnp.cos(angle)
    reach = geometry.apex_distance - 0.5 * geometry.roller_length
    return _Roller(sine, jnp.stack([-cosine, sine]), jnp.sin(2.0 * half), reach)


def _races(
    geometry: TaperedGeometry,
    laws: ContactLaws,
    load: Float[Array, "2 roller"],
    reach: Array,
    motion: TaperedMotion,
    modulus: Array,
    oil: Lubricant,
    inlet: InletOil,
) -> RaceFriction:
    """Friction of the raceways: evenly loaded line contacts with the reduced radius and the speed of mid length."""
    contact = LineContact(
        geometry.race_reduced_radii(jnp.asarray(0.5))[:, None], jnp.asarray(geometry.roller_length), modulus
    )
    speed = motion.spin_speed * reach * jnp.sin(geometry.roller_half_angle) * jnp.ones((2, 1))
    loaded = load > 0
    pressing, still = jnp.where(loaded, load, 1.0), jnp.zeros_like(load)
    alone = dataclasses.replace(laws, traction=None, mixed=None)
    state = alone.evaluate(contact, pressing, speed + still, still, oil, inlet)
    rise, capacity, asperities = state.temperature_rise, None, None
    if laws.traction is not None:
        base = inlet.temperature + (still if rise is None else rise)
        capacity = laws.traction.force(
            contact,
            pressing,
            state.film,
            laws.entrainment(speed) + still,
            SKIDDING * jnp.abs(speed) + still,
            base,
            oil,
            oil.viscosity.viscosity(0.0, base),
        )
        if laws.mixed is not None:
            asperities = laws.asperities(contact, pressing, state.film, speed + still, inlet)
            capacity = laws.mixed.force(pressing, asperities.share, capacity, SKIDDING * jnp.abs(speed) + still)
            asperities = jax.tree.map(lambda values: jnp.where(loaded, values, jnp.nan), asperities)
    present = lambda values, absent: None if values is None else jnp.where(loaded, values, absent)
    return RaceFriction(
        film=jnp.where(loaded, state.film, jnp.nan),
        temperature_rise=present(rise, jnp.nan),
        rolling=present(state.rolling_force, 0.0),
        capacity=present(capacity, 0.0),
        speed=speed,
        radius=jnp.broadcast_to(contact.reduced_radius, (2, 1)),
        residual=state.inner_residual,
        asperities=asperities,
        starved=state.supply,
    )


def rib_friction(
    laws: PointLaws,
    geometry: TaperedGeometry,
    modulus: Array,
    oil: Lubricant,
    inlet: InletOil,
    moving: RibMotion,
    pressed: tuple[Array, Array, Array],
) -> RibFriction:
    """Films and friction of the roller ends on the rib.

    **Arguments:** `modulus`: reduced modulus of the raceway contacts, Pa; `inlet`: oil of the rib; `pressed`: load of
    each contact, N, the load at which its laws are evaluated, N, and the factor of its friction.
    """
    contact: PointContact = geometry.flange_contact(modulus).shaped()
    load, pressing, share = pressed
    loaded, ones = load > 0, jnp.ones_like(load)
    mean, sliding = moving.mean_speed * ones, moving.sliding_speed * ones
    film: PointFilm = laws.film_state(contact, pressing, mean, sliding, oil, inlet)
    traction, mixed = None, None
    if laws.traction is not None:
        slides = Sliding(sliding, spin=moving.spin * ones)
        shear = laws.shear(contact, pressing, film, mean, slides, oil)
        mixed = laws.mixed_state(contact, pressing, film, mean, slides, shear, oil)
        present = lambda values: jnp.where(share, values, 0.0) if share.dtype == bool else share * values
        traction = shear._replace(
            rolling=present(shear.rolling), moment=present(shear.moment), power=present(shear.power)
        )
    return RibFriction(
        motion=moving,
        film=jnp.where(loaded, film.film, jnp.nan),
        temperature_rise=None if film.rise is None else jnp.where(loaded, film.rise, jnp.nan),
        traction=traction,
        residual=jnp.max(film.residual),
        mixed=None if mixed is None else where_loaded(mixed, loaded),
    )


def where_loaded(mixed: MixedState, loaded: Array) -> MixedState:
    """Mixed friction, with boundary friction 0 and film ratio, load share and flash temperature NaN for contacts
    without load."""
    absent = (jnp.nan, jnp.nan, 0.0, 0.0, jnp.nan)
    return MixedState(*(jnp.where(loaded, values, none) for values, none in zip(mixed, absent, strict=True)))


def _balance(
    geometry: TaperedGeometry, roller: _Roller, races: RaceFriction, rib: Traction | None, drag: Array | None
) -> tuple[RollerBalance, Float[Array, "2 roller"]]:
    """Balance of each roller about the apex, and torques that drive the rings against each roller, N m."""
    moment, force, torque = jnp.zeros_like(races.film), jnp.zeros(races.film.shape[1]), jnp.zeros_like(races.film)
    if races.rolling is not None:
        couple = races.rolling * races.radius
        moment = moment - jnp.sum(couple[None] * roller.line, axis=1)
        torque = torque - couple * roller.line[0]
    if rib is not None:
        of_rib = jnp.stack(geometry.rib_moment(rib.rolling, rib.moment))
        moment, force = moment + of_rib, force + rib.rolling
        torque = torque + jnp.stack([of_rib[0], jnp.zeros_like(force)])
    if drag is not None:
        radius = 0.5 * geometry.pitch_diameter
        arm = jnp.stack([radius, radius / jnp.tan(geometry.axis_angle)])[:, None]
        moment, force = moment - drag * arm, force - drag
    across = jnp.sum(moment[:, None, :] * roller.line[:, ::-1], axis=0) / roller.double
    arms = jnp.asarray([[-1.0], [1.0]]) * across
    # forces at mid length; both races share what is missing in the balance of forces
    at_middle = arms / roller.reach
    traction = at_middle - 0.5 * (force + jnp.sum(at_middle, axis=0))[None]
    if races.rolling is not None:
        lean = races.radius / (roller.reach * jnp.tan(geometry.roller_half_angle)) - 0.5
        traction = traction - jnp.asarray([[1.0], [-1.0]]) * races.rolling * lean
    return RollerBalance(arms, traction), torque + arms * roller.sine
