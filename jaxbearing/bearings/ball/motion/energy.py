r"""Energy of the moving ball bearing: losses, works and stored energies, and what balances them.

With the forces f conjugate to the interaction speeds s, $G^Tf\cdot\dot q = f\cdot s$ at every state, hence

$$\frac{dE_{kin}}{dt} = P_{drive} + P_{load} - \sum D - P_{damping} - \Pi_{pocket} - \Pi_{race},$$

$E_{kin}$ that of balls, cage and ring (without the given rotation of the ring), and

- $P_{drive} = -\sum_k\omega_kG_{\omega k}$: of the torques that keep the rings turning;
- $P_{load}$: of the loads on the ring, of the imbalance of the cage and of the force that keeps a ball that nothing
  loads in its place (`FORCE_FLOOR`);
- D: friction of races, pockets, lands and drag, each force times its own sliding speed; $P_{damping}$: of the contacts,
  $\sum(N - Q)\dot\delta$, and of the ring from outside;
- $\Pi_{pocket} = \sum(W_1 - W_2)\dot\sigma$: work that closes the pocket films. A part is stored by the walls,
  $\sum\frac25W^{5/3}/K_p^{2/3}$, the rest squeezes oil out. Films between balls count here where there is no cage;
- $\Pi_{race} = \sum Q\,\dot l$: work that brings the centres of balls and grooves apart. It is stored,
  $\sum\frac25Q^{5/3}/K^{2/3}$, but for what changing films take.
"""

from typing import TYPE_CHECKING

import jax.numpy as jnp
from jaxtyping import Array, Float

from ...._types import Scalar
from ....numerics.arrow import ArrowPoint
from ..core import FORCE_FLOOR
from ..solution import BallPowerLoss
from .results import BallEnergy, BallInstant, LooseBallPowerLoss

if TYPE_CHECKING:
    from .rates import BallDynamics, MovingBalls

WORKS = ("drive", "dissipation", "damping", "pocket_films", "raceways", "load")
"""Works that are integrated beside the motion, in their order in the state."""


def race_losses(now: "MovingBalls") -> tuple[Float[Array, "2 ball"], Float[Array, "2 ball"] | None]:
    """Losses of every ball on both races by sliding and spin, and by rolling resistance (`None`: not modelled), W."""
    on, at = now.forces.races, now.speeds.races
    # the laws' rolling resistance stands apart; the rest of the moment against the roll is sliding
    all_together = -(on.rolling * at.rolling + on.transverse * at.transverse + on.spin * at.spin + on.roll * at.roll)
    if now.friction.resistance is None:
        return all_together, None
    rolled = -now.friction.resistance * at.roll
    return all_together - rolled, rolled


def pocket_losses(now: "MovingBalls") -> Float[Array, " ball"] | None:
    """Losses of every ball by sliding in its pocket, W; `None` without a cage."""
    forces, speeds = now.forces.pocket, now.speeds.pocket
    if forces is None or speeds is None:
        return None
    return -jnp.sum(forces.surface * speeds.surface, axis=(0, 1))


def power_by_location(dynamics: "BallDynamics", now: "MovingBalls") -> BallPowerLoss:
    """Losses by friction, W."""
    forces, speeds = now.forces, now.speeds
    sliding, rolled = race_losses(now)
    inner, outer = jnp.sum(sliding, axis=1)
    resistance = None if rolled is None else jnp.sum(rolled)
    in_pockets, lands, drag = pocket_losses(now), None, None
    pocket = None if in_pockets is None else jnp.sum(in_pockets)
    if forces.lands is not None and speeds.lands is not None:
        turning = jnp.sum(forces.lands.turning * speeds.lands.turning)
        lands = -jnp.sum(forces.lands.offset * speeds.lands.offset) - turning
    if dynamics.drag is not None:
        drag = -jnp.sum(forces.drag * speeds.drag)
    parts = [part for part in (inner, outer, resistance, pocket, lands, drag) if part is not None]
    names: dict[str, Array | None] = {
        "inner_raceway": inner,
        "outer_raceway": outer,
        "rolling_resistance": resistance,
        "pocket": pocket,
        "cage_pilot": lands,
        "drag": drag,
    }
    total = sum(parts[1:], parts[0])
    if forces.neighbours is None or speeds.neighbours is None:
        return BallPowerLoss(total=total, **names)
    rubbed = -jnp.sum(forces.neighbours.sliding * speeds.neighbours.sliding)
    return LooseBallPowerLoss(total=total + rubbed, **names, between_balls=rubbed)


