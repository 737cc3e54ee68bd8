"""Forces on the rollers and on the cage of a cylindrical roller bearing, steady or moving. Frames and signs: see
`cylindrical.scene`."""

from typing import Any, Literal, NamedTuple

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...contacts import LineContact
from ...contacts.laws import ContactState
from ...gaps import EndForces, FlangeCoefficients, Pocket, PocketEdgeCoefficients, RollerDrag, ShortJournal
from ...numerics.series import cosine_and_sine
from ..inlet import oil_temperature
from ..interactions import FrictionTotals, Interaction, friction_totals
from ..parts import drag_density
from .kinematics import RollerKinematics
from .loads import per_race
from .solution import PowerLoss


class CageParts(eqx.Module):
    """Models of all forces on rollers and cage except those of the raceways, prepared for the oil at its inlet
    temperature.

    Without a cage, `pocket`, `land` and `rails` are `None`. Only a transient run can leave the cage out: rollers
    outside the loaded zone then have no steady state.
    """

    pocket: Pocket | None
    land: ShortJournal | None
    guidance: Literal["inner_ring", "outer_ring"] = eqx.field(static=True)
    rails: PocketEdgeCoefficients | None = None
    inner_flange: FlangeCoefficients | None = None
    outer_flange: FlangeCoefficients | None = None
    drag: RollerDrag | None = None
    drag_density: Float[Array, ""] | None = None


class RollerForces(NamedTuple):
    """Sum of all forces on each roller except those of the pocket walls, and parts of this sum.

    - `tangential`: force along the orbit, N.
    - `moment`: moment about the roller's centre, counter-clockwise, N m.
    """

    tangential: Float[Array, " roller"]
    moment: Float[Array, " roller"]
    inner_flange: EndForces | None
    outer_flange: EndForces | None
    rails: EndForces | None
    drag_force: Float[Array, " roller"] | None


def drag_of(scene: Any) -> tuple[RollerDrag | None, Float[Array, ""] | None]:
    """Oil drag on the rollers of a bearing with a cage, and the density of the oil-air mixture, kg/m^3; `None` if drag
    is not modelled.

    The frontal area of a roller is its length times (diameter - thickness of the cage), which the cage does not cover:
    the analogue of the source's formula for balls. It is 0 if the cage is thicker than the roller.

    **Arguments:** `scene`: of a bearing with cylindrical or tapered rollers."""
    if scene.drag is None:
        return None, None
    geometry, cage = scene.geometry, getattr(scene, "cage", None)
    thickness = 0.0 if cage is None else (cage.outside(geometry) - cage.bore(geometry)) / 2.0
    area = jnp.asarray(geometry.roller_length) * jnp.maximum(geometry.element_diameter - thickness, 0.0)
    fraction, temperature = scene.drag.through_flow_fraction, oil_temperature(scene, "drag")
    density = drag_density(scene.oil, scene.operation, geometry.pitch_diameter, fraction, temperature)
    return RollerDrag(coefficient=jnp.asarray(scene.drag.coefficient), area=area), density


def rolling_force_factor(contact: LineContact, motion: RollerKinematics) -> Float[Array, "2"]:
    r"""Tangential force that rolling resistance exerts on a roller, divided by this resistance, at the inner and at the
    outer race: $R/R_R - 1/2$ with the reduced radius R.

    For tapered rollers it is $R/(R_R\cos\epsilon) - 1/2$. This force at mid length on the roller axis has the same
    moment about the apex, across that axis, as the shear of the film and the displaced pressure together
    (`tapered.friction`)."""
    radius = per_race(contact.reduced_radius) / motion.roller_radius
    return (radius if motion.half_cosine is None else radius / motion.half_cosine) - 0.5


def forces_without_pocket(
    motion: RollerKinematics,
    contact: LineContact,
    state: ContactState,
    parts: CageParts,
    orbit: Float[Array, " roller"],
    spin: Float[Array, " roller"],
    behind: Float[Array, " roller"] | None = None,
) -> RollerForces:
    """Forces of raceways, flanges, cage rails and oil drag on the rollers.

    **Arguments:** `state`: films and friction on the raceways; `orbit`, `spin`: orbital speeds and spins, rad/s;
    `behind`: orbital speeds less the speed of the cage, rad/s, `None` if all rollers orbit with the cage.
    """
    ends = lambda part, ring_speed: None if part is None else part.evaluate(-spin, ring_speed - orbit)
    inner_flange = ends(parts.inner_flange, motion.inner_speed)
    outer_flange = ends(parts.outer_flange, motion.outer_speed)
    against_cage = -spin if behind is None else behind - spin
    rails = None if parts.rails is None else parts.rails.evaluate(against_cage)
    traction = state.traction
    assert traction is not None
    tangential = traction[0] - traction[1]
    moment = -motion.roller_radius * (traction[0] + traction[1])
    for end in (inner_flange, outer_flange, rails):
        if end is not None:
            tangential = tangential + end.tangential_force
            moment = moment + end.moment
    rolling = state.rolling_force
    if rolling is not None:
        lean = rolling_force_factor(contact, motion)
        tangential = tangential + rolling[0] * lean[0] - rolling[1] * lean[1]
        moment = moment + 0.5 * motion.roller_radius * (rolling[0] + rolling[1])
    drag = None
    if parts.drag is not None:
        drag = parts.drag.force(motion.pitch_radius * orbit, parts.drag_density)
        tangential = tangential - drag
    return RollerForces(tangential, moment, inner_flange, outer_flange, rails, drag)


