r"""Energy of the moving cylindrical roller bearing: losses, works, stored energies and their balance.

Multiplying each equation of motion (see `rates`) by its speed gives, exactly,

$$\frac{dE_{kin}}{dt} = \omega_iT_i + \omega_oT_o - \sum D - \Pi - \Lambda,$$

$E_{kin} = \sum_j[\tfrac12 m R_m^2W_j^2 + \tfrac12J(W_j - s_j)^2] + \tfrac12 m_c(V_x^2 + V_y^2) + \tfrac12J_cW_c^2$,
with the torques T that drive the rings, and

- the dissipations D, each of them a friction force times its own sliding speed: raceways $F\,\Delta u$, rolling
  resistance $P\,u$, pocket friction $(F_{C1} + F_{C2})R_R(s + W_c - W) - (F_{C1} - F_{C2})\,V\cdot n$, flanges, rails,
  lands, drag;
- $\Pi = -\sum(Q_1\dot H_1 + Q_2\dot H_2)$: power that closes the pocket films. A part of this work is stored in the
  elastic flattening of the contacts, $E_{pocket} = \sum\frac{0.9}{1.9}kQ^{1.9}$; the rest squeezes oil out;
- $\Lambda = \sum(Q_1 - Q_2)(X\sin\Psi - Y\cos\Psi)W_j$: power that the model neglects, because it takes the moment of
  the pocket loads on the cage about the centre of the bearing instead of the centre of the cage (eq. (33)).

The radial direction is quasi-static and has its own balance (the derivative of eq. (38), weighted by Q):

$$F\cdot\dot d = \frac{dE_{race}}{dt} - \Omega - \sum Q_i\frac{d(h_i + h_o)}{dt} - \sum F_c\frac{d\delta_o}{dt},$$

$E_{race} = \sum\frac{0.9}{1.9}(k_iQ_i^{1.9} + k_oQ_o^{1.9})$. The raceways store the work of the load on the ring,
except for the work on the films, the work of the centrifugal force, and $\Omega = \sum Q_i\,(d\cdot t)\,W_j$: the
rollers roll into the wedge between the displaced rings, and the model neglects the tangential force
$Q_i\,(d\cdot t)/R_m$ that would supply this work. If raceways are not round, $\Omega$ has the additional part
$\sum Q_ip'(\psi_j)\,W_j$, neglected for the same reason; p is the closing of the rings by their deviations. The
identities hold to round-off at every state, which `tests` check.
"""

from typing import TYPE_CHECKING

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....numerics.arrow import ArrowPoint
from ....numerics.series import cosine_and_sine
from ...interactions import FrictionTotals, Interaction, friction_totals, of_land
from ..forces import friction_on_rings
from ..solution import PowerLoss
from .results import RollerEnergy, RollerInstant

if TYPE_CHECKING:
    from .rates import MovingState, RollerDynamics

WORKS = ("drive", "dissipation", "pocket_films", "lever_arm", "load")
"""Works that are integrated together with the motion, in the order of the state."""
_PALMGREN_ENERGY = 0.9 / 1.9


def power_by_location(dynamics: "RollerDynamics", now: "MovingState") -> FrictionTotals[PowerLoss]:
    """Losses by location and drive power, W, and torques that drive the rings, N m. Each loss is computed from the
    force and the sliding speed of its own interaction. The power that squeezes the pocket films is not among them (see
    `powers`)."""
    motion, forces, parts = now.motion, now.forces, dynamics.system.cage
    assert parts is not None
    interactions = friction_on_rings(
        motion, now.contact, now.sliding_speed, now.mean_speed, forces.inner_flange, forces.outer_flange
    )
    cosine, sine = cosine_and_sine(now.azimuth)
    behind = now.orbit - now.cage_orbit
    if now.pocket is not None:
        front, rear = now.pocket.front.friction, now.pocket.rear.friction
        outward = now.velocity[1] * cosine - now.velocity[0] * sine
        rubbing = (front + rear) * motion.roller_radius * (now.spin - behind)
        interactions.append(Interaction("pocket", jnp.sum(rubbing - (front - rear) * outward)))
    rails = forces.rails
    if rails is not None:
        along = -(now.velocity[0] * cosine + now.velocity[1] * sine)
        forward = rails.tangential_force * (motion.pitch_radius * behind - along)
        interactions.append(Interaction("element_ends", -jnp.sum(forward + rails.moment * (behind - now.spin))))
    if now.land is not None:
        interactions.append(of_land(now.land.power, now.land.ring_torque, parts.guidance))
    if forces.drag_force is not None:
        interactions.append(Interaction("drag", jnp.sum(forces.drag_force * motion.pitch_radius * now.orbit)))
    return friction_totals(PowerLoss, interactions, motion)