def drive_power(now: "MovingBalls") -> Float[Array, ""]:
    """Power of the torques that keep the rings turning, W."""
    return -jnp.sum(now.generalised.races * now.rates.races)


def damping_power(dynamics: "BallDynamics", now: "MovingBalls") -> Float[Array, ""]:
    """Loss by the damping of the raceway contacts and of the ring, W."""
    contacts = jnp.sum((now.load - now.pressed.load) * now.speeds.apart)
    return contacts - jnp.sum(dynamics.ring.damping_force(now.rates.ring) * now.rates.ring)


def powers(dynamics: "BallDynamics", time: Scalar, now: "MovingBalls") -> Float[Array, " work"]:
    """Rates of `WORKS`, W."""
    loss = power_by_location(dynamics, now).total
    assert loss is not None
    films = jnp.zeros(())
    load = jnp.sum(dynamics.ring_load(time) * now.rates.ring) + FORCE_FLOOR * jnp.sum(now.rates.centre[1])
    if now.forces.pocket is not None and now.speeds.pocket is not None:
        films = -jnp.sum(now.forces.pocket.opening * now.speeds.pocket.opening)
    if now.forces.neighbours is not None and now.speeds.neighbours is not None:
        films = films - jnp.sum(now.forces.neighbours.apart * now.speeds.neighbours.apart)
    if dynamics.cage is not None:
        angle = now.places.pockets[0] - dynamics.azimuth[0]
        turning = dynamics.cage.imbalance_force(now.rates.cage[5], angle)
        load = load + jnp.sum(turning * now.rates.cage[:3])
    raceways = jnp.sum(now.pressed.load * now.speeds.apart)
    return jnp.stack([drive_power(now), loss, damping_power(dynamics, now), films, raceways, load])


def kinetic_energy(dynamics: "BallDynamics", now: "MovingBalls") -> Float[Array, ""]:
    """Kinetic energy of balls, cage and ring, without the given rotation of the ring, J."""
    rates, radius = now.rates, now.places.radius
    centre = jnp.square(radius * rates.orbit) + jnp.sum(jnp.square(rates.centre), axis=0)
    w_x, w_r, w_t = rates.spin
    spin = jnp.square(rates.orbit - w_x) + jnp.square(w_r) + jnp.square(w_t)
    total = 0.5 * jnp.sum(dynamics.mass * centre + dynamics.inertia * spin) + dynamics.ring.kinetic_energy(rates.ring)
    return total if dynamics.cage is None else total + dynamics.cage.kinetic_energy(rates.cage)


def pocket_energy(dynamics: "BallDynamics", now: "MovingBalls") -> Float[Array, ""]:
    """Elastic energy of the pocket walls, or of balls that meet, J."""
    if dynamics.neighbours is not None and now.met is not None:
        return jnp.sum(dynamics.neighbours.law.elastic_energy(now.met.load))
    if dynamics.cage is None or now.walls is None:
        return jnp.zeros(())
    return jnp.sum(dynamics.cage.pocket.elastic_energy(now.walls.load))


def raceway_energy(dynamics: "BallDynamics", now: "MovingBalls") -> Float[Array, ""]:
    """Elastic energy of the raceway contacts, J."""
    stiffness = dynamics.levers.grooves.stiffness[:, None]
    return 0.4 * jnp.sum(now.pressed.load * jnp.square(jnp.cbrt(now.pressed.load / stiffness)))


def energy_of(dynamics: "BallDynamics", state: ArrowPoint, first: BallInstant, last: BallInstant) -> BallEnergy:
    """The works of the run up to a state, and how well they balance."""
    works: dict[str, Array] = dict(zip(WORKS, jnp.asarray(dynamics.unscaled(state)[2]), strict=True))
    gain = lambda name: jnp.asarray(getattr(last, name)) - jnp.asarray(getattr(first, name))
    kinetic = gain("kinetic_energy")
    spent = works["dissipation"] + works["damping"] + works["pocket_films"] + works["raceways"]
    left = works["drive"] + works["load"] - spent - kinetic
    return BallEnergy(
        drive=works["drive"],
        dissipation=works["dissipation"],
        pocket_films=works["pocket_films"],
        kinetic=kinetic,
        pocket_elastic=gain("pocket_energy"),
        damping=works["damping"],
        raceways=works["raceways"],
        raceway_elastic=gain("raceway_energy"),
        load_on_ring=works["load"],
        error=left / jnp.maximum(jnp.abs(works["drive"]), 1e-300),
    )
