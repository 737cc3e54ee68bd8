r"""Torques on the rings from the rolling resistance of balls that roll without sliding.

Without a traction law the motion of a ball is that of race control: no sliding along rolling on either race, and no
spin on the controlling race. The constraint forces of this motion, $F_{ti} = -F_{to}$ along the orbit and the moment
$M_s$ about the normal of the controlling race, do no work. They follow from the equilibrium of the ball with its
rolling resistances $M_{ri}, M_{ro}$ (see `friction`: moments about the axis and about the radius, force along the
tangent). With $c = \cos(\alpha_o - \alpha_i)$ and $s = \sin(\alpha_o - \alpha_i)$:

- outer control: $F_{ti} = \frac2D\frac{M_{ro} + cM_{ri}}{1 + c}$, $M_{so} = \frac{s}{1 + c}(M_{ro} - M_{ri})$;
- inner control: $F_{ti} = \frac2D\frac{M_{ri} + cM_{ro}}{1 + c}$, $M_{si} = \frac{s}{1 + c}(M_{ri} - M_{ro})$.

The torques on the rings follow from these forces and the resistances, so that the drive power equals the power of the
resistances. With one orbital speed for all balls (`kinematics.orbit` "common"), the balls slide a little on the
frictionless races, and the constraint forces do not follow from the equilibrium of a single ball. The torques are then
those of ideal constraints, $T_i = \sum M_r\,\partial\omega_r/\partial\omega_i$ and likewise $T_o$ (virtual work; the
roll speeds $\omega_r$ are linear in the speeds of the rings).

**Validity:** that of the law of rolling resistance. The resistance has no effect on loads, angles and speeds.
**Reference:** own derivation.
"""

import dataclasses
from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from .equations import AbstractBallEquations
from .state import BallsState


class RollingBalance(NamedTuple):
    """Constraint forces F_t along the orbit, N, and moments M_s about the contact normals, N m, on each ball; the first
    axis is over the races."""

    forward: Float[Array, "2 ball"]
    about: Float[Array, "2 ball"]


def rolling_resistance(system: AbstractBallEquations, state: BallsState) -> Float[Array, "contact ball"] | None:
    """Moments M_r against the roll, N m, with the sign that they have in `friction`; `None`: not modelled."""
    turn = system.arcs.senses * state.races.roll
    contact = state.contact
    if system.arcs.single:
        cosines = jnp.cos(state.angle)
        contact = system.geometry.contacts(cosines[0], cosines[1], system.reduced_modulus)
    return system.laws.rolling_moment(contact, state.load, state.film, state.races.mean_speed, turn, system.inlet)


def rolling_balance(
    system: AbstractBallEquations, state: BallsState, resistance: Float[Array, "2 ball"]
) -> RollingBalance:
    """Constraint forces and moments of balls with two contacts under race control (see the module).

    **Arguments:** `resistance`: moments against the roll, N m, inner race first."""
    inner, outer = resistance
    turned = state.angle[1] - state.angle[0]
    cosine, sine = jnp.cos(turned), jnp.sin(turned)
    arm, zero = 2.0 / system.kinematics.ball_diameter, jnp.zeros_like(inner)
    if system.attitude == "outer":
        push = arm * (outer + cosine * inner) / (1.0 + cosine)
        about = jnp.stack([zero, sine * (outer - inner) / (1.0 + cosine)])
    else:
        push = arm * (inner + cosine * outer) / (1.0 + cosine)
        about = jnp.stack([sine * (inner - outer) / (1.0 + cosine), zero])
    return RollingBalance(jnp.stack([push, -push]), about)


def constraint_torques(
    system: AbstractBallEquations, state: BallsState, resistance: Float[Array, "contact ball"]
) -> tuple[Float[Array, ""], Float[Array, ""]]:
    """Torques on the inner and the outer ring, N m, if the motion of the balls is a linear function of the speeds of
    the rings (see the module). **Arguments:** `resistance`: moment against the roll at each contact, N m."""

    def power(inner_speed: Array, outer_speed: Array) -> Array:
        """Power of the given resistances, W, as a function of the speeds of the rings, rad/s."""
        motion = dataclasses.replace(system.kinematics, inner_speed=inner_speed, outer_speed=outer_speed)
        turning = dataclasses.replace(system, kinematics=motion)
        rolls = turning.races_of(turning.constrained(state), state.angle).roll
        return system.multiplicity * jnp.sum(system.arcs.senses * resistance * rolls)

    inner, outer = jax.grad(power, argnums=(0, 1))(system.kinematics.inner_speed, system.kinematics.outer_speed)
    return inner, outer