def powers(dynamics: "RollerDynamics", time: Scalar, now: "MovingState") -> Float[Array, " work"]:
    r"""Rates of `WORKS`, W. The rate of the load is $-\dot F\cdot d$: the work of the load is the integral of this rate
    plus the change of $F\cdot d$."""
    cost = power_by_location(dynamics, now)
    closing = lever = jnp.zeros(())
    if now.pocket is not None:
        push = now.pocket.front.load - now.pocket.rear.load
        closing = -jnp.sum(push * now.pocket.gap_rate)
        cosine, sine = cosine_and_sine(now.azimuth)
        arm = now.centre[0] * sine - now.centre[1] * cosine
        lever = jnp.sum(push * arm * now.orbit)
    time = jnp.asarray(time, dtype=float)
    _, load_rate = jax.jvp(dynamics.ring_load, (time,), (jnp.ones_like(time),))
    load = -jnp.sum(load_rate * now.distribution.ring)
    assert cost.drive_power is not None
    assert cost.power_loss.total is not None
    return jnp.stack([cost.drive_power, cost.power_loss.total, closing, lever, load])


def kinetic_energy(dynamics: "RollerDynamics", time: Scalar, state: ArrowPoint) -> Float[Array, ""]:
    """Kinetic energy of rollers and cage, J."""
    motion = dynamics.system.kinematics
    (_, v, u), (_, _, _, v_x, v_y, v_c), _ = dynamics.unscaled(state)
    turning = dynamics.frame(time)[1]
    orbit, cage = turning + v / motion.pitch_radius, turning + v_c / motion.pitch_radius
    rollers = dynamics.system.roller_mass * jnp.square(motion.pitch_radius * orbit)
    rollers = rollers + dynamics.roller_inertia * jnp.square(orbit - u / motion.roller_radius)
    total = 0.5 * jnp.sum(rollers)
    if dynamics.cage_mass is None or dynamics.cage_inertia is None:
        return total
    return total + 0.5 * (dynamics.cage_mass * (v_x * v_x + v_y * v_y) + dynamics.cage_inertia * jnp.square(cage))


def pocket_energy(dynamics: "RollerDynamics", now: "MovingState") -> Float[Array, ""]:
    """Elastic energy of the flattening in the pocket contacts, J."""
    if now.pocket is None or dynamics.pocket is None:
        return jnp.zeros(())
    return jnp.sum(dynamics.pocket.flattening_energy(jnp.stack([now.pocket.front.load, now.pocket.rear.load])))


def raceway_energy(dynamics: "RollerDynamics", now: "MovingState") -> Float[Array, ""]:
    """Elastic energy of the raceway contacts, J."""
    load = now.distribution.load
    return _PALMGREN_ENERGY * jnp.sum(load * dynamics.system.contact.palmgren_approach(load))


def energy_of(dynamics: "RollerDynamics", state: ArrowPoint, first: RollerInstant, last: RollerInstant) -> RollerEnergy:
    """Works and changes of energy from the start of the run to a state, J, and the relative error of their balance.

    **Arguments:** `first`, `last`: instants at the start and at the state.
    """
    works = dict(zip(WORKS, jnp.asarray(dynamics.unscaled(state)[2]), strict=True))
    gain = lambda name: jnp.asarray(getattr(last, name)) - jnp.asarray(getattr(first, name))
    kinetic = gain("kinetic_energy")
    left = works["drive"] - works["dissipation"] - works["pocket_films"] - works["lever_arm"] - kinetic
    stored = [i.radial_load * i.ring.radial + i.lateral_load * i.ring.lateral for i in (first, last)]
    return RollerEnergy(
        drive=works["drive"],
        dissipation=works["dissipation"],
        pocket_films=works["pocket_films"],
        lever_arm=works["lever_arm"],
        kinetic=kinetic,
        pocket_elastic=gain("pocket_energy"),
        raceway_elastic=gain("raceway_energy"),
        load_on_ring=jnp.asarray(stored[1] - stored[0]) + works["load"],
        error=left / jnp.maximum(jnp.abs(works["drive"]), 1e-300),
    )
