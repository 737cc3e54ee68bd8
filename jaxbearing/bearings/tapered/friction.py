r"""Friction of a tapered roller bearing: what it takes to keep the rollers rolling without sliding about the apex.

Raceways. A cone that rolls on a cone of the same apex touches it at rest along the whole line, whatever forces act: the
tangential forces there are *constraint forces*, which do no work and follow from the balance of the roller; slip stays
microscopic as long as they are small against what the film carries (`SKIDDING`, a warning). They push only around the
bearing, and every one of them passes at a distance $\rho$ from the apex: with $A_k = \int t_k\rho\,d\rho$ their moment
about the *apex* is $A_k m_k$, $m_k = (\sin\alpha_k, \cos\alpha_k)$ in (a, r), wherever along the line they act. Moments
about the apex in the meridian plane are two equations for the two unknowns of a roller, $A_i$ and $A_o$:

$A_i m_i + A_o m_o + G = 0$, $A_i = -G\cdot p_o/\sin2\epsilon$, $A_o = G\cdot p_i/\sin2\epsilon$, $p_k = (-\cos\alpha_k,
\sin\alpha_k)$,

with all that dissipates in G. In a frame that orbits with the rollers, S the spin of a roller (`spin_speed`):

- *Rolling resistance*, force $P_k$ and power $P_ku$ (`contacts.rolling`) at $u = S\rho\sin\epsilon$, $\rho$ of mid
  length. Ring and roller turn against each other at $S\sin\gamma/\sin\alpha_k$ about the line of contact; the pressure,
  displaced against the motion, is a couple $-P_kR_kp_k$ on the roller, $R_k = \rho\sin\epsilon\sin\alpha_k/\sin\gamma$
  the reduced radius. (What it pushes around the bearing belongs to the constraint force.)
- *Rib*: at $x_f = (a_f, r_f)$ rib and roller end move with $u_1 = (\omega_i - \omega_m)r_f$ and $u_2 = SR_s\sin\theta$;
  they slide on each other and spin about the normal $n_f$ with $(\omega_i - \omega_m)\cos\alpha_f + S\cos\theta$. The
  film sheared in the Hertz ellipse gives a force $F_f$ around the bearing and a moment $M_f$ about the normal,
  $F_f(r_f, -a_f) + M_fn_f$. Left out: shear outside the ellipse, and the rolling resistance of what little rolls there.
- *Drag* D against the orbit, at mid length on the roller axis: $-D(r_m, -a_m)$.

Gyroscopic and normal forces have no moment in that plane. The torques that drive the rings are assembled from the same
forces, $\sum[A_i\sin\alpha_i + P_iR_i\cos\alpha_i + F_fr_f + M_f\cos\alpha_f]$ and $\sum[A_o\sin\alpha_o +
P_oR_o\cos\alpha_o]$; that their power is the sum of the dissipations tests every sign.

**Validity:** pure rolling. Friction does not change the normal loads and does not skew the rollers (the rib's force
along its generator and what friction does to the cone's equilibrium are left out). There is no cage: where a roller
without load on the cone is dragged, the constraint forces stand for the pocket that would push it, and are none of
the raceways.
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
from ...contacts.point_laws import PointFilm
from ...gaps import RollerDrag
from ...lubricants import InletOil, Lubricant
from ..inlet import oil_elsewhere, oil_of, oil_of_races, oil_temperature
from ..interactions import FrictionTotals, Interaction, friction_totals
from ..parts import drag_density
from .build import TaperedMotion, rolling_motion
from .geometry import TaperedGeometry
from .scene import TaperedRollerBearing
from .solution import TaperedPowerLoss
from .system import TaperedState

SKIDDING = 0.1
"""Sliding over rolling at which the traction that a film can carry is taken: beyond it films and rolling resistance are
no laws for rolling."""


class RibMotion(NamedTuple):
    """At the contact with the rib, seen from the orbiting frame: mean speed of both surfaces and speed of the rib over
    the roller end around the bearing, m/s; spin of the rib over the roller end about the normal into the roller,
    rad/s."""

    mean_speed: Array
    sliding_speed: Array
    spin: Array


class RaceFriction(NamedTuple):
    """Raceway contacts, races first. Without load a contact is not there: film and rise are NaN, forces are 0.

    `film`, m; `temperature_rise`, K; `rolling`, the force P, N; `capacity`: the traction at a slide-to-roll ratio of
    `SKIDDING`, N; `speed`, m/s, and `radius`, m, of shape (2, 1); `residual` of nested solves; `asperities`: of mixed
    friction; `starved`: what little oil does. None: not modelled.
    """

    film: Float[Array, "2 roller"]
    temperature_rise: Float[Array, "2 roller"] | None
    rolling: Float[Array, "2 roller"] | None
    capacity: Float[Array, "2 roller"] | None
    speed: Float[Array, "2 1"]
    radius: Float[Array, "2 1"]
    residual: Float[Array, ""]
    asperities: Asperities | None
    starved: Starvation | None


class RibFriction(NamedTuple):
    """Contacts of the roller ends, as in `RaceFriction`; `traction`: force, moment about the normal and power of film
    and asperities, of the rib on the roller; `mixed`: mixed friction."""

    motion: RibMotion
    film: Float[Array, " roller"]
    temperature_rise: Float[Array, " roller"] | None
    traction: Traction | None
    residual: Float[Array, ""]
    mixed: MixedState | None


class RollerBalance(NamedTuple):
    """Constraint forces of the raceways on every roller, races first: moments A_k about the apex, N m, and force on the
    roller around the bearing less that of the rolling resistance, N."""

    arms: Float[Array, "2 roller"]
    traction: Float[Array, "2 roller"]


class TaperedFriction(NamedTuple):
    """Friction of races and rib, and the balance of the rollers; `balance` is `None` if the scene models none."""

    races: RaceFriction
    rib: RibFriction | None
    drag_force: Array | None
    balance: RollerBalance | None
    totals: FrictionTotals[TaperedPowerLoss]


class _Roller(NamedTuple):
    """Geometry of friction: sin(alpha_k); unit vectors (a, r) p_k from the apex along the lines of contact; sin(2 eps);
    rho of mid length, m."""

    sine: Float[Array, "2 1"]
    line: Float[Array, "component race 1"]
    double: Array
    reach: Array


def rib_motion(geometry: TaperedGeometry, motion: TaperedMotion) -> RibMotion:
    """See the module. The speeds of the rings against the rollers are taken from the spin, in which nothing cancels."""
    orbiting = motion.spin_speed * jnp.sin(geometry.roller_half_angle) / jnp.sin(geometry.cone_angle)
    rib = orbiting * geometry.flange_radius
    end = motion.spin_speed * geometry.sphere_radius * jnp.sin(geometry.flange_tilt)
    spin = orbiting * jnp.cos(jnp.asarray(geometry.rib_angle)) + motion.spin_speed * jnp.cos(geometry.flange_tilt)
    return RibMotion(0.5 * (rib + end), rib - end, spin)


def tapered_friction(scene: TaperedRollerBearing, state: TaperedState) -> TaperedFriction:
    """Films, friction, losses and torques at the loads of a solution. **Arguments:** `scene` with oil and contact."""
    geometry, operation, oil = scene.geometry, scene.operation, scene.oil
    assert scene.contact is not None
    assert oil is not None
    motion, inlet, elsewhere = rolling_motion(geometry, operation), oil_of_races(scene), oil_elsewhere(scene)
    modulus = scene.materials.race_modulus
    roller = _roller(geometry)
    races = _races(geometry, scene.contact, state.load, roller.reach, motion, modulus, oil, inlet)
    rib = (
        None
        if scene.rib is None
        else _rib(scene, state.flange_load, motion, modulus, oil_of(inlet, elsewhere, "flange"))
    )
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
    # what keeps the rollers rolling acts on the rings and does no work
    found = [Interaction("", None, inner, outer)]
    if races.rolling is not None:
        powers = total(races.rolling * races.speed)
        found.append(Interaction("rolling_resistance", jnp.sum(powers), by_race=powers))
    if traction is not None:
        found.append(Interaction("flange", total(traction.power)))
    if drag is not None:
        power = geometry.n_rollers * drag * 0.5 * geometry.pitch_diameter * motion.orbital_speed
        found.append(Interaction("drag", power))
    return nothing._replace(balance=balance, totals=friction_totals(TaperedPowerLoss, found, scene.operation))


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
    """Even line contacts of the size and speed at mid length."""
    contact = LineContact(
        geometry.race_reduced_radii(jnp.asarray(0.5))[:, None], jnp.asarray(geometry.roller_length), modulus
    )
    speed = motion.spin_speed * reach * jnp.sin(geometry.roller_half_angle) * jnp.ones((2, 1))
    loaded = load > 0
    pressing, still = jnp.where(loaded, load, 1.0), jnp.zeros_like(load)
    alone = dataclasses.replace(laws, traction=None, mixed=None)
    found = alone.evaluate(contact, pressing, speed + still, still, oil, inlet)
    rise, capacity, asperities = found.temperature_rise, None, None
    if laws.traction is not None:
        base = inlet.temperature + (still if rise is None else rise)
        capacity = laws.traction.force(
            contact,
            pressing,
            found.film,
            laws.entrainment(speed) + still,
            SKIDDING * jnp.abs(speed) + still,
            base,
            oil,
            oil.viscosity.viscosity(0.0, base),
        )
        if laws.mixed is not None:
            asperities = laws.asperities(contact, pressing, found.film, speed + still, inlet)
            capacity = laws.mixed.force(pressing, asperities.share, capacity, SKIDDING * jnp.abs(speed) + still)
            asperities = jax.tree.map(lambda values: jnp.where(loaded, values, jnp.nan), asperities)
    present = lambda values, absent: None if values is None else jnp.where(loaded, values, absent)
    return RaceFriction(
        film=jnp.where(loaded, found.film, jnp.nan),
        temperature_rise=present(rise, jnp.nan),
        rolling=present(found.rolling_force, 0.0),
        capacity=present(capacity, 0.0),
        speed=speed,
        radius=jnp.broadcast_to(contact.reduced_radius, (2, 1)),
        residual=found.inner_residual,
        asperities=asperities,
        starved=found.supply,
    )


def _rib(
    scene: TaperedRollerBearing, load: Float[Array, " roller"], motion: TaperedMotion, modulus: Array, inlet: InletOil
) -> RibFriction:
    laws, oil = scene.rib, scene.oil
    assert laws is not None
    assert oil is not None
    contact: PointContact = scene.geometry.flange_contact(modulus).shaped()
    moving = rib_motion(scene.geometry, motion)
    loaded = load > 0
    pressing, ones = jnp.where(loaded, load, 1.0), jnp.ones_like(load)
    mean, sliding = moving.mean_speed * ones, moving.sliding_speed * ones
    film: PointFilm = laws.film_state(contact, pressing, mean, sliding, oil, inlet)
    traction, mixed = None, None
    if laws.traction is not None:
        slides = Sliding(sliding, spin=moving.spin * ones)
        shear = laws.shear(contact, pressing, film, mean, slides, oil)
        mixed = laws.mixed_state(contact, pressing, film, mean, slides, shear, oil)
        present = lambda values: jnp.where(loaded, values, 0.0)
        traction = shear._replace(
            rolling=present(shear.rolling), moment=present(shear.moment), power=present(shear.power)
        )
    return RibFriction(
        motion=moving,
        film=jnp.where(loaded, film.film, jnp.nan),
        temperature_rise=None if film.rise is None else jnp.where(loaded, film.rise, jnp.nan),
        traction=traction,
        residual=jnp.max(film.residual),
        mixed=None if mixed is None else _where_loaded(mixed, loaded),
    )


def _where_loaded(mixed: MixedState, loaded: Array) -> MixedState:
    """Nothing rubs where nothing touches, and film and temperature are not there."""
    absent = (jnp.nan, jnp.nan, 0.0, 0.0, jnp.nan)
    return MixedState(*(jnp.where(loaded, values, none) for values, none in zip(mixed, absent, strict=True)))


def _balance(
    geometry: TaperedGeometry, roller: _Roller, races: RaceFriction, rib: Traction | None, drag: Array | None
) -> tuple[RollerBalance, Float[Array, "2 roller"]]:
    """Balance of each roller about the apex; and the torque that each roller asks of the rings, N m."""
    moment, force, torque = jnp.zeros_like(races.film), jnp.zeros(races.film.shape[1]), jnp.zeros_like(races.film)
    if races.rolling is not None:
        couple = races.rolling * races.radius
        moment = moment - jnp.sum(couple[None] * roller.line, axis=1)
        torque = torque - couple * roller.line[0]
    if rib is not None:
        normal = jnp.stack([jnp.cos(jnp.asarray(geometry.rib_angle)), -jnp.sin(jnp.asarray(geometry.rib_angle))])
        axial, radius = geometry.sphere_centre[0] - geometry.sphere_radius * normal[0], geometry.flange_radius
        of_rib = rib.rolling[None] * jnp.stack([radius, -axial])[:, None] + rib.moment[None] * normal[:, None]
        moment, force = moment + of_rib, force + rib.rolling
        torque = torque + jnp.stack([of_rib[0], jnp.zeros_like(force)])
    if drag is not None:
        radius = 0.5 * geometry.pitch_diameter
        arm = jnp.stack([radius, radius / jnp.tan(geometry.axis_angle)])[:, None]
        moment, force = moment - drag * arm, force - drag
    across = jnp.sum(moment[:, None, :] * roller.line[:, ::-1], axis=0) / roller.double
    arms = jnp.asarray([[-1.0], [1.0]]) * across
    # at mid length; what the sum of forces then lacks, both share
    at_middle = arms / roller.reach
    traction = at_middle - 0.5 * (force + jnp.sum(at_middle, axis=0))[None]
    if races.rolling is not None:
        lean = races.radius / (roller.reach * jnp.tan(geometry.roller_half_angle)) - 0.5
        traction = traction - jnp.asarray([[1.0], [-1.0]]) * races.rolling * lean
    return RollerBalance(arms, traction), torque + arms * roller.sine
