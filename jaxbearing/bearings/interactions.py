"""Friction of a bearing. An *interaction* is the friction, or a constraint force, at one place; losses, torques and
drive power are sums over all interactions.

The power of an interaction is its force times its sliding speed, or its mean speed for rolling resistance. Its torques
are those that drive the rings against it: the opposite of the moments of its forces on the rings. The drive power is
the sum of driving torque times speed over both rings. In a steady state it must equal the sum of the dissipations.
The code does not use this equality; tests compare the two, and would find a wrong sign of a torque.
"""

from collections.abc import Callable, Sequence
from typing import Generic, NamedTuple, Protocol, TypeVar

import jax.numpy as jnp
from jaxtyping import Array, Float

from .._types import Values

Losses = TypeVar("Losses")


class Interaction(NamedTuple):
    """Friction, or a constraint force without power, at one place of a bearing.

    **Arguments:**
    - `location`: field of the family's losses that takes this power; "" for a constraint force.
    - `power`: dissipation, W; `None` for a constraint force, which does no work.
    - `inner_torque`, `outer_torque`: torque that drives the ring against this friction, N m; `None` if it does not act
      on that ring.
    - `by_race`: power of the rolling resistance at the inner and at the outer raceway, W. At most one interaction of a
      bearing has it; it is `None` for all others.
    """

    location: str
    power: Float[Array, ""] | None = None
    inner_torque: Float[Array, ""] | None = None
    outer_torque: Float[Array, ""] | None = None
    by_race: Float[Array, "2"] | None = None


class FrictionTotals(NamedTuple, Generic[Losses]):
    """Sums over all interactions: losses, W, drive power, W, and torques that drive the rings, N m. If no loss is
    modelled, the drive power, the torques and all fields of `power_loss` are `None`. `rolling_by_race`: the `by_race`
    of the interaction that has it, W."""

    power_loss: Losses
    drive_power: Float[Array, ""] | None = None
    inner_torque: Float[Array, ""] | None = None
    outer_torque: Float[Array, ""] | None = None
    rolling_by_race: Float[Array, "2"] | None = None


class TurningRings(Protocol):
    """Protocol of objects with the speeds of both rings, rad/s."""

    @property
    def inner_speed(self) -> Values: ...

    @property
    def outer_speed(self) -> Values: ...


def friction_totals(
    losses: Callable[..., Losses], interactions: Sequence[Interaction], motion: TurningRings
) -> FrictionTotals[Losses]:
    """Losses, drive power and ring torques of a bearing.

    **Arguments:** `losses`: the class that holds the losses of the family, with one field for each location and one for
    the `total`; `interactions`: all places of friction; `motion`: speeds of the rings.
    """
    if not interactions:
        return FrictionTotals(losses())
    powers: dict[str, Array] = {}
    for friction in interactions:
        if friction.power is not None:
            powers[friction.location] = (
                powers[friction.location] + friction.power if friction.location in powers else friction.power
            )
    inner, outer = (
        _sum([torque for friction in interactions if (torque := getattr(friction, f"{ring}_torque")) is not None])
        for ring in ("inner", "outer")
    )
    drive = motion.inner_speed * inner + motion.outer_speed * outer
    rolling = next((friction.by_race for friction in interactions if friction.by_race is not None), None)
    return FrictionTotals(losses(total=_sum(list(powers.values())), **powers), drive, inner, outer, rolling)


def _sum(values: Sequence[Array]) -> Float[Array, ""]:
    return sum(values[1:], jnp.asarray(values[0])) if values else jnp.zeros(())


def of_land(power: Array, ring_torque: Array, guidance: str) -> Interaction:
    """The interaction of the cage lands (loss `cage_pilot`).

    **Arguments:** `power`: dissipation, W; `ring_torque`: torque that the friction exerts on the guiding ring, N m (the
    drive must supply its opposite); `guidance`: "inner_ring" if the inner ring guides the cage, otherwise the outer
    ring does.
    """
    ring = "inner_torque" if guidance == "inner_ring" else "outer_torque"
    return Interaction("cage_pilot", power, **{ring: -ring_torque})
