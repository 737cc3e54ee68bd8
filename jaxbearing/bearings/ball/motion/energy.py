r"""Energy balance of the moving ball bearing: losses, works and stored energies.

The forces f are conjugate to the interaction speeds s, so that $G^Tf\cdot\dot q = f\cdot s$ in every state. Hence

$$\frac{dE_{kin}}{dt} = P_{drive} + P_{load} - \sum D - P_{damping} - \Pi_{pocket} - \Pi_{race},$$

with the kinetic energy $E_{kin}$ of balls, cage and ring (without the prescribed rotation of the ring) and

- $P_{drive} = -\sum_k\omega_kG_{\omega k}$: power of the torques that keep the rings turning;
- $P_{load}$: power of the loads on the ring, of the imbalance of the cage and of the force that keeps unloaded balls in
  the outer groove (`FORCE_FLOOR`);
- D: friction losses of races, pockets, lands and drag, each force times its own sliding speed; $P_{damping}$: losses by
  the damping of the contacts, $\sum(N - Q)\dot\delta$, and by the external damping of the ring;
- $\Pi_{pocket} = \sum(W_1 - W_2)\dot\sigma$: power that closes the pocket films. A part of the work is stored as
  elastic energy of the walls, $\sum\frac25W^{5/3}/K_p^{2/3}$; the rest squeezes out oil. Without a cage, this term is
  that of the films between the balls;
- $\Pi_{race} = \sum Q\,\dot l$: power that moves the centres of balls and grooves apart. The work is stored as elastic
  energy $\sum\frac25Q^{5/3}/K^{2/3}$, except for the work on films of changing thickness.
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
"""Works that are integrated together with the motion, in their order in the state."""


def race_losses(now: "MovingBalls") -> tuple[Float[Array, "2 ball"], Float[Array, "2 ball"] | None]:
    """Losses of every ball on both races by sliding and spin, and by rolling resistance (`None`: not modelled), W."""
    on, at = now.forces.races, now.speeds.races
    # the rolling resistance of the law is a separate loss; the rest of the moment against the roll is sliding
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
    """Friction losses by location, W."""
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
    """Power loss by the damping of the raceway contacts and of the ring, W."""
    contacts = jnp.sum((now.load - now.pressed.load) * now.speeds.apart)
    return contacts - jnp.sum(dynamics.ring.damping_force(now.rates.ring) * now.rates.ring)


def powers(dynamics: "BallDynamics", time: Scalar, now: "MovingBalls") -> Float[Array, " work"]:
    """Powers whose integrals over time are the `WORKS`, W."""
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
    """Kinetic energy of balls, cage and ring, without the prescribed rotation of the ring, J."""
    rates, radius = now.rates, now.places.radius
    centre = jnp.square(radius * rates.orbit) + jnp.sum(jnp.square(rates.centre), axis=0)
    w_x, w_r, w_t = rates.spin
    spin = jnp.square(rates.orbit - w_x) + jnp.square(w_r) + jnp.square(w_t)
    total = 0.5 * jnp.sum(dynamics.mass * centre + dynamics.inertia * spin) + dynamics.ring.kinetic_energy(rates.ring)
    return total if dynamics.cage is None else total + dynamics.cage.kinetic_energy(rates.cage)


def pocket_energy(dynamics: "BallDynamics", now: "MovingBalls") -> Float[Array, ""]:
    """Elastic energy of the pocket walls or, without a cage, of the ball-to-ball contacts, J."""
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
    """The works of a run up to a state, the changes of the stored energies, and the error of the energy balance.

    **Arguments:** `state`: last state; `first`, `last`: results at the start and at the end."""
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