def on_cage(
    motion: RollerKinematics,
    azimuth: Float[Array, " roller"],
    load: tuple[Array, Array],
    friction: tuple[Array, Array],
    rails: EndForces | None,
) -> tuple[Float[Array, " roller"], Float[Array, "2 roller"]]:
    """Moment about the bearing centre, N m, and force (X, Y), N, that each roller exerts on the cage.

    **Arguments:** `load`, `friction`: on the front and the rear pocket wall, N; `rails`: forces of the side rails on
    the rollers.
    """
    forward = load[0] - load[1]
    moment = forward * motion.pitch_radius - motion.across((friction[0] + friction[1]) * motion.roller_radius)
    if rails is not None:
        forward = forward - rails.tangential_force
        moment = moment - rails.moment - rails.tangential_force * motion.pitch_radius
    outward = motion.across(friction[0] - friction[1])
    cosine, sine = cosine_and_sine(azimuth)
    # t = (-cos, -sin), n = (-sin, cos) in (X, Y), the load along +Y
    return moment, jnp.stack([-forward * cosine - outward * sine, -forward * sine + outward * cosine])


def friction_on_rings(
    motion: RollerKinematics,
    contact: ContactState,
    sliding: Array,
    rolling: Array,
    inner_flange: EndForces | None,
    outer_flange: EndForces | None,
) -> list[Interaction]:
    """Friction and rolling resistance of the rollers on raceways and flanges.

    **Arguments:** `sliding`, `rolling`: sliding speeds and mean surface speeds on the inner and the outer race, m/s.
    """
    traction, resistance = contact.traction, contact.rolling_force
    assert traction is not None
    power = jnp.sum(traction * sliding, axis=1)
    interactions = [
        Interaction("inner_raceway", power[0], inner_torque=jnp.sum(traction[0]) * motion.inner_radius),
        Interaction("outer_raceway", power[1], outer_torque=-jnp.sum(traction[1]) * motion.outer_radius),
    ]
    if resistance is not None:
        torques = _against_rolling(motion, resistance)
        own = jnp.sum(resistance * rolling, axis=1)
        interactions.append(Interaction("rolling_resistance", jnp.sum(resistance * rolling), *torques, own))
    if inner_flange is not None:
        interactions.append(Interaction("flange", jnp.sum(inner_flange.power), -jnp.sum(inner_flange.ring_moment)))
    if outer_flange is not None:
        interactions.append(
            Interaction("flange", jnp.sum(outer_flange.power), None, -jnp.sum(outer_flange.ring_moment))
        )
    return interactions


def _against_rolling(motion: RollerKinematics, resistance: Array) -> tuple[Array, Array]:
    """Torques that drive the rings against rolling resistance, N m: half of its force acts on the ring."""
    half = 0.5 * jnp.sum(resistance, axis=1)
    return half[0] * motion.inner_radius, -half[1] * motion.outer_radius


def rolling_alone(
    contact: LineContact, motion: RollerKinematics, rolling: Float[Array, "2 roller"] | None
) -> FrictionTotals[PowerLoss]:
    r"""Power and ring torques of rollers that roll without sliding, with rolling resistance alone.

    The tractions T balance each roller and do no work: $T_i + T_o = (R_i + R_o)/2$ (moment) and $T_i - T_o =
    \lambda_oR_o - \lambda_iR_i$ (tangential force), with the rolling resistances R and the factors $\lambda$ of
    `rolling_force_factor`.

    **Arguments:** `rolling`: rolling resistances R, N; `None` if they are not modelled.
    """
    if rolling is None:
        return friction_totals(PowerLoss, [], motion)
    lean = rolling_force_factor(contact, motion)
    total = 0.5 * (rolling[0] + rolling[1])
    difference = lean[1] * rolling[1] - lean[0] * rolling[0]
    traction = 0.5 * jnp.stack([total + difference, total - difference])
    still = jnp.zeros(())
    speed = motion.surface_speeds(still, still)[0][0]
    power = jnp.sum(rolling) * speed
    own = jnp.sum(rolling, axis=1) * speed
    constraint = jnp.sum(traction, axis=1) * jnp.stack([motion.inner_radius, -motion.outer_radius])
    interactions = [
        Interaction("", None, constraint[0], constraint[1]),
        Interaction("rolling_resistance", power, *_against_rolling(motion, rolling), own),
    ]
    return friction_totals(PowerLoss, interactions, motion)
